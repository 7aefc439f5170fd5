"""Small and cheap surfaces for tests with absurd values."""

from active_implicit_surfaces import (
    vtkActiveImplicitSurface,
)
from same_bytes_shapes import ball
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersSources import vtkLineSource, vtkPlaneSource, vtkSphereSource
from vtkmodules.vtkImagingHybrid import vtkSampleFunction

VOXEL = 1 / 12


def make_surface():
    surface = vtkActiveImplicitSurface()
    surface.SetVoxelSize(VOXEL)
    surface.SetAttraction(4)
    surface.SetNumberOfThreads(1)
    surface.SetMaximumNumberOfActiveVoxels(100000)
    surface.SetMaximumNumberOfSubsteps(20)
    surface.OutputPotentialOn()
    return surface


def ball_to_ball():
    surface = make_surface()
    surface.SetModelBounds(-1, 1, -1, 1, -1, 1)
    surface.SetInitialFunction(ball(0.45))
    surface.SetTargetFunction(ball(0.6))
    return surface


def penalties():
    surface = ball_to_ball()
    surface.SetTension(0.01)
    surface.SetVolumeControlToPenalty()
    surface.SetAreaControlToPenalty()
    return surface


def exact_volume():
    surface = ball_to_ball()
    surface.SetVolumeControlToExact()
    return surface


def exact_area():
    surface = ball_to_ball()
    surface.SetAreaControlToExact()
    return surface


def to_rest():
    surface = ball_to_ball()
    surface.SetEvolutionModeToEquilibrium()
    return surface


def penalties_to_rest():
    surface = penalties()
    surface.SetEvolutionModeToEquilibrium()
    return surface


def tension_to_rest():
    surface = to_rest()
    surface.SetAttraction(0)
    surface.SetTension(0.01)
    return surface


def paper():
    surface = ball_to_ball()
    surface.PaperFaithful()
    return surface


def paper_to_rest():
    surface = to_rest()
    surface.PaperFaithful()
    return surface


def raw():
    surface = ball_to_ball()
    surface.NormalizeTargetOff()
    return surface


def at_nodes():
    surface = ball_to_ball()
    surface.SetTargetEvaluationToNode()
    return surface


def in_a_box():
    surface = ball_to_ball()
    surface.SetModelBounds(-0.5, 0.5, -1, 1, -1, 1)
    surface.BoundedDomainOn()
    return surface


def particles():
    points = vtkPoints()
    for x in (-0.2, 0.2):
        points.InsertNextPoint(x, 0, 0)
    data = vtkPolyData()
    data.SetPoints(points)
    surface = make_surface()
    surface.SetInputData(data)
    surface.SetKernelRadius(0.8)
    return surface


def skeleton():
    source = vtkLineSource()
    surface = make_surface()
    surface.SetInputConnection(source.GetOutputPort())
    surface.SetKernelRadius(0.8)
    return surface


def mesh():
    source = vtkSphereSource()
    surface = make_surface()
    surface.SetInputConnection(source.GetOutputPort())
    return surface


def open_mesh():
    source = vtkPlaneSource()
    surface = make_surface()
    surface.SetInputConnection(source.GetOutputPort())
    surface.SetMeshThickness(0.3)
    return surface


def make_image():
    sample = vtkSampleFunction()
    sample.SetImplicitFunction(ball(0.6))
    sample.SetModelBounds(-1, 1, -1, 1, -1, 1)
    sample.SetSampleDimensions(20, 20, 20)
    return sample


def image():
    sample = make_image()
    surface = make_surface()
    surface.SetInputConnection(sample.GetOutputPort())
    return surface


# Properties that have a larger or another effect in these scenes than in the first one.
SCENES = {
    penalties: "Tension AreaStiffness VolumeStiffness TargetArea TargetVolume CFL",
    exact_volume: "Tension TargetVolume VolumeControl AreaControl",
    exact_area: "Tension TargetArea",
    to_rest: "Attraction CFL RestTolerance MaximumNumberOfSubsteps TimeScale StartTime",
    penalties_to_rest: "AreaStiffness VolumeStiffness TargetArea TargetVolume",
    tension_to_rest: "Attraction Tension CFL TimeScale",
    paper: "Attraction Tension CFL NormalizeTarget",
    paper_to_rest: "Attraction Tension CFL",
    raw: "Attraction TargetIsoValue",
    at_nodes: "Attraction TargetIsoValue TargetReach",
    in_a_box: "Attraction TargetIsoValue VoxelSize",
    particles: "KernelRadius ParticleSpacing Anisotropy VoxelSize TargetIsoValue",
    skeleton: "KernelRadius ParticleThreshold ParticleKernel VoxelSize TargetIsoValue",
    mesh: "MeshThickness TargetReach TargetIsoValue",
    open_mesh: "MeshThickness TargetReach TargetIsoValue VoxelSize",
    image: "TargetIsoValue TargetReach VoxelSize",
}
