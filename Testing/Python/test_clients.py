# ctest: DISPLAY LABELS contract
"""Skins as read by other libraries: the table "What other libraries see" of Filters/IO/README.md.

Each test is skipped if its library is not installed (pip install trimesh meshio OpenImageIO).
"""

import importlib
import unittest

import numpy
from command_line import CommandTest, grid

SPEED = 1.25  # along x: 0.05 in a frame, at 25 frames per second
VOLUME = 0.5**3
NAMES = ("ply", "obj", "stl", "glb", "vdb")


def library(name):
    try:
        return importlib.import_module(name)
    except ImportError:
        raise unittest.SkipTest(f"{name} is not installed") from None


class Clients(CommandTest):
    def setUp(self):
        super().setUp()
        steps = numpy.stack([grid() + [0.05 * step, 0, 0] for step in range(3)])
        heat = numpy.tile(numpy.arange(125.0), (3, 1))
        numpy.savez("p.npz", positions=steps, heat=heat, ids=numpy.tile(numpy.arange(125), (3, 1)))
        # z is up here; the .glb is turned, so that y is up.
        self.common = ("skin", "p.npz", "--particle-spacing", 0.1, "--up", "z", "--quiet")

    def write(self, suffix):
        arrays = ("--pass-target-arrays", "--compute-velocity")
        common = self.common if suffix == "glb" else (*self.common[:4], "--quiet")
        self.succeed(*common, *arrays, "-o", f"s_#.{suffix}", "--index", "none")
        return str(self.folder / f"s_1.{suffix}")

    def test_trimesh(self):
        trimesh = library("trimesh")
        for suffix in ("ply", "obj", "stl", "glb"):
            with self.subTest(suffix):
                mesh = trimesh.load(self.write(suffix), force="mesh")
                if suffix == "stl":
                    mesh.merge_vertices()
                self.assertTrue(mesh.is_watertight)
                self.assertGreater(mesh.volume, 0.8 * VOLUME)
                self.assertLess(mesh.volume, 1.2 * VOLUME)
                up = 1 if suffix == "glb" else 2
                self.assertAlmostEqual(abs(mesh.bounds.mean(0)[up]), 0.2, delta=0.01)
        mesh = next(iter(trimesh.load(self.write("glb")).geometry.values()))
        names = {"_VELOCITY_X", "_VELOCITY_Y", "_VELOCITY_Z", "_HEAT", "_ID"}
        self.assertEqual(set(mesh.vertex_attributes), names)
        along = numpy.median(mesh.vertex_attributes["_VELOCITY_X"])
        self.assertAlmostEqual(along, SPEED, delta=0.01 * SPEED)

    def test_meshio(self):
        meshio = library("meshio")
        for suffix, arrays in (
            ("ply", {"nx", "ny", "nz", "Velocity_x", "Velocity_y", "Velocity_z", "heat", "id"}),
            ("obj", {"obj:vn"}),
            ("stl", set()),
        ):
            with self.subTest(suffix):
                mesh = meshio.read(self.write(suffix))
                self.assertEqual(set(mesh.point_data), arrays)
                faces = mesh.cells_dict["triangle"]
                a, b, c = numpy.moveaxis(mesh.points[faces].astype(float), 1, 0)
                volume = numpy.einsum("ij,ij->i", a, numpy.cross(b, c)).sum() / 6
                self.assertAlmostEqual(volume / VOLUME, 1.0, delta=0.2)
        mesh = meshio.read(self.write("ply"))
        self.assertAlmostEqual(
            float(numpy.median(mesh.point_data["Velocity_x"])), SPEED, delta=0.02
        )

    def test_openimageio(self):
        oiio = library("OpenImageIO")
        self.succeed(*self.common, "--render", "f.#.exr", "--size", "320x240", "--fps", 25)
        image = oiio.ImageBuf(str(self.folder / "f.1.exr"))
        names = list(image.spec().channelnames)
        plain = {"R", "G", "B", "A", "Z", "id", *(f"{n}.{c}" for n in "NP" for c in "XYZ")}
        self.assertEqual(plain - set(names), set())
        self.assertEqual(tuple(image.spec().getattribute("framesPerSecond")), (25, 1))
        pixels = image.get_pixels(oiio.FLOAT)
        layers = {name: pixels[..., i] for i, name in enumerate(names)}
        covered = layers["A"] > 0.99
        self.assertLess(covered.mean(), 0.5, "the ground is a layer of its own")
        # `forward` is the displacement in pixels during a frame, here of 0.05 along x.
        matrix = numpy.reshape(image.spec().getattribute("worldToNDC"), (4, 4))
        points = numpy.stack([layers[f"P.{axis}"][covered] for axis in "XYZ"], -1).astype(float)
        moved = [numpy.c_[p, numpy.ones(len(p))] @ matrix for p in (points, points + [0.05, 0, 0])]
        before, after = (p[:, :2] / p[:, 3:] for p in moved)
        own = numpy.stack([layers["forward.u"][covered], layers["forward.v"][covered]], -1)
        wanted = (after - before) * [320, -240]  # v is up, rows go down
        self.assertGreater(numpy.median(wanted[:, 0]), 5.0)
        self.assertLess(numpy.median(abs(own - wanted)), 1.0, "pixels")

    def test_openvdb(self):
        openvdb = library("pyopenvdb")
        path = self.write("vdb")
        surface = openvdb.read(path, "surface")
        self.assertEqual(surface.gridClass, openvdb.GridClass.LEVEL_SET)
        self.assertEqual(surface.metadata["frame"], 1)
        points, triangles, quads = surface.convertToPolygons(0.0, 0.0)
        corners = numpy.vstack([triangles, quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
        a, b, c = numpy.moveaxis(points[corners].astype(float), 1, 0)
        volume = abs(numpy.einsum("ij,ij->i", a, numpy.cross(b, c)).sum() / 6)
        self.assertAlmostEqual(volume / VOLUME, 1.0, delta=0.2)
        values = [value.value[0] for value in openvdb.read(path, "v").citerOnValues()]
        self.assertAlmostEqual(float(numpy.median(values)), SPEED, delta=0.01 * SPEED)


if __name__ == "__main__":
    unittest.main()
