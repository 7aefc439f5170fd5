"""A star, the potential of a skeleton of six points, becomes two balls that do not touch.

Figure 6 of the paper: the surface splits by itself. Run: python3 morph_topology.py
"""

from active_implicit_surfaces import vtkActiveImplicitSurface, vtkSkeletonPotential
from film_strip import CLAY, output_folder, skin_actor, write_film_strip
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkImplicitBoolean, vtkPolyData, vtkSphere
from vtkmodules.vtkFiltersCore import vtkPolyDataConnectivityFilter

TIMES = (0.0, 0.3, 0.8, 1.8, 2.1, 3.0)


def make_surface():
    points = vtkPoints()
    for axis in range(3):
        for side in (-0.63, 0.63):
            points.InsertNextPoint([side if axis == i else 0.0 for i in range(3)])
    six_points = vtkPolyData()
    six_points.SetPoints(points)
    star = vtkSkeletonPotential()
    star.SetInput(six_points)
    star.SetRadius(0.9)
    balls = vtkImplicitBoolean()
    balls.SetOperationTypeToUnion()
    for x in (-0.6, 0.6):
        ball = vtkSphere()
        ball.SetCenter(x, 0.0, 0.0)
        ball.SetRadius(0.45)
        balls.AddFunction(ball)

    surface = vtkActiveImplicitSurface()
    surface.SetModelBounds(-1.25, 1.25, -1.25, 1.25, -1.25, 1.25)
    surface.SetVoxelSize(2.5 / 50)
    surface.SetInitialFunction(star)
    surface.SetTargetFunction(balls)
    surface.SetAttraction(2)
    surface.SetTension(0.01)
    surface.SetNumberOfTimeSteps(31)  # 0, 0.1 ... 3
    return surface


def main():
    folder, surface = output_folder(__doc__), make_surface()
    components = vtkPolyDataConnectivityFilter()
    components.SetExtractionModeToAllRegions()
    components.SetInputConnection(surface.GetOutputPort())
    frames = []
    for time in TIMES:
        components.UpdateTimeStep(time)
        print(f"at {time}: {components.GetNumberOfExtractedRegions()} piece(s)", flush=True)
        frames.append([skin_actor(surface.GetOutput(), CLAY)])
    write_film_strip(folder / "morph_topology.png", frames, floor=-1.2)
    print(f"wrote {folder / 'morph_topology.png'}")


if __name__ == "__main__":
    main()
