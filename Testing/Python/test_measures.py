# ctest: LABELS contract
"""Measures of meshes, by info and by the history, against what is exact.

Run: python3 test_measures.py
"""

import csv
import io
import json
import unittest

import numpy
from active_implicit_surfaces.measures import measure
from active_implicit_surfaces.skin_files import write_mesh
from command_line import CommandTest, grid, moving_grid
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkReverseSense
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkPlaneSource


def cube(side=1.0, x=0.0, inward=False):
    source, turn = vtkCubeSource(), vtkReverseSense()
    source.SetXLength(side)
    source.SetYLength(side)
    source.SetZLength(side)
    source.SetCenter(x, 0, 1e6)
    turn.SetInputConnection(source.GetOutputPort())
    for filter in (source, turn):
        filter.Update()
    return (turn if inward else source).GetOutput()


def together(*meshes):
    append = vtkAppendPolyData()
    append.SetOutputPointsPrecision(1)
    for mesh in meshes:
        append.AddInputData(mesh)
    append.Update()
    return append.GetOutput()


class Measures(unittest.TestCase):
    def test_pieces_and_voids(self):
        found = measure(together(cube(4), cube(1, inward=True), cube(2, x=7)))
        self.assertAlmostEqual(found["area"], 6 * (16 + 1 + 4))
        self.assertAlmostEqual(found["volume"], 64 - 1 + 8)
        self.assertEqual((found["pieces"], found["voids"], found["open edges"]), (2, 1, 0))

    def test_what_is_open_inward_or_empty(self):
        plane = vtkPlaneSource()
        plane.SetResolution(3, 2)
        plane.Update()
        found = measure(plane.GetOutput())
        self.assertAlmostEqual(found["area"], 1.0)
        self.assertEqual(found["open edges"], 10)
        self.assertAlmostEqual(measure(cube(inward=True))["volume"], -1.0)
        self.assertEqual(set(measure(vtkPolyData()).values()), {0})

    def test_a_long_strip_is_one_piece(self):
        plane = vtkPlaneSource()
        plane.SetResolution(3000, 1)
        plane.SetPoint1(3000, 0, 0)
        plane.Update()
        mesh = plane.GetOutput()
        mesh.GetPoints().SetPoint(0, 0, 0, 1e-3)
        self.assertEqual(measure(mesh)["pieces"] + measure(mesh)["voids"], 1)


class Programs(CommandTest):
    def test_info_of_a_series(self):
        for step in range(3):
            write_mesh(self.folder / f"c_{step}.vtp", cube(1 + step))
        told = json.loads(self.succeed("info", "c_*.vtp", "--json").out)
        self.assertEqual([round(each["volume"], 6) for each in told["each"]], [1, 8, 27])
        self.assertEqual(told["closed"], "yes")
        rows = list(csv.DictReader(io.StringIO(self.succeed("info", "c_*.vtp", "--csv").out)))
        self.assertEqual([float(row["area"]) for row in rows], [6, 24, 54])
        self.assertEqual(rows[2]["open_edges"], "0")
        numpy.savetxt("p.csv", grid(), delimiter=",", header="x,y,z", comments="")
        self.assertIn(
            "meshes and images are read from", self.fail_with(1, "info", "p.csv", "--csv")
        )

    def test_history_of_a_run(self):
        numpy.savez("p.npz", positions=moving_grid())
        common = ("--quiet", "--particle-spacing", 0.1, "-o", "s_#.ply")
        self.succeed("skin", "p.npz", *common, "--history", "h.csv")
        rows = list(csv.DictReader(io.StringIO((self.folder / "h.csv").read_text())))
        self.assertEqual([float(row["Time"]) for row in rows], [0, 0.04, 0.08, 0.12])
        told = json.loads(self.succeed("info", "s_*.ply", "--json").out)
        for row, each in zip(rows, told["each"]):
            self.assertAlmostEqual(float(row["Volume"]), each["volume"], places=6)
            self.assertAlmostEqual(float(row["Area"]), each["area"], places=5)
            self.assertEqual(int(row["Components"]), each["pieces"])


if __name__ == "__main__":
    unittest.main()
