# ctest: LABELS contract
"""Images of labels: the skin is smooth, keeps pixels on their sides, has the label's volume."""

import sys
import tempfile
import unittest
from pathlib import Path

import active_implicit_surfaces as active
import numpy
from active_implicit_surfaces import vtkActiveImplicitSurface
from active_implicit_surfaces.measures import measure
from same_bytes_shapes import Steps
from shapes import as_array, bytes_of, image_of, points_of, with_properties
from skin_checks import is_closed
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkCommonMath import vtkMatrix3x3

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "Examples" / "Python"))
from knot_label import smooth_by_sinc  # noqa: E402

RADIUS = 12.0
CENTER = numpy.array([16.2, 15.9, 16.3])
ISOTROPIC, SLICES = (1.0, 1.0, 1.0), (1.0, 1.0, 4.0)  # pixels


def pixels(spacing, size=33.0):
    axes = [numpy.arange(0, size, side) for side in spacing]
    z, y, x = numpy.meshgrid(*axes[::-1], indexing="ij")
    return numpy.stack([x, y, z], -1)


def ball_label(spacing, shift=(0, 0, 0), radius=RADIUS):
    inside = numpy.linalg.norm(pixels(spacing) - CENTER - shift, axis=-1) < radius
    return 7 * inside.astype("u1")


def skin_of(image, **properties):
    surface = with_properties(vtkActiveImplicitSurface(), properties)
    surface.SetInputData(image)
    surface.Update()
    return surface


def volume_of_label(values, spacing):
    return numpy.count_nonzero(values) * numpy.prod(spacing)


def errors(skin):
    return numpy.abs(numpy.linalg.norm(points_of(skin) - CENTER, axis=1) - RADIUS)


def distances(surface, points):
    function = surface.GetSkinFunction()
    return numpy.array([function.FunctionValue(point) for point in points])


class Labels(unittest.TestCase):
    def assert_volume(self, skin, expected):
        self.assertTrue(is_closed(skin))
        self.assertAlmostEqual(measure(skin)["volume"] / expected, 1, delta=1e-3)

    def assert_sides(self, surface, values, spacing):
        """Each pixel next to the label's surface is on its side of the skin. The tolerance is a
        twentieth of a pixel's longest side, as the skin is interpolated between the nodes."""
        inside = values > 0
        near = numpy.zeros_like(inside)
        for axis in range(3):
            changed = numpy.diff(inside, axis=axis)
            low, high = (
                numpy.moveaxis(near, axis, 0)[part] for part in (slice(-1), slice(1, None))
            )
            low |= numpy.moveaxis(changed, axis, 0)
            high |= numpy.moveaxis(changed, axis, 0)
        found = distances(surface, pixels(spacing)[near]) / max(spacing)
        wrong = numpy.where(inside[near], found, -found)
        self.assertLess(wrong.max(), 0.05)

    def test_a_ball_is_nearer_than_the_one_of_a_windowed_sinc(self):
        for spacing in (ISOTROPIC, SLICES):
            with self.subTest(spacing):
                values = ball_label(spacing)
                image = image_of(values, spacing)
                surface = skin_of(image)
                skin, other = surface.GetOutput(), smooth_by_sinc(image, 7)
                self.assertLess(errors(skin).mean(), 0.6 * errors(other).mean())
                self.assert_volume(skin, volume_of_label(values, spacing))
                self.assert_sides(surface, values, spacing)

    def test_tension_smooths_and_the_bound_holds(self):
        values = ball_label(SLICES)
        means = []
        for tension in (0.01, 0.2, 1.0):
            surface = skin_of(image_of(values, SLICES), Tension=tension)
            means.append(errors(surface.GetOutput()).mean())
            self.assert_sides(surface, values, SLICES)
            self.assert_volume(surface.GetOutput(), volume_of_label(values, SLICES))
        self.assertEqual(means, sorted(means, reverse=True))

    def test_noise_of_zero_gives_the_faces_of_the_pixels(self):
        image = image_of(ball_label(ISOTROPIC), ISOTROPIC)
        raw = skin_of(image, TargetNoise=0.0)
        explicit = skin_of(image, TimeIntegration=0)
        self.assertEqual(bytes_of(raw), bytes_of(explicit))
        self.assertGreater(
            errors(raw.GetOutput()).mean(), 2 * errors(skin_of(image).GetOutput()).mean()
        )
        self.assertEqual(raw.GetTargetNoiseInUse(), 0)
        narrow = skin_of(image, TargetNoise=0.25)
        self.assertAlmostEqual(narrow.GetTargetNoiseInUse(), 0.25)
        found = [errors(one.GetOutput()).mean() for one in (raw, narrow, skin_of(image))]
        self.assertEqual(found, sorted(found, reverse=True))

    def test_parts_of_one_pixel_survive_on_voxels_of_a_pixel(self):
        values = numpy.zeros((20, 20, 20), "u1")
        values[4, 4, 4] = values[10, 3:17, 3:17] = values[15, 15, 4:9] = 1
        surface = skin_of(image_of(values), VoxelSize=1.0)
        self.assertEqual(surface.GetHistory().GetValueByName(0, "Components").ToInt(), 3)
        self.assert_volume(surface.GetOutput(), volume_of_label(values, ISOTROPIC))

    def test_a_label_at_the_border_ends_with_its_pixels(self):
        values = ball_label(ISOTROPIC)[10:22, :, :]
        surface = skin_of(image_of(values))
        self.assert_volume(surface.GetOutput(), volume_of_label(values, ISOTROPIC))
        self.assertLess(surface.GetOutput().GetBounds()[4], -0.4)

    def test_a_turned_image_has_the_turned_skin(self):
        values = ball_label(SLICES)
        straight = skin_of(image_of(values, SLICES), VoxelSize=0.8).GetOutput()
        image, turn = image_of(values, SLICES), vtkMatrix3x3()
        c, s = numpy.cos(0.4), numpy.sin(0.4)
        matrix = numpy.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
        for i in range(3):
            for j in range(3):
                turn.SetElement(i, j, matrix[i, j])
        image.SetDirectionMatrix(turn)
        image.SetOrigin(1000.0, 0.0, 0.0)
        skin = skin_of(image, VoxelSize=0.8).GetOutput()
        self.assert_volume(skin, volume_of_label(values, SLICES))
        back = (points_of(skin) - [1000.0, 0.0, 0.0]) @ matrix
        found = numpy.abs(numpy.linalg.norm(back - CENTER, axis=1) - RADIUS).mean()
        self.assertAlmostEqual(found, errors(straight).mean(), delta=0.05)

    def test_fine_voxels_keep_bound_and_symmetry(self):
        values = numpy.zeros((12, 12, 12), "u1")
        values[4:8, 4:8, 4:8] = 1  # faces at 3.5 and 7.5
        for voxel in (0.5, 0.25, 0.125):
            for origin in ((0, 0, 0), (0, 0.3, 0.7)):
                with self.subTest(voxel=voxel, origin=origin):
                    image = image_of(values)
                    image.SetOrigin(origin)
                    surface = skin_of(image, VoxelSize=voxel)
                    self.assert_volume(surface.GetOutput(), 64)
                    low, high = numpy.reshape(surface.GetOutput().GetBounds(), (3, 2)).T - origin
                    bulges = numpy.concatenate([3.5 - low, high - 7.5])
                    self.assertGreater(bulges.min(), 0.35)
                    self.assertLess(bulges.max(), 0.5)
                    if not any(origin):
                        self.assertLess(numpy.ptp(bulges), 1e-4)

    def test_a_bound_of_any_length(self):
        values = ball_label(ISOTROPIC)
        for noise in (3.0, 1e4, 1e29):
            skin = skin_of(image_of(values), TargetNoise=noise).GetOutput()
            self.assert_volume(skin, volume_of_label(values, ISOTROPIC))

    def test_voxels_of_any_size(self):
        values = ball_label(ISOTROPIC)
        for voxel in (0.4, 2.0, 3.1):
            skin = skin_of(image_of(values), VoxelSize=voxel).GetOutput()
            self.assert_volume(skin, volume_of_label(values, ISOTROPIC))
            self.assertLess(errors(skin).mean(), 0.05 * max(voxel, 1))

    def test_other_images_are_no_labels(self):
        far = numpy.linalg.norm(pixels(ISOTROPIC) - CENTER, axis=-1) - RADIUS
        for values in (far, numpy.clip(0.5 - far, 0, 1)):
            image = image_of(values.astype("f4"))
            self.assertEqual(bytes_of(skin_of(image)), bytes_of(skin_of(image, TimeIntegration=0)))

    def test_values_that_are_not_finite_are_outside(self):
        values = ball_label(ISOTROPIC).astype("f4")
        values[values == 0] = numpy.where(numpy.arange((values == 0).sum()) % 5, 0, numpy.nan)
        surface = skin_of(image_of(values))
        self.assert_volume(surface.GetOutput(), volume_of_label(values == 7, ISOTROPIC))

    def test_walls_cut_the_label(self):
        box = {"ModelBounds": (0, 16, 0, 32, 0, 32), "BoundedDomain": True}
        for voxel in (1.0, 0.2):
            with self.subTest(voxel=voxel):
                skin = skin_of(image_of(ball_label(ISOTROPIC)), VoxelSize=voxel, **box).GetOutput()
                self.assertTrue(is_closed(skin))
                self.assertAlmostEqual(skin.GetBounds()[1], 16, delta=1e-3)

    def test_threads_do_not_matter(self):
        image = image_of(ball_label(SLICES), SLICES)
        self.assertEqual(*(bytes_of(skin_of(image, NumberOfThreads=n)) for n in (1, 2)))


class Series(unittest.TestCase):
    """A label that moves by a pixel per frame; the last image has none."""

    def setUp(self):
        shapes = [ball_label(ISOTROPIC, (step, 0, 0), 6.0) for step in range(4)]
        self.volume = [volume_of_label(values, ISOTROPIC) for values in shapes]
        self.images = [image_of(values) for values in [*shapes, 0 * shapes[0]]]

    def center(self, skin):
        return points_of(skin).mean(axis=0)[0] - CENTER[0]

    def test_each_skin_is_that_of_its_image(self):
        for step, (_, skin) in enumerate(active.frames(self.images, fps=10)):
            if step == 4:
                self.assertEqual(skin.GetNumberOfPoints(), 0)
                break
            self.assertAlmostEqual(measure(skin)["volume"] / self.volume[step], 1, delta=1e-3)
            self.assertAlmostEqual(self.center(skin), step, delta=0.1)
            single = next(iter(active.frames([self.images[step]], fps=10))).skin
            self.assertAlmostEqual(measure(skin)["area"] / measure(single)["area"], 1, delta=1e-3)
            self.assertLess(
                numpy.abs(numpy.subtract(skin.GetBounds(), single.GetBounds())).max(), 0.02
            )

    def test_in_between_it_moves_evenly(self):
        found = [
            self.center(skin)
            for time, skin in active.frames(self.images[:4], fps=10, output_fps=40)
        ]
        self.assertLess(numpy.abs(found - 0.25 * numpy.arange(len(found))).max(), 0.1)

    def test_a_lagging_skin_stays_within_the_first_label(self):
        balls = {t: image_of(ball_label(SLICES, radius=10.0 - 6.0 * t), SLICES) for t in (0.0, 1.0)}
        source = Steps(balls)
        surface = with_properties(vtkActiveImplicitSurface(), {"Attraction": 1.0, "Tension": 0.05})
        surface.SetInputConnection(source.GetOutputPort())
        surface.UpdateTimeStep(1.0)
        farthest = numpy.abs(points_of(surface.GetOutput()) - CENTER).max(axis=0)
        self.assertTrue((farthest > 4.0).all() and (farthest < 10.5).all(), farthest)

    def test_velocity_is_that_of_the_label(self):
        skins = [
            frame.skin for frame in active.frames(self.images[:4], fps=10, compute_velocity=True)
        ]
        velocity = vtk_to_numpy(skins[2].GetPointData().GetArray("Velocity"))
        normals = vtk_to_numpy(skins[2].GetPointData().GetArray("Normals"))
        ends = numpy.abs(normals[:, 0]) > 0.95
        self.assertAlmostEqual(velocity[ends, 0].mean(), 10.0, delta=2.0)

    def test_values_of_cells_are_at_their_centers(self):
        values = ball_label(ISOTROPIC)
        cells = vtkImageData()
        cells.SetDimensions([n + 1 for n in values.shape[::-1]])
        cells.SetOrigin(-0.5, -0.5, -0.5)
        cells.GetCellData().SetScalars(as_array(values.ravel()))
        of_points, of_cells = (
            next(iter(active.frames([image], fps=1))).skin for image in (image_of(values), cells)
        )
        self.assertEqual(bytes_of(of_cells), bytes_of(of_points))

    def test_a_state_continues(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "state.vdb")
            first, second = vtkActiveImplicitSurface(), vtkActiveImplicitSurface()
            for image in self.images[:3]:
                self.assertTrue(first.Advance(image, 0.1))
            self.assertTrue(first.SaveState(str(file)))
            self.assertTrue(second.LoadState(str(file)))
            self.assertTrue(second.Advance(self.images[2], 0.1))
            for surface in (first, second):
                self.assertTrue(surface.Advance(self.images[3], 0.1))
            self.assertEqual(bytes_of(first), bytes_of(second))


if __name__ == "__main__":
    unittest.main()
