# ctest: LABELS contract long TIMEOUT 3600
"""Many operations on one filter on ranks; some abort or fail on one rank, or are refused by all.
The skins have the bytes of a new filter in one process.

Run: python3 test_ranks_endurance.py [--operations N] [--seed N]
Each 50 operations have their own filter, seed and number of ranks, which are printed. Skipped where
there is no MPI, see with_ranks. ACTIVE_RANDOM_CASES in the environment is another number of
operations.
"""

import argparse
import os
import sys
import unittest
from ast import literal_eval
from collections import Counter
from pathlib import Path
from random import Random

from ranks_checks import start_ranks

PROGRAM = Path(__file__).with_name("ranks_endurance_program.py")
AT_ONCE = 50  # operations of one program
ENOUGH = 300  # operations that hold every kind of trouble
LONGEST = 900  # seconds of these
SIZES = (2, 3, 4)

OPTIONS = argparse.Namespace(
    operations=int(os.environ.get("ACTIVE_RANDOM_CASES", ENOUGH)), seed=20261125
)


class RanksEndurance(unittest.TestCase):
    def test_many_operations_leave_no_trace(self):
        sums = Counter()
        for first in range(0, OPTIONS.operations, AT_ONCE):
            seed = OPTIONS.seed + first // AT_ONCE
            size = Random(seed).choice(SIZES)
            operations = min(AT_ONCE, OPTIONS.operations - first)
            print(f"{operations} operations of seed {seed} on {size} ranks", flush=True)
            said = start_ranks(PROGRAM, size, [seed, operations], LONGEST)
            sums.update(literal_eval(said.split("counts: ")[1].splitlines()[0]))
        print(dict(sums), flush=True)
        if OPTIONS.operations >= ENOUGH:
            for kind in ("refused", "stopped", "failed"):
                self.assertGreater(sums[kind], 0, kind)
        self.assertGreater(sums["skins"], sums["requests"] // 3, "skins of nothing prove nothing")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--operations", type=int, default=OPTIONS.operations)
    parser.add_argument("--seed", type=int, default=OPTIONS.seed)
    OPTIONS, rest = parser.parse_known_args()
    unittest.main(argv=[sys.argv[0], *rest])
