"""A dam breaks, and its water goes round a pillar, which the skin does not enter.

Run: python3 obstacle.py [--output FOLDER]
"""

import numpy as np
from active_implicit_surfaces import vtkActiveImplicitSurface
from film_strip import CLAY, output_folder, skin_actor, write_film_strip
from fluid_scenes import RATE, lattice, shaken
from fluid_solver import Fluid
from particle_series import ParticleSeries
from vtkmodules.vtkCommonDataModel import vtkCylinder, vtkDataObject
from vtkmodules.vtkFiltersCore import vtkTriangleFilter
from vtkmodules.vtkFiltersSources import vtkCylinderSource

SPACING, SIZE = 0.05, (2.0, 1.2, 0.9)
RADIUS, CENTER = 0.17, np.array([[1.2], [0.45]])  # of the pillar, x and z


class FluidRoundPillar(Fluid):
    def _stay_within(self, places):
        super()._stay_within(places)
        away = places[::2] - CENTER
        distance = np.sqrt((away * away).sum(axis=0))
        away *= np.maximum(RADIUS + 0.1 * self.spacing, distance) / distance
        places[::2] = CENTER + away


folder = output_folder(__doc__)
fluid, frames = FluidRoundPillar(SPACING, SIZE, cohesion=3.0), []
fluid.add(shaken(lattice((0, 0, 0), (0.7, 0.8, SIZE[2]), SPACING), 0.005, 1), (0, 0, 0))
for _ in range(24):
    frames.append(fluid.frame())
    fluid.advance(1 / RATE)

pillar, picture = vtkCylinder(), vtkCylinderSource()
for cylinder in (pillar, picture):
    cylinder.SetRadius(RADIUS)
    cylinder.SetCenter(CENTER[0, 0], SIZE[1] / 2, CENTER[1, 0])
picture.SetHeight(SIZE[1])
picture.SetResolution(64)
triangles = vtkTriangleFilter()
triangles.SetInputConnection(picture.GetOutputPort())
triangles.Update()

series, surface, moments = ParticleSeries(frames, RATE), vtkActiveImplicitSurface(), []
surface.SetInputConnection(series.GetOutputPort())
surface.SetInputArrayToProcess(1, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "id")
surface.SetParticleSpacing(SPACING)
surface.SetObstacleFunction(pillar)
for step in range(len(frames)):
    surface.UpdateTimeStep(step / RATE)
    if step in (2, 9, 14, 22):
        moments.append([skin_actor(surface.GetOutput()), skin_actor(triangles.GetOutput(), CLAY)])
write_film_strip(folder / "obstacle.png", moments, view=(0.5, 0.5, 1), width=2000, floor=0)
print(f"wrote {folder / 'obstacle.png'}")
