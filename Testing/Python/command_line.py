"""Runs active-surface within this process, and makes data for it."""

import contextlib
import io
import os
import tempfile
import unittest
from pathlib import Path

import numpy
from active_implicit_surfaces import commands

DROP = Path(__file__).resolve().parents[1] / "Data" / "sph_drop.vtp"


class Outcome:
    def __init__(self, *arguments):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            self.code = commands.main([str(argument) for argument in arguments])
        self.out, self.err = out.getvalue(), err.getvalue()


class CommandTest(unittest.TestCase):
    """Each test has a folder of its own, which is the working directory."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)  # default output folder

    def succeed(self, *arguments):
        outcome = Outcome(*arguments)
        self.assertEqual(outcome.code, 0, outcome.err)
        return outcome

    def fail_with(self, code, *arguments):
        """Returns the error message of a command that has to fail with this one message."""
        outcome = Outcome(*arguments)
        self.assertEqual(outcome.code, code, outcome.err)
        lines = [
            line
            for line in outcome.err.splitlines()
            if ": note: " not in line and " frames/s" not in line
        ]
        self.assertEqual(len(lines), 1, outcome.err)
        self.assertRegex(lines[0], r"^active-surface( \w+)?: .*[.]$")
        return lines[0]

    def put(self, name, content):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def hidden(self, folder=None):
        """Hidden files, which a command should not leave behind."""
        return [path.name for path in (folder or self.folder).rglob(".*")]


def grid(count=5, spacing=0.1):
    """Particles on a lattice."""
    axis = spacing * numpy.arange(count)
    return numpy.stack(numpy.meshgrid(axis, axis, axis), -1).reshape(-1, 3)


def moving_grid(frames=4):
    return numpy.stack([grid() + [0.05 * step, 0, 0] for step in range(frames)])
