"""The presets: a noisy pool with `viscous` and `paper`, and a pile of grains with `grains`.

Each picture begins with the skin that has no preset.

Run: python3 presets.py [--output FOLDER]
"""

import active_implicit_surfaces as active
import numpy as np
from film_strip import CLAY, output_folder, skin_actor, write_film_strip
from grain_pile import make_pile
from vtkmodules.vtkCommonDataModel import vtkBox
from vtkmodules.vtkFiltersCore import vtkClipPolyData

SPACING, FRAMES = 0.1, 4
NOISE = 0.4 * SPACING  # 0.8 r
LENGTHS = {"particle_spacing": SPACING, "voxel_size": 0.4 * SPACING}
SHOWN = (0.6, 2.6, 0.36, 9, 0.7, 1.8)  # the top, without the edges


def noisy_pool():
    """Returns frames of a pool that moves along x, with a wave and random displacements."""
    axes = [SPACING * np.arange(count) for count in (34, 6, 26)]
    places = np.stack(np.meshgrid(*axes), -1).reshape(-1, 3)
    places[:, 1] *= 1 + 0.2 * np.cos(2.4 * places[:, 0])
    places += np.random.default_rng(1).normal(0, NOISE, places.shape)
    return [places + [0.1 * SPACING * step, 0, 0] for step in range(FRAMES)]


def top_of(skin):
    box, clip = vtkBox(), vtkClipPolyData()
    box.SetBounds(SHOWN)
    clip.SetInputData(skin)
    clip.SetClipFunction(box)
    clip.InsideOutOn()
    clip.Update()
    return clip.GetOutput()


folder, strip = output_folder(__doc__), []
for options in ({}, {"preset": "viscous"}, {"preset": "paper"}):
    *_, (_, skin) = active.frames(noisy_pool(), fps=25, **LENGTHS, **options)
    strip.append([skin_actor(top_of(skin))])
write_film_strip(folder / "parameters_preset.png", strip, view=(0.2, 0.6, 1), width=2000)
centers, radii = make_pile(300)
spacing = 2 * float(np.median(radii))
strip = [
    [skin_actor(active.skin(centers, particle_spacing=spacing), CLAY)],
    [skin_actor(active.skin(centers, preset="grains", radii=radii), CLAY)],
]
write_film_strip(folder / "grains.png", strip, view=(0.4, 0.5, 1), width=1600, floor=0)
print(f"wrote {folder / 'parameters_preset.png'} and {folder / 'grains.png'}")
