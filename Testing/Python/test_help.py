"""help(vtkActiveImplicitSurface) tells unit, range and default of every property, and truly."""

import pydoc
import re
import unittest

import active_implicit_surfaces
from active_implicit_surfaces import vtkActiveImplicitSurface, vtkSkeletonPotential

NUMBERS = """
    TargetIsoValue TargetReach VoxelSize MaximumNumberOfActiveVoxels Attraction Tension CFL
    StartTime TimeStepSize NumberOfTimeSteps TimeScale ParticleRadius ParticleThreshold
    MeshThickness NumberOfThreads
""".split()
NOT_NUMBERS = """
    InvertTarget NormalizeTarget ModelBounds ComputeNormals OutputPotential ParticleKernel
""".split()
WITH_UNIT = """
    TargetReach VoxelSize ModelBounds Attraction Tension StartTime TimeStepSize TimeScale
    ParticleRadius MeshThickness
""".split()


def comment_of(name):
    """The property's comment, without the signature lines that the wrapper puts above it."""
    signatures, _, comment = getattr(vtkActiveImplicitSurface, "Set" + name).__doc__.rpartition(
        "\nC++: "
    )
    return comment.partition("\n")[2] if signatures else comment


class HelpTellsEverything(unittest.TestCase):
    def test_every_property_tells_its_default(self):
        for name in NUMBERS + NOT_NUMBERS:
            with self.subTest(name):
                self.assertIn("Default", comment_of(name))

    def test_every_number_tells_its_range(self):
        for name in NUMBERS:
            with self.subTest(name):
                self.assertIn("Range", comment_of(name))

    def test_every_quantity_tells_its_unit(self):
        for name in WITH_UNIT:
            with self.subTest(name):
                self.assertRegex(comment_of(name), r"\[[^\]]+\]")

    def test_a_default_that_is_a_number_is_the_one_a_new_filter_has(self):
        surface = vtkActiveImplicitSurface()
        for name in NUMBERS:
            told = re.search(r"Default:\s*(-?\d[\d.]*(?:e[+-]?\d+)?)", comment_of(name))
            if told:
                with self.subTest(name):
                    default = float(told.group(1).rstrip("."))
                    self.assertEqual(getattr(surface, "Get" + name)(), default)

    def test_help_shows_all_of_it(self):
        shown = pydoc.plain(pydoc.render_doc(vtkActiveImplicitSurface))
        for name in NUMBERS + NOT_NUMBERS:
            with self.subTest(name):
                self.assertTrue("Set" + name in shown, "help() does not show it")

    def test_the_classes_and_the_package_say_what_they_are(self):
        self.assertTrue(vtkActiveImplicitSurface.__doc__)
        self.assertTrue(vtkSkeletonPotential.__doc__)
        self.assertRegex(active_implicit_surfaces.__version__, r"^\d+\.\d+\.\d+$")


if __name__ == "__main__":
    unittest.main()
