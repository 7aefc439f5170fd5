# ctest: LABELS exact
"""A radius is a radius: the skin shows the given ball or tube if it has no neighbours.

Run: python3 test_radii.py
"""

import unittest
import warnings

import active_implicit_surfaces as active
import numpy
from active_implicit_surfaces.data_objects import as_particles
from active_implicit_surfaces.measures import measure
from shapes import as_array
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

FAR = 12.0  # between balls, in the largest radius, beyond every kernel
SHARE = 0.03


def corners_of(skin):
    points = vtk_to_numpy(skin.GetPoints().GetData()).astype(float)
    return points[vtk_to_numpy(skin.GetPolys().GetConnectivityArray()).reshape(-1, 3)]


def radii_of_balls(skin, centers):
    """For each center, the radius of the ball that has the volume of the skin there."""
    corners = corners_of(skin)
    numbers = numpy.abs(corners.mean(1)[:, None, 0] - centers[None, :, 0]).argmin(1)
    a, b, c = (corners[:, k] - centers[numbers] for k in range(3))
    parts = numpy.einsum("ij,ij->i", a, numpy.cross(b, c)) / 6
    volumes = numpy.bincount(numbers, parts, minlength=len(centers))
    return numpy.cbrt(volumes / (4 / 3 * numpy.pi))


def balls(radii, seed=0):
    """Distant points, off every lattice of voxels."""
    centers = numpy.random.default_rng(seed).uniform(-0.5, 0.5, (len(radii), 3))
    centers[:, 0] += FAR * max(radii) * numpy.arange(len(radii))
    return centers


class Balls(unittest.TestCase):
    def check(self, radii, voxel, share=SHARE, **options):
        centers = balls(radii)
        skin = active.skin(centers, radii=numpy.array(radii), voxel_size=voxel, **options)
        shown = radii_of_balls(skin, centers) / radii
        self.assertLess(numpy.abs(shown - 1).max(), share, shown)

    def test_anisotropic(self):
        self.check([0.5] * 8, 0.25)

    def test_sums_of_any_kernel_and_threshold(self):
        for kernel in ("wyvill", "cubic_spline", "metaball"):
            for threshold in (0.05, 0.5, 0.8):
                with self.subTest(kernel=kernel, threshold=threshold):
                    options = {"particle_kernel": kernel, "particle_threshold": threshold}
                    self.check([0.5] * 4, 0.1, particle_model="sum", **options)

    def test_a_spread_of_sizes(self):
        """The radius of the smallest ball is a voxel and a half."""
        self.check([1.0, 0.6, 0.3, 0.15], 0.1, share=0.05)

    def test_balls_that_overlap(self):
        """The skin lies far outside balls that overlap, and the domain must not cut it."""
        spread = numpy.arange(4)
        centers = numpy.stack([0.1 * spread, 0.05 * (spread % 3), 0 * spread], -1)
        radii = 0.2 + 0.02 * spread
        corners = corners_of(active.skin(centers, radii=radii, voxel_size=0.05))
        self.assertTrue((corners.min((0, 1)) < centers.min(0) - 0.1).all())
        a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
        volume = numpy.einsum("ij,ij->i", a, numpy.cross(b, c)).sum() / 6
        self.assertGreater(volume, 4 / 3 * numpy.pi * radii.max() ** 3)
        self.assertLess(volume, 4 * 4 / 3 * numpy.pi * (2 * radii.max()) ** 3)

    def test_radii_that_do_not_fit_the_spacing_are_told(self):
        rows = numpy.arange(6.0)
        body = numpy.stack(numpy.meshgrid(rows, rows, rows), -1).reshape(-1, 3)
        fine = 0.5 * body + [6, 0, 0]
        sizes = numpy.r_[numpy.full(216, 0.5), numpy.full(216, 0.25)]
        loose = numpy.random.default_rng(1).uniform(0, 6, (216, 3))
        for points, radii, options, are_told in (
            (body, numpy.full(216, 0.5), {}, False),
            (loose, numpy.full(216, 0.5), {}, False),
            (numpy.concatenate([body, fine]), sizes, {}, False),
            (body, numpy.full(216, 0.65), {"particle_model": "sum"}, False),
            (body, numpy.full(216, 0.65), {}, True),
            (body, numpy.full(216, 1.0), {"particle_spacing": 1.0}, True),
        ):
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                active.skin(points, radii=radii, **options)
            said = " ".join(str(each.message) for each in caught)
            self.assertEqual("The radii are too large" in said, are_told, said)

    def test_a_preset_for_atoms(self):
        self.check([1.7, 1.1], 0.25, preset="molecule")

    def test_atoms_without_radii_are_balls_of_1_3_spacings(self):
        centers = numpy.array([[0.0, 0, 0], [9, 0, 0]])
        skin = active.skin(centers, preset="molecule", particle_spacing=2.0, voxel_size=0.3)
        numpy.testing.assert_allclose(radii_of_balls(skin, centers), 2.6, rtol=0.02)

    def test_a_preset_for_grains(self):
        self.check([0.5, 0.4, 0.3], 0.1, preset="grains")

    def test_a_kernel_radius_overrides_the_array_radius_of_a_preset(self):
        centers, given = numpy.array([[0.0, 0, 0], [9, 0, 0]]), numpy.array([1.0, 1.5])
        atoms = as_particles(centers, radius=given)
        options = {"preset": "molecule", "kernel_radius": 2 / 0.7947, "voxel_size": 0.2}
        for more, wanted in (({}, [2.0, 2.0]), ({"radii": "radius"}, given)):
            shown = radii_of_balls(active.skin(atoms, **options, **more), centers)
            numpy.testing.assert_allclose(shown, wanted, rtol=SHARE)

    def test_the_mean_over_places_at_voxels_of_a_radius(self):
        radii = [1.0] * 60
        centers = balls(radii, seed=3)
        skin = active.skin(centers, particle_spacing=2.0, voxel_size=1.0)
        shown = radii_of_balls(skin, centers)
        self.assertAlmostEqual(shown.mean(), 1.0, delta=0.01)
        self.assertLess(numpy.abs(shown - 1).max(), 0.06)


class Grains(unittest.TestCase):
    """Balls of radius 0.5 in a lattice that is rotated against the voxels."""

    def setUp(self):
        turn, _ = numpy.linalg.qr(numpy.random.default_rng(1).normal(size=(3, 3)))
        self.turn = turn
        self.wanted = 4 / 3 * numpy.pi * 0.5**3

    def lattice(self, count, spacing=1.0):
        rows = numpy.arange(count) * spacing
        return numpy.stack(numpy.meshgrid(rows, rows, rows), -1).reshape(-1, 3) @ self.turn

    def test_a_thousand_that_touch_keep_their_volume(self):
        for options in ({"radii": numpy.full(1000, 0.5)}, {"particle_spacing": 1.0}, {}):
            with warnings.catch_warnings():
                warnings.simplefilter("error")  # no warning of a short kernel
                skin = active.skin(self.lattice(10), preset="grains", **options)
            self.assertAlmostEqual(measure(skin)["volume"] / self.wanted, 1000, delta=30)

    def test_those_apart_stay_apart(self):
        """Gaps are 0.4 of the radius, 1.2 voxels."""
        skin = active.skin(self.lattice(5, 1.2), preset="grains", radii=numpy.full(125, 0.5))
        self.assertEqual(measure(skin)["pieces"], 125)

    def test_they_keep_it_while_they_fall(self):
        """The radii are in an array that is not called radius, beside one that is."""
        balls = self.lattice(5, 1.3)
        arrays = {"size": numpy.full(125, 0.5), "radius": numpy.full(125, 0.1)}
        steps = [as_particles(balls - [0, 0.1 * step, 0], **arrays) for step in range(4)]
        volumes = [
            measure(skin)["volume"] / self.wanted
            for _, skin in active.frames(steps, preset="grains", arrays={"radii": "size"})
        ]
        self.assertLess(numpy.abs(numpy.divide(volumes, 125) - 0.92).max(), 0.03, volumes)


class Tubes(unittest.TestCase):
    def test_a_tube_has_its_radius(self):
        points, lines, data = vtkPoints(), vtkCellArray(), vtkPolyData()
        for x in (0.0, 10.0):
            points.InsertNextPoint(x, 0.037, 0.051)
        lines.InsertNextCell(2)
        lines.InsertCellPoint(0)
        lines.InsertCellPoint(1)
        data.SetPoints(points)
        data.SetLines(lines)
        radii = as_array(numpy.array([0.5, 0.5]))
        radii.SetName("size")
        data.GetPointData().AddArray(radii)
        surface = active.vtkActiveImplicitSurface()
        surface.SetInputData(data)
        surface.SetInputArrayToProcess(0, 0, 0, 0, "size")
        surface.SetVoxelSize(0.1)
        surface.Update()
        places = corners_of(surface.GetOutput()).reshape(-1, 3)
        middle = places[numpy.abs(places[:, 0] - 5) < 3]
        away = numpy.hypot(middle[:, 1] - 0.037, middle[:, 2] - 0.051)
        self.assertLess(numpy.abs(away / 0.5 - 1).max(), SHARE)


class Kernels(unittest.TestCase):
    def test_a_radius_of_particles_goes_with_that_of_kernels(self):
        """Kernels are 4.5 times as wide as the radii: the skin is that of a spacing of two
        radii."""
        block = numpy.stack(numpy.meshgrid(*[numpy.arange(6.0)] * 3), -1).reshape(-1, 3) + 0.137
        given = active.skin(block, radii=numpy.full(216, 0.5), voxel_size=0.5)
        known = active.skin(block, particle_spacing=1.0, voxel_size=0.5)
        kernel = active.skin(block, particle_spacing=1.0, kernel_radius=2.25, voxel_size=0.5)
        for skin in (given, kernel):
            self.assertEqual(corners_of(skin).tobytes(), corners_of(known).tobytes())

    def test_an_array_by_its_name(self):
        cloud = as_particles(balls([0.5, 0.25]), size=numpy.array([0.5, 0.25]))
        shown = radii_of_balls(active.skin(cloud, radii="size", voxel_size=0.1), balls([0.5, 0.25]))
        self.assertAlmostEqual(shown[0] / shown[1], 2.0, delta=0.06)


class Strengths(unittest.TestCase):
    def skin(self, most, **options):
        block = numpy.stack(numpy.meshgrid(*[numpy.arange(4.0)] * 3), -1).reshape(-1, 3)
        strengths = numpy.where(numpy.arange(64) % 3, 1.0, most)
        return active.skin(block, strengths=strengths, particle_spacing=1.0, **options)

    def test_ellipsoids_count_those_above_one_as_one(self):
        whole = corners_of(self.skin(1.0))
        for most in (3.0, 1e24, 1e90):
            with self.assertWarnsRegex(active.ActiveSurfaceWarning, "above 1 count as 1"):
                self.assertEqual(corners_of(self.skin(most)).tobytes(), whole.tobytes())

    def test_a_sum_grows_with_them(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            volumes = [
                measure(self.skin(most, particle_model="sum"))["volume"]
                for most in (1.0, 3.0, 1e9, 1e24, 1e90)
            ]
        self.assertLess(volumes[0], 0.9 * volumes[1])
        self.assertLess(volumes[1], 0.9 * volumes[2])
        self.assertEqual(volumes[2:], 3 * volumes[2:3])

    def test_another_model_uses_the_given_ones(self):
        found = []
        for first in (0, 1):
            points = as_particles(balls([0.5, 0.5]), weight=numpy.array([1.0, 9.0]))
            surface = active.vtkActiveImplicitSurface()
            surface.SetInputData(points)
            surface.SetInputArrayToProcess(2, 0, 0, 0, "weight")
            surface.SetParticleSpacing(1.0)
            surface.SetParticleModel(first)
            surface.Update()
            surface.SetParticleModel(0)
            surface.Update()
            found.append(corners_of(surface.GetOutput()).tobytes())
        self.assertEqual(found[0], found[1])


if __name__ == "__main__":
    unittest.main()
