"""Drops that touch become one drop under tension; VolumeControl (upper row) keeps their volume.

Run: python3 constant_volume.py [--output FOLDER]
"""

import math

from active_implicit_surfaces import vtkActiveImplicitSurface
from film_strip import CLAY, WATER, output_folder, skin_actor, write_film_strip
from vtkmodules.vtkCommonDataModel import vtkImplicitBoolean, vtkSphere

TIMES = (0.0, 0.1, 0.25, 0.4)

drops = vtkImplicitBoolean()
for i in range(5):
    ball = vtkSphere()
    ball.SetCenter(0.5 * math.cos(0.4 * math.pi * i), 0, 0.5 * math.sin(0.4 * math.pi * i))
    ball.SetRadius(0.32)
    drops.AddFunction(ball)

folder, rows = output_folder(__doc__), []
for control, color in (("EXACT", WATER), ("NONE", CLAY)):
    surface = vtkActiveImplicitSurface()
    surface.SetModelBounds(-1, 1, -0.6, 0.6, -1, 1)
    surface.SetVoxelSize(0.04)
    surface.SetTargetFunction(drops)
    surface.SetInitialFunction(drops)
    surface.SetAttraction(0)
    surface.SetTension(0.08)
    surface.SetVolumeControl(getattr(surface, control))
    rows.append([])
    for time in TIMES:
        surface.UpdateTimeStep(time)
        rows[-1].append([skin_actor(surface.GetOutput(), color)])
    history = surface.GetHistory()
    volumes = [history.GetValueByName(row, "Volume").ToDouble() for row in (0, 4)]
    print(f"{control}: volume {volumes[0]:.6f} at 0, {volumes[1]:.6f} at 0.4", flush=True)
write_film_strip(folder / "constant_volume.png", *rows, view=(0.3, 0.9, 1))
print(f"wrote {folder / 'constant_volume.png'}")
