"""The colors of the particles on their skin: a drop of another color falls into a basin.

Run: python3 colors.py [--output FOLDER]
"""

from pathlib import Path

import active_implicit_surfaces as active
import numpy as np
from active_implicit_surfaces.data_objects import as_particles
from film_strip import ball_actor, colored, output_folder, skin_actor, write_film_strip
from vtkmodules.util.numpy_support import vtk_to_numpy

DATA = Path(__file__).resolve().parents[2] / "Testing" / "Data" / "sph_drop.vtp"
BASIN, DROP = (70, 150, 215), (240, 120, 60)

folder, balls, skins = output_folder(__doc__), [], []
source = active.ParticleSeries(DATA)
places = [vtk_to_numpy(source.frame(step).GetPoints().GetData()) for step in range(26)]
is_drop = places[0][:, 1] > 0.45
colors = np.where(is_drop[:, None], DROP, BASIN).astype(np.uint8)
ids = np.arange(len(colors))
series = [as_particles(points.copy(), ids=ids, Color=colors) for points in places]
options = {"particle_spacing": 0.1, "voxel_size": 0.03, "pass_target_arrays": True}
for frame, (_, skin) in enumerate(active.frames(series, fps=25, **options)):
    if frame in (4, 9, 14, 24):
        balls.append([colored(ball_actor(series[frame], 0.05), "Color")])
        skins.append([colored(skin_actor(skin), "Color")])
print(f"{is_drop.sum()} of {len(is_drop)} particles are the drop's")
write_film_strip(folder / "colors.png", balls, skins, view=(0.4, 0.5, 1), width=2000, floor=0)
print(f"wrote {folder / 'colors.png'}")
