# ctest: LABELS acceptance long
"""The skin over a splash of 992 particles meets the package's promises in all 41 steps.

Run: python3 test_splash.py
"""

import unittest

import numpy
from active_implicit_surfaces import vtkSkeletonPotential
from scenes import PARTICLE_SPACING, STEPS, VOXEL, splash
from skin_checks import is_closed
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkFiltersCore import (
    vtkFlyingEdges3D,
    vtkImplicitPolyDataDistance,
    vtkPolyDataConnectivityFilter,
)
from vtkmodules.vtkImagingHybrid import vtkSampleFunction


def count_pieces(skin):
    pieces = vtkPolyDataConnectivityFilter()
    pieces.SetInputData(skin)
    pieces.SetExtractionModeToAllRegions()
    pieces.Update()
    return pieces.GetNumberOfExtractedRegions()


def surface_of(particles):
    """Present surface of the particles, on the lattice of the skin."""
    potential = vtkSkeletonPotential()
    potential.SetInput(particles)
    potential.SetParticleModelToAnisotropic()
    potential.SetParticleSpacing(PARTICLE_SPACING)
    potential.SetRadius(2.25 * PARTICLE_SPACING)
    bounds = [0.0] * 6
    potential.GetSkeletonBounds(bounds)
    low = [int(numpy.floor(bound / VOXEL)) for bound in bounds[::2]]
    high = [int(numpy.ceil(bound / VOXEL)) for bound in bounds[1::2]]
    samples = vtkSampleFunction()
    samples.SetImplicitFunction(potential)
    samples.SetModelBounds([VOXEL * end for axis in zip(low, high) for end in axis])
    samples.SetSampleDimensions([b - a + 1 for a, b in zip(low, high)])
    samples.ComputeNormalsOff()
    contour = vtkFlyingEdges3D()
    contour.SetInputConnection(samples.GetOutputPort())
    contour.SetValue(0, 0.0)
    contour.Update()
    return contour.GetOutput()


def mean_distance(points, surface):
    """Mean of the points' distances to the surface, in voxels."""
    distance = vtkImplicitPolyDataDistance()
    distance.SetInput(surface)
    distances = vtkDoubleArray()
    distance.FunctionValue(points.GetPoints().GetData(), distances)
    return numpy.abs(vtk_to_numpy(distances)).mean() / VOXEL


def count_clusters(places, gap):
    """Number of clusters: points nearer than the gap are in one cluster."""
    near = numpy.linalg.norm(places[:, None] - places[None], axis=2) < gap
    left, clusters = numpy.ones(len(places), bool), 0
    while left.any():
        cluster = numpy.zeros(len(places), bool)
        cluster[numpy.argmax(left)] = True
        grown = near[cluster].any(axis=0)
        while grown.sum() > cluster.sum():
            cluster = grown
            grown = near[cluster].any(axis=0)
        left &= ~cluster
        clusters += 1
    return clusters


class Splash(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.messages, cls.closed, cls.pieces, cls.distances = [], [], [], []
        cls.clusters = []
        particles, surface = splash()
        for event in ("WarningEvent", "ErrorEvent"):
            surface.AddObserver(event, lambda _, what: cls.messages.append(what))
        for step in range(STEPS):
            surface.UpdateTimeStep(step)
            skin, target = surface.GetOutput(), surface_of(particles.GetOutput())
            cls.closed.append(is_closed(skin))
            cls.pieces.append(count_pieces(skin))
            places = vtk_to_numpy(particles.GetOutput().GetPoints().GetData()).astype(float)
            cls.clusters.append(
                [count_clusters(places, gap * 0.5 * PARTICLE_SPACING) for gap in (2.8, 4.0)]
            )
            cls.distances.append((mean_distance(skin, target), mean_distance(target, skin)))

    def test_says_nothing(self):
        self.assertEqual(self.messages, [])

    def test_is_closed_and_manifold_at_each_step(self):
        self.assertEqual([step for step in range(STEPS) if not self.closed[step]], [])

    # Distances are measured in both directions, so that a drop without skin is detected. A skin
    # 1/100 s behind a surface that moves at 1 per second is off by a third of a voxel.
    def test_is_within_half_a_voxel_of_the_particles_surface(self):
        for step, distances in enumerate(self.distances):
            self.assertLess(max(distances), 0.5, f"at step {step}")

    # The drop is separate from the pool until it lands. Then four drops fly, and two heaps remain
    # apart.
    def test_merges_and_splits(self):
        self.assertEqual(self.pieces[:8], [2] * 8)
        self.assertEqual(self.pieces[9:21], [1] * 12)
        self.assertEqual(self.pieces[21:28], [5] * 7)
        self.assertEqual(self.pieces[28:35], [1] * 7)
        self.assertEqual(self.pieces[38:], [3] * 3)

    def test_particles_are_apart_where_the_skin_is(self):
        """Particles nearer than 2.8 r belong in one piece, and no piece may span a gap of more than
        4 r: both limit the number of pieces."""
        for step, (most, least) in enumerate(self.clusters):
            with self.subTest(step=step):
                self.assertLessEqual(self.pieces[step], most)
                self.assertGreaterEqual(self.pieces[step], least)


if __name__ == "__main__":
    unittest.main()
