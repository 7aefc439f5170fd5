# ctest: LABELS contract
"""Choices before the skin: conditions, labels, small pieces; ranges of frames and frames between.

Run: python3 test_choice.py
"""

import json
import unittest

import active_implicit_surfaces as active
import numpy
from active_implicit_surfaces import choice, file_names
from active_implicit_surfaces.data_objects import as_particles
from active_implicit_surfaces.particle_files import open_particles
from active_implicit_surfaces.skin_files import read_shape
from command_line import CommandTest, grid
from reader_checks import array_of
from shapes import image_of, points_of, volume_of, write
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkFiltersCore import vtkStripper, vtkThresholdPoints
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkSphereSource
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

SHIFTS = 0.05 * numpy.arange(6)
QUIET = ("--quiet", "--particle-spacing", 0.1)


def ids_of(data):
    return sorted(array_of(data, "id")) if data.GetNumberOfPoints() else []


class Conditions(unittest.TestCase):
    def setUp(self):
        points = numpy.array([[0, 0, 0], [1, 0, 0], [2, 0, 1e7 + 0.25], [3, 4, 0]])
        arrays = {"Type": [1, 2, 3, 3], "T": [300.0, 310.0, numpy.nan, 290.0], "v": points}
        self.cloud = as_particles(points, ids=numpy.arange(4), **arrays)

    def test_signs_numbers_and_vectors(self):
        for where, wanted in (
            ("Type=3", [2, 3]),
            ("Type==3", [2, 3]),
            ("Type=1,2", [0, 1]),
            ("Type!=3", [0, 1]),
            ("T>300", [1]),
            ("T>=300", [0, 1]),
            ("T<1e3", [0, 1, 3]),
            ("T != 290", [0, 1, 2]),
            ("v=5", [3]),
            ("x<=1", [0, 1]),
            ("y>3", [3]),
            (["Type=3", "T<300"], [3]),
            (["Type=3", "T>300"], []),
        ):
            with self.subTest(where):
                self.assertEqual(ids_of(choice.choose(self.cloud, where)), wanted)

    def test_positions_and_arrays_are_as_they_were(self):
        chosen = choice.choose(self.cloud, "id=2")
        self.assertEqual(chosen.GetPoint(0), (2, 0, 1e7 + 0.25))
        names = [chosen.GetPointData().GetArrayName(i) for i in range(4)]
        self.assertEqual(names, ["id", "Type", "T", "v"])
        self.assertEqual(chosen.GetPointData().GetNumberOfArrays(), 4)

    def test_what_is_no_condition(self):
        for where in ("Type", "Type=", "=3", "T<a", "T<1,2", "T=>3", "T=1,", 'T="a', ""):
            with self.subTest(where), self.assertRaisesRegex(ValueError, "is no condition"):
                choice.choose(self.cloud, [where])
        for name in ("Kind", "T_x", "v:3"):  # T has one component
            words = f"no array '{name}' to choose by; there are x, y, z"
            with self.subTest(name), self.assertRaisesRegex(ValueError, words):
                choice.choose(self.cloud, f"{name}=1")

    def test_polygons_by_points_and_by_cells(self):
        cube = vtkCubeSource()
        cube.Update()
        mesh = cube.GetOutput()
        self.assertEqual(choice.choose(mesh, "x>0").GetNumberOfCells(), 1)
        array = numpy_to_vtk(numpy.arange(6))
        array.SetName("face")
        mesh.GetCellData().AddArray(array)
        self.assertEqual(choice.choose(mesh, "face<4").GetNumberOfPolys(), 4)

    def test_strips_are_triangles(self):
        ball, strips = vtkSphereSource(), vtkStripper()
        strips.SetInputConnection(ball.GetOutputPort())
        strips.Update()
        one, other = (choice.choose(mesh.GetOutput(), "x>0") for mesh in (strips, ball))
        self.assertEqual(one.GetNumberOfPolys(), other.GetNumberOfPolys())

    def test_small_pieces(self):
        points = numpy.vstack([grid(), grid(2) + 3, [[9.0, 9, 9]]])
        cloud = as_particles(points, ids=numpy.arange(134))
        for minimum, count in ((1, 134), (2, 133), (8, 133), (9, 125), (126, 0)):
            kept = choice.without_small_pieces(cloud, minimum, 0.1)
            self.assertEqual(ids_of(kept), list(range(count)))
        for volume, count in ((0.0005, 134), (0.008, 133), (0.0081, 125), (0.125, 125), (0.126, 0)):
            arguments = {"particle_spacing": 0.1, "minimum_volume": volume}
            if count:
                way = active.frames([points], **arguments)
                self.assertEqual(way.source.frame(0).GetNumberOfPoints(), count)
            else:
                with self.assertRaisesRegex(ValueError, "a cluster of 126 or more"):
                    active.frames([points], **arguments)

    def test_particles_keep_their_order(self):
        """Without ids, the filter matches particles of two frames by their order."""
        points = numpy.random.default_rng(1).permutation(numpy.vstack([grid(), [[9.0, 9, 9]]]))
        kept = choice.without_small_pieces(as_particles(points), 2, 0.1)
        numpy.testing.assert_array_equal(points_of(kept), points[points[:, 0] < 9])

    def test_python_functions(self):
        frames = [as_particles(grid() + step, kind=numpy.arange(125) % 2) for step in range(2)]
        way = active.frames(frames, where="kind=1", particle_spacing=0.1)
        self.assertEqual(way.source.frame(1).GetNumberOfPoints(), 62)
        for where, count in ((iter(["kind=1"]), 62), (None, 125)):
            series = active.ParticleSeries(frames, where=where)
            self.assertEqual(series.frame(1).GetNumberOfPoints(), count)
        with self.assertRaisesRegex(ValueError, "No frame has particles that meet kind=7"):
            active.frames(frames, where="kind=7")
        points = [numpy.vstack([grid(), grid(2) + 3]) + 0.02 * step for step in range(3)]
        way = active.frames(points, fps=10, output_fps=40, minimum_piece=9, particle_spacing=0.1)
        numpy.testing.assert_allclose([time for time, _ in way], numpy.arange(9) / 40)
        self.assertLess(next(way).skin.GetBounds()[1], 1)

    def test_a_threshold_upstream_gives_the_same_skin(self):
        cloud = as_particles(
            numpy.vstack([grid(), grid() + [0.3, 0, 2]]), Type=[1] * 125 + [2] * 125
        )
        threshold, surface = vtkThresholdPoints(), active.vtkActiveImplicitSurface()
        threshold.SetInputData(cloud)
        threshold.SetInputArrayToProcess(0, 0, 0, 0, "Type")
        threshold.ThresholdBetween(1, 1)
        surface.SetInputConnection(threshold.GetOutputPort())
        surface.SetParticleSpacing(0.1)
        surface.Update()
        (_, chosen), *_ = active.frames([cloud], where="Type=1", particle_spacing=0.1)
        own = points_of(surface.GetOutput())
        self.assertGreater(len(own), 500)
        numpy.testing.assert_array_equal(points_of(chosen), own)

    def test_frames_in_between_keep_the_events(self):
        """Two boxes touch, and separate by 0.1 per frame; a third box appears in frame 3."""
        halves = [numpy.vstack([grid() - [x, 0, 0], grid() + [0.5 + x, 0, 0]]) for x in SHIFTS]
        places = [*halves[:3], *(numpy.vstack([each, grid(3) + [0, 2, 0]]) for each in halves[3:])]
        for rate in ({}, {"output_fps": 20}, {"output_fps": 40}):
            skins = active.frames(places, fps=10, particle_spacing=0.1, **rate)
            self.assertEqual(len(list(skins)), 5 * rate.get("output_fps", 10) // 10 + 1)
            held = active.history(skins)
            numpy.testing.assert_allclose(held["Time"], numpy.arange(6) / 10, atol=1e-12)
            events = {
                round(time, 3): text for time, text in zip(held["Time"], held["Event"]) if text
            }
            self.assertEqual(events, {0.2: "split", 0.3: "birth"})


class Components(unittest.TestCase):
    def test_a_component_of_vectors(self):
        cloud = as_particles(numpy.eye(3), v=[[1, 2, 3], [4, 5, 6], [7, 8, 9]])
        for condition, count in (("v_x>3", 2), ("v:1=8", 1), ("v[2]<4", 1), ("v.z!=9", 2)):
            found = choice.choose(cloud, condition).GetNumberOfPoints()
            self.assertEqual(found, count, condition)
        for condition in ("v_w=1", "u_x=1", "v:3=1"):
            with self.assertRaisesRegex(ValueError, "there are x, y, z, v."):
                choice.choose(cloud, condition)

    def test_a_condition_is_one_comparison(self):
        for text in ("0<x<1", "a=1 and b=2", "a==1 && b==2"):
            with self.assertRaisesRegex(ValueError, "compares one array with numbers or texts"):
                choice.choose(as_particles(numpy.eye(3)), text)


class Labels(CommandTest):
    """A label map: box 3 of 6 x 6 x 6 points, the adjacent box 5 of 4 x 6 x 6, and the distant
    box 9."""

    def setUp(self):
        super().setUp()
        values = numpy.zeros((12, 12, 22), "i2")  # z, y, x
        values[3:9, 3:9, 3:9], values[3:9, 3:9, 9:13], values[3:9, 3:9, 16:20] = 3, 5, 9
        write(vtkXMLImageDataWriter(), image_of(values), self.folder / "map.vti")

    def test_one_and_several_of_an_image(self):
        self.succeed("convert", "map.vti", "--label", 3, "-o", "three.stl")
        # The surface is half a voxel outside of the points of the label, but loses 7.4 % of the
        # volume at edges and corners.
        self.assertAlmostEqual(
            volume_of(read_shape(self.folder / "three.stl")), 6**3, delta=0.08 * 6**3
        )
        self.succeed("convert", "map.vti", "--labels", "all", "-o", "part_##.stl")
        made = sorted(path.name for path in self.folder.glob("part*"))
        self.assertEqual(made, ["part_03.stl", "part_05.stl", "part_09.stl"])
        self.succeed("convert", "map.vti", "--labels", "5,9", "-o", "part.ply")
        for label in (5, 9):
            own = volume_of(read_shape(self.folder / f"part_{label}.ply"))
            self.assertAlmostEqual(own, 6 * 6 * 4, delta=0.1 * 144)
        said = self.fail_with(1, "convert", "map.vti", "--label", 4, "-o", "none.stl")
        self.assertIn("The image has no label 4; it has 3, 5, 9.", said)

    def test_info(self):
        told = json.loads(self.succeed("info", "map.vti", "--json").out)
        self.assertEqual(told["labels"], {"3": 216, "5": 144, "9": 144})
        told = json.loads(self.succeed("info", "map.vti", "--labels", "all", "--json").out)
        self.assertEqual(list(told), ["label 3", "label 5", "label 9"])

    def test_an_image_without_labels(self):
        write(vtkXMLImageDataWriter(), image_of(numpy.zeros((4, 4, 4))), self.folder / "none.vti")
        for command in ("convert", "skin"):
            said = self.fail_with(1, command, "none.vti", "--label", "all", "-o", "n_#.ply")
            self.assertIn("has found no label", said)

    def test_infinite_values_are_no_labels(self):
        values = numpy.zeros((4, 4, 4))
        values[1, 1, 1:3] = 3, numpy.inf
        write(vtkXMLImageDataWriter(), image_of(values), self.folder / "far.vti")
        self.assertNotIn("labels", json.loads(self.succeed("info", "far.vti", "--json").out))
        said = self.fail_with(1, "convert", "far.vti", "--label", "all", "-o", "f_#.ply")
        self.assertIn("not all values are whole numbers", said)

    def test_skins_of_particles(self):
        points = numpy.vstack([grid(), grid(4) + 2])
        labels = [7] * 125 + [2] * 64
        for step in range(2):
            numpy.savez(self.folder / f"p_{step}.npz", positions=points, label=labels)
        self.succeed("skin", "p_*.npz", "--labels", "all", "-o", "s_####.stl", *QUIET)
        made = sorted(path.name for path in self.folder.glob("s_*.stl"))
        self.assertEqual(made, [f"s_{n}_000{i}.stl" for n in (2, 7) for i in (0, 1)])
        self.assertGreater(read_shape(self.folder / "s_2_0001.stl").GetBounds()[0], 1)
        two = numpy.stack([points, points])
        numpy.savez("all.npz", positions=two, label=numpy.stack([labels, labels]))
        self.succeed("skin", "all.npz", "--labels", "2,7", "-o", "t_##_####.stl", *QUIET)
        made = sorted(path.name for path in self.folder.glob("t_*.stl"))
        self.assertEqual(made, [f"t_0{n}_000{i}.stl" for n in (2, 7) for i in (0, 1)])
        self.succeed("convert", "p_0.npz", "--label", 2, "-o", "two.csv")
        self.assertEqual(open_particles("two.csv").load(0).GetNumberOfPoints(), 64)

    def test_names(self):
        for name, is_series, wanted in (
            ("a.stl", False, "a_3.stl"),
            ("a_##.stl", False, "a_03.stl"),
            ("a_####.stl", True, "a_3_####.stl"),
            ("a_##_####.stl", True, "a_03_####.stl"),
        ):
            self.assertEqual(str(file_names.labelled(name, 3, is_series, True)), wanted)
        self.assertEqual(str(file_names.labelled("a.stl", 3, False, False)), "a.stl")


class Programs(CommandTest):
    """A lattice of 125 particles of Type 1 beside a moving one of 27 of Type 2, as files 10 to
    16."""

    def setUp(self):
        super().setUp()
        for step in range(7):
            points = numpy.vstack([grid(), grid(3) + [2, 0.02 * step**2, 0]])
            kinds = [1] * 125 + [2] * 27
            numpy.savez(self.folder / f"p_{step + 10}.npz", positions=points, Type=kinds)

    def test_nothing_left_is_said(self):
        said = self.succeed("convert", "p_10.npz", "--where", "Type>5", "-o", "c.csv").err
        self.assertIn("Frame 1 of 1 is empty: nothing in it meets Type>5.", said)
        self.assertEqual((self.folder / "c.csv").read_text().split(), ["x,y,z,Type"])
        said = self.fail_with(1, "skin", "p_*.npz", "--minimum-piece", 999, *QUIET)
        self.assertIn("No frame has particles in a cluster of 999 or more;", said)

    def bounds(self, name):
        return read_shape(self.folder / name).GetBounds()

    def made(self, pattern):
        return sorted(path.name for path in self.folder.glob(pattern))

    def test_where(self):
        self.succeed("skin", "p_10.npz", "--where", "Type=1", "-o", "a.ply", *QUIET)
        self.assertLess(self.bounds("a.ply")[1], 1)
        self.succeed("skin", "p_10.npz", "--minimum-piece", 28, "-o", "b.ply", *QUIET)
        self.assertLess(self.bounds("b.ply")[1], 1)
        self.succeed("skin", "p_10.npz", "--minimum-volume", 0.0275, "-o", "b.ply", *QUIET)
        self.assertLess(self.bounds("b.ply")[1], 1)
        told = json.loads(self.succeed("info", "p_*.npz", "--where", "Type=2", "--json").out)
        self.assertEqual(told["points"], 27)
        self.succeed("convert", "p_10.npz", "--where", "Type=2", "--where", "x>2.1", "-o", "c.csv")
        self.assertEqual(open_particles("c.csv").load(0).GetNumberOfPoints(), 9)
        said = self.fail_with(1, "skin", "p_10.npz", "--where", "Type=4")
        self.assertIn("There is no Type=4; Type is 1, 2.", said)
        said = self.fail_with(1, "skin", "p_*.npz", "--where", "Type=4")
        self.assertIn("No frame has particles that meet Type=4;", said)

    def test_frames_and_frames_in_between(self):
        self.succeed("skin", "p_*.npz", "--frames", "11:15:2", "-o", "s_##.ply", *QUIET)
        self.assertEqual(self.made("s_*.ply"), ["s_11.ply", "s_13.ply", "s_15.ply"])
        arguments = ("--fps", 10, "--output-fps", 20, "--frames", "12:13")
        self.succeed("skin", "p_*.npz", *arguments, "-o", "t_##.ply", *QUIET)
        self.assertEqual(self.made("t_*.ply"), ["t_04.ply", "t_05.ply", "t_06.ply"])
        numpy.testing.assert_allclose(
            file_names.read_index(self.folder / "t.ply.series").times, [0.2, 0.25, 0.3]
        )
        one = self.succeed("skin", "p_*.npz", "--frames", "13:13", "--transport", 0.5, *QUIET)
        self.assertIn("No effect on one frame: --transport", one.err)
        arguments = ("--frames", "13:13", "--preroll", 2, "--transport", 0.5, *QUIET)
        self.assertNotIn("No effect", self.succeed("skin", "p_*.npz", *arguments).err)
        said = self.fail_with(1, "skin", "p_*.npz", "--frames", "20:30")
        self.assertIn(
            "--frames 20:30:1 selects no frame; the frames are 10, 11, 12, 13, 14, 15, 16.", said
        )
        for wrong in ("10", "a:b", "1:2:0", "1:2:3:4"):
            self.fail_with(2, "skin", "p_*.npz", "--frames", wrong)
        self.assertIn(
            "it acts before the first", self.fail_with(2, "skin", "p_*.npz", "--preroll", 2)
        )

    def test_a_chunk_that_is_rolled_from_the_start_has_the_bytes_of_one_run(self):
        self.succeed("skin", "p_*.npz", "-o", "w_##.ply", "--quiet")
        for preroll, is_same in ((3, True), (1, False)):
            arguments = ("--frames", "13:15", "--preroll", preroll, "-o", "c_##.ply", "--quiet")
            self.succeed("skin", "p_*.npz", *arguments)
            for step in (13, 14, 15):
                own, whole = (self.folder / f"{name}_{step}.ply" for name in "cw")
                self.assertEqual(own.read_bytes() == whole.read_bytes(), is_same, step)

    def test_in_between_is_between(self):
        arguments = ("--fps", 10, "--output-fps", 20, "-o", "t_##.ply", "--where", "Type=2")
        self.succeed("skin", "p_*.npz", *arguments, *QUIET)
        heights = [self.bounds(f"t_{i:02}.ply")[3] for i in range(13)]
        self.assertEqual(heights, sorted(heights))
        self.assertGreater(heights[-1] - heights[-3], 0.1, "it moves by .22 in the last frame")

    def test_a_run_with_choices_is_resumed_to_the_same_bytes(self):
        arguments = ("p_*.npz", "--fps", 10, "--output-fps", 20, "--where", "Type=2", *QUIET)
        self.succeed("skin", *arguments, "-o", "whole_##.ply")
        last = (self.folder / "p_16.npz").read_bytes()
        (self.folder / "p_16.npz").write_bytes(b"PK")
        self.fail_with(1, "skin", *arguments, "-o", "s_##.ply", "--resume")
        self.assertLess(len(self.made("s_*.ply")), 13)
        (self.folder / "p_16.npz").write_bytes(last)
        self.succeed("skin", *arguments, "-o", "s_##.ply", "--resume")
        for i in range(13):
            own, whole = (self.folder / f"{name}_{i:02}.ply" for name in ("s", "whole"))
            self.assertEqual(own.read_bytes(), whole.read_bytes(), i)


if __name__ == "__main__":
    unittest.main()
