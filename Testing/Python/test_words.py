# ctest: WITHOUT_PACKAGE LABELS contract
"""Testing/check_words.py finds private words in prose, with their lines, and none in code."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from documents import ROOT

AGAIN = "a" + "new"  # a private word, which Testing/lint would find here
CXX = f"""#include <string>
int {AGAIN} = 1'000;
/**
 * Starts {AGAIN}.
 */
int x = 0; // `{AGAIN}` is code
// Starts the motion
// {AGAIN}.
const char* text = "A motion that "
                   "starts {AGAIN}";
const char* url = "http://{AGAIN}";
"""
PYTHON = f'''"""Starts
the motion {AGAIN}."""

{AGAIN} = f"the value is {{{AGAIN}}}"
raise ValueError(f"{{{AGAIN}}} starts {AGAIN}")  # {AGAIN}
'''
PAGE = f"""# Title

Starts {AGAIN}: `{AGAIN}`, [link]({AGAIN}.md).

```python
{AGAIN} = 1
```
Started {AGAIN}.
"""
XML = f"""<Proxy name="{AGAIN}">
  <Documentation>Starts
    {AGAIN}.</Documentation>
</Proxy>
"""
HEADS = """// What the band is.
int x; // Returns what the band is.

/**
 * @brief Whether the band is empty. As above.
 */
"""


# Listed words in their ordinary senses, which are no findings.
ORDINARY = """It takes ten minutes. The points are in place, on a round surface, along both ways.
In this way a wheel has room for particles. The water is at rest. The header says so: --alone.
"""


def check(name, text):
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, name)
        path.write_text(text, encoding="utf-8")
        command = [sys.executable, ROOT / "Testing" / "check_words.py", path]
        run = subprocess.run(command, capture_output=True, text=True, check=False)
    assert not run.stderr, run.stderr
    return run.returncode, run.stdout.replace(f"{folder}/", "")


class Words(unittest.TestCase):
    def assert_found(self, name, text, lines):
        advice = f'"{AGAIN}": write "restart, rebuild, again"\n'
        expected = "".join(f"{name}:{line}: {advice}" for line in lines)
        self.assertEqual(check(name, text), (1, expected))

    def test_comments_and_messages_of_cxx(self):
        self.assert_found("a.cxx", CXX, [4, 8, 10, 11])

    def test_docstrings_messages_and_comments_of_python(self):
        self.assert_found("a.py", PYTHON, [2, 5])

    def test_pages(self):
        self.assert_found("a.md", PAGE, [3, 8])

    def test_texts_of_xml(self):
        self.assert_found("a.xml", XML, [3])

    def test_first_words_of_comments(self):
        advice = 'write "a noun phrase or a verb"\n'
        expected = f'a.h:1: "What": {advice}a.h:5: "@brief Whether": {advice}'
        self.assertEqual(check("a.h", HEADS), (1, expected))

    def test_ordinary_senses_are_not_found(self):
        self.assertEqual(check("a.md", ORDINARY), (0, ""))


if __name__ == "__main__":
    unittest.main()
