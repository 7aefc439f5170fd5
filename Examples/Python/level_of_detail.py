"""A body has 400 particles, then 50, then 400 again; the skin of the body does not jump.

Run: python3 level_of_detail.py [--output FOLDER]
"""

import active_implicit_surfaces as active
import numpy as np
from active_implicit_surfaces.data_objects import as_particles
from film_strip import ball_actor, output_folder, skin_actor, write_film_strip
from fluid_scenes import RATE, lattice, shaken

VOLUME = 4 / 3 * np.pi * 0.5**3
FINE, COARSE, CHANGE, BACK, FRAMES = 400, 50, 4, 14, 25
SHOWN = (3, 5, 13, 15, 24)
RADIUS = 0.55  # of a particle [spacings]: with sums of kernels, the skin has the body's volume


def body(count):
    """Returns `count` particles, each with the same part of the body's volume."""
    spacing = np.cbrt(VOLUME / count)
    places = shaken(lattice((-10 * spacing,) * 3, (10 * spacing,) * 3, spacing), 0.15 * spacing, 2)
    nearest = np.argsort((places**2).sum(axis=1), kind="stable")[:count]
    ids = np.arange(count) + 1000 * (count == COARSE)  # no particle is in both bodies
    return as_particles(places[nearest], ids=ids, radii=np.full(count, RADIUS * spacing))


folder, balls, skins, volumes = output_folder(__doc__), [], [], []
series = [body(COARSE if CHANGE <= frame < BACK else FINE) for frame in range(FRAMES)]
frames = active.frames(
    series,
    fps=RATE,
    arrays={"radii": "radius"},
    particle_model="sum",
    voxel_size=0.04,
    attraction=10,  # the skin takes a tenth of a second to follow
    time_integration="explicit",
)
for frame, (_, skin) in enumerate(frames):
    if frame in SHOWN:
        cloud = series[frame]
        balls.append([ball_actor(cloud, 0.5 * np.cbrt(VOLUME / cloud.GetNumberOfPoints()))])
        skins.append([skin_actor(skin)])
table = frames.surface.GetHistory()
volumes = [table.GetValueByName(row, "Volume").ToDouble() for row in range(FRAMES)]
steps = np.abs(np.diff(volumes)) / volumes[0]
change = abs(volumes[BACK - 1] / volumes[0] - 1)
print(f"from {FINE} to {COARSE} particles the volume changes by {change:.1%},")
print(f"from one frame to the next by {steps.max():.1%} at most")
if max(change, steps.max()) > 0.05:
    raise SystemExit("the volume changes by more than 5 %")
write_film_strip(folder / "level_of_detail.png", balls, skins, view=(0.4, 0.4, 1))
