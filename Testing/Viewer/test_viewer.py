"""The page of Examples/Python/viewer.py, seen and used as by a person, in a headless Chromium.

Run by Testing/Viewer/run. Its last pictures are in build/viewer.
"""

import os
import signal
import socket
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy
from active_implicit_surfaces import frames
from active_implicit_surfaces.particle_files import read_vtk
from playwright.sync_api import expect, sync_playwright
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

ROOT = Path(__file__).resolve().parents[2]
VIEWER = ROOT / "Examples" / "Python" / "viewer.py"
PICTURES = ROOT / "build" / "viewer"
SPACING, FRAMES = 0.1, 8
SECONDS = 60  # limit for a step on a busy machine; most need less than one


def block(step):
    places = SPACING * numpy.stack(numpy.meshgrid(*3 * [numpy.arange(8.0)]), -1).reshape(-1, 3)
    wider = 1 + 0.02 * step
    fallen = 0.7 * (step / (FRAMES - 1)) ** 2
    return (places - 3.5 * SPACING) * [wider, 1, wider] - [0, fallen, 0]


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def pixels_of(png):
    """Array [row, column, R G B] of integers."""
    reader = vtkPNGReader()
    reader.SetFileName(str(png))
    reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    scalars = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    return scalars.reshape(height, width, -1)[..., :3].astype(int)


def is_water(pixels):
    """Mask of the skin's color: clearly more blue than red, in light and in shade."""
    return pixels[..., 2] - pixels[..., 0] > 30


class Page(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.files = [self.folder / f"block_{step}.csv" for step in range(FRAMES)]
        for step, file in enumerate(self.files):
            numpy.savetxt(file, block(step), delimiter=",", header="x,y,z", comments="")

    def open(self):
        port = free_port()
        names = [str(file) for file in self.files]
        options = ["--server", "--port", str(port), "--timeout", "0"]
        server = subprocess.Popen(
            [sys.executable, str(VIEWER), *names, *options],
            start_new_session=True,
            stdout=subprocess.DEVNULL,
        )
        self.addCleanup(server.wait)
        self.addCleanup(os.killpg, server.pid, signal.SIGKILL)
        playwright = sync_playwright().start()
        self.addCleanup(playwright.stop)
        browser = playwright.chromium.launch(executable_path="/usr/bin/chromium")
        self.addCleanup(browser.close)
        page = browser.new_page(viewport={"width": 1200, "height": 800})
        page.set_default_timeout(1000 * SECONDS)
        expect.set_options(timeout=1000 * SECONDS)
        self.go_to(page, server, f"http://127.0.0.1:{port}")
        page.wait_for_selector("img.picture[src^=data]")
        return page

    def go_to(self, page, server, address):
        """Waits for the server, and fails if the server has ended."""
        host, _, port = address.rpartition("/")[2].partition(":")
        with socket.socket() as line:
            while line.connect_ex((host, int(port))):
                self.assertIsNone(server.poll(), "the viewer has ended")
                page.wait_for_timeout(100)
        page.goto(address)

    def source(self, page):
        return page.get_attribute("img.picture", "src")

    def wait_for_another(self, page, source):
        page.wait_for_function("s => document.querySelector('img.picture').src != s", arg=source)

    def wait_until_done(self, page):
        """Waits for all skins, and for the last task, a picture with soft shades."""
        page.wait_for_selector("img.picture.soft")
        page.wait_for_function(
            "() => document.querySelector('.made').getAttribute('aria-valuenow') == 100"
        )

    def picture(self, page, name):
        path = PICTURES / f"{name}.png"
        page.locator("img.picture").screenshot(path=path)
        return pixels_of(path)

    def drag(self, page, start, across, down=0.0):
        page.mouse.move(*start)
        page.mouse.down()
        page.mouse.move(start[0] + across, start[1] + down, steps=10)
        page.mouse.up()

    def frame(self, page):
        return page.locator(".frame").inner_text().partition(",")[0]

    def scrub(self, page, frame):
        """Moves to a frame, counted from 1, by a click on the time slider."""
        box = page.locator(".time .v-slider-track").bounding_box()
        place = box["x"] + (box["width"] - 1) * (frame - 1) / (FRAMES - 1)
        page.mouse.click(place, box["y"] + box["height"] / 2)
        # The browser shows the frame's number at once, but the time only with the server's picture.
        time = f"{(frame - 1) / 25:.3g}"
        expect(page.locator(".frame")).to_contain_text(f"frame {frame} of {FRAMES}, time {time}")

    def middle_of(self, page, selector):
        box = page.locator(selector).bounding_box()
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def test_it_shows_the_skin_and_what_the_sliders_are(self):
        page = self.open()
        expect(page.get_by_text("Voxel size [length]")).to_be_visible()
        expect(page.get_by_text("Tension [length²/time]")).to_be_visible()
        expect(page.locator("span.particle_spacing")).to_have_text("0.1")
        expect(page.locator("span.voxel_size")).to_have_text("0.05")
        expect(page.get_by_text(f"frame 1 of {FRAMES}, time 0")).to_be_visible()
        page.get_by_text("Voxel size [length]").hover()
        expect(page.get_by_text("Distance of the lattice nodes")).to_be_visible()
        self.wait_until_done(page)
        page.screenshot(path=PICTURES / "page.png")
        # The block's height and its fall fill the picture's height, of which the block is about
        # half.
        share = is_water(self.picture(page, "start")).mean()
        self.assertTrue(0.03 < share < 0.5, share)
        lines = page.locator(".history polyline").evaluate_all(
            "all => all.map(line => line.getAttribute('points').split(' ').length)"
        )
        self.assertIn(FRAMES, lines)

    def test_play_stop_and_scrub(self):
        page = self.open()
        self.wait_until_done(page)
        before = is_water(self.picture(page, "first"))
        page.click(".play")
        expect(page.locator(".frame")).not_to_contain_text("frame 1 ")
        page.click(".play")
        page.wait_for_timeout(500)
        text = self.frame(page)
        page.wait_for_timeout(500)
        self.assertEqual(self.frame(page), text)
        self.scrub(page, FRAMES)
        self.wait_until_done(page)
        after = is_water(self.picture(page, "last"))
        # The block has fallen by 0.7 of the visible height, 0.8 + 0.7. Rows count from below.
        rows = [numpy.nonzero(water)[0].mean() for water in (before, after)]
        self.assertLess(rows[1], rows[0] - 0.2 * len(before))

    def test_a_drag_of_a_slider_shows_a_preview_then_makes_all_anew(self):
        page = self.open()
        self.wait_until_done(page)
        before = is_water(self.picture(page, "before_drag"))
        source = self.source(page)
        thumb = self.middle_of(page, ".slider-particle_spacing [role=slider]")
        page.mouse.move(*thumb)
        page.mouse.down()
        page.mouse.move(thumb[0] + 400, thumb[1], steps=10)  # beyond the slider's end
        self.wait_for_another(page, source)
        page.mouse.up()
        expect(page.locator("span.particle_spacing")).to_have_text("0.2")
        expect(page.locator("span.voxel_size")).to_have_text("0.1")  # the voxel size follows
        self.wait_until_done(page)
        expect(page.locator(".save-vtp")).to_be_enabled()
        # Twice the spacing rounds the corners more, and changes more than a tenth of the block's
        # pixels.
        page.locator(".note .v-alert__close button").click()  # a note about particles outside
        expect(page.locator(".note")).to_have_count(0)
        after = is_water(self.picture(page, "after_drag"))
        self.assertGreater((after != before).sum(), 0.1 * before.sum())

    def test_a_drag_on_the_picture_turns_it_and_the_wheel_zooms(self):
        page = self.open()
        self.wait_until_done(page)
        before, source = self.picture(page, "before_turn"), self.source(page)
        middle = self.middle_of(page, "img.picture")
        self.drag(page, middle, 80, 30)
        self.wait_for_another(page, source)
        self.wait_until_done(page)
        turned, source = self.picture(page, "turned"), self.source(page)
        self.assertGreater((abs(turned - before).max(-1) > 30).mean(), 0.01)
        page.mouse.wheel(0, -100)
        self.wait_for_another(page, source)
        self.wait_until_done(page)
        nearer = self.picture(page, "nearer")
        # A factor of 1.1 nearer means about 1.2 times the area.
        self.assertGreater(is_water(nearer).mean(), 1.1 * is_water(turned).mean())

    def test_files_are_those_of_the_frame(self):
        page = self.open()
        self.wait_until_done(page)
        self.scrub(page, step := FRAMES - 1)
        names = [str(file) for file in self.files]
        skins = {i: skin for i, (_, skin) in enumerate(frames(names, particle_spacing=SPACING))}
        for suffix in ("vtp", "obj", "vdb"):
            with self.subTest(suffix):
                with page.expect_download() as download:
                    page.click(f".save-{suffix}")
                self.assertEqual(download.value.suggested_filename, f"skin_{step - 1}.{suffix}")
                path = self.folder / f"saved.{suffix}"
                download.value.save_as(path)
                self.compare(read_vtk(path), skins[step - 1], suffix)

    def compare(self, saved, skin, suffix):
        if suffix == "vdb":  # voxels are half of the spacing
            self.assertAlmostEqual(saved.GetSpacing()[0], 0.5 * SPACING)
        else:
            self.assertEqual(saved.GetNumberOfPolys(), skin.GetNumberOfPolys())
            places = [vtk_to_numpy(one.GetPoints().GetData()) for one in (saved, skin)]
            # The files keep all digits. The viewer estimates the spacing, as 0.1 up to rounding.
            self.assertLess(abs(places[0] - places[1]).max(), 1e-5)

    def test_an_error_is_told_and_what_was_made_can_be_seen(self):
        page = self.open()
        self.wait_until_done(page)
        self.files[5].unlink()
        self.drag(page, self.middle_of(page, ".slider-voxel_size [role=slider]"), 20)
        expect(page.locator(".note")).to_contain_text("block_5.csv")
        expect(page.locator(".save-vtp")).to_be_enabled()
        self.scrub(page, 4)
        expect(page.locator(".save-vtp")).to_be_enabled()

    def test_a_file_that_cannot_be_read_is_a_sentence(self):
        self.files[3].write_text("no,numbers\nat,all\n")
        done = subprocess.run(
            [sys.executable, str(VIEWER), *map(str, self.files), "--server", "--port", "0"],
            capture_output=True,
            text=True,
        )
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr.splitlines()[-1], r"^.*block_3\.csv cannot be read")


if __name__ == "__main__":
    unittest.main()
