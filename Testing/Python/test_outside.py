# ctest: LABELS acceptance
"""The history's Outside equals "outside by more than r" of Testing/Benchmarks/quality.py.

Run: python3 test_outside.py
"""

import sys
import unittest
from pathlib import Path
from types import SimpleNamespace

import numpy
from scenes import PARTICLE_SPACING, STEPS, VOXEL, splash
from vtkmodules.util.numpy_support import vtk_to_numpy

ROOT = Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / "Testing" / "Benchmarks"), str(ROOT / "Examples" / "Python")]
from skin_geometry import Skin  # noqa: E402
from skin_measures import kept  # noqa: E402

ROUNDING = 1e-4 * VOXEL  # of the mesh's points, in single precision, with a margin


def measure(attraction):
    """For each of the first steps: Outside, the same fraction by quality.py, and that of ties."""
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
        """A slow skin without new parts loses many particles. Signs are hardest in splashes."""
        rows = measure(attraction=10)
        self.assertGreater(rows[:, 0].max(), 0.05)
        for step, (outside, expected, ties) in enumerate(rows):
            with self.subTest(step=step):
                self.assertLessEqual(abs(outside - expected), ties + 1e-12)


if __name__ == "__main__":
    unittest.main()
