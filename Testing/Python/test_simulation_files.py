# ctest: LABELS contract
"""Particles of simulations: .bgeo of partio itself, dumps of LAMMPS, .gro, .pdb, PySPH's .hdf5.

Run: python3 test_simulation_files.py
"""

import base64
import gzip
import math
import sys
import unittest
from unittest import mock

import numpy
from active_implicit_surfaces.measures import measure
from active_implicit_surfaces.particle_files import open_particles
from active_implicit_surfaces.skin_files import read_shape
from command_line import grid
from reader_checks import ReaderTest, array_of
from vtkmodules.util.numpy_support import vtk_to_numpy

# Written by partio itself: 3 particles with velocity, id, density and a text.
PARTIO = base64.b64decode(
    "H4sIAAAAAAAA/3NKT80PY2BgYAViZgZUwILEZmTgKEvNyU/OLKkEq2NFUcmUmQJUwQDGDAzsKal5xSCFjAijsjPzIEpA"
    "hjIxsJYnlqQWMTDnZ+bYNTAwABGDZ4kKg30DRLk9wmh2lyqo2AIGhgMQdQIgdWAM5O+H6GFzqXIAO9RBAKiuAaxOAaTG"
    "AWreAYgxrC5VUEtYi5MTc1IRjnRQABL/AVcmNWYRAQAA"
)
DUMP = """ITEM: UNITS
lj
ITEM: TIME
{time}
ITEM: TIMESTEP
{step}
ITEM: NUMBER OF ATOMS
{count}
ITEM: BOX BOUNDS {sides}
{box}
ITEM: ATOMS {columns}
{rows}
"""
BOX = "0 10\n-5 5\n2 4"
GRO = """Water and an ion, t= {time}
    3
    1SOL     OW    1   {x}.126   1.624   1.679  0.1227 -0.0580  0.0434
    1SOL    HW1    2   0.190   1.661   1.747  0.8085  0.3191 -0.7791
    2CA      CA    3   0.177   1.568   1.613 -0.9045 -2.6469  1.3180
   1.82060   1.82060   1.82060
"""
MODEL = """MODEL        {model}
ATOM      1  N   ALA A   1      1{model}.104   6.134  -6.504  1.00  5.00           N
ATOM      2  CA AALA A   1      11.639   6.071  -5.147  0.50  6.00           C
ATOM      3  CA BALA A   1      11.739   6.171  -5.147  0.50  6.00           C
TER
ATOM      4 HG11 VAL B   2      12.739   6.171  -5.147  1.00  6.00
HETATM    5 CA    CA B 101      13.559  86.257  95.222  1.00  7.00          CA
ENDMDL
"""


def field_of(cloud, name):
    return vtk_to_numpy(cloud.GetFieldData().GetArray(name))


def dump(rows, columns="id type x y z", step=0, time=0.5, box=BOX, sides="pp pp ff"):
    text = "\n".join(" ".join(map(str, row)) for row in rows)
    count = len(rows)
    return DUMP.format(**{**locals(), "rows": text})


class Bgeo(ReaderTest):
    def test_what_partio_writes(self):
        for name, content in (("a.bgeo.gz", PARTIO), ("a.bgeo", gzip.decompress(PARTIO))):
            cloud = open_particles(self.put(name, content)).load(0)
            self.assert_points(cloud, [[0.25, 0, 1e6], [1.25, -2, 1e6 + 1], [2.25, -4, 1e6 + 2]])
            self.assertEqual(array_of(cloud, "velocity"), [[0, 0.5, 0], [1, 0.5, -1], [2, 0.5, -2]])
            self.assertEqual(array_of(cloud, "id"), [7, 6, 5])
            self.assertEqual(array_of(cloud, "density"), [1000, 1001, 1002])
            self.assertEqual(array_of(cloud, "kind"), ["water", "oil", "water"])

    def test_damage(self):
        whole = gzip.decompress(PARTIO)
        for content in (whole[:60], whole[:-60], PARTIO[:90], whole[:9] + b"\xff" * 4 + whole[13:]):
            self.assert_refused("it is damaged", self.put("a.bgeo", content))
        self.assert_refused("it is no .bgeo", self.put("a.bgeo", b"PGEOMETRY V5"))
        self.assert_refused("newer .bgeo; save it as", self.put("a.bgeo", b"\x7fNSJb"))


class Dumps(ReaderTest):
    def test_frames_columns_and_box(self):
        rows = [[2, 1, 1, 2, 3, 7, 8, 9], [1, 2, 4, 5, 6, 1, 1, 1]]
        columns = "id type x y z vx vy vz"
        text = dump(rows, columns) + dump(rows[1:], columns, 100, 1.25) + dump([], columns, 200, 2)
        series = open_particles(self.put("a.lammpstrj", text))
        self.assertEqual(series.times, [0.5, 1.25, 2.0])
        cloud = series.load(0)
        self.assert_points(cloud, [[1, 2, 3], [4, 5, 6]])
        self.assertEqual(array_of(cloud, "id"), [2, 1])
        self.assertEqual(array_of(cloud, "v"), [[7, 8, 9], [1, 1, 1]])
        self.assertEqual(field_of(cloud, "Lattice").ravel().tolist(), [10, 0, 0, 0, 10, 0, 0, 0, 2])
        self.assertEqual(field_of(cloud, "pbc").tolist(), [[1, 1, 0]])
        self.assertEqual([series.load(i).GetNumberOfPoints() for i in (1, 2)], [1, 0])

    def test_positions_as_shares_of_the_box(self):
        row = [1, 1, 0.5, 0.25, -0.5]
        slanted = "-1 13 3\n-5 5 -1\n2 4 0"  # of the box 0 to 10 along x
        for box, wanted in (
            (BOX, [5, -2.5, 1]),
            (slanted, [5 + 0.25 * 3 - 0.5 * -1, -2.5, 1]),
            ("10 0 0 0\n3 10 0 -5\n-1 0 2 2", [5 + 0.25 * 3 + 0.5, -2.5, 1]),
        ):
            for columns in ("id type xs ys zs", "id type xsu ysu zsu"):
                path = self.put("a.dump", dump([row], columns, box=box))
                self.assert_points(open_particles(path).load(0), [wanted])
        path = self.put("a.dump", dump([row], "id type xu yu zu"))
        self.assert_points(open_particles(path).load(0), [[0.5, 0.25, -0.5]])

    def test_elements_and_names_of_files(self):
        for step in (0, 50, 200):
            rows = [["C", 0, 0, step], ["O", 1, 0, 0]]
            self.put(f"dump.melt.{step}", dump(rows, "element x y z", step, time=step))
        series = open_particles("dump.melt.*")
        self.assertEqual([path.name[10:] for path in series.names], ["0", "50", "200"])
        self.assertEqual(series.times, [0, 50, 200])
        self.assertEqual(array_of(series.load(2), "atomic_number"), [6, 8])

    def test_damage(self):
        whole = dump([[1, 1, 1, 2, 3], [2, 1, 4, 5, 6]])
        for words, text in (
            ("a frame has only 1 of 2 atoms", whole[:-11]),
            ("it is no dump", "1 2 3\n"),
            ("it is binary; write it as text", b"\0\1" + bytes(90)),
            ("a frame is incomplete or damaged", whole.replace("ITEM: BOX", "ITEM: BIX")),
            ("its BOX BOUNDS are not 3 rows", dump([[1, 1, 0, 0, 0]], box="0 1")),
            (r"an atom has 4 column\(s\), but its frame names 5", dump(["1123"])),
            ('the row "2 1 a 0 0" for an atom', dump([[1, 1, 0, 0, 0], "21a00"])),
            ('the row "2 1 0 0" for an atom', dump([[1, 1, 0, 0, 0], "2100"])),
            ("columns are id, type, a", whole.replace("x y z", "a b c")),
        ):
            self.assert_refused(words, self.put("a.dump", text))


class Atoms(ReaderTest):
    def test_gro(self):
        text = "".join(GRO.format(time=time, x=x) for time, x in ((0, 0), (2.5, 1)))
        series = open_particles(self.put("a.gro", text))
        self.assertEqual(series.times, [0, 2.5])
        cloud = series.load(1)
        self.assert_points(
            cloud, [[1.126, 1.624, 1.679], [0.19, 1.661, 1.747], [0.177, 1.568, 1.613]]
        )
        self.assertEqual(array_of(cloud, "atomic_number"), [8, 1, 20])
        self.assertEqual(array_of(cloud, "residue"), [1, 1, 2])
        self.assertEqual(array_of(cloud, "Velocity")[2], [-0.9045, -2.6469, 1.318])
        self.assertEqual(field_of(cloud, "Lattice").diagonal().tolist(), 3 * [1.8206])
        partly = text.replace("-0.9045 -2.6469  1.3180", "").replace(
            "1.82060   1.82060", "40000.0000040000.00000"
        )
        cloud = open_particles(self.put("b.gro", partly)).load(1)
        self.assertFalse(cloud.GetPointData().HasArray("Velocity"))
        self.assertEqual(field_of(cloud, "Lattice").diagonal().tolist(), [40000, 40000, 1.8206])
        for words, wrong in (
            ("ends before the 3 atoms that line 2 declares, or before their box", text[:150]),
            ("line 2 is not the number of atoms", "a\nb\n"),
            ('x   1.82060", not 3 or 9 numbers', text.replace("0   1.82060   1", "0   x   1")),
            ('"1.82060", not 3 or 9 numbers', text.replace("1.82060   1.82060   ", "")),
            ("line 4 lacks a valid position, velocity", text.replace("0.190", "x.190")),
        ):
            self.assert_refused(words, self.put("b.gro", wrong))

    def test_pdb(self):
        cell = "CRYST1   20.000   21.000   22.000  90.00  90.00  60.00 P 1           1\n"
        text = cell + MODEL.format(model=1) + MODEL.format(model=2) + "END\n"
        series = open_particles(self.put("a.pdb", text))
        self.assertEqual(len(series), 2)
        cloud = series.load(1)
        self.assertEqual(cloud.GetPoint(0), (12.104, 6.134, -6.504))
        self.assertEqual(array_of(cloud, "atomic_number"), [7, 6, 1, 20])
        self.assertEqual(array_of(cloud, "residue"), [1, 1, 2, 101])
        self.assertEqual(array_of(cloud, "chain"), ["A", "A", "B", "B"])
        self.assertEqual(array_of(cloud, "hetero"), [0, 0, 0, 1])
        edges = field_of(cloud, "Lattice")
        numpy.testing.assert_allclose(edges[1], [10.5, 21 * math.sqrt(0.75), 0], atol=1e-9)
        self.assert_refused("it has no ATOM", self.put("b.pdb", cell))

    def test_a_lone_atom_has_its_radius_in_either_unit(self):
        """Calcium of 2.4 Angstrom, in nm and in Angstrom. The radius follows from the skin's
        volume, to 3 %."""
        self.put("a.gro", "ion\n    1\n    1CA      CA    1   0.000   0.000   0.000\n1 1 1\n")
        ion = "HETATM    1 CA    CA A   1       0.000   0.000   0.000  1.00  0.00          CA\n"
        self.put("a.pdb", ion)
        for name, radius in (("a.gro", 0.24), ("a.pdb", 2.4)):
            voxel = ("--voxel-size", radius / 12)
            self.succeed("skin", name, "--preset", "molecule", *voxel, "-o", "a.ply", "--quiet")
            volume = measure(read_shape(self.folder / "a.ply"))["volume"]
            self.assertAlmostEqual(
                (volume / (4 / 3 * math.pi)) ** (1 / 3), radius, delta=0.03 * radius
            )


class PySPH(ReaderTest):
    def test_without_h5py(self):
        with mock.patch.dict(sys.modules, {"h5py": None}):
            said = self.fail_with(1, "skin", self.put("run_0.hdf5", "text"), "--quiet")
        self.assertIn(
            "run_0.hdf5 cannot be read as particles: it needs h5py (Debian: python3-h5py", said
        )

    def test_kinds_of_particles(self):
        try:
            import h5py
        except ImportError:
            raise unittest.SkipTest("h5py is not installed") from None
        points = grid(3)
        for step in (0, 10):
            with h5py.File(f"run_{step}.hdf5", "w") as file:
                file.create_group("solver_data").attrs["t"] = 0.5 * step
                for i, (name, count) in enumerate((("fluid", 27), ("inlet", 0), ("walls", 9))):
                    arrays = file.create_group(f"particles/{name}/arrays")
                    columns = {
                        **dict(zip("xyz", points[:count].T)),
                        "u": numpy.full(count, 2.0 + i),
                    }
                    columns |= {
                        "v": numpy.zeros(count),
                        "w": numpy.zeros(count),
                        "A": range(3 * count),
                    }
                    for key, values in columns.items():
                        own = arrays.create_dataset(key, data=list(values))
                        own.attrs["stored"], own.attrs["stride"] = True, 3 if key == "A" else 1
                    arrays.create_dataset("rho", (0,), "f4").attrs["stored"] = False
        series = open_particles(["run_0.hdf5", "run_10.hdf5"])
        self.assertEqual(series.times, [0, 5])
        cloud = series.load(1)
        self.assert_points(cloud, numpy.vstack([points, points[:9]]).round(6))
        self.assertEqual(array_of(cloud, "array"), 27 * ["fluid"] + 9 * ["walls"])
        self.assertEqual(array_of(cloud, "Velocity"), 27 * [[2, 0, 0]] + 9 * [[4, 0, 0]])
        self.assertEqual(cloud.GetPointData().GetArray("A").GetNumberOfComponents(), 3)
        self.assert_refused("no .hdf5 of PySPH", self.put("a.hdf5", "text"))


if __name__ == "__main__":
    unittest.main()
