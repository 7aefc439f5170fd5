# ctest: LABELS exact
"""The level of an image's surface and the voxel size are derived from the image.

Run: python3 test_image_levels.py
"""

import unittest
import warnings

import active_implicit_surfaces as active
import numpy
from active_implicit_surfaces import vtkActiveImplicitSurface
from active_implicit_surfaces.contours import as_level_set, level_of_series
from listener import Listener
from shapes import image_of, volume_of, with_properties
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLogger

SIZE, RADIUS = 50, 15.3
PLACES = numpy.mgrid[0:SIZE, 0:SIZE, 0:SIZE] - 24.4
DISTANCE = numpy.sqrt((PLACES**2).sum(0)) - RADIUS
BALL = 4 / 3 * numpy.pi * RADIUS**3
INSIDE = DISTANCE < 0


def surface_of(values, **properties):
    surface = vtkActiveImplicitSurface()
    surface.SetInputData(0, image_of(values, properties.pop("spacing", (1, 1, 1))))
    with_properties(surface, properties)
    surface.UpdateTimeStep(0.0)
    return surface


def volume(values, **properties):
    skin = surface_of(values, **properties).GetOutput()
    return volume_of(skin)


class Levels(unittest.TestCase):
    def setUp(self):
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)

    def check(self, values, expected=BALL, **properties):
        self.assertLess(abs(volume(values, **properties) / expected - 1), 0.01)

    def test_masks(self):
        for low, high, kind in ((0, 1, "u1"), (0, 3, "i2"), (7, 9, "i4"), (0, 255, "f4")):
            with self.subTest(low=low, high=high, kind=kind):
                self.check(numpy.where(INSIDE, high, low).astype(kind))
                self.check(numpy.where(INSIDE, high, low).astype(kind), InvertTarget=1)

    def test_the_start_of_a_morph_is_zero_midway_between_two_values(self):
        for inside, outside, half in ((-3.0, 1.0, 2), (-1.0, 1.0, 1), (7, 0, 3.5)):
            image = image_of(numpy.where(INSIDE, inside, outside), (1, 1, 1))
            level_set = as_level_set(image, *level_of_series([image]))
            found = vtk_to_numpy(level_set.GetPointData().GetScalars())
            wanted = image_of(numpy.where(INSIDE, -half, half), (1, 1, 1)).GetPointData()
            numpy.testing.assert_array_equal(found, vtk_to_numpy(wanted.GetScalars()))

    def test_fractions(self):
        fraction = numpy.clip(0.5 - DISTANCE, 0, 1)
        self.check(fraction)
        noise = numpy.random.default_rng(1).uniform(-0.02, 0.02, fraction.shape)
        self.check(fraction + noise * (noise > 0.012))  # noise as left by a solver
        self.check(fraction - noise * (noise > 0.012))

    def test_pixels_that_are_no_numbers_do_not_count(self):
        mask = numpy.where(INSIDE, 1.0, 0.0)
        mask[0, 0, 0] = numpy.nan
        self.check(mask)

    def test_pixels_that_are_no_numbers_are_counted(self):
        distance = numpy.array(DISTANCE, dtype=float)
        middle = distance.shape[0] // 2
        distance[middle, middle, middle] = numpy.nan
        distance[0, 0, 0] = numpy.inf
        for port, where in enumerate(("", " of input port 1")):
            surface = vtkActiveImplicitSurface()
            surface.SetInputData(0, image_of(DISTANCE if port else distance))
            if port:
                surface.SetInputData(1, image_of(distance))
            heard = Listener(surface)
            surface.UpdateTimeStep(0.0)
            told = " ".join(" ".join(heard.warnings).split())
            wanted = f"{where}: 2 of its {distance.size} values are not finite"
            self.assertEqual(told.count(wanted), 1, told)

    def test_pixels_of_a_mask_that_are_no_numbers_are_told_once(self):
        mask = numpy.where(INSIDE, 1.0, 0.0)
        mask[0, 0, 0] = numpy.nan
        images = [image_of(mask), image_of(mask)]
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            list(active.frames(images, fps=25))
        said = [str(each.message) for each in caught if "not finite" in str(each.message)]
        self.assertEqual(len(said), 1, said)

    def test_what_is_below_zero_stays_inside(self):
        self.check(DISTANCE)
        self.check(numpy.clip(DISTANCE, -1, 1))
        self.check(numpy.where(INSIDE, -1, 1).astype("i1"))
        self.check(0.001 * DISTANCE / RADIUS, spacing=(1, 1, 1))

    def test_a_level_that_is_given_counts(self):
        self.check(DISTANCE, 4 / 3 * numpy.pi * (RADIUS + 2) ** 3, TargetIsoValue=2.0)
        density = 100.0 - DISTANCE
        self.check(density, TargetIsoValue=100.0, InvertTarget=1)
        three = numpy.where(DISTANCE < -8, 2, numpy.where(INSIDE, 1, 0)).astype("u1")
        self.check(three, TargetIsoValue=0.5, InvertTarget=1)

    def test_a_full_image_has_no_level(self):
        self.assertEqual(volume(numpy.ones((9, 9, 9))), 0.0)

    def test_several_labels_have_no_level(self):
        three = numpy.where(DISTANCE < -8, 2, numpy.where(INSIDE, 1, 0)).astype("u1")
        surface = vtkActiveImplicitSurface()
        surface.SetInputData(0, image_of(three))
        heard = Listener(surface)
        surface.UpdateTimeStep(0.0)
        self.assertEqual(surface.GetOutput().GetNumberOfCells(), 0)
        told = " ".join(" ".join(heard.warnings).split())
        self.assertIn("Its values are from 0 to 2, and inside is below 0", told)
        self.assertIn("choose one label by vtkImageThreshold", told)

    def test_what_has_an_inside_needs_no_sentence(self):
        for values in (DISTANCE, INSIDE.astype("u1"), numpy.zeros((9, 9, 9))):
            surface = vtkActiveImplicitSurface()
            surface.SetInputData(0, image_of(values))
            heard = Listener(surface)
            surface.UpdateTimeStep(0.0)
            self.assertNotIn("Its values are", " ".join(heard.warnings))


class Voxels(unittest.TestCase):
    def test_no_coarser_than_a_pixel(self):
        fine = numpy.zeros((4, 4, 200), "u1")
        fine[1:3, 1:3, 20:180] = 1
        surface = surface_of(fine, spacing=(0.5, 0.7, 0.9))
        self.assertEqual(surface.GetVoxelSizeInUse(), 0.5)
        self.assertGreater(surface.GetOutput().GetNumberOfCells(), 0)

    def test_a_coarse_image_gets_its_64_voxels(self):
        surface = surface_of(DISTANCE[::5, ::5, ::5].copy(), spacing=(5, 5, 5))
        self.assertLess(surface.GetVoxelSizeInUse(), 1.0)

    def test_a_size_that_is_given_counts(self):
        self.assertEqual(surface_of(DISTANCE, VoxelSize=2.0).GetVoxelSizeInUse(), 2.0)


if __name__ == "__main__":
    unittest.main()
