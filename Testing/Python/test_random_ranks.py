# ctest: LABELS contract long TIMEOUT 900
"""Ranks make the skins of one process, of random particles, properties and distributions.

Run: python3 test_random_ranks.py [--cases <each>] [--seed <first>] [--sizes <ranks> ...]. A failure
names the seed, the case, which random_ranks_program.py draws from it, and the number of ranks.
Skipped without MPI, see with_ranks.
"""

import argparse
import sys
import tempfile
import unittest
from pathlib import Path

from ranks import load
from ranks_checks import assert_same_outputs, start_ranks

PROGRAM = Path(__file__).with_name("random_ranks_program.py")
AT_ONCE = 10  # cases of one program
LONGEST = 600  # seconds of these

OPTIONS = argparse.Namespace(cases=10, seed=1, sizes=[2, 3])


def start(size, seed, cases, folder):
    start_ranks(PROGRAM, size, [seed, cases, folder], LONGEST)


class RandomRanks(unittest.TestCase):
    def folder(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        return Path(folder.name)

    def assert_same_errors(self, kept, alone):
        for part in kept:
            self.assertEqual(bool(len(part["errors"])), bool(len(alone[0]["errors"])), kept)

    def try_seed(self, seed, cases):
        alone = self.folder()
        start(1, seed, 0, alone)  # or all are skipped
        start(0, seed, cases, alone)
        skins = 0
        for size in OPTIONS.sizes:
            folder = self.folder()
            start(size, seed, cases, folder)
            for case in range(cases):
                for name in (f"{case}_0", f"{case}_1"):
                    with self.subTest(seed=seed, case=case, request=name, ranks=size):
                        expected = load(alone, name, 1)
                        assert_same_outputs(self, load(folder, name, size), expected, name)
                        self.assert_same_errors(
                            load(folder, name + ".errors", size), load(alone, name + ".errors", 1)
                        )
                        skins += len(expected[0]["triangles"]) > 0
        return skins

    def test_same_bytes(self):
        skins = 0
        for first in range(0, OPTIONS.cases, AT_ONCE):
            cases = min(AT_ONCE, OPTIONS.cases - first)
            skins += self.try_seed(OPTIONS.seed + first // AT_ONCE, cases)
        requests = 2 * OPTIONS.cases * len(OPTIONS.sizes)
        print(f"{skins} skins of {requests} requests, from seed {OPTIONS.seed} on", flush=True)
        self.assertGreater(skins, requests / 4, "skins of nothing prove nothing")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--cases", type=int, default=OPTIONS.cases)
    parser.add_argument("--seed", type=int, default=OPTIONS.seed)
    parser.add_argument("--sizes", type=int, nargs="+", default=OPTIONS.sizes)
    OPTIONS, rest = parser.parse_known_args()
    unittest.main(argv=[sys.argv[0], *rest])
