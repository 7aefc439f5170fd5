# ctest: LABELS contract
"""Each recipe of CONTRIBUTING.md names all files that have to know a new thing. Tests by rules do
not list the properties.

Run: python3 test_recipes.py
"""

import re
import unittest
from types import SimpleNamespace

from active_implicit_surfaces import vtkActiveImplicitSurface
from active_implicit_surfaces.particle_files import TARGET_SUFFIXES
from active_implicit_surfaces.skin_files import SKIN_SUFFIXES
from documents import ROOT
from properties import clamped_values, other_values, refused_values, restarts, rows_of

ROWS = rows_of(vtkActiveImplicitSurface)
PLAIN = {name for name, row in ROWS.items() if row.kind != "object"}
# Tests that take properties and their values from rules, not from lists.
BY_RULES = """
    Python/properties.py Python/test_help.py Python/test_property_values.py
    Python/test_properties.py Python/test_extremes.py Python/random_cases.py
    ParaView/test_proxies.py
""".split()


def recipe(title="Add a property"):
    """Files in the numbered steps of a recipe, the alternatives of a step together."""
    text = (ROOT / ".github" / "CONTRIBUTING.md").read_text(encoding="utf-8")
    section = text.partition(f"## {title}\n")[2].partition("\n## ")[0]
    steps = re.findall(r"^\d\. (.*?)(?=^\d\. |^$)", section, re.MULTILINE | re.DOTALL)
    return [set(re.findall(r"`(\w+/[\w/]+\.\w+)`", step)) for step in steps]


def files_with(pattern, folder):
    """Files of a folder whose code, without comments, has a pattern."""
    found = set()
    for path in (ROOT / folder).rglob("*"):
        if path.suffix in (".h", ".cxx", ".py", ".txt", ".xml"):
            code = re.sub(r"/\*.*?\*/", "", path.read_text(encoding="utf-8"), flags=re.DOTALL)
            if re.search(pattern, re.sub("//.*", "", code), re.MULTILINE):
                found.add(path.relative_to(ROOT).as_posix())
    return found


def declarations_of(name):
    """Files of Filters that declare a property: macro, line of ForEachProperty, panel."""
    pattern = rf'(Macro\({name}\b|_PROPERTY\(\s*{name},|<Own name="{name}")'
    return {file for file, text in SOURCES.items() if re.search(pattern, text)}


OWN_FOLDERS = ("Surfaces", "ParaView")  # others have classes with properties of their own
OTHER_CLASSES = ("EXR.xml", "VDB.xml", "ImplicitFunctions.xml")
SOURCES = {
    path.relative_to(ROOT / "Filters").as_posix(): path.read_text(encoding="utf-8")
    for folder in OWN_FOLDERS
    for path in (ROOT / "Filters" / folder).rglob("*")
    if path.suffix in (".h", ".cxx", ".xml", ".py") and path.name not in OTHER_CLASSES
}


class OtherRecipes(unittest.TestCase):
    def test_a_kind_of_input_stands_in_its_files_only(self):
        own, kinds = recipe("Add a kind of input")
        for name in ("Image", "Mesh", "Skeleton"):
            with self.subTest(name):
                expected = {file.replace("XShape", name + "Shape") for file in own} | kinds
                expected.add(f"Filters/Surfaces/Targets/{name}Shape.cxx")
                self.assertEqual(files_with(rf"\b{name}Shape\b", "Filters"), expected)
                self.assertEqual(len(expected), 4)

    def test_an_array_is_made_in_one_file(self):
        made = recipe("Add a point array to the skin")[1]
        for name in ("MakeVelocity", "MakeCurvatureOf"):
            self.assertEqual(files_with(rf"\b{name}\b", "Filters"), made)

    def test_a_scheme_stands_in_its_files(self):
        files = set().union(*recipe("Add a scheme"))
        known = files_with(r"TimeIntegration::Nodes|^  Nodes$|Nodes/NodeStep\.h", "Filters")
        self.assertEqual({file for file in known if "/Nodes/" not in file}, files)

    def test_a_format_stands_in_its_files(self):
        readers, writers = recipe("Add a file format")
        for table, pattern in ((readers, r"\bread_gro\b"), (writers, r"\bwrite_glb\b")):
            found = files_with(pattern, "Python/active_implicit_surfaces")
            self.assertEqual(len(found), 2)
            self.assertEqual(len(found & table), 1, found)
        page = (ROOT / "Python" / "files.md").read_text(encoding="utf-8")
        for suffix in (*TARGET_SUFFIXES, *SKIN_SUFFIXES):
            self.assertIn(suffix, page)


class Recipe(unittest.TestCase):
    def test_the_recipe_has_three_steps_with_files_that_exist(self):
        self.assertEqual(len(recipe()), 3)
        for files in recipe():
            self.assertLessEqual(files, set(SOURCES))

    def test_every_property_is_declared_in_one_file_of_each_step_only(self):
        steps = recipe()
        self.assertGreater(len(PLAIN), 50)
        for name in sorted(PLAIN):
            with self.subTest(name):
                found = declarations_of(name)
                self.assertEqual(len(found), 3, found)
                for files in steps:
                    self.assertEqual(len(found & files), 1, found)

    def test_no_test_by_rules_lists_properties(self):
        for file in BY_RULES:
            text = (ROOT / "Testing" / file).read_text(encoding="utf-8")
            named = {name for name in PLAIN if re.search(rf"\b{name}\b", text)}
            with self.subTest(file):
                self.assertLess(len(named), len(PLAIN) / 2, named)

    def test_the_rules_have_values_for_properties_of_each_kind(self):
        blank = {"choices": [], "clamped": False, "least": None, "largest": None, "range": ""}
        one = {"comment": "Does not restart the motion. Default: 3."}
        number = SimpleNamespace(
            **blank | one | {"kind": "number", "default": 3.0, "range": "> 0; of all"}
        )
        self.assertEqual(other_values(number), [6.0])
        self.assertEqual(refused_values(number)[-2:], [0.0, -0.5])
        self.assertFalse(restarts(number))
        share = SimpleNamespace(
            **blank | {"kind": "number", "default": 1.0, "clamped": True, "least": 0.0}
        )
        share.largest, share.comment = 1.0, "Default: 1."
        self.assertEqual(other_values(share), [0.5])
        self.assertEqual(clamped_values(share), [(-1.0, 0.0), (2.0, 1.0)])
        self.assertTrue(restarts(share))
        choice = SimpleNamespace(**blank | {"kind": "choice", "default": 1})
        choice.choices = ["A", "B", "C"]
        self.assertEqual(other_values(choice), [0, 2])


if __name__ == "__main__":
    unittest.main()
