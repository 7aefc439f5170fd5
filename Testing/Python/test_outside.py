# ctest: LABELS acceptance
"""The history's Outside equals "outside by more than r" of Testing/Benchmarks/quality.py. For an
inverted target, Outside is the fraction of the space around the points that the skin does not
enclose.

Run: python3 test_outside.py
"""

import sys
import unittest
from pathlib import Path
from types import SimpleNamespace

import numpy
from active_implicit_surfaces import vtkActiveImplicitSurface
from listener import Listener
from same_bytes_shapes import lines
from scenes import PARTICLE_SPACING, STEPS, VOXEL, splash
from shapes import make_points
from vtkmodules.util.numpy_support import vtk_to_numpy

ROOT = Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / "Testing" / "Benchmarks"), str(ROOT / "Examples" / "Python")]
from skin_geometry import Skin  # noqa: E402
from skin_measures import kept  # noqa: E402

ROUNDING = 1e-4 * VOXEL  # of the mesh's points, in single precision, with a margin


def measure(attraction):
    """For each of the first steps: Outside, the same by quality.py, and the fraction of ties."""
    particles, surface = splash()
    surface.SetAttraction(attraction)
    surface.CreatePartsOff()
    surface.SetTransport(0.0)
    rows = []
    for step in range(STEPS // 2):
        surface.UpdateTimeStep(step)
        particles.UpdateTimeStep(step)
        places = vtk_to_numpy(particles.GetOutput().GetPoints().GetData()).astype(float)
        skin = Skin(surface.GetOutput())
        scene = SimpleNamespace(frames=[None, (places,)], spacing=PARTICLE_SPACING)
        expected = kept(scene, [None, skin], 1, lambda frame: slice(None))[1]
        ties = abs(skin.distances(places) - 0.5 * PARTICLE_SPACING) < ROUNDING
        outside = surface.GetHistory().GetValueByName(step, "Outside").ToDouble()
        rows.append((outside, expected, ties.mean()))
    return numpy.array(rows)


class OutsideAgrees(unittest.TestCase):
    def test_with_drops_that_are_lost(self):
        """A slow skin without new parts loses many particles."""
        rows = measure(attraction=10)
        self.assertGreater(rows[:, 0].max(), 0.05)
        for step, (outside, expected, ties) in enumerate(rows):
            with self.subTest(step=step):
                self.assertLessEqual(abs(outside - expected), ties + 1e-12)


class Inverted(unittest.TestCase):
    """The first skin over an inverted target encloses the space around the points."""

    def check(self, data):
        surface = vtkActiveImplicitSurface()
        surface.SetInputData(data)
        surface.SetModelBounds(-1, 2, -1, 2, -1, 2)
        surface.SetParticleSpacing(0.2)
        surface.InvertTargetOn()
        heard = Listener(surface)
        surface.Update()
        self.assertGreater(surface.GetOutput().GetNumberOfPolys(), 0)
        outside = surface.GetHistory().GetValueByName(0, "Outside").ToDouble()
        self.assertLess(outside, 0.01)
        self.assertEqual(heard.warnings, [])

    def test_particles(self):
        ticks = 0.2 * numpy.arange(5)
        self.check(make_points(numpy.stack(numpy.meshgrid(ticks, ticks, ticks), axis=-1)))

    def test_a_line(self):
        self.check(lines([(0, 0, 0), (1, 0, 0)], (0, 1)))


if __name__ == "__main__":
    unittest.main()
