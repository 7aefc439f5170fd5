# ctest: LABELS contract
"""Rules for every property of every class, by reflection, so that none is forgotten.

Run: python3 test_properties.py
"""

import inspect
import unittest

import active_implicit_surfaces
from active_implicit_surfaces import (
    vtkActiveEXRReader,
    vtkActiveVDBReader,
    vtkGridPotential,
    vtkSkeletonPotential,
)
from listener import Listener
from properties import get, own_properties, put
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkObject


def classes():
    """Classes of the package."""
    named = inspect.getmembers(active_implicit_surfaces, inspect.isclass)
    return [kind for name, kind in named if name.startswith("vtk") and issubclass(kind, vtkObject)]


def readable(kind):
    """Properties with a getter."""
    getters = {name: getattr(kind, "Get" + name, None) for name in own_properties(kind)}
    return [
        name for name, getter in getters.items() if getter and f"Get{name}(self)" in getter.__doc__
    ]


class TestEveryProperty(unittest.TestCase):
    def test_classes_are_found(self):
        names = {kind.__name__ for kind in classes()}
        self.assertLessEqual({"vtkActiveImplicitSurface", "vtkActiveVDBReader"}, names)
        self.assertGreater(len(names), 6)

    def test_a_value_that_is_there_already_changes_nothing(self):
        for kind in classes():
            thing = kind()
            for name in readable(kind):
                with self.subTest(kind=kind.__name__, property=name):
                    value = get(thing, name)
                    before = thing.GetMTime()
                    put(thing, name, value)
                    self.assertEqual(thing.GetMTime(), before)
                    self.assertEqual(get(thing, name), value)

    def test_the_description_names_it(self):
        for kind in classes():
            described = str(kind())
            for name in readable(kind):
                with self.subTest(kind=kind.__name__, property=name):
                    self.assertIn(name + ":", described)

    def test_arrays_that_cannot_be_evaluated_are_refused(self):
        points, pairs, values = (vtkDoubleArray() for _ in range(3))
        points.SetNumberOfComponents(3)
        pairs.SetNumberOfComponents(2)
        for kind in (vtkGridPotential, vtkSkeletonPotential):
            function = kind()
            listener = Listener(function)
            for given in ((None, values), (points, None), (pairs, values)):
                function.EvaluateFunction(*given)
                self.assertIn("needs an input array of 3 components", listener.errors.pop())

    def test_numbers_of_lists_that_do_not_exist_have_nothing(self):
        reader = vtkActiveEXRReader()
        for number in (-1, 0, 7):
            self.assertIsNone(reader.GetPartName(number))
            self.assertIsNone(reader.GetPartType(number))
            self.assertIsNone(reader.GetChannelName(number))
            self.assertEqual(reader.GetChannelType(number), -1)
            self.assertFalse(vtkActiveVDBReader().GetGridName(number))


if __name__ == "__main__":
    unittest.main()
