"""Inputs made only by sums, products and square roots, whose rounding is the same on all
machines."""

import itertools
from math import sqrt

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (
    vtkBox,
    vtkCellArray,
    vtkDataObject,
    vtkImageData,
    vtkImplicitBoolean,
    vtkPolyData,
    vtkSphere,
)
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline

BOX = (-1, 1, -1, 1, -1, 1)


def ball(radius, center=(0, 0, 0)):
    function = vtkSphere()
    function.SetRadius(radius)
    function.SetCenter(center)
    return function


def block(*bounds):
    function = vtkBox()
    function.SetBounds(bounds)
    return function


def union(*functions):
    both = vtkImplicitBoolean()
    both.SetOperationTypeToUnion()
    for function in functions:
        both.AddFunction(function)
    return both


def two_balls(way=0.45, radius=0.35):
    return union(ball(radius, (-way, 0, 0)), ball(radius, (way, 0, 0)))


def add_array(data, name, values, dtype=numpy.float64):
    array = numpy_to_vtk(numpy.array(values, dtype), deep=True)
    array.SetName(name)
    data.AddArray(array)
    return array


def cloud(positions, **arrays):
    """Points, and point arrays by their names; integer arrays are int64."""
    points = vtkPoints()
    points.SetDataTypeToDouble()
    for position in positions:
        points.InsertNextPoint(position)
    data = vtkPolyData()
    data.SetPoints(points)
    for name, values in arrays.items():
        whole = all(isinstance(value, int) for value in values)
        add_array(data.GetPointData(), name, values, numpy.int64 if whole else numpy.float64)
    return data


def scattered(count, seed=1):
    """Points in the cube from -1/2 to 1/2, by a congruential generator."""
    numbers = []
    for _ in range(3 * count):
        seed = (1103515245 * seed + 12345) % 2**31
        numbers.append((seed >> 16) / 2**15 - 0.5)
    return [tuple(numbers[3 * i : 3 * i + 3]) for i in range(count)]


def lines(positions, *chains, **arrays):
    data = cloud(positions, **arrays)
    cells = vtkCellArray()
    for chain in chains:
        cells.InsertNextCell(len(chain), chain)
    data.SetLines(cells)
    return data


def polygons(positions, *faces):
    data = cloud(positions)
    cells = vtkCellArray()
    for face in faces:
        cells.InsertNextCell(len(face), face)
    data.SetPolys(cells)
    return data


def brick(half=(0.5, 0.4, 0.3), center=(0, 0, 0)):
    """A closed mesh of six quadrangles, outward."""
    corners = [
        tuple(c + s * h for c, s, h in zip(center, signs, half))
        for signs in itertools.product((-1, 1), repeat=3)
    ]
    faces = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    return polygons(corners, *faces)


def globe(radius):
    """A closed mesh of 32 triangles: an octahedron, split once, its corners on a ball."""
    corners = [(1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    faces = []
    for a, b in ((0, 1), (1, 2), (2, 3), (3, 0)):
        faces += [(a, b, 4), (b, a, 5)]
    corners, split = [tuple(map(float, corner)) for corner in corners], []
    for a, b, c in faces:
        ab, bc, ca = (middle(corners, *edge) for edge in ((a, b), (b, c), (c, a)))
        split += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return polygons([tuple(radius * x for x in corner) for corner in corners], *split)


def middle(corners, a, b):
    """Index of the point halfway between two corners on the unit sphere; adds the point if it is
    missing."""
    between = [x + y for x, y in zip(corners[a], corners[b])]
    length = sqrt(sum(x * x for x in between))
    point = tuple(x / length for x in between)
    if point not in corners:
        corners.append(point)
    return corners.index(point)


def strip():
    """An open mesh: a strip of four triangles, bent."""
    data = cloud([(x, y, z) for x, z in ((-0.5, 0), (0, 0.2), (0.5, 0)) for y in (-0.3, 0.3)])
    cells = vtkCellArray()
    cells.InsertNextCell(6, range(6))
    data.SetStrips(cells)
    return data


def image(value, count=21, **others):
    """Samples of value(x, y, z), and of others by their names, in the box from -1 to 1."""
    data = vtkImageData()
    data.SetDimensions(count, count, count)
    data.SetOrigin(-1, -1, -1)
    data.SetSpacing(2 / (count - 1), 2 / (count - 1), 2 / (count - 1))
    ticks = numpy.arange(count) * (2 / (count - 1)) - 1
    z, y, x = numpy.meshgrid(ticks, ticks, ticks, indexing="ij")
    for name, function in {"F": value, **others}.items():
        add_array(data.GetPointData(), name, function(x, y, z).ravel())
    data.GetPointData().SetActiveScalars("F")
    return data


def quadric(a, b, c, level=0.36):
    """A function for image(): negative in an ellipsoid."""
    return lambda x, y, z: a * x * x + b * y * y + c * z * z - level


def lattice(count=7, half=0.9):
    """Points of a coarse lattice, away from the nodes of skins."""
    ticks = [half * (2 * i / (count - 1) - 1) + 0.013 for i in range(count)]
    return list(itertools.product(ticks, repeat=3))


class Steps(VTKPythonAlgorithmBase):
    """A source with one data object for each time step."""

    def __init__(self, steps):
        super().__init__(nInputPorts=0, outputType=next(iter(steps.values())).GetClassName())
        self.steps = steps

    def FillOutputPortInformation(self, port, info):
        info.Set(vtkDataObject.DATA_TYPE_NAME(), self.OutputType)
        return 1

    def RequestInformation(self, request, inputs, outputs):
        times = list(self.steps)
        information = outputs.GetInformationObject(0)
        information.Set(Pipeline.TIME_STEPS(), times, len(times))
        information.Set(Pipeline.TIME_RANGE(), [times[0], times[-1]], 2)
        if self.OutputType == "vtkImageData":
            first = self.steps[times[0]]
            information.Set(Pipeline.WHOLE_EXTENT(), first.GetExtent(), 6)
        return 1

    def RequestData(self, request, inputs, outputs):
        information = outputs.GetInformationObject(0)
        key = Pipeline.UPDATE_TIME_STEP()
        wanted = information.Get(key) if information.Has(key) else next(iter(self.steps))
        time = max((step for step in self.steps if step <= wanted), default=next(iter(self.steps)))
        output = vtkDataObject.GetData(outputs, 0)
        output.ShallowCopy(self.steps[time])
        output.GetInformation().Set(output.DATA_TIME_STEP(), time)
        return 1
