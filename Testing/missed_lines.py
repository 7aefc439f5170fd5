"""Lists the lines and branches that the tests do not reach, from a JSON file of llvm-cov.

Run: python3 missed_lines.py coverage.json

A line of the list is a file and a range of lines that never ran, or a line and a result that a
condition there never had, in any instance of a template. The last lines are llvm-cov's totals.
"""

import json
import os
import sys
from itertools import groupby
from pathlib import Path


def count_lines(segments):
    """Number of executions of each line with code in a file."""
    counts = {}
    before = None
    by_line = {line: list(group) for line, group in groupby(segments, key=lambda s: s[0])}
    for line in range(min(by_line, default=1), max(by_line, default=0) + 1):
        here = by_line.get(line, [])
        starts = [
            count
            for _, _, count, has_count, is_entry, is_gap in here
            if has_count and is_entry and not is_gap
        ]
        is_skipped = here and not here[0][3] and here[0][4]
        wraps = before is not None and before[3]
        if not is_skipped and (wraps or starts):
            counts[line] = max([before[2] if wraps else 0, *starts])
        before = here[-1] if here else before
    return counts


def count_branches(branches):
    """Numbers of true and false results of each condition, by its place."""
    counts = {}
    for first_line, first_column, last_line, last_column, true, false, *_ in branches:
        place = first_line, first_column, last_line, last_column
        before = counts.get(place, (0, 0))
        counts[place] = before[0] + true, before[1] + false
    return counts


def join_ranges(lines):
    """Line numbers as texts, consecutive ones as one range."""
    texts = []
    for _, group in groupby(enumerate(lines), key=lambda pair: pair[1] - pair[0]):
        numbers = [number for _, number in group]
        texts.append(f"{numbers[0]}-{numbers[-1]}" if len(numbers) > 1 else f"{numbers[0]}")
    return texts


def list_missed(name, entry):
    lines = count_lines(entry["segments"])
    missed = [line for line, count in lines.items() if count == 0]
    for text in join_ranges(missed):
        yield f"{name}:{text}: never ran"
    for (line, column, *_), counts in sorted(count_branches(entry["branches"]).items()):
        if not lines.get(line) or not any(counts):
            continue  # listed already, constant at compile time, or never evaluated
        for result, count in zip(("true", "false"), counts):
            if count == 0:
                yield f"{name}:{line}: column {column} was never {result}"


def main():
    data = json.loads(Path(sys.argv[1]).read_text())["data"][0]
    for entry in sorted(data["files"], key=lambda entry: entry["filename"]):
        for text in list_missed(os.path.relpath(entry["filename"]), entry):
            print(text)
    for kind in ("lines", "branches"):
        total = data["totals"][kind]
        print(f"{kind}: {total['count']}, {total['percent']:.1f} % reached")


if __name__ == "__main__":
    main()
