# ctest: LABELS contract long TIMEOUT 3600
"""Random scenes, properties and orders of requests: skins are valid and errors are messages.
However a filter came to a time, its bytes are those of a new one.

The seed is printed. A failed case is printed as a short program of which no part can be omitted.
Cases run in separate processes, so that a crash or a hang is a failure like others.

Run: python3 test_random.py [--cases N] [--seed N] [--jobs N]
ACTIVE_RANDOM_CASES in the environment is another number of cases.
"""

import argparse
import os
import pprint
import re
import subprocess
import sys
from ast import literal_eval
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from random import Random

from random_cases import draw_case, minimise

HERE = Path(__file__).resolve().parent
CASES = 300
BLOCK = 50  # cases per process
SEED = 20261122

# Cases of fixed defects, with their causes.
FOUND = (
    # A penalty removed new parts in each substep, and each substep created them again.
    {
        "target": ("emitter", 704501),
        "obstacle": ("some_balls", 446754),
        "properties": {"Attraction": 1.0, "AreaControl": 1, "Tension": 0.0, "ParticleModel": 1},
        "operations": [("time", 0.8336629540096793)],
    },
    # A first time step that failed was treated as available, and empty.
    {
        "target": ("unmatched_particles", 29845),
        "operations": [("fail", 0.522947349948669), ("time", 0.7082218516460795)],
    },
    # Pieces other than the first got the time of the input's step, or a time beyond the last one,
    # instead of the requested time.
    {
        "target": ("unmatched_particles", 754407),
        "operations": [("piece", 1.0, 1, 3), ("time", 0.8)],
    },
    {
        "target": ("emitter", 829168),
        "operations": [("time", 0.25), ("piece", 0.25, 1, 3), ("time", 0.5)],
    },
    # The first step was empty, so no skin was expected, but a skin of size 1e-31 appeared.
    {"target": ("births_and_deaths", 410836), "operations": [("time", 0.25)]},
    {
        "target": ("births_and_deaths", 549585),
        "properties": {"ParticleModel": 0},
        "operations": [("time", 0.1)],
    },
    # After a failure of the input, the skin function was not that of the kept skin.
    {
        "target": ("moving_skeleton", 451632),
        "operations": [("save and load",), ("fail", 1.0), ("time", 0.0)],
    },
    # An interrupted motion was resumed although its target had been rebuilt when the kind of input
    # became known.
    {
        "target": ("table", 548627),
        "initial": ("an_ellipsoid", 407916),
        "properties": {
            "Attraction": 1,
            "PassTargetArrays": 1,
            "ArrivalTime": 0.15,
            "GradientScheme": 1,
            "TimeIntegration": 0,
            "ParticleModel": 1,
            "ParticleSpacing": 0.2,
        },
        "operations": [
            ("piece", 0.6900032225195295, 1, 3),
            ("put", "TimeStepSize", 0.3),
            ("put", "CheckpointMemory", 0),
            ("time", 0.5),
            ("no file", 0.30000000000000004),
            ("time", 1.0),
            ("time", 0.7769081287213302),
        ],
    },
    # After a state was loaded, the spacing was estimated from another step than before.
    {
        "target": ("blocks", 518),
        "properties": {"ModelBounds": (-1.0, 1.0, -1.0, 1.0, -1.0, 1.0)},
        "operations": [("time", 0.6832981095362682), ("save and load",), ("time", 0.25)],
    },
    # The state of a vanished skin could be saved, but not loaded.
    {
        "target": ("a_ball", 281445),
        "properties": {"TargetIsoValue": -1.0, "ModelBounds": (-1.0, 1.0, -1.0, 1.0, -1.0, 1.0)},
        "operations": [("time", 0.6), ("save and load",), ("time", 0.78)],
    },
    # With two empty steps, the motion depended on whether later steps had been read.
    {
        "target": ("births_and_deaths", 632483),
        "initial": ("a_mesh", 830424),
        "properties": {"TargetIsoValue": -0.03, "ParticleSpacing": 0.2},
        "operations": [("time", 1.0), ("time", 0.25)],
    },
    # With EQUILIBRIUM a first time step that failed was treated as available, and empty.
    {
        "target": ("births_and_deaths", 786125),
        "properties": {"TimeScale": 3.0},
        "operations": [
            ("fail", 0.25),
            ("put", "EvolutionMode", 1),
            ("time", 0.4844346128063809),
        ],
    },
    # After an error about too many active voxels, the next request had a skin and no error.
    {
        "target": ("unmatched_particles", 607979),
        "properties": {"InvertTarget": 1},
        "operations": [("time", 1.0), ("time", 0.9)],
    },
    # With Transport and evaluation at nodes, the number of ghosts was limited, but not after
    # loading a state.
    {
        "target": ("table", 910850),
        "initial": ("some_balls", 251552),
        "properties": {
            "TargetEvaluation": 1,
            "CFL": 0.3,
            "ParticleModel": 1,
            "ParticleSpacing": 0.3,
            "ComputeVelocity": 1,
        },
        "operations": [("time", 0.75), ("save and load",), ("time", 0.9885261906695527)],
    },
    # A bound meant for the node scheme changed restored values beyond 1000 voxels.
    {
        "target": ("skeleton", 786669),
        "properties": {
            "ParticleModel": 1,
            "TargetEvaluation": 1,
            "CheckpointInterval": 1,
            "ComputeVelocity": 1,
        },
        "operations": [("time", 0.9), ("time", 0.75)],
    },
)

PROGRAM = """
# PYTHONPATH=<folder of the package>:Testing/Python python3 this.py
from random_checks import check

check({case})
"""


def try_cases(cases):
    """(case, failure or empty text, counts) of each case. If a process ends, a new one continues
    with the next case."""
    left = list(cases)
    while left:
        done, log = run_program(left)
        for case, (failure, counts) in zip(left, done):
            yield case, failure, counts
        if len(done) < len(left):
            yield left[len(done)], f"the program ended: {log}", {}
        left = left[len(done) + 1 :]


def run_program(cases):
    """Returns the results that the program printed for the cases, and how it ended."""
    ran = subprocess.run(
        [sys.executable, str(HERE / "random_program.py")],
        input="\n".join(map(repr, cases)),
        capture_output=True,
        text=True,
        check=False,
    )
    told = [line[2:] for line in ran.stdout.splitlines() if line.startswith("> ")]
    return [literal_eval(line) for line in told], f"status {ran.returncode}, {ran.stderr[-2000:]}"


def kind_of(failure):
    """Returns the first words of a failure, without numbers."""
    return re.sub(r"-?[\d.]+|\b[0-9a-f]{64}\b", "N", " ".join(failure.split()[:8]))


def report(case, failure):
    """Prints a reduced case that fails likewise, as a program."""

    def fails(other):
        return any(kind_of(told) == kind_of(failure) for _, told, _ in try_cases([other]))

    least = minimise(case, fails)
    failure = next(told for _, told, _ in try_cases([least]))
    text = pprint.pformat(least, width=90, sort_dicts=False)
    print(f"\n{failure}\n{PROGRAM.format(case=text)}", flush=True)


def try_all(cases, jobs):
    blocks = [cases[i : i + BLOCK] for i in range(0, len(cases), BLOCK)]
    failures, sums = [], {}
    with ThreadPoolExecutor(jobs) as pool:
        for block in pool.map(lambda block: list(try_cases(block)), blocks):
            for case, failure, counts in block:
                failures += [(case, failure)] if failure else []
                for name, count in counts.items():
                    sums[name] = sums.get(name, 0) + count
    return failures, sums


def main():
    parser = argparse.ArgumentParser()
    wanted = int(os.environ.get("ACTIVE_RANDOM_CASES", CASES))
    parser.add_argument("--cases", type=int, default=wanted)
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--jobs", type=int, default=1)
    options = parser.parse_args()
    print(f"{options.cases} cases of seed {options.seed}", flush=True)
    random = Random(options.seed)
    nothing = {"initial": None, "obstacle": None, "properties": {}}
    cases = [{**nothing, **found} for found in FOUND]
    cases += [draw_case(random) for _ in range(options.cases)]
    failures, sums = try_all(cases, options.jobs)
    print(f"{len(failures)} failures; {sums}", flush=True)
    for case, failure in failures:
        print(f"{failure.splitlines()[0]}: {case}", flush=True)
    told = set()
    for case, failure in failures:
        if kind_of(failure) not in told:
            told.add(kind_of(failure))
            report(case, failure)
    few = not failures and sums["skins"] < 0.6 * sums["requests"]
    if few:
        print("Less than 60 % of the requests show a skin: the cases are of little use.")
    sys.exit(bool(failures or few))


if __name__ == "__main__":
    main()
