"""Implicit functions in ParaView: as targets, as starting shapes, in Clip; also moved during an
animation."""

import unittest

from paraview.simple import (
    ActiveImplicitSurfaceFunctions,
    Clip,
    OutputPort,
    PolyLineSource,
    ResetSession,
    Sphere,
    Wavelet,
)
from scenes import skin_bytes

OFFERED = [
    "Sphere",
    "Box",
    "Plane",
    "Cylinder",
    "Superquadric",
    "Skeleton Potential",
    "Image or Mesh",
]


def ball(**properties):
    return ActiveImplicitSurfaceFunctions(**({"VoxelSize": 0.1, "Attraction": 4} | properties))


def bounds_of(surface, time):
    surface.UpdatePipeline(time)
    return surface.GetDataInformation(0).GetBounds()


class Functions(unittest.TestCase):
    def setUp(self):
        ResetSession()

    def test_each_function_offered_is_a_target(self):
        surface = ball()
        available = surface.GetProperty("TargetFunction").GetAvailable()
        self.assertEqual(
            [name.replace(" ", "") for name in available],  # ParaView 5.13 omits spaces
            [name.replace(" ", "") for name in OFFERED],
        )
        inputs = {"Skeleton Potential": PolyLineSource(), "Image or Mesh": Sphere(Radius=0.6)}
        skins = set()
        for name in OFFERED:
            surface.TargetFunction = name
            if name in inputs:
                surface.TargetFunction.Input = inputs[name]
            skins.add(skin_bytes(surface, 0.2)[0])
        self.assertEqual(len(skins), len(OFFERED))

    # F = r^2 - R^2 of vtkSphere has the first-order distance (r^2 - R^2) / 2r. F decreases by
    # exp(-4 t), to r = 0.5845. Linear interpolation is off by h^2 / 8r = 0.003, substeps of
    # CFL / 4 = 0.0125 by half of a substep's displacement, 0.0125 * 4 * 0.13 / 2 = 0.003.
    def test_a_small_ball_grows_towards_a_larger_one(self):
        surface = ball(InitialFunction="Sphere", CFL=0.05)
        surface.InitialFunction.Radius = 0.4
        surface.TargetFunction.Radius = 0.7
        self.assertAlmostEqual(bounds_of(surface, 0)[1], 0.4, delta=0.005)
        self.assertAlmostEqual(bounds_of(surface, 0.2)[1], 0.5845, delta=0.006)

    def test_a_function_that_moves_leaves_no_stale_skin(self):
        surface, fresh = ball(), ball()
        skin_bytes(surface, 0.3)
        surface.TargetFunction.Center = fresh.TargetFunction.Center = [0.2, 0, 0]
        self.assertEqual(skin_bytes(surface, 0.3), skin_bytes(fresh, 0.3))

    def test_a_skeleton_that_moves_leaves_no_stale_skin(self):
        line = PolyLineSource(Points=[-0.4, 0, 0, 0.4, 0, 0])
        surface = ball(TargetFunction="Skeleton Potential")
        surface.TargetFunction.Input = line
        before = skin_bytes(surface, 0.3)
        line.Points = [-0.4, 0, 0, 0.4, 0.3, 0]
        after = skin_bytes(surface, 0.3)
        self.assertNotEqual(before, after)
        fresh = ball(TargetFunction="Skeleton Potential")
        fresh.TargetFunction.Input = line
        self.assertEqual(skin_bytes(fresh, 0.3), after)

    # The surface is at 0.4542 of the kernel radius from the line, also beyond the line's ends.
    def test_clip_cuts_along_a_skeleton(self):
        clip = Clip(Input=Wavelet(), ClipType="Skeleton Potential")
        clip.ClipType.Input = PolyLineSource(Points=[-5, 0, 0, 5, 0, 0])
        clip.ClipType.Radius = 10
        clip.UpdatePipeline()
        self.assertAlmostEqual(clip.GetDataInformation().GetBounds()[1], 5 + 4.542, delta=0.1)

    def test_the_potential_of_one_surface_is_the_target_of_another(self):
        first = ball()
        second = ball(TargetFunction="Image or Mesh")
        second.TargetFunction.Input = OutputPort(first, 1)
        self.assertAlmostEqual(bounds_of(second, 0)[1], bounds_of(first, 0)[1], delta=0.01)


if __name__ == "__main__":
    unittest.main()
