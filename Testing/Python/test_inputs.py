# ctest: LABELS contract
"""Meshes and images as target and initial shape of vtkActiveImplicitSurface.

Run: python3 test_inputs.py
"""

import unittest

import numpy
from active_implicit_surfaces import series, vtkActiveImplicitSurface
from active_implicit_surfaces.data_objects import as_particles
from listener import Listener
from same_bytes_shapes import Steps, ball, lines
from shapes import (
    ball_mesh,
    bytes_of,
    image_of,
    make_points,
    output_of,
    points_of,
    volume_of,
)
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
from vtkmodules.vtkFiltersHybrid import vtkForceTime
from vtkmodules.vtkImagingHybrid import vtkSampleFunction
from vtkmodules.vtkIOInfovis import vtkDelimitedTextReader


def growing_ball():
    """Mesh of a ball of radius 0.3 at time 0, 0.7 at the last of its 21 time steps, 2."""
    times = [0.1 * step for step in range(21)]
    return Steps({time: output_of(ball_mesh(0.3 + 0.2 * time)) for time in times})


class Inputs(unittest.TestCase):
    def setUp(self):
        self.mesh = ball_mesh()  # radius 0.5
        self.image = vtkSampleFunction()
        self.image.SetImplicitFunction(ball(0.5))
        self.image.SetModelBounds(-1, 1, -1, 1, -1, 1)
        self.surface = vtkActiveImplicitSurface()
        self.surface.SetVoxelSize(0.05)

    def assert_is_the_ball(self, time):
        self.surface.UpdateTimeStep(time)
        bounds = self.surface.GetOutput().GetBounds()
        for side, bound in enumerate(bounds):
            # Tolerance of TestTargets.cxx: 0.06 voxel.
            self.assertAlmostEqual(bound, 0.5 if side % 2 else -0.5, delta=0.003)

    def test_a_mesh_is_a_target(self):
        self.surface.SetInputConnection(self.mesh.GetOutputPort())
        self.assert_is_the_ball(0.0)
        self.assert_is_the_ball(1.0)

    def test_an_image_is_a_target(self):
        self.surface.SetInputConnection(self.image.GetOutputPort())
        self.assert_is_the_ball(0.0)
        self.assert_is_the_ball(1.0)

    def test_a_csv_of_paraview_is_particles(self):
        rows = [(0.1 * i, 0.1 * j, 0.0, 10 * i + j) for i in range(8) for j in range(8)]
        text = "\n".join(
            ["id,Points:0,Points:1,Points:2"] + [f"{n},{x},{y},{z}" for x, y, z, n in rows]
        )
        table = vtkDelimitedTextReader()
        table.SetReadFromInputString(True)
        table.SetInputString(text)
        table.SetHaveHeaders(True)
        cloud = as_particles([place for *place, _ in rows], ids=[number for *_, number in rows])
        self.surface.SetInputArrayToProcess(1, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "id")
        self.surface.SetInputData(cloud)
        self.surface.Update()
        expected = bytes_of(self.surface)
        self.surface.SetInputConnection(table.GetOutputPort())
        messages = Listener(self.surface)
        self.surface.Update()
        self.assertIn("DetectNumericColumns", messages.errors[0])
        table.DetectNumericColumnsOn()
        self.surface.Update()
        made = bytes_of(self.surface)
        self.assertTrue(expected)
        self.assertEqual(made, expected)
        self.assertEqual(len(messages.errors), 1)

    def test_a_mesh_is_an_initial_shape(self):
        self.surface.SetTargetFunction(ball(0.4))
        self.surface.SetInputConnection(1, self.mesh.GetOutputPort())
        self.assert_is_the_ball(0.0)

    def test_a_single_point_is_refused(self):
        corners = lines([(0.0, 0.0, 0.0)] * 3, (0, 1, 2))
        flat = make_points(points_of(corners))
        flat.SetPolys(corners.GetLines())
        for data in (flat, image_of(numpy.ones((1, 1, 1)))):
            surface = vtkActiveImplicitSurface()
            surface.SetInputData(data)
            messages = Listener(surface)
            surface.Update()
            self.assertIn("is a single point", "".join(messages.errors))

    def test_a_forced_time_is_a_static_target(self):
        source = growing_ball()
        forced = vtkForceTime()  # lists its time as often as the source has steps
        forced.SetInputConnection(source.GetOutputPort())
        forced.SetForcedTime(1.0)  # a radius of 0.5
        forced.IgnorePipelineTimeOn()
        self.surface.SetInputConnection(forced.GetOutputPort())
        self.surface.SetStartTime(7.0)
        messages = Listener(self.surface)
        self.assert_is_the_ball(7.0)
        self.assert_is_the_ball(7.5)
        self.assertEqual(messages.errors, [])
        self.surface.UpdateInformation()
        steps = self.surface.GetOutputInformation(0).Get(Pipeline.TIME_STEPS())
        self.assertEqual((len(steps), steps[0]), (11, 7.0))


class ParticlesWithoutIds(unittest.TestCase):
    def setUp(self):
        cube = numpy.stack(numpy.meshgrid(*[numpy.arange(8.0)] * 3), -1).reshape(-1, 3)
        self.cube = 0.1 * cube

    def follow(self, frames):
        source = series.ParticleSeries(frames, fps=1.0)
        surface = vtkActiveImplicitSurface()
        surface.SetInputConnection(source.GetOutputPort())
        surface.SetParticleSpacing(0.1)
        heard, volumes = Listener(surface), []
        for time in (0.0, 0.5, 1.5, 3.0):
            surface.UpdateTimeStep(time)
            volumes.append(volume_of(surface.GetOutput()))
        self.assertEqual(heard.errors, [])
        return volumes, heard.warnings

    def test_in_another_order_each_time_they_stay_where_they_are(self):
        still, quiet = self.follow([self.cube] * 4)
        chance = numpy.random.default_rng(1)
        volumes, warnings = self.follow([chance.permutation(self.cube) for _ in range(4)])
        self.assertEqual(quiet, [])
        self.assertEqual(len(warnings), 1)
        self.assertIn("no ids", warnings[0])
        for volume, expected in zip(volumes, still):
            self.assertAlmostEqual(volume, expected, delta=0.01 * expected)

    def test_what_moves_or_grows_keeps_its_indices(self):
        for frames in (
            [self.cube + [0.8 * step, 0.0, 0.0] for step in range(4)],
            [(1.0 + 0.3 * step) * self.cube for step in range(4)],
        ):
            self.assertEqual(self.follow(frames)[1], [])


if __name__ == "__main__":
    unittest.main()
