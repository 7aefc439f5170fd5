"""Random operations of test_ranks_endurance.py on one filter.

Run under mpiexec: python3 ranks_endurance_program.py <seed> <operations>
"""

import os
import sys
import traceback
from random import Random

from random_cases import draw_case, draw_operation, draw_time, draw_trouble
from ranked_case import RankedCase
from ranks import begin

IN_A_ROW = 10  # operations between two comparisons
ON_A_SCENE = 50
TROUBLES = 0.2  # the share of what is aborted, fails or is refused, besides that of any operations


def try_scene(random, ranks, operations):
    scene = draw_case(random)
    said = {name: value for name, value in scene.items() if name != "operations"}
    done = []
    try:
        case = RankedCase(said, ranks, random)
        for count in range(1, operations + 1):
            draw = draw_trouble if random.random() < TROUBLES else draw_operation
            done.append(draw(random))
            case.do(*done[-1])
            if count % IN_A_ROW == 0:
                if random.random() < 0.5:
                    case.set_back(said)
                case.request(draw_time(random))
                case.check_fresh()
    except Exception:
        print(f"Rank {ranks.rank} of {ranks.size}, in {said}, after {done}:", flush=True)
        traceback.print_exc()
        sys.stderr.flush()
        ranks.Abort(1)  # or the others would wait
        os._exit(1)
    return case.counts


def main():
    seed, operations = (int(word) for word in sys.argv[1:])
    ranks = begin(False)
    random = Random(seed)
    sums = {}
    for first in range(0, operations, ON_A_SCENE):
        counts = try_scene(random, ranks, min(ON_A_SCENE, operations - first))
        sums = {name: sums.get(name, 0) + count for name, count in counts.items()}
    if ranks.rank == 0:
        print(f"counts: {sums}", flush=True)


if __name__ == "__main__":
    main()
