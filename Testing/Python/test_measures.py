# ctest: LABELS contract
"""Measures of meshes, by info and by the history, compared with exact values.

Run: python3 test_measures.py
"""

import csv
import importlib.util
import io
import json
import sys
import unittest
from unittest import mock

import active_implicit_surfaces as active
import numpy
from active_implicit_surfaces.measures import measure
from active_implicit_surfaces.skin_files import write_mesh
from command_line import CommandTest, grid, moving_grid
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import (
    vtkAppendPolyData,
    vtkReverseSense,
    vtkStripper,
    vtkTriangleFilter,
)
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

    def test_strips_are_triangles(self):
        triangles, strips = vtkTriangleFilter(), vtkStripper()
        triangles.SetInputData(cube(2))
        strips.SetInputConnection(triangles.GetOutputPort())
        strips.Update()
        self.assertGreater(strips.GetOutput().GetNumberOfStrips(), 0)
        self.assertEqual(measure(strips.GetOutput()), measure(triangles.GetOutput()))

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

    def test_a_polygon_without_area_opens_nothing(self):
        mesh = cube()
        points, polygons = mesh.GetPoints(), mesh.GetPolys()
        copy = points.InsertNextPoint(points.GetPoint(0))
        polygons.InsertNextCell(3, [0, 1, copy])
        self.assertEqual(measure(mesh)["open edges"], 0)


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
        both = cube(1)
        labels = numpy_to_vtk(numpy.full(both.GetNumberOfPoints(), 3), deep=1)
        labels.SetName("label")
        both.GetPointData().AddArray(labels)
        write_mesh(self.folder / "l.vtp", both)
        command = ("info", "l.vtp", "--csv", "--label")
        rows = list(csv.DictReader(io.StringIO(self.succeed(*command, "all").out)))
        self.assertEqual([(row["label"], float(row["area"])) for row in rows], [("3", 6)])
        rows = list(csv.DictReader(io.StringIO(self.succeed(*command, "3,4").out)))
        self.assertEqual([(row["label"], float(row["area"])) for row in rows], [("3", 6), ("4", 0)])
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
        way = active.frames("p.npz", particle_spacing=0.1)
        for _ in way:
            pass
        held = active.history(way)
        for name in ("Time", "Volume", "Components"):
            self.assertEqual(held[name].tolist(), [float(row[name]) for row in rows])
        self.assertEqual(held["Event"].tolist(), [row["Event"] for row in rows])

    def test_plot_of_a_run(self):
        numpy.savez("p.npz", positions=moving_grid())
        common = ("skin", "p.npz", "--quiet", "--particle-spacing", 0.1, "-o", "s_#.ply")
        self.fail_with(2, *common, "--plot", "h.txt")
        with mock.patch.dict(sys.modules, {"matplotlib.figure": None}):
            said = self.fail_with(1, *common, "--plot", "h.svg")
        self.assertIn("Plots need matplotlib, which is not installed", said)
        self.assertEqual([*self.folder.glob("s_*")], [], "before the first frame is made")
        if importlib.util.find_spec("matplotlib") is None:
            self.skipTest("matplotlib is not installed")
        self.succeed(*common, "--plot", "h.svg", "--history", "h.csv")
        drawn = (self.folder / "h.svg").read_text()
        self.assertEqual(drawn.count('<g id="axes_'), 3)
        for name in ("Volume", "Area", "Components", "Time"):
            self.assertIn(f"<!-- {name} -->", drawn)
        self.succeed(*common, "--plot", "h.png")
        self.assertTrue((self.folder / "h.png").read_bytes().startswith(b"\x89PNG"))

    @unittest.skipUnless(importlib.util.find_spec("pandas"), "pandas is not installed")
    def test_history_as_a_table_of_pandas(self):
        import pandas

        live = active.LiveSurface(particle_spacing=0.1)
        for step in range(3):
            live.advance(grid() + 0.01 * step, 0.1)
        table = pandas.DataFrame(active.history(live)).set_index("Time")
        numpy.testing.assert_allclose(table.index, [0, 0.1, 0.2])
        self.assertAlmostEqual(table.Volume.mean(), 0.125, delta=0.02)


if __name__ == "__main__":
    unittest.main()
