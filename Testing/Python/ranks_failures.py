"""The runs of test_ranks.py in which something fails, is stopped or changed on one rank."""

import os
import signal

import numpy
from ranks import POINTS, Particles, Pipeline, at_random, in_blocks, make_surface
from ranks_scenes import STEPS, make_splash, run, splash_particles
from scenes import DATA
from shapes import as_array
from vtkmodules.vtkCommonDataModel import (
    vtkImageData,
    vtkImplicitVolume,
    vtkPolyData,
    vtkSphere,
    vtkTable,
)
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader


class Failing(Particles):
    """Source that fails at step 3 if `fails`, and at each request of times if `knows_no_times`."""

    fails = False
    knows_no_times = False

    def RequestInformation(self, request, inputs, outputs):
        if self.knows_no_times:
            return 0
        return super().RequestInformation(request, inputs, outputs)

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
    """Step 3 fails on rank 1, for requests of steps 4 and 3; later the same requests succeed."""
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
def failing_information(ranks, keeper, folder):
    """The times are unknown on rank 1, then known."""
    source, surface = make_failing(ranks)
    source.fails = False
    source.knows_no_times = ranks.rank == 1
    keeper.update("unknown_2", surface, 2)
    source.knows_no_times = False
    source.Modified()  # otherwise VTK does not repeat the request
    keeper.update("known_2", surface, 2)


@run
def missing_file(ranks, keeper, folder):
    """The first rank lacks its file at first; once it has the file, there is a skin."""
    reader = vtkXMLPolyDataReader()
    reader.SetFileName("none.vtp" if ranks.rank == 0 else str(DATA / "sph_drop.vtp"))
    reader.AddObserver("ErrorEvent", lambda caller, event: None)
    reader.GetExecutive().AddObserver("ErrorEvent", lambda caller, event: None)
    surface = make_surface(reader, 0.1, ParticleSpacing=0.085)
    keeper.update("no_file", surface, 0)
    reader.SetFileName(str(DATA / "sph_drop.vtp"))
    keeper.update("a_file", surface, 0)


@run
def missing_columns(ranks, keeper, folder):
    """Tables without columns: on all ranks, then on rank 0 only, beside empty point sets."""
    for name, count in (("no_columns", ranks.size), ("few_columns", 1)):
        surface = make_surface(voxel=0.1, ParticleSpacing=0.1)
        empty = vtkTable() if ranks.rank < count else vtkPolyData()
        surface.SetInputDataObject(0, empty)
        keeper.update(name, surface, 0)


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
    surface.ComputeVelocityOn()
    surface.TangentialVelocityOn()
    surface.SetInputArrayToProcess(5, 0, 0, 0, "velocity of " + str(ranks.rank))
    keeper.update("other_velocities", surface, 1)


@run
def killed(ranks, keeper, folder):
    """The last rank is killed in the middle of a step, while the other ranks wait for it."""
    _, surface = make_splash(VoxelSize=0.1)
    keeper.keep("pid", pid=os.getpid())

    def end(caller, event):
        if ranks.rank == ranks.size - 1 and surface.GetProgress() > 0.6:
            os.kill(os.getpid(), signal.SIGKILL)

    surface.AddObserver("ProgressEvent", end)
    keeper.update("killed_2", surface, 2)


@run
def bad_state(ranks, keeper, folder):
    """No rank loads a state that one rank does not find."""
    _, surface = make_splash()
    name = "none.vdb" if ranks.rank == 1 else "saved.vdb"
    surface.AddObserver("ErrorEvent", lambda caller, event: None)
    loaded = surface.LoadState(os.path.join(folder, name))
    surface.RemoveAllObservers()
    keeper.keep("loaded", loaded=loaded)


@run
def aborted(ranks, keeper, folder):
    """Aborts on the last rank in the middle of a step; then all ranks continue."""
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
    """The source is modified on rank 0 only; then all ranks request another time."""
    source, surface = make_splash(VoxelSize=0.1)
    keeper.update("unchanged_1", surface, 1)
    if ranks.rank == 0:
        source.Modified()
    keeper.update("changed_2", surface, 2)


def box_around(centre, value, beyond):
    """Returns a function: `value` within 0.3 of `centre` along each axis, `beyond` elsewhere."""
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
    """The reason for an empty start lies at one end of the box, where only the first or only the
    last rank evaluates."""
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
