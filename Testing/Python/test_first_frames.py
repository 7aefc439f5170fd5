# ctest: LABELS contract
"""The spacing depends on more than the first frame. Emitters may begin with no particle, with
one or with strays: the filter itself uses the spacing of later frames with particles.

Run: python3 test_first_frames.py
"""

import sys
import unittest
from pathlib import Path

import numpy
from active_implicit_surfaces import vtkActiveImplicitSurface
from shapes import with_properties
from skin_checks import points_of, triangles_of
from vtkmodules.vtkCommonCore import vtkLogger
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as SDDP

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "Examples" / "Python"))
from particle_series import ParticleSeries  # noqa: E402

GRID = numpy.stack(numpy.meshgrid(*3 * [numpy.arange(8.0)], indexing="ij"), -1).reshape(-1, 3)
STRAYS = GRID[[0, 100, 300]]
NOTHING = numpy.zeros((0, 3))


def same_skins(one, other):
    return numpy.array_equal(points_of(one), points_of(other)) and numpy.array_equal(
        triangles_of(one), triangles_of(other)
    )


class Counting(ParticleSeries):
    """Lists the requested steps; steps in `broken` fail."""

    def __init__(self, frames, broken=()):
        super().__init__([(frame, None, numpy.arange(len(frame))) for frame in frames])
        self.made, self.broken = [], broken

    def RequestData(self, request, inputs, outputs):
        time = outputs.GetInformationObject(0).Get(SDDP.UPDATE_TIME_STEP())
        step = round((time or 0.0) * self.rate)
        self.made.append(step)
        return 0 if step in self.broken else super().RequestData(request, inputs, outputs)


def surface_over(source, **properties):
    surface = vtkActiveImplicitSurface()
    surface.SetInputConnection(source.GetOutputPort())
    surface.SetInputArrayToProcess(1, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "id")
    return with_properties(surface, properties)


def series(first, count=6):
    return Counting([first, *(GRID + 0.1 * step for step in range(1, count))])


class FirstFrames(unittest.TestCase):
    def setUp(self):
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)

    def test_the_frames_with_particles_tell_the_spacing(self):
        for first in (NOTHING, GRID[:1], STRAYS, GRID):
            with self.subTest(particles=len(first)):
                surface = surface_over(series(first))
                given = surface_over(series(first), ParticleSpacing=1.0)
                for step in (0, 1, 3):
                    surface.UpdateTimeStep(step / 25)
                    given.UpdateTimeStep(step / 25)
                    self.assertTrue(same_skins(surface.GetOutput(), given.GetOutput()), step)
                self.assertEqual(surface.GetParticleSpacingInUse(), 1.0)
                self.assertEqual(surface.GetVoxelSizeInUse(), 0.5)
                self.assertGreater(surface.GetOutput().GetNumberOfPoints(), 500)

    def test_whatever_is_asked_for_first(self):
        skins = []
        for steps in ((0, 1, 4), (4,), (3, 0, 4)):
            surface = surface_over(series(STRAYS))
            for step in steps:
                surface.UpdateTimeStep(step / 25)
            skins.append(surface.GetOutput())
        self.assertTrue(same_skins(skins[0], skins[1]))
        self.assertTrue(same_skins(skins[0], skins[2]))

    def test_the_domain_of_the_potential_is_of_the_same_spacing(self):
        surface = surface_over(series(STRAYS))
        surface.Update(1)
        self.assertEqual(surface.GetVoxelSizeInUse(), 0.5)

    def test_few_steps_are_read(self):
        source = series(GRID, 40)
        surface_over(source).UpdateTimeStep(0.0)
        self.assertEqual(source.made, [0, 19, 39])
        source = series(GRID, 40)
        surface_over(source, ParticleSpacing=1.0).UpdateTimeStep(0.0)
        self.assertEqual(source.made, [0])

    def test_a_last_step_that_cannot_be_made_is_no_matter_before(self):
        source = Counting([STRAYS, *(GRID + 0.1 * step for step in range(1, 6))], broken=(5,))
        surface = surface_over(source)
        surface.UpdateTimeStep(2 / 25)
        self.assertEqual(surface.GetParticleSpacingInUse(), 1.0)
        self.assertGreater(surface.GetOutput().GetNumberOfPoints(), 500)

    def test_nothing_in_any_step(self):
        surface = surface_over(Counting([NOTHING] * 4))
        for step in range(4):
            surface.UpdateTimeStep(step / 25)
            self.assertEqual(surface.GetOutput().GetNumberOfPoints(), 0)

    def test_one_particle_in_all_steps_is_an_error(self):
        surface = surface_over(Counting([GRID[:1]] * 4))
        surface.UpdateTimeStep(0.0)
        self.assertEqual(surface.GetOutput().GetNumberOfPoints(), 0)
        self.assertEqual(surface.GetParticleSpacingInUse(), 0.0)


if __name__ == "__main__":
    unittest.main()
