"""A pile of grains for presets.py: each grain falls, and rolls down to where it rests."""

import numpy as np

STEP, DIRECTIONS = 0.1, 12  # of the rolling: part of a radius, and number


def heights(points, own, centers, radii):
    """Returns the height at which a grain of radius `own` rests, for each of the points (x, z)."""
    reach = (own + radii) ** 2 - ((points[:, None] - centers[:, [0, 2]]) ** 2).sum(axis=2)
    resting = np.where(reach > 0, centers[:, 1] + np.sqrt(np.maximum(reach, 0)), own)
    return np.max(resting, axis=1, initial=own)


def make_pile(count, seed=0, width=4.0):
    """Returns centers and radii of grains that fall one after another, near the origin."""
    random = np.random.default_rng(seed)
    angles = 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
    around = STEP * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    centers, radii = np.empty((0, 3)), np.empty(0)
    for own in random.uniform(0.7, 1.3, count):
        point = random.normal(0, width, 2)
        height = heights(point[None], own, centers, radii)[0]
        while True:
            near = point + own * around
            found = heights(near, own, centers, radii)
            best = int(np.argmin(found))
            if found[best] >= height - 1e-3 * own:
                break
            point, height = near[best], found[best]
        centers = np.vstack([centers, [point[0], height, point[1]]])
        radii = np.append(radii, own)
    return centers, radii
