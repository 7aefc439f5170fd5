"""The surface of an image, as the filter starts on it: closed, outward, all triangles with area."""

from __future__ import annotations

from typing import Any

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkCellDataToPointData

from .choice import labels_of
from .data_objects import add_array, vtk_points
from .messages import few, listening


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
        skin.SetPoints(vtk_points(vtk_to_numpy(skin.GetPoints().GetData()) + shift))
    return skin


def usual_level(image: Any, level: float | None = None) -> tuple[float, bool]:
    """The level of an image, and whether inside is above it.

    Of a mask, with two values, it is between them, inside above; else it is 0, and inside below.
    Inside is also above a given level if most of the image's border is below it.
    """
    image, values = _with_point_values(image)
    low, high = (float(values.min()), float(values.max())) if values.size else (0.0, 0.0)
    is_mask = low < high and bool(numpy.all((values == low) | (values == high)))
    if level is None:
        return (0.5 * (low + high), True) if is_mask else (0.0, False)
    cube = values.reshape(image.GetDimensions()[::-1])
    border = numpy.concatenate([cube.take((0, -1), axis).ravel() for axis in range(3)])
    return level, is_mask or bool(numpy.mean(border < level) > 0.5)


def as_level_set(image: Any) -> Any:
    """The image; of a mask, one that is below 0 inside.

    Raises
    ------
    ValueError
        An image without an inside: a map of several labels, or values of 0 and more.
    """
    level, above = usual_level(image)
    values = _with_point_values(image)[1]
    labels = labels_of(image) if not above and values.dtype.kind in "iu" and values.size else []
    if labels and values.min() >= 0:
        raise ValueError(f"The image has the labels {few(labels, 20)}; choose one: --label.")
    if not above and values.size and values.min() >= 0:
        raise ValueError(
            f"The image has no inside, which is below 0: its values are from {values.min():g} to "
            f"{values.max():g}. Give target_iso_value, and invert_target if inside is above."
        )
    if not above:
        return image
    level_set = image.NewInstance()
    level_set.CopyStructure(_with_point_values(image)[0])
    add_array(level_set, "distance", level - values.astype(float))
    level_set.GetPointData().SetActiveScalars("distance")
    return level_set


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
