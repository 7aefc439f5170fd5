# ctest: LABELS contract
"""Damaged meshes and points give an OSError, or the readable rest: never a crash.

Run: python3 test_damaged_files.py
ACTIVE_RANDOM_CASES in the environment is another number of damages.
"""

import gzip
import os
import random
import tempfile
import unittest
from pathlib import Path

import numpy
import test_simulation_files as simulations
from active_implicit_surfaces.data_objects import as_particles
from active_implicit_surfaces.particle_files import open_particles
from active_implicit_surfaces.skin_files import read_shape, write_mesh, write_particles
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOPLY import vtkPLYWriter

TIMES = int(os.environ.get("ACTIVE_RANDOM_CASES", "300"))
HEADER = 600  # bytes, hit by a third of the damages


def damaged(content, chance):
    content, kind = bytearray(content), chance.random()
    if kind < 0.4:
        return content[: chance.randrange(1, len(content))]
    end = min(len(content), HEADER) if kind < 0.7 else len(content)
    for _ in range(chance.randrange(1, 6)):
        content[chance.randrange(end)] = chance.randrange(256)
    return content


class DamagedFiles(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        source = vtkSphereSource()
        source.Update()
        self.ball = source.GetOutput()

    def damage(self, path, read):
        """Number of damaged files that were read, and the errors of the others."""
        chance, content, whole, said = random.Random(path.name), path.read_bytes(), 0, []
        for _ in range(TIMES):
            path.write_bytes(damaged(content, chance))
            try:
                read(path)
                whole += 1
            except OSError as error:
                said.append(str(error))
        for sentence in said:
            self.assertIn(str(path), sentence)
            self.assertTrue(sentence.endswith("."), sentence)
        self.assertGreater(len(said), 0)
        return whole, said

    def test_meshes(self):
        for name in ("a.ply", "a.glb", "a.obj", "a.stl"):
            with self.subTest(name):
                write_mesh(self.folder / name, self.ball)
                self.assertGreater(read_shape(self.folder / name).GetNumberOfPolys(), 0)
                self.damage(self.folder / name, read_shape)

    def test_text(self):
        path = self.folder / "text.ply"
        writer = vtkPLYWriter()
        writer.SetInputData(self.ball)
        writer.SetFileName(str(path))
        writer.SetFileTypeToASCII()
        writer.Write()
        self.assertEqual(read_shape(path).GetNumberOfPolys(), self.ball.GetNumberOfPolys())
        self.damage(path, read_shape)

    def test_points(self):
        for name in ("p.ply", "p.npz", "p.csv", "p.json"):
            with self.subTest(name):
                path = self.folder / name
                write_particles(path, as_particles(numpy.eye(3), T=numpy.arange(3.0)))
                self.assertEqual(open_particles(path).load(0).GetNumberOfPoints(), 3)
                self.damage(path, lambda path: open_particles(path).load(0))

    def test_particles_of_simulations(self):
        for name, content in (
            ("p.bgeo", gzip.decompress(simulations.PARTIO)),
            ("p.bgeo.gz", simulations.PARTIO),
            ("p.dump", simulations.dump([[1, 1, 1, 2, 3], [2, 1, 4, 5, 6]])),
            ("p.gro", simulations.GRO.format(time=0, x=0)),
            ("p.pdb", simulations.MODEL.format(model=1)),
        ):
            with self.subTest(name):
                path = self.folder / name
                path.write_bytes(content if isinstance(content, bytes) else content.encode())
                self.assertGreater(open_particles(path).load(0).GetNumberOfPoints(), 1)
                self.damage(path, lambda path: open_particles(path).load(0))

    def test_lines_of_a_header_without_all_words(self):
        path = self.folder / "a.ply"
        write_mesh(path, self.ball)
        content = path.read_bytes()
        for whole, rest in (
            ("list uchar int vertex_indices", ("list", "list uchar", "list uchar int", "")),
            ("float x", ("float", "float x y", "")),
        ):
            line = f"property {whole}\n".encode()
            self.assertIn(line, content)
            for words in rest:
                with self.subTest(words):
                    path.write_bytes(
                        content.replace(line, f"property {words}".strip().encode() + b"\n")
                    )
                    with self.assertRaisesRegex(OSError, "is damaged, or no .ply"):
                        read_shape(path)

    def test_lists_of_several_lengths(self):
        path = self.folder / "quad.ply"
        head = (
            "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\n"
            "property float y\nproperty float z\nelement face 2\n"
            "property list uchar int vertex_indices\nend_header\n"
        )
        corners = numpy.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], "<f4").tobytes()

        def write(triangle, quad):
            faces = b"\3" + numpy.array(triangle, "<i4").tobytes()
            faces += b"\4" + numpy.array(quad, "<i4").tobytes()
            path.write_bytes(head.encode() + corners + faces)

        write([0, 1, 2], [0, 1, 2, 3])
        self.assertEqual(read_shape(path).GetNumberOfPolys(), 2)
        for triangle, quad in (([0, 1, 4], [0, 1, 2, 3]), ([0, 1, 2], [0, 1, 2, -1])):
            write(triangle, quad)
            with self.assertRaisesRegex(OSError, "a vertex that does not exist"):
                read_shape(path)
        path.write_bytes(path.read_bytes()[:-1])
        with self.assertRaisesRegex(OSError, "ends before the end of its last element"):
            read_shape(path)


if __name__ == "__main__":
    unittest.main()
