"""Data as other libraries would give it, and how much a skin holds."""

from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkMassProperties


def volume_of(skin):
    measure = vtkMassProperties()
    measure.SetInputData(skin)
    return measure.GetVolume()


class Library:
    """An object of another library: only what is read of it."""

    def __init__(self, **members):
        self.__dict__.update(members)


def make_points(positions, kind=vtkPolyData):
    cloud, points = kind(), vtkPoints()
    points.SetData(as_array(positions))
    cloud.SetPoints(points)
    return cloud


def as_array(numbers):
    """A VTK array of its own memory."""
    return numpy_to_vtk(numbers, deep=True)
