"""The pictures of Filters/PARAMETERS.md: what each of the main properties does to a splash.

Run: python3 parameters.py [--output FOLDER]
"""

from pathlib import Path

import active_implicit_surfaces as active
import numpy as np
from active_implicit_surfaces.data_objects import as_particles
from film_strip import CLAY, ball_actor, output_folder, skin_actor, write_film_strip
from vtkmodules.util.numpy_support import vtk_to_numpy

DATA = Path(__file__).resolve().parents[2] / "Testing" / "Data" / "sph_drop.vtp"
FIRST, LAST, R, RATE = 21, 24, 0.05, 25
USUAL = {"particle_spacing": 2 * R, "voxel_size": 0.6 * R}
SMOOTH = 150 * R**2  # Attraction * r^2: Attraction is 6 for each frame
PLAIN = {"target_noise": 0}  # without other smoothing

STRIPS = {
    "spacing": [{"particle_spacing": spacing} for spacing in (0.07, 0.1, 0.15)],
    "model": [{"particle_model": name} for name in ("sum", "anisotropic")],
    "voxel": [{"voxel_size": voxels * R} for voxels in (2, 1, 0.5)],
    "attraction": [{"attraction": rate, "transport": 0} for rate in (5, 25, 150)],
    "tension": [{"tension": times * SMOOTH, **PLAIN} for times in (0, 2, 8)],
    "parts": [{"create_parts": choice} for choice in (False, True)],
}


def skin_of(series, **options):
    """Returns the skin of the last frame."""
    *_, (_, skin) = active.frames(series, fps=RATE, **{**USUAL, **options})
    return skin


def without_drops(step):
    """Returns the particles that are below 0.62 in the last frame; from the third frame on, all."""
    kept = np.flatnonzero(places[-1][:, 1] < (0.62 if step < 2 else np.inf))
    return as_particles(places[step][kept], ids=kept)


folder, source = output_folder(__doc__), active.ParticleSeries(DATA)
places = [vtk_to_numpy(source.frame(step).GetPoints().GetData()) for step in range(FIRST, LAST + 1)]
series = [as_particles(points, ids=np.arange(len(points))) for points in places]
balls = ball_actor(series[-1], 0.2 * R, CLAY)
for name, choices in STRIPS.items():
    shown = series if name != "parts" else [without_drops(step) for step in range(len(series))]
    strip = [[skin_actor(skin_of(shown, **options))] for options in choices]
    if name == "attraction":
        strip = [[*frame, balls] for frame in strip]
    picture = folder / f"parameters_{name}.png"
    write_film_strip(picture, strip, view=(0.4, 0.5, 1), width=1500, floor=0)
    print(f"wrote {picture}", flush=True)
