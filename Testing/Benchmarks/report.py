"""Compares the benchmarks' figures with the aims: a table, and everything as JSON.

Run: python3 report.py benchmarks.jsonl quick|full benchmarks.json

benchmarks.jsonl has an object on each line, as written by Measuring.h and particles.py. An aim is
met if the median of its least favourable case meets it. The table shows that case next to the most
favourable one, and both as measured for commit b67f7a4. A dash means that nothing was measured.
"""

import json
import os
import platform
import re
import sys
from dataclasses import dataclass
from pathlib import Path


@dataclass
class Aim:
    text: str
    limit: float
    part: str
    name: str
    case: str = ""
    threads: int = 1  # 0: all threads, on two cores or more
    at_most: bool = False
    before: str = "-"  # b67f7a4: least and most favourable case of quick runs

    def selects(self, row):
        threads_match = row["threads"] == self.threads or (
            self.threads == 0 and row["threads"] == os.cpu_count() != 1
        )
        return (
            threads_match
            and row["part"] == self.part
            and re.fullmatch(self.name, row["name"])
            and re.search(self.case, row["case"])
        )

    def judge(self, rows):
        found = sorted(row["median"] for row in rows if self.selects(row))
        if not found:
            return None
        worst, best = (found[-1], found[0]) if self.at_most else (found[0], found[-1])
        return worst, best, self.limit / worst if self.at_most else worst / self.limit


# "shrinks" is a motion by tension to the same time, at which our error is the smaller one. Source
# of `before`: Testing/README.md of b67f7a4. For morphs, `before` is of either scheme of substeps,
# for particles (SUM, without Transport, voxels of r and 0.5 r) of the faster scheme.
AIMS = [
    Aim(
        "default scheme [ns per active voxel, substep]",
        25,
        "tension",
        "default scheme",
        at_most=True,
        before="30-62",
    ),
    Aim(
        "tension, no target [ns per active voxel, substep]",
        5,
        "tension",
        "tension",
        at_most=True,
        before="14-27",
    ),
    Aim(
        "tension, times meanCurvature, defaults",
        100,
        "tension",
        "shrinks over .*defaults",
        before="77-100",
    ),
    Aim(
        "tension, times meanCurvature, cheapest",
        25,
        "tension",
        "shrinks over .*cheapest",
        before="22-28",
    ),
    Aim(
        "morph, times LevelSetMorphing, defaults",
        100,
        "morph",
        "morph over .*defaults",
        before="14-28",
    ),
    Aim(
        "morph, times LevelSetMorphing, cheapest",
        30,
        "morph",
        "morph over .*cheapest",
        before="7.5-13",
    ),
    Aim(
        "particles, times pysplashsurf",
        3,
        "particles",
        "frame over pysplashsurf",
        before="0.72-1.5",
    ),
    Aim("the same, all threads", 3, "particles", "frame over pysplashsurf", threads=0),
    Aim(
        "particles, times ParticlesToLevelSet",
        50,
        "particles",
        "frame over OpenVDB",
        before="8.6-12",
    ),
    Aim(
        "mesh, times vtkFlyingEdges3D",
        4,
        "skin",
        "skin over vtkFlyingEdges3D",
        "n = 256",
        before="3.2-4.0",
    ),
    Aim(
        "growth of time with n [exponent]",
        2.1,
        "growth",
        "exponent of time",
        at_most=True,
        before="2.2-2.4",
    ),
    Aim("2 threads, times one", 1.85, "growth", "2 threads over 1", threads=2, before="1.6-2.2"),
    Aim(
        "one of ten balls moves, times all moving",
        5,
        "parts",
        "90 % steady over all moving",
        before="5.0-6.0",
    ),
    Aim(
        "the same, under tension",
        5,
        "parts",
        "90 % steady under tension over all moving under tension",
        before="4.2-4.3",
    ),
    Aim(
        "memory at the peak [bytes per active voxel]",
        40,
        "growth",
        "memory at the peak",
        "(256|512)",
        at_most=True,
        before="59-66",
    ),
]


def machine():
    model = "unknown"
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            model = line.split(":", 1)[1].strip()
    return {
        "processor": model,
        "cores": os.cpu_count(),
        "load": os.getloadavg()[0],
        "system": platform.platform(),
    }


def main():
    source, size, target = sys.argv[1:]
    rows = [json.loads(line) for line in Path(source).read_text().splitlines()]
    judged = []
    print(f"\n{'work':54} {'aim':>8} {'b67f7a4':>9} {'measured':>9} {'at best':>9}  ")
    for aim in AIMS:
        relation = "<=" if aim.at_most else ">="
        line = f"{aim.text:54} {relation}{aim.limit:6g} {aim.before:>9}"
        verdict = aim.judge(rows)
        if not verdict:
            print(f"{line} {'-':>9}")
            continue
        worst, best, factor = verdict
        met = f"met, {factor:.2f} x" if factor >= 1 else f"not met, by {1 / factor:.2f} x"
        print(f"{line} {worst:9.3g} {best:9.3g}  {met}")
        judged.append({"aim": aim.text, "limit": aim.limit, "measured": worst, "factor": factor})
    where = machine()
    print("\non {processor}, {cores} core(s), load {load:.1f}".format(**where))
    result = {"size": size, "machine": where, "aims": judged, "figures": rows}
    Path(target).write_text(json.dumps(result, indent=1))
    print(f"all figures: {target}")


if __name__ == "__main__":
    main()
