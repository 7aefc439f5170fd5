# ctest: LABELS contract
"""Readers of meshes preserve colours, outward faces and empty meshes of other programs.

Run: python3 test_mesh_files.py
"""

import json
import struct
import unittest

import numpy
from active_implicit_surfaces.measures import measure
from active_implicit_surfaces.skin_files import MESH_WRITERS, read_shape
from command_line import CommandTest
from reader_checks import array_of
from shapes import write
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLUnstructuredGridWriter

# A tetrahedron of volume 1/6 with outward faces, and colours of its corners.
PLACES = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
FACES = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
COLOURS = [[255, 0, 0], [0, 255, 0], [0, 0, 255], [51, 102, 204]]


def ply(kind, colours, label=""):
    head = ["ply", "format ascii 1.0", "element vertex 4"]
    head += [f"property float {name}" for name in "xyz"]
    head += [f"property {kind} {name}" for name in ("red", "green", "blue")]
    head += ["element face 4", "property list uchar int vertex_indices"]
    head += [f"property {label}"] * bool(label) + ["end_header"]
    rows = [[*place, *colour] for place, colour in zip(PLACES, colours)]
    rows += [[3, *face, *([1, 7] if "list" in label else [7]) * bool(label)] for face in FACES]
    return "\n".join([*head, *(" ".join(map(str, row)) for row in rows), ""])


def obj(colours):
    rows = [["v", *place, *colour] for place, colour in zip(PLACES, colours)]
    rows += [["f", *(corner + 1 for corner in face)] for face in FACES]
    return "".join(" ".join(map(str, row)) + "\n" for row in rows)


def glb(*nodes):
    """A .glb of another program, in which all nodes contain the tetrahedron."""
    places, corners = (numpy.array(a, k).tobytes() for a, k in ((PLACES, "<f4"), (FACES, "<u4")))
    views = [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 48}]
    described = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": list(range(len(nodes)))}],
        "nodes": [{"mesh": 0, **node} for node in nodes],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"byteLength": 96}],
        "bufferViews": views,
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5125, "count": 12, "type": "SCALAR"},
        ],
    }
    described["accessors"][0] |= {"min": [0, 0, 0], "max": [1, 1, 1]}
    text = json.dumps(described).encode()
    text += b" " * (-len(text) % 4)
    parts = struct.pack("<2I", len(text), 0x4E4F534A) + text + struct.pack("<2I", 96, 0x004E4942)
    size = 12 + len(parts) + 96
    return struct.pack("<3I", 0x46546C67, 2, size) + parts + places + corners


class MeshFiles(CommandTest):
    def test_colours_of_other_programs(self):
        shares = (numpy.array(COLOURS) / 255).round(4).tolist()
        for name, text in (
            ("bytes.ply", ply("uchar", COLOURS)),
            ("shares.ply", ply("float", shares)),
            ("shares.obj", obj(shares)),
        ):
            with self.subTest(name):
                self.assertEqual(array_of(read_shape(self.put(name, text)), "RGB"), COLOURS)

    def test_colours_survive_a_conversion_there_and_back(self):
        self.put("a.ply", ply("uchar", COLOURS))
        for suffix in ("vtp", "ply", "obj", "glb", "vtk"):
            with self.subTest(suffix):
                self.succeed("convert", "a.ply", "-o", f"b.{suffix}")
                self.assertEqual(array_of(read_shape(self.folder / f"b.{suffix}"), "RGB"), COLOURS)

    def test_a_plain_obj_needs_no_note(self):
        self.put("a.obj", obj([[]] * 4))
        self.assertNotIn("note", self.succeed("convert", "a.obj", "-o", "a.ply").err)

    def test_properties_of_polygons(self):
        path = self.put("a.ply", ply("uchar", COLOURS, "int label"))
        cells = read_shape(path).GetCellData()
        self.assertEqual([cells.GetArray("label").GetValue(i) for i in range(4)], 4 * [7])
        self.put("a.ply", ply("uchar", COLOURS, "list uchar float texcoord"))
        said = self.succeed("convert", "a.ply", "-o", "a.vtp").err
        self.assertIn("a.ply: list properties of polygons are left out: texcoord.", said)

    def test_lists_of_vertices_are_left_out(self):
        self.put(
            "a.ply",
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
            "property float y\nproperty float z\nproperty list uchar int bonds\nend_header\n"
            "0 0 0 2 1 2\n",
        )
        said = self.succeed("convert", "a.ply", "-o", "a.vtp").err
        self.assertIn("a.ply: list properties of vertices are left out: bonds.", said)

    def test_a_ply_of_strips(self):
        head = "ply\nformat ascii 1.0\nelement vertex 4\n"
        head += "".join(f"property float {axis}\n" for axis in "xyz")
        head += "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
        head += "0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
        for count in (12, 13):
            self.put(f"{count}.ply", head + f"{count} 0 2 1 3 -1 0 3 2 -1 0 1 3\n")
        told = json.loads(self.succeed("info", "12.ply", "--json").out)
        self.assertAlmostEqual(told["volume"], 1 / 6)
        self.assertEqual(told["closed"], "yes")
        self.assertIn("it ends before", self.fail_with(1, "info", "13.ply"))
        face = "element face 1\nproperty list int int vertex_indices\nproperty int n\nelement tri"
        text = (head + "3 0 1 2 7\n5 0 2 1 3 -1\n").replace("element tri", face)
        self.put("both.ply", text)
        said = self.succeed("info", "both.ply")
        self.assertIn("left out, because the file also has strips: n.", said.err)
        self.assertIn("arrays: none", said.out)

    def test_a_ply_in_capital_letters(self):
        text = ply("uchar", COLOURS)
        for name in "xyz":
            text = text.replace(f"float {name}\n", f"float {name.upper()}\n")
        self.assertAlmostEqual(measure(read_shape(self.put("a.ply", text)))["volume"], 1 / 6, 6)

    def test_nodes_that_mirror_leave_faces_outward(self):
        twice = {"scale": [2, 2, 2], "translation": [9, 0, 0]}
        for nodes, volume in (
            ([{}], 1 / 6),
            ([{"scale": [-1, 1, 1]}], 1 / 6),
            ([{"scale": [1, 1, -2]}], 1 / 3),
            ([{"scale": [-1, -1, 1]}], 1 / 6),
            ([{"scale": [-1, 1, 1]}, twice], 1 / 6 + 8 / 6),
        ):
            with self.subTest(nodes):
                mesh = read_shape(self.put("a.glb", glb(*nodes)))
                self.assertAlmostEqual(measure(mesh)["volume"], volume, 6)

    def test_an_stl_in_capital_letters(self):
        corners = "".join(
            "facet normal 0 0 0\nouter loop\n"
            + "".join(" vertex {} {} {}\n".format(*PLACES[corner]) for corner in face)
            + "endloop\nendfacet\n"
            for face in FACES
        )
        path = self.put("A.STL", f"solid a\n{corners}endsolid a\n".upper())
        self.assertAlmostEqual(measure(read_shape(path))["volume"], 1 / 6, 6)

    def test_empty_meshes_are_read_as_they_are_written(self):
        for writer, empty, name in (
            (vtkXMLPolyDataWriter(), vtkPolyData(), "e.vtp"),
            (vtkXMLUnstructuredGridWriter(), vtkUnstructuredGrid(), "e.vtu"),
        ):
            write(writer, empty, name)
            for suffix in MESH_WRITERS:
                with self.subTest(name=name, suffix=suffix):
                    self.succeed("convert", name, "-o", f"f{suffix}")
                    self.succeed("convert", f"f{suffix}", "-o", "g.vtp")
                    self.assertEqual(read_shape(self.folder / "g.vtp").GetNumberOfPoints(), 0)
                    self.succeed("info", f"f{suffix}")

    def test_empty_clouds_are_read_as_they_are_written(self):
        self.put("e.csv", "x,y,z\n")
        self.succeed("convert", "e.csv", "-o", "e.xyz")
        self.succeed("convert", "e.xyz", "-o", "f.csv")
        self.assertEqual((self.folder / "f.csv").read_text().split(), ["x,y,z"])

    def test_text_that_is_no_obj_is_refused(self):
        for text in ("no mesh\n", "0 1 2\nv 0 0 0\n"):
            self.put("a.obj", text)
            self.assertIn("data begin without a vertex", self.fail_with(1, "info", "a.obj"))


if __name__ == "__main__":
    unittest.main()
