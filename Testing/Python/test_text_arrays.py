# ctest: LABELS contract
"""Text arrays of particles, such as names of atoms and residues: read, chosen by --where,
written.

Run: python3 test_text_arrays.py
"""

import json
import unittest
import warnings

import active_implicit_surfaces as active
import numpy
from active_implicit_surfaces import choice
from active_implicit_surfaces.data_objects import as_particles
from active_implicit_surfaces.messages import ActiveSurfaceWarning
from active_implicit_surfaces.particle_files import open_particles
from active_implicit_surfaces.skin_files import read_shape
from command_line import grid
from reader_checks import ReaderTest, array_of

SALT = ("Na", "Cl", "Na", "K")
POSITIONS = ((0, 0, 0), (3, 0, 0), (0, 4, 0), (3, 4, 0))
PDB = (
    "{kind:<6}{i:5} {name:<4} {residue:<3} {chain}{number:4}    {x:8.3f}{y:8.3f}{z:8.3f}"
    "  1.00  0.00          {element:>2}\n"
)
DUMP = """ITEM: TIMESTEP
0
ITEM: NUMBER OF ATOMS
4
ITEM: BOX BOUNDS pp pp pp
0 9
0 9
0 9
ITEM: ATOMS id label x y z
"""


def rows(form):
    """Lines of text, one for each atom: {0} is the name, {1} {2} {3} the position."""
    return "".join(form.format(name, *place) + "\n" for name, place in zip(SALT, POSITIONS))


class Readers(ReaderTest):
    def atoms_of_pdb(self):
        residues = [("ATOM", "N", "GLY", "A", "N"), ("ATOM", "O5'", "DA", "B", "O")]
        residues += [("HETATM", "NA", "LIG", "B", "NA"), ("HETATM", "O", "HOH", " ", "O")]
        return "".join(
            PDB.format(kind=k, i=i, name=n, residue=r, chain=c, number=i, x=x, y=y, z=z, element=e)
            for i, ((k, n, r, c, e), (x, y, z)) in enumerate(zip(residues, POSITIONS), 1)
        )

    def test_objects_of_python_are_refused(self):
        file = self.folder / "a.npz"
        numpy.savez(file, particles=numpy.array({"fluid": 1}, dtype=object))
        with self.assertRaisesRegex(OSError, "a.npz cannot be read .* or it has Python objects"):
            open_particles([str(file)])

    def test_each_format(self):
        gro = "{:5}{:<5}{:>5}{:5}{:8.3f}{:8.3f}{:8.3f}\n"
        ions = "".join(gro.format(1, name, name, 1, *place) for name, place in zip(SALT, POSITIONS))
        table = "x,y,z,Type,note\n" + rows('{1},{2},{3},{0},"a, b"')
        for name, text, where, count in (
            ("a.csv", table, "Type=Na", 2),
            ("a.csv", table, "Type!=Na", 2),
            ("a.csv", table, "Type=K,Cl", 2),
            ("a.csv", table, "Type == 'K'", 1),
            ("a.csv", table, 'note="a, b"', 4),
            ("b.csv", "index;what;x;y;z\n" + rows("7;'{0}';{1},5;{2},5;{3}"), "what=Na", 2),
            ("c.txt", "# x y z kind\n" + rows("{1} {2} {3} {0}"), "kind=Na", 2),
            ("d.csv", "x,y,z,Type\n" + rows("{1},{2},{3},{0}#1"), "Type=Na#1", 2),
            ("e.csv", "x,y,z,Type,T\n" + rows("{1},{2},{3},{0},"), "Type=Na", 2),
            ("f.csv", "x,y,z,Type\n0,0,0,Na\n1,1,1\n2,2,2,\n", 'Type=""', 2),
            ("g.csv", "x,y,z,Type\n0,0,0,Na\n1,1,1,Na\n", "Type=Na", 2),
            ("a.xyz", "4\n\n" + rows("{0} {1} {2} {3}"), "element=Na", 2),
            ("a.xyz", "4\n\n" + rows("{0} {1} {2} {3}"), "species=K", 1),
            (
                "b.xyz",
                "4\nProperties=pos:R:3:resname:S:1\n" + rows("{1} {2} {3} {0}"),
                "resname=K",
                1,
            ),
            ("a.pdb", self.atoms_of_pdb(), "resname=LIG", 1),
            ("a.pdb", self.atoms_of_pdb(), "resname!=HOH,LIG", 2),
            ("a.pdb", self.atoms_of_pdb(), "name=O5'", 1),
            ("a.pdb", self.atoms_of_pdb(), "chain=B", 2),
            ("a.pdb", self.atoms_of_pdb(), 'chain=""', 1),
            ("a.pdb", self.atoms_of_pdb(), "element=Na", 1),
            ("a.gro", f"ions\n 4\n{ions}9 9 9\n", "resname=Na", 2),
            ("a.gro", f"ions\n 4\n{ions}9 9 9\n", "name=Cl,K", 2),
            ("a.dump", DUMP + rows("1 {0} {1} {2} {3}"), "label=Na", 2),
        ):
            with self.subTest(name=name, where=where):
                series = open_particles(self.put(name, text), where=where)
                self.assertEqual(series.load(0).GetNumberOfPoints(), count)

    def test_frames_of_a_table(self):
        text = "t,x,y,z,Type\n" + rows("0,{1},{2},{3},{0}") + rows("0.5,{3},{1},{2},{0}s")
        series = open_particles(self.put("a.csv", text))
        self.assertEqual(series.times, [0, 0.5])
        self.assertEqual(array_of(series.load(1), "Type"), ["Nas", "Cls", "Nas", "Ks"])

    def test_columns_that_are_called_as_keys_of_this_package(self):
        text = "x,y,z,field,symbols,id,ids,radius\n0,0,0,1,2,p1,q1,r1\n1,0,0,1,2,p2,q2,r2\n"
        cloud = open_particles(self.put("a.csv", text)).load(0)
        self.assertEqual(array_of(cloud, "field"), [1, 1])
        self.assertEqual(array_of(cloud, "symbols"), [2, 2])
        self.assertEqual(array_of(cloud, "radius"), ["r1", "r2"])
        skin = active.skin(cloud, particle_spacing=1)
        self.assertGreater(skin.GetNumberOfPoints(), 0, "texts are no ids of particles")


class Choices(unittest.TestCase):
    def setUp(self):
        self.cloud = as_particles(numpy.array(POSITIONS, float), Type=SALT, kind=[1, 2, 1, 4])

    def test_absent_values_are_said(self):
        for where, said in (
            ("Type=Li", "There is no Type=Li; Type is Cl, K, Na."),
            ("Type=na,li", "There is no Type=na,li; Type is Cl, K, Na."),
            ("kind=3", "There is no kind=3; kind is 1, 2, 4."),
            ("kind=Na", "'kind' holds numbers, not texts; kind is 1, 2, 4."),
            ("Type>3", "'Type' holds texts, which are compared by = and != only"),
            ("Sort=Na", "There is no array 'Sort' to choose by; there are x, y, z, Type, kind."),
        ):
            with self.subTest(where), self.assertRaises(ValueError) as caught:
                choice.choose(self.cloud, where)
            self.assertIn(said, str(caught.exception))

    def test_a_part_that_is_absent_is_a_note(self):
        for where, count in (("Type=Na,Li", 2), ("Type!=Li", 4), ("kind!=3", 4)):
            with self.subTest(where), self.assertWarnsRegex(ActiveSurfaceWarning, "There is no "):
                self.assertEqual(choice.choose(self.cloud, where).GetNumberOfPoints(), count)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertEqual(choice.choose(self.cloud, "Type!=Na").GetNumberOfPoints(), 2)

    def test_frames(self):
        clouds = [as_particles(grid() + i, Type=(["Na", "Cl", "Na"] * 42)[:125]) for i in range(2)]
        way = active.frames(clouds, where="Type=Cl", particle_spacing=0.1)
        self.assertEqual(way.source.frame(1).GetNumberOfPoints(), 42)
        with (
            self.assertWarnsRegex(ActiveSurfaceWarning, "In a frame: there is no Type=K; Type is"),
            self.assertRaisesRegex(ValueError, "No frame has particles that meet Type=K"),
        ):
            active.frames(clouds, where="Type=K")

    def test_labels_are_numbers(self):
        with self.assertRaisesRegex(ValueError, "the values are texts"):
            choice.labels_of(as_particles(numpy.eye(3), label=["a", "b", "c"]))


class Programs(ReaderTest):
    def setUp(self):
        super().setUp()
        lines = [f"{x},{y},{z},{'sand' if x < 0.15 else 'clay'}" for x, y, z in grid().tolist()]
        self.put("a.csv", "x,y,z,Type\n" + "\n".join(lines) + "\n")

    def test_commands(self):
        arguments = ("--where", "Type=sand", "--quiet", "--particle-spacing", 0.1)
        self.succeed("skin", "a.csv", *arguments, "-o", "a.ply")
        self.assertLess(read_shape(self.folder / "a.ply").GetBounds()[1], 0.2)
        found = json.loads(self.succeed("info", "a.csv", "--json").out)
        self.assertEqual(found["arrays"]["Type"], "texts, clay 75, sand 50")
        found = json.loads(self.succeed("info", "a.csv", "--where", "Type=clay", "--json").out)
        self.assertEqual(found["points"], 75)
        for command, more in (("skin", ()), ("info", ()), ("convert", ("-o", "b.csv"))):
            said = self.fail_with(1, command, "a.csv", "--where", "Type=salt", *more)
            self.assertIn("There is no Type=salt; Type is clay, sand.", said)
            self.assertFalse((self.folder / "b.csv").exists())

    def test_texts_are_written(self):
        text = 'x,y,z,Type,id,T\n0,0,0,"a, ""b""",9007199254740993,0.1\n1,0,0,,2,1e-9\n'
        self.put("b.csv", text)
        for name in ("c.csv", "c.json", "c.npz", "c.vtp"):
            self.succeed("convert", "b.csv", "-o", name)
            cloud = open_particles(name).load(0)
            self.assertEqual(array_of(cloud, "Type"), ['a, "b"', ""], name)
            self.assertEqual(array_of(cloud, "T"), [0.1, 1e-9], name)
        self.assertIn("left out", self.succeed("convert", "b.csv", "-o", "c.ply").err)
        arguments = ("--pass-target-arrays", "--particle-spacing", 0.1, "--quiet")
        for suffix, is_held in ((".vtp", True), (".vdb", False), (".glb", False)):
            said = self.succeed("skin", "a.csv", *arguments, "-o", "a" + suffix).err
            self.assertEqual("cannot hold Type," not in said, is_held, suffix)
        numpy.savez("d.npz", positions=numpy.eye(3), id=numpy.array([2**53 + 1, 2, 3]))
        self.succeed("convert", "d.npz", "-o", "d.csv")
        self.assertIn("9007199254740993", (self.folder / "d.csv").read_text())


if __name__ == "__main__":
    unittest.main()
