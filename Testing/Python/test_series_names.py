# ctest: LABELS contract
"""Series of files with names from other programs and users: indices, home folders, patterns,
gaps.
"""

import os
import unittest
from unittest import mock

from active_implicit_surfaces import file_names
from active_implicit_surfaces.particle_files import open_particles
from command_line import grid
from reader_checks import ReaderTest, array_of

POINT = "x,y,z\n0,0,0\n"


class IndicesOfOthers(ReaderTest):
    def test_folders_of_windows(self):
        self.put("run/0.csv", POINT)
        path = self.put("a.pvd", '<VTKFile><DataSet timestep="0" file="run\\0.csv"/></VTKFile>')
        self.assertEqual(open_particles(path).load(0).GetNumberOfPoints(), 1)

    def test_an_entry_without_name_or_time(self):
        for name, text, words in (
            ("a.series", '{"files": ["0.csv"]}', "`name` and `time` in each entry"),
            ("a.series", '{"files": [{"name": "0.csv"}]}', "`name` and `time` in each entry"),
            ("a.pvd", '<VTKFile><DataSet timestep="0"/></VTKFile>', "`file` in each entry"),
        ):
            with self.subTest(text):
                self.assert_refused(words, self.put(name, text))

    def test_arrays_that_not_all_parts_have_are_a_note(self):
        self.put("fluid.csv", "x,y,z,T,id\n0,0,0,5,1\n")
        self.put("wall.csv", "x,y,z,id\n1,0,0,2\n")
        rows = "".join(
            f'<DataSet timestep="0" part="{n}" file="{n}.csv"/>' for n in ("fluid", "wall")
        )
        path = self.put("a.pvd", f"<VTKFile>{rows}</VTKFile>")
        with self.assertWarnsRegex(
            UserWarning, "T are left out, because some parts of the frame lack"
        ):
            cloud = open_particles(path).load(0)
        self.assertEqual(array_of(cloud, "id"), [1, 2])

    def test_ids_that_a_later_frame_lacks_are_not_used(self):
        block = "\n".join(f"{x},{y},{z}" for x, y, z in grid())
        self.put(
            "p_0.csv", "x,y,z,id\n" + "\n".join(f"{r},{i}" for i, r in enumerate(block.split()))
        )
        for step in (1, 2):
            self.put(f"p_{step}.csv", f"x,y,z\n{block}\n")
        self.succeed("skin", "p_*.csv", "-o", "s_#.vtp", "--particle-spacing", 0.1, "--quiet")
        self.assertTrue((self.folder / "s_2.vtp").exists())


class Names(ReaderTest):
    def test_a_tilde_is_the_home_folder(self):
        self.put("home/p_1.csv", POINT)
        with mock.patch.dict(os.environ, HOME=str(self.folder / "home")):
            self.assertEqual(len(open_particles("~/p_*.csv")), 1)
            self.succeed("convert", "~/p_1.csv", "-o", "~/q.csv")
            self.succeed("skin", "~/p_1.csv", "-o", "~/s.vtp", "--particle-spacing", 1)
        for name in ("q.csv", "s.vtp"):
            self.assertTrue((self.folder / "home" / name).exists())

    def test_marks_of_python(self):
        for step in (1, 2):
            self.put(f"p_{step:04}.csv", POINT)
        self.assertEqual(len(open_particles("p_{:04d}.csv")), 2)
        self.assertEqual(str(file_names.numbered("s_{:03d}.vtp", 7)), "s_007.vtp")

    def test_gaps_of_decimals_and_exponents_are_gaps_in_time(self):
        for form, numbers in (("{}", (0.5, 0.75, 1.5)), ("{:.0e}", (1e-3, 2e-3, 5e-3))):
            names = ["p_" + form.format(number) + ".csv" for number in numbers]
            for name in names:
                self.put(name, POINT)
            self.assertEqual(open_particles(names, fps=1).times, [0, 1, 4])

    def test_a_name_given_twice_is_one_frame(self):
        self.put("p_1.csv", POINT)
        self.put("p_2.csv", POINT)
        with self.assertWarnsRegex(UserWarning, "p_2.csv is named more than once"):
            self.assertEqual(len(open_particles(["p_*.csv", "p_2.csv"])), 2)

    def test_folders_of_index_and_history_are_made(self):
        self.put("p_1.csv", POINT)
        more = ("--history", "new/h.csv", "--index", "other/s.pvd", "--particle-spacing", 1)
        self.succeed("skin", "p_1.csv", "-o", "s.vtp", *more)
        self.assertTrue((self.folder / "new/h.csv").exists())
        self.assertEqual(len(file_names.read_index(self.folder / "other/s.pvd").frames), 1)


if __name__ == "__main__":
    unittest.main()
