# ctest: LABELS contract
"""Series of files: indices with parts and restarts, names, folders, blocks, frames without points.

Run: python3 test_series_files.py
"""

import json
import os
import unittest
import warnings

import numpy
from active_implicit_surfaces import file_names
from active_implicit_surfaces.data_objects import as_particles
from active_implicit_surfaces.particle_files import open_particles
from active_implicit_surfaces.skin_files import read_shape, write_mesh, write_particles
from command_line import Outcome, grid
from reader_checks import ReaderTest, array_of, points_of
from shapes import write as write_data
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet, vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkFiltersSources import vtkCubeSource
from vtkmodules.vtkIOLegacy import vtkPolyDataWriter
from vtkmodules.vtkIOXML import (
    vtkXMLMultiBlockDataWriter,
    vtkXMLPolyDataWriter,
    vtkXMLUnstructuredGridWriter,
)

POINT = "x,y,z\n0,0,0\n"


def count_in(path):
    return open_particles(path).load(0).GetNumberOfPoints()


def cubes(count=2):
    for i in range(count):
        cube = vtkCubeSource()
        cube.SetCenter(3 * i, 0, 0)
        cube.Update()
        yield cube.GetOutput()


class Indices(ReaderTest):
    def setUp(self):
        super().setUp()
        for i in range(6):
            self.put(f"{i}.csv", f"x,y,z,n\n{i},0,0,{i}\n")

    def put_index(self, *entries):
        rows = "".join(f"<DataSet {entry}/>" for entry in entries)
        return self.put("a.pvd", f"<VTKFile><Collection>{rows}</Collection></VTKFile>")

    def xs(self, path):
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            series = open_particles(path)
        found = [sorted(x for x, _, _ in points_of(series.load(i))) for i in range(len(series))]
        return found, series.times, [str(one.message) for one in said]

    def test_parts_are_one_frame(self):
        index = self.put_index(
            'timestep="0" part="0" file="0.csv"',
            'timestep="0" part="1" file="1.csv"',
            'timestep="1" part="0" file="2.csv"',
            'timestep="1" part="1" file="3.csv"',
            'timestep="2" group="a" part="0" file="4.csv"',
            'timestep="2" group="b" part="0" file="5.csv"',
        )
        self.assertEqual(self.xs(index), ([[0, 1], [2, 3], [4, 5]], [0, 1, 2], []))
        self.assertEqual(array_of(open_particles(index).load(1), "n"), [2, 3])
        info = json.loads(self.succeed("info", index, "--json").out)
        self.assertEqual((info["files"], info["frames"], info["points"]), (6, 3, 2))
        (self.folder / "1.csv").rename(self.folder / "1_0002.csv")
        index.write_text(index.read_text().replace("1.csv", "1_0002.csv"))
        said = self.fail_with(1, "convert", index, "-o", self.folder / "1_####.csv")
        self.assertIn("1_0002.csv is one of the input files", said)

    def test_parts_of_a_mesh_are_one_mesh(self):
        for i, cube in enumerate(cubes()):
            write_mesh(self.folder / f"{i}.vtp", cube)
        index = self.put_index('timestep="0" part="0" file="0.vtp"', 'part="1" file="1.vtp"')
        self.succeed("convert", index, "-o", "both.stl")
        self.assertEqual(read_shape(self.folder / "both.stl").GetBounds()[:2], (-0.5, 3.5))

    def test_the_later_entry_counts(self):
        at = 'timestep="{}" file="{}.csv"'.format
        for entries, wanted in (
            ((at(0.3, 0), at(0.30000000000000004, 1)), [[1]]),
            ((at(1, 0), at(2, 1), at(1, 2)), [[2], [1]]),
            ((at(0, 0), 'part="1" file="1.csv"', 'part="1" file="5.csv"'), [[0, 5]]),
        ):
            with self.subTest(entries):
                found, _, said = self.xs(self.put_index(*entries))
                self.assertEqual((found, len(said)), (wanted, 1))
                self.assertIn("the last entry is used", said[0])
        text = '{"files": [{"name": "0.csv", "time": 1}, {"name": "3.csv", "time": 1}]}'
        self.assertEqual(self.xs(self.put("a.series", text))[0], [[3]])

    def test_times_that_are_none(self):
        for time in ("nan", "inf", "soon"):
            self.assert_refused("is no index", self.put_index(f'timestep="{time}" file="0.csv"'))


class Names(ReaderTest):
    def order(self, names):
        for name in names:
            self.put(f"in/{name}", POINT)
        found = [path.name for path in open_particles(self.folder / "in" / "*").names]
        for name in names:
            (self.folder / "in" / name).unlink()
        return found

    def test_sign_number_and_exponent(self):
        for names in (
            ["p_-10.csv", "p_-2.csv", "p_0.csv", "p_3.csv", "p_12.csv"],
            ["t-1.csv", "t0.csv", "t1.csv"],
            ["run-1.csv", "run-2.csv", "run-10.csv"],
            ["t_1e-05.csv", "t_2.5e-3.csv", "t_0.01.csv", "t_0.5.csv", "t_1.csv", "t_1e2.csv"],
            ["t=-1.5.csv", "t=-0.25.csv", "t=0.csv", "t=0.125.csv", "t=0.5.csv"],
            ["v1.2.csv", "v1.9.csv", "v1.10.csv", "v1.11.csv"],
            ["p_0.05.csv", "p_0.1.csv", "p_0.15.csv", "p_0.2.csv"],
            ["s.0009.csv", "s.0010.csv", "s.0100.csv"],
            ["2024-01-30.csv", "2024-02-01.csv", "2024-10-01.csv"],
        ):
            with self.subTest(names):
                self.assertEqual(self.order(names[::-1]), names)

    def test_numbers_with_a_sign_are_kept_and_parts_of_numbers_are_none(self):
        for names, wanted in (
            (["p_-2.csv", "p_-1.csv", "p_1.csv"], [-2, -1, 1]),
            (["run-2.csv", "run-4.csv"], [2, 4]),
            (["t_0.1.csv", "t_0.2.csv", "t_0.25.csv"], [0, 1, 2]),
            (["t_1e-3.csv", "t_1e-2.csv"], [0, 1]),
        ):
            self.assertEqual(file_names.numbers_of(names), wanted)
        for step in (-2, -1, 1):
            self.put(f"p_{step}.csv", POINT)
        self.assertEqual(open_particles("p_####.csv").times, [0, 0.04, 0.12])

    def test_only_the_name_is_a_pattern(self):
        patterns = ("p_*.csv", "p_#.csv", "p_%d.csv", "p_{}.csv", "p_[0-2].csv", "p_?.csv", "")
        for folder in ("a[1]", "b*", "c?", "d#1", "e{}", "f%d", "[g"):
            for step in range(3):
                self.put(f"{folder}/p_{step}.csv", POINT)
            for name in patterns:
                with self.subTest(folder=folder, name=name):
                    self.assertEqual(len(open_particles(f"{folder}/{name}")), 3)
        for step in range(2):
            self.put(f"p[a]_{step}.csv", POINT)
        for name in ("p[a]_*.csv", "p[a]_#.csv"):
            self.assertEqual(len(open_particles(name)), 2)
        with self.assertRaisesRegex(OSError, r"none/p.csv; its folder does not exist\.$"):
            open_particles("none/p.csv")
        with self.assertRaisesRegex(OSError, "only the name of a file may be a pattern"):
            open_particles("none*/p_*.csv")

    def test_a_folder_is_its_files(self):
        for name in ("p_2.csv", "p_10.csv", "notes.txt", ".p_3.csv", "picture.png"):
            self.put(f"run/{name}", POINT)
        for given in ("run", "run/", self.folder / "run"):
            names = [path.name for path in open_particles(given).names]
            self.assertEqual(names, ["p_2.csv", "p_10.csv"])
        self.succeed("skin", "run", "-o", "s_##.vtp", "--particle-spacing", 1)
        self.assertTrue((self.folder / "s_10.vtp").exists())
        self.put("run/wall_1.csv", POINT)
        with self.assertRaisesRegex(OSError, "several series, p_####.csv, wall_####.csv; choose"):
            open_particles("run")
        for name in ("p_1.csv", "p_2.csv", "p_old_1.csv"):
            self.put(f"two/{name}", POINT)
        with self.assertRaisesRegex(OSError, "choose one, such as two/p_####.csv"):
            open_particles("two")
        self.assertEqual(len(open_particles("two/p_####.csv")), 2)
        os.mkdir("none")
        with self.assertRaisesRegex(OSError, "none cannot be read: the folder has no file"):
            open_particles("none")

    def test_frames_of_one_of_several_files_are_told_once(self):
        for step in range(3):
            self.put(f"p_{step}.xyz", "1\n\nO 0 0 0\n" * 2)
        series = open_particles("p_*.xyz")
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            self.assertEqual(sum(series.load(i).GetNumberOfPoints() for i in range(3)), 3)
        self.assertEqual(len(said), 1)
        self.assertIn("p_0.xyz: it has 2 frames", str(said[0].message))

    def test_two_running_numbers_are_noticed(self):
        for names, is_noticed in (
            ([f"p_{rank}_{step}.csv" for rank in range(2) for step in range(3)], True),
            ([f"2024-01-{day:02}T{hour}.csv" for day in (1, 2) for hour in (10, 20)], True),
            ([f"p_{step}_{10 * step}.csv" for step in range(4)], False),
            ([f"run2_{step}.csv" for step in range(4)], False),
        ):
            for name in names:
                self.put(f"in/{name}", POINT)
            with warnings.catch_warnings(record=True) as said:
                warnings.simplefilter("always")
                open_particles(self.folder / "in" / "*")
            self.assertEqual(
                ["two running numbers" in str(one.message) for one in said], [True] * is_noticed
            )
            for name in names:
                (self.folder / "in" / name).unlink()


class Blocks(ReaderTest):
    def test_a_vtm_is_all_its_points(self):
        blocks, nested = vtkMultiBlockDataSet(), vtkMultiBlockDataSet()
        nested.SetBlock(0, as_particles(grid() + 1.0, ids=numpy.arange(125)))
        blocks.SetBlock(0, as_particles(grid(), ids=numpy.arange(125)))
        blocks.SetBlock(2, nested)
        blocks.SetBlock(3, vtkPolyData())
        for step in range(2):
            write_data(vtkXMLMultiBlockDataWriter(), blocks, self.folder / f"a_{step}.vtm")
        self.assertEqual(len(array_of(open_particles("a_*.vtm").load(1), "id")), 250)
        self.assertEqual(json.loads(self.succeed("info", "a_0.vtm", "--json").out)["points"], 250)
        self.succeed("skin", "a_*.vtm", "-o", "s_#.ply")
        self.succeed("convert", "a_0.vtm", "-o", "b.csv")
        self.assertEqual(count_in("b.csv"), 250)
        self.succeed("convert", "a_0.vtm", "-o", "b.vtp")
        self.assertEqual(count_in("b.vtp"), 250)

    def test_a_vtm_of_meshes_is_one(self):
        blocks = vtkMultiBlockDataSet()
        for i, cube in enumerate(cubes()):
            blocks.SetBlock(i, cube)
        write_data(vtkXMLMultiBlockDataWriter(), blocks, self.folder / "a.vtm")
        self.succeed("convert", "a.vtm", "-o", "a.stl")
        self.assertEqual(read_shape(self.folder / "a.stl").GetNumberOfPolys(), 24)
        self.assertEqual(json.loads(self.succeed("info", "a.vtm", "--json").out)["holds"], "a mesh")

    def test_a_piece_that_is_missing(self):
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, as_particles(grid()))
        write_data(vtkXMLMultiBlockDataWriter(), blocks, self.folder / "a.vtm")
        next((self.folder / "a").iterdir()).unlink()
        self.assert_refused("cannot be read", self.folder / "a.vtm")

    def test_steps_of_a_vtkhdf_are_refused_where_vtk_cannot(self):
        content = b"\x89HDF\r\n\x1a\n" + 500 * b"\0" + b"Steps\0\0\0NSteps\0\0"
        is_old = (vtkVersion.GetVTKMajorVersion(), vtkVersion.GetVTKMinorVersion()) < (9, 3)
        words = "has time steps, which VTK 9" if is_old else "cannot be read"
        self.assert_refused(words, self.put("a.vtkhdf", content))


class Meshes(ReaderTest):
    def test_a_mesh_is_said_to_be_a_mesh(self):
        mesh = next(cubes(1))
        for suffix in (".vtp", ".ply", ".vtk"):
            write_mesh(self.folder / f"a{suffix}", mesh)
            with self.subTest(suffix), warnings.catch_warnings(record=True) as said:
                warnings.simplefilter("always")
                self.assertEqual(count_in(self.folder / f"a{suffix}"), 24)
            holds = [one for one in said if "it holds a mesh" in str(one.message)]
            self.assertEqual(len(holds), 1)
        for suffix in (".stl", ".obj"):
            write_mesh(self.folder / f"a{suffix}", mesh)
            self.assert_refused(f"{suffix} is a format of meshes, not", self.folder / f"a{suffix}")


class Empty(ReaderTest):
    def assert_goes_on(self, suffix, write):
        empty, full = as_particles(numpy.zeros((0, 3))), as_particles(grid())
        for step in range(3):
            write(self.folder / f"p_{step}{suffix}", empty if step == 1 else full)
        outcome = Outcome("skin", f"p_*{suffix}", "-o", "s_#.vtp", "--particle-spacing", 0.1)
        self.assertEqual(outcome.code, 0, outcome.err)
        made = [count_in(self.folder / f"s_{step}.vtp") > 0 for step in range(3)]
        self.assertEqual(made, [True, False, True])

    def test_by_this_package(self):
        for suffix in (".vtp", ".ply", ".vtk", ".csv", ".json", ".npz"):
            with self.subTest(suffix):
                self.assert_goes_on(suffix, write_particles)

    def test_by_vtk(self):
        for suffix, writer, kind in (
            (".vtp", vtkXMLPolyDataWriter, vtkPolyData),
            (".vtu", vtkXMLUnstructuredGridWriter, vtkUnstructuredGrid),
            (".vtk", vtkPolyDataWriter, vtkPolyData),
        ):

            def write(path, data, writer=writer, kind=kind):
                own = kind()
                if data.GetNumberOfPoints():
                    own.SetPoints(data.GetPoints())
                write_data(writer(), own, path)

            with self.subTest(suffix):
                self.assert_goes_on(suffix, write)

    def test_headers_alone(self):
        for head in ("x,y,z", ",x,y,z,T", '"x";"y";"z"', "# x y z", "t,x,y,z\n"):
            with self.subTest(head):
                self.assertEqual(count_in(self.put("a.csv", head)), 0)

    def test_lists_of_nothing(self):
        for text in ("[]", '{"positions": [], "id": []}', '{"x": [], "y": [], "z": []}'):
            with self.subTest(text):
                self.assertEqual(count_in(self.put("a.json", text)), 0)

    def test_first_and_last(self):
        rows = "\n".join(",".join(map(str, row)) for row in grid())
        for step, text in enumerate(("", rows, "")):
            self.put(f"p_{step}.csv", f"x,y,z\n{text}")
        for suffix in (".vtp", ".ply", ".obj", ".stl", ".glb", ".vdb"):
            with self.subTest(suffix):
                self.succeed("skin", "p_*.csv", "-o", f"s_#{suffix}")
                self.assertEqual(len(list(self.folder.glob(f"s_?{suffix}"))), 3)
        self.succeed("info", "p_*.csv")
        self.succeed("convert", "p_*.csv", "-o", "q_#.vtp")
        self.assertEqual(len(open_particles("q_*.vtp")), 3)


if __name__ == "__main__":
    unittest.main()
