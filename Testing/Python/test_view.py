# ctest: LABELS contract
"""Points of a series that a film's camera shows, and the axis that it uses as up."""

import unittest

import numpy
from active_implicit_surfaces.commands.view import find_view
from active_implicit_surfaces.particle_files import open_particles
from active_implicit_surfaces.series import ParticleSeries
from command_line import DROP, CommandTest, grid, moving_grid
from vtkmodules.util.numpy_support import vtk_to_numpy

RATE = 25.0


class Series:
    """Frames in memory, with the attributes that find_view reads of files."""

    kind = "vtkPolyData"

    def __init__(self, frames, rate=RATE):
        self.times = [step / rate for step in range(len(frames))]
        self.load = ParticleSeries(frames, times=self.times).frame

    def __len__(self):
        return len(self.times)


def turned(points, up):
    """Rotates points from a world with z up to one with another axis up."""
    moved = numpy.roll(points, "xyz".index(up[-1]) - 2, axis=-1)
    return moved * (-1.0 if up[0] == "-" else 1.0)


def block(*counts):
    axes = [0.1 * numpy.arange(count) for count in counts]
    return numpy.stack(numpy.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)


def up_of(frames, **names):
    return find_view(Series(frames), **names)[1]


class Up(unittest.TestCase):
    def test_a_still_pool(self):
        for up, counts in ("z", (20, 20, 4)), ("y", (20, 4, 20)):
            frames = [block(*counts)] * 5
            self.assertEqual(up_of(frames), up)

    def test_a_pool_at_rest_whose_particles_tremble(self):
        random = numpy.random.default_rng(4)
        frames = [block(20, 4, 20) + random.normal(0.0, 0.002, (1600, 3)) for _ in range(20)]
        self.assertEqual(up_of(frames), "y")

    def test_where_most_lie_low_in_their_box(self):
        for up in ("y", "z"):
            heap, stick = block(9, 9, 2), block(1, 1, 9)
            self.assertEqual(up_of([turned(numpy.concatenate([heap, stick]), up)]), up)

    def test_a_drop_that_falls_into_a_bowl(self):
        fall = open_particles(DROP)
        frames = [vtk_to_numpy(fall.load(i).GetPoints().GetData()).copy() for i in range(20)]
        for count in (5, 20):
            self.assertEqual(up_of(frames[:count]), "y")
            self.assertEqual(up_of([numpy.roll(own, 1, axis=1) for own in frames[:count]]), "z")

    def test_a_cube_of_atoms_has_no_up_but_z(self):
        self.assertEqual(up_of([grid()] * 3), "z")

    def test_nothing_at_all(self):
        self.assertEqual(up_of([numpy.zeros((0, 3))] * 3), "z")
        self.assertEqual(up_of([numpy.full((4, 3), numpy.nan)] * 3), "z")


class TheBox(CommandTest):
    def held(self, positions):
        numpy.savez(self.folder / "a.npz", positions=positions)
        return find_view(open_particles(self.folder / "a.npz"))[0]

    def test_it_holds_all_frames_and_no_nan(self):
        moving = moving_grid(200)
        moving[50, 3] = numpy.nan
        held = self.held(moving)
        # The view contains the first and the last frame. The margin is the larger one of 2 % of the
        # longest side and 1.2 times the spacing, 0.1.
        self.assertTrue(numpy.isfinite(held).all())
        length = 199 * 0.05 + 0.4
        self.assertGreater(0.02 * length, 1.2 * 0.1)
        self.assertAlmostEqual(held[:, 0].max(), length * 1.02, places=6)
        self.assertAlmostEqual(held[:, 0].min(), -0.02 * length, places=6)

    def test_strays_do_not_make_all_else_small(self):
        strays = numpy.array([[9.0, 0.2, 0.2], [0.2, 0.2, -9.0]])
        # 2 of 627: less than 0.5 % at a side.
        held = self.held(numpy.concatenate([*[grid()] * 5, strays]))
        # The heap of side 0.4 is extended by a quarter of its side, and by a margin of 2 %. The
        # spacing, 0 for coincident particles, adds nothing.
        self.assertAlmostEqual(held[:, 0].max(), 0.4 * 1.25 + 0.02 * 0.5, places=6)
        self.assertAlmostEqual(held[:, 2].min(), -0.4 * 0.25 - 0.02 * 0.5, places=6)

    def test_a_drop_that_is_not_far_is_held(self):
        drop = numpy.array([[0.2, 0.49, 0.2]])
        held = self.held(numpy.concatenate([*[grid()] * 5, drop]))
        self.assertAlmostEqual(held[:, 1].max(), 0.49 + 0.02 * 0.49, places=6)


if __name__ == "__main__":
    unittest.main()
