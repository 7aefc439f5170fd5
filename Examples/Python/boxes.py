"""Walls and periodic sides: water in a box, without and with the filter's properties for each.

The first picture, of walls, is seen from below. The second picture shows each skin and, in the next
box, a copy of the skin: with PeriodicBounds, wave and drop continue through the side.

Run: python3 boxes.py [--output FOLDER]
"""

import active_implicit_surfaces as active
import numpy as np
from film_strip import CLAY, output_folder, skin_actor, write_film_strip
from vtkmodules.util.numpy_support import vtk_to_numpy

SIDE, DEPTH, SPACING = 2.0, 0.6, 0.1
BOX = (0, SIDE, 0, 9, 0, SIDE)  # open above
PERIODIC = (0, SIDE, 1, -1, 1, -1)  # along x


def water():
    """Returns the particles of a layer with waves, and those of a drop across the box's side."""
    x, y, z = (np.arange(0.5 * SPACING, end, SPACING) for end in (SIDE, DEPTH, SIDE))
    places = np.stack(np.meshgrid(x, y, z), -1).reshape(-1, 3)
    phases = 2 * np.pi / SIDE * places
    wave = 0.16 * np.sin(phases[:, 0] + 0.6) + 0.08 * np.cos(phases[:, 2])
    places[:, 1] += wave * places[:, 1] / DEPTH
    places += np.random.default_rng(3).uniform(-0.02, 0.02, places.shape)
    places[:, 1] = np.maximum(places[:, 1], 0.4 * SPACING)
    ball = np.stack(np.meshgrid(*3 * [np.arange(-3, 4) * SPACING]), -1).reshape(-1, 3)
    drop = ball[np.linalg.norm(ball, axis=1) < 0.29] + [SIDE, 1.3, 0.6 * SIDE]
    return places, drop % [SIDE, 9, SIDE]


folder, (layer, drop) = output_folder(__doc__), water()
strip = []
for options in ({}, {"model_bounds": BOX, "bounded_domain": True}):
    strip.append([skin_actor(active.skin(layer, particle_spacing=SPACING, **options))])
write_film_strip(folder / "parameters_walls.png", strip, view=(0.4, -0.7, 1), width=1600)
strip, both = [], np.vstack([layer, drop])
for options in ({}, {"periodic_bounds": PERIODIC}):
    skin = active.skin(both, particle_spacing=SPACING, voxel_size=0.2 * SPACING, **options)
    strip.append([skin_actor(skin)])
    vtk_to_numpy(skin.GetPoints().GetData())[:, 0] += SIDE
    strip[-1].append(skin_actor(skin, CLAY))
write_film_strip(folder / "periodic.png", strip, view=(0.1, 0.45, 1), width=2000)
print(f"wrote {folder / 'parameters_walls.png'} and {folder / 'periodic.png'}")
