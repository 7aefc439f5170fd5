# ctest: LABELS contract exact
"""Particles in a periodic box: the skin does not depend on where the box is cut.

Run: python3 test_periodic.py
"""

import unittest
from pathlib import Path
from tempfile import TemporaryDirectory

import active_implicit_surfaces as active
import numpy
from active_implicit_surfaces import (
    ParticleSeries,
    vtkActiveImplicitSurface,
    vtkActiveVDBWriter,
)
from active_implicit_surfaces.data_objects import as_particles
from active_implicit_surfaces.measures import measure
from active_implicit_surfaces.skin_files import read_shape
from command_line import CommandTest
from listener import Listener
from shapes import points_of, volume_of
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkBox, vtkSphere
from vtkmodules.vtkFiltersCore import vtkClipPolyData, vtkFeatureEdges
from vtkmodules.vtkFiltersSources import vtkSphereSource

SPACING = 0.1
VOXEL = 0.5 * SPACING
SIDE = 2.0
BOX = (0.0, SIDE, 0.0, SIDE, 1.0, -1.0)
DEPTH = 8  # in particles
STEPS = 5


def water(time):
    """A layer with a wave and noise, which moves along x and y."""
    count = round(SIDE / SPACING)
    lattice = numpy.stack(numpy.meshgrid(*2 * [range(count)], range(DEPTH), indexing="ij"), -1)
    places = lattice.reshape(-1, 3) * SPACING
    places = places + numpy.random.default_rng(1).normal(0, 0.0125, places.shape)
    height = places[:, 2] / (DEPTH * SPACING)
    places[:, 2] += 0.1 * height * numpy.sin(2 * numpy.pi * places[:, 0] / SIDE)
    return places + numpy.array([0.15, 0.1, 0.0]) * time


def wrapped(places, low=0.0):
    places = places.copy()
    places[:, :2] = low + (places[:, :2] - low) % SIDE
    return places


def surface_over(frames, **properties):
    series = ParticleSeries(list(frames), times=range(len(frames)))
    surface = vtkActiveImplicitSurface()
    surface.SetInputConnection(series.GetOutputPort())
    for name, value in {"ParticleSpacing": SPACING, "PeriodicBounds": BOX, **properties}.items():
        getattr(surface, "Set" + name)(value)
    surface.series = series
    return surface


def skin_at(surface, time):
    surface.UpdateTimeStep(time)
    return surface.GetOutput()


def open_edges(skin):
    edges = vtkFeatureEdges()
    edges.SetInputData(skin)
    edges.FeatureEdgesOff()
    edges.Update()
    return edges.GetOutput().GetNumberOfCells()


def heights(skin, shift=(0, 0)):
    """Heights of the surface [voxels] above each node (x, y) of the lattice, by index."""
    nodes = points_of(skin) / VOXEL
    whole = numpy.rint(nodes[:, :2])
    above = (numpy.abs(nodes[:, :2] - whole) < 1e-3).all(axis=1) & (nodes[:, 2] > 8)
    count = round(SIDE / VOXEL)
    numbers = (whole[above].astype(int) - shift) % count
    return {tuple(number): z for number, z in zip(numbers, nodes[above, 2])}


class Water(unittest.TestCase):
    def test_positions_may_be_in_any_copy_of_the_box(self):
        one = surface_over([wrapped(water(t)) for t in range(STEPS)])
        other = surface_over([water(t) + [SIDE * t, -3 * SIDE, 0] for t in range(STEPS)])
        for time in (0, 1, 2.5, 4):
            skin, same = skin_at(one, time), skin_at(other, time)
            self.assertEqual(skin.GetNumberOfPoints(), same.GetNumberOfPoints())
            numpy.testing.assert_allclose(points_of(skin), points_of(same), atol=1e-3 * VOXEL)

    def test_the_volume_is_that_of_the_layer(self):
        surface = surface_over([wrapped(water(t)) for t in range(STEPS)])
        for time in (0, 0.5, 1, 2.3, 4):
            skin = skin_at(surface, time)
            self.assertAlmostEqual(volume_of(skin), SIDE**2 * DEPTH * SPACING, delta=0.01)
            self.assertEqual(open_edges(skin), 0)
            low, high = points_of(skin).min(axis=0), points_of(skin).max(axis=0)
            numpy.testing.assert_allclose(low[:2], 0, atol=1e-3 * VOXEL)
            numpy.testing.assert_allclose(high[:2], SIDE, atol=1e-3 * VOXEL)

    def test_it_does_not_matter_where_the_box_is_cut(self):
        for model in range(2):
            self.check_cuts(STEPS if model == 1 else 2, 0.1, 0.01, ParticleModel=model)
        self.check_cuts(1, 0.3, 0.1, TimeIntegration=vtkActiveImplicitSurface.EXPLICIT)

    def check_cuts(self, steps, most, mean, **properties):
        shift = numpy.array([13, 9])  # in voxels
        moved = [water(t) + [*(VOXEL * shift), 0] for t in range(STEPS)]
        here = surface_over([wrapped(water(t)) for t in range(STEPS)], **properties)
        there = surface_over([wrapped(places) for places in moved], **properties)
        count = round(SIDE / VOXEL)
        for time in range(steps):
            a, b = heights(skin_at(here, time)), heights(skin_at(there, time), shift)
            inside = [
                node
                for node in set(a) & set(b)
                if all(n not in (0, s % count, -s % count) for n, s in zip(node, shift))
            ]
            self.assertGreater(len(inside), 0.85 * count**2)
            off = numpy.array([a[node] - b[node] for node in inside])
            told = f"voxels at {time}, {properties}"
            self.assertLess(numpy.abs(off).max(), most, told)
            self.assertLess(numpy.abs(off).mean(), mean, told)

    def test_each_particle_may_be_in_another_copy(self):
        lengths = numpy.random.default_rng(3).integers(-3, 4, (len(water(0)), 2))
        jump = numpy.hstack([lengths * SIDE, numpy.zeros((len(lengths), 1))])
        for properties in ({}, {"ParticleModel": 0}):
            one = surface_over([wrapped(water(t)) for t in range(3)], **properties)
            other = surface_over([water(t) + jump for t in range(3)], **properties)
            for time in (0, 1.5, 2):
                volumes = [volume_of(skin_at(surface, time)) for surface in (one, other)]
                self.assertAlmostEqual(*volumes, delta=1e-4, msg=properties)
        surface = surface_over([water(0) + jump], ParticleSpacing=-1)
        heard = Listener(surface)
        skin_at(surface, 0)
        self.assertIn("a ParticleSpacing of 0.100", " ".join(heard.warnings))

    def test_sides_of_any_length(self):
        side = 1.93
        scale = side / SIDE
        places = [water(t) * [scale, scale, 1] for t in range(3)]
        surface = surface_over(places, PeriodicBounds=(0, side, 0, side, 1, -1))
        for time in range(3):
            volume = volume_of(skin_at(surface, time))
            self.assertAlmostEqual(volume / (side**2 * DEPTH * SPACING), 1, delta=0.02)

    def test_same_bytes_in_any_order_and_with_any_threads(self):
        frames = [wrapped(water(t)) for t in range(STEPS)]
        wanted = points_of(skin_at(surface_over(frames), 3))
        other = surface_over(frames, NumberOfThreads=1, CheckpointInterval=2)
        for time in (4, 0.5, 1, 3):
            last = points_of(skin_at(other, time))
        numpy.testing.assert_array_equal(last, wanted)
        saved = surface_over(frames)
        skin_at(saved, 2)
        with TemporaryDirectory() as folder:
            state = str(Path(folder) / "state.vdb")
            self.assertTrue(saved.SaveState(state))
            resumed = surface_over(frames)
            self.assertTrue(resumed.LoadState(state))
            numpy.testing.assert_array_equal(points_of(skin_at(resumed, 3)), wanted)
            writer = vtkActiveVDBWriter()
            writer.SetInputConnection(saved.GetOutputPort())
            writer.SetFileName(state)
            writer.WriteStateOn()
            self.assertTrue(writer.Write())
            again = surface_over(frames)
            self.assertTrue(again.LoadState(state))
            numpy.testing.assert_array_equal(points_of(skin_at(again, 3)), wanted)

    def test_the_sides_may_be_cut_open(self):
        """The skin is clipped by a box a hundredth of a voxel smaller (Filters/inputs.md)."""
        surface = surface_over([wrapped(water(0))])
        less, closed = 0.01 * VOXEL, skin_at(surface, 0)
        box, clip = vtkBox(), vtkClipPolyData()
        box.SetBounds(less, SIDE - less, less, SIDE - less, -10, 10)
        clip.SetInputData(closed)
        clip.SetClipFunction(box)
        clip.InsideOutOn()
        clip.Update()
        skin = clip.GetOutput()
        edges = vtkFeatureEdges()
        edges.SetInputData(skin)
        edges.FeatureEdgesOff()
        edges.Update()
        rim = points_of(edges.GetOutput())[:, :2]
        self.assertGreater(len(rim), 4 * SIDE / VOXEL)
        nearest, other = numpy.sort(numpy.minimum(rim, SIDE - rim), axis=1).T
        at_edge = other < 1.01 * VOXEL  # VTK cuts triangles across an edge of the box in one line
        self.assertLess(nearest[~at_edge].max(), 1.1 * less)
        self.assertLess(nearest[at_edge].max(), VOXEL)
        caps = measure(closed)["area"] - measure(skin)["area"]
        heights = DEPTH * SPACING - 2 * VOXEL, DEPTH * SPACING  # the edges of caps are round
        self.assertTrue(heights[0] < caps / (4 * SIDE) < heights[1], caps)

    def test_particles_in_the_velocity(self):
        surface = surface_over([wrapped(water(t)) for t in range(3)], ComputeVelocity=1)
        velocity = vtk_to_numpy(skin_at(surface, 2).GetPointData().GetArray("Velocity"))
        top = points_of(surface.GetOutput())[:, 2] > 0.5
        numpy.testing.assert_allclose(
            numpy.median(velocity[top], axis=0), [0.15, 0.1, 0], atol=0.01
        )
        self.assertLess(numpy.linalg.norm(velocity, axis=1).max(), 1.0)


class Drops(unittest.TestCase):
    def test_a_drop_goes_through_the_side(self):
        ball = numpy.stack(numpy.meshgrid(*3 * [numpy.arange(-5, 6.0)]), -1).reshape(-1, 3)
        ball = SPACING * ball[numpy.linalg.norm(ball, axis=1) < 3.3] + [0, 1, 1]
        start, steps = 1.4, 9
        frames = [wrapped(ball + [start + 0.15 * t, 0, 0]) for t in range(steps)]
        surface = surface_over(frames)
        whole = volume_of(skin_at(surface, 0))
        rims = 2 * 2 * numpy.pi * 0.38 * VOXEL**2 / 2  # the triangles' chamfer at both sides
        pieces = []
        for time in numpy.arange(0, steps - 0.5, 0.5):
            skin = skin_at(surface, time)
            self.assertAlmostEqual(volume_of(skin), whole, delta=rims + 0.01 * whole, msg=time)
            x = points_of(skin)[:, 0]
            off = numpy.abs((x - start - 0.15 * time + 0.5 * SIDE) % SIDE - 0.5 * SIDE)
            self.assertLess(off.max(), 0.33 + SPACING, "a piece in the middle of the box")
            pieces.append(len(set(numpy.rint(x / SIDE))))
        self.assertEqual((pieces[0], max(pieces), pieces[-1]), (1, 2, 1), "through the side")

    def test_what_does_not_go_with_it(self):
        surface = surface_over([water(0), water(1)], VolumeControl=2)
        heard = Listener(surface)
        surface.UpdateTimeStep(0)
        self.assertIn("PeriodicBounds continues the skin across the sides", " ".join(heard.errors))
        self.assertEqual(surface.GetOutput().GetNumberOfPoints(), 0)

    def test_only_particles_have_a_box(self):
        surface = vtkActiveImplicitSurface()
        source = vtkSphereSource()
        surface.SetInputConnection(source.GetOutputPort())
        surface.SetPeriodicBounds(BOX)
        heard = Listener(surface)
        skin = skin_at(surface, 0)
        self.assertIn("PeriodicBounds has no effect here", " ".join(heard.warnings))
        self.assertLess(points_of(skin)[:, 0].min(), -0.45, "not cut at the side")

    def test_a_function_has_no_box(self):
        surface = vtkActiveImplicitSurface()
        surface.SetTargetFunction(vtkSphere())
        surface.SetModelBounds(-1, 1, -1, 1, -1, 1)
        surface.SetPeriodicBounds(BOX)
        heard = Listener(surface)
        surface.Update()
        self.assertIn("PeriodicBounds has no effect here", " ".join(heard.warnings))

    def test_narrow_boxes_are_refused(self):
        for side in (0.19, 1e-9):
            surface = surface_over([water(0)], PeriodicBounds=(0, side, 0, SIDE, 1, -1))
            heard = Listener(surface)
            surface.UpdateTimeStep(0)
            told = " ".join(" ".join(heard.errors).split())
            self.assertIn("long along x, less than four voxels of 0.05;", told)

    def test_kernels_that_are_long_for_the_box_are_refused(self):
        box = (0, 0.04, 0, 0.04, 0, 0.04)
        surface = surface_over([water(0)], PeriodicBounds=box, VoxelSize=0.01, ParticleSpacing=1)
        heard = Listener(surface)
        surface.UpdateTimeStep(0)
        told = " ".join(" ".join(heard.errors).split())
        self.assertIn("less than a quarter of 7.2, the distance up to which particles", told)

    def test_balls_of_any_radius_have_their_copies(self):
        few = numpy.array([[2, y, z] for y in (0.2, 3.8) for z in (0.2, 3.8)])
        for model in (0, 1):
            found = []
            for x in (3.8, 2.8):  # across the side, and within
                places = numpy.vstack([few, [[x, 2, 2]]])
                balls = as_particles(places, radii=numpy.array(4 * [0.1] + [0.5]))
                surface = vtkActiveImplicitSurface()
                surface.SetInputData(balls)
                surface.SetInputArrayToProcess(0, 0, 0, 0, "radius")
                surface.SetVoxelSize(0.08)
                surface.SetParticleModel(model)
                surface.SetPeriodicBounds(0, 4, 0, 4, 0, 4)
                found.append(points_of(skin_at(surface, 0))[:, 0])
            cut, whole = found
            self.assertLess(cut.min(), 1e-3)
            self.assertAlmostEqual(cut[cut < 0.5].max(), whole.max() + 1 - 4, delta=0.01)

    def test_a_part_too_thin_for_the_lattice_is_not_outside(self):
        ball = numpy.stack(numpy.meshgrid(*3 * [numpy.arange(-5, 6.0)]), -1).reshape(-1, 3)
        ball = SPACING * ball[numpy.linalg.norm(ball, axis=1) < 3.3] + [1.7, 1, 1]
        surface = surface_over([ball] * 3)
        heard = Listener(surface)
        skin_at(surface, 2)
        self.assertEqual(heard.warnings, [])

    def test_few_particles(self):
        one = numpy.array([[0.0, 1.0, 1.0]])
        surface = surface_over([one, one + [0.08, 0, 0], one[:0]])
        pieces = [skin_at(surface, time).GetNumberOfPoints() > 0 for time in (0, 0.5, 1, 2)]
        self.assertEqual(pieces, [True, True, True, False])


GRO = "water, t= {time}\n{count}\n{rows}\n   2.00000   2.00000   5.00000\n"
DUMP = """ITEM: TIME
{time}
ITEM: TIMESTEP
{time}
ITEM: NUMBER OF ATOMS
{count}
ITEM: BOX BOUNDS pp pp ff
0 2
0 2
0 5
ITEM: ATOMS x y z
{rows}
"""
XYZ = '{count}\nLattice="{box}" Properties=pos:R:3 pbc="T T F" Time={time}\n{rows}\n'


class Files(CommandTest):
    def write(self, *boxes):
        with open(self.folder / "p.xyz", "w", encoding="utf-8") as file:
            for time, box in enumerate(boxes):
                places = wrapped(water(time))
                rows = "\n".join(" ".join(f"{x:.6f}" for x in row) for row in places)
                text = {"count": len(places), "box": box, "time": time, "rows": rows}
                file.write(XYZ.format(**text))

    def test_the_box_of_a_file(self):
        self.write("2 0 0 0 2 0 0 0 5", "2 0 0 0 2 0 0 0 5")
        command = ("skin", "p.xyz", "--particle-spacing", SPACING, "--quiet")
        self.succeed(*command, "--periodic", "-o", "a_#.vtp")
        self.succeed(*command, "--periodic-bounds", *BOX, "-o", "b_#.vtp")
        for step in range(2):
            one, other = (self.folder / f"{name}_{step}.vtp" for name in "ab")
            self.assertEqual(one.read_bytes(), other.read_bytes())
        surface = active.frames(str(self.folder / "p.xyz"), periodic=True).surface
        self.assertEqual(surface.GetPeriodicBounds(), BOX)

    def test_the_box_stays_with_selected_and_converted_particles(self):
        self.write("2 0 0 0 2 0 0 0 5", "2 0 0 0 2 0 0 0 5")
        self.succeed("convert", "p.xyz", "-o", "p_#.vtp")
        for name in ("p.xyz", "p_*.vtp"):
            way = active.frames(str(self.folder / name), where="z<9", periodic=True)
            self.assertEqual(way.surface.GetPeriodicBounds(), BOX)

    def test_boxes_of_molecules(self):
        """A .dump and a .gro give the skin of the .xyz. In the .gro z is periodic too."""
        atom = "    1SOL     OW    1{:8.3f}{:8.3f}{:8.3f}"
        texts = {"p.xyz": (XYZ, "{} {} {}"), "p.dump": (DUMP, "{} {} {}"), "p.gro": (GRO, atom)}
        command, skins = ("--particle-spacing", SPACING, "--periodic", "--quiet"), []
        for name, (frame, row) in texts.items():
            text = ""
            for time in range(2):
                places = numpy.round(wrapped(water(time)) + [0, 0, 2], 3)
                rows = "\n".join(row.format(*place) for place in places)
                named = {"count": len(places), "time": time, "box": "2 0 0 0 2 0 0 0 5"}
                text += frame.format(rows=rows, **named)
            (self.folder / name).write_text(text, encoding="utf-8")
            self.succeed("skin", name, *command, "-o", "s_#.vtp")
            skins.append([read_shape(self.folder / f"s_{step}.vtp") for step in range(2)])
        for wanted, *others in zip(*skins):
            self.assertAlmostEqual(volume_of(wanted), SIDE**2 * DEPTH * SPACING, delta=0.01)
            for skin in others:
                self.assertEqual(skin.GetNumberOfPoints(), wanted.GetNumberOfPoints())
                numpy.testing.assert_allclose(points_of(skin), points_of(wanted), atol=1e-3 * VOXEL)

    def test_the_corner_of_the_box(self):
        places = "0.5 0.5 0.5"
        head = 'Lattice="2 0 0 0 3 0 0 0 4" Origin="-1 -2 -3" Properties=pos:R:3 pbc="T F T"'
        (self.folder / "one.xyz").write_text(f"1\n{head}\n{places}\n", encoding="utf-8")
        path, given = str(self.folder / "one.xyz"), {"particle_spacing": 0.5, "periodic": True}
        surface = active.frames(path, **given).surface
        self.assertEqual(surface.GetPeriodicBounds(), (-1, 1, 1, -1, -3, 1))
        with self.assertRaisesRegex(ValueError, "either periodic or periodic_bounds"):
            active.frames(path, **given, periodic_bounds=BOX)

    def test_boxes_that_cannot_be(self):
        command = ("skin", "p.xyz", "--particle-spacing", SPACING, "--periodic", "-o", "a_#.vtp")
        self.write("2 0 0 0.5 2 0 0 0 5")
        self.assertIn("slanted or rotated", self.fail_with(1, *command))
        self.write("2 0 0 0 2 0 0 0 5", "2.1 0 0 0 2 0 0 0 5")
        self.assertIn(
            "from [0, 2] x [0, 2] x (no period) to [0, 2.1] x", self.fail_with(1, *command)
        )
        text = (self.folder / "p.xyz").read_text().replace("T T F", "T T")
        (self.folder / "p.xyz").write_text(text)
        self.assertIn("The pbc of the box has 2 numbers, not 3", self.fail_with(1, *command))
        numpy.save(self.folder / "p.npy", water(0))
        command = ("skin", "p.npy", "--periodic", "-o", "a.vtp")
        self.assertIn("no particles with a box", self.fail_with(1, *command))


if __name__ == "__main__":
    unittest.main()
