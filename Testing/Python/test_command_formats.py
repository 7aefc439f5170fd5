# ctest: LABELS contract
"""active-surface skin, morph, convert and info with every format, in both directions."""

import json
import math
import struct
import unittest

import numpy
from active_implicit_surfaces import data_objects, skin_files
from active_implicit_surfaces.contours import contour
from active_implicit_surfaces.particle_files import open_particles
from active_implicit_surfaces.skin_files import read_shape
from active_implicit_surfaces.vtk_files import read_vtk
from command_line import DROP, CommandTest, grid, moving_grid
from shapes import output_of, volume_of, write
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkSphere, vtkUnstructuredGrid
from vtkmodules.vtkFiltersCore import vtkAppendFilter
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkSphereSource
from vtkmodules.vtkImagingHybrid import vtkSampleFunction
from vtkmodules.vtkIOParallelXML import vtkXMLPPolyDataWriter
from vtkmodules.vtkIOXML import (
    vtkXMLImageDataWriter,
    vtkXMLPolyDataWriter,
    vtkXMLUnstructuredGridWriter,
)

# Rounding of coordinates below 1 to single precision, or to 9 digits of text.
FLOAT = 6e-8
VOXEL = 0.05
# Volume error of a ball of radius 0.6: its area times an error of the radius. Linear interpolation
# between nodes contributes voxel^2 / 8 / radius to this error, flat triangles as much again.
LEVEL_SET_ERROR = 2 * VOXEL**2 / 8 / 0.6 * 4 * math.pi * 0.36


def positions_of(cloud):
    return vtk_to_numpy(cloud.GetPoints().GetData())


class Particles(CommandTest):
    def assert_reads(self, path, arrays=(), tolerance=FLOAT):
        cloud = open_particles(path).load(0)
        difference = numpy.abs(positions_of(cloud) - grid()).max()
        self.assertLessEqual(difference, tolerance, path)
        for name in arrays:
            values = cloud.GetPointData().GetArray(name)
            self.assertIsNotNone(values, f"{path}: {name}")
            self.assertEqual(values.GetTuple(7)[0], 7.0)
        return cloud

    def test_every_format_out_and_in_again(self):
        source = self.folder / "a.npz"
        speeds = numpy.stack(3 * [numpy.arange(125.0)], 1)
        numpy.savez(source, positions=grid(), id=numpy.arange(125), speed=speeds)
        for suffix in skin_files.PARTICLE_OUT_SUFFIXES:
            with self.subTest(suffix):
                made = self.folder / f"b{suffix}"
                self.succeed("convert", source, "-o", made)
                kept = () if suffix in (".ply", ".xyz") else ("id", "speed")
                self.assert_reads(made, kept)
                info = json.loads(self.succeed("info", made, "--json").out)
                self.assertEqual((info["points"], info["holds"]), (125, "particles"))
                # spacing of the lattice
                self.assertAlmostEqual(info["spacing"], 0.1, delta=4 * FLOAT)
                self.succeed("skin", made, "-o", self.folder / f"skin{suffix}.vtp")
        self.assertEqual(self.hidden(), [])

    def test_other_formats_in(self):
        cloud = data_objects.as_particles(grid(), id=numpy.arange(125))
        write(vtkXMLPPolyDataWriter(), cloud, self.folder / "a.pvtp")
        points = vtkAppendFilter()
        points.AddInputData(cloud)
        self.assertIsInstance(output_of(points), vtkUnstructuredGrid)
        write(vtkXMLUnstructuredGridWriter(), output_of(points), self.folder / "a.vtu")
        for name in ("a.pvtp", "a.vtu"):
            self.assert_reads(self.folder / name, ["id"])

    def test_texts_of_others(self):
        rows = [" ".join(f"{value:.9g}" for value in row) for row in grid()]
        texts = {
            "a.csv": ["Points:0,Points:1,Points:2", *(row.replace(" ", ",") for row in rows)],
            "b.csv": ["X [m];Y [m];Z [m]", *(row.replace(" ", ";") for row in rows)],
            "c.csv": ["pos_x\tpos_y\tpos_z", *(row.replace(" ", "\t") for row in rows)],
            "h.csv": ["# of a run", "# P[x],P[y],P[z]", *(row.replace(" ", ",") for row in rows)],
            "d.csv": [row.replace(" ", ",") for row in rows],
            "e.csv": ["name,z,y,x", *("a," + ",".join(r.split()[::-1]) for r in rows)],
            "f.xyz": rows,
            "g.xyz": ["# x y z", *rows],
            "h.json": [json.dumps(grid().tolist())],
            "i.json": [
                json.dumps(
                    {"x": list(grid()[:, 0]), "y": list(grid()[:, 1]), "z": list(grid()[:, 2])}
                )
            ],
        }
        for name, lines in texts.items():
            with self.subTest(name):
                (self.folder / name).write_text("\n".join(lines) + "\n")
                self.assert_reads(self.folder / name)

    def test_raw_floats(self):
        (self.folder / "a.xyz").write_bytes(grid().astype("<f4").tobytes())
        self.assert_reads(self.folder / "a.xyz")

    def test_a_molecule(self):
        path = self.folder / "water.xyz"
        path.write_text("3\nwater\nO 0 0 0\nH 0.76 0.59 0\nH -0.76 0.59 0\n" * 2)
        series = open_particles(path)
        self.assertEqual(len(series), 2)
        numbers = series.load(1).GetPointData().GetArray("atomic_number")
        self.assertEqual([numbers.GetValue(i) for i in range(3)], [8, 1, 1])
        self.succeed("skin", path, "--preset", "molecule", "-o", self.folder / "w_#.vtp")
        bounds = read_vtk(self.folder / "w_0.vtp").GetBounds()
        # Oxygen's van der Waals radius is 1.52. The hydrogens are on the other side (y > 0). The
        # tolerance is half a voxel.
        self.assertAlmostEqual(bounds[2], -1.52, delta=0.16)

    def test_a_vtp_with_a_range_that_vtk_cannot_read(self):
        speeds = numpy.full((125, 3), math.nan)
        cloud = data_objects.as_particles(grid(), speed=speeds)
        cloud.GetPointData().GetArray("speed").GetRange(-1)  # computed ranges are written
        path = write(vtkXMLPolyDataWriter(), cloud, self.folder / "a.vtp")
        read = open_particles(path).load(0).GetPointData().GetArray("speed")
        numpy.testing.assert_array_equal(vtk_to_numpy(read), speeds)

    def test_npz_with_frames_and_times(self):
        path = self.folder / "a.npz"
        moving = moving_grid(3)
        for more, times in (
            ({}, [0, 0.04, 0.08]),
            ({"fps": 10.0}, [0, 0.1, 0.2]),
            ({"times": [1.0, 2.0, 4.0]}, [1, 2, 4]),
        ):
            numpy.savez(path, positions=moving, mass=numpy.ones(125), v=moving, **more)
            series = open_particles(path)
            self.assertEqual(series.times, times)
            arrays = series.load(2).GetPointData()
            self.assertEqual(arrays.GetArray("mass").GetNumberOfTuples(), 125)
            self.assertEqual(arrays.GetArray("v").GetTuple(5), tuple(moving[2][5]))

    def test_npz_with_counts(self):
        path = self.folder / "a.npz"
        numpy.savez(path, positions=grid(), id=numpy.arange(125), counts=[100, 0, 25])
        series = open_particles(path)
        clouds = [series.load(step) for step in range(3)]
        self.assertEqual([cloud.GetNumberOfPoints() for cloud in clouds], [100, 0, 25])
        self.assertEqual(positions_of(clouds[2]).tobytes(), grid()[100:].tobytes())
        self.assertEqual(clouds[2].GetPointData().GetArray("id").GetValue(0), 100)

    def test_npz_that_does_not_fit_is_refused(self):
        rows, frames = numpy.zeros((1500, 3)), numpy.zeros((3, 500, 3))
        cases = (
            (
                '"counts" adds up to 1499, but there are 1500 positions',
                rows,
                {"counts": [500, 999]},
            ),
            ('"times" has 2 value(s) for 3 frame(s)', frames, {"times": [0, 1]}),
            ('"times" has 3 value(s) for 1 frame(s)', frames[:1], {"times": [0, 1, 2]}),
            (
                '"times" has values that are not numbers',
                frames,
                {"times": numpy.full(3, "2020", "M8[D]")},
            ),
            ("a.npz: Times have to be finite", frames, {"times": [0, 1, numpy.inf]}),
            ("a.npz: Times have to be finite", frames, {"times": [0, 1, 1]}),
            ('"fps" is 0, not a finite number above 0', frames, {"fps": 0}),
        )
        for words, positions, more in cases:
            with self.subTest(words):
                numpy.savez(self.folder / "a.npz", positions=positions, **more)
                self.assertIn(words, self.fail_with(1, "info", self.folder / "a.npz"))

    def test_arrays_of_a_json(self):
        points = {"positions": [[1, 2, 3]]}
        for more in {"comment": None}, {"counts": ["one"]}, {"counts": 1}, {"counts": [1.0]}:
            path = self.put("a.json", json.dumps({**points, **more}))
            self.assertEqual(open_particles(path).load(0).GetPoint(0), (1, 2, 3), more)
        said = self.fail_with(1, "info", self.put("b.json", '{"x": [1, 2], "z": [1, 2]}'))
        self.assertIn("no array of positions, but x, z", said)

    def test_frames_of_one_file_stay_as_they_were(self):
        series = open_particles(DROP)
        first = series.load(0)
        before = positions_of(first).tobytes()
        self.assertNotEqual(positions_of(series.load(20)).tobytes(), before)
        self.assertEqual(positions_of(first).tobytes(), before)

    def test_vdb_points(self):
        """Reads a file written by OpenVDB 10: the same lattice, in another order."""
        cloud = open_particles(DROP.with_name("lattice_points.vdb")).load(0)
        made = numpy.array(sorted(positions_of(cloud).round(6).tolist()))
        wanted = numpy.array(sorted(grid().round(6).tolist()))
        self.assertLessEqual(numpy.abs(made - wanted).max(), 2e-6)
        info = json.loads(self.succeed("info", DROP.with_name("lattice_points.vdb"), "--json").out)
        self.assertEqual((info["holds"], info["points"]), ("particles", 125))


class Meshes(CommandTest):
    def setUp(self):
        super().setUp()
        self.cube, self.ball = self.folder / "cube.stl", self.folder / "ball.vtp"
        cube, ball = vtkCubeSource(), vtkSphereSource()
        ball.SetRadius(0.6)
        ball.SetThetaResolution(48)
        ball.SetPhiResolution(48)
        for source, path in ((cube, self.cube), (ball, self.ball)):
            source.Update()
            skin_files.write_mesh(path, source.GetOutput())

    def assert_same(self, made, wanted, tolerance):
        self.assertAlmostEqual(volume_of(made), volume_of(wanted), delta=tolerance)
        for value, other in zip(made.GetBounds(), wanted.GetBounds()):
            self.assertAlmostEqual(value, other, delta=tolerance)

    def test_morph_writes_and_reads_every_format(self):
        wanted = None
        for suffix in skin_files.SKIN_SUFFIXES:
            with self.subTest(suffix):
                name = self.folder / f"m_#{suffix}"
                command = ["--frames", 3, "--voxel-size", VOXEL]
                self.succeed("morph", self.cube, self.ball, "-o", name, *command)
                made = read_shape(self.folder / f"m_2{suffix}")
                made = contour(made, 0.0) if suffix == ".vdb" else made
                wanted = wanted or made
                error = LEVEL_SET_ERROR if suffix == ".vdb" else 40 * FLOAT
                self.assert_same(made, wanted, error)
        self.assertEqual(self.hidden(), [])

    def test_convert_between_all(self):
        ball = read_shape(self.ball)
        for suffix in (*skin_files.SKIN_SUFFIXES, ".vtk"):
            with self.subTest(suffix):
                made, back = self.folder / f"b{suffix}", self.folder / "back.ply"
                size = ("--voxel-size", VOXEL) if suffix == ".vdb" else ()
                self.succeed("convert", self.ball, "-o", made, *size)
                self.succeed("convert", made, "-o", back)
                error = LEVEL_SET_ERROR if suffix == ".vdb" else 40 * FLOAT
                self.assert_same(read_shape(back), ball, error)
                info = json.loads(self.succeed("info", made, "--json").out)
                if suffix == ".vdb":
                    self.assertEqual(info["grids"][0]["class"], "level set")
                else:
                    self.assertEqual((info["holds"], info["closed"]), ("a mesh", "yes"))

    def test_a_vdb_is_no_source_of_another(self):
        self.succeed("convert", self.ball, "-o", self.folder / "a.vdb", "--voxel-size", VOXEL)
        said = self.fail_with(1, "convert", self.folder / "a.vdb", "-o", self.folder / "b.vdb")
        self.assertIn("is a .vdb already", said)
        self.assertFalse((self.folder / "b.vdb").exists())
        both = (self.ball, self.folder / "a.vdb")
        self.assertIn("a.vdb is a .vdb", self.fail_with(1, "convert", *both, "-o", "c_#.vdb"))
        self.assertEqual(list(self.folder.glob("c_*")), [])

    def test_images(self):
        function, sample = vtkSphere(), vtkSampleFunction()
        function.SetRadius(0.6)
        sample.SetImplicitFunction(function)
        sample.SetModelBounds(-1, 1, -1, 1, -1, 1)
        sample.SetSampleDimensions(41, 41, 41)
        sample.ComputeNormalsOff()
        image = write(vtkXMLImageDataWriter(), output_of(sample), self.folder / "a.vti")
        self.succeed("convert", image, "-o", self.folder / "a.ply")
        # The function is quadratic: a crossing between nodes is off by at most voxel^2 / 8 / 0.6.
        self.assertAlmostEqual(
            read_shape(self.folder / "a.ply").GetBounds()[1], 0.6, delta=VOXEL**2 / 8 / 0.6
        )
        self.succeed("convert", image, "-o", self.folder / "b.ply", "--level", 0.64 - 0.36)
        self.assertAlmostEqual(
            read_shape(self.folder / "b.ply").GetBounds()[1], 0.8, delta=VOXEL**2 / 8 / 0.8
        )
        said = self.fail_with(1, "convert", image, "-o", self.folder / "c.ply", "--level", 9)
        self.assertIn("no surface at the level 9", said)
        self.succeed("convert", image, "-o", self.folder / "a.vdb")
        self.assertEqual(json.loads(self.succeed("info", image, "--json").out)["holds"], "an image")
        self.succeed("morph", image, self.cube, "-o", self.folder / "m_#.vtp", "--frames", 2)
        made = read_shape(self.folder / "m_1.vtp")
        self.assertAlmostEqual(made.GetBounds()[1], 0.5, delta=0.0125)

    def test_particles_are_no_mesh_and_a_mesh_is_no_particles(self):
        numpy.savez(self.folder / "a.npz", positions=grid())
        said = self.fail_with(1, "convert", self.folder / "a.npz", "-o", self.folder / "a.stl")
        self.assertIn("active-surface skin", said)
        said = self.fail_with(1, "convert", self.cube, "-o", self.folder / "a.csv")
        self.assertIn("meshes and images are written as", said)

    def test_a_glb_is_one(self):
        for mesh in (self.ball, self.cube):
            self.succeed("convert", mesh, "-o", self.folder / "a.glb")
            content = (self.folder / "a.glb").read_bytes()
            magic, version, size, length, kind = struct.unpack_from("<4sIII4s", content)
            self.assertEqual((magic, version, size, kind), (b"glTF", 2, len(content), b"JSON"))
            self.assertEqual(length % 4, 0)
        described = json.loads(content[20 : 20 + length])
        size, kind = struct.unpack_from("<I4s", content, 20 + length)
        self.assertEqual((size, kind), (described["buffers"][0]["byteLength"], b"BIN\0"))
        self.assertEqual(described["accessors"][0]["max"], [0.5, 0.5, 0.5])

    def test_a_series_becomes_a_series(self):
        for step in range(2):
            skin_files.write_mesh(self.folder / f"s_{step}.stl", read_shape(self.cube))
        self.succeed("convert", self.folder / "s_*.stl", "-o", self.folder / "t_##.obj")
        self.assertEqual(
            [p.name for p in sorted(self.folder.glob("t_*"))], ["t_00.obj", "t_01.obj"]
        )

    def test_info_of_states_and_pictures(self):
        from active_implicit_surfaces import vtkActiveEXRWriter, vtkActiveImplicitSurface
        from vtkmodules.vtkImagingSources import vtkImageSinusoidSource

        surface = vtkActiveImplicitSurface()
        surface.SetInputData(data_objects.as_particles(grid()))
        surface.SetParticleSpacing(0.1)
        surface.Update()
        self.assertTrue(surface.SaveState(str(self.folder / "s.vdb")))
        told = self.succeed("info", self.folder / "s.vdb").out
        self.assertIn("state: yes", told)
        self.assertIn("name potential", told)
        image, writer = vtkImageSinusoidSource(), vtkActiveEXRWriter()
        image.SetWholeExtent(0, 31, 0, 15, 0, 0)
        writer.SetInputConnection(image.GetOutputPort())
        writer.SetFileName(str(self.folder / "p.exr"))
        writer.Write()
        info = json.loads(self.succeed("info", self.folder / "p.exr", "--json").out)
        self.assertEqual((info["pixels"], info["holds"]), ([32, 16], "a picture"))
        self.assertEqual(len(info["layers"]), 1)


if __name__ == "__main__":
    unittest.main()
