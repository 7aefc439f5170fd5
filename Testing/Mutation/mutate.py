"""Finds deleted statements and flipped conditions of Filters that no test detects.

    python3 Testing/Mutation/mutate.py --count 300 --seed 1 | tee survivors.txt
    python3 Testing/Mutation/mutate.py --again survivors.txt

Copies the tree to build/mutants, draws mutants at random, and compiles all of them at once. A
mutant is active only if the environment variable ACTIVE_MUTANT is its number. Every test runs once
to find the mutants that it reaches. Then each mutant runs the tests that reach it, fastest first,
until one fails.

Prints the survivors, and mutants that only a time-out detects. Needs the packages of Testing/run,
and about an hour.

With --again only the mutants of an earlier output are tried, as far as the sources still contain
their statements.
"""

import argparse
import json
import os
import random
import re
import shutil
import subprocess
import time
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TREE = ROOT / "build" / "mutants"
BUILD = TREE / "build" / "release"
# Files that no result depends on, or whose mutants would only fail to compile.
LEFT_OUT = {"CompilerBuiltins.h", "InstructionSets.h", "InstructionSets.cxx", "OpenVDB.h"}

HEADER = """#ifndef ActiveMutant_h
#define ActiveMutant_h
#include <cstdio>
#include <cstdlib>
struct ActiveMutants
{
  int Awake = std::getenv("ACTIVE_MUTANT") ? std::atoi(std::getenv("ACTIVE_MUTANT")) : -1;
  bool Reached[COUNT] = {};
  ~ActiveMutants()
  {
    const char* log = std::getenv("ACTIVE_MUTANT_LOG");
    if (std::FILE* file = log ? std::fopen(log, "a") : nullptr)
    {
      for (int i = 0; i < COUNT; ++i)
      {
        Reached[i] ? std::fprintf(file, "%d\\n", i) : 0;
      }
      std::fclose(file);
    }
  }
};
inline ActiveMutants AllMutants;
__attribute__((always_inline)) inline bool ActiveMutant(int number)
{
  AllMutants.Reached[number] = true;
  return number == AllMutants.Awake;
}
#endif
"""

CONDITION = re.compile(r"^(\s+(?:else )?if \()(?!.*\b(?:auto|const|constexpr)\b)(.*)(\))$")
STATEMENT = re.compile(
    r"^(\s+)((?:\+\+|--)?[\w:.>\-\[\]()*]+(?: (?:[-+*/|&]?=) .*|\(.*\)|\+\+|--)?;)$"
)
NOT_A_STATEMENT = re.compile(
    r"^\s+(return|throw|using|break|continue|static|case|default|delete|friend|virtual|goto)\b"
    r"|^\s+(std::)?\w+(::\w+)*(<.*>)?[&*]* [\w]+( =|\(|\{|;)|static_cast<void>|\) (const|override);"
)
ENDS_A_STATEMENT = re.compile(r"([;{}]|^\s*//.*|:)$")

UNNOTICED = "no test notices"
UNREACHED = "no test reaches it"
TIMED_OUT = "only a time-out"
KILLED = "killed"
LISTED = re.compile(rf"^(Filters/\S+):(\d+): (?:{UNNOTICED}|{UNREACHED}|{TIMED_OUT}): (.*)$", re.M)
# A mutant that hangs would hang in each test that reaches it.
MOST_TIME_OUTS = 3
TIME_OUT = "timed out"  # replaces an exit status


def find_candidates(path):
    """(line number, line with @ for the mutant's number) of each candidate."""
    lines = path.read_text(encoding="utf-8").split("\n")
    constant = False
    for i, line in enumerate(lines):
        if re.match(r"^\s*(static |inline )*constexpr .*\(", line):
            constant = True
        if re.match(r"^(  )?}", line):
            constant = False
        if constant or not line.startswith("  "):
            continue
        before = next((x for x in reversed(lines[:i]) if x.strip()), "")
        condition = CONDITION.match(line)
        statement = STATEMENT.match(line)
        if condition:
            yield i, f"{condition[1]}ActiveMutant(@) != bool({condition[2]}){condition[3]}"
        elif statement and not NOT_A_STATEMENT.search(line) and ENDS_A_STATEMENT.search(before):
            yield i, f"{statement[1]}if (!ActiveMutant(@)) {{ {statement[2]} }}"


def find_all_candidates():
    sources = [
        path
        for path in sorted((ROOT / "Filters").rglob("*"))
        if path.suffix in (".h", ".cxx")
        and path.name not in LEFT_OUT
        # VTK's wrappers parse these headers, but could not parse the code of mutants.
        and not (path.name.startswith("vtk") and path.suffix == ".h")
    ]
    return [
        (path.relative_to(ROOT), line, text)
        for path in sources
        for line, text in find_candidates(path)
    ]


def as_mutants(candidates):
    return [{"file": str(f), "line": n, "text": t} for f, n, t in sorted(candidates)]


def draw(count, seed):
    candidates = find_all_candidates()
    chosen = random.Random(seed).sample(candidates, min(count, len(candidates)))
    print(f"{len(candidates)} candidates, {len(chosen)} drawn with seed {seed}", flush=True)
    return as_mutants(chosen)


def find_again(listing):
    """Mutants of an earlier output; among equal statements of a file, the nearest to the line."""
    candidates = find_all_candidates()
    chosen = set()
    for file, line, text in LISTED.findall(Path(listing).read_text(encoding="utf-8")):
        same = [c for c in candidates if str(c[0]) == file and c[2].strip() == text]
        if same:
            chosen.add(min(same, key=lambda c: abs(c[1] + 1 - int(line))))
        else:
            print(f"{file}:{line}: gone: {text}", flush=True)
    return as_mutants(chosen)


def write_tree(mutants, dropped):
    # The list includes new files, which are in no commit yet.
    listing = ["git", "-C", ROOT, "ls-files", "--cached", "--others", "--exclude-standard"]
    names = subprocess.check_output(listing, text=True).split("\n")
    for name in filter(None, names):
        source, target = ROOT / name, TREE / name
        if source.is_file() and not (
            target.is_file() and target.read_bytes() == source.read_bytes()
        ):
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, target)
    (TREE / "Filters/LevelSet/ActiveMutant.h").write_text(
        HEADER.replace("COUNT", str(len(mutants)))
    )
    by_file = defaultdict(list)
    for number, mutant in enumerate(mutants):
        if number not in dropped:
            by_file[mutant["file"]].append((number, mutant))
    for name, own in by_file.items():
        lines = (ROOT / name).read_text(encoding="utf-8").split("\n")
        for number, mutant in own:
            lines[mutant["line"]] = mutant["text"].replace("@", str(number))
        first = next(i for i, line in enumerate(lines) if line.startswith("#include "))
        header = TREE / "Filters/LevelSet/ActiveMutant.h"
        lines[first] = f'#include "{header}"\n#line {first + 1}\n{lines[first]}'
        (TREE / name).write_text("\n".join(lines), encoding="utf-8")


def build(mutants):
    """Compiles; returns the numbers of the mutants that do not compile."""
    dropped = set()
    while True:
        write_tree(mutants, dropped)
        if not (BUILD / "build.ninja").exists():
            subprocess.run(["cmake", "--preset", "release"], cwd=TREE, check=True)
        done = subprocess.run(
            ["ninja", "-C", BUILD, "-k0"], capture_output=True, text=True, check=False
        )
        if done.returncode == 0:
            return dropped
        errors = set(re.findall(r"(Filters/[\w/.]+):(\d+):\d+: error", done.stdout))
        found = {
            number
            for number, mutant in enumerate(mutants)
            if (mutant["file"], str(mutant["line"] + 1)) in errors
        } - dropped
        if not found:
            raise SystemExit(done.stdout[-4000:])
        dropped |= found


def list_tests():
    """name: (command, environment) of the tests that need nothing installed or displayed."""
    text = subprocess.check_output(["ctest", "--test-dir", BUILD, "--show-only=json-v1"], text=True)
    tests = {}
    for test in json.loads(text)["tests"]:
        properties = {p["name"]: p["value"] for p in test["properties"]}
        command = test.get("command", [])
        is_plain = command and "with_display" not in " ".join(command)
        if is_plain and not any(k.startswith("FIXTURES") for k in properties):
            environment = dict(e.split("=", 1) for e in properties.get("ENVIRONMENT", []))
            tests[test["name"]] = (command, environment)
    return tests


def run(test, more, limit):
    """(exit status, seconds)."""
    command, environment = test
    begin = time.monotonic()
    try:
        done = subprocess.run(
            command,
            env={**os.environ, **environment, **more},
            cwd=BUILD,
            capture_output=True,
            timeout=limit,
            check=False,
        )
        return done.returncode, time.monotonic() - begin
    except subprocess.TimeoutExpired:
        return TIME_OUT, time.monotonic() - begin


def find_reach(tests, pool):
    """mutant: [(seconds, test)] of the passing tests that reach it."""
    logs = TREE / "logs"
    shutil.rmtree(logs, ignore_errors=True)
    logs.mkdir()

    def reach(name):
        status, seconds = run(tests[name], {"ACTIVE_MUTANT_LOG": str(logs / name)}, 600)
        return name, status, seconds

    reached = defaultdict(list)
    for name, status, seconds in pool.map(reach, tests):
        if status != 0:
            print(f"{name} fails by itself and is left out", flush=True)
        elif (logs / name).exists():
            for number in set((logs / name).read_text().split()):
                reached[int(number)].append((seconds, name))
    return reached


def try_mutant(number, tests, reached):
    time_outs = 0
    for seconds, name in sorted(reached[number]):
        status, _ = run(tests[name], {"ACTIVE_MUTANT": str(number)}, 10 + 5 * seconds)
        if status not in (0, TIME_OUT):
            return KILLED
        time_outs += status == TIME_OUT
        if time_outs == MOST_TIME_OUTS:
            break
    if time_outs:
        return TIMED_OUT
    return UNNOTICED if reached[number] else UNREACHED


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--count", type=int, default=300, help="mutants (default: %(default)s)")
    parser.add_argument("--seed", type=int, default=1, help="of the draw (default: %(default)s)")
    parser.add_argument("--again", metavar="FILE", help="only those that an earlier output lists")
    options = parser.parse_args()
    mutants = find_again(options.again) if options.again else draw(options.count, options.seed)
    dropped = build(mutants)
    tests = list_tests()
    print(f"{len(dropped)} do not compile; {len(tests)} tests", flush=True)
    alive = [number for number in range(len(mutants)) if number not in dropped]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        reached = find_reach(tests, pool)
        verdicts = list(pool.map(lambda n: try_mutant(n, tests, reached), alive))
    for number, verdict in zip(alive, verdicts):
        if verdict != KILLED:
            mutant = mutants[number]
            print(f"{mutant['file']}:{mutant['line'] + 1}: {verdict}: {mutant['text'].strip()}")
    survivors = sum(verdict in (UNNOTICED, UNREACHED) for verdict in verdicts)
    share = 100.0 * survivors / max(len(alive), 1)
    source = f"of {options.again}" if options.again else f"seed {options.seed}"
    print(f"{survivors} of {len(alive)} mutants survive ({share:.1f} %), {source}")
    print(f"{verdicts.count(TIMED_OUT)} more are noticed by nothing but a time-out")


if __name__ == "__main__":
    main()
