# ctest: LABELS contract
"""Results stay bitwise identical: many runs have the hashes of Baselines/hashes.json.

All runs use one thread; a few short ones also use two threads and every instruction set.

Run: python3 test_same_bytes.py. After an intended change:
python3 test_same_bytes.py --write, with the reason in the commit.
python3 test_same_bytes.py --print [<run>...] prints names and hashes.
"""

import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

import same_bytes_motion  # noqa: F401
import same_bytes_outputs  # noqa: F401
import same_bytes_targets  # noqa: F401
from same_bytes import RUNS, THREADS, hash_of

TABLE = Path(__file__).resolve().parents[1] / "Baselines" / "hashes.json"
# Group of runs whose meshes go through OpenVDB's meshToVolume: other versions may differ.
BY_OPENVDB = "meshes by OpenVDB"
OPENVDB = 10
# Runs that cover all kernels, for each number of threads and each instruction set.
SHORT = """
    particles_with_radii_and_strengths particles_of_every_kernel_and_threshold skeleton mesh
    image_of_samples parts_split with_tension paper_faithful volume_exactly rest_under_tension
    target_evaluation_at_closest_points skeleton_potential_of_lines curvature_and_velocity
    arrays_of_the_particles particles_of_anisotropic_kernels
""".split()


def openvdb_version():
    try:
        import pyopenvdb as module
    except ImportError:
        try:
            import openvdb as module
        except ImportError:
            return None
    return module.LIBRARY_VERSION[0]


def expected_hashes():
    groups = json.loads(TABLE.read_text())
    return {name: hashed for group in groups.values() for name, hashed in group.items()}


def write_table():
    groups = {}
    for name, (group, _) in RUNS.items():
        groups.setdefault(group, {})[name] = hash_of(name)
    TABLE.write_text(json.dumps(groups, indent=1) + "\n")


def print_hashes(names):
    for name in names or RUNS:
        try:
            print(name, hash_of(name), flush=True)
        except Exception as error:  # a failed run is a difference too; the others continue
            print(name, f"{type(error).__name__}: {error}", flush=True)


def hashes_with(instruction_set):
    """Hashes of the short runs, in a separate process: the set is chosen when the library loads."""
    said = subprocess.run(
        [sys.executable, __file__, "--print", *SHORT],
        env={**os.environ, "ACTIVE_INSTRUCTION_SET": instruction_set},
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    return dict(line.split(" ", 1) for line in said.splitlines())


class SameBytes(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        self.expected = expected_hashes()
        self.addCleanup(THREADS.update, THREADS)

    def test_every_run_is_in_the_table(self):
        self.assertEqual(sorted(RUNS), sorted(self.expected))

    def test_hashes_are_those_of_the_table(self):
        THREADS["number"] = 1
        for name, (group, _) in RUNS.items():
            if group == BY_OPENVDB and openvdb_version() != OPENVDB:
                continue
            with self.subTest(group=group, run=name):
                self.assertEqual(hash_of(name), self.expected[name])

    def test_two_threads_make_the_same_bytes(self):
        THREADS["number"] = 2
        for name in SHORT:
            with self.subTest(name):
                self.assertEqual(hash_of(name), self.expected[name])

    def test_every_instruction_set_makes_the_same_bytes(self):
        expected = {name: self.expected[name] for name in SHORT}
        for instruction_set in ("sse2", "avx2", "avx512"):
            with self.subTest(instruction_set):
                self.assertEqual(hashes_with(instruction_set), expected)

    def test_checkpoints_do_not_change_the_bytes(self):
        name = "times_back_and_forth"
        for way in ("without_checkpoints", "with_every_checkpoint", "without_memory"):
            self.assertEqual(self.expected[f"{name}_{way}"], self.expected[name], way)

    def test_no_two_other_runs_are_the_same(self):
        others = [name for name in self.expected if not name.startswith("times_back_and_forth_")]
        self.assertEqual(len({self.expected[name] for name in others}), len(others))


if __name__ == "__main__":
    if sys.argv[1:2] == ["--write"]:
        write_table()
    elif sys.argv[1:2] == ["--print"]:
        print_hashes(sys.argv[2:])
    else:
        unittest.main()
