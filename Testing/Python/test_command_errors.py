# ctest: LABELS contract
"""Errors of active-surface: one message, exit code 1 for data, 2 for the command line."""

import json
import re
import unittest
from unittest import mock

import numpy
from active_implicit_surfaces import commands, particle_files
from active_implicit_surfaces.commands import skin
from active_implicit_surfaces.data_objects import as_particles
from active_implicit_surfaces.presets import estimate_spacing
from active_implicit_surfaces.skin_files import write_particles
from command_line import DROP, CommandTest, Outcome, grid
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

HELP_LINES = 50  # lines of a screen


class Help(CommandTest):
    def test_help_of_every_command_fits_a_screen(self):
        for command in ([], *([name] for name in commands.COMMANDS)):
            with self.subTest(command):
                told = self.succeed(*command, "--help").out
                self.assertLessEqual(len(told.splitlines()), HELP_LINES)
                self.assertLessEqual(max(map(len, told.splitlines())), 100)
                self.assertIn("usage: active-surface", told)

    def test_help_of_properties_has_every_one_under_its_group(self):
        from active_implicit_surfaces import properties

        told = self.succeed("skin", "--help-properties").out
        groups = list(dict.fromkeys(own.group for own in properties.every()))
        self.assertEqual(re.findall(r"^\w+$", told, re.MULTILINE), groups)
        self.assertLessEqual({"Particles", "Resolution", "Motion", "Output", "Limits"}, set(groups))
        for own in properties.every():
            if own.kind != "object":
                self.assertIn(f"  {own.option}", told)
                self.assertIn(own.summary[:20], " ".join(told.split()))


class Usage(CommandTest):
    def test_nothing_is_usage(self):
        self.assertEqual(Outcome().code, 2)

    def test_wrong_words(self):
        cases = {
            "invalid choice: 'skinn'": ["skinn", "a.vtp"],
            "did you mean --voxel-size": ["skin", DROP, "--voxel-sise", 3],
            "its range: 1 to 100": ["skin", DROP, "--anisotropy", 300],
            "its range: >= 0, or -1": ["skin", DROP, "--tension", -3],
            "invalid number value": ["skin", DROP, "--tension", "much"],
            "invalid choice: 'round'": ["skin", DROP, "--particle-model", "round"],
            "expected 6 arguments": ["skin", DROP, "--model-bounds", 1, 2],
            "skins are written as": ["skin", DROP, "-o", "a.foo"],
            "films are written as .mp4": ["skin", DROP, "--render", "a.avi"],
            "--fps: 0 is not a finite number above 0": ["skin", DROP, "--fps", 0],
            "--csv: not allowed with argument --json": ["info", DROP, "--json", "--csv"],
            "are no times": ["skin", DROP, "--times", "0,b"],
            "is no size": ["skin", DROP, "--size", "wide"],
            "'Type' is no condition": ["skin", DROP, "--where", "Type"],
            "--index has to be none": ["skin", DROP, "--index", "a.txt"],
            "a film cannot be resumed": ["skin", DROP, "--resume", "--render", "a.ogv"],
            "the following arguments are required": ["morph", "a.stl"],
            "--frames has to be 2 or more": ["morph", "a.stl", "b.stl", "--frames", 1],
            "required: -o": ["convert", "a.stl"],
            "files are written as": ["convert", "a.stl", "-o", "b.doc"],
        }
        for words, command in cases.items():
            with self.subTest(words):
                self.assertIn(words, self.fail_with(2, *command))

    def test_nothing_far_fetched_is_suggested(self):
        for option, wanted in (("-r", None), ("-x", None), ("--particle-spacin", "spacing")):
            said = self.fail_with(2, "skin", DROP, option, 1)
            self.assertEqual("did you mean" in said, wanted is not None, said)
            self.assertIn(wanted or option, said)


class Data(CommandTest):
    """Files with errors in them."""

    def assert_skin_fails(self, words, *files):
        said = self.fail_with(1, "skin", *files, "-o", self.folder / "out" / "s_#.vtp")
        self.assertIn(words, said)
        self.assertEqual(self.hidden(), [])

    def test_missing(self):
        self.assert_skin_fails("There is no file", self.folder / "none.vtp")
        self.assert_skin_fails("No file fits the pattern", self.folder / "none*.vtp")
        self.assert_skin_fails("There is no file", self.folder / "none.pvd")
        self.assert_skin_fails("cannot be read", self.folder)

    def test_empty_files_of_every_kind(self):
        for suffix in particle_files.PARTICLE_SUFFIXES:
            with self.subTest(suffix):
                self.assert_skin_fails("is empty", self.put(f"a{suffix}", ""))

    def test_garbage_of_every_kind(self):
        noise = numpy.random.default_rng(7).integers(0, 256, 1000, dtype="u1").tobytes()
        for suffix in particle_files.PARTICLE_SUFFIXES:
            for content in (noise, b"garbage\n" * 20):
                with self.subTest(suffix=suffix, content=content[:8]):
                    self.assert_skin_fails("cannot be read", self.put(f"a{suffix}", content))

    def test_files_cut_off(self):
        cloud = as_particles(grid(), ids=range(125))
        for suffix in (".vtp", ".ply", ".vtk", ".json", ".npz"):
            with self.subTest(suffix):
                whole = self.folder / f"whole{suffix}"
                write_particles(whole, cloud)
                content = whole.read_bytes()
                whole.unlink()
                cut = self.put(f"cut{suffix}", content[: len(content) // 2])
                self.assert_skin_fails("cut", cut)

    def test_appended_data_have_a_hint(self):
        writer = vtkXMLPolyDataWriter()
        writer.SetInputData(as_particles(grid()))
        writer.SetFileName(str(self.folder / "a.vtp"))
        writer.Write()
        content = (self.folder / "a.vtp").read_bytes()
        cut = self.put("cut.vtp", content[: content.index(b"<AppendedData") + 40])
        is_old = vtkVersion.GetVTKVersion().startswith("9.1.")
        self.assert_skin_fails("SetDataModeToBinary" if is_old else "cannot be read", cut)

    def test_wrong_columns(self):
        self.assert_skin_fails("no columns x, y and z", self.put("a.csv", "x,y\n1,2\n"))
        self.assert_skin_fails("no columns x, y and z", self.put("a.csv", "x,y,z\n1,2,a\n"))
        self.assert_skin_fails("2 column(s)", self.put("a.csv", "1,2\n3,4\n"))
        self.assert_skin_fails('line 3 has "b"', self.put("a.csv", "x,y,z\n1,2,3\n1,b,3\n"))
        self.assert_skin_fails("2 column(s)", self.put("a.xyz", "1 2\n3 4\n"))
        self.assert_skin_fails(
            "fewer atoms than the 3 that line 1 declares;", self.put("a.xyz", "3\n\nH 0 0 0\n")
        )
        self.assert_skin_fails("need the shape (n, 3)", self.put("a.json", "[[1, 2], [3, 4]]"))
        self.assert_skin_fails("rows of different", self.put("a.json", "[[1, 2, 3], [4, 5]]"))
        self.assert_skin_fails("are not numbers", self.put("a.json", '[[1, 2, "x"]]'))
        self.assert_skin_fails("no array of positions", self.put("a.json", '{"a": [], "b": []}'))
        self.assert_skin_fails("neither a list", self.put("a.json", "3"))

    def test_wrong_arrays(self):
        path = self.folder / "a.npz"
        numpy.savez(path, positions=numpy.zeros((4, 2)))
        self.assert_skin_fails("have the shape (4, 2)", path)
        numpy.savez(path, positions=numpy.array([{}], dtype=object))
        self.assert_skin_fails("cannot be read", path)

    def test_no_particles(self):
        numpy.savez(self.folder / "a.npz", positions=numpy.zeros((0, 3)))
        outcome = Outcome("skin", self.folder / "a.npz", "-o", self.folder / "s.vtp")
        self.assertEqual(outcome.code, 0)
        self.assertIn("The target is empty", outcome.err)

    def test_particles_that_are_not_finite(self):
        positions = grid()
        positions[7] = numpy.nan
        numpy.savez(self.folder / "a.npz", positions=positions)
        outcome = Outcome("skin", self.folder / "a.npz", "-o", self.folder / "s.vtp")
        self.assertEqual(outcome.code, 0, outcome.err)
        self.assertRegex(outcome.err, "note: .*finite")
        found = json.loads(self.succeed("info", self.folder / "a.npz", "--json").out)
        self.assertEqual(found["points that are not finite"], 1)
        self.assertEqual(
            found["spacing"], estimate_spacing(as_particles(numpy.delete(grid(), 7, 0)))
        )
        positions[7] = numpy.nan, 1e9, 0
        vectors, size = numpy.ones((len(positions), 3)), numpy.arange(len(positions), dtype=float)
        vectors[2, 1] = size[:2] = numpy.nan
        arrays = {"vectors": vectors, "size": size, "nothing": numpy.nan * size}
        numpy.savez(self.folder / "a.npz", positions=positions, **arrays)
        found = json.loads(self.succeed("info", self.folder / "a.npz", "--json").out)
        self.assertLess(max(found["bounds"]), 10)
        count = len(positions)
        self.assertEqual(
            [found["arrays"][name] for name in arrays],
            [
                "double x 3, length 1.73205 to 1.73205, 1 not finite",
                f"double, 2 to {count - 1}, 2 not finite",
                f"double, {count} not finite",
            ],
        )
        numpy.savez(self.folder / "a.npz", positions=numpy.full((4, 3), numpy.nan))
        found = json.loads(self.succeed("info", self.folder / "a.npz", "--json").out)
        self.assertNotIn("bounds", found)

    def test_an_unknown_kind_of_file(self):
        self.assert_skin_fails("particles or images are read from", self.put("a.abc", "x"))
        self.assertIn("info reads", self.fail_with(1, "info", self.put("a.abc", "x")))
        self.assertIn(
            "files are read from",
            self.fail_with(1, "convert", self.put("a.abc", "x"), "-o", self.folder / "b.ply"),
        )
        self.assertIn("meshes and images", self.fail_with(1, "morph", self.folder / "a.abc", DROP))

    def test_damaged_indices(self):
        self.assert_skin_fails("is no index", self.put("a.pvd", "<VTKFile>"))
        self.assert_skin_fails("is no index", self.put("a.series", '{"files": [{"name": 1}]}'))
        self.assert_skin_fails("lists no files", self.put("b.series", '{"files": []}'))
        index = self.put("c.series", '{"files": [{"name": "no.npy", "time": 0}]}')
        self.assert_skin_fails("no.npy", index)

    def test_times_that_do_not_fit(self):
        numpy.savez(self.folder / "a.npz", positions=numpy.stack(3 * [grid()]))
        for times, words in (
            ("0,1", "times is 2, but that of frames is 3"),
            ("0,2,1", "have to increase"),
        ):
            said = self.fail_with(1, "skin", self.folder / "a.npz", "--times", times)
            self.assertIn(words, said)

    def test_numbers_that_are_too_large(self):
        said = self.fail_with(2, "skin", DROP, "--number-of-threads", 10**15)
        self.assertIn("number_of_threads = 1000000000000000 is out of its range", said)

    def test_one_argument_too_many(self):
        said = self.fail_with(2, "morph", DROP, DROP, "--quiet", DROP)
        self.assertIn("one argument too many; leave it out;", said)
        said = self.fail_with(2, "convert", DROP, "-o", "a.csv", DROP)
        self.assertIn("leave it out, or, if it is a file, put it next to the other files;", said)

    def test_arrays_that_are_missing(self):
        said = self.fail_with(1, "skin", DROP, "--radii", "size", "-o", self.folder / "s_#.vtp")
        self.assertIn("'size'", said)

    def test_the_filters_own_error(self):
        said = self.fail_with(
            1, "skin", DROP, "--maximum-number-of-active-voxels", 10, "-o", self.folder / "s_#.vtp"
        )
        self.assertIn("MaximumNumberOfActiveVoxels", said)

    def test_output_that_cannot_be_written(self):
        blocked = self.put("file", "x")
        said = self.fail_with(1, "skin", DROP, "-o", blocked / "s_#.vtp")
        self.assertIn("cannot be made", said)
        for suffix in (".vtp", ".ply", ".obj", ".stl", ".glb", ".vdb"):
            with self.subTest(suffix):
                name = self.folder / f"folder{suffix}"
                name.mkdir()
                numpy.save(self.folder / "a.npy", grid())
                said = self.fail_with(1, "skin", self.folder / "a.npy", "-o", name)
                self.assertIn("cannot be written", said)
                self.assertEqual(self.hidden(), [])

    def test_no_input_is_written_over(self):
        for step in range(2):
            numpy.savez(self.folder / f"p_{step}.npz", positions=grid())
        before = (self.folder / "p_1.npz").read_bytes()
        for command in (
            ["skin", "p_1.npz", "-o", self.folder / "." / "p_1.npz"],
            ["convert", "p_*.npz", "-o", "p_#.npz"],
        ):
            said = Outcome(*command).err
            self.assertRegex(said, "is one of the input files|skins are written as")
        self.succeed("convert", "p_*.npz", "-o", "q_#.ply")
        self.assertIn(
            "is one of the input files", self.fail_with(1, "skin", "q_*.ply", "-o", "q_#.ply")
        )
        self.succeed("skin", "p_0.npz", "-o", "cube_0.ply")
        command = ["morph", "cube_0.ply", "cube_0.ply", "-o", "cube_#.ply"]
        self.assertIn("is one of the input files", self.fail_with(1, *command))
        command = ["convert", "cube_0.ply", "-o", "cube_#.ply"]
        self.assertIn("is one of the input files", self.fail_with(1, *command))
        self.assertEqual((self.folder / "p_1.npz").read_bytes(), before)

    def test_meshes_that_are_none(self):
        numpy.savez(self.folder / "a.npz", positions=grid())
        self.succeed("convert", self.folder / "a.npz", "-o", self.folder / "a.ply")
        said = self.fail_with(1, "morph", self.folder / "a.ply", self.folder / "a.ply")
        self.assertIn("no polygons", said)
        for suffix in (".stl", ".obj", ".glb", ".vti", ".vdb"):
            with self.subTest(suffix):
                path = self.put(f"bad{suffix}", b"\x07nonsense" * 30)
                said = self.fail_with(1, "morph", path, path)
                self.assertIn(path.name, said)

    def test_an_interruption_is_no_traceback(self):
        with mock.patch.object(skin, "open_particles", side_effect=KeyboardInterrupt):
            outcome = Outcome("skin", DROP)
        self.assertEqual(outcome.code, 130)
        self.assertIn("interrupted", outcome.err)


if __name__ == "__main__":
    unittest.main()
