"""The runs of test_ranks.py; what the ranks have made goes into a folder.

Run: python3 ranks_program.py <run>[,<run>...] <folder> [--alone], under mpiexec but for --alone.
"""

import os
import signal
import sys

import numpy
from active_implicit_surfaces import LiveSurface, vtkActiveVDBReader, vtkActiveVDBWriter
from python_data import as_array
from ranks import (
    POINTS,
    Keeper,
    Particles,
    Pipeline,
    at_random,
    begin,
    in_blocks,
    make_surface,
)
from scenes import DATA, star_to_balls
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (
    vtkCellArray,
    vtkImageData,
    vtkImplicitVolume,
    vtkPolyData,
    vtkSphere,
)
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

RUNS = {}
STEPS = 7


def run(function):
    RUNS[function.__name__] = function
    return function


@run
def nothing(ranks, keeper, folder):
    """There is MPI."""


def splash_particles():
    """particles(step) of the splash, of which some are born and some die at each step."""
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(DATA / "sph_drop.vtp"))

    def particles(step):
        reader.UpdateTimeStep(5 * step)
        position = vtk_to_numpy(reader.GetOutput().GetPoints().GetData()).copy()
        ids = numpy.arange(len(position))
        lives = (ids % 11 != step) & ((ids % 7 < 5) | (ids % 7 + step > 8))
        heat = numpy.sin(ids + step)
        order = numpy.random.default_rng(step).permutation(ids[lives])
        return {"position": position[order], "id": ids[order], "heat": heat[order]}

    return particles


def make_splash(**others):
    source = Particles(STEPS, splash_particles(), at_random)
    properties = {
        "TimeScale": 1 / 5,
        "ParticleSpacing": 0.085,
        "ComputeVelocity": True,
        "TangentialVelocity": True,
        "PassTargetArrays": True,
        "OutputPotential": True,
        **others,
    }
    surface = make_surface(source, **properties)
    surface.SetInputArrayToProcess(1, 0, 0, POINTS, "id")
    return source, surface


@run
def splash(ranks, keeper, folder):
    """Births and deaths; other owners at each step; forward, between two steps, back; a state."""
    _, surface = make_splash()
    keeper.update("splash_2", surface, 2)
    surface.SaveState(os.path.join(folder, "splash.vdb"))
    keeper.update("splash_3.5", surface, 3.5)
    keeper.update("splash_1", surface, 1)


@run
def restart(ranks, keeper, folder):
    """From the state that another number of ranks has saved."""
    _, surface = make_splash()
    assert surface.LoadState(os.path.join(folder, "saved.vdb"))
    keeper.update("restart_4", surface, 4)


@run
def emitter(ranks, keeper, folder):
    """Particles without ids, in blocks, so that ranks begin without any."""

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
    """Of the triangles of a ball those of a rank, with their points."""
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
def meshes(ranks, keeper, folder):
    """A mesh that becomes another one; each rank has some of their triangles."""
    surface = make_surface(voxel=0.08, Attraction=4)
    surface.SetInputDataObject(0, part_of_ball(0.8, ranks))
    surface.SetInputDataObject(1, part_of_ball(0.5, ranks))
    keeper.update("meshes_0.3", surface, 0.3)


def part_of_image(ranks):
    """A ball's distances; each rank has some slices."""
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
    """Segments end to end, of which each rank has some."""
    points, lines = vtkPoints(), vtkCellArray()
    for i in numpy.flatnonzero(in_blocks(0, 8, ranks.size) == ranks.rank):
        ends = [points.InsertNextPoint(0.1 * k, 0.05 * (k % 2), 0) for k in (i, i + 1)]
        lines.InsertNextCell(2, ends)
    segments = vtkPolyData()
    segments.SetPoints(points)
    segments.SetLines(lines)
    surface = make_surface(voxel=0.05, ParticleRadius=0.3)
    surface.SetInputDataObject(0, segments)
    keeper.update("skeleton_0.2", surface, 0.2)


@run
def grid(ranks, keeper, folder):
    """A level set of a .vdb, which the first rank writes and reads."""
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
    """Functions, which every rank has; the exact volume is held through a split."""
    surface = star_to_balls()
    surface.SetNumberOfThreads(1)
    surface.SetVoxelSize(0.1)
    surface.SetVolumeControlToExact()
    surface.OutputPotentialOn()
    keeper.update("morph_1", surface, 1)


@run
def live(ranks, keeper, folder):
    """Each rank pushes its own particles, one of them none at first."""
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
    """A .vdb with all that is on the skin; and one that the first rank cannot write."""
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


class Failing(Particles):
    """Fails at a step on a rank as long as it is told to."""

    fails = False

    def RequestData(self, request, inputs, outputs):
        if self.fails and outputs.GetInformationObject(0).Get(Pipeline.UPDATE_TIME_STEP()) == 3.0:
            return 0
        return super().RequestData(request, inputs, outputs)


def make_failing(ranks):
    source = Failing(STEPS, splash_particles(), at_random)
    source.fails = ranks.rank == 1
    surface = make_surface(source, TimeScale=1 / 5, ParticleSpacing=0.085, VoxelSize=0.1)
    surface.SetInputArrayToProcess(1, 0, 0, POINTS, "id")
    return source, surface


@run
def failing_step(ranks, keeper, folder):
    """A step in the middle fails on rank 1; then the same without; the step asked for fails too."""
    source, surface = make_failing(ranks)
    keeper.update("failed_4", surface, 4)
    source.fails = False
    keeper.update("mended_4", surface, 4)
    source, surface = make_failing(ranks)
    keeper.update("before_2", surface, 2)
    keeper.update("failed_3", surface, 3)
    source.fails = False
    keeper.update("mended_3", surface, 3)


@run
def missing_file(ranks, keeper, folder):
    """The first rank has no file; when it has, all have a skin."""
    reader = vtkXMLPolyDataReader()
    reader.SetFileName("none.vtp" if ranks.rank == 0 else str(DATA / "sph_drop.vtp"))
    reader.AddObserver("ErrorEvent", lambda caller, event: None)
    reader.GetExecutive().AddObserver("ErrorEvent", lambda caller, event: None)
    surface = make_surface(reader, 0.1, ParticleSpacing=0.085)
    keeper.update("no_file", surface, 0)
    reader.SetFileName(str(DATA / "sph_drop.vtp"))
    keeper.update("a_file", surface, 0)


@run
def missing_array(ranks, keeper, folder):
    def particles(step):
        names = {"position": numpy.array([[i, 0.0, 0.0] for i in range(8)])}
        if ranks.rank != 2:
            names["size"] = numpy.full(8, 0.8)
        return names

    surface = make_surface(Particles(2, particles, in_blocks), 0.2)
    surface.SetInputArrayToProcess(0, 0, 0, POINTS, "size")
    keeper.update("no_array", surface, 0)


@run
def other_properties(ranks, keeper, folder):
    _, surface = make_splash(VoxelSize=0.1 + 0.01 * (ranks.rank == 2))
    keeper.update("other_voxels", surface, 1)
    surface.SetVoxelSize(0.1)
    keeper.update("other_times", surface, ranks.rank)


@run
def killed(ranks, keeper, folder):
    """The last rank comes to a sudden end in the middle of a step, while the others wait for it."""
    _, surface = make_splash(VoxelSize=0.1)
    keeper.keep("pid", pid=os.getpid())

    def end(caller, event):
        if ranks.rank == ranks.size - 1 and surface.GetProgress() > 0.6:
            os.kill(os.getpid(), signal.SIGKILL)

    surface.AddObserver("ProgressEvent", end)
    keeper.update("killed_2", surface, 2)


@run
def bad_state(ranks, keeper, folder):
    """A state that one rank does not find is loaded by none."""
    _, surface = make_splash()
    name = "none.vdb" if ranks.rank == 1 else "saved.vdb"
    surface.AddObserver("ErrorEvent", lambda caller, event: None)
    loaded = surface.LoadState(os.path.join(folder, name))
    surface.RemoveAllObservers()
    keeper.keep("loaded", loaded=loaded)


@run
def aborted(ranks, keeper, folder):
    """Stopped on the last rank in the middle of a step; then all go on."""
    _, surface = make_splash(VoxelSize=0.1)

    def stop(caller, event):
        if ranks.rank == ranks.size - 1 and surface.GetProgress() > 0.6:
            surface.AbortExecuteOn()

    surface.AddObserver("ProgressEvent", stop)
    surface.UpdateTimeStep(2)
    keeper.outputs("aborted_2", surface)
    surface.RemoveAllObservers()
    surface.AbortExecuteOff()
    surface.Modified()
    keeper.update("resumed_2", surface, 2)


@run
def changed_upstream(ranks, keeper, folder):
    """Something upstream changes on one rank only, while all ask for another time."""
    source, surface = make_splash(VoxelSize=0.1)
    keeper.update("unchanged_1", surface, 1)
    if ranks.rank == 0:
        source.Modified()
    keeper.update("changed_2", surface, 2)


def box_around(centre, value, beyond):
    """A value within .3 of a place along each axis, another one beyond."""
    image = vtkImageData()
    image.SetDimensions(2, 2, 2)
    image.SetOrigin(*(x - 0.3 for x in centre))
    image.SetSpacing(0.6, 0.6, 0.6)
    image.GetPointData().SetScalars(as_array(numpy.full(8, float(value))))
    function = vtkImplicitVolume()
    function.SetVolume(image)
    function.SetOutValue(beyond)
    return function


@run
def empty_starts(ranks, keeper, folder):
    """Only some ranks evaluate where the reason is: at either end of the box, so the first or the
    last one."""
    for end in (-1.5, 1.5):
        place = (end, 0.1, 0.1)
        ball = vtkSphere()
        ball.SetCenter(place)
        ball.SetRadius(0.3)
        for name, initial, obstacle in (
            ("outside", box_around(place, 1, numpy.nan), None),
            ("no_numbers", box_around(place, numpy.nan, numpy.nan), None),
            ("covered", ball, box_around(place, -0.4, 1)),
        ):
            surface = make_surface(voxel=0.05, InitialFunction=initial, TargetFunction=initial)
            surface.SetModelBounds(-2, 2, -2, 2, -2, 2)
            surface.SetObstacleFunction(obstacle)
            keeper.update(f"{name}_{end}", surface, 0)


def main():
    name, folder = sys.argv[1:3]
    ranks = begin("--alone" in sys.argv)
    for one in name.split(","):
        RUNS[one](ranks, Keeper(ranks, folder), folder)


if __name__ == "__main__":
    main()
