# ctest: LABELS contract
"""help() documents unit, range and default of every property of the classes correctly."""

import pydoc
import re
import unittest

import active_implicit_surfaces
from active_implicit_surfaces import (
    vtkActiveClockAlgorithm,
    vtkActiveEXRReader,
    vtkActiveEXRWriter,
    vtkActiveImplicitSurface,
    vtkActiveMotionAlgorithm,
    vtkActiveVDBReader,
    vtkActiveVDBWriter,
    vtkGridPotential,
    vtkSkeletonPotential,
)
from properties import comment_of, get, own_properties

# Properties of each class: numbers with a range, some of them with a unit; and others.
NUMBERS = {
    vtkActiveImplicitSurface: """
        TargetIsoValue TargetReach VoxelSize MaximumNumberOfActiveVoxels Attraction Tension CFL
        VolumeStiffness AreaStiffness TargetVolume TargetArea RestTolerance
        MaximumNumberOfSubsteps StartTime TimeStepSize NumberOfTimeSteps TimeScale ArrivalTime
        KernelRadius TargetNoise
        ParticleSpacing Anisotropy Transport ParticleThreshold MeshThickness NumberOfThreads
        CheckpointInterval CheckpointMemory
        MaximumVelocity
    """.split(),
    vtkSkeletonPotential: "Radius Threshold ParticleSpacing Anisotropy".split(),
    vtkGridPotential: "IsoValue VoxelSize Reach MeshThickness MaximumNumberOfVoxels".split(),
    vtkActiveEXRReader: "Part MaximumMemory".split(),
    vtkActiveEXRWriter: "CompressionLevel PixelAspectRatio FramesPerSecond FrameNumber".split(),
    vtkActiveVDBReader: "DownsamplingFactor MaximumNumberOfPoints".split(),
    vtkActiveVDBWriter: ["VoxelSize"],
}
SWITCHES = {
    vtkActiveImplicitSurface: """
        InvertTarget NormalizeTarget BoundedDomain ComputeNormals ComputeVelocity TangentialVelocity
        PassTargetArrays ComputeCurvature OutputPotential PaperScheme AutomaticAttraction
        AutomaticSmoothing CreateParts TensionWeighting
    """.split(),
    vtkSkeletonPotential: [],
    vtkGridPotential: ["InvertInside"],
    vtkActiveEXRReader: [],
    vtkActiveEXRWriter: ["WriteAllTimeSteps"],
    vtkActiveVDBReader: ["OutputDense"],
    vtkActiveVDBWriter: """
        WriteAllTimeSteps WriteState WriteDensity WriteVelocity WritePointArrays HalfFloat
    """.split(),
}
CHOICES = {
    vtkActiveImplicitSurface: """
        VolumeControl AreaControl EvolutionMode TargetEvaluation TimeIntegration GradientScheme
        ParticleKernel
        ParticleModel
    """.split(),
    vtkSkeletonPotential: ["Kernel", "ParticleModel"],
    vtkGridPotential: [],
    vtkActiveEXRReader: ["Window"],
    vtkActiveEXRWriter: "Compression ColorEncoding".split(),
    vtkActiveVDBReader: ["Region"],
    vtkActiveVDBWriter: "GridClass Compression".split(),
}
OTHERS = {
    vtkActiveImplicitSurface: """
        TargetFunction InitialFunction ObstacleFunction ModelBounds PeriodicBounds Controller
    """.split(),
    vtkSkeletonPotential: "Input InputConnection RadiusArrayName StrengthArrayName".split(),
    vtkGridPotential: "Input InputConnection ScalarArrayName".split(),
    vtkActiveEXRReader: [],
    vtkActiveEXRWriter: "DisplaySize TimeCode WorldToCamera WorldToNDC".split(),
    vtkActiveVDBReader: "FileName GridName IndexRegion WorldRegion".split(),
    vtkActiveVDBWriter: "FileName InputData Units Controller".split(),
}
WITH_UNIT = {
    vtkActiveImplicitSurface: """
        TargetIsoValue TargetReach VoxelSize ModelBounds Attraction Tension VolumeStiffness
        AreaStiffness TargetVolume TargetArea RestTolerance StartTime TimeStepSize TimeScale
        ArrivalTime KernelRadius ParticleSpacing MeshThickness CheckpointMemory MaximumVelocity
        PeriodicBounds
        TargetNoise
    """.split(),
    vtkSkeletonPotential: """
        Radius RadiusArrayName StrengthArrayName Threshold ParticleSpacing
    """.split(),
    vtkGridPotential: "IsoValue VoxelSize Reach MeshThickness".split(),
    vtkActiveEXRReader: ["MaximumMemory"],
    vtkActiveEXRWriter: "DisplaySize FramesPerSecond".split(),
    vtkActiveVDBReader: ["WorldRegion"],
    vtkActiveVDBWriter: ["VoxelSize"],
}


def every(*lists):
    """(class, name) of the properties in these lists."""
    return [(kind, name) for names in lists for kind in names for name in names[kind]]


class HelpTellsEverything(unittest.TestCase):
    def about(self, kind, name):
        return self.subTest(f"{kind.__name__}.{name}")

    def test_every_property_is_in_one_list(self):
        for kind in NUMBERS:
            with self.subTest(kind.__name__):
                listed = NUMBERS[kind] + SWITCHES[kind] + CHOICES[kind] + OTHERS[kind]
                self.assertEqual(sorted(listed), own_properties(kind))

    def test_the_motion_is_among_the_properties_of_the_surface(self):
        clock = own_properties(vtkActiveClockAlgorithm)
        motion = own_properties(vtkActiveMotionAlgorithm)
        self.assertIn("ArrivalTime", clock)
        self.assertIn("Tension", motion)
        self.assertLess(set(clock), set(motion))
        self.assertLess(set(motion), set(own_properties(vtkActiveImplicitSurface)))

    def test_every_property_tells_its_default(self):
        for kind, name in every(NUMBERS, SWITCHES, CHOICES, OTHERS):
            with self.about(kind, name):
                comment = comment_of(kind, name)
                self.assertIn("Default:", comment)

    def test_every_number_tells_its_range(self):
        for kind, name in every(NUMBERS):
            with self.about(kind, name):
                comment = comment_of(kind, name)
                self.assertIn("Range:", comment)

    def test_every_quantity_tells_its_unit(self):
        for kind, name in every(WITH_UNIT):
            with self.about(kind, name):
                comment = comment_of(kind, name)
                self.assertRegex(comment, r"\[[^\]]+\]")

    def test_every_choice_tells_its_values(self):
        for kind, name in every(CHOICES):
            with self.about(kind, name):
                comment = comment_of(kind, name)
                values = getattr(kind(), f"Get{name}MaxValue")() + 1
                told = {int(value) for value in re.findall(r"\s\((\d)\)", comment)}
                self.assertEqual(told, set(range(values)))

    def test_a_default_that_is_a_number_is_the_one_a_new_object_has(self):
        told = 0
        for kind, name in every(NUMBERS):
            with self.about(kind, name):
                comment = comment_of(kind, name)
                number = re.search(r"Default:\s*(-?\d[\d.]*(?:e[+-]?\d+)?)", comment)
                self.assertIsNotNone(number)
                self.assertEqual(get(kind(), name), float(number[1].rstrip(".")))
                told += 1
        self.assertEqual(told, len(every(NUMBERS)))

    def test_a_switch_tells_how_it_is_made(self):
        for kind, name in every(SWITCHES):
            with self.about(kind, name):
                comment = " ".join(comment_of(kind, name).split())
                self.assertIn("Default: on" if get(kind(), name) else "Default: off", comment)

    def test_a_choice_tells_which_it_begins_with(self):
        for kind, name in every(CHOICES):
            with self.about(kind, name):
                comment = comment_of(kind, name)
                word = re.search(r"Default:\s*(\w+)", comment)[1]
                self.assertEqual(get(kind(), name), getattr(kind, word, 0))

    def test_help_shows_all_of_it(self):
        shown = {kind: pydoc.plain(pydoc.render_doc(kind)) for kind in NUMBERS}
        for kind, name in every(NUMBERS, SWITCHES, CHOICES, OTHERS):
            with self.about(kind, name):
                self.assertTrue("Set" + name in shown[kind], "help() does not show it")

    def test_the_classes_and_the_package_say_what_they_are(self):
        for kind in (*NUMBERS, vtkActiveClockAlgorithm, vtkActiveMotionAlgorithm):
            self.assertTrue(kind.__doc__)
        self.assertRegex(active_implicit_surfaces.__version__, r"^\d+\.\d+\.\d+$")


if __name__ == "__main__":
    unittest.main()
