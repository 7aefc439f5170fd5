# ctest: DISPLAY LONGER LABELS contract TIMEOUT 600
"""Every code block of every page works as described.

- python: consecutive lines of an example or of test_pyvista.py; else run here, with data of the
  names it uses.
- cpp: consecutive lines of an example.
- bash: `active-surface` is run here, without `--plot` if matplotlib is not installed. Other
  commands are not run here: they name existing scripts, presets and targets, or are in OTHERS.
- cmake: contents of the project Testing/Consumer.
- no language: a drawing.

The first block or command of each page that can run here is run; with ACTIVE_LONG in the
environment (Testing/run --long) all of them.
"""

import contextlib
import importlib.util
import io
import json
import os
import re
import shlex
import stat
import sys
import textwrap
import types
import unittest
from unittest import mock

import documents
import numpy
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  draws
from active_implicit_surfaces import data_objects, skin, vtkActiveVDBWriter
from command_line import CommandTest, grid, moving_grid
from documents import ROOT
from shapes import write
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkUnstructuredGrid
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkSphereSource
from vtkmodules.vtkIOGeometry import vtkSTLWriter
from vtkmodules.vtkIOPLY import vtkPLYWriter
from vtkmodules.vtkIOXML import (
    vtkXMLImageDataWriter,
    vtkXMLPolyDataWriter,
    vtkXMLUnstructuredGridWriter,
)
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow

RUN_ALL = "ACTIVE_LONG" in os.environ
EXAMPLES = sorted((ROOT / "Examples" / "Python").glob("*.py"))
PROGRAMS = sorted((ROOT / "Examples" / "Cxx").glob("*.cxx"))
WITH_PYVISTA = ROOT / "Testing" / "Python" / "test_pyvista.py"
PRESETS = {
    preset["name"]
    for preset in json.loads((ROOT / "CMakePresets.json").read_text())["configurePresets"]
}
TARGETS = {"documentation"}
# Commands that are not run here. Testing/Wheel/run installs a wheel with similar options, and
# ParaView's tests set the path of plugins. No test runs `ACTIVE_VTK=system pip install .`.
OTHERS = {
    "pip install 'pyvista[cvista]' build/wheel/dist/*.whl",
    "ACTIVE_VTK=system pip install .",
    "PV_PLUGIN_PATH=P/lib/paraview-5.11/plugins paraview",
}
PROGRAM = re.compile(r"(build/release/install/bin/)?active-surface ")
HAS_PLOTS = importlib.util.find_spec("matplotlib")
FFMPEG = '#!/bin/sh\nfor last; do :; done\ncat > "$last"\n'


def tidy(text):
    return [line.rstrip() for line in textwrap.dedent(text).strip("\n").splitlines()]


def contains(program, snippet):
    lines = program.splitlines()
    starts = range(len(lines) - len(snippet) + 1)
    return any(tidy("\n".join(lines[i : i + len(snippet)])) == snippet for i in starts)


def arguments_of(command):
    return shlex.split(command if HAS_PLOTS else re.sub(r" --plot \S+", "", command))[1:]


def is_known(command):
    """Returns true if a command that is not run here exists."""
    words = shlex.split(command)
    if words[0] == "bash":
        return (ROOT / words[1]).is_file()
    if words[0] == "cmake":
        presets = re.findall(r"--preset (\S+)|--install build/(\S+)", command)
        targets = re.findall(r"--target (\S+)", command)
        names = {name for pair in presets for name in pair if name}
        return bool(names) and names <= PRESETS and set(targets) <= TARGETS
    return command in OTHERS


class Blocks(CommandTest):
    def setUp(self):
        super().setUp()
        self.cube, self.ball = vtkCubeSource(), vtkSphereSource()
        for source in (self.cube, self.ball):
            source.Update()
        self.write_particles()
        write(vtkSTLWriter(), self.cube.GetOutput(), "bunny.stl")
        write(vtkSTLWriter(), self.ball.GetOutput(), "horse.stl")
        write(vtkPLYWriter(), self.ball.GetOutput(), "horse.ply")
        write(vtkActiveVDBWriter(), skin(grid(), particle_spacing=0.1), "skin_0040.vdb")
        self.put_on_path("ffmpeg", FFMPEG)

    def write_particles(self):
        """The series named in the pages, three frames each."""
        (self.folder / "run").mkdir()
        entries = ""
        for step, places in enumerate(moving_grid(3)):
            cloud = data_objects.as_particles(places)
            write(vtkXMLPolyDataWriter(), cloud, f"splash_{step:04}.vtp")
            write(vtkXMLUnstructuredGridWriter(), self.as_grid(cloud), f"run/p_{step}.vtu")
            numpy.savetxt(
                f"splash_{step:04}.csv", places, delimiter=",", header="x,y,z", comments=""
            )
            write(vtkXMLImageDataWriter(), self.fractions(places), f"alpha_{step}.vti")
            entries += f'<DataSet timestep="{0.04 * step}" file="splash_{step:04}.vtp"/>'
        text = (
            f'<VTKFile type="Collection" version="0.1"><Collection>{entries}</Collection></VTKFile>'
        )
        (self.folder / "splash.pvd").write_text(text)

    def fractions(self, places):
        """Fractions of volume, of a cube about the particles."""
        image, axis = vtkImageData(), 0.05 * numpy.arange(20) - 0.2
        low, high = places.min(0) - 0.05, places.max(0) + 0.05
        z, y, x = numpy.meshgrid(axis, axis, axis, indexing="ij")
        inside = [numpy.minimum(own - a, b - own) for own, a, b in zip((x, y, z), low, high)]
        values = numpy.clip(numpy.min(inside, axis=0) / 0.05 + 0.5, 0, 1)
        image.SetDimensions(20, 20, 20)
        image.SetSpacing(0.05, 0.05, 0.05)
        image.SetOrigin(-0.2, -0.2, -0.2)
        image.GetPointData().SetScalars(numpy_to_vtk(values.ravel(), deep=True))
        return image

    def as_grid(self, cloud):
        points = vtkUnstructuredGrid()
        points.SetPoints(cloud.GetPoints())
        return points

    def put_on_path(self, name, text):
        program = self.folder / "programs" / name
        program.parent.mkdir(exist_ok=True)
        program.write_text(text)
        program.chmod(program.stat().st_mode | stat.S_IXUSR)
        path = f"{program.parent}{os.pathsep}{os.environ['PATH']}"
        patch = mock.patch.dict(os.environ, {"PATH": path})
        patch.start()
        self.addCleanup(patch.stop)

    def names(self):
        renderer, window, actor = vtkRenderer(), vtkRenderWindow(), vtkActor()
        actor.SetMapper(vtkPolyDataMapper())
        actor.GetMapper().SetInputConnection(self.ball.GetOutputPort())
        renderer.AddActor(actor)
        window.SetOffScreenRendering(True)
        window.AddRenderer(renderer)
        shapes = {"cube": self.cube.GetOutput(), "ball": self.ball.GetOutput()}
        return {"points": grid(), "dt": 0.04, "window": window, **shapes}

    def run_python(self, body):
        pyplot = types.SimpleNamespace(subplots=lambda rows, *_, **__: (None, fake_axes(rows)))
        matplotlib = types.SimpleNamespace(pyplot=pyplot)
        stand_in = {"matplotlib": matplotlib, "matplotlib.pyplot": pyplot}
        with mock.patch.dict(sys.modules, stand_in), contextlib.redirect_stdout(io.StringIO()):
            exec(compile(body, "block", "exec"), self.names())

    def run_once(self, run, *arguments):
        if RUN_ALL or not self.has_run:
            run(*arguments)
        self.has_run = True

    def check(self, language, body):
        if language == "python":
            shown = [*EXAMPLES, WITH_PYVISTA]
            if not any(contains(path.read_text(), tidy(body)) for path in shown):
                self.run_once(self.run_python, body)
        elif language == "cpp":
            shown = any(contains(path.read_text(), tidy(body)) for path in PROGRAMS)
            self.assertTrue(shown, "no example has these lines")
        elif language == "bash":
            for command in documents.commands(body):
                if not PROGRAM.match(command):
                    self.assertTrue(is_known(command), f"nobody runs `{command}`")
                else:
                    self.run_once(self.succeed, *arguments_of(command))
        elif language == "cmake":
            consumer = (ROOT / "Testing" / "Consumer" / "CMakeLists.txt").read_text()
            for name in re.findall(r"find_package\(.*?\)|\w+::\w+", body):
                self.assertIn(name, consumer)
        else:
            self.assertEqual(language, "", "blocks are python, cpp, bash, cmake, or drawings")
            self.assertNotRegex(body, r"^(\$|import |active-surface )", "say what language it is")

    def test_all_of_them(self):
        count = 0
        for page in documents.pages():
            self.has_run = False
            for number, (language, body) in enumerate(documents.blocks((ROOT / page).read_text())):
                with self.subTest(page=str(page), block=number + 1):
                    self.check(language, body)
                    count += 1
        self.assertGreater(count, 10)


def fake_axes(rows):
    axes = numpy.array([[mock.Mock()] for _ in range(rows)])
    for place in axes[:, 0]:
        place.get_ylim.return_value = (0.0, 1.0)
    return axes


class TheChecks(unittest.TestCase):
    def test_part_of_an_example_is_compared_line_by_line(self):
        snippet = ["a = 1", "if a:", "    b = 2"]
        self.assertTrue(contains("import x\na = 1\nif a:\n    b = 2\nprint(b)\n", snippet))
        self.assertTrue(contains("def f():\n    a = 1\n    if a:\n        b = 2\n", snippet))
        self.assertFalse(contains("a = 1\nif a:\n    b = 3\n", snippet))
        self.assertFalse(contains("a = 1\n\nif a:\n    b = 2\n", snippet))
        self.assertFalse(contains("a = 1\nif a:\n", snippet))

    def test_commands_have_to_be_known(self):
        self.assertTrue(is_known("bash Testing/run"))
        self.assertFalse(is_known("bash Testing/walk"))
        self.assertTrue(is_known("cmake --build --preset release"))
        self.assertFalse(is_known("cmake --build --preset quick"))
        self.assertFalse(is_known("cmake --build --preset release --target nothing"))
        self.assertFalse(is_known("make install"))


if __name__ == "__main__":
    unittest.main()
