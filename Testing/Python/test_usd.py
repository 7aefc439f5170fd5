# ctest: LABELS contract
"""A film of skins in one .usdc or .usda, as read by usd-core and Blender; skipped without them.

Run: python3 test_usd.py    (pip install usd-core; bpy)
"""

import importlib.util
import sys
import unittest
from unittest import mock

import numpy
from active_implicit_surfaces.skin_files import read_shape
from command_line import CommandTest, grid
from vtkmodules.util.numpy_support import vtk_to_numpy

SPEED = 1.25  # along x: 0.05 in a frame, at 25 frames per second
HAS_USD = importlib.util.find_spec("pxr")
COMMON = ("--particle-spacing", 0.1, "--quiet")


def volume_of(points, corners):
    a, b, c = (points[corners[i::3]].astype(float) for i in range(3))
    return numpy.einsum("ij,ij->i", a, numpy.cross(b, c)).sum() / 6


class Films(CommandTest):
    def setUp(self):
        super().setUp()
        steps = numpy.stack([grid() + [0.05 * step, 0, 0] for step in range(4)])
        heat = numpy.tile(numpy.arange(125.0), (4, 1))
        kinds = numpy.tile(["ice", "mud", "ice", "ice", "mud"], (4, 25))
        ids = numpy.tile(numpy.arange(125), (4, 1))
        self.arrays = {"heat": heat, "kind": kinds, "id": ids, "code": ids + 2**40}
        numpy.savez("p.npz", positions=steps, **self.arrays)

    @unittest.skipUnless(HAS_USD, "usd-core is not installed")
    def test_what_usd_reads(self):
        from pxr import Usd, UsdGeom

        self.succeed("skin", "p.npz", *COMMON, "--fps", 25, "--compute-velocity", "-o", "s_#.vtp")
        for suffix in ("usdc", "usda"):
            arguments = ("--fps", 25, "--pass-target-arrays", "--up", "z", "-o", f"film.{suffix}")
            said = self.succeed("skin", "p.npz", *COMMON, *arguments).err
            self.assertIn(f"A .{suffix} file cannot hold kind,", said)
            stage = Usd.Stage.Open(f"film.{suffix}")
            self.assertEqual(UsdGeom.GetStageUpAxis(stage), "Z")
            self.assertEqual(UsdGeom.GetStageMetersPerUnit(stage), 1)
            self.assertEqual(stage.GetTimeCodesPerSecond(), 25)
            self.assertEqual((stage.GetStartTimeCode(), stage.GetEndTimeCode()), (0, 3))
            mesh = UsdGeom.Mesh(stage.GetDefaultPrim())
            self.assertEqual(mesh.GetPointsAttr().GetTimeSamples(), [0, 1, 2, 3])
            for code in range(4):
                self.assert_is(mesh, code, read_shape(self.folder / f"s_{code}.vtp"))
            heat = UsdGeom.PrimvarsAPI(mesh).GetPrimvar("heat")
            self.assertEqual(heat.GetInterpolation(), "vertex")
            types = {"id": "int[]", "code": "int64[]", "heat": "float[]"}
            for name, wanted in types.items():
                own = UsdGeom.PrimvarsAPI(mesh).GetPrimvar(name)
                self.assertEqual(own.GetTypeName(), wanted)
                if name != "heat":
                    self.assertLessEqual(set(own.Get(1)), set(self.arrays[name][1].tolist()))
            self.assertEqual(len(heat.Get(2)), len(mesh.GetPointsAttr().Get(2)))
            self.assertEqual(self.hidden(), [])

    @unittest.skipUnless(HAS_USD, "usd-core is not installed")
    def test_velocities_are_in_the_time_of_the_codes(self):
        from pxr import Usd, UsdGeom

        for scale in (0.5, 2):
            arguments = (
                "--times",
                "0,0.04,0.08,0.12",
                "--fps",
                25,
                "--time-scale",
                scale,
                "-o",
                "film.usdc",
            )
            self.succeed("skin", "p.npz", *COMMON, *arguments)
            stage = Usd.Stage.Open("film.usdc")
            mesh = UsdGeom.Mesh(stage.GetDefaultPrim())
            velocities = numpy.array(mesh.GetVelocitiesAttr().Get(2))
            self.assertAlmostEqual(float(numpy.median(velocities[:, 0])), SPEED, delta=0.02)

    def assert_is(self, mesh, code, skin):
        points = numpy.array(mesh.GetPointsAttr().Get(code))
        wanted = vtk_to_numpy(skin.GetPoints().GetData())
        numpy.testing.assert_array_equal(points, wanted.astype("f4"))
        self.assertEqual(set(mesh.GetFaceVertexCountsAttr().Get(code)), {3})
        corners = numpy.array(mesh.GetFaceVertexIndicesAttr().Get(code))
        self.assertAlmostEqual(volume_of(points, corners), 0.5**3, delta=0.2 * 0.5**3)
        velocities = numpy.array(mesh.GetVelocitiesAttr().Get(code))
        wanted = vtk_to_numpy(skin.GetPointData().GetArray("Velocity"))
        numpy.testing.assert_array_equal(velocities, wanted.astype("f4"))
        if code:
            self.assertAlmostEqual(float(numpy.median(velocities[:, 0])), SPEED, delta=0.02)
        normals = numpy.array(mesh.GetNormalsAttr().Get(code))
        outward = numpy.einsum("ij,ij->i", normals, points - points.mean(0))
        self.assertGreater(outward.min(), 0)
        numpy.testing.assert_allclose(mesh.GetExtentAttr().Get(code)[1], points.max(0))

    @unittest.skipUnless(HAS_USD, "usd-core is not installed")
    def test_other_axes_and_commands(self):
        from pxr import Gf, Usd, UsdGeom

        self.succeed("skin", "p.npz", *COMMON, "--up=-y", "-o", "film.usda", "--frames", "2:3")
        stage = Usd.Stage.Open("film.usda")
        self.assertEqual(UsdGeom.GetStageUpAxis(stage), "Y")
        turned = UsdGeom.Xformable(stage.GetDefaultPrim()).GetLocalTransformation()
        up = turned.TransformDir(Gf.Vec3d(0, -1, 0))
        numpy.testing.assert_allclose(up, [0, 1, 0], atol=1e-6)
        self.assertEqual(stage.GetStartTimeCode(), 2)
        self.succeed("skin", "p.npz", *COMMON, "-o", "s_#.stl")
        morph = ("morph", "s_0.stl", "s_3.stl", "--frames", 3, "--quiet")
        self.succeed(*morph, "-o", "m.usdc", "--duration", 2)
        stage = Usd.Stage.Open("m.usdc")
        mesh = UsdGeom.Mesh(stage.GetDefaultPrim())
        self.assertEqual(len(mesh.GetPointsAttr().GetTimeSamples()), 3)
        self.succeed("convert", "s_*.stl", "-o", "c.usdc", "--quiet")
        stage = Usd.Stage.Open("c.usdc")
        mesh = UsdGeom.Mesh(stage.GetDefaultPrim())
        self.assertEqual(mesh.GetPointsAttr().GetTimeSamples(), [0, 1, 2, 3])

    @unittest.skipUnless(importlib.util.find_spec("bpy"), "bpy is not installed")
    def test_what_blender_shows(self):
        import bpy

        self.succeed("skin", "p.npz", *COMMON, "--fps", 25, "--up", "z", "-o", "film.usdc")
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.ops.wm.usd_import(filepath="film.usdc")
        found = next(one for one in bpy.data.objects if one.type == "MESH")
        for frame in (0, 3):
            bpy.context.scene.frame_set(frame)
            shown = found.evaluated_get(bpy.context.evaluated_depsgraph_get())
            places = numpy.array([found.matrix_world @ v.co for v in shown.data.vertices])
            centre = 0.5 * (places.min(0) + places.max(0))
            numpy.testing.assert_allclose(centre, [0.2 + 0.05 * frame, 0.2, 0.2], atol=0.01)

    @unittest.skipUnless(HAS_USD, "usd-core is not installed")
    def test_integers_that_become_wide_are_an_error(self):
        points = numpy.load("p.npz")["positions"]
        wide = numpy.stack([numpy.arange(125) + 2**40 * step for step in range(4)])
        numpy.savez("w.npz", positions=points, code=wide)
        said = self.fail_with(1, "skin", "w.npz", *COMMON, "--pass-target-arrays", "-o", "w.usdc")
        self.assertIn("w.usdc: array code needs 64-bit integers, but has 32-bit ones", said)

    def test_what_cannot_be(self):
        with mock.patch.dict(sys.modules, {"pxr": None}):
            said = self.fail_with(1, "skin", "p.npz", *COMMON, "-o", "film.usdc")
        self.assertIn("film.usdc cannot be written: usd-core is not installed; pip install", said)
        said = self.fail_with(1, "skin", "p.npz", *COMMON, "-o", "film_#.usdc")
        self.assertIn("film_#.usdc holds all frames in one file", said)
        for option in (("--resume",), ("--index", "a.pvd")):
            said = self.fail_with(2, "skin", "p.npz", "-o", "film.usdc", *option)
            self.assertIn(f"{option[0]} has no effect on film.usdc, one file of all frames", said)


if __name__ == "__main__":
    unittest.main()
