# ctest: LABELS contract
"""Values of vtkActiveImplicitSurface's properties: defaults, clamped values, refused values.

Run: python3 test_property_values.py
"""

import math
import unittest

from active_implicit_surfaces import vtkActiveImplicitSurface, vtkSkeletonPotential
from listener import Listener
from test_filter import make_shrinking_ball
from vtkmodules.vtkCommonDataModel import vtkPolyData

UNSET_BOUNDS = (1.0, -1.0, 1.0, -1.0, 1.0, -1.0)
DEFAULTS = {
    "TargetFunction": None,
    "InitialFunction": None,
    "ObstacleFunction": None,
    "TargetIsoValue": 0.0,
    "InvertTarget": 0,
    "NormalizeTarget": 1,
    "TargetReach": 0.0,
    "VoxelSize": 0.0,
    "ModelBounds": UNSET_BOUNDS,
    "Attraction": 1.0,
    "Tension": 0.0,
    "CFL": 1.0,
    "StartTime": 0.0,
    "TimeStepSize": 0.1,
    "NumberOfTimeSteps": 11,
    "TimeScale": 1.0,
    "ArrivalTime": 0.0,
    "AutomaticAttraction": 1,
    "AutomaticSmoothing": 1,
    "TargetNoise": 0.0,
    "TimeIntegration": 1,  # AUTOMATIC
    "CreateParts": 1,
    "TensionWeighting": 1,
    "Transport": 1.0,
    "ParticleModel": 1,  # vtkSkeletonPotential.ANISOTROPIC
    "ParticleSpacing": 0.0,
    "KernelRadius": 0.0,
    "Anisotropy": 4.0,
    "ParticleKernel": 0,  # vtkSkeletonPotential.WYVILL
    "ParticleThreshold": 0.5,
    "PeriodicBounds": (1.0, -1.0, 1.0, -1.0, 1.0, -1.0),
    "MeshThickness": 0.0,
    "ComputeNormals": 1,
    "OutputPotential": 0,
    "MaximumNumberOfActiveVoxels": 50000000,
    "NumberOfThreads": 0,
}
# Results of clamping values out of range: (property, value, result).
CLAMPED = [
    ("VoxelSize", -1.0, 0.0),
    ("TargetReach", -1.0, 0.0),
    ("Attraction", -1.0, 0.0),
    ("Tension", -1.0, 0.0),
    ("TargetNoise", -1.0, 0.0),
    ("TimeIntegration", 4, vtkActiveImplicitSurface.AUTOMATIC),
    ("ArrivalTime", -1.0, 0.0),
    ("KernelRadius", -1.0, 0.0),
    ("ParticleSpacing", -1.0, 0.0),
    ("Transport", -1.0, 0.0),
    ("Transport", 2.0, 1.0),
    ("Anisotropy", 0.5, 1.0),
    ("Anisotropy", 1000.0, 100.0),
    ("ParticleModel", 3, vtkSkeletonPotential.ANISOTROPIC),
    ("MeshThickness", -1.0, 0.0),
    ("ParticleKernel", 7, vtkSkeletonPotential.METABALL),
    ("NumberOfTimeSteps", 0, 1),
    ("NumberOfThreads", -3, 0),
    ("MaximumNumberOfActiveVoxels", 0, 1),
]
# Values that are refused.
REFUSED = [
    ("VoxelSize", math.nan),
    ("TargetReach", math.nan),
    ("TargetIsoValue", math.inf),
    ("ModelBounds", (0, 1, 2, -2, 0, 1)),
    ("ModelBounds", (0, 1, 0, math.inf, 0, 1)),
    ("ModelBounds", (0, 0, 0, 0, 0, 0)),
    ("Attraction", math.nan),
    ("Tension", math.nan),
    ("TargetNoise", math.nan),
    ("CFL", 0.0),
    ("CFL", math.nan),
    ("TimeStepSize", 0.0),
    ("TimeStepSize", math.nan),
    ("StartTime", -math.inf),
    ("TimeScale", 0.0),
    ("ArrivalTime", math.nan),
    ("KernelRadius", math.nan),
    ("ParticleSpacing", math.nan),
    ("Transport", math.nan),
    ("Anisotropy", math.nan),
    ("ParticleThreshold", math.inf),
    ("ParticleThreshold", 0.0),
    ("ParticleThreshold", -0.5),
    ("MeshThickness", math.nan),
    ("PeriodicBounds", (0, 1, 0, math.inf, 0, 1)),
    ("PeriodicBounds", (math.nan, 1, 1, -1, 1, -1)),
]


class Properties(unittest.TestCase):
    def test_defaults(self):
        surface = vtkActiveImplicitSurface()
        for name, default in DEFAULTS.items():
            with self.subTest(name):
                self.assertEqual(getattr(surface, "Get" + name)(), default)

    def test_what_is_set_is_got(self):
        surface = vtkActiveImplicitSurface()
        for name, default in DEFAULTS.items():
            if isinstance(default, (int, float)):
                with self.subTest(name):
                    value = 1 if default == 0 else default / 2 if default <= 1 else 2
                    getattr(surface, "Set" + name)(type(default)(value))
                    self.assertEqual(getattr(surface, "Get" + name)(), type(default)(value))

    def test_what_can_be_mended_is(self):
        surface = vtkActiveImplicitSurface()
        for name, value, mended in CLAMPED:
            with self.subTest(name):
                getattr(surface, "Set" + name)(value)
                self.assertEqual(getattr(surface, "Get" + name)(), mended)

    def test_what_cannot_be_mended_is_an_error_that_names_it(self):
        for name, value in REFUSED:
            with self.subTest(name, value=value):
                surface = make_shrinking_ball()
                getattr(surface, "Set" + name)(value)
                listener = Listener(surface)
                surface.UpdateTimeStep(0.3)
                self.assertEqual(len(listener.errors), 1)
                self.assertIn(name, listener.errors[0])
                self.assertEqual(surface.GetOutput().GetNumberOfPoints(), 0)

    def test_wrong_types_are_type_errors(self):
        surface = vtkActiveImplicitSurface()
        for wrong in ("ball", 3, vtkPolyData()):
            with self.assertRaises(TypeError):
                surface.SetTargetFunction(wrong)
        with self.assertRaises(TypeError):
            surface.SetVoxelSize("small")
        with self.assertRaises(TypeError):
            surface.SetModelBounds(0, 1)

    def test_printing_names_every_property(self):
        text = str(vtkActiveImplicitSurface())
        for name in DEFAULTS:
            with self.subTest(name):
                self.assertIn(name + ":", text)


if __name__ == "__main__":
    unittest.main()
