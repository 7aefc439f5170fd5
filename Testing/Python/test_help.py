# ctest: LABELS contract
"""The table of properties is that of the compiled classes. Each comment, which help() and the
panels show, has the default, and comments of numbers have range and unit."""

import pydoc
import re
import unittest

import active_implicit_surfaces
from properties import CLASSES, get, put, rows_of


def every(*kinds):
    """(class, row) of the properties of some kinds, or of all."""
    rows = ((kind, row) for kind in CLASSES for row in rows_of(kind).values())
    return [(kind, row) for kind, row in rows if not kinds or row.kind in kinds]


def setters_of(kind):
    """Names X of the methods SetX(value) that a class itself declares."""
    return {
        name[3:]
        for name, method in vars(kind).items()
        if name.startswith("Set") and not re.match(r"Set\w+\(self\)", method.__doc__)
    }


class Case(unittest.TestCase):
    def about(self, kind, row):
        return self.subTest(f"{kind.__name__}.{row.name}")


class TableAndClasses(Case):
    """The table, which is read from the sources, and the classes as compiled are the same."""

    def test_every_property_is_in_the_table(self):
        for kind in CLASSES:
            with self.subTest(kind.__name__):
                self.assertEqual(setters_of(kind), set(rows_of(kind)))
        self.assertGreater(len(every()), 100)

    def test_the_comment_is_that_of_help(self):
        for kind, row in every():
            with self.about(kind, row):
                signatures, _, text = getattr(kind, "Set" + row.name).__doc__.rpartition("\nC++: ")
                comment = text.partition("\n\n")[2] if signatures else text
                self.assertEqual(" ".join(comment.split()), row.comment)

    def test_the_default_is_that_of_a_new_object(self):
        for kind, row in every("switch", "choice", "integer", "number", "integers", "numbers"):
            with self.about(kind, row):
                value = get(kind(), row.name)
                self.assertEqual(list(value) if isinstance(value, tuple) else value, row.default)

    def test_the_bounds_are_those_of_the_macro(self):
        for kind, row in every():
            with self.about(kind, row):
                self.assertEqual(hasattr(kind, f"Get{row.name}MinValue"), row.clamped)
                for bound, end in ((row.least, "Min"), (row.largest, "Max")):
                    if row.clamped and bound is not None:
                        self.assertEqual(getattr(kind(), f"Get{row.name}{end}Value")(), bound)

    def test_switches_and_choices_have_their_methods(self):
        for kind, row in every():
            with self.about(kind, row):
                self.assertEqual(hasattr(kind, row.name + "On"), row.kind == "switch")
                for value, word in enumerate(row.choices):
                    thing = kind()
                    put(thing, row.name, (value + 1) % len(row.choices))
                    getattr(thing, f"Set{row.name}To{word}")()
                    self.assertEqual(get(thing, row.name), value)

    def test_every_property_of_the_filter_has_a_group(self):
        for row in rows_of(active_implicit_surfaces.vtkActiveImplicitSurface).values():
            self.assertRegex(row.group, r"^[A-Z][a-z]+$", row.name)


class Comments(Case):
    def test_every_comment_has_the_default(self):
        for kind, row in every():
            with self.about(kind, row):
                self.assertIn("Default:", row.comment)

    def test_every_number_has_a_range(self):
        for kind, row in every("number", "integer"):
            with self.about(kind, row):
                self.assertRegex(row.range, r"^(>=? -?\d|finite|[\d.e+-]+ (to|or) [\d.e+-]+)")
                if row.clamped and row.largest is not None:
                    low, high = re.match(r"(\S+) to ([^;]+)", row.range).groups()
                    self.assertEqual((float(low), float(high)), (row.least, row.largest))
                elif row.default == -1:
                    self.assertRegex(row.range, r", or -1$")
                    self.assertRegex(row.comment, r"or -1, automatic: .* Default: -1\.$")
                elif row.clamped:
                    self.assertRegex(row.range, rf"^>= {row.least:g}")

    def test_every_quantity_has_a_unit(self):
        for kind, row in every("number", "numbers"):
            with self.about(kind, row):
                self.assertTrue(row.unit, "write [1] for a pure number")

    def test_every_choice_has_its_values(self):
        for kind, row in every("choice"):
            with self.about(kind, row):
                told = {int(value) for value in re.findall(r"\s\((\d)\)", row.comment)}
                self.assertEqual(told, set(range(len(row.choices))))

    def test_the_default_of_the_comment_is_that_of_the_class(self):
        for kind, row in every("number", "integer"):
            with self.about(kind, row):
                number = re.search(r"Default:\s*(-?\d[\d.]*(?:e[+-]?\d+)?)", row.comment)
                self.assertIsNotNone(number)
                self.assertEqual(row.default, float(number[1].rstrip(".")))
        for kind, row in every("switch"):
            with self.about(kind, row):
                self.assertIn("Default: on" if row.default else "Default: off", row.comment)
        for kind, row in every("choice"):
            with self.about(kind, row):
                word = re.search(r"Default:\s*(\w+)", row.comment)[1]
                self.assertEqual(row.default, getattr(kind, word))

    def test_help_shows_all_of_it(self):
        shown = {kind: pydoc.plain(pydoc.render_doc(kind)) for kind in CLASSES}
        for kind, row in every():
            with self.about(kind, row):
                self.assertTrue("Set" + row.name in shown[kind], "help() does not show it")

    def test_the_classes_and_the_package_say_what_they_are(self):
        for kind in CLASSES:
            self.assertTrue(kind.__doc__)
        self.assertRegex(active_implicit_surfaces.__version__, r"^\d+\.\d+\.\d+$")


if __name__ == "__main__":
    unittest.main()
