# ctest: LABELS contract
"""help() of the package's functions documents each parameter, unit, default, result and error.

test_help.py tests the same for the classes of VTK.
"""

import inspect
import re
import unittest

import active_implicit_surfaces
from active_implicit_surfaces import render
from active_implicit_surfaces.series import TemporalSource

PUBLIC = {name: getattr(active_implicit_surfaces, name) for name in dir(active_implicit_surfaces)}
FUNCTIONS = {
    "skin": PUBLIC["skin"],
    "frames": PUBLIC["frames"],
    "morph": PUBLIC["morph"],
    "history": PUBLIC["history"],
    "plot_history": PUBLIC["plot_history"],
    "ParticleSeries": PUBLIC["ParticleSeries"],
    "TemporalSource": TemporalSource,
    "render.write_exr": render.write_exr,
    "render.capture": render.capture,
    "render.camera_matrices": render.camera_matrices,
}
# Public names that are no functions: a tuple, an exception, and a class whose methods raise.
OTHERS = {"Frame", "ActiveSurfaceWarning", "LiveSurface"}
WITHOUT_ERRORS = {"render.camera_matrices", "TemporalSource"}  # the attribute `failure` holds them
QUANTITIES = {"times", "fps", "duration", "frame_duration", "far"}
NOT_A_RESULT = {"ParticleSeries", "TemporalSource"}  # constructors


def sections(documented):
    """Title and lines of each section of a docstring in numpydoc's format."""
    lines = inspect.cleandoc(documented.__doc__).splitlines()
    starts = [i for i in range(len(lines) - 1) if re.fullmatch("-{4,}", lines[i + 1])]
    ends = [*starts[1:], len(lines)]
    return {lines[i]: lines[i + 2 : end] for i, end in zip(starts, ends, strict=True)}


def parameters(documented):
    """Name, type and text of each parameter."""
    found, names = {}, []
    for line in sections(documented).get("Parameters", []):
        if line and not line.startswith(" "):
            head, _, kind = line.partition(" : ")
            names = [name.strip().lstrip("*") for name in head.split(",")]
            found.update({name: [kind, ""] for name in names})
        for name in names:
            if line.startswith(" "):
                found[name][1] += " " + line.strip()
    return found


def as_told(value):
    """A default in the docstrings' format."""
    if isinstance(value, float):
        return f"{value:g}".replace("+", "")
    return ", ".join(value) if isinstance(value, tuple) else str(value)


class EveryPublicName(unittest.TestCase):
    def test_is_in_one_list(self):
        own = {
            name
            for name, value in PUBLIC.items()
            if not name.startswith(("_", "vtk")) and not inspect.ismodule(value)
        }
        self.assertEqual(own - {"VTK_PACKAGE"}, (set(FUNCTIONS) & own) | OTHERS)
        for name in OTHERS:
            self.assertTrue(PUBLIC[name].__doc__)

    def test_tells_each_parameter_and_its_type(self):
        for name, function in FUNCTIONS.items():
            told, real = parameters(function), inspect.signature(function).parameters
            with self.subTest(name):
                self.assertEqual(list(told), list(real))
            for one, parameter in real.items():
                with self.subTest(name, parameter=one):
                    kind, text = told[one]
                    self.assertTrue(kind or parameter.kind == parameter.VAR_KEYWORD)

    def test_tells_each_unit(self):
        for name, function in FUNCTIONS.items():
            for one, (_, text) in parameters(function).items():
                if one in QUANTITIES:
                    with self.subTest(name, parameter=one):
                        self.assertRegex(text, r"\[[^\]]+\]")

    def test_tells_each_default_that_is_a_value(self):
        for name, function in FUNCTIONS.items():
            for one, parameter in inspect.signature(function).parameters.items():
                value = parameter.default
                kind, text = parameters(function)[one]
                with self.subTest(name, parameter=one):
                    if value is None:
                        self.assertIn("optional", kind)
                    elif value is not parameter.empty:
                        told = text.partition("Default: ")[2].rstrip(".").strip('"')
                        self.assertEqual(told, as_told(value))

    def test_tells_what_comes_out_and_what_goes_wrong(self):
        for name, function in FUNCTIONS.items():
            with self.subTest(name):
                titles = set(sections(function))
                if name not in NOT_A_RESULT:
                    self.assertTrue(titles & {"Returns", "Yields"})
                if name not in WITHOUT_ERRORS:
                    self.assertIn("Raises", titles)


if __name__ == "__main__":
    unittest.main()
