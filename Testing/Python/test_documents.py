# ctest: WITHOUT_PACKAGE LABELS contract
"""Documents: each link has a target, each page is reachable, each example is shown."""

import re
import tempfile
import unittest
from pathlib import Path

import documents
from documents import ROOT

EXAMPLES = ROOT / "Examples" / "Python"
PICTURES = ROOT / "Examples" / "Pictures"
MODULES = {
    "coat_scene",
    "film_strip",
    "fluid_scenes",
    "fluid_solver",
    "grain_pile",
    "knot_label",
    "particle_series",
    "two_layers",
    "viewer_motion",
    "viewer_page",
}
# Examples that need minutes to make their particles; test_picture_splash.py tests them.
TOO_LONG = {"splash"}
# Examples with a browser page; Testing/Viewer tests them.
PAGES = {"viewer"}


class TakingApart(unittest.TestCase):
    PAGE = (
        "# A `b` (c)\n[x](#a-b-c) ![p](p.png)\n```python\n# no heading\nf[0](1)\n```\n"
        "## Two, words\n[`code`](q.md#r) and `[no](link)`\n## Two, words\n```\ndrawing\n```\n"
    )

    def test_blocks(self):
        python = "# no heading\nf[0](1)\n"
        self.assertEqual(documents.blocks(self.PAGE), [("python", python), ("", "drawing\n")])

    def test_links(self):
        self.assertEqual(documents.links(self.PAGE), ["#a-b-c", "p.png", "q.md#r"])

    def test_anchors(self):
        self.assertEqual(documents.anchors(self.PAGE), {"a-b-c", "two-words", "two-words-1"})

    def test_commands(self):
        body = "a b  # c\n# d\ne \\\n  f && g\n"
        self.assertEqual(documents.commands(body), ["a b", "e    f", "g"])

    def test_finds_what_is_broken_and_what_is_not_reached(self):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            (root / "a.md").write_text("# A\n[b](sub/b.md#b) [c](c.md) [d](sub/b.md#no) [e](#a)\n")
            (root / "sub").mkdir()
            (root / "sub" / "b.md").write_text("# B\n[up](../a.md)\n")
            (root / "lone.md").write_text("# L\n")
            self.assertEqual(documents.broken_links(root), ["a.md: c.md", "a.md: sub/b.md#no"])
            self.assertEqual(documents.reached("a.md", root), {Path("a.md"), Path("sub/b.md")})


class ThePages(unittest.TestCase):
    maxDiff = None

    def test_links_lead_somewhere(self):
        self.assertEqual(documents.broken_links(), [])

    def test_each_page_is_reached_from_the_readme(self):
        self.assertEqual(set(documents.pages()) - documents.reached("README.md"), set())

    def test_one_version(self):
        files = {
            "CMakeLists.txt": r"  VERSION (\S+)",
            "pyproject.toml": r'version = "(.*)"',
            ".github/CITATION.cff": r"version: (\S+)",
            "CHANGELOG.md": r"## (\S+)",
        }
        versions = {
            name: re.search(f"(?m)^{pattern}", (ROOT / name).read_text())[1]
            for name, pattern in files.items()
        }
        self.assertEqual(len(set(versions.values())), 1, versions)

    def test_the_readme_is_short(self):
        self.assertLessEqual(len((ROOT / "README.md").read_text().splitlines()), 110)


class TheGallery(unittest.TestCase):
    def setUp(self):
        self.gallery = (ROOT / "Examples" / "README.md").read_text(encoding="utf-8")
        self.examples = sorted({path.stem for path in EXAMPLES.glob("*.py")} - MODULES)

    def test_shows_each_example(self):
        for name in self.examples:
            with self.subTest(name):
                self.assertIn(f"](Python/{name}.py)", self.gallery)

    def test_each_example_is_short_and_a_test(self):
        tests = (ROOT / "Examples" / "CMakeLists.txt").read_text(encoding="utf-8")
        for name in self.examples:
            with self.subTest(name):
                lines = (EXAMPLES / f"{name}.py").read_text(encoding="utf-8").splitlines()
                self.assertLess(len(lines), 200 if name in PAGES else 60)
                self.assertIn(f"Run: python3 {name}.py", "\n".join(lines))
                if name not in TOO_LONG | PAGES:
                    self.assertRegex(
                        tests, rf"active_add_python_example\({name}( LONG)?( ON_RANKS \d)?\)"
                    )

    def test_pictures_are_small_and_shown(self):
        shown = {
            (ROOT / page).parent.joinpath(target).resolve()
            for page in documents.pages()
            for target in documents.links((ROOT / page).read_text(encoding="utf-8"))
            if not re.match(r"https?://", target)
        }
        for picture in sorted(PICTURES.iterdir()):
            with self.subTest(picture.name):
                self.assertLessEqual(picture.stat().st_size, 200_000)
                self.assertIn(picture.resolve(), shown)


if __name__ == "__main__":
    unittest.main()
