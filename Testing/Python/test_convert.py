# ctest: LABELS contract
"""active-surface convert: surfaces of images and grids are closed, outward, and in the right
place.

Volumes and areas are sums over the triangles of the written files.
"""

import math
import os
import unittest

import active_implicit_surfaces as active
import numpy
from active_implicit_surfaces import contours, skin, vtkActiveVDBWriter
from active_implicit_surfaces.measures import measure
from active_implicit_surfaces.skin_files import read_shape
from command_line import CommandTest, grid
from shapes import points_of, write
from skin_checks import check_manifold, triangles_of
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter, vtkXMLPolyDataWriter

BALL = 4 / 3 * numpy.pi


def volume(mesh):
    """Volume of a closed mesh; positive if the triangles are oriented outward."""
    found = measure(mesh)
    assert found["open edges"] == 0
    return found["volume"]


def image_of(function, count=41, half=1.5, origin=0.0, dtype=numpy.float64, cells=False):
    """Values of the function at points, or in cells, of a cube of the given half side."""
    axis = numpy.linspace(-half, half, count) + origin
    spacing = axis[1] - axis[0]
    image = vtkImageData()
    image.SetOrigin(*(axis[0] - (spacing / 2 if cells else 0),) * 3)
    image.SetSpacing(spacing, spacing, spacing)
    image.SetDimensions(*(count + cells,) * 3)
    z, y, x = numpy.meshgrid(axis, axis, axis, indexing="ij")
    values = numpy_to_vtk(function(x, y, z).astype(dtype).ravel(), deep=True)
    values.SetName("f")
    (image.GetCellData() if cells else image.GetPointData()).SetScalars(values)
    return image


def ball(x, y, z):
    return numpy.sqrt(x * x + y * y + z * z) - 1.0


def inside(x, y, z):
    return ball(x, y, z) < 0


class Contours(unittest.TestCase):
    def check(self, mesh, wanted, share):
        triangles, points = triangles_of(mesh), points_of(mesh).astype(float)
        check_manifold(triangles, len(points))
        a, b, c = (points[triangles[:, i]] for i in range(3))
        self.assertGreater(numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1).min(), 0.0)
        self.assertAlmostEqual(volume(mesh) / wanted, 1.0, delta=share)

    def test_a_level_set_has_its_volume(self):
        # Triangles with sides up to sqrt(2) h lie 0.25 h^2 below the sphere on average: 0.75 h^2 of
        # the volume. Linear interpolation of distances between nodes adds up to 0.25 h^2.
        for count in (31, 40, 41):
            h = 3 / (count - 1)
            with self.subTest(points=count):
                image = image_of(ball, count)
                self.check(contours.contour(image, 0.0), BALL, h * h)

    def test_nodes_on_the_surface_are_no_trouble(self):
        box = image_of(lambda x, y, z: numpy.max(numpy.abs([x, y, z]), axis=0) - 0.75, 41)
        mesh = contours.contour(box, 0.0)
        self.check(mesh, 1.5**3, 0.02)

    def test_it_is_closed_at_the_border(self):
        """A ball of radius 1 in a box of half side 0.8, which cuts off six caps."""
        mesh = contours.contour(image_of(ball, 81, 0.8), 0.0)
        cap = numpy.pi * 0.2**2 * (3 - 0.2) / 3
        faces = 6 * numpy.pi * (1 - 0.8**2)  # at the border, up to a voxel beyond its points
        self.check(mesh, BALL - 6 * cap, 0.02 * faces / (BALL - 6 * cap))

    def test_above_is_outward_too(self):
        mesh = contours.contour(
            image_of(lambda *x: numpy.clip(1 - ball(*x), 0, 2)), 1.0, above=True
        )
        self.check(mesh, BALL, 0.02)

    def test_values_in_cells_are_taken(self):
        mesh = contours.contour(image_of(ball, cells=True), 0.0)
        self.check(mesh, BALL, 0.05)

    def test_a_label_map_is_between_its_values_and_above(self):
        for low, high in ((0, 1), (0, 255), (3, 7)):
            image = image_of(
                lambda *x, a=low, b=high: numpy.where(inside(*x), b, a), dtype=numpy.uint8
            )
            level, above = contours.usual_level(image)
            self.assertEqual((level, above), (0.5 * (low + high), True))
            self.check(contours.contour(image, level, above=above), BALL, 0.05)
        self.assertEqual(contours.usual_level(image_of(ball)), (0.0, False))

    def test_two_values_of_which_one_is_negative_are_signs(self):
        image = image_of(lambda *x: numpy.where(inside(*x), -1.0, 1.0))
        level, above = contours.usual_level(image)
        self.assertEqual((level, above), (0.0, False))
        self.check(contours.contour(image, level, above=above), BALL, 0.05)

    def test_values_that_are_not_finite_are_a_warning(self):
        image = image_of(ball)
        image.GetPointData().GetScalars().SetTuple1(0, math.nan)
        self.assertEqual(contours.usual_level(image), (0.0, False))
        with self.assertWarnsRegex(active.ActiveSurfaceWarning, "1 of its .* is not finite"):
            contours.contour(image, 0.0)

    def test_where_the_image_is_does_not_matter(self):
        here = contours.contour(image_of(ball), 0.0)
        there = image_of(ball)
        there.SetOrigin(*numpy.add(there.GetOrigin(), (100.3, -50.7, 0.01)))
        mesh = contours.contour(there, 0.0)
        self.assertEqual(mesh.GetNumberOfPolys(), here.GetNumberOfPolys())
        bounds = numpy.subtract(mesh.GetBounds(), here.GetBounds())
        numpy.testing.assert_allclose(bounds, [100.3, 100.3, -50.7, -50.7, 0.01, 0.01], atol=2e-5)

    def test_no_level_no_surface(self):
        for level in (-2.0, 9.0):
            self.assertEqual(contours.contour(image_of(ball), level).GetNumberOfPoints(), 0)
        self.assertEqual(contours.contour(vtkImageData(), 0.0).GetNumberOfPoints(), 0)


class Program(CommandTest):
    def setUp(self):
        super().setUp()
        self.skin = skin(grid(), particle_spacing=0.1)

    def test_a_skin_by_way_of_vdb_looks_as_it_did(self):
        source = write(vtkActiveVDBWriter(), self.skin, self.folder / "skin.vdb")
        for name in ("a.stl", "a.ply", "a.obj", "a.vtp"):
            self.succeed("convert", source, "-o", self.folder / name)
            made = read_shape(self.folder / name)
            self.assertAlmostEqual(volume(made) / volume(self.skin), 1.0, delta=0.02)

    def test_an_image_by_way_of_vdb_keeps_its_inside(self):
        """Distances, fractions and signs, in grids without a class."""
        makers = {
            "distances": ball,
            "fractions": lambda *x: numpy.clip(0.5 - 10 * ball(*x), 0, 1),
            "signs": lambda *x: numpy.where(inside(*x), 1.0, -1.0),
        }
        for name, maker in makers.items():
            with self.subTest(name):
                source = write(vtkXMLImageDataWriter(), image_of(maker), self.folder / "a.vti")
                self.succeed("convert", source, "-o", self.folder / "a.vdb")
                self.succeed("convert", self.folder / "a.vdb", "-o", self.folder / "a.ply")
                made = read_shape(self.folder / "a.ply")
                self.assertAlmostEqual(volume(made) / BALL, 1.0, delta=0.05)

    def test_a_label_map_is_converted_without_options(self):
        labels = image_of(inside, dtype=numpy.int16)
        source = write(vtkXMLImageDataWriter(), labels, self.folder / "labels.vti")
        self.succeed("convert", source, "-o", self.folder / "a.stl")
        self.assertAlmostEqual(volume(read_shape(self.folder / "a.stl")) / BALL, 1.0, delta=0.05)
        said = self.fail_with(1, "convert", source, "-o", self.folder / "b.stl", "--level", 2)
        self.assertIn("its values are from 0 to 1", said)
        self.assertFalse((self.folder / "b.stl").exists())

    def test_a_level_beyond_the_band_of_a_vdb_gives_no_empty_file(self):
        source = write(vtkActiveVDBWriter(), self.skin, self.folder / "skin.vdb")
        for level in (9, -9):
            said = self.fail_with(
                1, "convert", source, "-o", self.folder / "b.stl", "--level", level
            )
            self.assertIn(f"no surface at the level {level}", said)
        self.assertFalse((self.folder / "b.stl").exists())

    def test_a_frame_without_the_label_is_named(self):
        for name, label in (("one.vti", 1), ("two.vti", 2)):
            image = image_of(lambda *x, label=label: label * inside(*x), dtype=numpy.int16)
            write(vtkXMLImageDataWriter(), image, self.folder / name)
        files = [self.folder / name for name in ("one.vti", "two.vti")]
        said = self.fail_with(1, "convert", *files, "--label", 1, "-o", self.folder / "a.stl")
        self.assertIn("two.vti: The image has no label 1", said)

    def test_a_pipe_is_not_replaced(self):
        mesh = write(vtkXMLPolyDataWriter(), self.skin, self.folder / "skin.vtp")
        for name in ("pipe.ply", "pipe.vdb", "pipe.vtp"):
            os.mkfifo(self.folder / name)
            said = self.fail_with(1, "convert", mesh, "-o", self.folder / name)
            self.assertIn("a pipe or a device", said)
            self.assertTrue((self.folder / name).is_fifo())


if __name__ == "__main__":
    unittest.main()
