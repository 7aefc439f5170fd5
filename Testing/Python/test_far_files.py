# ctest: DISPLAY LABELS contract
"""Files of skins at map coordinates, 5e6 with a spacing of 0.01: accurate, or with a message.

Run: python3 test_far_files.py
"""

import importlib.util
import json
import unittest
import warnings

import active_implicit_surfaces as active
import numpy
from active_implicit_surfaces.data_objects import points_of
from active_implicit_surfaces.glb import TO_Y
from active_implicit_surfaces.measures import measure
from active_implicit_surfaces.messages import ActiveSurfaceWarning
from active_implicit_surfaces.particle_files import open_particles
from active_implicit_surfaces.skin_files import read_shape, write_mesh
from command_line import CommandTest, grid
from shapes import write
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

SPACING = 0.01
MAP = numpy.array([5e6 + 0.003, 4.2e6, 120.0])
EXACT = SPACING / 100
HAS_USD = importlib.util.find_spec("pxr")


def places_of(data):
    return points_of(data) - MAP


class Files(CommandTest):
    def setUp(self):
        super().setUp()
        frames = numpy.stack([grid() / 10 + MAP + [0.004 * step, 0, 0] for step in range(2)])
        numpy.savez("p.npz", positions=frames, heat=numpy.arange(125.0))
        self.succeed("skin", "p.npz", "--fps", 25, "--quiet", "-o", "s_#.vtp")
        self.skins = [read_shape(self.folder / f"s_{step}.vtp") for step in range(2)]

    def write(self, suffix, *arguments):
        """Returns the messages, and the file of the second frame."""
        given = ("p.npz", "--fps", 25, "--quiet", *arguments, "-o", f"t_#{suffix}")
        return self.succeed("skin", *given).err, self.folder / f"t_1{suffix}"

    def test_the_skin(self):
        box = numpy.array([places_of(self.skins[0]).min(0), places_of(self.skins[0]).max(0)])
        self.assertTrue((box[0] < -0.003).all() and (box[0] > -SPACING).all(), box)
        self.assertTrue((box[1] > 0.043).all() and (box[1] < 0.04 + SPACING).all(), box)

    def test_formats_of_doubles(self):
        for suffix, arguments in ((".ply", ()), (".obj", ()), (".glb", ("--up", "z"))):
            with self.subTest(suffix):
                said, path = self.write(suffix, *arguments)
                self.assertNotIn("precision", said)
                again = read_shape(path)
                self.assertLess(numpy.abs(points_of(again) - points_of(self.skins[1])).max(), EXACT)
                wanted = measure(self.skins[1])["volume"]
                self.assertAlmostEqual(measure(again)["volume"] / wanted, 1, delta=1e-4)

    def test_a_stl_says_it(self):
        said, path = self.write(".stl")
        self.assertIn("A .stl file rounds points to single precision, by up to", said)
        self.assertIn("or move the data near the origin before writing a .stl.", said)
        with self.assertWarnsRegex(ActiveSurfaceWarning, "to steps of up to 0.5, but edges"):
            read_shape(path)

    def test_a_vdb(self):
        said, path = self.write(".vdb")
        self.assertNotIn("precision", said)
        self.succeed("convert", path, "-o", "v.ply")
        again = read_shape(self.folder / "v.ply")
        boxes = [numpy.reshape(mesh.GetBounds(), (3, 2)) for mesh in (again, self.skins[1])]
        self.assertLess(numpy.abs(boxes[0] - boxes[1]).max(), 0.05 * SPACING)

    def test_each_axis_of_a_glb(self):
        """World coordinates follow from the node's rotation and translation, as in a reader of
        glTF."""
        for up in ("y", *TO_Y):
            path = self.folder / "a.glb"
            write_mesh(path, self.skins[0], up=up)
            content = path.read_bytes()
            size = int.from_bytes(content[12:16], "little")
            (node,) = json.loads(content[20 : 20 + size])["nodes"]
            count = self.skins[0].GetNumberOfPoints()
            local = numpy.frombuffer(content, "<f4", 3 * count, 28 + size).reshape(-1, 3)
            x, y, z, w = node.get("rotation", [0, 0, 0, 1])
            turn = numpy.array(
                [
                    [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                    [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                    [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
                ]
            )
            world = local @ turn.T + node["translation"]
            wanted = points_of(self.skins[0]) @ turn.T
            self.assertLess(numpy.abs(world - wanted).max(), EXACT, up)
            origin = numpy.array(node["extras"]["origin"])
            self.assertTrue((origin.astype("f4") == origin).all(), "a float holds it, as Blender's")

    @unittest.skipUnless(HAS_USD, "usd-core is not installed")
    def test_usd(self):
        from pxr import Usd, UsdGeom

        for up in ("z", "y", "x", "-y"):
            arguments = ("p.npz", "--fps", 25, "--quiet", f"--up={up}", "-o", f"film{up}.usda")
            self.assertNotIn("precision", self.succeed("skin", *arguments).err)
            stage = Usd.Stage.Open(f"film{up}.usda")
            mesh = UsdGeom.Mesh(stage.GetDefaultPrim())
            local = numpy.array(mesh.GetPointsAttr().Get(1), float)
            matrix = numpy.array(mesh.ComputeLocalToWorldTransform(1))  # the matrix multiplies rows
            world = local @ matrix[:3, :3] + matrix[3, :3]
            wanted = points_of(self.skins[1]) @ matrix[:3, :3].round(6)  # a quaternion of floats
            self.assertLess(numpy.abs(world - wanted).max(), EXACT, up)

    def test_exr(self):
        arguments = ("p.npz", "--fps", 25, "--quiet", "--size", "160x120", "--up", "z")
        said = self.succeed("skin", *arguments, "--render", "e_#.exr").err
        self.assertIn("are relative to worldOrigin, 5000000 4200000 120.0", said)
        reader = active.vtkActiveEXRReader()
        reader.SetFileName("e_1.exr")
        reader.Update()
        image = reader.GetOutput()
        layers, field = image.GetPointData(), image.GetFieldData()
        shown = vtk_to_numpy(layers.GetArray("RGBA"))[:, 3] == 1
        origin = numpy.array(field.GetAbstractArray("worldOrigin").GetValue(0).split(), float)
        places = vtk_to_numpy(layers.GetArray("P"))[shown] + origin
        inside = numpy.reshape(self.skins[1].GetBounds(), (3, 2)).T
        self.assertTrue((places > inside[0] - EXACT).all() and (places < inside[1] + EXACT).all())
        matrix = vtk_to_numpy(field.GetArray("worldToNDC")).reshape(4, 4)
        clip = (places - origin) @ matrix[:, :3].T + matrix[:, 3]
        found = clip[:, :2] / clip[:, 3:] * [160, 120]
        ahead = vtk_to_numpy(field.GetArray("worldToCamera")).reshape(4, 4)[2]
        depths = vtk_to_numpy(layers.GetArray("Z"))[shown]
        self.assertLess(numpy.abs((places - origin) @ ahead[:3] + ahead[3] - depths).max(), EXACT)
        rows, columns = numpy.divmod(numpy.flatnonzero(shown), 160)
        wanted = numpy.stack([columns + 0.5, 119.5 - rows], -1)
        self.assertLess(numpy.abs(found - wanted).max(), 0.1)

    def test_particles_keep_their_digits(self):
        wanted = numpy.load("p.npz")["positions"][0]
        numpy.savez("one.npz", positions=wanted)
        for name in ("a.xyz", "a.csv", "a.json", "a.npz", "a.vtp", "a.ply", "a.vtk"):
            self.succeed("convert", "one.npz", "-o", name)
            numpy.testing.assert_array_equal(points_of(open_particles(name).load(0)), wanted, name)

    def test_info_tells_the_bounds(self):
        for name in ("p.npz", "s_0.vtp"):
            said = self.succeed("info", name).out
            self.assertIn("bounds: 499999" if name == "s_0.vtp" else "bounds: 5000000.003 ", said)


class SinglePrecision(CommandTest):
    def test_particles_that_are_too_coarse(self):
        far = (grid() / 10 + MAP).astype("f4")
        with self.assertWarnsRegex(ActiveSurfaceWarning, "steps of up to 0.5 here, where their"):
            active.skin(far, particle_spacing=SPACING)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            active.skin(far.astype("f4") * 0 + grid().astype("f4") + 1000, particle_spacing=0.1)

    def test_an_obj_with_colours_and_normals_of_its_own(self):
        """VTK's reader duplicates a point that has several normals."""
        vertices = [[0, 0, 0], [0.01, 0, 0], [0, 0.01, 0], [0, 0, 0.01]]
        lines = [
            f"v {x!r} {y!r} {z!r} {i / 4} 0 0"
            for i, (x, y, z) in enumerate((MAP + vertices).tolist())
        ]
        faces = ((1, 3, 2), (1, 2, 4), (2, 3, 4), (1, 4, 3))
        for name, corner in (("a.obj", "{0}"), ("b.obj", "{0}//{1}")):
            own = [f"vn 0 0 {i + 1}" for i in range(4)] if name == "b.obj" else []
            own += [
                "f " + " ".join(corner.format(one, i + 1) for one in face)
                for i, face in enumerate(faces)
            ]
            (self.folder / name).write_text("\n".join(lines + own) + "\n")
        mesh = read_shape(self.folder / "a.obj")
        self.assertLess(numpy.abs(points_of(mesh) - MAP - vertices).max(), 1e-9)
        colours = vtk_to_numpy(mesh.GetPointData().GetArray("RGB"))[:, 0]
        self.assertEqual(colours.tolist(), [0, 64, 128, 191])
        with self.assertWarnsRegex(
            ActiveSurfaceWarning, "b.obj: single precision has rounded the points"
        ):
            read_shape(self.folder / "b.obj")

    def test_a_mesh_near_the_origin_has_no_note(self):
        write(vtkXMLPolyDataWriter(), active.skin(grid(), particle_spacing=0.1), "a.vtp")
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            for suffix in (".stl", ".glb", ".obj", ".ply"):
                write_mesh(self.folder / ("a" + suffix), read_shape(self.folder / "a.vtp"))
                read_shape(self.folder / ("a" + suffix))
        self.assertNotIn(b"translation", (self.folder / "a.glb").read_bytes())


if __name__ == "__main__":
    unittest.main()
