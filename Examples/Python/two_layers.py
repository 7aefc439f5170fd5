"""Particles of two fluids in a box, one over the other, with a wave between; not by a solver."""

import numpy as np
from fluid_scenes import lattice, shaken

SIZE, LEVEL, RATE = np.array([1.2, 0.8, 0.6]), 0.4, 25


def flow(places, time):
    """Returns the velocity of a wave between the two fluids, which is free of divergence."""
    x, y = np.pi * places[:, :2].T / SIZE[:2, None]
    along, up = SIZE[0] * np.sin(x) * np.cos(y), -SIZE[1] * np.cos(x) * np.sin(y)
    return 0.9 * np.cos(2 * np.pi * time) * np.stack([along, up, 0 * x], axis=1)


def write_fluids(path, spacing, frames):
    """Writes one file of all frames of both fluids: positions, and the array phase, 1 or 2."""
    places = shaken(lattice((0, 0, 0), SIZE, spacing), 0.1 * spacing, 1)
    phase, step, series = np.where(places[:, 1] < LEVEL, 1, 2), 0.25 / RATE, []
    for substep in range(4 * (frames - 1) + 1):
        time = substep * step
        if substep % 4 == 0:
            series.append(places)
        middle = places + 0.5 * step * flow(places, time)
        places = places + step * flow(middle, time + 0.5 * step)
    np.savez(path, positions=series, phase=np.tile(phase, (frames, 1)), fps=RATE)
