"""Grains fall on a moving skin and bounce off; the skin's function gives distances to the skin.

Run: python3 collisions.py [--output FOLDER]
"""

import numpy as np
from active_implicit_surfaces import LiveSurface
from film_strip import CLAY, ball_actor, output_folder, skin_actor, write_film_strip
from fluid_scenes import ball
from particle_series import make_particles
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray

RATE, FRAMES, GRAIN, SPACING, SUBSTEPS = 25, 34, 0.016, 0.08, 4
LUMPS = np.array([[-0.55, 0.22, 0.1], [0.0, 0.3, -0.15], [0.5, 0.2, 0.2]])
RADII, PHASES = (0.3, 0.36, 0.26), np.array([0.0, 2.1, 4.2])


def body_at(time):
    """Returns the particles, at a time, of three lumps that move up and down."""
    lifts = 0.08 * np.sin(5 * time + PHASES)
    lumps = zip(LUMPS, RADII, lifts)
    return np.concatenate([ball(r, SPACING) + place + (0, lift, 0) for place, r, lift in lumps])


def distance(function, places):
    result = vtkDoubleArray()
    function.EvaluateFunction(numpy_to_vtk(np.ascontiguousarray(places)), result)
    return vtk_to_numpy(result).copy()


def bounce(function, places, velocities):
    """Moves grains out of the skin along its normal, and reflects their velocity."""
    hits = np.flatnonzero(distance(function, places) < GRAIN)
    near, step = places[hits], 0.3 * SPACING
    slopes = [distance(function, near + d) - distance(function, near - d) for d in step * np.eye(3)]
    normals = np.stack(slopes, axis=1)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True) + 1e-9
    places[hits] += normals * (GRAIN - distance(function, near))[:, None]
    speeds = np.minimum((velocities[hits] * normals).sum(axis=1), 0)
    velocities[hits] -= 1.15 * normals * speeds[:, None]


random = np.random.default_rng(1)
grains = random.uniform((-0.8, 0.8, -0.4), (0.7, 2.6, 0.4), (3000, 3))
velocities, moments, live = np.zeros_like(grains), [], LiveSurface(particle_spacing=SPACING)
folder, dt = output_folder(__doc__), 1 / RATE / SUBSTEPS
for frame in range(FRAMES):
    skin = live.advance(body_at(frame / RATE), 1 / RATE)
    for _ in range(SUBSTEPS):
        velocities[:, 1] -= 9.81 * dt
        grains += dt * velocities
        bounce(live.surface.GetSkinFunction(), grains, velocities)
        velocities[grains[:, 1] < GRAIN] *= 0.6
        np.clip(grains, (-1.25, GRAIN, -0.9), (1.2, 9, 0.9), out=grains)
    if frame in (14, 22, 33):
        moments.append([skin_actor(skin), ball_actor(make_particles(grains), GRAIN, CLAY)])
write_film_strip(folder / "collisions.png", moments, view=(0.3, 0.5, 1), width=2000, floor=0)
