# ctest: LABELS contract
"""Skins shown by Examples/Python/viewer.py: whole motions and previews. Testing/Viewer tests its
page."""

import sys
import tempfile
import unittest
from pathlib import Path

import numpy
from active_implicit_surfaces import frames

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "Examples" / "Python"))

import viewer_motion  # noqa: E402
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402

SPACING = 0.1
FRAMES = 7


def block(step):
    grid = numpy.stack(numpy.meshgrid(*3 * [numpy.arange(6.0)]), -1).reshape(-1, 3)
    return SPACING * grid + [0, 0.07 * step, 0]


def places(skin):
    return vtk_to_numpy(skin.GetPoints().GetData())


class TheMotion(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.files = [Path(temporary.name, f"block_{step}.npy") for step in range(FRAMES)]
        for step, file in enumerate(self.files):
            numpy.save(file, block(step))
        self.motion = viewer_motion.Motion(self.files)

    def make_all(self):
        while not self.motion.is_whole():
            self.motion.advance()

    def test_skins_are_those_of_a_program_without_options(self):
        self.make_all()
        given = {"particle_spacing": self.motion.values()["particle_spacing"]}
        for shown, (_, skin) in zip(self.motion.skins, frames(self.files, **given), strict=True):
            self.assertTrue(numpy.array_equal(places(shown), places(skin)))

    def test_first_values_are_what_the_filter_finds(self):
        interval = self.motion.times[1] - self.motion.times[0]
        wanted = {
            "particle_spacing": SPACING,
            "kernel_radius": 2.25 * SPACING,
            "voxel_size": 0.5 * SPACING,
            "attraction": 6 / interval,
            "transport": 1.0,
            "tension": 0.0,
        }
        for name, value in self.motion.values().items():
            self.assertAlmostEqual(value, wanted[name], msg=name)
        self.make_all()
        before = places(self.motion.skins[-1])
        # The explicit value differs from the default only in the last digits, and so do the skins.
        self.motion.sliders = {**self.motion.sliders, "kernel_radius": 2.25 + 1e-12}
        self.motion.restart()
        self.make_all()
        self.assertLess(abs(places(self.motion.skins[-1]) - before).max(), 1e-6)

    def test_lengths_follow_the_spacing(self):
        self.motion.sliders["particle_spacing"] = 2.0
        self.assertAlmostEqual(self.motion.values()["voxel_size"], SPACING)
        self.assertAlmostEqual(self.motion.values()["kernel_radius"], 4.5 * SPACING)

    def test_each_slider_changes_the_skins(self):
        self.make_all()
        before = self.motion.skins[-1].GetBounds()
        for name, (least, _, first, _) in viewer_motion.SLIDERS.items():
            with self.subTest(name):
                start = dict(self.motion.sliders)
                self.motion.sliders[name] = 2.0 if least == first else least
                self.motion.restart()
                self.assertEqual(self.motion.skins, [])
                self.make_all()
                self.assertNotEqual(self.motion.skins[-1].GetBounds(), before)
                self.motion.sliders = start

    def test_a_preview_is_coarse_near_and_leaves_the_motion_alone(self):
        self.motion.advance()
        preview = self.motion.preview(FRAMES - 1)
        self.assertEqual(len(self.motion.skins), 1)
        self.make_all()
        whole = self.motion.skins[-1]
        # Voxels are twice as large: a quarter of the points.
        self.assertLess(preview.GetNumberOfPoints(), 0.4 * whole.GetNumberOfPoints())
        # Both are surfaces of the same particles, with errors below their voxels.
        coarse = viewer_motion.COARSE * self.motion.values()["voxel_size"]
        for near, true in zip(preview.GetBounds(), whole.GetBounds(), strict=True):
            self.assertLess(abs(near - true), coarse)

    def test_a_preview_looks_at_a_few_frames_only(self):
        asked = []
        load = self.motion.files.load
        self.motion.files.load = lambda step: asked.append(step) or load(step)
        self.motion.preview(5)
        self.assertGreaterEqual(min(asked), 5 - viewer_motion.RUN_UP)
        self.assertIn(5, asked)

    def test_the_history_is_of_what_is_made(self):
        self.assertEqual(self.motion.volumes(), [])
        self.motion.advance()
        self.motion.advance()
        times, volumes = zip(*self.motion.volumes(), strict=True)
        self.assertEqual(list(times), self.motion.times[:2])
        self.assertGreater(min(volumes), 0)

    def test_after_a_stop_it_can_begin_anew(self):
        self.motion.stop()
        self.assertTrue(self.motion.is_whole())
        self.motion.restart()
        self.assertFalse(self.motion.is_whole())

    def test_a_series_without_motion_or_particles_is_refused(self):
        with self.assertRaisesRegex(ValueError, "at least two frames"):
            viewer_motion.Motion(self.files[:1])
        for file in self.files:
            numpy.save(file, numpy.zeros((0, 3)))
        with self.assertRaisesRegex(ValueError, "no frame has two"):
            viewer_motion.Motion(self.files)


if __name__ == "__main__":
    unittest.main()
