"""Common scenes of the tests: the splash of particles, and the two metamorphoses of the paper."""

import math
from pathlib import Path

from active_implicit_surfaces import vtkActiveImplicitSurface, vtkSkeletonPotential
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkImplicitBoolean, vtkPolyData, vtkSphere
from vtkmodules.vtkFiltersSources import vtkLineSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

DATA = Path(__file__).resolve().parents[1] / "Data"
STEPS = 41
VOXEL = 0.03
PARTICLE_SPACING = 0.085


def splash():
    """The reader of the particles, steps 0 to 40, and the skin over them."""
    particles = vtkXMLPolyDataReader()
    particles.SetFileName(str(DATA / "sph_drop.vtp"))
    surface = vtkActiveImplicitSurface()
    surface.SetInputConnection(particles.GetOutputPort())
    surface.SetTimeScale(1 / 25)
    surface.SetVoxelSize(VOXEL)
    surface.SetParticleSpacing(PARTICLE_SPACING)
    surface.SetAttraction(100)
    return particles, surface


def tube_to_box():
    """A bent tube that becomes a box, times 0 to 3 (Figure 5 of the paper)."""
    corners = vtkPoints()
    for i in range(17):
        angle = math.pi * (i / 8 - 1)
        corners.InsertNextPoint(0.1 * i - 0.8, 0.4 * math.sin(angle), 0.25 * math.cos(angle))
    line = vtkLineSource()
    line.SetPoints(corners)
    line.Update()
    tube = vtkSkeletonPotential()
    tube.SetInput(line.GetOutput())
    tube.SetRadius(0.45)
    from vtkmodules.vtkCommonDataModel import vtkSuperquadric  # missing in some builds of VTK

    box = vtkSuperquadric()
    box.SetSize(1.0)
    box.SetScale(0.75, 0.5, 0.5)
    box.SetPhiRoundness(0.3)
    box.SetThetaRoundness(0.3)
    return morph(tube, box)


def star_to_balls():
    """A star of six points that becomes two balls apart, times 0 to 3 (Figure 6 of the paper)."""
    points = vtkPoints()
    for axis in range(3):
        for side in (-0.63, 0.63):
            points.InsertNextPoint([side if axis == i else 0.0 for i in range(3)])
    skeleton = vtkPolyData()
    skeleton.SetPoints(points)
    star = vtkSkeletonPotential()
    star.SetInput(skeleton)
    star.SetRadius(0.9)
    balls = vtkImplicitBoolean()
    balls.SetOperationTypeToUnion()
    for x in (-0.6, 0.6):
        ball = vtkSphere()
        ball.SetCenter(x, 0.0, 0.0)
        ball.SetRadius(0.45)
        balls.AddFunction(ball)
    return morph(star, balls)


def morph(start, end):
    surface = vtkActiveImplicitSurface()
    surface.SetModelBounds(-1.25, 1.25, -1.25, 1.25, -1.25, 1.25)
    surface.SetVoxelSize(2.5 / 50)
    surface.SetInitialFunction(start)
    surface.SetTargetFunction(end)
    surface.SetAttraction(2)
    surface.SetTension(0.01)
    surface.SetTimeStepSize(0.1)
    surface.SetNumberOfTimeSteps(31)
    return surface
