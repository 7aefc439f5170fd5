"""A small fluid: particles in a box, by position-based dynamics (Macklin and Muller 2013) in numpy.

The solver makes scenes to coat, and is not for physics: the only viscosity is that of the scheme,
cohesion just holds drops and sheets together, and walls have no friction. y is up. The solver uses
only sums, products, quotients and roots, in a fixed order, so the particles are the same on any
machine.
"""

import numpy as np

GRAVITY = (0.0, -9.81, 0.0)
SUPPORT = 2.0  # support radius of a particle, in spacings
# Density of the interior relative to that of a cubic lattice. With this ratio, a settled pool of N
# particles fills the volume N spacing^3.
REST = 0.963
ITERATIONS = 4
SOFTNESS = 0.05  # of a constraint, relative to the stiffness within a lattice
# Factor of the density behind a wall. With this factor, a wall half a spacing away counts as much
# as the next layer of a lattice.
WALL = 0.63
XSPH = 0.03  # fraction of the neighbours' mean velocity that a particle adopts in each substep
COURANT = 0.4  # spacings that the fastest particle moves in a substep
LONGEST = 0.008  # seconds of a substep, limited by the cohesion


class Fluid:
    """Particles in a box that is open above and has its corner at the origin."""

    def __init__(self, spacing, size, cohesion=0.0):
        self.spacing, self.size, self.cohesion = spacing, np.array(size, float), cohesion
        self.support = SUPPORT * spacing
        self.places = np.empty((3, 0))  # a row for each axis
        self.velocities = np.empty((3, 0))
        self.ids = np.empty(0, np.int64)
        self.next_id = 0
        self.rest_density, self.lattice_stiffness = _lattice(spacing, self.support)
        self.rest_density *= REST

    def add(self, places, velocity):
        """Adds particles; returns their ids. `velocity` is one vector for all, or one for each."""
        count = len(places)
        velocities = np.broadcast_to(np.asarray(velocity, float), (count, 3))
        ids = np.arange(self.next_id, self.next_id + count)
        self.next_id += count
        self.places = np.concatenate([self.places, np.asarray(places, float).T], axis=1)
        self.velocities = np.concatenate([self.velocities, velocities.T], axis=1)
        self.ids = np.concatenate([self.ids, ids])
        return ids

    def keep(self, chosen):
        self.places = self.places[:, chosen]
        self.velocities = self.velocities[:, chosen]
        self.ids = self.ids[chosen]

    def advance(self, seconds, gravity=GRAVITY, damping=0.0):
        """Advances by `seconds`, in equal substeps. `gravity` is a vector or, for a shaken box, a
        function of the time since the start of this call."""
        speed = np.sqrt(_squared(self.velocities).max(initial=0.0)) + 9.81 * seconds
        substeps = int(np.ceil(seconds * max(speed / (COURANT * self.spacing), 1.0 / LONGEST)))
        for substep in range(substeps):
            pull = gravity(substep * seconds / substeps) if callable(gravity) else gravity
            self._substep(seconds / substeps, np.array(pull, float)[:, None])
            self.velocities *= 1.0 - damping

    def frame(self):
        """Returns positions [n, 3], velocities [n, 3] and ids [n], in the order of the ids."""
        order = np.argsort(self.ids, kind="stable")
        places, velocities = self.places[:, order].T, self.velocities[:, order].T
        return places.astype(np.float32), velocities.astype(np.float32), self.ids[order]

    def _substep(self, seconds, pull):
        self.keep(np.argsort(_cells(self.places, self.support)[0], kind="stable"))
        self.velocities += seconds * pull
        moved = self.places + seconds * self.velocities
        self._stay_within(moved)
        pairs = pairs_within(moved, self.support)
        if self.cohesion:
            moved += seconds * seconds * self._cohere(moved, pairs)
        for _ in range(ITERATIONS):
            moved += self._corrections(moved, pairs)
            self._stay_within(moved)
        self.velocities = (moved - self.places) / seconds
        self.places = moved
        self._share_velocities(pairs)

    def _stay_within(self, places):
        margin = 0.1 * self.spacing
        for axis, size in enumerate(self.size):
            top = np.inf if axis == 1 else size - margin
            np.clip(places[axis], margin, top, out=places[axis])

    def _apart(self, places, pairs):
        """Returns for each pair the unit vector from second to first particle, and 1 - distance /
        support, or 0 if this is negative."""
        apart = np.take(places, pairs[0], 1) - np.take(places, pairs[1], 1)
        length = np.sqrt(_squared(apart)) + 1e-9 * self.spacing
        return apart / length, np.maximum(1.0 - length / self.support, 0.0)

    def _corrections(self, places, pairs):
        """Returns displacements by the excess density of each particle and of its neighbours."""
        first, second = pairs
        count = places.shape[1]
        direction, w = self._apart(places, pairs)
        share = w * w * w / self.rest_density
        density = (1.0 / self.rest_density) + _gather(first, second, share, count)
        wall, wall_gradient = self._walls(places)
        excess = np.maximum(density + wall - 1.0, 0.0)
        slope = -3.0 * w * w / (self.support * self.rest_density)
        gradient = wall_gradient.copy()
        for axis in range(3):
            gradient[axis] += _gather(first, second, slope * direction[axis], count, -1)
        stiffness = _squared(gradient) + _gather(first, second, slope * slope, count)
        strength = -excess / (stiffness + SOFTNESS * self.lattice_stiffness)
        both = slope * (np.take(strength, first) + np.take(strength, second))
        moves = strength * wall_gradient
        for axis in range(3):
            moves[axis] += _gather(first, second, both * direction[axis], count, -1)
        return moves

    def _walls(self, places):
        """Returns the density that is missing behind floor and sides, and its gradient.

        The half space behind a plane at a distance d contains the fraction (3 w^5 - 2 w^6) / 2 of
        the kernel (1 - q)^3, w = 1 - d / support; planes at right angles cut independently.
        """
        free, slopes = np.ones_like(places), np.zeros_like(places)
        for axis, size in enumerate(self.size):
            sides = (places[axis],) if axis == 1 else (places[axis], size - places[axis])
            for sign, distance in zip((-1.0, 1.0), sides):
                w = np.clip(1.0 - distance / self.support, 0.0, 1.0)
                half = 0.5 * WALL * (w * w) * (w * w)
                free[axis] -= half * w * (3.0 - 2.0 * w)
                slopes[axis] += sign * half * (15.0 - 12.0 * w) / self.support
        slopes[0] *= free[1] * free[2]
        slopes[1] *= free[2] * free[0]
        slopes[2] *= free[0] * free[1]
        return 1.0 - free[0] * free[1] * free[2], slopes

    def _cohere(self, places, pairs):
        """Returns accelerations by neighbours: repulsive at less than one spacing, attractive from
        1 to 1.6 spacings."""
        direction, w = self._apart(places, pairs)
        distance = SUPPORT * (1.0 - w)  # in spacings
        force = self.cohesion * (distance - 1.0) * np.maximum(1.6 - distance, 0.0) / 0.09
        return np.stack([-_gather(*pairs, force * d, places.shape[1], -1) for d in direction])

    def _share_velocities(self, pairs):
        w = self._apart(self.places, pairs)[1]
        share = w * w * w / self.rest_density
        difference = np.take(self.velocities, pairs[0], 1) - np.take(self.velocities, pairs[1], 1)
        for axis in range(3):
            change = _gather(*pairs, share * difference[axis], self.places.shape[1], -1)
            self.velocities[axis] -= XSPH * change


def pairs_within(places, reach):
    """Returns the indices of all pairs nearer than `reach`; `places` has a row for each axis."""
    cells, row, layer = _cells(places, reach)
    order = np.argsort(cells, kind="stable")
    cells, sorted_places = cells[order], np.take(places, order, axis=1)
    here = np.arange(len(cells))
    firsts, seconds = [], []
    # Three adjacent cells of a row are a range of the sorted particles. The search covers only
    # later particles, so it finds each pair once.
    for step in (0, row, layer - row, layer, layer + row):
        begin = here + 1 if step == 0 else np.searchsorted(cells, cells + step - 1, "left")
        count = np.searchsorted(cells, cells + step + 1, "right") - begin
        first = np.repeat(here, count)
        second = np.arange(len(first)) + np.repeat(begin - (np.cumsum(count) - count), count)
        apart = np.take(sorted_places, first, 1) - np.take(sorted_places, second, 1)
        near = np.flatnonzero(_squared(apart) < reach * reach)
        firsts.append(order[first[near]])
        seconds.append(order[second[near]])
    return np.concatenate(firsts), np.concatenate(seconds)


def _cells(places, width):
    """Returns the number of each particle's cell, and the offsets of the next row and layer."""
    index = np.floor(places / width).astype(np.int64)
    index -= index.min(axis=1, keepdims=True) - 1
    row, layer, _ = index.max(axis=1) + 2
    return index[0] + row * (index[1] + layer * index[2]), row, row * layer


def _squared(vectors):
    return vectors[0] * vectors[0] + vectors[1] * vectors[1] + vectors[2] * vectors[2]


def _gather(first, second, values, count, sign=1):
    """Returns the sum of `values` over the pairs of each particle.

    With a negative `sign`, the second particle of a pair gets the opposite value.
    """
    firsts = np.bincount(first, values, count)
    seconds = np.bincount(second, values, count)
    return firsts + seconds if sign > 0 else firsts - seconds


def _lattice(spacing, support):
    """Returns density and stiffness of a constraint in a cubic lattice, by the kernel (1 - q)^3."""
    steps = np.arange(-2.0, 3.0)
    x, y, z = np.meshgrid(steps, steps, steps)
    w = np.maximum(1.0 - spacing * np.sqrt(x * x + y * y + z * z).ravel() / support, 0.0)
    density = (w * w * w).sum()
    slope = 3.0 * w[w < 1] ** 2 / (support * density)
    return density, (slope * slope).sum()
