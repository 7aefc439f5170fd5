# ctest: DISPLAY LABELS contract
"""Time series of images as the target of skin: fractions of volume, distances, labels.

Run: python3 test_image_series.py
"""

import json
import math
import unittest

import active_implicit_surfaces as active
import numpy
from active_implicit_surfaces.measures import measure
from active_implicit_surfaces.skin_files import read_shape
from command_line import CommandTest
from shapes import image_of, write
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

SIDE, RADIUS, STEP = 30, 0.2, 0.05  # pixels per unit; radius and displacement per frame of the ball
VOLUME = 4 / 3 * math.pi * RADIUS**3


def image(step, kind, count=1):
    """A moving ball; for labels, `count` moving balls along y."""
    axis = numpy.arange(SIDE * count) / SIDE
    z, y, x = numpy.meshgrid(axis[:SIDE], axis, axis[:SIDE], indexing="ij")
    distances = [
        numpy.sqrt((x - 0.3 - STEP * step) ** 2 + (y - i - 0.5) ** 2 + (z - 0.5) ** 2) - RADIUS
        for i in range(count)
    ]
    if kind == "distance":
        values = distances[0]
    elif kind == "fraction":
        values = numpy.clip(0.5 - distances[0] * SIDE, 0, 1) * 1.0001 - 1e-6  # overshoots
    else:
        values = sum((i + 2) * (own < 0) for i, own in enumerate(distances)).astype("i2")
    return image_of(values, 3 * [1 / SIDE])


class Series(CommandTest):
    def write(self, kind, count=1):
        for step in range(4):
            write(vtkXMLImageDataWriter(), image(step, kind, count), f"v_{step}.vti")

    def assert_ball(self, mesh, step, y=0.5):
        """Tolerances: volume 6 % (a pixel is a sixth of the radius), position half a pixel."""
        found, box = measure(mesh), mesh.GetBounds()
        self.assertAlmostEqual(found["volume"] / VOLUME, 1, delta=0.06)
        self.assertAlmostEqual(0.5 * (box[0] + box[1]), 0.3 + STEP * step, delta=0.5 / SIDE)
        self.assertAlmostEqual(0.5 * (box[2] + box[3]), y, delta=0.5 / SIDE)
        self.assertEqual(found["open edges"], 0)

    def test_fractions_and_distances(self):
        for kind in ("fraction", "distance"):
            with self.subTest(kind):
                self.write(kind)
                self.succeed("skin", "v_*.vti", "-o", "s_#.ply", "--fps", 10, "--quiet")
                for step in range(4):
                    self.assert_ball(read_shape(self.folder / f"s_{step}.ply"), step)
        index = json.loads((self.folder / "s.ply.series").read_text())
        self.assertEqual([file["time"] for file in index["files"]], [0, 0.1, 0.2, 0.3])

    def test_labels(self):
        self.write("labels", 2)
        said = self.fail_with(1, "skin", "v_*.vti", "--quiet")
        self.assertIn("The image has the values 2, 3; if they are labels, choose one", said)
        said = self.fail_with(1, "skin", "v_*.vti", "--label", 7, "--quiet")
        self.assertIn("The image has no surface: all values are 0. Choose another label", said)
        self.succeed("skin", "v_*.vti", "--labels", "all", "-o", "s_#.ply", "--quiet")
        for label in (2, 3):
            mesh = read_shape(self.folder / f"s_{label}_3.ply")
            self.assert_ball(mesh, 3, label - 1.5)

    def test_a_frame_without_the_label_is_empty(self):
        images = [image(step, "labels") for step in range(3)]
        images[2].GetPointData().GetScalars().Fill(0)
        skins = [frame.skin for frame in active.frames(images, fps=10)]
        self.assert_ball(skins[1], 1)
        self.assertEqual(skins[2].GetNumberOfPoints(), 0)

    def test_a_level_of_its_own(self):
        hot = [image(step, "distance") for step in range(2)]
        for own in hot:  # 300 outside, 400 at the centre
            values = own.GetPointData().GetScalars()
            for i in range(values.GetNumberOfTuples()):
                values.SetValue(i, 350 - 250 * values.GetValue(i))
        options = {"target_iso_value": 350, "invert_target": True}
        for step, frame in enumerate(active.frames(hot, fps=10, **options)):
            self.assert_ball(frame.skin, step)
        with self.assertRaisesRegex(ValueError, "no inside.*Give target_iso_value"):
            active.frames(hot, fps=10)

    def test_options_of_particles_are_an_error(self):
        self.write("fraction")
        said = self.fail_with(1, "skin", "v_*.vti", "--preset", "viscous")
        self.assertIn("The preset viscous needs particles, not an image", said)
        for option in (("--radii", "r"), ("--particle-spacing", 1)):
            said = self.fail_with(2, "skin", "v_*.vti", *option)
            self.assertIn(f"{option[0]} has no effect here: it acts on particles", said)

    def test_pictures_and_resuming(self):
        self.write("fraction")
        arguments = ("skin", "v_*.vti", "-o", "s_#.ply", "--render", "p_#.png", "--quiet")
        self.succeed(*arguments, "--size", "160x120", "--resume")
        whole = (self.folder / "s_3.ply").read_bytes()
        self.succeed(*arguments, "--size", "160x120", "--frames", "1:3", "--preroll", 1)
        self.assertEqual((self.folder / "s_3.ply").read_bytes(), whole)
        self.assertTrue((self.folder / "p_3.png").exists())


if __name__ == "__main__":
    unittest.main()
