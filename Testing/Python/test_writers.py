# ctest: LABELS contract
"""Written meshes have their normals and arrays, or one warning names the omitted ones.

The test parses files according to their formats; trimesh reads them too if installed.
"""

import importlib.util
import json
import struct
import unittest
import warnings

import numpy
from active_implicit_surfaces import ActiveSurfaceWarning, api, data_objects, skin_files
from active_implicit_surfaces.mesh_writers import polygons_of
from command_line import DROP, CommandTest, grid
from shapes import output_of
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkStringArray
from vtkmodules.vtkFiltersSources import (
    vtkConeSource,
    vtkLineSource,
    vtkSphereSource,
)

TYPES = {"float": "<f4", "double": "<f8", "uchar": "u1", "int": "<i4"}
AXES = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1)}


def read_ply(path):
    """Vertices as a table with the properties' names, and the types of the properties."""
    head, _, body = path.read_bytes().partition(b"end_header\n")
    lines = [line.split() for line in head.decode("ascii").splitlines()]
    count = next(int(line[2]) for line in lines if line[:2] == ["element", "vertex"])
    kinds = {line[2]: line[1] for line in lines if line[0] == "property" and line[1] != "list"}
    row = numpy.dtype([(name, TYPES[kind]) for name, kind in kinds.items()])
    return numpy.frombuffer(body, row, count), kinds


def read_glb(path):
    content = path.read_bytes()
    (length,) = struct.unpack_from("<I", content, 12)
    described, data = json.loads(content[20 : 20 + length]), content[28 + length :]
    widths = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}

    def numbers(place):
        accessor = described["accessors"][place]
        view = described["bufferViews"][accessor["bufferView"]]
        part = data[view["byteOffset"] :][: view["byteLength"]]
        return numpy.frombuffer(part, "<f4").reshape(-1, widths[accessor["type"]])

    attributes = described["meshes"][0]["primitives"][0]["attributes"]
    return {name: numbers(place) for name, place in attributes.items()}, described


def read_obj(path):
    """Rows of numbers by their first word; the corners of faces as words."""
    rows = {"v": [], "vn": [], "vt": [], "f": [], "l": []}
    for line in path.read_text().splitlines():
        word, *cells = line.split()
        rows[word].append(cells if word in "fl" else [float(cell) for cell in cells])
    return {
        word: numpy.array(cells, float) if word in ("v", "vn", "vt") else cells
        for word, cells in rows.items()
    }


def turned(quaternion, vector):
    """Rotates a vector by a quaternion x y z w."""
    axis, real = numpy.array(quaternion[:3]), quaternion[3]
    twice = 2 * numpy.cross(axis, vector)
    return vector + real * twice + numpy.cross(axis, twice)


def put(mesh, name, values, data=None):
    array = numpy_to_vtk(numpy.ascontiguousarray(values), deep=True)
    array.SetName(name)
    (data or mesh.GetPointData()).AddArray(array)


class Writers(CommandTest):
    def setUp(self):
        super().setUp()
        self.ball = output_of(vtkSphereSource())
        count = self.ball.GetNumberOfPoints()
        random = numpy.random.default_rng(3)
        self.colours = random.integers(0, 256, (count, 3)).astype("u1")
        self.arrays = {
            "temperature": random.random(count),
            "mean stress": random.random(count).astype("f4"),
            "Velocity": random.random((count, 3)).astype("f4"),
            "uv": random.random((count, 2)).astype("f4"),
            "strain": random.random((count, 6)).astype("f4"),
            "id": numpy.arange(count, dtype="i8"),
            "hash": 2**40 + numpy.arange(count, dtype="i8"),
        }

    def coloured_ball(self):
        for name, values in {"Colors": self.colours, **self.arrays}.items():
            put(self.ball, name, values)
        return self.ball

    def write(self, name, mesh, **options):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            skin_files.write_mesh(self.folder / name, mesh, **options)
        self.assertTrue(all(one.category is ActiveSurfaceWarning for one in caught))
        return self.folder / name, [str(one.message) for one in caught]

    def normals(self):
        return vtk_to_numpy(self.ball.GetPointData().GetNormals())

    def test_a_ply_holds_normals_and_every_array_of_numbers(self):
        path, notes = self.write("a.ply", self.coloured_ball())
        self.assertEqual(notes, [])
        table, kinds = read_ply(path)
        wanted = {"nx": self.normals()[:, 0], "nz": self.normals()[:, 2]}
        wanted |= {"red": self.colours[:, 0], "blue": self.colours[:, 2]}
        wanted |= {name: self.arrays[name] for name in ("temperature", "id", "hash")}
        wanted["mean_stress"] = self.arrays["mean stress"]
        for i, axis in enumerate("xyz"):
            wanted[f"Velocity_{axis}"] = self.arrays["Velocity"][:, i]
        wanted |= {"uv_y": self.arrays["uv"][:, 1], "strain_5": self.arrays["strain"][:, 5]}
        for name, values in wanted.items():
            numpy.testing.assert_array_equal(table[name], values, name)
        found = [kinds[name] for name in ("nx", "red", "temperature", "Velocity_x", "id")]
        self.assertEqual(found, ["float", "uchar", "double", "float", "int"])

    def test_names_of_a_ply_are_each_there_once(self):
        for name in ("x", "nx", "red", "Größe"):
            put(self.ball, name, numpy.arange(50.0))
        put(self.ball, "Colors", self.colours)
        table, kinds = read_ply(self.write("a.ply", self.ball)[0])
        self.assertEqual(len(kinds), 3 + 3 + 3 + 4)
        for name in ("x_", "nx_", "red_", "Gr__e"):
            numpy.testing.assert_array_equal(table[name], numpy.arange(50.0), name)

    def test_a_ply_keeps_coordinates_in_double_precision(self):
        far = data_objects.as_particles(grid() + (650000.017946, 0, 5200000.09693))
        skin_files.write_particles(self.folder / "a.ply", far)
        table, _ = read_ply(self.folder / "a.ply")
        positions = vtk_to_numpy(far.GetPoints().GetData())
        numpy.testing.assert_array_equal(table["z"], positions[:, 2])

    def test_a_glb_holds_normals_colours_and_arrays(self):
        path, notes = self.write("a.glb", self.coloured_ball())
        self.assertEqual(len(notes), 1)
        self.assertIn("rounds integers beyond 16777216, as in hash; write .vtp", notes[0])
        found, described = read_glb(path)
        for name, attribute in {
            "temperature": "_TEMPERATURE",
            "mean stress": "_MEAN_STRESS",
            "id": "_ID",
        }.items():
            values = self.arrays[name].reshape(len(self.colours), -1).astype("f4")
            numpy.testing.assert_array_equal(found[attribute], values, name)
        for name, axis, place in (("Velocity", "Z", 2), ("uv", "Y", 1), ("strain", 5, 5)):
            values = found[f"_{name.upper()}_{axis}"][:, 0]
            numpy.testing.assert_array_equal(values, self.arrays[name][:, place].astype("f4"))
        widths = {own.shape[1] for name, own in found.items() if name.startswith("_")}
        self.assertEqual(widths, {1}, "Blender fails at several")
        numpy.testing.assert_array_equal(found["NORMAL"], self.normals())
        # Colours of glTF are linear: half of the light is 188 of 255 in sRGB.
        self.assertAlmostEqual(numpy.interp(0.5, *light_of(self.colours, found)), 188, delta=3)
        look = described["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"]
        self.assertEqual(look, [1, 1, 1, 1])

    def test_an_obj_holds_colours_and_normals_and_says_what_it_leaves_out(self):
        path, notes = self.write("a.obj", self.coloured_ball())
        rows = read_obj(path)
        numpy.testing.assert_array_equal(
            rows["v"][:, :3].astype("f4"), vtk_to_numpy(self.ball.GetPoints().GetData())
        )
        numpy.testing.assert_array_equal(numpy.rint(rows["v"][:, 3:] * 255), self.colours)
        numpy.testing.assert_allclose(rows["vn"], self.normals(), atol=1e-6)
        self.assertEqual(rows["f"][0], [f"{i + 1}//{i + 1}" for i in polygons_of(self.ball)[0][0]])
        self.assertEqual(len(notes), 1)
        for word in ("temperature", "Velocity", ".obj file cannot hold", ".vtp or .ply to"):
            self.assertIn(word, notes[0])
        self.assertNotIn("Colors", notes[0])

    def test_lines_of_an_obj(self):
        line = output_of(vtkLineSource())
        line.GetPointData().Initialize()
        self.assertEqual(self.write("b.obj", line)[1], [])
        self.assertEqual(read_obj(self.folder / "b.obj")["l"], [["1", "2"]])

    def test_what_a_format_cannot_hold_is_one_sentence(self):
        names = vtkStringArray()
        names.SetName("element")
        names.SetNumberOfValues(50)
        words, cells = (output_of(vtkSphereSource()) for _ in range(2))
        words.GetPointData().AddArray(names)
        put(cells, "part", numpy.zeros(cells.GetNumberOfCells()), cells.GetCellData())
        tubes = output_of(vtkConeSource())
        tubes.SetLines(output_of(vtkLineSource()).GetLines())
        for suffix, mesh, what, better in (
            (".ply", words, "cannot hold element,", "write .vtp to"),
            (".glb", words, "cannot hold element,", "write .vtp to"),
            (".stl", self.coloured_ball(), "temperature, mean stress", ".vtp or .ply to"),
            (".stl", cells, "cannot hold part (of cells),", "write .vtp to"),
            (".glb", cells, "cannot hold part (of cells),", "write .vtp to"),
            (".ply", tubes, "cannot hold the lines,", "write .vtp to"),
        ):
            with self.subTest(suffix=suffix, what=what):
                _, notes = self.write("a" + suffix, mesh)
                self.assertEqual(len(notes), 1)
                self.assertIn(what, notes[0])
                self.assertIn(better, notes[0])
                self.assertEqual(self.write("a.vtp", mesh)[1], [])

    def test_particles_keep_their_arrays(self):
        speeds = grid() * 2
        cloud = data_objects.as_particles(grid(), velocities=speeds, temperature=speeds[:, 0])
        numpy.savez(self.folder / "a.npz", positions=grid(), Velocity=speeds)
        self.succeed("convert", "a.npz", "-o", "a.ply")
        numpy.testing.assert_array_equal(
            read_ply(self.folder / "a.ply")[0]["Velocity_y"], speeds[:, 1]
        )
        with self.assertWarnsRegex(ActiveSurfaceWarning, "hold Velocity, temperature,"):
            skin_files.write_particles(self.folder / "b.xyz", cloud)

    def test_a_mesh_without_points_is_written(self):
        for suffix in (".ply", ".obj", ".stl", ".glb", ".vtp"):
            path, notes = self.write("none" + suffix, data_objects.vtkPolyData())
            self.assertEqual((path.exists(), notes), (True, []), suffix)
        self.assertEqual((self.folder / "none.stl").stat().st_size, 84)

    def test_an_stl_has_the_normals_of_its_triangles(self):
        path, _ = self.write("a.stl", self.ball)
        facets = numpy.frombuffer(
            path.read_bytes()[84:], [("numbers", "<f4", (4, 3)), ("n", "<u2")]
        )
        normals, corners = facets["numbers"][:, 0], facets["numbers"][:, 1:]
        self.assertEqual(len(facets), self.ball.GetNumberOfPolys())
        numpy.testing.assert_allclose(numpy.linalg.norm(normals, axis=1), 1, atol=1e-6)
        self.assertGreater((normals * corners.mean(axis=1)).sum(axis=1).min(), 0, "outward")

    def test_the_axis_that_is_up_is_y_in_a_glb(self):
        for up in ("x", "y", "z", "-x", "-y", "-z"):
            path, _ = self.write("a.glb", output_of(vtkConeSource()), up=up)
            attributes, described = read_glb(path)
            points = vtk_to_numpy(output_of(vtkConeSource()).GetPoints().GetData())
            numpy.testing.assert_array_equal(attributes["POSITION"], points, up)
            quaternion = described["nodes"][0].get("rotation", [0, 0, 0, 1])
            axis = numpy.array(AXES[up[-1]]) * (-1 if up[0] == "-" else 1)
            numpy.testing.assert_allclose(turned(quaternion, axis), (0, 1, 0), atol=1e-12)
            read = skin_files.read_shape(path)
            self.assertEqual(read.GetBounds(), output_of(vtkConeSource()).GetBounds(), up)

    @unittest.skipUnless(importlib.util.find_spec("trimesh"), "trimesh is not installed")
    def test_trimesh_reads_them_closed(self):
        import trimesh

        skin = api.skin(grid(), particle_spacing=0.1, compute_velocity=True)
        for suffix in (".ply", ".obj", ".glb", ".stl"):
            path, _ = self.write("a" + suffix, skin)
            mesh = trimesh.load(path, force="mesh")
            mesh.merge_vertices(merge_norm=True, merge_tex=True)
            self.assertTrue(mesh.is_watertight, suffix)


class Program(CommandTest):
    def setUp(self):
        super().setUp()
        frames = numpy.stack([grid() + [0, 0, 5 - 0.05 * step**2] for step in range(4)])
        heat = numpy.tile(numpy.arange(125.0), (4, 1))
        numpy.savez(self.folder / "fall.npz", positions=frames, heat=heat)

    def skin(self, name, *more):
        return self.succeed("skin", "fall.npz", "-o", name, "--particle-spacing", 0.1, *more)

    def test_arrays_asked_for_are_there_or_noted_once(self):
        wanted = "--compute-velocity", "--compute-curvature", "--pass-target-arrays"
        self.assertNotIn("cannot hold", self.skin("s_#.ply", *wanted).err)
        names = {"nx", "Velocity_z", "MeanCurvature", "heat"}
        self.assertLessEqual(names, set(read_ply(self.folder / "s_3.ply")[1]))
        self.assertNotIn("cannot hold", self.skin("s_#.glb", *wanted).err)
        names = {"NORMAL", "_VELOCITY_X", "_VELOCITY_Z", "_MEANCURVATURE", "_HEAT"}
        self.assertLessEqual(names, set(read_glb(self.folder / "s_3.glb")[0]))
        for suffix in (".obj", ".stl"):
            said = self.skin("s_#" + suffix, *wanted).err
            self.assertEqual(said.count("cannot hold"), 1, said)
            for name in ("Velocity", "MeanCurvature", "heat"):
                self.assertIn(name, said)

    def test_what_is_up_in_a_glb(self):
        def rotation(name):
            return read_glb(self.folder / name)[1]["nodes"][0].get("rotation")

        self.skin("s_#.glb", "--up", "z")
        for step in range(4):
            self.assertLess(rotation(f"s_{step}.glb")[0], 0, "z becomes y")
        self.skin("t_#.glb", "--up", "y")
        self.assertIsNone(rotation("t_0.glb"))
        self.skin("u_#.stl")
        for more, is_turned in ((), True), (("--up", "y"), False), (("--up", "z"), True):
            self.succeed("convert", "u_*.stl", "-o", "u_#.glb", *more)
            self.assertEqual(rotation("u_2.glb") is not None, is_turned, more)

    def test_a_skin_of_the_drop_has_its_arrays_as_a_glb(self):
        self.succeed("skin", DROP, "-o", "d.vtp", "--times", "0:1:41", "--compute-velocity")
        self.succeed("convert", "d_0020.vtp", "-o", "d.glb")
        found, _ = read_glb(self.folder / "d.glb")
        self.assertGreater(numpy.abs(found["_VELOCITY"]).max(), 0)


def light_of(colours, found):
    """Returns the reds of a .glb's COLOR_0, ascending, and the reds of `colours` there.

    COLOR_0 is linear light, `colours` is sRGB; `found` has the arrays of the .glb.
    """
    order = numpy.argsort(found["COLOR_0"][:, 0])
    return found["COLOR_0"][order, 0], colours[order, 0]


if __name__ == "__main__":
    unittest.main()
