# ctest: LABELS contract
"""What a film's camera holds of a series, and which axis it takes for up."""

import unittest

import numpy
from active_implicit_surfaces.commands.upward import Fall
from active_implicit_surfaces.commands.view import find_view
from active_implicit_surfaces.particle_files import open_particles
from active_implicit_surfaces.series import ParticleSeries
from command_line import CommandTest, grid, moving_grid

GRAVITY, RATE = 9.81, 25.0
AXES = ("x", "y", "z", "-x", "-y", "-z")


class Series:
    """Frames in memory, with what find_view asks of files."""

    kind = "vtkPolyData"

    def __init__(self, frames, rate=RATE):
        self.times = [step / rate for step in range(len(frames))]
        self.load = ParticleSeries(frames, times=self.times).frame

    def __len__(self):
        return len(self.times)


class Particles:
    """Points with arrays, as meshio's."""

    def __init__(self, points, **arrays):
        self.points, self.point_data = points, arrays


def turned(points, up):
    """Points of a world with z up in one with another axis up."""
    moved = numpy.roll(points, "xyz".index(up[-1]) - 2, axis=-1)
    return moved * (-1.0 if up[0] == "-" else 1.0)


def thrown(count=40, frames=12, seed=1):
    """Drops thrown about in a world with z up: their places and velocities in each frame."""
    random = numpy.random.default_rng(seed)
    start, speed = random.random((count, 3)), random.normal(0.0, 2.0, (count, 3))
    pull = numpy.array([0.0, 0.0, -GRAVITY])
    times = numpy.arange(frames)[:, None, None] / RATE
    return start + speed * times + 0.5 * pull * times**2, speed + pull * times


def block(*counts):
    """A lattice of so many particles along the axes."""
    axes = [0.1 * numpy.arange(count) for count in counts]
    return numpy.stack(numpy.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)


def up_of(frames, **names):
    return find_view(Series(frames), **names)[1]


class WhatFalls(unittest.TestCase):
    def test_it_falls_along_each_axis(self):
        places, _ = thrown()
        # A wall at rest beside the drops, which is flat along x and lies low along no axis.
        wall = block(1, 20, 20) - 1.0
        for up in AXES:
            with self.subTest(up):
                frames = [turned(numpy.concatenate([wall, frame]), up) for frame in places]
                self.assertEqual(up_of(frames), up)

    def test_what_falls_for_a_while_tells_it_for_the_whole_series(self):
        # Flat along y, low along y: were it not for what falls at the end, y were up.
        pool, (places, _) = block(20, 2, 20), thrown(frames=8)
        still = [numpy.concatenate([pool, places[0]])] * 12
        falling = [numpy.concatenate([pool, frame]) for frame in places]
        self.assertEqual(up_of(still), "y")
        self.assertEqual(up_of(still + falling), "z")

    def test_a_long_series(self):
        places, _ = thrown(frames=400)
        self.assertEqual(up_of(turned(places, "x")), "x")

    def test_velocities_tell_it_in_two_frames(self):
        places, speeds = thrown(frames=2)
        for name, names in ("v", {}), ("of the fluid", {"velocities": "of the fluid"}):
            with self.subTest(name):
                frames = [Particles(place, **{name: v}) for place, v in zip(places, speeds)]
                self.assertEqual(up_of(turned(places, "-x")), "z", "places alone do not tell it")
                turned_frames = [
                    Particles(turned(f.points, "-x"), **{name: turned(f.point_data[name], "-x")})
                    for f in frames
                ]
                self.assertEqual(up_of(turned_frames, **names), "-x")

    def test_velocities_that_say_nothing_leave_it_to_the_places(self):
        places, _ = thrown()
        frames = [Particles(turned(p, "x"), velocity=numpy.zeros(p.shape)) for p in places]
        self.assertEqual(up_of(frames), "x")

    def test_births_and_deaths(self):
        places, _ = thrown(count=90, frames=30)
        random = numpy.random.default_rng(2)
        frames = []
        for step, place in enumerate(turned(places, "-y")):
            there = random.permutation(numpy.arange(2 * step, 2 * step + 30))
            frames.append((place[there], there))
        for name, names in ("id", {}), ("number", {"ids": "number"}):
            with self.subTest(name):
                own = [Particles(points, **{name: ids}) for points, ids in frames]
                self.assertEqual(up_of(own, **names), "-y")

    def test_particles_that_are_all_new_tell_nothing(self):
        frames = []
        for step, place in enumerate(turned(thrown()[0], "x")):
            frames.append(Particles(place, id=100 * step + numpy.arange(len(place))))
        self.assertEqual(up_of(frames), "z")

    def test_frames_that_do_not_follow_each_other_tell_nothing(self):
        places, fall = thrown()[0], Fall()
        for step in (0, 1, 5, 6):
            fall.add(step, step / RATE, Series([places[step]]).load(0))
        self.assertIsNone(fall.up())

    def test_births_without_ids_are_not_taken_for_motion(self):
        # With a row more at the front, each row would seem to jump from place to place.
        columns = turned(block(3, 3, 30), "x")
        frames = [columns[len(columns) - 100 - 9 * step :] for step in range(12)]
        fall = Fall()
        for step, frame in enumerate(frames):
            fall.add(step, step / RATE, Series([frame]).load(0))
        self.assertIsNone(fall.up())

    def test_unequal_times(self):
        random = numpy.random.default_rng(3)
        times = numpy.cumsum(random.uniform(0.2, 2.0, 12)) / RATE
        start, speed = random.random((40, 3)), random.normal(0.0, 2.0, (40, 3))
        pull = numpy.array([-GRAVITY, 0.0, 0.0])
        series = Series([start + speed * time + 0.5 * pull * time**2 for time in times])
        series.times = times.tolist()
        self.assertEqual(find_view(series)[1], "x")


class NothingFalls(unittest.TestCase):
    def up_of_fall(self, frames):
        fall = Fall()
        for step, frame in enumerate(frames):
            fall.add(step, step / RATE, Series([frame]).load(0))
        return fall.up()

    def test_a_still_pool(self):
        for up, counts in ("z", (20, 20, 4)), ("y", (20, 4, 20)):
            frames = [block(*counts)] * 5
            self.assertIsNone(self.up_of_fall(frames))
            self.assertEqual(up_of(frames), up)

    def test_a_pool_at_rest_whose_particles_tremble(self):
        random = numpy.random.default_rng(4)
        frames = [block(20, 4, 20) + random.normal(0.0, 0.002, (1600, 3)) for _ in range(20)]
        self.assertIsNone(self.up_of_fall(frames))
        self.assertEqual(up_of(frames), "y")

    def test_where_most_lie_low_in_their_box(self):
        for up in ("y", "z"):
            heap, stick = block(9, 9, 2), block(1, 1, 9)
            self.assertEqual(up_of([turned(numpy.concatenate([heap, stick]), up)]), up)

    def test_a_molecule(self):
        for seed in range(10):
            random = numpy.random.default_rng(seed)
            rest, sway, phase = random.random((60, 3)), *random.normal(0.0, 1.0, (2, 60, 3))
            frames = [rest + 0.05 * sway * numpy.sin(0.7 * step + phase) for step in range(60)]
            self.assertIsNone(self.up_of_fall(frames))

    def test_a_cube_of_atoms_has_no_up_but_z(self):
        self.assertEqual(up_of([grid()] * 3), "z")

    def test_what_swings_as_one(self):
        ways = numpy.array([1.0, 0.0, 0.0])
        frames = [grid() + 0.2 * numpy.sin(0.3 * step) * ways for step in range(63)]
        self.assertIsNone(self.up_of_fall(frames))

    def test_what_turns(self):
        frames = []
        for angle in 0.1 * numpy.arange(63):
            c, s = numpy.cos(angle), numpy.sin(angle)
            frames.append((grid(8) - 0.35) @ numpy.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]))
        self.assertIsNone(self.up_of_fall(frames))

    def test_rounding_is_no_motion(self):
        # At 1000 the numbers of a float32 are 6.1e-5 apart.
        still = (1000.0 + grid()).astype("f4")
        self.assertIsNone(self.up_of_fall([still, still, still + numpy.float32([0, 6.1e-5, 0])]))

    def test_what_is_driven_askew(self):
        frames = [grid() + 0.01 * step**2 * numpy.array([1.0, 1.0, 0.0]) for step in range(9)]
        self.assertIsNone(self.up_of_fall(frames))

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
        # The first and the last frame are looked at, and the margin is 2 % of the longest side, or
        # 1.2 times the spacing, .1.
        self.assertTrue(numpy.isfinite(held).all())
        length = 199 * 0.05 + 0.4
        self.assertGreater(0.02 * length, 1.2 * 0.1)
        self.assertAlmostEqual(held[:, 0].max(), length * 1.02, places=6)
        self.assertAlmostEqual(held[:, 0].min(), -0.02 * length, places=6)

    def test_strays_do_not_make_all_else_small(self):
        strays = numpy.array([[9.0, 0.2, 0.2], [0.2, 0.2, -9.0]])
        # 2 of 627: less than .5 % at a side.
        held = self.held(numpy.concatenate([*[grid()] * 5, strays]))
        # The heap's .4, a quarter of it, and the margin, which is 2 % or 1.2 times the spacing: of
        # particles in the same place, 0.
        self.assertAlmostEqual(held[:, 0].max(), 0.4 * 1.25 + 0.02 * 0.5, places=6)
        self.assertAlmostEqual(held[:, 2].min(), -0.4 * 0.25 - 0.02 * 0.5, places=6)

    def test_a_drop_that_is_not_far_is_held(self):
        drop = numpy.array([[0.2, 0.49, 0.2]])
        held = self.held(numpy.concatenate([*[grid()] * 5, drop]))
        self.assertAlmostEqual(held[:, 1].max(), 0.49 + 0.02 * 0.49, places=6)


if __name__ == "__main__":
    unittest.main()
