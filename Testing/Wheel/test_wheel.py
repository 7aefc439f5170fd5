"""An installed wheel: its contents, its program, and its message beside another VTK.

Run by Testing/Wheel/run, in an environment with the wheel and pyvista[cvista].
"""

import os
import subprocess
import sys
import tempfile
import unittest
from importlib import metadata
from pathlib import Path

import active_implicit_surfaces
import numpy

PACKAGE = Path(active_implicit_surfaces.__file__).parent
BUNDLED = PACKAGE.with_name("active_implicit_surfaces.libs")
CLOUD = "cloud = pyvista.PolyData([[x % 4, x // 4 % 4, x // 16] for x in range(64)]); "


def run(*command, **environment):
    return subprocess.run(
        command, capture_output=True, text=True, env={**os.environ, **environment}
    )


def run_python(code, **environment):
    return run(sys.executable, "-c", code, **environment)


def dynamic_section(library):
    return run("readelf", "--dynamic", "--wide", str(library)).stdout


class Contents(unittest.TestCase):
    def test_each_library_is_there_once(self):
        ours = sorted(path.name for path in PACKAGE.glob("libvtkActive*"))
        modules = ("Files", "IO", "LevelSet", "Particles", "Shapes", "Surfaces")
        self.assertEqual(ours, [f"libvtkActive{module}.so" for module in modules])
        stems = [path.name.partition("-")[0] for path in BUNDLED.iterdir()]
        self.assertEqual(len(stems), len(set(stems)), stems)

    def test_libraries_are_looked_for_in_the_environment_only(self):
        for library in (*PACKAGE.glob("*.so"), *BUNDLED.iterdir()):
            for line in dynamic_section(library).splitlines():
                if "RPATH" in line or "RUNPATH" in line:
                    for folder in line.partition("[")[2].rstrip("]").split(":"):
                        self.assertTrue(folder.startswith("$ORIGIN"), f"{library}: {line}")

    def test_no_file_is_only_for_those_who_build(self):
        names = [str(file) for file in metadata.files("active-implicit-surfaces")]
        for part in (".h", ".cmake", "hierarchy.txt"):
            self.assertEqual([name for name in names if name.endswith(part)], [])
        self.assertEqual([name for name in names if name.startswith(("include", "share"))], [])

    def test_what_is_bundled_has_its_licence(self):
        files = metadata.files("active-implicit-surfaces")
        listed = next(file for file in files if file.name == "BUNDLED.txt").read_text()
        for library in BUNDLED.iterdir():
            self.assertIn(library.name, listed)
        licences = {file.name for file in files if "licenses" in file.parts}
        for package in ("LICENSE", "libopenvdb10.0.txt", "libtbb12.txt"):
            if package == "LICENSE" or package[:-4] in listed:
                self.assertIn(package, licences)
        named = {line.split()[3] for line in listed.splitlines()[1:]}
        self.assertEqual({f"{name}.txt" for name in named} - licences, set())

    def test_it_asks_for_the_libraries_it_was_built_with(self):
        self.assertIn("cvista[all]==", " ".join(metadata.requires("active-implicit-surfaces")))


class TheProgram(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.data = self.folder / "cubes.npz"
        cube = numpy.stack(numpy.meshgrid(*3 * [numpy.arange(5.0)]), -1).reshape(-1, 3)
        numpy.savez(self.data, positions=numpy.stack([cube, cube + 0.1]), fps=10.0)

    def names(self, pattern):
        return sorted(path.name for path in self.folder.glob(pattern))

    def test_skins_and_pictures(self):
        output = ("-o", f"{self.folder}/skin_####.ply", "--render", f"{self.folder}/frame_####.png")
        done = run("active-surface", "skin", str(self.data), *output)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.names("*.ply"), ["skin_0000.ply", "skin_0001.ply"])
        self.assertEqual(self.names("*.png"), ["frame_0000.png", "frame_0001.png"])

    def test_pictures_as_exr_are_refused_in_a_sentence(self):
        pictures = ("--render", f"{self.folder}/frame_####.exr")
        done = run("active-surface", "skin", str(self.data), *pictures)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("vtkValuePass, which the VTK of cvista does not have", done.stderr)
        self.assertEqual(self.names("frame*"), [])


class BesidePyVista(unittest.TestCase):
    def test_the_accessor_is_there_without_an_import(self):
        skin = "cloud.active_surface.skin(particle_spacing=1)"
        done = run_python(f"import pyvista; {CLOUD}print({skin}.is_manifold)")
        self.assertEqual((done.stdout, done.returncode), ("True\n", 0), done.stderr)

    def test_the_other_backend_is_an_error_and_no_crash(self):
        code = f"import pyvista; {CLOUD}cloud.active_surface.skin(particle_spacing=1)"
        done = run_python(code, PYVISTA_VTK_BACKEND="vtk")
        self.assertEqual(done.returncode, 1, done.stderr)
        last = done.stderr.splitlines()[-1]
        self.assertTrue(last.startswith("AttributeError: "), last)
        self.assertIn("loaded that of vtk" + "modules; a program cannot have both", last)
        self.assertIn("PYVISTA_VTK_BACKEND to cvista (it is vtk)", last)

    def test_the_other_backend_loaded_later_is_an_error_too(self):
        code = "import active_implicit_surfaces as active, pyvista; " + CLOUD + "active.skin(cloud)"
        done = run_python(code, PYVISTA_VTK_BACKEND="vtk")
        self.assertEqual(done.returncode, 1, done.stderr)
        last = done.stderr.splitlines()[-1]
        self.assertTrue(last.startswith("TypeError: "), last)
        self.assertIn("is of another VTK than that of active_implicit_surfaces", last)


if __name__ == "__main__":
    unittest.main()
