# ctest: LABELS exact
"""Tests the node scheme over particles: skins of known size or shape, and the same bytes for any
order of requests, number of threads, restart and instruction set.

Run: python3 test_nodes.py
"""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy
from active_implicit_surfaces import ParticleSeries, vtkActiveImplicitSurface
from active_implicit_surfaces.data_objects import as_particles
from active_implicit_surfaces.measures import measure
from listener import Listener
from shapes import points_of, volume_of, with_properties
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkSphere
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

DROP = Path(__file__).resolve().parents[1] / "Data" / "sph_drop.vtp"
R = 0.5  # half of the particles' spacing
LAST = 4


def block(n):
    """n^3 particles, one spacing apart, around a point off every lattice of voxels."""
    axis = numpy.arange(n) - (n - 1) / 2 + 0.137
    return numpy.stack(numpy.meshgrid(axis, axis, axis, indexing="ij"), -1).reshape(-1, 3)


def skin_of(function, steps=LAST + 1, voxel=R, **properties):
    """The filter over function(t) -> (points, ids) at the times 0, 1 ..."""

    def particles(t):
        points, ids = function(t)
        return as_particles(points, ids=ids)

    surface = vtkActiveImplicitSurface()
    source = ParticleSeries(particles, times=range(steps))
    surface.SetInputConnection(source.GetOutputPort())
    surface.source = source
    surface.SetInputArrayToProcess(1, 0, 0, 0, "id")
    surface.SetParticleSpacing(2 * R)
    surface.SetVoxelSize(voxel)
    return with_properties(surface, properties)


def make_surface(**properties):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(DROP))
    surface = vtkActiveImplicitSurface()
    surface.SetInputConnection(reader.GetOutputPort())
    surface.SetParticleSpacing(0.1)
    surface.SetVoxelSize(0.05)
    surface.SetInputArrayToProcess(1, 0, 0, 0, "id")
    return with_properties(surface, properties)


def at(surface, t):
    surface.UpdateTimeStep(t)
    return surface.GetOutput()


def column(surface, name):
    return list(vtk_to_numpy(surface.GetOutputDataObject(2).GetColumnByName(name)))


def roughness_of(skin):
    """Mean angle between the normals of adjacent triangles, weighted by area [rad]."""
    corners = vtk_to_numpy(skin.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    points = points_of(skin)[corners].astype(float)
    normals = numpy.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0])
    areas = numpy.linalg.norm(normals, axis=1)
    normals /= numpy.maximum(areas, 1e-30)[:, None]
    edges = numpy.sort(corners[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    pairs = numpy.lexsort(edges.T).reshape(-1, 2) // 3  # each edge is in two triangles
    cosines = (normals[pairs[:, 0]] * normals[pairs[:, 1]]).sum(axis=1)
    weights = areas[pairs].min(axis=1)
    return (numpy.arccos(numpy.clip(cosines, -1, 1)) * weights).sum() / weights.sum()


class Truths(unittest.TestCase):
    def test_tension_makes_no_waves(self):
        """Over still particles the skin is as smooth after many frames as at first."""
        points = numpy.random.default_rng(3).uniform(0, 10.7, (12**3, 3))
        for voxel, tension, weighted in (
            (R, -1, True),
            (R / 2, -1, True),
            (R / 2, 6 * R**2, True),
            (R, 6 * R**2, False),
            (R, 18 * R**2, True),
            (R, 36 * R**2, True),
        ):
            with self.subTest(voxel=voxel, tension=tension, weighted=weighted):
                surface = skin_of(
                    lambda t: (points, numpy.arange(len(points))),
                    steps=13,
                    voxel=voxel,
                    Attraction=6,
                    Tension=tension,
                    TensionWeighting=weighted,
                )
                first, last = (roughness_of(at(surface, t)) for t in (0, 12))
                self.assertLess(last, 1.1 * first)

    def test_a_lone_particle_is_a_ball_of_its_own_radius(self):
        """The error of the volume is of second order in the voxel size."""
        errors = []
        for voxel in (R / 4, R / 8):
            skin = at(skin_of(lambda t: (numpy.full((1, 3), 0.1371), [7]), voxel=voxel), LAST)
            errors.append(abs(volume_of(skin) / (4 / 3 * numpy.pi * R**3) - 1))
        self.assertLess(errors[1], 0.01)
        self.assertLess(errors[1], errors[0] / 3)

    def test_a_block_that_moves_keeps_its_shape_and_its_place(self):
        """The block moves by 3.3 voxels per frame; the lag is less than a twentieth of a voxel."""
        way = 3.3 * R
        surface = skin_of(lambda t: (block(6) + (way * t, 0, 0), range(216)))
        first = at(surface, 0)
        low, size = first.GetBounds()[0], volume_of(first)
        last = at(surface, LAST)
        self.assertAlmostEqual(last.GetBounds()[0] - low, LAST * way, delta=0.05 * R)
        self.assertAlmostEqual(volume_of(last) / size, 1.0, delta=0.005)

    def test_two_particles_merge_and_part(self):
        def pair(t):
            away = abs(t - 2.0) + 0.4
            return numpy.array([[-away, 0, 0], [away, 0, 0]]) + 0.137, [0, 1]

        surface = skin_of(pair, voxel=R / 4)
        at(surface, LAST)
        self.assertEqual(column(surface, "Components"), [2, 2, 1, 2, 2])

    def test_births_and_deaths_are_seen_in_their_frame(self):
        def change(t):
            ids = [0] if t < 2 else [0, 1] if t < 3 else [1]
            return numpy.array([[5.0 * i, 0, 0] for i in ids]), ids

        surface = skin_of(change)
        at(surface, LAST)
        self.assertEqual(column(surface, "Components"), [1, 1, 2, 1, 1])
        self.assertGreater(surface.GetOutput().GetBounds()[0], 3.0)

    def test_an_empty_frame_is_a_frame(self):
        surface = skin_of(lambda t: (block(2)[: 0 if t == 2 else 8], range(0 if t == 2 else 8)))
        self.assertEqual(at(surface, 2).GetNumberOfPoints(), 0)
        self.assertGreater(at(surface, 3).GetNumberOfPoints(), 0)

    def test_a_wall_cuts_the_skin_flat(self):
        wall = 2.0
        surface = skin_of(
            lambda t: (block(6), range(216)),
            ModelBounds=(-5, wall, -5, 5, -5, 5),
            BoundedDomain=True,
        )
        skin = at(surface, LAST)
        self.assertLess(skin.GetBounds()[1], wall + 1e-6)
        x, y, z = points_of(surface).T
        middle = x[(abs(y) < 1.8) & (abs(z) < 1.8) & (x > 1.2)]
        self.assertEqual(len(middle), 7 * 7)  # nodes of the lattice
        self.assertGreater(middle.min(), wall - 0.05 * R)  # a twentieth of a voxel

    def test_the_skin_ends_at_an_obstacle_within_a_body(self):
        """A void around the obstacle: no vertex is deeper in the obstacle than a twentieth of a
        voxel."""
        centre, radius = numpy.full(3, 0.137), 1.6
        obstacle = vtkSphere()
        obstacle.SetCenter(centre)
        obstacle.SetRadius(radius)
        surface = skin_of(lambda t: (block(9), range(729)), ObstacleFunction=obstacle)
        at(surface, LAST)
        away = numpy.linalg.norm(points_of(surface) - centre, axis=1)
        around = away[away < 3.0]
        self.assertGreater(len(around), 100)
        self.assertGreater(around.min(), radius - 0.05 * R)
        self.assertLess(around.max(), radius + 0.2 * R)
        self.assertEqual(column(surface, "Components")[-1], 1)

    def test_an_exact_volume_is_held_through_a_split(self):
        def split(t):
            side = numpy.where(block(5)[:, 0] > 0.1, 1.0, -1.0)
            return block(5) + side[:, None] * (0.8 * t, 0, 0), range(125)

        surface = skin_of(split, VolumeControl=vtkActiveImplicitSurface.EXACT)
        at(surface, LAST)
        volumes = column(surface, "Volume")
        self.assertGreater(column(surface, "Components")[-1], column(surface, "Components")[0])
        self.assertLess(max(abs(v / volumes[0] - 1) for v in volumes), 1e-6)

    def test_particles_at_rest_keep_the_bytes_of_their_skin(self):
        surface = skin_of(lambda t: (block(5), range(125)), steps=40)
        at(surface, 37)
        before = points_of(surface).copy()
        at(surface, 39)
        self.assertTrue(numpy.array_equal(before, points_of(surface)))

    def test_particles_without_ids_may_enter_far_parts_of_the_last_band(self):
        lattice = numpy.indices((5, 5, 5)).reshape(3, -1).T.astype(float)
        surface = skin_of(lambda t: (lattice[: 50 + int(t)] + [1.3 * t, 0, 0], None), steps=2)
        surface.SetInputArrayToProcess(1, 0, 0, 0, "")
        found = []
        for time in (0.0, 1.0):
            surface.UpdateTimeStep(time)
            found.append(
                (points_of(surface.GetOutput()).min(axis=0), volume_of(surface.GetOutput()))
            )
        self.assertLess(abs(found[1][0] - found[0][0] - [1.3, 0, 0]).max(), 0.25 * R)
        self.assertAlmostEqual(found[1][1] / found[0][1], 51 / 50, delta=0.1)

    def test_tension_over_one_frame_without_an_attraction(self):
        areas = []
        for properties in ({}, {"Tension": 0.1}, {"Tension": 0.1, "Attraction": 1.0}):
            surface = vtkActiveImplicitSurface()
            surface.SetInputData(as_particles(block(4)))
            with_properties(surface, {"ParticleSpacing": 2 * R, "Tension": 0.0} | properties)
            surface.Update()
            areas.append(measure(surface.GetOutput())["area"])
        self.assertEqual(areas[1], areas[2])
        self.assertLess(areas[1], areas[0])

    def test_the_first_of_many_frames_tells_of_a_tension_that_it_ignores(self):
        for properties, number in (({}, 1), ({"Attraction": 6}, 0)):
            surface = skin_of(lambda t: (block(3), range(27)), Tension=0.1, **properties)
            heard = Listener(surface)
            surface.UpdateTimeStep(0.0)
            told = [text for text in heard.warnings if "without the given Tension" in text]
            self.assertEqual(len(told), number)

    def test_what_only_substeps_have_is_told(self):
        for properties in (
            {"InvertTarget": True},
            {"CreateParts": False},
            {"VolumeControl": 1},
            {"Attraction": 0.5},
        ):
            surface = skin_of(lambda t: (block(2), range(8)), **properties)
            told = []
            surface.AddObserver("WarningEvent", lambda *_, seen=told: seen.append(1))
            at(surface, 1)
            self.assertTrue(told, properties)


class Bytes(unittest.TestCase):
    def points(self, steps, **properties):
        surface = make_surface(**properties)
        for step in steps:
            surface.UpdateTimeStep(step)
        self.assertGreater(len(points_of(surface)), 1000)
        return points_of(surface)

    def assert_same(self, one, other):
        self.assertTrue(numpy.array_equal(one, other))

    def test_threads_and_models(self):
        for model in range(2):
            self.assert_same(
                self.points([LAST], NumberOfThreads=1, ParticleModel=model),
                self.points([LAST], NumberOfThreads=2, ParticleModel=model),
            )

    def test_order_of_requests(self):
        self.assert_same(self.points([LAST]), self.points([2, 2.4, 3, 1, 3.7, LAST]))

    def test_restart(self):
        with tempfile.TemporaryDirectory() as folder:
            file = str(Path(folder) / "state.vdb")
            first = make_surface()
            first.UpdateTimeStep(3)
            self.assertTrue(first.SaveState(file))
            second = make_surface()
            second.LoadState(file)
            second.UpdateTimeStep(LAST)
            self.assert_same(self.points([LAST]), points_of(second))

    def test_a_frame_alone_is_the_first_of_many(self):
        def frame(t):
            return block(4) + (0.3 * t, 0, 0), range(64)

        alone, many = skin_of(frame, steps=1), skin_of(frame)
        at(alone, 0)
        at(many, 0)
        self.assert_same(points_of(alone), points_of(many))
        first = points_of(alone).copy()
        at(alone, 1)
        self.assert_same(first, points_of(alone))  # static particles

    def test_instruction_sets(self):
        program = (
            "import hashlib, test_nodes as t, unittest;"
            "p = t.Bytes().points([4]); print(hashlib.sha256(p.tobytes()).hexdigest())"
        )
        told = {
            subprocess.run(
                [sys.executable, "-c", program],
                env={**os.environ, "ACTIVE_INSTRUCTION_SET": name},
                cwd=Path(__file__).parent,
                capture_output=True,
                check=True,
                text=True,
            ).stdout
            for name in ("sse2", "avx2", "avx512")
        }
        self.assertEqual(len(told), 1)


if __name__ == "__main__":
    unittest.main()
