"""Time in ParaView: the time keeper, playing, scrubbing, and property changes during the motion."""

import sys
import unittest
from pathlib import Path

import active_implicit_surfaces
import numpy
from paraview import servermanager
from paraview.simple import (
    ActiveImplicitSurface,
    Calculator,
    Delete,
    GetAnimationScene,
    GetTimeKeeper,
    PointSource,
    ResetSession,
    Sphere,
    Wavelet,
)
from scenes import IN_USE, skin_bytes, splash
from vtkmodules.util.numpy_support import vtk_to_numpy

sys.path.append(str(Path(__file__).resolve().parents[1] / "Python"))
from properties import needed_values, other_values, rows_of  # noqa: E402

ROWS = rows_of(active_implicit_surfaces.vtkActiveImplicitSurface)
# A second value of each property, by rules or from this list.
OTHER_VALUES = {name: values[0] for name, row in ROWS.items() if (values := other_values(row))} | {
    "Anisotropy": 1,
    "Attraction": 40,
    "IdArray": ["POINTS", "id"],
    "InitialArray": ["POINTS", "RTData"],
    "InitialFunction": "Sphere",
    "KernelRadius": 0.2,
    "MaximumNumberOfSubsteps": 10,
    "ModelBounds": [-1, 2, -1, 3, -1, 2],
    "ObstacleFunction": "Plane",
    "ParticleSpacing": 0.07,
    "PeriodicBounds": [-1, 2, -1, 3, 1, -1],
    "RadiusArray": ["POINTS", "id"],
    "RestTolerance": 1,
    "StrengthArray": ["POINTS", "id"],
    "TargetArea": 2,
    "TargetArray": ["POINTS", "id"],
    "TargetVolume": 2,
    "TimeScale": 1 / 50,
    "VelocityArray": ["POINTS", "id"],
    "VoxelSize": 0.1,
}
# Inputs, read-only properties, and properties without a valid second value over these particles.
NOT_CHANGED = {"Input", "Initial", "TimestepValues", "ArrivalTime"} | set(IN_USE)
del OTHER_VALUES["ArrivalTime"]
# Properties whose second value leaves the skin at time 2 as it is.
WITHOUT_EFFECT = set(
    """
    BoundedDomain CFL CheckpointInterval CheckpointMemory
    MaximumNumberOfActiveVoxels MeshThickness ModelBounds NumberOfThreads NumberOfTimeSteps
    OutputPotential ParticleKernel StartTime TargetReach TimeStepSize
    VelocityArray
""".split()
)
WITHOUT_SKIN = {"InvertTarget", "RadiusArray", "StrengthArray", "TargetArray", "InitialArray"}


class Time(unittest.TestCase):
    def setUp(self):
        ResetSession()

    def test_the_time_keeper_has_the_steps_of_the_particles(self):
        surface, _ = splash()
        self.assertEqual(list(surface.TimestepValues), [float(i) for i in range(41)])
        self.assertEqual(list(GetTimeKeeper().TimestepValues), list(surface.TimestepValues))

    def test_the_time_keeper_has_the_steps_of_a_surface_without_any_in_its_input(self):
        surface = ActiveImplicitSurface(Input=Sphere(), NumberOfTimeSteps=4, TimeStepSize=0.5)
        self.assertEqual(list(surface.TimestepValues), [0, 0.5, 1, 1.5])
        surface.NumberOfTimeSteps = 2
        surface.UpdatePipelineInformation()
        self.assertEqual(list(GetTimeKeeper().TimestepValues), [0, 0.5])

    def test_ten_steps_played_are_those_asked_for_one_by_one(self):
        surface, _ = splash()
        scene = GetAnimationScene()
        scene.UpdateAnimationUsingDataTimeSteps()
        played = []
        for step in range(10):
            scene.AnimationTime = step
            played.append(skin_bytes(surface, step))
        for step in (9, 4):
            fresh, _ = splash()
            self.assertEqual(skin_bytes(fresh, step), played[step], f"step {step}")
        self.assertEqual(len({skin[0] for skin in played}), 10, "each step has its own skin")

    def test_scrubbing_back_and_forth_twenty_times_is_the_same_as_forward(self):
        surface, _ = splash()
        forward = [skin_bytes(surface, step) for step in range(12)]
        places = [(7 * i) % 12 for i in range(20)]
        for step in places:
            self.assertEqual(skin_bytes(surface, step), forward[step], f"step {step}")


class ChangesInMidAnimation(unittest.TestCase):
    def test_every_property_has_another_value_here(self):
        ResetSession()
        surface, _ = splash()
        known = set(OTHER_VALUES) | NOT_CHANGED
        self.assertEqual(sorted(surface.ListProperties()), sorted(known))

    def test_no_change_leaves_stale_output(self):
        ResetSession()
        fresh = {}  # by name, conditions and value; each is made once
        for name in sorted(set(OTHER_VALUES) - WITHOUT_SKIN):
            with self.subTest(name):
                needed = self.needed(name)
                key = str(needed)
                if key not in fresh:
                    fresh[key] = self.fresh_bytes(needed)
                changed, particles = splash(**needed)
                for step in (0, 1, 2):
                    changed.UpdatePipeline(step)
                before = plain_value(changed, name)
                setattr(changed, name, OTHER_VALUES[name])
                expected = self.fresh_bytes(needed | {name: OTHER_VALUES[name]})
                self.assertEqual(skin_bytes(changed, 2), expected)
                self.assertEqual(expected != fresh[key], name not in WITHOUT_EFFECT)
                setattr(changed, name, before)
                self.assertEqual(skin_bytes(changed, 2), fresh[key], "and back")
                Delete(changed)
                Delete(particles)

    @staticmethod
    def fresh_bytes(properties):
        surface, particles = splash(**properties)
        found = skin_bytes(surface, 2)
        Delete(surface)
        Delete(particles)
        return found

    @staticmethod
    def needed(name):
        """Values of properties without which this property has no effect on the skin."""
        more = {
            "RestTolerance": {"EvolutionMode": 1, "MaximumNumberOfSubsteps": 20},
            "MaximumNumberOfSubsteps": {"EvolutionMode": 1, "MaximumNumberOfSubsteps": 20},
            "EvolutionMode": {"MaximumNumberOfSubsteps": 20},
            "PaperScheme": {"Attraction": -1},
            "NormalizeTarget": {"Attraction": -1},
        }
        return (needed_values(ROWS[name]) if name in ROWS else {}) | more.get(name, {})

    def test_the_skin_goes_along_with_the_particles(self):
        ResetSession()
        surface, particles = splash(ComputeVelocity=1)
        wind = numpy.array([3.0, -2.0, 1.0])
        surface.Input = Calculator(
            Input=particles, ResultArrayName="wind", Function="3*iHat - 2*jHat + kHat"
        )
        surface.VelocityArray = ["POINTS", "wind"]
        surface.UpdatePipeline(2)
        data = servermanager.Fetch(surface, idx=0).GetPointData()
        normals, velocities = (vtk_to_numpy(data.GetArray(n)) for n in ("Normals", "Velocity"))
        differences = velocities - wind
        along = numpy.einsum("ij,ij->i", differences, normals)[:, None]
        # Velocities of some ten units, and the normals, have single precision.
        self.assertLess(abs(differences - along * normals).max(), 1e-4)

    def test_another_input_is_another_skin(self):
        ResetSession()
        surface, _ = splash()
        before = skin_bytes(surface, 1)
        points = PointSource(NumberOfPoints=60, Radius=0.3)
        surface.Input = points
        fresh, _ = splash()
        fresh.Input = points
        self.assertEqual(skin_bytes(surface, 0.1), skin_bytes(fresh, 0.1))
        self.assertNotEqual(skin_bytes(surface, 0.1), before)
        points.Radius = 0.5
        self.assertEqual(skin_bytes(surface, 0.1), skin_bytes(fresh, 0.1))

    def test_initial_may_come_and_go(self):
        ResetSession()
        surface, _ = splash(Attraction=-1)
        without = skin_bytes(surface, 1)
        surface.Initial = Sphere(Radius=0.4, Center=[0.5, 0.5, 0.5])
        self.assertNotEqual(skin_bytes(surface, 1), without)
        surface.Initial = None
        self.assertEqual(skin_bytes(surface, 1), without)
        surface.Initial = Wavelet(WholeExtent=[-2, 2, -2, 2, -2, 2])


def plain_value(surface, name):
    """Value of a property in a form that can be set again."""
    value = getattr(surface, name)
    if name in ("InitialFunction", "ObstacleFunction"):
        return "None"
    return value if isinstance(value, (int, float, str)) else list(value)


if __name__ == "__main__":
    unittest.main()
