# ctest: LABELS contract
"""Values of vtkActiveImplicitSurface's properties: other, clamped, and refused values, by the rules
of properties.py.

Run: python3 test_property_values.py
"""

import unittest

from active_implicit_surfaces import vtkActiveImplicitSurface
from listener import Listener
from properties import clamped_values, get, other_values, put, refused_values, rows_of
from test_filter import make_shrinking_ball
from vtkmodules.vtkCommonDataModel import vtkPolyData

ROWS = rows_of(vtkActiveImplicitSurface).values()
# Refused values that no rule knows.
EMPTY_BOXES = ("ModelBounds", [(0, 1, 2, -2, 0, 1), (0, 0, 0, 0, 0, 0)])


class Properties(unittest.TestCase):
    def test_what_is_set_is_got(self):
        surface = vtkActiveImplicitSurface()
        tried = 0
        for row in ROWS:
            for value in other_values(row):
                with self.subTest(row.name):
                    self.assertNotEqual(value, row.default)
                    put(surface, row.name, value)
                    self.assertEqual(get(surface, row.name), value)
                    tried += 1
        self.assertGreater(tried, len(ROWS) - 10, "all but boxes and objects")

    def test_values_beyond_a_bound_become_the_bound(self):
        surface = vtkActiveImplicitSurface()
        tried = 0
        for row in ROWS:
            for value, bound in clamped_values(row):
                with self.subTest(row.name, value=value):
                    put(surface, row.name, value)
                    self.assertEqual(get(surface, row.name), bound)
                    tried += 1
        self.assertGreater(tried, 30)

    def test_invalid_values_are_an_error_that_names_the_property(self):
        cases = [(row.name, value) for row in ROWS for value in refused_values(row)]
        cases += [(EMPTY_BOXES[0], value) for value in EMPTY_BOXES[1]]
        self.assertGreater(len(cases), 30)
        for name, value in cases:
            with self.subTest(name, value=value):
                surface = make_shrinking_ball()
                put(surface, name, value)
                listener = Listener(surface)
                surface.UpdateTimeStep(0.3)
                self.assertEqual(len(listener.errors), 1)
                self.assertIn(name, listener.errors[0])
                self.assertEqual(surface.GetOutput().GetNumberOfPoints(), 0)

    def test_wrong_types_are_type_errors(self):
        surface = vtkActiveImplicitSurface()
        for wrong in ("ball", 3, vtkPolyData()):
            with self.assertRaises(TypeError):
                surface.SetTargetFunction(wrong)
        with self.assertRaises(TypeError):
            surface.SetVoxelSize("small")
        with self.assertRaises(TypeError):
            surface.SetModelBounds(0, 1)


if __name__ == "__main__":
    unittest.main()
