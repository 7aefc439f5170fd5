"""Sources of particles on one or several ranks, and files of the ranks' outputs."""

import os
import random

import numpy
from active_implicit_surfaces import vtkActiveImplicitSurface
from listener import Listener
from shapes import as_array, make_points, with_properties
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline

POINTS = vtkDataObject.FIELD_ASSOCIATION_POINTS


CONTROLLERS = []  # VTK does not hold the global one


class Alone:
    rank, size = 0, 1


def begin(is_alone):
    """Returns a communicator of the ranks, which VTK's global controller then uses, or `Alone`."""
    if is_alone:
        return Alone
    from mpi4py import MPI  # it starts MPI
    from vtkmodules.vtkParallelCore import vtkMultiProcessController
    from vtkmodules.vtkParallelMPI import vtkMPIController

    controller = vtkMPIController()
    controller.Initialize()
    vtkMultiProcessController.SetGlobalController(controller)
    CONTROLLERS.append(controller)
    return MPI.COMM_WORLD


class Particles(VTKPythonAlgorithmBase):
    """Source of the particles of one piece at each step.

    particles(step): arrays by name, one of them "position". owners(step, count, pieces): the piece
    of each particle.
    """

    def __init__(self, steps, particles, owners):
        super().__init__(nInputPorts=0, outputType="vtkPolyData")
        self.steps = [float(step) for step in range(steps)]
        self.particles = particles
        self.owners = owners

    def RequestInformation(self, request, inputs, outputs):
        information = outputs.GetInformationObject(0)
        information.Set(Pipeline.TIME_STEPS(), self.steps, len(self.steps))
        information.Set(Pipeline.TIME_RANGE(), [self.steps[0], self.steps[-1]], 2)
        information.Set(vtkAlgorithm.CAN_HANDLE_PIECE_REQUEST(), 1)
        return 1

    def RequestData(self, request, inputs, outputs):
        information = outputs.GetInformationObject(0)
        piece = information.Get(Pipeline.UPDATE_PIECE_NUMBER())
        pieces = information.Get(Pipeline.UPDATE_NUMBER_OF_PIECES())
        step = round(information.Get(Pipeline.UPDATE_TIME_STEP()))
        arrays = self.particles(step)
        own = self.owners(step, len(arrays["position"]), pieces) == piece
        arrays = {name: array[own] for name, array in arrays.items()}
        cloud = vtkPolyData.GetData(outputs)
        if not len(arrays["position"]):
            return 1  # a rank without particles has no arrays either
        cloud.ShallowCopy(make_points(arrays.pop("position")))
        for name, array in arrays.items():
            own_array = as_array(array)
            own_array.SetName(name)
            cloud.GetPointData().AddArray(own_array)
        return 1


def at_random(step, count, pieces):
    """Random pieces, different at each step and for each number of pieces."""
    draw = random.Random(f"{step} {count} {pieces}")
    return numpy.array([draw.randrange(pieces) for _ in range(count)], dtype=int)


def in_blocks(step, count, pieces):
    """Pieces of consecutive particles, as in partitioned files."""
    return numpy.arange(count) * pieces // max(count, 1)


def make_surface(source=None, voxel=0.06, **properties):
    surface = vtkActiveImplicitSurface()
    surface.SetNumberOfThreads(1)
    surface.SetVoxelSize(voxel)
    if source:
        surface.SetInputConnection(source.GetOutputPort())
    return with_properties(surface, properties)


class Keeper:
    """Keeps outputs as files <name>.<rank>.npz of a folder."""

    def __init__(self, ranks, folder):
        self.ranks = ranks
        self.folder = folder

    def keep(self, name, **arrays):
        numpy.savez(os.path.join(self.folder, f"{name}.{self.ranks.rank}.npz"), **arrays)

    def outputs(self, name, surface):
        self.keep(name, **outputs_of(surface))

    def update(self, name, surface, time):
        """Keeps the outputs, errors and warnings of an update."""
        listener = Listener(surface)
        surface.UpdateTimeStep(time)
        said = {"errors": listener.errors, "warnings": listener.warnings}
        self.keep(name + ".errors", **{kind: numpy.array(t, dtype=str) for kind, t in said.items()})
        self.outputs(name, surface)
        surface.RemoveAllObservers()


def outputs_of(surface):
    return {
        "triangles": triangles_of(surface.GetOutput()),
        "history": history_of(surface.GetHistory()),
        **points_of(surface.GetOutput()),
        **image_of(surface.GetPotential()),
    }


def triangles_of(skin):
    """Returns a row of bytes for each triangle: all values of its corners except global ids."""
    if skin.GetNumberOfPolys() == 0:
        return numpy.zeros((0, 0), dtype=numpy.uint8)
    corners = vtk_to_numpy(skin.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    arrays = skin.GetPointData()
    columns = [vtk_to_numpy(skin.GetPoints().GetData())]
    names = sorted(arrays.GetArrayName(i) for i in range(arrays.GetNumberOfArrays()))
    columns += [vtk_to_numpy(arrays.GetArray(name)) for name in names if name != "GlobalPointIds"]
    bytes_of_points = numpy.concatenate(
        [numpy.ascontiguousarray(c).view(numpy.uint8).reshape(len(c), -1) for c in columns], axis=1
    )
    return bytes_of_points[corners].reshape(len(corners), -1)


def points_of(skin):
    ids = skin.GetPointData().GetGlobalIds()
    points = skin.GetPoints()
    return {
        "points": vtk_to_numpy(points.GetData()) if points else [],
        "ids": vtk_to_numpy(ids) if ids else [],
    }


def image_of(image):
    if image.GetNumberOfPoints() == 0:
        return {"extent": [0, -1, 0, -1, 0, -1], "potential": numpy.array([])}
    return {
        "extent": image.GetExtent(),
        "potential": vtk_to_numpy(image.GetPointData().GetScalars()),
    }


def history_of(table):
    """Returns a text for each row of the history, with the exact numbers."""
    columns = [table.GetColumn(i) for i in range(table.GetNumberOfColumns())]
    rows = []
    for row in range(table.GetNumberOfRows()):
        values = [column.GetValue(row) for column in columns]
        rows.append(" ".join(v if isinstance(v, str) else float(v).hex() for v in values))
    return numpy.array(rows, dtype=str)


def load(folder, name, ranks):
    loaded = []
    for rank in range(ranks):
        with numpy.load(os.path.join(folder, f"{name}.{rank}.npz")) as kept:
            loaded.append(dict(kept))
    return loaded


def sorted_triangles(kept):
    rows = [part["triangles"] for part in kept if len(part["triangles"])]
    if not rows:
        return []
    together = numpy.concatenate(rows)
    return sorted(row.tobytes() for row in together)


def whole_image(kept, extent):
    """Joins the ranks' parts of an image; NaN at nodes that no rank has."""
    low = numpy.array(extent[0::2])
    image = numpy.full(numpy.array(extent[1::2]) - low + 1, numpy.nan, dtype=numpy.float32)
    for part in kept:
        first, last = part["extent"][0::2] - low, part["extent"][1::2] - low + 1
        place = tuple(slice(a, b) for a, b in zip(first, last))
        if part["potential"].size:
            image[place] = part["potential"].reshape((last - first)[::-1]).transpose()
    return image
