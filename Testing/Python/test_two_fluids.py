# ctest: LABELS exact
"""Two skins that share a surface, as in Examples/Python/two_fluids.py.

Run: python3 test_two_fluids.py
"""

import sys
import tempfile
import unittest
from pathlib import Path

import numpy
from active_implicit_surfaces import ParticleSeries
from active_implicit_surfaces.measures import measure
from shapes import points_of
from vtkmodules.vtkFiltersCore import vtkImplicitPolyDataDistance

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "Examples" / "Python"))
import two_fluids  # noqa: E402
import two_layers  # noqa: E402

SPACING = 0.04
VOXEL = 0.5 * SPACING
FRAMES = 7  # until the wave is steepest


class Interface(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "both.npz"
            two_layers.write_fluids(path, SPACING, FRAMES)
            clouds = [ParticleSeries(path, where=f"phase={phase}") for phase in (1, 2)]
            cls.particles = [points_of(cloud.frame(FRAMES - 1)) for cloud in clouds]
            for cls.skins in two_fluids.skins_of(path, SPACING):
                pass

    def test_volumes(self):
        for skin, particles in zip(self.skins, self.particles):
            share = measure(skin)["volume"] / (len(particles) * SPACING**3)
            self.assertLess(abs(share - 1), 0.03)

    def test_no_overlap(self):
        """Distances to the first skin are trilinear within its voxels."""
        function = self.skins[2]
        least = min(function.EvaluateFunction(point) for point in points_of(self.skins[1]))
        self.assertGreater(least, -0.2 * VOXEL)

    def test_gap(self):
        """Gap from the first skin, at points that face the second fluid, away from edges."""
        heavy, light = self.skins[:2]
        points = points_of(heavy)
        edge, box = 3 * SPACING, numpy.array([two_layers.SIZE[0], numpy.inf, two_layers.SIZE[2]])
        points = points[((points > edge) & (points < box - edge)).all(axis=1)]
        self.assertGreater(len(points), 500)
        distance = vtkImplicitPolyDataDistance()
        distance.SetInput(light)
        gaps = numpy.abs([distance.EvaluateFunction(point) for point in points]) / VOXEL
        self.assertLess(gaps.max(), 0.6)


if __name__ == "__main__":
    unittest.main()
