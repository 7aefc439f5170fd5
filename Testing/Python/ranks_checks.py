"""Starts programs on ranks, and compares their outputs with those of one process."""

import subprocess
import sys
import unittest
from pathlib import Path

import numpy
from ranks import sorted_triangles, whole_image

WITH_RANKS = Path(__file__).resolve().parents[1] / "with_ranks"
NO_MPI = 77  # by with_ranks


def start_ranks(program, size, arguments, longest):
    """Runs a program on `size` ranks, which share the cores; if `size` is 0, without MPI (--alone).

    Fails after `longest` seconds, since ranks may wait for each other for ever.
    """
    command = [sys.executable, str(program), *map(str, arguments)]
    with subprocess.Popen(
        ["bash", str(WITH_RANKS), str(size), *command] if size else [*command, "--alone"],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    ) as started:
        try:
            said, _ = started.communicate(timeout=longest)
        except subprocess.TimeoutExpired:
            started.terminate()  # by which mpiexec ends its ranks; it would not, if it were killed
            raise
    if started.returncode == NO_MPI:
        raise unittest.SkipTest(said)
    if started.returncode != 0:
        raise RuntimeError(f"{command[1:]} on {size} ranks: {said[-4000:]}")
    return said


def assert_same_outputs(test, kept, alone, of):
    """Checks that the ranks' outputs, joined, are those of the program without MPI."""
    test.assertTrue(sorted_triangles(kept) == sorted_triangles(alone), f"triangles of {of}")
    test.assertEqual(list(kept[0]["history"]), list(alone[0]["history"]), f"history of {of}")
    for other in kept[1:]:
        test.assertEqual(len(other["history"]), 0, "the first rank has the rows")
    if alone[0]["potential"].size:
        extent = alone[0]["extent"]
        numpy.testing.assert_array_equal(
            whole_image(kept, extent), whole_image(alone, extent), f"image of {of}"
        )
