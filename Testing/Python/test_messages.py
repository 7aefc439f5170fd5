# ctest: LABELS contract
"""Messages of the Python package: they name the input and the cause, and no error is raw."""

import types
import unittest
import warnings
from unittest import mock

import active_implicit_surfaces as active
import numpy
from active_implicit_surfaces.data_objects import add_array, as_particles, points_of
from command_line import CommandTest, grid
from shapes import ball_mesh, image_of, output_of
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

GRO = "run t= 1e\n    1\n    1ALA     CA    1   0.126   1.624   1.679\n1.82060 1.82060 1.82060\n"

DISTANCE = numpy.linalg.norm(numpy.indices((9, 9, 9)) - 4.0, axis=0) - 2.5


def ball():
    return output_of(ball_mesh(0.6))


def boxed(edges, **field):
    cloud = as_particles(grid())
    for name, values in {"Lattice": edges, **field}.items():
        add_array(cloud, name, values, cloud.GetFieldData())
    return cloud


class Keywords(unittest.TestCase):
    def assert_fails(self, kind, words, make, *data, **options):
        with self.subTest(words), self.assertRaisesRegex(kind, words):
            make(*data, **options)

    def test_numbers(self):
        for value in (10**30, 2**40, float("inf")):
            words = "number_of_threads = .* is out of its range: 0 to 1024"
            self.assert_fails(ValueError, words, active.skin, grid(), number_of_threads=value)
        self.assert_fails(
            ValueError, "voxel_size = 1.* is out", active.skin, grid(), voxel_size=10**400
        )
        radii = numpy.ones(125)
        words = "probe has to be a number, not '1'"
        self.assert_fails(TypeError, words, active.skin, grid(), radii=radii, probe="1")
        self.assert_fails(TypeError, "fps has to be a number", active.frames, [grid()], fps="a")
        self.assert_fails(TypeError, "dt has to be", active.LiveSurface().advance, grid(), "a")
        self.assert_fails(TypeError, "start has to be a number", active.LiveSurface, start="a")
        self.assert_fails(ValueError, "start .* finite", active.LiveSurface, start=float("nan"))

    def test_times(self):
        for value in (3, "a", [None]):
            words = "times has to be a sequence of numbers"
            self.assert_fails(TypeError, words, active.frames, [grid()], times=value)
        words = "number of times is 2, but that of frames is 1;"
        self.assert_fails(ValueError, words, active.frames, [grid()], times=[0, 1])

    def test_morphs(self):
        for value in (1, 2.5, "3", None, float("nan"), float("inf")):
            words = "frames has to be a whole number of 2 or more"
            self.assert_fails(ValueError, words, active.morph, ball(), ball(), frames=value)
        self.assertEqual(len(active.morph(ball(), ball(), frames=3.0)), 3)
        self.assert_fails(TypeError, "duration has to be a", active.morph, ball(), ball(), "2")
        self.assert_fails(TypeError, "The first shape: A str", active.morph, "a.vtp", ball())
        for faces in ([[0, 1, 2], [1, 2, 3, 4]], "abc"):
            mesh = types.SimpleNamespace(vertices=grid(), faces=faces)
            self.assert_fails(ValueError, "last shape: Faces have", active.morph, ball(), mesh)

    def test_series(self):
        for value in (3, None, ball()):
            words = f"type {type(value).__name__} is no series of particles; give a list"
            self.assert_fails(TypeError, words, active.frames, value)
        self.assert_fails(TypeError, "A NoneType is no set of particles", active.skin, None)
        way = active.frames([image_of(DISTANCE), grid()])
        next(way)
        self.assert_fails(TypeError, "of type ndarray, but the first frame is an image", next, way)

    def test_arrays(self):
        values = {"radii": numpy.ones(125)}
        for more in ({}, {"probe": 1.0}):
            words = "In `arrays`, `radii` is an object of type ndarray"
            self.assert_fails(TypeError, words, active.frames, [grid()], arrays=values, **more)
        cloud = as_particles(grid(), v=numpy.ones((125, 3)))
        chosen = {"arrays": {"radii": "v"}, "probe": 1.0}
        words = "'v' has 3 components, but radii need one number"
        with self.subTest(words), self.assertRaisesRegex(ValueError, words):
            active.frames([cloud], **chosen)

    def test_a_kernel_radius_without_effect_is_not_judged(self):
        radii = numpy.full(125, 0.06)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            one, other = (
                active.skin(grid(), kernel_radius=radius, radii=radii) for radius in (0.06, 0.13)
            )
        numpy.testing.assert_array_equal(points_of(one), points_of(other))
        with self.assertWarnsRegex(active.ActiveSurfaceWarning, "so kernels reach few neighbours"):
            active.skin(grid(), kernel_radius=0.06)

    def test_boxes(self):
        edges = 5 * numpy.eye(3)
        for frames, words in (
            ([boxed(edges), boxed(edges, Origin=numpy.ones((1, 3)))], r"to \[1, 6\] x"),
            ([boxed(edges[:1])], "Lattice of the box has 3 numbers, not 9"),
            ([boxed(edges, pbc=numpy.ones((1, 2)))], "pbc of the box has 2 numbers, not 3"),
        ):
            self.assert_fails(ValueError, words, active.frames, frames, periodic=True)

    def test_histories(self):
        self.assert_fails(TypeError, "type int has no history", active.history, 3)
        way = active.frames([grid()], particle_spacing=0.1)
        next(way)
        axes = mock.MagicMock()
        self.assertEqual(active.plot_history(way, "Volume", axes=[axes]), [axes])


class Files(CommandTest):
    def image(self, name, value):
        writer = vtkXMLImageDataWriter()
        writer.SetFileName(str(self.folder / name))
        writer.SetInputData(image_of(numpy.array(numpy.broadcast_to(value, (9, 9, 9)), "f4")))
        writer.Write()

    def test_damage_has_its_place(self):
        for name, text, words in (
            ("a.json", '{"x": [1, 2], "y": [2], "z": [1]}', "x, y and z differ in shape"),
            ("b.json", '{"positions": [[[1, 2, 3]]], "times": ["a"]}', "times.* not numbers"),
            ("c.json", '{"positions": [[[1, 2, 3]]], "fps": "a"}', "is a, not a finite number"),
        ):
            with self.subTest(name):
                said = self.fail_with(1, "info", self.put(name, text))
                self.assertRegex(said, f"{name} cannot be read as particles: .*{words}")
        for counts in ([4.5], [5, -1]):
            numpy.savez(self.folder / "a.npz", positions=numpy.zeros((4, 3)), counts=counts)
            self.assertIn("whole numbers of 0 or more", self.fail_with(1, "info", "a.npz"))
        self.put("b.gro", GRO)
        self.succeed("info", "b.gro")  # no time

    def test_headers_of_images(self):
        head = "NRRD0004\ntype: {}\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n{}\n12345678"
        for kind, origin, words in (
            ("uchar", "space origin: (1,2)\n", "its space origin has 2 number(s), not 3"),
            ("foo", "", "its header is invalid"),
        ):
            said = self.fail_with(1, "info", self.put("a.nrrd", head.format(kind, origin)))
            self.assertIn(f"a.nrrd cannot be read: {words}", said)

    def test_the_file_is_named(self):
        for step in range(2):
            numpy.savez(self.folder / f"p_{step}.npz", positions=grid(), **{f"T{step}": range(125)})
        said = self.fail_with(1, "convert", "p_#.npz", "-o", "a.vtp", "--where", "T0=3")
        self.assertIn("p_1.npz: There is no array 'T0'", said)
        still = numpy.stack([grid(), grid()])
        numpy.savez(self.folder / "a.npz", positions=still, times=[1, 0])
        self.assertIn(
            "a.npz: Times have to be finite, and have to increase",
            self.fail_with(1, "info", "a.npz"),
        )
        self.succeed("skin", "a.npz", "--fps", 2, "-o", "s_#.vtp")
        self.image("a.vti", DISTANCE)
        for files, words in (
            (["p_0.npz", "a.vti"], "a.vti is an image, unlike p_0.npz"),
            (["a.vti", "p_0.npz"], "p_0.npz is no image, unlike a.vti"),
        ):
            self.assertIn(words, self.fail_with(1, "skin", *files))

    def test_an_image_without_a_surface(self):
        for value, words in (
            (3, "all its values are 3"),
            (numpy.where(DISTANCE < 0, 3, numpy.nan), "all its finite values are 3"),
            (numpy.nan, "none of its values"),
        ):
            self.image("a.vti", value)
            said = self.fail_with(1, "convert", "a.vti", "-o", "a.stl")
            self.assertIn(f"a.vti has no surface: {words}", said)

    def test_runs_that_cannot_go_on(self):
        for step in range(2):
            numpy.save(self.folder / f"p_{step}.npy", grid())
        self.put("p_2.npy", "damage")
        command = ["skin", "p_#.npy", "-o", "s_#.vtp", "--particle-spacing", 0.1]
        self.fail_with(1, *command, "--frames", "0:2")
        self.assertIn("with frames 0:2:1, but", self.fail_with(1, *command, "--resume"))
        self.put(".s.state.vdb", "damage")
        said = self.fail_with(1, *command, "--resume", "--frames", "0:2")
        self.assertRegex(said, r"\.s\.state\.vdb.*; run without --resume to make all")
        self.assertNotIn("SaveState", said)

    def test_one_lost_array_is_singular(self):
        for more, words in (({}, "this is left out"), ({"id": range(125)}, "these are left out")):
            numpy.savez(self.folder / "a.npz", positions=grid(), T=numpy.ones(125), **more)
            self.assertIn(words, self.succeed("convert", "a.npz", "-o", "a.xyz").err)

    def test_values_that_begin_with_a_minus(self):
        numpy.savez(self.folder / "a.npz", positions=numpy.stack([grid(), grid()]))
        said = self.fail_with(2, "skin", "a.npz", "--up", "-y", "--render", "a.png")
        self.assertIn("write OPTION=VALUE", said)


if __name__ == "__main__":
    unittest.main()
