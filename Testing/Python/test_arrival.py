# ctest: LABELS exact
"""ArrivalTime: the skin reaches the target at a given time, for every kind of target, from any
start.

Run: python3 test_arrival.py
"""

import tempfile
import unittest
from pathlib import Path

import numpy
from active_implicit_surfaces import vtkActiveImplicitSurface
from listener import Listener
from same_bytes_shapes import ball
from scenes import splash
from shapes import ball_mesh, make_points, points_of, with_properties
from skin_checks import is_closed
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkImagingHybrid import vtkSampleFunction

VOXEL = 0.05
ARRIVAL = 2.0
FAR = (0.5, 0.03, -0.02)


def make_surface(**properties):
    surface = vtkActiveImplicitSurface()
    surface.SetModelBounds(-1, 1, -1, 1, -1, 1)
    surface.SetVoxelSize(VOXEL)
    surface.SetInitialFunction(ball(0.3, (-0.5, 0.01, 0.02)))
    surface.SetArrivalTime(ARRIVAL)
    surface.SetTimeStepSize(0.5)
    surface.SetNumberOfTimeSteps(9)
    return with_properties(surface, properties)


def image_of_ball(radius, center):
    samples = vtkSampleFunction()
    samples.SetImplicitFunction(ball(radius, center))
    samples.SetModelBounds(-1, 1, -1, 1, -1, 1)
    samples.SetSampleDimensions(41, 41, 41)
    return samples


def bytes_at(surface, *times):
    for time in times:
        surface.UpdateTimeStep(time)
    return points_of(surface).tobytes()


class ItArrives(unittest.TestCase):
    def assert_is_ball(self, surface, radius, slack):
        self.assertTrue(is_closed(surface.GetOutput()))
        radii = numpy.linalg.norm(points_of(surface) - FAR, axis=1)
        self.assertLess(numpy.abs(radii - radius).max(), slack)

    def test_at_every_kind_of_target_that_the_skin_does_not_meet(self):
        """The tolerance is a tenth of a voxel, plus h^2 / 8R, 0.02 voxel, for chords of the mesh
        and of the image's cells."""
        for integration in (0, 1):
            for source in (ball_mesh(0.35, 96, FAR), image_of_ball(0.35, FAR), None):
                surface = make_surface(TimeIntegration=integration)
                if source:
                    surface.SetInputConnection(source.GetOutputPort())
                else:
                    surface.SetTargetFunction(ball(0.35, FAR))
                said = Listener(surface)
                for time in (1.0, 2.0):
                    surface.UpdateTimeStep(time)
                    self.assertEqual(said.errors + said.warnings, [])
                    self.assertTrue(is_closed(surface.GetOutput()))
                self.assert_is_ball(surface, 0.35, 0.12 * VOXEL)
                surface.UpdateTimeStep(4.0)
                self.assert_is_ball(surface, 0.35, 0.12 * VOXEL)

    def test_at_particles_that_stand_still(self):
        """An isolated particle is a ball of its own radius, half of the spacing."""
        surface = make_surface(ParticleSpacing=0.6)
        surface.SetInputData(make_points([FAR]))
        surface.UpdateTimeStep(ARRIVAL)
        self.assert_is_ball(surface, 0.3, 0.02 * 0.3 + 0.1 * VOXEL)

    def test_from_nothing(self):
        surface = make_surface(InitialFunction=ball(0.001, (0.9, 0.9, 0.9)))
        surface.SetTargetFunction(ball(0.35, FAR))
        surface.UpdateTimeStep(ARRIVAL)
        self.assert_is_ball(surface, 0.35, 0.1 * VOXEL)

    def test_parts_are_not_created_where_they_may_not_be(self):
        surface = make_surface(CreateParts=0)
        surface.SetTargetFunction(ball(0.35, FAR))
        surface.UpdateTimeStep(ARRIVAL)
        self.assertEqual(surface.GetOutput().GetNumberOfPoints(), 0)

    def test_the_time_is_that_of_the_pipeline(self):
        """The interval begins at the first step, whatever the unit of the motion's own time."""
        for scale in (0.04, 25.0):
            surface = make_surface(StartTime=-7.0, TimeScale=scale)
            surface.SetTargetFunction(ball(0.35, FAR))
            surface.UpdateTimeStep(-7.0 + ARRIVAL)
            self.assert_is_ball(surface, 0.35, 0.1 * VOXEL)
            surface.UpdateTimeStep(-7.0 + ARRIVAL / 2)
            points = points_of(surface)
            radii = numpy.linalg.norm(points[points[:, 0] > 0] - FAR, axis=1)
            core = 2.5 * VOXEL
            self.assertAlmostEqual(radii.mean(), (core + 0.35) / 2, delta=VOXEL)

    def test_the_velocity_is_what_is_left_over_the_time_that_is_left(self):
        """Distances are accurate to a voxel."""
        surface = make_surface(InitialFunction=ball(0.3), ComputeVelocity=1)
        surface.SetTargetFunction(ball(0.6))
        surface.UpdateTimeStep(0.0)
        velocity = vtk_to_numpy(surface.GetOutput().GetPointData().GetArray("Velocity"))
        speeds = numpy.linalg.norm(velocity, axis=1)
        self.assertLess(numpy.abs(speeds - 0.3 / ARRIVAL).max(), VOXEL / ARRIVAL)


class TheSameBytes(unittest.TestCase):
    def make(self):
        surface = make_surface()
        surface.SetTargetFunction(ball(0.35, FAR))
        return surface

    def test_in_any_order_of_requests(self):
        straight = bytes_at(self.make(), 0.0, 0.5, 1.0, 1.5)
        self.assertEqual(bytes_at(self.make(), 1.5), straight)
        self.assertEqual(bytes_at(self.make(), 0.2, 2.0, 0.7, 1.5), straight)
        self.assertEqual(bytes_at(self.make(), 1.25), bytes_at(self.make(), 0.1, 1.25))

    def test_after_an_abort_anywhere(self):
        straight = bytes_at(self.make(), 1.0)
        for patience in (0, 1, 2, 5):
            surface = self.make()
            calls = []

            def stop(caller, event, surface=surface, calls=calls, patience=patience):
                calls.append(1)
                surface.SetAbortExecute(len(calls) == patience + 1)

            surface.AddObserver("ProgressEvent", stop)
            surface.UpdateTimeStep(1.0)
            surface.RemoveAllObservers()
            surface.SetAbortExecute(0)
            surface.Modified()
            self.assertEqual(bytes_at(surface, 1.0), straight, f"after {patience} calls")

    def test_after_a_restart(self):
        with tempfile.TemporaryDirectory() as folder:
            state = str(Path(folder) / "state.vdb")
            first = self.make()
            first.UpdateTimeStep(1.0)
            self.assertTrue(first.SaveState(state))
            second = self.make()
            self.assertTrue(second.LoadState(state))
            self.assertEqual(bytes_at(second, 1.5), bytes_at(first, 1.5))


class WhatIsRefused(unittest.TestCase):
    def assert_refused(self, surface, words):
        said = Listener(surface)
        surface.Update()
        self.assertEqual(len(said.errors), 1, said.errors)
        self.assertIn(words, said.errors[0])
        self.assertEqual(surface.GetOutput().GetNumberOfPoints(), 0)

    def test_a_target_that_moves(self):
        _, surface = splash()
        surface.SetArrivalTime(3.0)
        self.assert_refused(surface, "ArrivalTime needs a target that stands still")

    def test_what_is_no_distance(self):
        for name, value in (("NormalizeTarget", 0), ("PaperScheme", 1)):
            surface = make_surface(**{name: value})
            surface.SetTargetFunction(ball(0.35, FAR))
            self.assert_refused(surface, "ArrivalTime needs distances")

    def test_a_time_beyond_all_numbers(self):
        surface = make_surface(ArrivalTime=1e300, TimeScale=1e10)
        surface.SetTargetFunction(ball(0.35, FAR))
        self.assert_refused(surface, "has to be finite")

    def test_at_rest_there_is_no_time(self):
        """EQUILIBRIUM ignores ArrivalTime."""
        surface = make_surface(EvolutionMode=1, InitialFunction=ball(0.3, FAR))
        surface.SetTargetFunction(ball(0.35, FAR))
        said = Listener(surface)
        surface.Update()
        self.assertEqual(said.errors, [])
        radii = numpy.linalg.norm(points_of(surface) - FAR, axis=1)
        self.assertLess(numpy.abs(radii - 0.35).max(), 0.1 * VOXEL)


if __name__ == "__main__":
    unittest.main()
