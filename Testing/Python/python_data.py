"""Data in the form of other libraries, and the volume of a skin."""

from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkMassProperties


def volume_of(skin):
    measure = vtkMassProperties()
    measure.SetInputData(skin)
    return measure.GetVolume()


class Library:
    """An object of another library with only the members that are read."""

    def __init__(self, **members):
        self.__dict__.update(members)


def make_points(positions, kind=vtkPolyData):
    cloud, points = kind(), vtkPoints()
    points.SetData(as_array(positions))
    cloud.SetPoints(points)
    return cloud


def as_array(numbers):
    """A VTK array with its own memory."""
    return numpy_to_vtk(numbers, deep=True)
