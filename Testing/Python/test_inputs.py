# ctest: LABELS contract
"""Meshes and images as the target and the start of vtkActiveImplicitSurface.

Run: python3 test_inputs.py
"""

import unittest

from active_implicit_surfaces import vtkActiveImplicitSurface
from listener import Listener
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkSphere
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
from vtkmodules.vtkFiltersHybrid import vtkForceTime
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkImagingHybrid import vtkSampleFunction


def make_ball(radius):
    ball = vtkSphere()
    ball.SetRadius(radius)
    return ball


class GrowingBall(VTKPythonAlgorithmBase):
    """A mesh of a ball of radius .3 at time 0, .6 at the last of its 21 time steps, 2."""

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
        self.mesh = vtkSphereSource()  # of radius .5
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
            # As in TestTargets.cxx: .06 voxels.
            self.assertAlmostEqual(bound, 0.5 if side % 2 else -0.5, delta=0.003)

    def test_a_mesh_is_a_target(self):
        self.surface.SetInputConnection(self.mesh.GetOutputPort())
        self.assert_is_the_ball(0.0)
        self.assert_is_the_ball(1.0)

    def test_an_image_is_a_target(self):
        self.surface.SetInputConnection(self.image.GetOutputPort())
        self.assert_is_the_ball(0.0)
        self.assert_is_the_ball(1.0)

    def test_a_mesh_is_an_initial_shape(self):
        self.surface.SetTargetFunction(make_ball(0.4))
        self.surface.SetInputConnection(1, self.mesh.GetOutputPort())
        self.assert_is_the_ball(0.0)

    def test_a_forced_time_is_a_static_target(self):
        source = GrowingBall()
        forced = vtkForceTime()  # lists its time as often as the source has steps
        forced.SetInputConnection(source.GetOutputPort())
        forced.SetForcedTime(4.0 / 3.0)  # a radius of .5
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


if __name__ == "__main__":
    unittest.main()
