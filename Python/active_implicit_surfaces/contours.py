"""The surface of an image, as the filter starts on it: closed, outward, all triangles with area."""

from __future__ import annotations

from typing import Any

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkCellDataToPointData

from .messages import listening


def contour(image: Any, level: float, *, above: bool = False) -> Any:
    """The surface of an image at a level.

    Parameters
    ----------
    image : vtkImageData
        Its active scalars, of points or cells, have one component.
    level : float
        Unit of the values.
    above : bool
        Inside is above the level: a fog, a density. Default: below, as in a level set.

    Returns
    -------
    vtkPolyData
        Triangles that look outward, closed at the border of the image, with normals; none unless
        there are values on both sides of the level.

    Raises
    ------
    ValueError
        With the filter's sentence: values that are no numbers, too many voxels.
    """
    from . import vtkActiveImplicitSurface

    if image.GetNumberOfPoints() == 0:
        return vtkPolyData()
    image, values = _with_point_values(image)
    if not (numpy.any(values < level) and numpy.any(values > level)):
        return vtkPolyData()
    aligned, shift = _on_the_lattice(image)
    surface = vtkActiveImplicitSurface()
    surface.SetInputData(0, aligned)
    surface.SetTargetIsoValue(level)
    surface.SetInvertTarget(above)
    surface.SetVoxelSize(_voxel_size(image))
    with listening(surface) as heard:
        surface.UpdateTimeStep(0.0)
    heard.raise_error(ValueError)
    skin = surface.GetOutput()
    if numpy.any(shift) and skin.GetNumberOfPoints():
        points = vtkPoints()
        moved = vtk_to_numpy(skin.GetPoints().GetData()) + shift
        points.SetData(numpy_to_vtk(moved, deep=True))
        skin.SetPoints(points)
    return skin


def usual_level(image: Any) -> tuple[float, bool]:
    """The level of an image, and whether inside is above it.

    Between the two values of a label map, which are integers, and above; else 0, and below.
    """
    values = _with_point_values(image)[1]
    if numpy.issubdtype(values.dtype, numpy.integer) and values.size:
        low, high = float(values.min()), float(values.max())
        if low < high and numpy.all((values == low) | (values == high)):
            return 0.5 * (low + high), True
    return 0.0, False


def _with_point_values(image: Any) -> tuple[Any, Any]:
    """The image with values at its points, and these."""
    if image.GetPointData().GetScalars() is None and image.GetCellData().GetScalars() is not None:
        convert = vtkCellDataToPointData()
        convert.SetInputData(image)
        convert.Update()
        image = convert.GetOutput()
    scalars = image.GetPointData().GetScalars()
    if scalars is None or scalars.GetNumberOfComponents() != 1:
        raise ValueError("The image has no scalars of one component, of which a surface could be.")
    return image, vtk_to_numpy(scalars)


def _voxel_size(image: Any) -> float:
    """The smallest spacing of an axis with more than one point."""
    sides = [s for s, n in zip(image.GetSpacing(), image.GetDimensions()) if n > 1]
    return float(min(sides or image.GetSpacing()))


def _on_the_lattice(image: Any) -> tuple[Any, Any]:
    """The image moved so that its points are nodes of the filter's lattice, and the way back.

    The values then are those of the nodes, not interpolated once more.
    """
    origin = numpy.array(image.GetOrigin())
    place = numpy.rint(origin / _voxel_size(image)) * _voxel_size(image)
    moved = image.NewInstance()
    moved.ShallowCopy(image)
    moved.SetOrigin(*place)
    return moved, origin - place
