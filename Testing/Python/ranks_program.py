"""Runs of test_ranks.py; each rank saves its results in a folder.

Run: python3 ranks_program.py <run>[,<run>...] <folder> [--alone]; without --alone, under mpiexec.
"""

import os
import sys

import numpy
import ranks_failures  # noqa: F401  whose runs are among them
from active_implicit_surfaces import LiveSurface, vtkActiveVDBReader, vtkActiveVDBWriter
from listener import Listener
from random_shapes import as_table
from ranks import POINTS, Keeper, Particles, at_random, begin, in_blocks, make_surface
from ranks_scenes import RUNS, make_splash, run, splash_particles
from same_bytes_shapes import Steps, cloud
from scenes import star_to_balls, tube_to_box
from shapes import as_array
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData, vtkSphere
from vtkmodules.vtkFiltersSources import vtkSphereSource


@run
def nothing(ranks, keeper, folder):
    """Succeeds if there is MPI."""


@run
def splash(ranks, keeper, folder):
    """Particles with births, deaths and new owners; times forward, between steps, back; a state."""
    _, surface = make_splash()
    keeper.update("splash_2", surface, 2)
    surface.SaveState(os.path.join(folder, "splash.vdb"))
    keeper.update("splash_3.5", surface, 3.5)
    keeper.update("splash_1", surface, 1)


@run
def restart(ranks, keeper, folder):
    """Resumes from a state that another number of ranks has saved."""
    _, surface = make_splash()
    assert surface.LoadState(os.path.join(folder, "saved.vdb"))
    keeper.update("restart_4", surface, 4)


WITHOUT_PARTICLES = {
    "ComputeVelocity": False,
    "TangentialVelocity": False,
    "PassTargetArrays": False,
    "OutputPotential": False,
    "ComputeCurvature": True,
}


@run
def shared(ranks, keeper, folder):
    """Each rank has a part of the surface: times forward, between steps, back; a state, a .vdb."""
    _, surface = make_splash(**WITHOUT_PARTICLES)
    for time in (2, 3.5, 1, 4):
        keeper.update(f"shared_{time}", surface, time)
    surface.SaveState(os.path.join(folder, "shared.vdb"))
    writer = vtkActiveVDBWriter()
    writer.SetInputConnection(surface.GetOutputPort())
    writer.SetFileName(os.path.join(folder, "shared_skin.vdb"))
    assert writer.Write()
    listener = Listener(surface)
    surface.GetSkinFunction()  # only a part is available: a warning
    keeper.keep("function", warnings=numpy.array(listener.warnings, dtype=str))
    surface.RemoveAllObservers()
    surface.SetComputeVelocity(True)  # for which all ranks need the whole
    keeper.update("shared_5", surface, 5)
    surface.SetComputeVelocity(False)
    keeper.update("shared_6", surface, 6)


@run
def shared_back(ranks, keeper, folder):
    """Requests the start again without checkpoints, then the same frames with their arrays."""
    _, surface = make_splash(CheckpointInterval=0, **WITHOUT_PARTICLES)
    for number, time in enumerate((0, 1, 0, 1)):
        keeper.update(f"shared_back_{number}", surface, time)
    surface.SetPassTargetArrays(True)
    for number, time in enumerate((0, 1, 0)):
        keeper.update(f"shared_back_arrays_{number}", surface, time)


@run
def shared_fine(ranks, keeper, folder):
    """Voxels so small that tension reaches over four nodes."""
    _, surface = make_splash(VoxelSize=0.02, **WITHOUT_PARTICLES)
    keeper.update("shared_fine_2", surface, 2)


@run
def shared_walls(ranks, keeper, folder):
    """Walls and an obstacle, which cut the body, and an empty time step."""

    def particles(step):
        spread = numpy.indices((8, 8, 24)).reshape(3, -1).T * 0.1
        spread += [0.2 * step, 0.02 * step * step, 0.05 * step]
        return {"position": spread[: 0 if step == 4 else None]}

    obstacle = vtkSphere()
    obstacle.SetCenter(1.2, 0.9, 1.0)
    obstacle.SetRadius(0.4)
    source = Particles(6, particles, in_blocks)
    surface = make_surface(source, 0.05, ParticleSpacing=0.1, **WITHOUT_PARTICLES)
    surface.SetModelBounds(-0.3, 1.6, -0.3, 2.4, -0.3, 3.0)
    surface.SetBoundedDomain(True)
    surface.SetObstacleFunction(obstacle)
    for time in (1, 3, 3.5, 5):
        keeper.update(f"shared_walls_{time}", surface, time)


@run
def shared_estimate(ranks, keeper, folder):
    """Fast particles without ids, whose spacing is estimated, all on the first rank."""

    def particles(step):
        places = numpy.random.default_rng(1).random((900, 3))
        return {"position": places * [1, 1, 2] + [step, 0, 0.5 * step]}

    source = Particles(5, particles, lambda step, count, pieces: numpy.zeros(count, dtype=int))
    surface = make_surface(source, 0.06, **WITHOUT_PARTICLES)
    for time in (1, 4):
        keeper.update(f"shared_estimate_{time}", surface, time)


@run
def emitter(ranks, keeper, folder):
    """Particles without ids, in blocks; at the first step all ranks but one have none."""

    def particles(step):
        count = 1 + 3 * step
        spread = numpy.arange(count)
        return {
            "position": numpy.stack([0.1 * spread, 0.05 * (spread % 3), 0 * spread], -1),
            "size": 0.2 + 0.02 * (spread % 4),
        }

    source = Particles(4, particles, in_blocks)
    surface = make_surface(source, 0.05)
    surface.SetInputArrayToProcess(0, 0, 0, POINTS, "size")
    keeper.update("emitter_3", surface, 3)


def part_of_ball(radius, ranks):
    ball = vtkSphereSource()
    ball.SetRadius(radius)
    ball.SetThetaResolution(24)
    ball.SetPhiResolution(17)
    ball.Update()
    polys = ball.GetOutput().GetPolys()
    count = polys.GetNumberOfCells()
    own = numpy.flatnonzero(in_blocks(0, count, ranks.size) == ranks.rank)
    points, cells = vtkPoints(), vtkCellArray()
    for cell in own:
        corners = ball.GetOutput().GetCell(cell).GetPoints()
        cells.InsertNextCell(3, [points.InsertNextPoint(corners.GetPoint(i)) for i in range(3)])
    mesh = vtkPolyData()
    mesh.SetPoints(points)
    mesh.SetPolys(cells)
    return mesh


@run
def table(ranks, keeper, folder):
    """A table from a source without pieces: ranks other than the first have no columns."""
    places = [(0.1 * i, 0.05 * (i % 3)) for i in range(12)]
    steps = {z: as_table(cloud([(x, y, 0.05 * z) for x, y in places])) for z in range(2)}
    surface = make_surface(Steps(steps), 0.05, ParticleSpacing=0.15)
    keeper.update("table_1", surface, 1)


@run
def meshes(ranks, keeper, folder):
    """A mesh that becomes another one; each rank has some of their triangles."""
    surface = make_surface(voxel=0.08, Attraction=4)
    surface.SetInputDataObject(0, part_of_ball(0.8, ranks))
    surface.SetInputDataObject(1, part_of_ball(0.5, ranks))
    keeper.update("meshes_0.3", surface, 0.3)


def part_of_image(ranks):
    nodes = 24
    first = nodes * ranks.rank // ranks.size
    last = min(nodes * (ranks.rank + 1) // ranks.size, nodes - 1)
    image = vtkImageData()
    image.SetExtent(0, nodes - 1, 0, nodes - 1, first, last)
    image.SetOrigin(-1, -1, -1)
    image.SetSpacing(2 / 23, 2 / 23, 2 / 23)
    places = numpy.array([image.GetPoint(i) for i in range(image.GetNumberOfPoints())])
    values = as_array(numpy.sqrt((places**2).sum(1)) - 0.6)
    values.SetName("distance")
    image.GetPointData().SetScalars(values)
    return image


@run
def image(ranks, keeper, folder):
    surface = make_surface(voxel=0.08, Attraction=4)
    surface.SetInputDataObject(0, part_of_image(ranks))
    keeper.update("image_0.2", surface, 0.2)


@run
def skeleton(ranks, keeper, folder):
    """A polyline, of which each rank has a part; neighbours have copies of a common end."""
    points, lines = vtkPoints(), vtkCellArray()
    own = numpy.flatnonzero(in_blocks(0, 8, ranks.size) == ranks.rank)
    if len(own):
        ids = [
            points.InsertNextPoint(0.1 * k, 0.05 * (k % 2), 0) for k in range(own[0], own[-1] + 2)
        ]
        lines.InsertNextCell(len(ids), ids)
    segments = vtkPolyData()
    segments.SetPoints(points)
    segments.SetLines(lines)
    surface = make_surface(voxel=0.05, KernelRadius=0.3)
    surface.SetInputDataObject(0, segments)
    keeper.update("skeleton_0.2", surface, 0.2)


@run
def grid(ranks, keeper, folder):
    """A level set that is written to a .vdb and read again."""
    ball = vtkSphereSource()
    ball.SetRadius(0.6)
    writer = vtkActiveVDBWriter()
    writer.SetInputConnection(ball.GetOutputPort())
    writer.SetVoxelSize(0.05)
    writer.SetFileName(os.path.join(folder, "ball.vdb"))
    assert writer.Write() == 1
    reader = vtkActiveVDBReader()
    reader.SetFileName(writer.GetFileName())
    reader.OutputDenseOff()
    keeper.update("grid_0.2", make_surface(reader, 0.08, Attraction=4), 0.2)


@run
def morph(ranks, keeper, folder):
    """Functions, which every rank has; the exact volume is conserved through a split."""
    for name, surface in (("split", star_to_balls()), ("tube", tube_to_box())):
        surface.SetNumberOfThreads(1)
        surface.SetVoxelSize(0.1)
        surface.OutputPotentialOn()
        if name == "split":
            surface.SetVolumeControlToExact()
        keeper.update(f"{name}_1", surface, 1)
        keeper.update(f"{name}_3", surface, 3)


@run
def live(ranks, keeper, folder):
    """Each rank passes its own particles to LiveSurface; at first rank 1 has none."""
    surface = LiveSurface(particle_spacing=0.085, voxel_size=0.1, number_of_threads=1)
    particles = splash_particles()
    for step in range(3):
        arrays = particles(step)
        owners = at_random(step, len(arrays["id"]), ranks.size)
        owners[(owners == 1) & (step == 0)] = 0
        own = owners == ranks.rank
        surface.advance(arrays["position"][own], 0.2, ids=arrays["id"][own])
    keeper.keep("live.errors", errors=numpy.array([], dtype=str))
    keeper.outputs("live", surface.surface)


@run
def written(ranks, keeper, folder):
    """A .vdb with state, velocity and point arrays; then one that the first rank cannot write."""
    _, surface = make_splash(VoxelSize=0.1)
    surface.UpdateTimeStep(1)
    writer = vtkActiveVDBWriter()
    writer.SetInputConnection(surface.GetOutputPort())
    writer.WriteStateOn()
    writer.WriteVelocityOn()
    writer.WritePointArraysOn()
    writer.SetFileName(os.path.join(folder, "written.vdb"))
    done = [writer.Write()]
    writer.SetFileName(os.path.join(folder, "nowhere", "written.vdb"))
    writer.AddObserver("ErrorEvent", lambda caller, event: None)
    done.append(writer.Write())
    keeper.keep("writes", done=done)


def main():
    name, folder = sys.argv[1:3]
    ranks = begin("--alone" in sys.argv)
    for one in name.split(","):
        RUNS[one](ranks, Keeper(ranks, folder), folder)


if __name__ == "__main__":
    main()
