# ctest: LABELS contract
"""active-surface skin: results for the data in the repository, and resumed runs."""

import io
import itertools
import json
import os
import signal
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from unittest import mock

import active_implicit_surfaces
import numpy
from active_implicit_surfaces import api
from active_implicit_surfaces.commands import progress, resume, skin
from active_implicit_surfaces.skin_files import read_shape
from active_implicit_surfaces.vtk_files import read_vtk
from command_line import DROP, CommandTest, grid, moving_grid
from vtkmodules.util.numpy_support import vtk_to_numpy


def bytes_of(path):
    return vtk_to_numpy(read_shape(path).GetPoints().GetData()).tobytes()


class Skins(CommandTest):
    def test_the_splash_needs_no_options(self):
        self.succeed("skin", DROP, "-o", self.folder / "skin_####.vtp")
        files = sorted(self.folder.glob("skin_*.vtp"))
        self.assertEqual(len(files), 41)
        listed = ElementTree.parse(self.folder / "skin.pvd").iter("DataSet")
        entries = [(one.attrib["file"], float(one.attrib["timestep"])) for one in listed]
        self.assertEqual(entries, [(file.name, i / 25) for i, file in enumerate(files)])
        self.assertEqual(self.hidden(), [])
        for step in (0, 20, 40):
            self.assert_has_volume_of_particles(files[step], step)

    def assert_has_volume_of_particles(self, file, step):
        """N particles fill N cubes of their spacing, 0.1. Rounding of edges removes up to a fifth
        of the volume."""
        from vtkmodules.vtkFiltersCore import vtkMassProperties

        measure = vtkMassProperties()
        measure.SetInputData(read_shape(file))
        share = measure.GetVolume() / (992 * 0.1**3)
        self.assertTrue(0.8 < share < 1.2, f"at {step} the volume is {share} of the particles'")

    def test_the_same_skins_as_the_functions(self):
        self.succeed("skin", DROP, "-o", self.folder / "s_#.vtp", "--times", "0:1:41")
        frames = iter(api.frames(str(DROP), times=numpy.linspace(0, 1, 41)))
        for step in range(3):
            points = next(frames).skin.GetPoints().GetData()
            self.assertEqual(
                bytes_of(self.folder / f"s_{step}.vtp"), vtk_to_numpy(points).tobytes()
            )

    def test_one_frame_is_one_file(self):
        numpy.savez(self.folder / "one.npz", positions=grid())
        self.succeed("skin", self.folder / "one.npz", "-o", self.folder / "new" / "one.ply")
        self.assertEqual([path.name for path in (self.folder / "new").iterdir()], ["one.ply"])

    def test_the_first_particles_tell_the_spacing(self):
        numpy.savetxt(self.folder / "p0.csv", numpy.zeros((0, 3)), header="x,y,z", comments="")
        for step in (1, 2):
            numpy.savetxt(
                self.folder / f"p{step}.csv", grid(), delimiter=",", header="x,y,z", comments=""
            )
        for more in ((), ("--particle-spacing", 0.1)):
            self.succeed("skin", "p#.csv", "-o", f"s{len(more)}_#.vtp", *more)
        self.assertGreater(read_shape(self.folder / "s0_2.vtp").GetNumberOfPoints(), 0)
        self.assertEqual(bytes_of(self.folder / "s0_2.vtp"), bytes_of(self.folder / "s2_2.vtp"))

    def test_patterns_are_series_in_the_natural_order(self):
        for step, frame in enumerate(moving_grid(12)):
            numpy.save(self.folder / f"p{step}.npy", frame)
        for name in ("p*.npy", "p#.npy", "p%d.npy", "p{}.npy", "p$F.npy"):
            with self.subTest(name):
                output = self.folder / "s.####.vtp"
                self.succeed("skin", self.folder / name, "-o", output, "--fps", 10)
                last = read_shape(self.folder / "s.0011.vtp").GetCenter()[0]
                # The lattice's middle is 0.2 and moves by 0.05 per frame. Half a voxel is 0.025.
                self.assertAlmostEqual(last, 0.2 + 11 * 0.05, delta=0.025)

    def test_numbers_of_files_are_kept_and_gaps_are_gaps_in_time(self):
        for number, frame in zip((90, 100, 120), moving_grid(3)):
            numpy.save(self.folder / f"p{number}.npy", frame)
        self.succeed("skin", "p*.npy", "-o", "s_####.ply", "--fps", 10)
        made = json.loads((self.folder / "s.ply.series").read_text())["files"]
        self.assertEqual(
            [(one["name"], round(one["time"], 9)) for one in made],
            [("s_0090.ply", 0.0), ("s_0100.ply", 0.1), ("s_0120.ply", 0.3)],
        )
        self.succeed("convert", "s_*.ply", "-o", "t_#.stl")
        self.assertEqual(
            sorted(p.name for p in self.folder.glob("t_*")),
            [
                "t_100.stl",
                "t_120.stl",
                "t_90.stl",
            ],
        )
        self.succeed("convert", "p*.npy", "-o", "q_#.csv")
        self.assertTrue((self.folder / "q_120.csv").exists())

    def test_times_of_a_series_file_hold(self):
        for step, frame in enumerate(moving_grid(3)):
            numpy.save(self.folder / f"p{step}.npy", frame)
        files = [{"name": f"p{step}.npy", "time": 2.0 + step} for step in range(3)]
        index = self.folder / "p.npy.series"
        index.write_text(json.dumps({"file-series-version": "1.0", "files": files}))
        self.succeed("skin", index, "-o", self.folder / "s_#.ply")
        made = json.loads((self.folder / "s.ply.series").read_text())["files"]
        self.assertEqual([one["time"] for one in made], [2.0, 3.0, 4.0])

    def test_times_inside_the_files_hold(self):
        self.succeed("skin", self.save_moving(), "-o", self.folder / "a_#.vdb", "--fps", 4)
        info = json.loads(self.succeed("info", self.folder / "a_1.vdb", "--json").out)
        self.assertEqual((info["time"], info["frame"]), ("0.25", "1"))

    def test_the_index_is_a_choice(self):
        moving = self.save_moving(2)
        for index, names in (
            ("none", []),
            ("a.series", ["a.series"]),
            ("a.pvd", ["a.pvd", "a.series"]),
        ):
            self.succeed("skin", moving, "-o", "s_#.vtp", "--index", index)
            found = [p.name for p in self.folder.iterdir() if p.suffix in (".pvd", ".series")]
            self.assertEqual(sorted(found), names)
        self.assertIn('file="s_1.vtp"', (self.folder / "a.pvd").read_text())

    def save_moving(self, frames=4):
        numpy.savez(self.folder / "moving.npz", positions=moving_grid(frames))
        return self.folder / "moving.npz"

    def test_every_property_is_an_option(self):
        properties = active_implicit_surfaces.properties.every()
        options = {name for action in skin.make_parser()._actions for name in action.option_strings}
        for own in properties:
            if own.kind != "object":
                self.assertIn(own.option, options)
        self.assertGreater(len(properties), 40)

    def test_properties_reach_the_filter(self):
        moving = self.save_moving(2)
        chosen = "--voxel-size .04 --compute-curvature --particle-model sum".split()
        self.succeed("skin", moving, "-o", self.folder / "a_#.vtp", *chosen)
        made = read_vtk(self.folder / "a_1.vtp")
        self.assertTrue(made.GetPointData().HasArray("MeanCurvature"))
        spacing = {"voxel_size": 0.04, "particle_model": "sum"}
        points = [frame.skin for frame in api.frames(moving_grid(2), **spacing)][1].GetPoints()
        self.assertEqual(
            bytes_of(self.folder / "a_1.vtp"), vtk_to_numpy(points.GetData()).tobytes()
        )

    def test_every_preset_makes_a_skin(self):
        moving, made = self.save_moving(2), {}
        for name in active_implicit_surfaces.presets.PRESETS:
            with self.subTest(name):
                self.succeed("skin", moving, "-o", self.folder / f"{name}_#.vtp", "--preset", name)
                made[name] = bytes_of(self.folder / f"{name}_1.vtp")
                self.assertGreater(len(made[name]), 0)
        self.assertEqual(len(set(made.values())), len(made), "two presets give the same")


class GoingOn(CommandTest):
    """A run of six frames that fails at its fourth, and is resumed."""

    def setUp(self):
        super().setUp()
        for step, frame in enumerate(moving_grid(6)):
            numpy.save(self.folder / f"p{step}.npy", frame)
        self.command = ["skin", self.folder / "p*.npy", "-o", self.folder / "a" / "s_#.vtp"]
        self.succeed("skin", self.folder / "p*.npy", "-o", self.folder / "b" / "s_#.vtp")
        self.fourth = (self.folder / "p3.npy").read_bytes()
        (self.folder / "p3.npy").write_bytes(self.fourth[:200])

    def test_it_gives_the_same_bytes_and_makes_no_skin_twice(self):
        self.fail_with(1, *self.command)
        before = {path: path.stat().st_mtime_ns for path in (self.folder / "a").glob("s_?.vtp")}
        self.assertEqual(len(before), 3)
        (self.folder / "p3.npy").write_bytes(self.fourth)
        self.succeed(*self.command, "--resume")
        for step in range(6):
            pair = [self.folder / name / f"s_{step}.vtp" for name in "ab"]
            self.assertEqual(bytes_of(pair[0]), bytes_of(pair[1]), f"frame {step}")
        for path, time in before.items():
            self.assertEqual(path.stat().st_mtime_ns, time, f"{path} was made twice")

    def test_a_series_that_has_grown_goes_on(self):
        (self.folder / "p3.npy").write_bytes(self.fourth)
        last = (self.folder / "p5.npy").rename(self.folder / "later")
        self.succeed(*self.command, "--resume")
        last.rename(self.folder / "p5.npy")
        self.succeed(*self.command, "--resume")
        pair = [bytes_of(self.folder / name / "s_5.vtp") for name in "ab"]
        self.assertEqual(*pair)

    def test_other_options_are_another_run(self):
        self.fail_with(1, *self.command)
        said = self.fail_with(1, *self.command, "--resume", "--voxel-size", ".04")
        self.assertIn(
            "without voxel_size, but further skins would be made with voxel_size 0.04", said
        )

    def test_a_finished_run_has_nothing_left_to_do(self):
        (self.folder / "p3.npy").write_bytes(self.fourth)
        for _ in range(3):
            self.succeed(*self.command, "--resume")
        pair = [bytes_of(self.folder / name / "s_5.vtp") for name in "ab"]
        self.assertEqual(*pair)

    def test_a_finished_run_has_its_history(self):
        (self.folder / "p3.npy").write_bytes(self.fourth)
        self.succeed(*self.command, "--resume", "--history", "a.csv")
        self.succeed(*self.command, "--resume", "--history", "b.csv")
        histories = [(self.folder / name).read_text() for name in ("a.csv", "b.csv")]
        self.assertEqual(*histories)

    def test_names_may_be_a_pattern_or_a_list(self):
        self.fail_with(1, *self.command)
        (self.folder / "p3.npy").write_bytes(self.fourth)
        listed = sorted(self.folder.glob("p*.npy"), reverse=True)
        self.succeed("skin", *listed, *self.command[2:], "--resume")

    def test_a_file_that_has_changed_is_told(self):
        self.fail_with(1, *self.command)
        (self.folder / "p3.npy").write_bytes(self.fourth)
        (self.folder / "p1.npy").write_bytes(self.fourth)
        said = self.fail_with(1, *self.command, "--resume")
        self.assertIn("p1.npy has since changed", said)

    def test_another_file_in_between_is_told(self):
        self.fail_with(1, *self.command)
        (self.folder / "p0.npy").unlink()
        said = self.fail_with(1, *self.command, "--resume", "--times", "0:.16:5")
        self.assertIn("p1.npy is in place of", said)

    def test_a_missing_skin_is_told(self):
        self.fail_with(1, *self.command)
        (self.folder / "a" / "s_1.vtp").unlink()
        self.assertIn("s_1.vtp is missing", self.fail_with(1, *self.command, "--resume"))

    def test_damaged_notes_are_told(self):
        self.fail_with(1, *self.command)
        notes = {"done": 1, "times": [0], "options": {}, "files": [], "properties": {}}
        damages = {"options": [1]}, {"files": [3]}, {"properties": {"none": 1}}
        for text in "{", *(json.dumps({**notes, **damage}) for damage in damages):
            (self.folder / "a" / ".s.state.json").write_text(text)
            self.assertIn("is damaged", self.fail_with(1, *self.command, "--resume"))

    def test_a_damaged_state_is_told(self):
        self.fail_with(1, *self.command)
        (self.folder / "a" / ".s.state.vdb").write_bytes(b"no grid")
        said = self.fail_with(1, *self.command, "--resume")
        self.assertEqual(said.count(".s.state.vdb"), 1, said)
        self.assertIn(".s.state.vdb cannot be read", said)

    def test_new_frames_keep_the_properties_of_the_preset(self):
        command = [*self.command, "--preset", "viscous", "--resume", "--times"]
        (self.folder / "p3.npy").write_bytes(self.fourth)
        names = [self.folder / f"p{step}.npy" for step in range(6)]
        notes = self.folder / "a" / ".s.state.json"
        made = []
        for count, times in (3, "0,.04,.08"), (6, "0,.04,.08,.09,.1,.11"):
            self.succeed("skin", *names[:count], *command[2:], times)
            made.append(json.loads(notes.read_text())["properties"])
        self.assertEqual(*made)
        self.assertGreater(made[0]["attraction"], 0)

    def test_a_file_of_one_frame_may_grow(self):
        frames = numpy.stack(list(moving_grid(3)))
        name, skins = self.folder / "all.npy", self.folder / "c" / "s_#.vtp"
        for count in 1, 3:
            numpy.save(name, frames[:count])
            self.succeed("skin", name, "-o", skins, "--particle-spacing", ".1", "--resume")
        self.succeed("skin", name, "-o", self.folder / "d" / "s_#.vtp", "--particle-spacing", ".1")
        pair = [bytes_of(self.folder / folder / "s_2.vtp") for folder in "cd"]
        self.assertEqual(*pair)

    def test_a_file_of_one_frame_that_has_changed_is_told(self):
        name, command = self.folder / "all.npy", ["-o", self.folder / "c" / "s_#.vtp", "--resume"]
        numpy.save(name, grid()[None])
        self.succeed("skin", name, *command)
        numpy.save(name, grid()[None] + 0.01)
        self.assertIn("has since changed", self.fail_with(1, "skin", name, *command))

    def test_a_state_that_cannot_be_saved_leaves_the_one_before(self):
        files = [self.folder / f"p{step}.npy" for step in range(6)]
        kept = resume.Resumption(self.folder / "s_#.vtp", {}, files)
        frames = api.frames(moving_grid(6), fps=25)
        next(iter(frames))
        kept.save(frames.surface, frames.source.times, 1, now=True)
        without_state = active_implicit_surfaces.vtkActiveImplicitSurface()
        with self.assertRaisesRegex(OSError, "no state"):
            kept.save(without_state, frames.source.times, 2, now=True)
        again = api.frames(moving_grid(6), fps=25)
        self.assertEqual(kept.load(again.surface, again.source.times), 1)

    def test_states_are_kept_while_it_runs(self):
        (self.folder / "p3.npy").write_bytes(self.fourth)
        with mock.patch.object(resume, "_SECONDS_BETWEEN_STATES", 0.0):
            self.succeed(*self.command)
        self.assertEqual(self.hidden(self.folder / "a"), [], "a finished run leaves none")


class Terminal(io.StringIO):
    def isatty(self):
        return True


class Progress(unittest.TestCase):
    def tell(self, stream, between=0.0):
        with (
            mock.patch.object(
                progress.time, "monotonic", side_effect=itertools.count(0, 2).__next__
            ),
            mock.patch.object(progress, "_SECONDS_BETWEEN_LINES", between),
        ):
            told = progress.Progress(100, 40, stream=stream)  # each query of the clock takes 2 s
            told.add(40)
            told.add(59)
        return stream.getvalue()

    def test_a_bar_on_a_terminal(self):
        text = self.tell(Terminal())
        self.assertEqual(text.count("\r"), 2)
        self.assertNotIn("\n", text)
        # 20 frames in 4 s, with 40 remaining.
        self.assertIn("[" + 18 * "#" + 12 * "-" + "] 60 of 100 frames, 5 frames/s, 0:08 left", text)

    def test_lines_elsewhere(self):
        text = self.tell(io.StringIO())
        self.assertEqual(text.splitlines()[-1], "60 of 100 frames, 5 frames/s, 0:08 left")
        self.assertNotIn("\r", text)
        self.assertEqual(self.tell(io.StringIO(), between=100.0), "", "not at every frame")


class Program(unittest.TestCase):
    def find_launcher(self):
        package = Path(active_implicit_surfaces.__file__).parents[1]
        folder = next(p / "bin" for p in package.parents if (p / "bin").is_dir())
        return package, folder / "active-surface"

    def test_an_interruption_while_vtk_is_loaded_is_no_traceback(self):
        with tempfile.TemporaryDirectory() as folder:
            stub = Path(folder) / "vtkmodules" / "__init__.py"  # a VTK that raises Ctrl-C
            stub.parent.mkdir()
            stub.write_text("import os, signal\nos.kill(os.getpid(), signal.SIGINT)\n")
            done = subprocess.run(
                [self.find_launcher()[1], "--version"],
                capture_output=True,
                text=True,
                env={**os.environ, "PYTHONPATH": folder},
            )
        self.assertEqual(done.returncode, -signal.SIGINT, done.stderr)
        self.assertEqual(done.stderr + done.stdout, "")

    def test_the_module_and_the_launcher_run(self):
        package, launcher = self.find_launcher()
        for command in ([sys.executable, "-m", "active_implicit_surfaces"], [str(launcher)]):
            environment = {**os.environ, "PYTHONPATH": str(package)}
            if command[0] == str(launcher):
                del environment["PYTHONPATH"]  # the launcher finds the package itself
            with self.subTest(command[-1]):
                for arguments, code in (["--version"], 0), (["skin"], 2), (["info", "none.vtp"], 1):
                    done = subprocess.run(
                        [*command, *arguments], capture_output=True, text=True, env=environment
                    )
                    self.assertEqual(done.returncode, code, done.stderr)


if __name__ == "__main__":
    unittest.main()
