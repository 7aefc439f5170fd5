# ctest: LABELS exact
"""ObstacleFunction: the skin ends on the obstacle, closed, for every kind of motion.

Run: python3 test_obstacle.py
"""

import math
import re
import tempfile
import unittest
from pathlib import Path

import numpy
from active_implicit_surfaces import vtkActiveImplicitSurface
from listener import Listener
from same_bytes_shapes import ball
from scenes import splash
from shapes import ball_mesh, bytes_of, make_points, points_of, with_properties
from skin_checks import is_closed
from vtkmodules.vtkCommonDataModel import (
    vtkImplicitBoolean,
    vtkPlane,
    vtkQuadric,
)
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkTriangleFilter
from vtkmodules.vtkImagingHybrid import vtkSampleFunction

VOXEL = 0.05
RADIUS = 0.6
HEIGHT = -0.22  # of the ground, above the obstacle


def ground(height=HEIGHT, normal=(0.0, 1.0, 0.0)):
    """Plane function, negative below."""
    plane = vtkPlane()
    plane.SetOrigin(0.0, height, 0.0)
    plane.SetNormal(normal)
    return plane


def make_surface(obstacle, **properties):
    surface = vtkActiveImplicitSurface()
    surface.SetModelBounds(-1, 1, -1, 1, -1, 1)
    surface.SetVoxelSize(VOXEL)
    surface.SetObstacleFunction(obstacle)
    return with_properties(surface, properties)


def last(surface, column):
    history = surface.GetHistory()
    return history.GetValueByName(history.GetNumberOfRows() - 1, column).ToDouble()


def cap_volume(radius, cut):
    """Volume of a ball about the origin, above a plane at this height."""
    height = radius - cut
    return math.pi * height * height * (3 * radius - height) / 3


class TheSkinEndsOnIt(unittest.TestCase):
    def assert_sound(self, surface, depth):
        self.assertTrue(is_closed(surface.GetOutput()))
        self.assertGreaterEqual(points_of(surface)[:, 1].min(), HEIGHT - depth)

    def assert_is_cap(self, surface):
        """A plane is exact between nodes, so that the skin is beyond the plane only by rounding.
        Chords of the lattice and of the mesh remove 0.2 % of the volume each, and triangles that
        are cut off along the rim up to 0.6 %."""
        self.assert_sound(surface, 1e-5)
        expected = cap_volume(RADIUS, HEIGHT)
        self.assertAlmostEqual(last(surface, "Volume") / expected, 1.0, delta=0.01)

    def test_a_ball_grows_to_a_cap(self):
        surface = make_surface(ground(), Attraction=4, TimeStepSize=1)
        surface.SetInitialFunction(ball(0.2, (0, 0.2, 0)))
        surface.SetTargetFunction(ball(RADIUS))
        surface.UpdateTimeStep(6.0)
        self.assert_is_cap(surface)
        # MaxSpeed excludes the pull into the ground. What remains is the speed at the rim, which is
        # within a voxel of its final position.
        self.assertLess(last(surface, "MaxSpeed"), 4 * VOXEL)

    def test_every_kind_of_input_starts_as_a_cap(self):
        source, samples, mesh = ball_mesh(RADIUS, 96), vtkSampleFunction(), vtkTriangleFilter()
        mesh.SetInputConnection(source.GetOutputPort())
        samples.SetImplicitFunction(ball(RADIUS))
        samples.SetModelBounds(-1, 1, -1, 1, -1, 1)
        for port in (mesh.GetOutputPort(), samples.GetOutputPort(), None):
            surface = make_surface(ground(), Attraction=4, TimeStepSize=1)
            if port:
                surface.SetInputConnection(port)
            else:
                surface.SetTargetFunction(ball(RADIUS))
            for time in (0.0, 3.0):
                surface.UpdateTimeStep(time)
                self.assert_is_cap(surface)

    def test_a_round_one_is_entered_by_a_chord_at_most(self):
        """Distances F / |grad F| = (r^2 - R^2) / 2r have second derivatives of up to 2 / R
        beside the surface, so that between nodes they are linear to h^2 / 4R."""
        radius = 0.4
        surface = make_surface(ball(radius, (0.013, -0.4, 0.02)), Attraction=4, TimeStepSize=1)
        surface.SetInitialFunction(ball(0.2, (0, 0.5, 0)))
        surface.SetTargetFunction(ball(0.8))
        surface.UpdateTimeStep(4.0)
        self.assertTrue(is_closed(surface.GetOutput()))
        distances = numpy.linalg.norm(points_of(surface) - (0.013, -0.4, 0.02), axis=1)
        self.assertGreater(distances.min(), radius - VOXEL * VOXEL / (4 * radius) - 1e-5)
        self.assertLess(distances.min(), radius + VOXEL, "it touches it")

    def test_tension_does_not_creep_through(self):
        for properties in ({}, {"PaperScheme": 1}, {"VolumeControl": 1}, {"AreaControl": 1}):
            with self.subTest(**properties):
                surface = make_surface(ground(), Attraction=0, Tension=0.05, **properties)
                surface.SetInitialFunction(ball(RADIUS))
                surface.SetTargetFunction(ball(RADIUS))
                for step in range(11):
                    surface.UpdateTimeStep(0.1 * step)
                    self.assert_sound(surface, 1e-5)

    def test_the_volume_is_exact(self):
        surface = make_surface(ground(), Attraction=0, Tension=0.02, VolumeControl=2)
        surface.SetInitialFunction(ball(RADIUS))
        surface.SetTargetFunction(ball(RADIUS))
        surface.UpdateTimeStep(0.0)
        volume = last(surface, "Volume")
        for step in range(1, 11):
            surface.UpdateTimeStep(0.1 * step)
            self.assertAlmostEqual(last(surface, "Volume") / volume, 1.0, delta=1e-6)
            self.assert_sound(surface, 1e-5)

    def test_walls_hold_too(self):
        surface = make_surface(ground(), Attraction=4, TimeStepSize=1, BoundedDomain=1)
        surface.SetModelBounds(-1, 0.3, -1, 1, -1, 1)
        surface.SetTargetFunction(ball(RADIUS))
        for time in (0.0, 3.0):
            surface.UpdateTimeStep(time)
            self.assert_sound(surface, 1e-5)
            self.assertLess(points_of(surface)[:, 0].max(), 0.3 + 1e-5)
            self.assertLess(last(surface, "Volume"), 0.95 * cap_volume(RADIUS, HEIGHT))

    def test_neither_of_two_is_entered(self):
        both = vtkImplicitBoolean()
        both.SetOperationTypeToUnion()
        both.AddFunction(ground())
        both.AddFunction(ground(-0.3, (0.0, -1.0, 0.0)))
        both.GetFunction().GetItemAsObject(1).SetOrigin(0.0, 0.3, 0.0)
        surface = make_surface(both, Attraction=4)
        surface.SetTargetFunction(ball(RADIUS))
        surface.UpdateTimeStep(1.0)
        self.assert_sound(surface, 1e-5)
        self.assertLess(points_of(surface)[:, 1].max(), 0.3 + 1e-5)


class OverParticles(unittest.TestCase):
    def test_the_start_and_new_parts_are_outside_of_it(self):
        """The rock lies where the drop of the splash falls. A chord of the rock is the tolerance,
        h^2 / 4R."""
        rock, radius = ball(0.25, (0.0, 0.05, 0.0)), 0.25
        _, surface = splash()
        surface.SetObstacleFunction(rock)
        for step in range(0, 41, 4):
            surface.UpdateTimeStep(step)
            self.assertTrue(is_closed(surface.GetOutput()))
            distances = numpy.linalg.norm(points_of(surface) - (0.0, 0.05, 0.0), axis=1)
            self.assertGreater(distances.min(), radius - 0.03 * 0.03 / (4 * radius) - 1e-5)

    def test_a_particle_inside_has_no_part_and_is_not_lost(self):
        places = [(0.2 * i, 0.2 * j, 0.2 * k) for i in range(4) for j in range(4) for k in range(4)]
        surface = make_surface(ball(0.5, (3.0, 0.0, 0.0)), ParticleSpacing=0.2)
        surface.SetModelBounds(-1, 5, -1, 1, -1, 1)
        surface.SetInputDataObject(make_points([*places, (3.0, 0.0, 0.0), (3.1, 0.1, 0.0)]))
        surface.SetInitialFunction(ball(0.3, (0.3, 0.3, 0.3)))
        surface.SetTimeStepSize(1.0)
        surface.SetAttraction(4.0)
        surface.UpdateTimeStep(3.0)
        self.assertEqual(last(surface, "Components"), 1)
        self.assertLess(points_of(surface)[:, 0].max(), 1.0)
        self.assertEqual(last(surface, "Outside"), 0.0)


class ItIsPartOfTheMotion(unittest.TestCase):
    def make(self, obstacle):
        surface = make_surface(obstacle, Attraction=4, Tension=0.01, CheckpointInterval=3)
        surface.SetInitialFunction(ball(0.3, (0, 0.2, 0)))
        surface.SetTargetFunction(ball(RADIUS))
        return surface

    def at(self, time, obstacle=None, **properties):
        surface = self.make(obstacle or ground())
        for name, value in properties.items():
            getattr(surface, f"Set{name}")(value)
        surface.UpdateTimeStep(time)
        return bytes_of(surface)

    def test_threads_and_order_leave_no_trace(self):
        expected = self.at(0.7, NumberOfThreads=1)
        self.assertEqual(self.at(0.7, NumberOfThreads=2), expected)
        turned = ground()  # functions with a transform are evaluated by one thread
        turned.SetTransform(vtkTransform())
        self.assertEqual(self.at(0.7, turned), expected)
        surface = self.make(ground())
        for time in (1.0, 0.25, 0.7, 0.4, 0.7):
            surface.UpdateTimeStep(time)
        self.assertEqual(bytes_of(surface), expected)

    def test_a_state_goes_on(self):
        with tempfile.TemporaryDirectory() as folder:
            file = str(Path(folder) / "state.vdb")
            first, second = self.make(ground()), self.make(ground())
            first.UpdateTimeStep(0.4)
            self.assertTrue(first.SaveState(file))
            second.LoadState(file)
            second.UpdateTimeStep(0.7)
            self.assertEqual(bytes_of(second), self.at(0.7))

    def test_a_change_restarts(self):
        plane = ground()
        surface = self.make(plane)
        surface.UpdateTimeStep(0.7)
        plane.SetOrigin(0.0, -0.1, 0.0)
        surface.UpdateTimeStep(0.7)
        self.assertEqual(bytes_of(surface), self.at(0.7, ground(-0.1)))
        lifted, transform = ground(), vtkTransform()
        lifted.SetTransform(transform)
        surface.SetObstacleFunction(lifted)
        surface.UpdateTimeStep(0.7)
        transform.Translate(0.0, -0.12, 0.0)  # of the evaluated point
        surface.UpdateTimeStep(0.7)
        self.assertGreater(points_of(surface)[:, 1].min(), -0.1 - 1e-5)
        surface.SetObstacleFunction(None)
        surface.UpdateTimeStep(0.7)
        self.assertLess(points_of(surface)[:, 1].min(), -0.4)


class WhatCannotBe(unittest.TestCase):
    def test_one_that_covers_all_leaves_nothing(self):
        surface = make_surface(ground(2.0))
        surface.SetTargetFunction(ball(RADIUS))
        messages = Listener(surface)
        surface.UpdateTimeStep(0.5)
        self.assertEqual(surface.GetOutput().GetNumberOfPoints(), 0)
        self.assertEqual(len(messages.warnings), 1)
        self.assertIn("The obstacle covers the initial shape", messages.warnings[0])
        self.assertEqual(messages.errors, [])

    def test_one_that_is_not_a_number_is_an_error(self):
        nowhere = vtkQuadric()
        nowhere.SetCoefficients([math.nan] * 10)
        surface = make_surface(nowhere)
        surface.SetTargetFunction(ball(RADIUS))
        messages = Listener(surface)
        surface.UpdateTimeStep(0.5)
        self.assertEqual(surface.GetOutput().GetNumberOfPoints(), 0)
        self.assertIn("ObstacleFunction is not a number at a point within", messages.errors[0])
        surface.SetObstacleFunction(ground())
        surface.UpdateTimeStep(0.5)
        self.assertGreater(surface.GetOutput().GetNumberOfPoints(), 0)

    def test_an_error_names_the_position_in_the_world(self):
        nowhere = vtkQuadric()
        nowhere.SetCoefficients([math.nan] * 10)
        surface = make_surface(nowhere, ModelBounds=(1e5 - 1, 1e5 + 1, -1, 1, -1, 1))
        surface.SetTargetFunction(ball(RADIUS, center=(1e5, 0, 0)))
        messages = Listener(surface)
        surface.UpdateTimeStep(0.5)
        found = re.search(r"within 0.35 of \(([^,]*), ([^,]*), ([^,]*)\)", messages.errors[0])
        self.assertLess(abs(float(found[1]) - 1e5), 2)


if __name__ == "__main__":
    unittest.main()
