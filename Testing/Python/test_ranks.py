# ctest: LABELS contract long TIMEOUT 900
"""Ranks of MPI make one skin, with the bytes of a program without MPI, and fail together.

Run: python3 test_ranks.py. Skipped where there is no MPI, see with_ranks.
"""

import shutil
import tempfile
import time
import unittest
from pathlib import Path

import numpy
from listener import sentence_of
from ranks import load, sorted_triangles
from ranks_checks import assert_same_outputs, start_ranks

PROGRAM = Path(__file__).with_name("ranks_program.py")
SIZES = (1, 2, 3, 4)
SAME = ("splash", "emitter", "table", "meshes", "image", "skeleton", "grid", "morph", "live")
SHARED = ("shared", "shared_back", "shared_fine", "shared_walls", "shared_estimate")
# Limit of a run, which takes seconds: a rank that waits for an absent rank waits for ever.
LONGEST = 120


def start(size, run, folder, longest=LONGEST):
    start_ranks(PROGRAM, size, [run, folder], longest)


def state_in(file):
    """Returns the bytes of a .vdb without its random id, 36 bytes at offset 21."""
    content = file.read_bytes()
    return content[:21] + content[57:]


def is_running(process):
    """Returns True unless the process has ended; a zombie has ended."""
    try:
        state = Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[0]
    except FileNotFoundError:
        return False
    return state not in "ZX"


def has_ended(process, within):
    """Waits up to `within` seconds for the end of a process; mpiexec may end a little earlier."""
    last = time.monotonic() + within
    while is_running(process) and time.monotonic() < last:
        time.sleep(0.1)
    return not is_running(process)


class Ranks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.alone = Path(cls.enterClassFolder())
        start(1, "nothing", cls.alone)  # or all are skipped
        start(0, ",".join(SAME), cls.alone)

    @classmethod
    def enterClassFolder(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        return folder.name

    def folder(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        return Path(folder.name)

    def names_in(self, folder):
        return sorted(
            path.name[: -len(".0.npz")]
            for path in folder.glob("*.0.npz")
            if not path.name.endswith(".errors.0.npz")
        )

    def assert_same(self, folder, size, alone, expected_folder=None):
        expected = load(expected_folder or self.alone, alone, 1)
        kept = load(folder, alone, size)
        self.assert_no_errors(folder, alone, size)
        triangles = sorted_triangles(expected)
        self.assertGreater(len(triangles), 100, "a skin of nothing proves nothing")
        assert_same_outputs(self, kept, expected, f"{alone}, {size} ranks")

    def assert_no_errors(self, folder, name, size):
        for part in load(folder, name + ".errors", size):
            self.assertEqual(list(part["errors"]), [])

    def assert_failed(self, folder, name, size, *words):
        """Checks that all ranks have the same error, which contains these words, and no skin."""
        errors = [part["errors"] for part in load(folder, name + ".errors", size)]
        for own in errors:
            self.assertEqual(len(own), 1, errors)
            self.assertEqual(sentence_of(own[0]), sentence_of(errors[0][0]))
            for word in words:
                self.assertIn(word, own[0])
        for part in load(folder, name, size):
            self.assertEqual(len(part["triangles"]), 0)

    def test_same_bytes_on_any_number_of_ranks(self):
        for size in SIZES:
            with self.subTest(ranks=size):
                folder = self.folder()
                start(size, ",".join(SAME), folder)
                self.assertEqual(self.names_in(folder), self.names_in(self.alone))
                for name in self.names_in(folder):
                    self.assert_same(folder, size, name)
                self.assertEqual(
                    state_in(folder / "splash.vdb"), state_in(self.alone / "splash.vdb")
                )

    def test_same_bytes_where_each_rank_has_a_part(self):
        alone = self.folder()
        start(0, ",".join(SHARED), alone)
        for size in (2, 3, 4, 7, 16):
            with self.subTest(ranks=size):
                folder = self.folder()
                start(size, ",".join(SHARED), folder)
                self.assertEqual(self.names_in(folder), self.names_in(alone))
                told = [list(part["warnings"]) for part in load(folder, "function", size)]
                self.assertIn("this rank's part", told[0][0])
                self.assertEqual(told[1:], [[]] * (size - 1), "the first rank says it for all")
                for name in self.names_in(folder):
                    if name == "function":
                        continue
                    self.assert_same(folder, size, name, alone)
                    whole = load(alone, name, 1)[0]["points"]
                    for part in load(folder, name, size):
                        numpy.testing.assert_array_equal(part["points"], whole[part["ids"]])
                for file in ("shared.vdb", "shared_skin.vdb"):
                    self.assertEqual(state_in(folder / file), state_in(alone / file), file)

    def test_shares_are_even_and_none_is_empty(self):
        folder = self.folder()
        start(3, "splash", folder)
        counts = [len(part["triangles"]) for part in load(folder, "splash_2", 3)]
        # Parts are divided between leaves, so they differ by about the triangles of a leaf at
        # either end.
        self.assertLess(max(counts) - min(counts), 600, counts)

    def test_points_at_borders_are_the_same_points(self):
        folder = self.folder()
        start(3, "splash", folder)
        whole = load(self.alone, "splash_2", 1)[0]["points"]
        parts = load(folder, "splash_2", 3)
        self.assertGreater(sum(len(part["ids"]) for part in parts), len(whole), "borders")
        for part in parts:
            numpy.testing.assert_array_equal(part["points"], whole[part["ids"]])

    def test_a_file_is_written_once_and_whole(self):
        expected = self.folder()
        start(0, "written", expected)
        folder = self.folder()
        start(3, "written", folder)
        self.assertEqual(state_in(folder / "written.vdb"), state_in(expected / "written.vdb"))
        for part in load(folder, "writes", 3):
            self.assertEqual(list(part["done"]), [1, 0])

    def test_restart_on_another_number_of_ranks(self):
        saved = self.folder()
        start(3, "splash", saved)
        expected = self.folder()
        (saved / "splash.vdb").rename(saved / "saved.vdb")
        shutil.copy(saved / "saved.vdb", expected)
        start(0, "restart", expected)
        for size in (1, 2, 4):
            with self.subTest(ranks=size):
                folder = self.folder()
                shutil.copy(saved / "saved.vdb", folder)
                start(size, "restart", folder)
                self.assert_same(folder, size, "restart_4", expected)

    def test_a_step_that_fails_on_one_rank(self):
        expected = self.folder()
        start(0, "failing_step", expected)  # the only rank is not rank 1
        for size in (2, 3):
            with self.subTest(ranks=size):
                folder = self.folder()
                start(size, "failing_step", folder)
                words = (f"On rank 1 of {size}: The update of ", " input failed")
                self.assert_failed(folder, "failed_4", size, *words)
                self.assert_failed(folder, "failed_3", size, *words)
                self.assert_same(folder, size, "before_2", expected)
                self.assert_same(folder, size, "mended_4", expected)
                self.assert_same(folder, size, "mended_3", expected)

    def test_information_that_fails_on_one_rank(self):
        expected = self.folder()
        start(0, "failing_information", expected)
        for size in (2, 3):
            with self.subTest(ranks=size):
                folder = self.folder()
                start(size, "failing_information", folder)
                words = (f"On rank 1 of {size}: The update of an input failed",)
                self.assert_failed(folder, "unknown_2", size, *words)
                self.assert_same(folder, size, "known_2", expected)

    def test_where_one_rank_is_killed_all_end(self):
        for size in (2, 3):
            with self.subTest(ranks=size):
                folder = self.folder()
                with self.assertRaisesRegex(RuntimeError, "(?i)signal:? 9"):
                    start(size, "killed", folder, longest=60)
                self.assertEqual(
                    self.names_in(folder), ["pid"], "nobody got to the end of the step"
                )
                for part in load(folder, "pid", size):
                    self.assertTrue(has_ended(int(part["pid"]), within=60))

    def test_a_file_that_one_rank_does_not_find(self):
        folder = self.folder()
        start(2, "missing_file", folder)
        self.assert_failed(folder, "no_file", 2, "On rank 0 of 2: ", "update of an input failed")
        self.assert_no_errors(folder, "a_file", 2)
        self.assertGreater(len(sorted_triangles(load(folder, "a_file", 2))), 100)

    def test_an_array_that_one_rank_does_not_have(self):
        folder = self.folder()
        start(3, "missing_array", folder)
        self.assert_failed(folder, "no_array", 3, "On rank 2 of 3: ", "no point array as chosen")

    def test_tables_of_which_none_has_a_column(self):
        expected = self.folder()
        start(0, "missing_columns", expected)
        sentence = sentence_of(load(expected, "no_columns.errors", 1)[0]["errors"][0])
        self.assertIn("column", sentence)
        folder = self.folder()
        start(2, "missing_columns", folder)
        self.assert_failed(folder, "no_columns", 2, sentence)
        self.assert_failed(folder, "few_columns", 2, "On rank 0 of 2: ", "column")

    def test_ranks_that_ask_for_different_things(self):
        folder = self.folder()
        start(3, "other_properties", folder)
        self.assert_failed(folder, "other_voxels", 3, "rank 2 has another value", "VoxelSize")
        self.assert_failed(folder, "other_times", 3, "rank 1 has another value", "the time")
        self.assert_failed(folder, "other_velocities", 3, "rank 1 has another value", "arrays")

    def test_a_state_that_one_rank_does_not_find(self):
        folder = self.folder()
        shutil.copy(self.alone / "splash.vdb", folder / "saved.vdb")
        start(2, "bad_state", folder)
        self.assertEqual([bool(part["loaded"]) for part in load(folder, "loaded", 2)], [False] * 2)

    def test_an_empty_start_has_the_reason_that_one_rank_has_seen(self):
        reasons = {
            "outside": "no surface within the bounds",
            "no_numbers": "not a finite number at any sampled point",
            "covered": "The obstacle covers the initial shape",
        }
        for size in (2, 3):
            folder = self.folder()
            start(size, "empty_starts", folder)
            for name in self.names_in(folder):
                said = load(folder, name + ".errors", size)
                texts = [text for part in said for text in part["warnings"]]
                with self.subTest(ranks=size, start=name):
                    self.assertEqual(len(texts), 1, "the first rank says it for all")
                    self.assertIn(reasons[name.rsplit("_", 1)[0]], texts[0])

    def test_a_source_without_pieces_is_told(self):
        folder = self.folder()
        start(2, "table,meshes,shared_walls", folder)
        for name in ("table_1", "meshes_0.3", "shared_walls_1"):
            said = [list(part["warnings"]) for part in load(folder, name + ".errors", 2)]
            told = [sum("CAN_HANDLE_PIECE_REQUEST" in text for text in own) for own in said]
            self.assertEqual(told, [1 if name == "table_1" else 0, 0], said)

    def test_what_one_rank_stops_all_stop(self):
        expected = self.folder()
        start(0, "aborted", expected)
        folder = self.folder()
        start(3, "aborted", folder)
        for part in load(folder, "aborted_2", 3):
            self.assertEqual(len(part["triangles"]), 0)
        self.assert_same(folder, 3, "resumed_2", expected)

    def test_a_change_upstream_of_one_rank(self):
        expected = self.folder()
        start(0, "changed_upstream", expected)
        folder = self.folder()
        start(2, "changed_upstream", folder)
        self.assert_same(folder, 2, "changed_2", expected)


if __name__ == "__main__":
    unittest.main()
