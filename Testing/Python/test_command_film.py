# ctest: DISPLAY LABELS contract
"""Films: every kind of file, light and ground, a camera that shows the whole series."""

import os
import stat
import subprocess
import sys
import time
import unittest
from pathlib import Path
from unittest import mock

import numpy
from active_implicit_surfaces import display, film, scene, vtkActiveEXRReader
from command_line import CommandTest, grid
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

SIZE = (160, 90)
SMALL = ("--size", "160x90")
# Replaces ffmpeg: keeps the command line and the input.
FFMPEG = """#!/bin/sh
for last; do :; done
echo "$@" > "$last.command"
{body}
"""


def pixels_of(path):
    """Rows from the top, of R G B."""
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    rows = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, 3)
    return rows[::-1].astype(int)


def is_skin(pixels):
    """Mask of the water, which is bluer than the paper and its shade."""
    return pixels[..., 2] - pixels[..., 0] > 40


class Films(CommandTest):
    def setUp(self):
        super().setUp()
        self.data = self.folder / "far.npz"
        numpy.savez(self.data, positions=[grid() + [1.0 * i, 0, 0] for i in range(3)])

    def render(self, name, *more):
        size = f"{SIZE[0]}x{SIZE[1]}"
        self.succeed("skin", self.data, "--render", self.folder / name, "--size", size, *more)

    def test_pictures_hold_the_whole_series(self):
        self.render("f_##.png")
        pictures = [pixels_of(self.folder / f"f_{i:02}.png") for i in range(3)]
        middles = []
        for picture in pictures:
            self.assertEqual(picture.shape, (SIZE[1], SIZE[0], 3))
            water = is_skin(picture)
            self.assertGreater(water.sum(), 100)
            edge = numpy.concatenate([water[0], water[-1], water[:, 0], water[:, -1]])
            self.assertFalse(edge.any(), "the skin leaves the picture")
            middles.append(numpy.nonzero(water)[1].mean())
        self.assertEqual(middles, sorted(middles), "x goes to the right")
        # The lattice moves by 2, five times its side: the motion fills most of the width.
        self.assertGreater(middles[2] - middles[0], 0.4 * SIZE[0])
        self.assertEqual(self.hidden(), [])
        self.assertEqual(sorted(self.folder.glob("*.vtp")), [], "no skins, as none are named")

    def test_the_camera_stays_where_a_run_goes_on(self):
        def go_on(offsets):
            for step, offset in enumerate(offsets):
                if not (self.folder / f"p{step}.npy").exists():
                    numpy.save(self.folder / f"p{step}.npy", grid() + [offset, 0, 0])
            command = ["skin", "p*.npy", "-o", "s_#.ply", "--render", "f_#.png", *SMALL]
            self.succeed(*command, "--resume")
            return is_skin(pixels_of(self.folder / f"f_{len(offsets) - 1}.png")).sum()

        self.assertGreater(go_on([0.0, 0.1]), 100)
        self.assertEqual(go_on([0.0, 0.1, 20.0]), 0, "far from what the first pictures show")

    def test_light_and_ground(self):
        numpy.savez(self.data, positions=grid())
        self.render("one.png")
        picture = pixels_of(self.folder / "one.png")
        water = is_skin(picture)
        brightness = picture.sum(axis=2)
        self.assertGreater(brightness[water].max(), 1.3 * brightness[water].min(), "no shading")
        paper = numpy.rint(255 * numpy.array(scene.PAPER)).sum()
        # Even far from the water, at the left, ambient occlusion darkens the ground by 1 or 2 %.
        background = numpy.median(brightness[:, 0])
        self.assertAlmostEqual(background, paper, delta=0.03 * paper, msg="the background")
        below = numpy.nonzero(water)[0].max() + 2
        middle = int(numpy.nonzero(water)[1].mean())
        self.assertLess(brightness[below, middle], 0.94 * paper, "no shade on the ground")

    def test_x_goes_to_the_right(self):
        for up in ("y", "z"):
            self.render("f_##.png", "--up", up)
            waters = [is_skin(pixels_of(self.folder / f"f_{i:02}.png")) for i in range(3)]
            middles = [numpy.nonzero(water)[1].mean() for water in waters]
            self.assertEqual(middles, sorted(middles), up)

    def test_the_axis_that_points_up(self):
        wide = grid() * [1.0, 0.3, 1.0]  # below, along y
        narrow = grid(2) + [0.15, 0.3, 0.15]
        numpy.savez(self.data, positions=numpy.concatenate([wide, narrow]))
        for up, is_narrow_above in ("--up=y", True), ("--up=-y", False):
            self.render("one.png", up)
            rows = is_skin(pixels_of(self.folder / "one.png")).sum(axis=1)
            rows = rows[rows > 0]
            fourth = len(rows) // 4
            self.assertEqual(rows[:fourth].mean() < rows[-fourth:].mean(), is_narrow_above, up)

    def test_layers(self):
        self.render("f_##.exr")
        reader = vtkActiveEXRReader()
        reader.SetFileName(str(self.folder / "f_01.exr"))
        reader.Update()
        arrays = reader.GetOutput().GetPointData()
        names = {arrays.GetArrayName(i) for i in range(arrays.GetNumberOfArrays())}
        self.assertLessEqual({"RGBA", "Z", "P", "N", "forward", "id"}, names)
        moved = vtk_to_numpy(arrays.GetArray("forward"))
        self.assertGreater(moved[:, 0].max(), 5.0, "the skin moves to the right")
        for scale in (0.5, 4):
            self.render("f_##.exr", "--time-scale", scale)
            reader.Modified()
            reader.Update()
            again = vtk_to_numpy(reader.GetOutput().GetPointData().GetArray("forward"))
            self.assertAlmostEqual(again[:, 0].max(), moved[:, 0].max(), delta=0.5, msg=scale)

    def test_an_ogg_film(self):
        self.render("film.ogv")
        self.assertEqual((self.folder / "film.ogv").read_bytes()[:4], b"OggS")
        self.assertEqual(self.hidden(), [])

    def put_ffmpeg(self, body):
        program = self.folder / "bin" / "ffmpeg"
        program.parent.mkdir()
        program.write_text(FFMPEG.format(body=body))
        program.chmod(program.stat().st_mode | stat.S_IXUSR)
        path = f"{program.parent}{os.pathsep}{os.environ['PATH']}"
        return mock.patch.dict(os.environ, {"PATH": path})

    def test_an_mp4_through_ffmpeg(self):
        with self.put_ffmpeg('cat > "$last"'):
            self.render("film.mp4", "--fps", 10)
        raw = (self.folder / "film.mp4").read_bytes()
        self.assertEqual(len(raw), 3 * 3 * SIZE[0] * SIZE[1])
        command = next(self.folder.glob(".*.command")).read_text()
        self.assertIn("-s 160x90 -r 10 ", command)

    def test_ffmpeg_that_fails(self):
        with self.put_ffmpeg('echo "no such coder" >&2; exit 3'):
            said = self.fail_with(1, "skin", self.data, "--render", self.folder / "a.mp4", *SMALL)
        self.assertIn("ffmpeg says: no such coder", said)
        self.assertFalse((self.folder / "a.mp4").exists())

    def test_no_ffmpeg(self):
        with mock.patch.object(film.shutil, "which", return_value=None):
            said = self.fail_with(1, "skin", self.data, "--render", self.folder / "a.mp4")
        self.assertIn("needs the program ffmpeg", said)

    @unittest.skipIf(display.vtk_version() >= (9, 4), "this VTK draws without a display")
    def test_no_display_and_none_to_start(self):
        without = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
        with (
            mock.patch.dict(os.environ, without, clear=True),
            mock.patch.object(display.shutil, "which", return_value=None),
        ):
            said = self.fail_with(1, "skin", self.data, "--render", self.folder / "a.png")
        self.assertIn("Xvfb", said)

    @unittest.skipIf(display.vtk_version() >= (9, 4), "this VTK draws without a display")
    def test_a_display_of_its_own(self):
        without = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
        program = (
            "import os, sys; from active_implicit_surfaces.commands import main; "
            "code = main(sys.argv[1:]); me = os.getpid(); "
            "print(open(f'/proc/{me}/task/{me}/children').read()); sys.exit(code)"
        )
        command = ("skin", str(self.data), "--render", str(self.folder / "a_#.png"), *SMALL)
        done = subprocess.run(
            [sys.executable, "-c", program, *command], env=without, capture_output=True, text=True
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(is_skin(pixels_of(self.folder / "a_2.png")).any())
        server = Path("/proc") / done.stdout.split()[-1]
        for _ in range(100):  # the server ends soon after the program
            if not server.exists():
                break
            time.sleep(0.1)
        self.assertFalse(server.exists(), "the display is still there")

    def test_a_folder_that_cannot_be_written(self):
        (self.folder / "a.png").mkdir()
        numpy.savez(self.data, positions=grid())
        said = self.fail_with(1, "skin", self.data, "--render", self.folder / "a.png", *SMALL)
        self.assertIn("cannot be written", said)


if __name__ == "__main__":
    unittest.main()
