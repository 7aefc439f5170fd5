# ctest: LABELS exact
"""Data far from the world's origin: the skin is that of the same data near it, translated.

The distance is a multiple of 2^16 voxels, like the lattice's origin. Positions on the lattice are
then the same up to the rounding of the input, 1e-7 voxels.

Run: python3 test_map_coordinates.py
"""

import tempfile
import unittest
from pathlib import Path

import numpy
from active_implicit_surfaces import (
    vtkActiveImplicitSurface,
    vtkActiveVDBReader,
    vtkActiveVDBWriter,
    vtkGridPotential,
)
from same_bytes_shapes import Steps, ball
from shapes import ball_mesh, image_of, make_points, output_of, points_of
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

VOXEL = 0.05
MAP = numpy.array([157.0, 16500.0, 0.0]) * 2**16 * VOXEL  # 1.1e9 voxels north
NEAR, FAR = numpy.zeros(3), MAP
EXACT = 1e-4 * VOXEL  # floats near the origin: 0.6e-6 of 64 voxels; the rest is a margin for sums


def particles(origin, time=0.0):
    places = numpy.random.default_rng(5).uniform(-0.02, 0.02, (343, 3))
    places += numpy.stack(numpy.meshgrid(*[numpy.arange(7) * 0.11 - 0.3] * 3), -1).reshape(-1, 3)
    data = make_points(places + origin + (0.04 * time, 0.0, 0.02 * time))
    heat = numpy_to_vtk(places[:, 0].copy(), deep=True)
    heat.SetName("heat")
    data.GetPointData().AddArray(heat)
    return data


def mesh(origin, radius=0.5):
    data = vtkPolyData()
    data.DeepCopy(output_of(ball_mesh(radius, 24)))
    data.SetPoints(make_points(points_of(data) + origin).GetPoints())
    return data


def image(origin):
    places = numpy.indices((33, 33, 33)) * VOXEL - 16 * VOXEL + 0.003
    data = image_of(numpy.sqrt((places**2).sum(0)) - 0.5, 3 * [VOXEL])
    data.SetOrigin(*(origin - 16 * VOXEL + 0.003))
    return data


def skeleton(origin):
    data = make_points(numpy.array([[-0.3, 0, 0.1], [0.2, 0.1, 0], [0.3, -0.3, 0.2]]) + origin)
    lines = vtkCellArray()
    lines.InsertNextCell(3, (0, 1, 2))
    data.SetLines(lines)
    return data


def surface_over(data, **properties):
    surface = vtkActiveImplicitSurface()
    surface.SetVoxelSize(VOXEL)
    if data is not None:
        surface.SetInputDataObject(0, data)
    for name, value in properties.items():
        getattr(surface, "Set" + name)(*value if isinstance(value, tuple) else (value,))
    return surface


def moving(origin):
    """Particles of four time steps."""
    frames = [particles(origin, step) for step in range(4)]
    source = Steps(dict(enumerate(frames)))
    surface = surface_over(
        None,
        ParticleSpacing=0.11,
        ComputeVelocity=True,
        TangentialVelocity=True,
        PassTargetArrays=True,
        CheckpointInterval=1,
    )
    surface.SetInputConnection(source.GetOutputPort())
    return surface, source


class MapCoordinates(unittest.TestCase):
    def check(self, make, time=0.0, has_rims=False):
        """make(origin) returns a surface, or a surface and the data that it needs. With has_rims,
        arrays are not compared, since a skin has no normal at a rim."""
        skins = []
        for origin in (NEAR, FAR):
            made = make(origin)
            surface = made[0] if isinstance(made, tuple) else made
            surface.UpdateTimeStep(time)
            skin = vtkPolyData()
            skin.DeepCopy(surface.GetOutput())
            skins.append(skin)
        self.compare(*skins, arrays=not has_rims)
        return skins

    def compare(self, near, far, arrays):
        self.assertGreater(near.GetNumberOfPoints(), 300)
        self.assertEqual(points_of(far).dtype, numpy.float64)
        self.assertEqual(points_of(near).dtype, numpy.float32)
        numpy.testing.assert_allclose(points_of(far) - FAR, points_of(near), rtol=0, atol=EXACT)
        for i in range(near.GetPointData().GetNumberOfArrays() if arrays else 0):
            name = near.GetPointData().GetArrayName(i)
            here, there = (vtk_to_numpy(one.GetPointData().GetArray(name)) for one in (near, far))
            numpy.testing.assert_allclose(there, here, rtol=1e-3, atol=1e-3, err_msg=name)

    def test_particles_with_arrays_and_velocity(self):
        near, _ = self.check(moving, 2.0)
        self.assertTrue(near.GetPointData().HasArray("heat"))
        self.check(moving, 2.5)

    def test_meshes_as_start_and_target(self):
        def make(origin):
            surface = surface_over(mesh(origin))
            surface.SetInputDataObject(1, mesh(origin, 0.7))
            surface.SetTimeStepSize(0.5)
            surface.SetNumberOfTimeSteps(3)
            return surface

        self.check(make, 1.0)

    def test_images_skeletons_and_functions(self):
        bounds = [value for low in NEAR for value in (low - 0.8, low + 0.8)]

        def function(origin):
            box = tuple(numpy.array(bounds) + numpy.repeat(origin, 2))
            target = ball(0.49, origin + (0.013, 0.007, 0.003))  # on no node
            obstacle = ball(0.3, origin + (0.41, 0.03, 0.01))
            return (
                surface_over(
                    None, TargetFunction=target, ObstacleFunction=obstacle, ModelBounds=box
                ),
                target,
                obstacle,
            )

        for make in (image, skeleton):
            with self.subTest(make.__name__):
                self.check(lambda origin, make=make: surface_over(make(origin), KernelRadius=0.7))
        self.check(function, has_rims=True)

    def test_the_parts_of_a_function(self):
        def make(origin):
            grid = vtkGridPotential()
            grid.SetInput(image(origin))
            start = ball(0.3, origin + (0.0, 0.0, 3.0))  # away from the target
            box = tuple(numpy.array([-1, 1, -1, 1, -1, 4]) + numpy.repeat(origin, 2))
            surface = surface_over(
                None, TargetFunction=grid, InitialFunction=start, ModelBounds=box, CreateParts=True
            )
            surface.SetTimeStepSize(1.0)
            surface.SetNumberOfTimeSteps(2)
            return surface, grid, start

        self.check(make, 1.0)

    def test_the_image_and_the_function_of_a_skin(self):
        for origin in (NEAR, FAR):
            surface = surface_over(mesh(origin))
            surface.SetOutputPotential(True)
            surface.Update()
            potential = surface.GetPotential()
            centre = potential.FindPoint(*origin)
            self.assertLess(potential.GetPointData().GetScalars().GetValue(centre), 0.0)
            numpy.testing.assert_allclose(potential.GetOrigin(), origin, atol=1e-6)
            skin = surface.GetSkinFunction()
            self.assertAlmostEqual(skin.FunctionValue(*(origin + (0.45, 0, 0))), -0.05, delta=0.01)

    def test_states_and_going_back(self):
        with tempfile.TemporaryDirectory() as folder:
            file = str(Path(folder) / "state.vdb")
            surface, source = moving(FAR)
            surface.UpdateTimeStep(2.0)
            self.assertTrue(surface.SaveState(file))
            surface.UpdateTimeStep(3.0)
            last = points_of(surface.GetOutput()).copy()
            surface.UpdateTimeStep(1.0)
            surface.UpdateTimeStep(3.0)
            numpy.testing.assert_array_equal(points_of(surface.GetOutput()), last)
            other, others = moving(FAR)
            self.assertTrue(other.LoadState(file))
            other.UpdateTimeStep(3.0)
            numpy.testing.assert_array_equal(points_of(other.GetOutput()), last)
        self.assertTrue(source and others)

    def test_files(self):
        surface = surface_over(mesh(FAR))
        surface.Update()
        with tempfile.TemporaryDirectory() as folder:
            for name, data in (("skin", surface.GetOutput()), ("mesh", mesh(FAR))):
                with self.subTest(name):
                    writer = vtkActiveVDBWriter()
                    writer.SetFileName(str(Path(folder) / f"{name}.vdb"))
                    writer.SetInputDataObject(data)
                    self.assertTrue(writer.Write())
                    reader = vtkActiveVDBReader()
                    reader.SetFileName(str(Path(folder) / f"{name}.vdb"))
                    again = surface_over(None)
                    again.SetInputConnection(reader.GetOutputPort())
                    again.Update()
                    bounds = numpy.array(again.GetOutput().GetBounds()) - numpy.repeat(FAR, 2)
                    numpy.testing.assert_allclose(bounds, [-0.5, 0.5] * 3, atol=0.01)


if __name__ == "__main__":
    unittest.main()
