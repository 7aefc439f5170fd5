# ctest: LABELS contract
"""Spacing of particles: from the frames that define it, with warnings about unsuitable lengths."""

import unittest
import warnings

import active_implicit_surfaces as active
import numpy
from active_implicit_surfaces.presets import estimate_spacing, series_spacing
from active_implicit_surfaces.series import ParticleSeries
from shapes import volume_of

SPACING = 0.05


def block(*sides):
    axes = [numpy.arange(SPACING / 2, side, SPACING) for side in sides]
    return numpy.stack(numpy.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)


BODY = block(0.6, 0.6, 0.3)
SPRAY = numpy.array([[0, 0, 1.0], [0.5, 0.5, 1.2], [1, 0.2, 0.9], [0.3, 0.9, 1.5]])
BOTH = numpy.vstack([SPRAY, BODY])
VOLUME = len(BODY) * SPACING**3


def notes_of(*arguments, **options):
    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always")
        active.skin(*arguments, **options)
    return [str(one.message) for one in heard]


class Series(unittest.TestCase):
    def last_volume(self, frames):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            *_, (_, skin) = active.frames(frames)
        return volume_of(skin)

    def test_a_sparse_first_frame_does_not_decide(self):
        for first in (SPRAY, SPRAY[:1], SPRAY[:2]):
            with self.subTest(particles=len(first)):
                found = self.last_volume([first, BOTH, BOTH, BOTH])
                self.assertAlmostEqual(found / VOLUME, 1.0, delta=0.2)

    def test_a_sparse_last_frame_does_not_decide(self):
        """A splash of which only spray remains."""
        series = ParticleSeries([BODY, BODY, SPRAY], fps=25)
        self.assertAlmostEqual(series_spacing(series.frames_that_tell()), SPACING, delta=1e-6)

    def test_parts_of_a_series_agree(self):
        frames = [SPRAY, *[BOTH + (0.01 * step, 0, 0) for step in range(9)]]
        found = [
            series_spacing(ParticleSeries(part, fps=25).frames_that_tell())
            for part in (frames, frames[:5], frames[5:], frames[3:8])
        ]
        for spacing in found:
            self.assertAlmostEqual(spacing / found[0], 1.0, delta=0.01)

    def test_a_function_of_time_is_asked_in_order(self):
        asked = []

        def particles(time):
            asked.append(time)
            return BODY

        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            list(active.frames(particles, times=[0.0, 1.0, 2.0]))
        self.assertEqual(asked, sorted(asked))

    def test_a_later_frame_that_cannot_be_read_stops_no_earlier_one(self):
        frames = active.frames([BODY, BODY, "no such thing"])
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            self.assertGreater(next(iter(frames)).skin.GetNumberOfPolys(), 0)

    def test_frames_can_be_taken_one_by_one(self):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            frames = active.frames([BODY, BODY + 0.1], fps=10)
            self.assertEqual([next(frames).time, next(frames).time], [0.0, 0.1])
            with self.assertRaises(StopIteration):
                next(frames)
            self.assertEqual(len(list(frames)), 2, "a loop begins at the first one")


class Notes(unittest.TestCase):
    def test_half_and_twice_a_spacing_are_told(self):
        for factor in (0.5, 2.0, 4.0):
            said = notes_of(BODY, particle_spacing=factor * SPACING)
            with self.subTest(factor=factor):
                self.assertTrue(any("0.05 apart" in note for note in said), said)

    def test_what_fits_is_not(self):
        for factor in (0.8, 1.0, 1.25):
            said = notes_of(BODY, particle_spacing=factor * SPACING)
            self.assertFalse([note for note in said if "apart" in note])

    def test_a_radius_in_place_of_a_spacing_is_told(self):
        for radius in (0.5 * SPACING, SPACING):
            said = notes_of(BODY, kernel_radius=radius)
            with self.subTest(radius=radius):
                self.assertTrue(any("particle_spacing 0.05" in note for note in said), said)
        said = notes_of(BODY, kernel_radius=3 * SPACING)
        self.assertFalse([note for note in said if "apart" in note])

    def test_few_particles_tell_nothing(self):
        self.assertFalse([n for n in notes_of(SPRAY, particle_spacing=0.1) if "apart" in n])
        self.assertGreater(estimate_spacing(ParticleSeries([SPRAY]).frame(0)), 0.5)


if __name__ == "__main__":
    unittest.main()
