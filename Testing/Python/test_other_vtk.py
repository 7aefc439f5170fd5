# ctest: LABELS contract
"""With another VTK than that of the build, the import raises an ImportError and does not crash.

The other VTK is a package vtkmodules of empty modules in a temporary folder.
"""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import active_implicit_surfaces
from active_implicit_surfaces import vtk_build

PACKAGES = Path(active_implicit_surfaces.__file__).parents[1]
MODULES = "__init__ vtkCommonDataModel vtkCommonExecutionModel vtkIOImage".split()
CORE = """
class vtkVersion:
    @staticmethod
    def GetVTKVersion():
        return {version!r}
"""


def import_beside(version):
    """Result of importing the package with a vtkmodules of this version."""
    with tempfile.TemporaryDirectory() as folder:
        modules = Path(folder) / "vtkmodules"
        modules.mkdir()
        for name in MODULES:
            (modules / f"{name}.py").touch()
        (modules / "vtkCommonCore.py").write_text(CORE.format(version=version))
        done = subprocess.run(
            [sys.executable, "-c", "import active_implicit_surfaces"],
            env={**os.environ, "PYTHONPATH": os.pathsep.join((folder, str(PACKAGES)))},
            capture_output=True,
            text=True,
        )
        return done, str(modules)


class OtherVTK(unittest.TestCase):
    def assert_refuses(self, version):
        done, folder = import_beside(version)
        self.assertEqual(done.returncode, 1, done.stderr)
        last = done.stderr.splitlines()[-1]
        self.assertTrue(last.startswith("ImportError: active_implicit_surfaces was built"), last)
        self.assertIn(f"with VTK {vtk_build.VERSION}, for", last)
        self.assertIn(f"another VTK, {version}, in {folder};", last)
        self.assertIn(f"pip uninstall {vtk_build.PACKAGE.removesuffix('modules')})", last)

    def test_another_version_is_refused(self):
        self.assert_refuses("99.7.2")

    @unittest.skipUnless(vtk_build.LIBRARY, "VTK is static")
    def test_another_copy_of_the_same_version_is_refused(self):
        self.assert_refuses(vtk_build.VERSION)

    def test_a_loaded_vtk_of_another_name_is_refused(self):
        code = (
            "import sys; sys.modules['other.vtkCommonCore'] = sys; import active_implicit_surfaces"
        )
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1, done.stderr)
        last = done.stderr.splitlines()[-1]
        self.assertTrue(last.startswith("ImportError: active_implicit_surfaces was built"), last)
        self.assertIn(f"the VTK of the package {vtk_build.PACKAGE}, but", last)
        self.assertIn("has loaded that of other; a program cannot have both", last)

    def test_the_vtk_of_the_build_is_there(self):
        self.assertTrue(vtk_build.is_loaded(vtk_build.LIBRARY))
        self.assertFalse(vtk_build.is_loaded("libvtkCommonCore-99.7.so.1"))
        vtk_build.check()


if __name__ == "__main__":
    unittest.main()
