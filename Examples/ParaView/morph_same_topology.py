"""A bent tube, the potential of a skeleton, becomes a box: two implicit functions in ParaView.

Figure 5 of the paper: a grid of 50^3, attraction 2, tension 0.01.
Run: pvbatch morph_same_topology.py [--output DIR]
"""

import math

from moments import output_folder, print_history, save_moments
from paraview.simple import ActiveImplicitSurfaceFunctions, PolyLineSource

corners = []
for i in range(17):
    angle = math.pi * (i / 8 - 1)
    corners += [0.1 * i - 0.8, 0.4 * math.sin(angle), 0.25 * math.cos(angle)]
line = PolyLineSource(Points=corners)

folder = output_folder(__doc__)
surface = ActiveImplicitSurfaceFunctions(
    InitialFunction="Skeleton Potential",
    TargetFunction="Superquadric",
    ModelBounds=[-1.25, 1.25, -1.25, 1.25, -1.25, 1.25],
    VoxelSize=2.5 / 50,
    Attraction=2,
    Tension=0.01,
    TimeStepSize=0.1,
    NumberOfTimeSteps=31,
)
tube, box = surface.InitialFunction, surface.TargetFunction
tube.Input = line
tube.Radius = 0.45
box.Scale = [0.75, 0.5, 0.5]
box.Size = 1.0
box.PhiRoundness = box.ThetaRoundness = 0.3

save_moments(surface, (0.0, 0.15, 0.3, 0.6, 3.0), folder / "pv_morph_same_topology.png")
print_history(surface, "Volume", every=5)
