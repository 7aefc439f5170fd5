"""A page in the browser: play the skin of particles, change six properties, save a frame.

Run: python3 viewer.py [FILE ...] [--port N] [--server]   (without FILE: a splash of 992 particles)

This program renders the pictures, so they look like those of `active-surface skin --render`.
"""

import asyncio
import base64
import math
import sys
import tempfile
import time
import warnings
from contextlib import suppress
from pathlib import Path

import numpy
from active_implicit_surfaces.commands.view import find_view
from active_implicit_surfaces.display import find_display
from active_implicit_surfaces.scene import Scene
from active_implicit_surfaces.skin_files import write_mesh
from viewer_motion import SLIDERS, Motion
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkJPEGWriter

try:
    from trame.app import get_server
    from viewer_page import build_page, draw_history
except ImportError as error:
    sys.exit(f"The viewer needs trame: pip install trame trame-vuetify. The cause was: {error}")

DATA = Path(__file__).resolve().parents[2] / "Testing" / "Data" / "sph_drop.vtp"
SIZE = (960, 640)
FRAME_DURATION = 0.04  # seconds per frame while playing
PATIENCE = 0.5  # seconds without a change before long tasks begin: the motion, a soft picture
LOWEST, HIGHEST = 0, 85  # degrees of the camera above the ground


class Viewer:
    """State of the page, and the single task that does all work, the most urgent piece first."""

    def __init__(self, server, motion):
        self.server, self.state, self.motion = server, server.state, motion
        held, up = find_view(motion.files)
        self.quick, self.soft = Scene(held, SIZE, up, soft=False), Scene(held, SIZE, up)
        self.awake, self.wanted, self.before = asyncio.Event(), {"picture", "soft picture"}, []
        self.changed_at = self.next_frame_at = 0.0
        for scene in (self.quick, self.soft):
            scene.renderer.GetActiveCamera().Dolly(1 / 1.1)  # margin for turning
        self.state.update({"step": 0, "playing": False, "note": "", **motion.sliders})
        self.tell()
        self.state.change(*SLIDERS)(self.on_slider)
        self.state.change("step", "playing")(self.redraw)
        for action in (self.turn, self.zoom, self.save):
            server.trigger(action.__name__)(action)
        server.controller.on_server_ready.add_task(self.work)
        build_page(server, SLIDERS, motion.times)

    def on_slider(self, **_):
        sliders = {name: float(self.state[name]) for name in SLIDERS}
        if sliders != self.motion.sliders:
            self.motion.sliders = sliders
            self.wanted.add("motion")
            self.tell()
            self.redraw()

    def redraw(self, **_):
        self.wanted |= {"picture", "soft picture"}
        self.changed_at = time.monotonic()
        self.awake.set()

    def turn(self, across, down):
        for scene in (self.quick, self.soft):
            camera = scene.renderer.GetActiveCamera()
            upward = numpy.dot(camera.GetViewUp(), camera.GetDirectionOfProjection())
            above = math.degrees(math.asin(-upward))
            camera.Azimuth(-0.4 * across)
            camera.Elevation(min(max(0.4 * down, LOWEST - above), HIGHEST - above))
        self.redraw()

    def zoom(self, wheel):
        for scene in (self.quick, self.soft):
            scene.renderer.GetActiveCamera().Dolly(1.1 if wheel < 0 else 1 / 1.1)
        self.redraw()

    def save(self, suffix):
        """Returns a file with the skin of this frame, as an attachment for the browser."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "skin" + suffix)
            voxel = {"SetVoxelSize": self.motion.values()["voxel_size"]} if suffix == ".vdb" else {}
            write_mesh(path, self.motion.skins[self.state.step], **voxel)
            return self.server.protocol.addAttachment(path.read_bytes())

    async def work(self, **_):
        while True:
            self.awake.clear()
            try:
                with warnings.catch_warnings(record=True) as said:
                    has_worked = self.do_one_thing()
                note = str(said[-1].message) if said else ""
            except (OSError, ValueError) as error:
                has_worked, note = False, str(error)
                self.motion.stop()
            with self.state:
                self.state.note = note or self.state.note
            if has_worked:
                await asyncio.sleep(0.005)  # lets messages from the browser in
                continue
            with suppress(asyncio.TimeoutError):
                await asyncio.wait_for(self.awake.wait(), FRAME_DURATION)

    def do_one_thing(self):
        """Does the most urgent piece of work; returns False if there is none."""
        is_quiet = time.monotonic() - self.changed_at > PATIENCE
        if "picture" in self.wanted:
            self.wanted.discard("picture")
            self.show(self.quick)
        elif "motion" in self.wanted and not is_quiet:
            return False
        elif "motion" in self.wanted:
            self.restart()
        elif self.state.playing and self.has(self.next_step()) and self.is_time():
            self.state.step = self.next_step()
        elif not self.motion.is_whole():
            self.make_next()
        elif "soft picture" in self.wanted and is_quiet and not self.state.playing:
            self.wanted.discard("soft picture")
            self.show(self.soft)
        else:
            return False
        return True

    def has(self, step):
        return "motion" not in self.wanted and step < len(self.motion.skins)

    def next_step(self):
        return (self.state.step + 1) % len(self.motion.times)

    def is_time(self):
        now = time.monotonic()
        is_due = now >= self.next_frame_at
        if is_due:
            self.next_frame_at = max(now, self.next_frame_at + FRAME_DURATION)
        return is_due

    def restart(self):
        self.wanted.discard("motion")
        self.before, self.state.note = self.motion.volumes(), ""
        self.motion.restart()
        self.tell()

    def make_next(self):
        self.motion.advance()
        self.tell()
        if len(self.motion.skins) == self.state.step + 1:
            self.wanted |= {"picture", "soft picture"}

    def show(self, scene):
        step, self.state.drawn = self.state.step, "soft" if scene is self.soft else "quick"
        skin = self.motion.skins[step] if self.has(step) else self.motion.preview(step)
        scene.show(skin)
        scene.renderer.ResetCameraClippingRange()
        self.state.picture = "data:image/jpeg;base64," + base64.b64encode(jpeg(scene)).decode()
        self.tell()

    def tell(self):
        """Updates the numbers and the history that the page shows."""
        step, times, motion = self.state.step, self.motion.times, self.motion
        self.state.values = {name: f"{value:.3g}" for name, value in motion.values().items()}
        self.state.made = 0 if "motion" in self.wanted else len(motion.skins)
        self.state.is_made = self.has(step)
        self.state.time = f"{times[step]:.3g}"
        self.state.history = draw_history(motion.volumes(), self.before, times, times[step])


def jpeg(scene):
    writer = vtkJPEGWriter()
    writer.SetInputData(scene.picture())
    writer.SetQuality(90)
    writer.WriteToMemoryOn()
    writer.Write()
    return vtk_to_numpy(writer.GetResult()).tobytes()


def main():
    server = get_server()
    server.cli.description = __doc__
    server.cli.add_argument("files", nargs="*", default=[DATA])
    try:
        find_display()
        Viewer(server, Motion(server.cli.parse_known_args()[0].files))
    except (OSError, ValueError) as error:
        sys.exit(str(error))
    server.start()


if __name__ == "__main__":
    main()
