# ctest: WITHOUT_PACKAGE LABELS contract
"""Compares Testing/Data/sph_drop.vtp with its description: a drop of particles, over time.

Run: python3 test_sph_drop.py
"""

import math
import unittest
from pathlib import Path

from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

DATA = Path(__file__).resolve().parents[1] / "Data" / "sph_drop.vtp"
STEPS = 41
PARTICLES = 992
RADIUS = 0.05
GRAVITY = 9.81
FRAME = 1.0 / 25.0
ROUNDING = 2.0**-17  # largest error of a coordinate, see make_sph_drop.py


def open_reader():
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(DATA))
    reader.UpdateInformation()
    return reader


def read_positions(reader, step):
    reader.UpdateTimeStep(step)
    particles = reader.GetOutput()
    return [particles.GetPoint(index) for index in range(particles.GetNumberOfPoints())]


class SphDrop(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.reader = open_reader()
        cls.frames = [read_positions(cls.reader, step) for step in range(STEPS)]

    def test_file_is_small(self):
        self.assertLess(DATA.stat().st_size, 1.5e6)

    def test_reader_publishes_one_step_per_frame(self):
        key = vtkStreamingDemandDrivenPipeline.TIME_STEPS()
        information = open_reader().GetOutputInformation(0)
        self.assertEqual(list(information.Get(key)), [float(step) for step in range(STEPS)])

    def test_each_step_has_all_particles_and_no_cells(self):
        for step in range(STEPS):
            self.reader.UpdateTimeStep(step)
            particles = self.reader.GetOutput()
            self.assertEqual(particles.GetNumberOfPoints(), PARTICLES)
            self.assertEqual(particles.GetNumberOfCells(), 0)

    def test_ids_are_point_indices_at_each_step(self):
        for step in range(STEPS):
            self.reader.UpdateTimeStep(step)
            ids = self.reader.GetOutput().GetPointData().GetArray("id")
            values = [ids.GetTuple1(index) for index in range(ids.GetNumberOfTuples())]
            self.assertEqual(ids.GetDataTypeAsString(), "int")
            self.assertEqual(values, list(range(PARTICLES)))

    def test_positions_are_finite(self):
        for frame in self.frames:
            self.assertTrue(all(math.isfinite(x) for point in frame for x in point))

    def test_order_of_requests_does_not_matter(self):
        reader = open_reader()
        for step in (40, 3, 17, 0, 16, 39, 4):
            self.assertEqual(read_positions(reader, step), self.frames[step])

    # Some bound moves by at least 0.0040 between consecutive steps; the margin is a factor of 2.
    def test_bounds_change_at_each_step(self):
        bounds = [[f(axis) for axis in zip(*frame) for f in (min, max)] for frame in self.frames]
        for before, after in zip(bounds, bounds[1:]):
            self.assertGreater(max(abs(a - b) for a, b in zip(before, after)), 0.002)

    # The largest offset from the axis is 0.907, the lowest and highest centre are at 0.093 and
    # 1.699. The margin is a radius.
    def test_particles_stay_in_the_basin(self):
        for frame in self.frames:
            for x, y, z in frame:
                self.assertLess(max(abs(x), abs(z)), 0.907 + RADIUS)
                self.assertGreater(y, 0.093 - RADIUS)
                self.assertLess(y, 1.699 + RADIUS)

    # Only gravity acts on the topmost particle of the drop in the first frames: the second
    # difference of its height is -g dt^2. Three roundings, one of them twice, make 4 * ROUNDING;
    # the simulation's single precision adds less than 1e-6. This fixes order and rate of frames.
    def test_drop_falls_freely_before_it_lands(self):
        top = max(range(PARTICLES), key=lambda index: self.frames[0][index][1])
        height = [frame[top][1] for frame in self.frames[:8]]
        for before, now, after in zip(height, height[1:], height[2:]):
            fall = after - 2 * now + before
            self.assertAlmostEqual(fall, -GRAVITY * FRAME**2, delta=4 * ROUNDING + 1e-6)

    # The limit is the speed of the topmost particle, which starts at 1.03 downwards, after a free
    # fall to the lowest height: sqrt(1.03^2 + 2 g 1.606) = 5.7, or 0.228 per frame. The fastest
    # particle moves by 0.178.
    def test_no_particle_outruns_free_fall(self):
        highest = max(point[1] for point in self.frames[0])
        lowest = min(point[1] for frame in self.frames for point in frame)
        speed = math.sqrt(1.03**2 + 2 * GRAVITY * (highest - lowest))
        for before, after in zip(self.frames, self.frames[1:]):
            moved = max(math.dist(a, b) for a, b in zip(before, after))
            self.assertLess(moved, speed * FRAME)


if __name__ == "__main__":
    unittest.main()
