# ctest: DISPLAY LABELS contract
"""Pictures .exr of the program for compositing: A is the skin's, the ground is a separate layer."""

import unittest

import numpy
from active_implicit_surfaces import render, scene, skin_files, vtkActiveEXRReader
from command_line import CommandTest, grid
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersSources import vtkCubeSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow

SMALL = ("--size", "160x90", "--particle-spacing", 0.1, "--quiet")
HALF = 2.0**-11  # relative accuracy of 16 bits


def read_exr(path):
    """Layers, and the attribute framesPerSecond."""
    reader = vtkActiveEXRReader()
    reader.SetFileName(str(path))
    reader.Update()
    data, rate = reader.GetOutput().GetPointData(), reader.GetOutput().GetFieldData()
    names = map(data.GetArrayName, range(data.GetNumberOfArrays()))
    layers = {name: vtk_to_numpy(data.GetArray(name)) for name in names}
    rates = rate.GetArray("framesPerSecond")
    return layers, None if rates is None else rates.GetTuple(0)


class Composites(CommandTest):
    def setUp(self):
        super().setUp()
        self.moved = [grid() + [0.02 * step, 0, 0] for step in range(3)]
        numpy.savez("p.npz", positions=self.moved)

    def render(self, *more, data="p.npz"):
        self.succeed("skin", data, "--render", "f_#.exr", *SMALL, *more)
        return read_exr("f_1.exr")

    def test_alpha_is_the_skin_and_the_ground_is_apart(self):
        layers, _ = self.render()
        alpha = layers["RGBA"][:, 3]
        self.assertEqual((alpha.min(), alpha.max()), (0, 1))
        inside = alpha == 1
        self.assertGreater(inside.sum(), 1000)
        numpy.testing.assert_array_equal(layers["id"][inside], 1)
        nothing = alpha == 0
        for name in ("RGBA", "P", "N", "forward", "id"):
            self.assertFalse(layers[name][nothing].any(), name)
        numpy.testing.assert_array_equal(layers["Z"][nothing], numpy.float32(render.FAR))
        self.assertEqual(layers["ground"][:, 3].min(), 1, "behind the skin too")
        self.assertTrue((layers["ground.Z"] > layers["Z"])[inside].all(), "below the skin")

    def test_skin_over_ground_is_the_picture(self):
        layers, _ = self.render()
        skin, ground = layers["RGBA"], layers["ground"]
        over = skin[:, :3] + (1 - skin[:, 3:]) * ground[:, :3]
        light = ((numpy.array(scene.PAPER) + 0.055) / 1.055) ** 2.4  # sRGB to linear
        beside = over[skin[:, 3] == 0]
        # The window has 8 bits: half a step of 255, times the slope of sRGB, at most 2.3.
        numpy.testing.assert_allclose(beside, numpy.tile(light, (len(beside), 1)), atol=1.2 / 255)
        rim = (skin[:, 3] > 0) & (skin[:, 3] < 1)
        self.assertGreater(rim.sum(), 50)
        own = skin[rim, 2] / skin[rim, 3]
        inside = skin[skin[:, 3] == 1, 2]
        self.assertGreater(own.min(), 0.8 * inside.min(), "no dark rim")
        self.assertLess(own.max(), 1.2 * inside.max(), "no bright rim")

    def test_without_ground(self):
        with_ground, _ = self.render()
        layers, _ = self.render("--no-ground")
        self.assertEqual(set(with_ground) - set(layers), {"ground", "ground.Z"})
        for name, numbers in layers.items():
            numpy.testing.assert_array_equal(numbers, with_ground[name], name)
        self.succeed("skin", "p.npz", "--render", "a_#.png", "--no-ground", *SMALL)
        self.succeed("skin", "p.npz", "--render", "b_#.png", *SMALL)
        first, second = ((self.folder / f"{name}_1.png").read_bytes() for name in "ab")
        self.assertNotEqual(first, second, "the shade of the skin is on the ground")

    def test_the_rate_is_an_attribute_and_motion_is_until_the_next_frame(self):
        moved = {}
        for more, rate in (
            (("--fps", 24), 24),
            (("--fps", 29.97), 29.97),
            (("--times", "0,1,2"), 1),
            (("--times", "0,1,2", "--fps", 24), 24),
            (("--times", "0,0.5,2"), 1),
        ):
            layers, found = self.render(*more)
            self.assertAlmostEqual(found[0] / (found[1] if len(found) > 1 else 1), rate, places=2)
            moved[more] = numpy.median(layers["forward"][layers["RGBA"][:, 3] == 1], axis=0)[0]
        even = moved["--times", "0,1,2"]
        self.assertGreater(even, 0.5)
        self.assertAlmostEqual(moved["--times", "0,1,2", "--fps", 24], even, delta=2 * HALF * even)

    def test_a_frame_without_particles_is_empty(self):
        for step, points in enumerate((self.moved[0], numpy.zeros((0, 3)), self.moved[1])):
            numpy.save(f"q{step}.npy", points)
        layers, _ = self.render(data="q#.npy")
        self.assertFalse(layers["RGBA"].any())
        self.assertTrue(layers["ground"].any())

    def test_a_morph(self):
        cube = vtkCubeSource()
        cube.Update()
        cube.GetOutput().GetPointData().Initialize()
        skin_files.write_mesh(self.folder / "cube.stl", cube.GetOutput())
        command = ["morph", "cube.stl", "cube.stl", "--render", "m_#.exr", "--size", "160x90"]
        self.succeed(*command, "--frames", 2, "--duration", 0.1)
        layers, rate = read_exr("m_1.exr")
        self.assertEqual(rate[0], 10)
        self.assertIn("ground", layers)
        self.succeed(*command, "--frames", 2, "--no-ground")
        self.assertNotIn("ground", read_exr("m_1.exr")[0])

    def test_capture_leaves_the_scene_as_it_was(self):
        cube, mapper, other = vtkCubeSource(), vtkPolyDataMapper(), vtkActor()
        cube.Update()
        studio = scene.Scene(grid() * 5, (64, 48), soft=False)
        studio.show(cube.GetOutput())
        mapper.SetInputConnection(cube.GetOutputPort())
        other.SetMapper(mapper)
        other.VisibilityOff()
        studio.renderer.AddActor(other)
        before = studio.picture().GetPointData().GetScalars()
        render.capture(studio.window, apart={**studio.apart, "other": other})
        after = studio.picture().GetPointData().GetScalars()
        numpy.testing.assert_array_equal(vtk_to_numpy(before), vtk_to_numpy(after))
        self.assertFalse(other.GetVisibility())
        self.assertEqual(studio.renderer.GetBackground(), scene.PAPER)

    def test_a_window_that_has_not_been_drawn_has_its_size_and_camera(self):
        cube, mapper, actor = vtkCubeSource(), vtkPolyDataMapper(), vtkActor()
        mapper.SetInputConnection(cube.GetOutputPort())
        actor.SetMapper(mapper)
        renderer, window = vtkRenderer(), vtkRenderWindow()
        renderer.AddActor(actor)
        window.AddRenderer(renderer)
        window.OffScreenRenderingOn()
        image = render.capture(window)
        self.assertEqual(image.GetDimensions(), (*window.GetSize(), 1))
        motion = vtk_to_numpy(image.GetPointData().GetArray("forward"))
        self.assertLess(numpy.abs(motion).max(), 1e-3, "nothing moves")


if __name__ == "__main__":
    unittest.main()
