# ctest: LABELS exact
"""Meshes with holes have an inside, defined by winding numbers.

Run: python3 test_open_meshes.py
"""

import math
import unittest

import numpy
from active_implicit_surfaces import vtkActiveImplicitSurface, vtkGridPotential
from listener import Listener
from shapes import ball_mesh, output_of, points_of, volume_of
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkReverseSense
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkPlaneSource

VOXEL = 0.05


def without(mesh, is_left_out):
    polygons = vtkCellArray()
    for i in range(mesh.GetNumberOfCells()):
        if not is_left_out(i):
            polygons.InsertNextCell(mesh.GetCell(i))
    data = vtkPolyData()
    data.SetPoints(mesh.GetPoints())
    data.SetPolys(polygons)
    return data


def ball(start=0.0):
    source = ball_mesh(1.0)
    source.SetStartPhi(start)
    return output_of(source)


def box_without_a_face():
    source = vtkCubeSource()
    source.Update()
    return without(source.GetOutput(), lambda i: i == 2)


def scan():
    """A ball without 3 % of its triangles, chosen at random."""
    holes = numpy.random.default_rng(3).random(100000) < 0.03
    return without(ball(), lambda i: holes[i])


def turned(mesh):
    turn = vtkReverseSense()
    turn.SetInputData(mesh)
    turn.Update()
    return turn.GetOutput()


def skin_of(mesh, threads=0):
    surface = vtkActiveImplicitSurface()
    surface.SetNumberOfThreads(threads)
    surface.SetInputData(mesh)
    listener = Listener(surface)
    surface.Update()
    return surface.GetOutput(), listener.warnings


class OpenMeshes(unittest.TestCase):
    def test_the_inside_ends_at_the_rims(self):
        whole = 4 / 3 * math.pi
        for name, mesh, wanted in (
            ("ball without its cap", ball(20.0), whole),
            ("box without a face", box_without_a_face(), 1.0),
            ("scan of many holes", scan(), whole),
        ):
            for turn in (mesh, turned(mesh)):
                with self.subTest(name):
                    skin, _ = skin_of(turn)
                    self.assertAlmostEqual(volume_of(skin) / wanted, 1.0, delta=0.01)

    def test_away_from_holes_it_is_the_closed_mesh(self):
        """Tolerance of a thousandth of a voxel: another triangle may be found as the nearest one
        of a node."""
        potentials = []
        whole = ball()
        is_cap = [whole.GetCell(i).GetBounds()[4] > 0.9 for i in range(whole.GetNumberOfCells())]
        for mesh in (whole, without(whole, lambda i: is_cap[i])):
            grid = vtkGridPotential()
            grid.SetVoxelSize(VOXEL)
            grid.SetReach(0.3)
            grid.SetInput(mesh)
            listener = Listener(grid)
            grid.FunctionValue(0.0, 0.0, 0.0)
            self.assertEqual(len(listener.warnings), len(potentials), "of the open one")
            potentials.append(grid)
        random = numpy.random.default_rng(7)
        places = random.uniform(-1.2, 1.2, (2000, 3)) - (0, 0, 0.5)
        for place in places[places[:, 2] < 0.3]:
            closed, opened = (one.FunctionValue(*place) for one in potentials)
            self.assertAlmostEqual(opened, closed, delta=0.001 * VOXEL)

    def test_the_number_of_threads_does_not_matter(self):
        points = [points_of(skin_of(scan(), n)[0]) for n in (1, 2)]
        numpy.testing.assert_array_equal(*points)

    def test_a_sheet_has_no_inside(self):
        source = vtkPlaneSource()
        source.SetResolution(20, 20)
        source.Update()
        skin, said = skin_of(source.GetOutput())
        self.assertEqual(skin.GetNumberOfPoints(), 0)
        self.assertIn("80 open edges", " ".join(map(str, said)))


if __name__ == "__main__":
    unittest.main()
