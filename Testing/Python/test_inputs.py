# ctest: LABELS contract
"""Meshes and images as target and initial shape of vtkActiveImplicitSurface.

Run: python3 test_inputs.py
"""

import unittest

import numpy
from active_implicit_surfaces import series, vtkActiveImplicitSurface
from listener import Listener
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonCore import vtkIntArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkPolyData, vtkSphere
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
from vtkmodules.vtkFiltersCore import vtkMassProperties
from vtkmodules.vtkFiltersHybrid import vtkForceTime
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkImagingHybrid import vtkSampleFunction
from vtkmodules.vtkIOInfovis import vtkDelimitedTextReader


def make_ball(radius):
    ball = vtkSphere()
    ball.SetRadius(radius)
    return ball


class GrowingBall(VTKPythonAlgorithmBase):
    """Mesh of a ball of radius 0.3 at time 0, 0.6 at the last of its 21 time steps, 2."""

    def __init__(self):
        super().__init__(nInputPorts=0, outputType="vtkPolyData")
        self.steps = [0.1 * step for step in range(21)]

    def RequestInformation(self, request, inputs, outputs):
        information = outputs.GetInformationObject(0)
        information.Set(Pipeline.TIME_STEPS(), self.steps, len(self.steps))
        information.Set(Pipeline.TIME_RANGE(), [self.steps[0], self.steps[-1]], 2)
        return 1

    def RequestData(self, request, inputs, outputs):
        time = outputs.GetInformationObject(0).Get(Pipeline.UPDATE_TIME_STEP())
        ball = vtkSphereSource()
        ball.SetThetaResolution(64)
        ball.SetPhiResolution(64)
        ball.SetRadius(0.3 + 0.15 * time)
        ball.Update()
        vtkPolyData.GetData(outputs).ShallowCopy(ball.GetOutput())
        return 1


class Inputs(unittest.TestCase):
    def setUp(self):
        self.mesh = vtkSphereSource()  # radius 0.5
        self.mesh.SetThetaResolution(64)
        self.mesh.SetPhiResolution(64)
        self.image = vtkSampleFunction()
        self.image.SetImplicitFunction(make_ball(0.5))
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
        table, cloud, points, ids = (
            vtkDelimitedTextReader(),
            vtkPolyData(),
            vtkPoints(),
            vtkIntArray(),
        )
        table.SetReadFromInputString(True)
        table.SetInputString(text)
        table.SetHaveHeaders(True)
        points.SetDataTypeToDouble()
        ids.SetName("id")
        for *place, number in rows:
            points.InsertNextPoint(place)
            ids.InsertNextValue(number)
        cloud.SetPoints(points)
        cloud.GetPointData().AddArray(ids)
        self.surface.SetInputArrayToProcess(1, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "id")
        self.surface.SetInputData(cloud)
        self.surface.Update()
        expected = vtk_to_numpy(self.surface.GetOutput().GetPoints().GetData()).tobytes()
        self.surface.SetInputConnection(table.GetOutputPort())
        messages = Listener(self.surface)
        self.surface.Update()
        self.assertIn("DetectNumericColumns", messages.errors[0])
        table.DetectNumericColumnsOn()
        self.surface.Update()
        made = vtk_to_numpy(self.surface.GetOutput().GetPoints().GetData()).tobytes()
        self.assertTrue(expected)
        self.assertEqual(made, expected)
        self.assertEqual(len(messages.errors), 1)

    def test_a_mesh_is_an_initial_shape(self):
        self.surface.SetTargetFunction(make_ball(0.4))
        self.surface.SetInputConnection(1, self.mesh.GetOutputPort())
        self.assert_is_the_ball(0.0)

    def test_a_forced_time_is_a_static_target(self):
        source = GrowingBall()
        forced = vtkForceTime()  # lists its time as often as the source has steps
        forced.SetInputConnection(source.GetOutputPort())
        forced.SetForcedTime(4.0 / 3.0)  # a radius of 0.5
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
    """A cube of particles at four time steps: halfway, and at the end."""

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
            mass = vtkMassProperties()
            mass.SetInputData(surface.GetOutput())
            volumes.append(mass.GetVolume())
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
