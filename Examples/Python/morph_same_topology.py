"""A bent tube, the potential of a skeleton of segments, becomes a box; both are one piece.

Figure 5 of the paper: a grid of 50^3, attraction 2. Run: python3 morph_same_topology.py
"""

import math

from active_implicit_surfaces import vtkActiveImplicitSurface, vtkSkeletonPotential
from film_strip import CLAY, output_folder, skin_actor, write_film_strip
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkSuperquadric
from vtkmodules.vtkFiltersCore import vtkMassProperties
from vtkmodules.vtkFiltersSources import vtkLineSource

TIMES = (0.0, 0.15, 0.3, 0.6, 3.0)


def make_surface():
    corners = vtkPoints()
    for i in range(17):
        angle = math.pi * (i / 8 - 1)
        corners.InsertNextPoint(0.1 * i - 0.8, 0.4 * math.sin(angle), 0.25 * math.cos(angle))
    line = vtkLineSource()
    line.SetPoints(corners)
    tube = vtkSkeletonPotential()
    tube.SetInputConnection(line.GetOutputPort())
    tube.SetRadius(0.45)
    box = vtkSuperquadric()
    box.SetScale(0.75, 0.5, 0.5)
    box.SetSize(1.0)
    box.SetPhiRoundness(0.3)
    box.SetThetaRoundness(0.3)

    surface = vtkActiveImplicitSurface()
    surface.SetModelBounds(-1.25, 1.25, -1.25, 1.25, -1.25, 1.25)
    surface.SetVoxelSize(2.5 / 50)
    surface.SetInitialFunction(tube)
    surface.SetTargetFunction(box)
    surface.SetAttraction(2)
    surface.SetTension(0.01)
    surface.SetNumberOfTimeSteps(31)  # 0, 0.1 ... 3
    return surface


def main():
    folder, surface = output_folder(__doc__), make_surface()
    volume = vtkMassProperties()
    frames = []
    for time in TIMES:
        surface.UpdateTimeStep(time)
        volume.SetInputData(surface.GetOutput())
        print(f"at {time}: volume {volume.GetVolume():.3f}", flush=True)
        frames.append([skin_actor(surface.GetOutput(), CLAY)])
    write_film_strip(folder / "morph_same_topology.png", frames, floor=-0.7)
    print(f"wrote {folder / 'morph_same_topology.png'}")


if __name__ == "__main__":
    main()
