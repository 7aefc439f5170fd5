# ctest: LABELS contract
"""The examples in the docstrings run, and give the documented results."""

import doctest
import importlib
import pkgutil
import unittest

import active_implicit_surfaces

# Modules whose examples need a display, files, a VTK with all its passes, or PyVista, or start a
# program.
LEFT_OUT = {"render", "surface_values", "pyvista_accessor", "__main__"}
WITH_EXAMPLES = {"api", "data_objects", "file_names", "morphing", "properties", "series"}


class Examples(unittest.TestCase):
    def test_all_of_them(self):
        seen = set()
        for module in pkgutil.iter_modules(active_implicit_surfaces.__path__):
            if module.name in LEFT_OUT or module.name.startswith(("vtk", "libvtk")):
                continue
            with self.subTest(module.name):
                found = importlib.import_module(f"active_implicit_surfaces.{module.name}")
                result = doctest.testmod(found)
                self.assertEqual(result.failed, 0)
                seen |= {module.name} if result.attempted else set()
        self.assertEqual(WITH_EXAMPLES - seen, set(), "have no examples")


if __name__ == "__main__":
    unittest.main()
