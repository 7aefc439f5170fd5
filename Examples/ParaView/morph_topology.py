"""A star, the potential of six points, becomes two balls that do not touch.

Figure 6 of the paper: the surface splits by itself. Run: pvbatch morph_topology.py [--output DIR]
"""

from moments import output_folder, print_history, save_moments
from paraview.simple import ActiveImplicitSurfaceFunctions, PolyPointSource

star_points = [
    side if axis == i else 0 for axis in range(3) for side in (-0.63, 0.63) for i in range(3)
]

folder = output_folder(__doc__)
surface = ActiveImplicitSurfaceFunctions(
    InitialFunction="Skeleton Potential",
    TargetFunction="Skeleton Potential",
    ModelBounds=[-1.25, 1.25, -1.25, 1.25, -1.25, 1.25],
    VoxelSize=2.5 / 50,
    Attraction=2,
    Tension=0.01,
    TimeStepSize=0.1,
    NumberOfTimeSteps=31,
)
star, balls = surface.InitialFunction, surface.TargetFunction
star.Input = PolyPointSource(Points=star_points)
star.Radius = 0.9
# The points are so far apart that they do not influence each other. They become balls of radius
# 0.45, as (1 - 0.75^2)^3 = 0.0837.
balls.Input = PolyPointSource(Points=[-0.6, 0, 0, 0.6, 0, 0])
balls.Radius = 0.6
balls.Threshold = (1 - 0.75**2) ** 3

save_moments(surface, (0.0, 0.1, 0.2, 0.3, 0.4, 1.0), folder / "pv_morph_topology.png")
print_history(surface, "Components", every=5)
