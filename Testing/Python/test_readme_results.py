# ctest: DISPLAY LABELS contract
"""Results of the pages' own command lines: closed, outward skins of the right volume.

test_document_blocks.py tests films.

Run: python3 test_readme_results.py
"""

import shlex
import unittest

import documents
import numpy
import test_document_blocks as blocks
from active_implicit_surfaces import skin
from active_implicit_surfaces.contours import contour
from active_implicit_surfaces.measures import measure
from active_implicit_surfaces.skin_files import read_shape
from command_line import grid

PAGES = ("README.md", "Python/README.md", "Python/command_line.md")
MESHES = (".vtp", ".ply", ".obj", ".stl", ".glb", ".vdb")
# The particles are 5 x 5 x 5, 0.1 apart. Presets and models round their corners differently.
PARTICLES = (0.5**3, 0.25)
CUBE, BALL = (1.0, 0.02), (numpy.pi / 6, 0.15)  # VTK's own ball has eight sides


class Results(blocks.Blocks):
    test_all_of_them = None  # run by its own file

    def setUp(self):
        super().setUp()
        self.numbers = 0

    def made_by(self, command):
        """Runs a command, and returns the meshes that it made. Earlier meshes are removed, except
        before info."""
        known = {"bunny.stl", "horse.stl", "horse.ply", "skin_0040.vdb"}
        for path in self.folder.glob("*"):
            is_own = path.name in known or "splash" in path.name
            if path.suffix in MESHES and not is_own and " info " not in command:
                path.unlink()
        self.succeed(*blocks.arguments_of(command))
        found = (path for path in self.folder.glob("[!.]*") if path.suffix in MESHES)
        return sorted(p for p in found if p.name not in known and "splash" not in p.name)

    def check(self, path, wanted, share):
        is_grid = path.suffix == ".vdb"
        found = measure(contour(read_shape(path), 0.0) if is_grid else read_shape(path))
        self.assertEqual(found["open edges"], 0, path.name)
        self.assertAlmostEqual(found["volume"] / wanted, 1.0, delta=share, msg=path.name)
        self.numbers += 1

    def check_command(self, command):
        kind = shlex.split(command)[1]
        made = self.made_by(command)
        if kind == "morph":
            self.check(made[0], *CUBE)
            self.check(made[-1], *BALL)
        elif kind == "convert":
            self.check(made[0], measure(skin(grid(), particle_spacing=0.1))["volume"], 0.01)
        elif kind == "skin":
            self.assertTrue(made, command)
            for path in made:
                self.check(path, *PARTICLES)

    def test_meshes(self):
        for page in PAGES:
            for language, body in documents.blocks((documents.ROOT / page).read_text()):
                for command in documents.commands(body) if language == "bash" else ():
                    if blocks.PROGRAM.match(command) and "--render" not in command:
                        with self.subTest(page=page, command=command):
                            self.check_command(command)
        self.assertGreater(self.numbers, 15)


if __name__ == "__main__":
    unittest.main()
