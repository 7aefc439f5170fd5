# ctest: LABELS contract
"""Readers follow the contents of a file: the dialect of a table, the columns of atoms and of
vertices.

Run: python3 test_readers.py
"""

import json
import math
import unittest
import warnings

import numpy
from active_implicit_surfaces.data_objects import finite_points
from active_implicit_surfaces.messages import ActiveSurfaceWarning
from active_implicit_surfaces.particle_files import open_particles
from active_implicit_surfaces.skin_files import read_shape
from reader_checks import ReaderTest, array_of
from vtkmodules.util.numpy_support import vtk_to_numpy

ROWS = [[0.5, 1.25, -2.0], [1.5, 2.25, 3.0]]


class Tables(ReaderTest):
    def test_dialects(self):
        texts = {
            "comma": "x,y,z\n0.5,1.25,-2\n1.5,2.25,3\n",
            "decimal commas, tabs": "x\ty\tz\n0,5\t1,25\t-2,0\n1,5\t2,25\t3,0\n",
            "decimal commas, blanks": "x y z\n0,5 1,25 -2,0\n1,5 2,25 3,0\n",
            "decimal commas, quotes": '"x","y","z"\n"0,5","1,25","-2,0"\n"1,5","2,25","3,0"\n',
            "decimal commas, no header": "0,5;1,25;-2,0\n1,5;2,25;3,0\n",
            "exponents with commas": "x;y;z\n5,0E-1;12,5E-1;-2,0E0\n1,5E0;2,25e+0;3\n",
            "bars": "x|y|z\n0.5|1.25|-2\n1.5|2.25|3\n",
            "runs of blanks": "  x   y\t z\n 0.5  1.25   -2\n 1.5\t2.25  3\n",
            "blanks behind commas": "x, y, z\n0.5, 1.25, -2\n1.5, 2.25, 3\n",
            "single quotes": "'x','y','z'\n'0.5','1.25','-2'\n'1.5','2.25','3'\n",
            "names in quotes, blanks": '"x [m]" "y [m]" "z [m]"\n0.5 1.25 -2\n1.5 2.25 3\n',
            "pandas, tabs": "\tx\ty\tz\n0\t0.5\t1.25\t-2\n1\t1.5\t2.25\t3\n",
            "pandas, texts": ',kind,x,y,z\n0,"a, b",0.5,1.25,-2\n1,"c #2",1.5,2.25,3\n',
            "R, numbers of rows": '"x" "y" "z"\n"1" 0.5 1.25 -2\n"2" 1.5 2.25 3\n',
            "R, names of rows": '"x","y","z"\n"a",0.5,1.25,-2\n"b",1.5,2.25,3\n',
            "sep= of Excel": "sep=;\nx;y;z\n0,5;1,25;-2\n1,5;2,25;3\n",
            "lines before": "run 7\n\nmass 3\nx,y,z\n0.5,1.25,-2\n1.5,2.25,3\n",
            "Fluent": "[Name]\nfluid\n\n[Data]\nX [ m ], Y [ m ], Z [ m ]\n"
            "0.5,1.25,-2\n1.5,2.25,3\n",
            "Comsol": "% Model: a\n% x                    y   z\n0.5 1.25 -2\n1.5 2.25 3\n",
            "count before": "2\n0.5,1.25,-2\n1.5,2.25,3\n",
            "units": "x,y,z,T\nm,m,m,K\n0.5,1.25,-2,1\n1.5,2.25,3,1\n",
            "units, some without": "x,y,z,n\nm,m,m,-\n0.5,1.25,-2,1\n1.5,2.25,3,1\n",
            "separator at the end": "x,y,z\n0.5,1.25,-2,\n1.5,2.25,3,\n",
            "old Mac": "x,y,z\r0.5,1.25,-2\r1.5,2.25,3\r",
            "Windows, mark": "\ufeffx,y,z\r\n0.5,1.25,-2\r\n1.5,2.25,3\r\n",
            "comments": "# x y z of all\n0.5 1.25 -2\n# a note\n1.5 2.25 3 # last\n",
            "times of one frame": "Time,x,y,z\n3,0.5,1.25,-2\n3,1.5,2.25,3\n",
            "separator at the end of the header": "x,y,z,\n0.5,1.25,-2\n1.5,2.25,3\n",
            "Fortran": "x y z\n5.0D-1 1.25d0 -2.\n0.15D+1 2.25 3\n",
            "numbers of rows, no header": "0,0.5,1.25,-2\n1,1.5,2.25,3\n2,NaN,NaN,NaN\n",
            "texts at the end, no header": "0.5 1.25 -2 a\n1.5 2.25 3 b\n",
            "UTF-16": "x;y;z\n0.5;1.25;-2\n1.5;2.25;3\n".encode("utf-16"),
            "Latin-1": "x;y;z;µ\n0.5;1.25;-2;1\n1.5;2.25;3;1\n".encode("latin-1"),
        }
        for kind, text in texts.items():
            with self.subTest(kind):
                series = open_particles(self.put("a.csv", text))
                self.assertEqual(len(series), 1)
                self.assert_points(finite_points(series.load(0)), ROWS)

    def test_names_of_positions(self):
        """Columns in any order, beside other vectors."""
        for names in (
            "x_pos y_pos z_pos",
            "xpos ypos zpos",
            "x-coordinate y-coordinate z-coordinate",
            "Location.X Location.Y Location.Z",
            "centroid_x centroid_y centroid_z",
            "Position[X](m) Position[Y](m) Position[Z](m)",
            "pos[i] pos[j] pos[k]",
            "x_mm y_mm z_mm",
            "x/m y/m z/m",
            "rx ry rz",
            "Xp Yp Zp",
        ):
            for heads, first in ((names.split(), 0), (["id", "vx", "vy", "vz", *names.split()], 4)):
                with self.subTest(heads):
                    cells = [[7, 8, 8, 8][:first] + row for row in ROWS]
                    lines = "\n".join(",".join(map(str, row)) for row in (heads, *cells))
                    cloud = open_particles(self.put("a.csv", lines)).load(0)
                    self.assert_points(cloud, ROWS)
                    if first:
                        self.assertEqual(array_of(cloud, "v"), 2 * [[8, 8, 8]])

    def test_other_vectors_are_no_positions(self):
        for names in (
            "xx,xy,xz",
            "px,py,pz",
            "Points:0,Points:1,Points:2",
            "x-speed,y-speed,z-speed",
        ):
            with self.subTest(names):
                path = self.put("a.csv", f"{names},x,y,z\n9,8,7,1,2,3\n")
                cloud = open_particles(path).load(0)
                self.assert_points(cloud, [[1, 2, 3]])
                base = {"x": "x", "p": "p", "P": "Points"}[names[0]] if names[1] != "-" else "speed"
                self.assertEqual(array_of(cloud, base), [[9, 8, 7]])

    def test_row_numbers_without_a_header_are_a_note(self):
        for text, is_note in (("0,5,6,7\n1,5,6,8\n2,5,6,9\n", 1), ("0,1,2\n1,1,3\n2,1,4\n", 0)):
            with warnings.catch_warnings(record=True) as said:
                warnings.simplefilter("always")
                cloud = open_particles(self.put("a.csv", text)).load(0)
            self.assertEqual(len(said), is_note)
            self.assertEqual(cloud.GetPoint(2), (5, 6, 9) if is_note else (2, 1, 4))

    def test_other_extensions_of_tables(self):
        for name in ("a.txt", "a.tsv", "a.dat"):
            cloud = open_particles(self.put(name, "x\ty\tz\n1\t2\t3\n")).load(0)
            self.assertEqual(cloud.GetPoint(0), (1, 2, 3))

    def test_empty_cells_are_of_their_row(self):
        for empty in ("", "NaN", "NA", '""', "null"):
            with self.subTest(empty):
                text = f"x,y,z,T\n1,{empty},3,5\n4,5,6,{empty}\n7,8,9,1\n"
                cloud = open_particles(self.put("a.csv", text)).load(0)
                self.assertEqual(cloud.GetNumberOfPoints(), 3)
                self.assertTrue(math.isnan(cloud.GetPoint(0)[1]))
                self.assertEqual(cloud.GetPoint(2), (7, 8, 9))
                heat = array_of(cloud, "T")
                self.assertEqual((heat[0], math.isnan(heat[1]), heat[2]), (5, True, 1))

    def test_a_column_of_times_makes_frames(self):
        rows = "1,{0},x,y,z\n1,0.5,0,0,0\n1,2,0,1,0\n2,0.5,1,0,0\n2,2,1,1,0\n3,2,5,5,5\n"
        for name, times in (
            ("time", [0.5, 2.0]),
            ("Time [s]", [0.5, 2.0]),
            ("t", [0.5, 2.0]),
            ("frame", [0.0, 0.04]),
            ("TimeStep", [0.0, 0.04]),
        ):
            with self.subTest(name):
                text = rows.replace("1,{0}", f"id,{name}", 1)
                series = open_particles(self.put("a.csv", text))
                self.assertEqual(series.times, times)
                self.assert_points(series.load(0), [[0, 0, 0], [1, 0, 0]])
                self.assertEqual(array_of(series.load(1), "id"), [1, 2, 3])
        series = open_particles(self.put("a.csv", "x,y,z,T\n1,2,3,4\n1,2,3,5\n"))
        self.assertEqual(len(series), 1)  # T is a temperature

    def test_times_of_a_series_of_tables(self):
        for step, time in enumerate((0.5, 2.0, 2.5)):
            self.put(f"p_{step}.csv", f"x,y,z,Time\n1,2,3,{time}\n4,5,6,{time}\n")
        self.assertEqual(open_particles(self.folder / "p_*.csv").times, [0.5, 2.0, 2.5])

    def test_what_is_wrong_is_said(self):
        for words, text in {
            "decimal marks": "x,y,z\n0,5,1,25,2,0\n",
            "line 2 has 2 column": "x,y,z\n1,2\n",
            'line 3 has "1.000,5"': "x;y;z\n1;2;3\n4;1.000,5;6\n",
            "no columns x, y and z of numbers.*; it has a, b, c": "a,b,c\n1,2,3\n",
            "it has x, z; text is in y": "x;y;z\n1.5;2,5;3\n",
            "no columns x, y and z of numbers.*; it has no named": "x,y,z\na,b,c\nd,e,f\n",
            "line 4 has 1 column": 'x,y,z\n1,2,3\n1,,3\n"4,5,6\n',
            "line 2 has 4 column": "1 2 3\n4 5 6 7\n",
            'line 4 has "six" in place of a number': "x,y,z\n1,2,3\n\n4,5,six\n",
            "it is no text": b"x,y,z\n1,2,\0\n",
        }.items():
            with self.subTest(words):
                self.assert_refused(words, self.put("a.csv", text))

    def test_tables_of_pandas_as_json(self):
        rows = [dict(zip(("x", "y", "z", "T"), [*row, 5])) for row in ROWS]
        columns = {name: {str(i): row[name] for i, row in enumerate(rows)} for name in rows[0]}
        for content in (rows, columns):
            cloud = open_particles(self.put("a.json", json.dumps(content))).load(0)
            self.assert_points(cloud, ROWS)
            self.assertEqual(array_of(cloud, "T"), [5, 5])

    def test_headers_of_a_cloud_of_points(self):
        for head in ("//x y z r", "# x y z r", "x y z r"):
            cloud = open_particles(self.put("a.xyz", f"{head}\n1 2 3 4\n5 6 7 8\n")).load(0)
            self.assertEqual(array_of(cloud, "r"), [4, 8])


class Molecules(ReaderTest):
    def numbers(self, *symbols):
        rows = "".join(f"{symbol} {i} 0 0\n" for i, symbol in enumerate(symbols))
        path = self.put("a.xyz", f"{len(symbols)}\n\n{rows}")
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            cloud = open_particles(path).load(0)
        has_numbers = cloud.GetPointData().HasArray("atomic_number")
        found = array_of(cloud, "atomic_number") if has_numbers else None
        return found, " ".join(str(one.message) for one in said)

    def test_names_of_atoms(self):
        for symbols, wanted in (
            (("N", "CA", "CB", "HA", "C", "O"), [7, 6, 6, 1, 6, 8]),
            (("N", "CA", "C", "O"), [7, 6, 6, 8]),
            (("CA", "CA"), [6, 6]),
            (("OW", "HW1", "HW2", "MW", "NA", "CL"), [8, 1, 1, 0, 11, 17]),
            (("1HB2", "HG21", "CG", "ND1", "SD", "OXT"), [1, 1, 6, 7, 16, 8]),
            (("OH2", "H1", "SOD", "CLA", "FE", "ZN"), [8, 1, 11, 17, 26, 30]),
        ):
            with self.subTest(symbols):
                found, said = self.numbers(*symbols)
                self.assertEqual(found, wanted)
                self.assertIn("names of atoms, from which elements are guessed", said)
                self.assertEqual("CA is C" in said, "CA" in symbols)

    def test_elements_stay_elements(self):
        for symbols, wanted in (
            (("Ca", "C", "O"), [20, 6, 8]),
            (("C1", "H12", "Hg3"), [6, 1, 80]),
            (("C1'", "O5*", "P", "H5''"), [6, 8, 15, 1]),
            (("Na+", "Cl-", "Fe3+"), [11, 17, 26]),
            (("6", "8", "1"), [6, 8, 1]),
            (("c", "h", "si"), [6, 1, 14]),
        ):
            with self.subTest(symbols):
                self.assertEqual(self.numbers(*symbols), (wanted, ""))

    def test_elements_in_capital_letters_may_be_names(self):
        for symbols, wanted, doubtful in (
            (("CA", "CL"), [20, 17], "CA is Ca"),
            (("HG", "CD"), [80, 48], "CD is Cd, HG is Hg"),
        ):
            found, said = self.numbers(*symbols)
            self.assertEqual(found, wanted)
            self.assertIn(f"capital letters are read as elements: {doubtful}. ", said)

    def test_columns_without_names(self):
        path = self.put("a.xyz", "2\n\nO 1 2 3 -0.8 5 a\nH 4.D0 5 6D-1 0.4 6 b\n")
        cloud = open_particles(path).load(0)
        self.assert_points(cloud, [[1, 2, 3], [4, 5, 0.6]])
        self.assertEqual(array_of(cloud, "column 4"), [-0.8, 0.4])
        self.assertEqual(array_of(cloud, "column 5"), [5, 6])
        self.assertFalse(cloud.GetPointData().HasArray("column 6"))
        cloud = open_particles(self.put("a.extxyz", "2\n\n1 2 3\n4 5 6\n")).load(0)
        self.assert_points(cloud, [[1, 2, 3], [4, 5, 6]])

    def test_radii_of_the_file_stay(self):
        text = "2\nProperties=species:S:1:pos:R:3:radius:R:1\nH 0 0 0 1.5\nO 1 0 0 0.5\n"
        cloud = open_particles(self.put("a.xyz", text)).load(0)
        self.assertEqual(array_of(cloud, "radius"), [1.5, 0.5])
        self.assertEqual(array_of(cloud, "atomic_number"), [1, 8])

    def test_keys_in_any_letters(self):
        text = "1\nproperties=pos:R:3:q:R:1 T=2.5\n1 2 3 4\n1\nPROPERTIES=pos:R:3 t=3\n1 2 3\n"
        series = open_particles(self.put("a.xyz", text))
        self.assertEqual(series.times, [2.5, 3])
        self.assertEqual(array_of(series.load(0), "q"), [4])

    def test_unknown_symbols_are_named(self):
        for symbols, unknown in (
            (("C", "Xx"), "Xx"),
            (("O", "999"), "999"),
            (("CB", "Unk"), "Unk"),
            (("Q", "Q"), "Q"),
        ):
            with self.subTest(symbols):
                found, said = self.numbers(*symbols)
                self.assertIn(f"{unknown}: there is no element of this symbol", said)
        self.assertIsNone(found)  # unknown radii follow from the distances
        for columns, effect in ("", "get the radius 0"), (":radius:R:1", "keep the radii of the"):
            rows = "C 0 0 0 1.5\nXx 3 0 0 2.5\n"
            path = self.put("r.xyz", f"2\nProperties=species:S:1:pos:R:3{columns}\n{rows}")
            with self.assertWarnsRegex(ActiveSurfaceWarning, f"these atoms {effect}"):
                open_particles(path).load(0)

    def test_properties_name_the_columns(self):
        for properties, row, wanted in (
            ("pos:R:3:species:S:1", "1 2 3 O", {"atomic_number": [8]}),
            ("species:S:1:velo:R:3:pos:R:3", "O 7 8 9 1 2 3", {"velo": [[7, 8, 9]]}),
            ("Z:I:1:pos:R:3:charge:R:1", "8 1 2 3 -0.5", {"atomic_number": [8], "charge": [-0.5]}),
            ("id:I:1:move_mask:L:1:pos:R:3", "4 T 1 2 3", {"id": [4], "move_mask": [1]}),
            ("tag:S:1:element:S:1:pos:R:3", "heavy O 1 2 3", {"atomic_number": [8]}),
        ):
            with self.subTest(properties):
                path = self.put("a.xyz", f"1\nProperties={properties} pbc='T F T'\n{row}\n")
                cloud = open_particles(path).load(0)
                self.assert_points(cloud, [[1, 2, 3]])
                for name, values in wanted.items():
                    self.assertEqual(array_of(cloud, name), values)
        for words, head in (
            ("no positions", "species:S:1"),
            ("line 3 has 4", "a:R:2:pos:R:3"),
            ("column pos has a value of a wrong type", "pos:R:3"),
        ):
            path = self.put("a.xyz", f"1\nProperties={head}\nO 1 2 3\n")
            self.assert_refused(words, path)

    def test_the_cell_is_field_data(self):
        for head, repeats in (
            ('Lattice="1 0 0 0 2 0 0 0 3" pbc="T T F"', [1, 1, 0]),
            ('pbc = "F F F" Lattice = "1.0 0 0 0 2 0 0 0 3"', [0, 0, 0]),
            ("Lattice={1 0 0 0 2 0 0 0 3} Properties=species:S:1:pos:R:3", [1, 1, 1]),
        ):
            with self.subTest(head):
                path = self.put("a.xyz", f"1\n{head}\nO 0 0 0\n")
                field = open_particles(path).load(0).GetFieldData()
                lattice = vtk_to_numpy(field.GetArray("Lattice"))
                self.assertEqual(numpy.diag(lattice).tolist(), [1, 2, 3])
                self.assertEqual(vtk_to_numpy(field.GetArray("pbc")).ravel().tolist(), repeats)
        found = json.loads(self.succeed("info", path, "--json").out)
        self.assertEqual(found["Lattice"], [1, 0, 0, 0, 2, 0, 0, 0, 3])
        self.succeed("convert", path, "-o", "a.vtp")
        self.assertIn(b"Lattice", (self.folder / "a.vtp").read_bytes())
        for lattice in "1 2", "a 0 0 0 1 0 0 0 1":
            path = self.put("a.xyz", f'1\nLattice="{lattice}"\nO 0 0 0\n')
            self.assert_refused(f'its Lattice is "{lattice}", not 9 numbers', path)

    def test_frames_times_and_none(self):
        frame = "1\ni = {0}, time = {0}.5, E = -1\nO {0} 0 0\n"
        series = open_particles(self.put("a.xyz", "\n".join(map(frame.format, range(3)))))
        self.assertEqual(series.times, [0.5, 1.5, 2.5])
        self.assert_points(series.load(2), [[2, 0, 0]])
        series = open_particles(self.put("a.xyz", "1\n\nO 0 0 0\n0\nnone\n1\n\nO 1 0 0\n"))
        counts = [series.load(step).GetNumberOfPoints() for step in range(3)]
        self.assertEqual(counts, [1, 0, 1])
        path = self.put("a.xyz", "1\n\nO 0 0 0\nO 1 0 0\n")
        self.assert_refused("line 4 is not the number", path)


class Properties(ReaderTest):
    ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
    TYPES = {"float": "f4", "double": "f8", "int": "i4", "uchar": "u1"}

    def put_ply(self, order, kinds, rows):
        names = "".join(f"property {kind} {name}\n" for name, kind in kinds)
        head = (
            f"ply\nformat {order} 1.0\ncomment a\nelement vertex {len(rows)}\n{names}end_header\n"
        )
        body = "".join(" ".join(map(str, row)) + "\n" for row in rows).encode()
        if mark := self.ORDERS[order]:
            types = [(name, mark + self.TYPES[kind]) for name, kind in kinds]
            body = numpy.array(rows, types).tobytes()
        return self.put("a.ply", head.encode() + body)

    def test_of_every_format(self):
        kinds = [(name, "float") for name in ("x", "y", "z", "vel_x", "vel_y", "vel_z")]
        kinds += [("id", "int"), ("density", "double")]
        rows = [(1, 2, 3, 4, 5, 6, 7, 0.125), (2, 3, 4, 5, 6, 7, 8, 1e-300)]
        for order in self.ORDERS:
            with self.subTest(order):
                cloud = open_particles(self.put_ply(order, kinds, rows)).load(0)
                self.assert_points(cloud, [[1, 2, 3], [2, 3, 4]])
                self.assertEqual(array_of(cloud, "vel"), [[4, 5, 6], [5, 6, 7]])
                self.assertEqual(array_of(cloud, "id"), [7, 8])
                self.assertEqual(array_of(cloud, "density"), [0.125, 1e-300])

    def test_in_any_order_and_in_double_precision(self):
        kinds = [("radius", "float"), ("z", "double"), ("y", "double"), ("x", "double")]
        for order in self.ORDERS:
            path = self.put_ply(order, kinds, [(0.5, 3, 2, 650000.0179)])
            cloud = open_particles(path).load(0)
            self.assertEqual(cloud.GetPoint(0), (650000.0179, 2, 3))
            self.assertEqual(array_of(cloud, "radius"), [0.5])

    def test_what_vtk_reads_is_its_own(self):
        kinds = [(name, "float") for name in ("x", "y", "z", "nx", "ny", "nz")]
        kinds += [(name, "uchar") for name in ("red", "green", "blue")] + [("age", "float")]
        path = self.put_ply("ascii", kinds, [(1, 2, 3, 0, 0, 1, 9, 8, 7, 6)])
        arrays = open_particles(path).load(0).GetPointData()
        names = {arrays.GetArrayName(i) for i in range(arrays.GetNumberOfArrays())}
        self.assertEqual(names, {"Normals", "RGB", "age"})

    def test_of_a_mesh(self):
        places = "".join(f"property float {name}\n" for name in ("x", "y", "z", "heat"))
        path = self.put(
            "m.ply",
            f"ply\nformat ascii 1.0\nelement vertex 3\n{places}element face 1\nproperty list uchar "
            "int vertex_indices\nend_header\n0 0 0 5\n1 0 0 6\n0 1 0 7\n3 0 1 2\n",
        )
        self.succeed("convert", path, "-o", "m.vtp")
        for name in ("m.ply", "m.vtp"):
            self.assertEqual(array_of(read_shape(self.folder / name), "heat"), [5, 6, 7])

    def test_vertices_behind_other_elements(self):
        places = "".join(f"property float {name}\n" for name in "xyz")
        head = f"element camera 1\nproperty uchar a\nelement vertex 1\n{places}end_header\n"
        path = self.put("a.ply", f"ply\nformat ascii 1.0\n{head}1\n1 2 3\n")
        self.assert_points(open_particles(path).load(0), [[1, 2, 3]])


if __name__ == "__main__":
    unittest.main()
