"""Helpers of the tests of readers."""

import numpy
from active_implicit_surfaces.data_objects import texts_of
from active_implicit_surfaces.particle_files import open_particles
from command_line import CommandTest
from vtkmodules.util.numpy_support import vtk_to_numpy


def points_of(cloud):
    count = cloud.GetNumberOfPoints()
    return vtk_to_numpy(cloud.GetPoints().GetData()).round(6).tolist() if count else []


def array_of(cloud, name):
    texts = texts_of(cloud.GetPointData(), name)
    found = vtk_to_numpy(cloud.GetPointData().GetArray(name)) if texts is None else texts
    return found.tolist()


class ReaderTest(CommandTest):
    def assert_points(self, cloud, wanted):
        numpy.testing.assert_allclose(points_of(cloud), wanted, rtol=1e-6)

    def assert_refused(self, words, path):
        with self.assertRaisesRegex(OSError, words) as caught:
            open_particles(path).load(0)
        self.assertIn(path.name, str(caught.exception))
        self.assertTrue(str(caught.exception).endswith("."))
