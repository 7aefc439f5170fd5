# ctest: WITHOUT_PACKAGE LABELS contract
"""README's first Python snippet is part of an example, line by line, so that it is known to run."""

import re
import textwrap
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def first_snippet(readme):
    """The lines of the first ```python block, without trailing space; none: an empty list."""
    found = re.search(r"^```python[ \t]*\n(.*?)^```", readme, re.MULTILINE | re.DOTALL)
    return tidy(found.group(1)) if found else []


def tidy(text):
    return [line.rstrip() for line in textwrap.dedent(text).strip("\n").splitlines()]


def contains(program, snippet):
    """Whether the snippet's lines stand in the program one after the other, equally indented."""
    lines = program.splitlines()
    starts = range(len(lines) - len(snippet) + 1)
    return any(tidy("\n".join(lines[i : i + len(snippet)])) == snippet for i in starts)


class TheComparison(unittest.TestCase):
    README = "# Title\n```sh\nls\n```\n```python\na = 1\nif a:\n    b = 2\n```\n```python\nc\n```\n"

    def test_takes_the_first_python_block(self):
        self.assertEqual(first_snippet(self.README), ["a = 1", "if a:", "    b = 2"])
        self.assertEqual(first_snippet("# Title\n"), [])

    def test_allows_indentation_and_nothing_else(self):
        snippet = first_snippet(self.README)
        self.assertTrue(contains("import x\na = 1\nif a:\n    b = 2\nprint(b)\n", snippet))
        self.assertTrue(contains("def f():\n    a = 1\n    if a:\n        b = 2\n", snippet))
        self.assertFalse(contains("a = 1\nif a:\n    b = 3\n", snippet))
        self.assertFalse(contains("a = 1\n\nif a:\n    b = 2\n", snippet))
        self.assertFalse(contains("a = 1\nif a:\n", snippet))


class TheReadme(unittest.TestCase):
    def test_its_snippet_is_part_of_an_example(self):
        snippet = first_snippet((ROOT / "README.md").read_text(encoding="utf-8"))
        self.assertTrue(snippet, "README.md has no ```python block")
        examples = sorted((ROOT / "Examples" / "Python").glob("*.py"))
        self.assertTrue(examples, "there is no Examples/Python/*.py")
        self.assertTrue(
            any(contains(path.read_text(encoding="utf-8"), snippet) for path in examples),
            "no Examples/Python/*.py contains, line by line:\n" + "\n".join(snippet),
        )


if __name__ == "__main__":
    unittest.main()
