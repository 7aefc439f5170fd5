"""Drops fall into a pool of 20,000 particles; rings and small drops go out from where they fall.

Run: python3 pool_with_drops.py [--output FOLDER]
"""

import active_implicit_surfaces as active
import numpy as np
from film_strip import output_folder, skin_actor, write_film_strip
from fluid_scenes import RATE, SPACING, ball, lattice, shaken
from particle_series import make_particles

WIDTH, DEPTH, FRAMES = 2.7, 0.35, 14
# Position (x, z) and time of each drop's impact.
DROPS = ((0.8, 0.9, -0.2), (1.95, 0.8, 0.02), (1.2, 2.0, 0.15), (2.2, 1.9, 0.38), (0.6, 1.9, 0.5))
REST = lattice((0, 0, 0), (WIDTH, DEPTH, WIDTH), SPACING)
POOL, DROP, SPLASH = shaken(REST, 0.005, 1), ball(0.14, SPACING), ball(0.055, SPACING)


def ring(age, distance):
    """Returns the height of the water, above still water, at a distance from a drop's impact."""
    way = distance - 1.2 * age
    grown = np.clip(age / 0.08, 0, 1)
    return 0.1 * grown * np.exp(-1.2 * age - (way / 0.2) ** 2) * np.cos(18 * way)


def parts_of(number, x, z, age):
    """Yields the falling drop and the droplets of its splash, each with its first id."""
    first = len(POOL) + 10000 * number
    if age < 0.02:
        yield DROP + (x, DEPTH + 0.1 - 3 * age - 4.9 * age**2, z), first
    for i, angle in enumerate(np.linspace(0, 2 * np.pi, 8)[:-1] + number):
        up, out = (1.9, 2.3, 1.6)[i % 3], (0.8, 0.65, 1.0)[i % 3]
        height = up * age - 4.9 * age**2
        if age > 0.06 and height > -0.05:
            reach = 0.2 + out * age
            place = (x + reach * np.cos(angle), DEPTH + height, z + reach * np.sin(angle))
            yield SPLASH + place, first + 1000 + 100 * i


def particles_at(time):
    height = sum(ring(time - t, np.hypot(POOL[:, 0] - x, POOL[:, 2] - z)) for x, z, t in DROPS)
    raised = POOL.copy()
    raised[:, 1] *= 1 + height / DEPTH
    parts = [(raised, 0)]
    for number, (x, z, start) in enumerate(DROPS):
        parts.extend(parts_of(number, x, z, time - start))
    ids = np.concatenate([first + np.arange(len(places)) for places, first in parts])
    return make_particles(np.concatenate([places for places, _ in parts]), ids=ids)


folder, moments = output_folder(__doc__), []
series = [particles_at(frame / RATE) for frame in range(FRAMES)]
options = {"particle_spacing": SPACING}
for time, skin in active.frames(series, fps=RATE, **options):
    frame = round(time * RATE)
    print(f"{series[frame].GetNumberOfPoints()} particles, {skin.GetNumberOfPolys()} triangles")
    if frame in (4, 13):
        moments.append([skin_actor(skin)])
write_film_strip(folder / "pool_with_drops.png", moments, view=(0.4, 0.5, 1), floor=0)
