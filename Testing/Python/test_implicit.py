# ctest: LABELS exact
"""The implicit integration over the particles of sph_drop.vtp: near the explicit skin, and the same
bytes for any threads, order of requests and restart.

Run: python3 test_implicit.py
"""

import tempfile
import unittest
from pathlib import Path

import numpy
from active_implicit_surfaces import vtkActiveImplicitSurface
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkImplicitPolyDataDistance
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

DATA = Path(__file__).resolve().parents[1] / "Data" / "sph_drop.vtp"
SPACING = 0.1  # twice the radius of a particle
VOXEL = 0.05
LAST = 4


def make_surface(**properties):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(DATA))
    surface = vtkActiveImplicitSurface()
    surface.SetInputConnection(reader.GetOutputPort())
    surface.SetParticleSpacing(SPACING)
    surface.SetVoxelSize(VOXEL)
    surface.SetInputArrayToProcess(1, 0, 0, 0, "id")
    surface.SetTimeIntegrationToImplicit()
    for name, value in properties.items():
        getattr(surface, f"Set{name}")(value)
    return surface


def points_of(surface):
    return vtk_to_numpy(surface.GetOutput().GetPoints().GetData())


def run(steps, **properties):
    surface = make_surface(**properties)
    for step in steps:
        surface.UpdateTimeStep(step)
    return surface


def history(surface, name):
    surface.Update()
    column = surface.GetOutputDataObject(2).GetColumnByName(name)
    return vtk_to_numpy(column)


TENSE = {"Tension": 6 * 0.05**2, "Attraction": 6.5}


class Implicit(unittest.TestCase):
    def assert_same(self, one, other):
        self.assertGreater(len(points_of(one)), 1000)
        self.assertTrue(numpy.array_equal(points_of(one), points_of(other)))

    def test_it_is_near_the_explicit_skin_in_fewer_substeps(self):
        """Both follow the same particles, attracted by e^-6 a step: .03 voxel on average, and the
        same parts."""
        for properties in ({}, TENSE):
            with self.subTest(**properties):
                implicit = run(range(LAST + 1), **properties)
                explicit = run(range(LAST + 1), TimeIntegration=0, **properties)
                distance = vtkImplicitPolyDataDistance()
                distance.SetInput(explicit.GetOutput())
                away = [abs(distance.EvaluateFunction(x)) for x in points_of(implicit)[::7]]
                self.assertLess(numpy.mean(away), 0.03 * VOXEL)
                for name in ("Components",):
                    self.assertEqual(list(history(implicit, name)), list(history(explicit, name)))
                self.assertLess(
                    3 * history(implicit, "Substeps").sum(), history(explicit, "Substeps").sum()
                )

    def test_threads_leave_no_trace(self):
        for properties in ({}, TENSE):
            self.assert_same(
                run([LAST], NumberOfThreads=1, **properties),
                run([LAST], NumberOfThreads=2, **properties),
            )

    def test_order_of_requests_leaves_no_trace(self):
        """Between the steps, and back."""
        for properties in ({}, TENSE):
            straight = run([LAST], **properties)
            self.assert_same(straight, run([2, 2.4, 3, 1, 3.7, LAST], **properties))

    def test_a_restart_leaves_no_trace(self):
        for properties in ({}, TENSE):
            with tempfile.TemporaryDirectory() as folder:
                file = str(Path(folder) / "state.vdb")
                self.assertTrue(run([3], **properties).SaveState(file))
                second = make_surface(**properties)
                second.LoadState(file)
                second.UpdateTimeStep(LAST)
                self.assert_same(run([LAST], **properties), second)


if __name__ == "__main__":
    unittest.main()
