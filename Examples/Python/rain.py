"""Rain on a pan: drops that appear in the air get skins, which merge with the skin of the water.

Run: python3 rain.py [--output FOLDER]
"""

from coat_scene import coat_scene
from film_strip import skin_actor
from fluid_scenes import ACROSS, SPACING
from vtkmodules.vtkFiltersCore import vtkAppendPolyData
from vtkmodules.vtkFiltersSources import vtkCubeSource

WIDTH, HEIGHT, WALL, GREY = ACROSS * SPACING, 0.16, 0.04, (0.45, 0.46, 0.5)


def pan():
    """Returns an actor of a floor and four walls around the water."""
    parts, low, high = vtkAppendPolyData(), -WALL, WIDTH + WALL
    for x, y, z in (
        ((low, high), (low, 0), (low, high)),
        ((low, 0), (0, HEIGHT), (low, high)),
        ((WIDTH, high), (0, HEIGHT), (low, high)),
        ((0, WIDTH), (0, HEIGHT), (low, 0)),
        ((0, WIDTH), (0, HEIGHT), (WIDTH, high)),
    ):
        part = vtkCubeSource()
        part.SetBounds(*x, *y, *z)
        part.Update()
        parts.AddInputData(part.GetOutput())
    parts.Update()
    return skin_actor(parts.GetOutput(), GREY)


coat_scene("rain", __doc__, pictured=(5, 9, 17, 29), solids=[pan()], floor=-WALL)
