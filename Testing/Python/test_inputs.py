# ctest: LABELS contract
"""Meshes and images as the target and the start of vtkActiveImplicitSurface.

Run: python3 test_inputs.py
"""

import unittest

from active_implicit_surfaces import vtkActiveImplicitSurface
from vtkmodules.vtkCommonDataModel import vtkSphere
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkImagingHybrid import vtkSampleFunction


def make_ball(radius):
    ball = vtkSphere()
    ball.SetRadius(radius)
    return ball


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


if __name__ == "__main__":
    unittest.main()
