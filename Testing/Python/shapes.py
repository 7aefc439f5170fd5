"""Points, balls, images and surfaces of the tests, numbers of skins, data of other libraries."""

import numpy
from active_implicit_surfaces import vtkActiveImplicitSurface
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkMassProperties
from vtkmodules.vtkFiltersSources import vtkSphereSource


class Library:
    """An object of another library with only the members that are read."""

    def __init__(self, **members):
        self.__dict__.update(members)


def as_array(numbers):
    """A VTK array with its own memory."""
    return numpy_to_vtk(numpy.ascontiguousarray(numbers), deep=True)


def make_points(positions, kind=vtkPolyData):
    """Points in the precision of the positions, double for integers."""
    cloud, points, places = kind(), vtkPoints(), numpy.reshape(positions, (-1, 3))
    points.SetData(as_array(places if places.dtype.kind == "f" else places.astype(float)))
    cloud.SetPoints(points)
    return cloud


def output_of(source):
    source.Update()
    return source.GetOutput()


def write(writer, data, path):
    """Writes data by a writer of VTK, not as appended data, which VTK 9.1 may not read."""
    if hasattr(writer, "SetDataModeToBinary"):
        writer.SetDataModeToBinary()
    writer.SetInputData(data)
    writer.SetFileName(str(path))
    writer.Write()
    return path


def ball_mesh(radius=0.5, resolution=64, center=(0, 0, 0)):
    source = vtkSphereSource()
    source.SetRadius(radius)
    source.SetCenter(center)
    source.SetThetaResolution(resolution)
    source.SetPhiResolution(resolution)
    return source


def image_of(values, spacing=(1, 1, 1)):
    """An image whose axes z, y, x are those of the array."""
    result = vtkImageData()
    result.SetDimensions(values.shape[::-1])
    result.SetSpacing(spacing)
    result.GetPointData().SetScalars(as_array(values.ravel()))
    return result


def with_properties(surface, properties):
    for name, value in properties.items():
        getattr(surface, f"Set{name}")(value)
    return surface


def surface_in_box(**properties):
    surface = vtkActiveImplicitSurface()
    surface.SetModelBounds(-1, 1, -1, 1, -1, 1)
    return with_properties(surface, properties)


def points_of(data):
    points = (data.GetOutput() if hasattr(data, "GetOutput") else data).GetPoints()
    return vtk_to_numpy(points.GetData()) if points else numpy.zeros((0, 3), numpy.float32)


def bytes_of(data):
    return points_of(data).tobytes()


def volume_of(skin):
    measure = vtkMassProperties()
    measure.SetInputData(skin)
    return measure.GetVolume() if skin.GetNumberOfCells() else 0.0
