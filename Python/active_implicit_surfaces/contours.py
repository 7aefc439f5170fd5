"""Levels of images, and the closed surface of an image at a level.

The surface is an initial skin of the filter, so no triangle is degenerate.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkCellDataToPointData

from .data_objects import add_array, copy_of, output_of, vtk_points
from .messages import few, listening, warn

_OVER, _FULL = 0.1, 1e-3  # volume fractions: excess over 0 or 1; tolerance of 0 and 1


def contour(image: Any, level: float, *, above: bool = False) -> Any:
    """Returns the surface of an image at a level.

    - image (vtkImageData): active scalars, of points or cells, with one component.
    - level (float): value on the surface [unit of the values].
    - above (bool): True if inside is above the level, as in a density; False if below, as in a
      level set.

    Returns vtkPolyData: triangles oriented outward, closed at the border of the image, with
    normals; empty unless there are values on both sides of the level.

    Raises ValueError if an image with points has no active scalars with one component. If there are
    values on both sides, also raises ValueError if the filter reports an error, as for a flat image
    or too many voxels, and warns if the filter warns, as of values that are not finite.
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
    warn(*heard.warnings)
    skin = surface.GetOutput()
    if numpy.any(shift) and skin.GetNumberOfPoints():
        skin.SetPoints(vtk_points(vtk_to_numpy(skin.GetPoints().GetData()) + shift))
    return skin


def usual_level(image: Any, level: float | None = None) -> tuple[float, bool]:
    """Returns the level of an image, and True if inside is above the level.

    - Mask (only two values): the level is midway between the values, inside above. If the lower
      value is negative, inside is above only if most values at the image's border are the lower
      value.
    - Volume fractions (about 0 to 1, most 0 or 1): the level is 0.5, inside above.
    - Other images: the level is 0, inside below.

    A given `level` is returned unchanged. Inside is then above if these rules say so, or if most
    values at the image's border are below `level`.
    """
    image, values = _with_point_values(image)
    border = _at_border(image, values)
    usual, above = _usual_level(values, border)
    if level is None:
        return usual, above
    return level, above or bool(numpy.mean(border < level) > 0.5)


def level_of_series(images: list[Any]) -> tuple[float, bool]:
    """Returns one level for a series, and True if inside is above, by the rules of `usual_level`.

    Raises ValueError if the images have several labels, or nothing is inside by these rules.
    """
    every = [_with_point_values(image) for image in images]
    border = numpy.concatenate([_at_border(*one) for one in every])
    joined = numpy.concatenate([values for _, values in every])
    level, above = _usual_level(joined, border)
    values = numpy.unique(joined)
    labels = [int(value) for value in values if value] if values.dtype.kind in "iu" else []
    if above or not values.size or values[0] < 0:
        return level, above
    if len(labels) > 1:
        raise ValueError(
            f"The image has the values {few(labels, 20)}; if they are labels, choose one "
            "(active-surface --label, or vtkImageThreshold), else give target_iso_value, the value "
            "at the surface, and, if the values inside are larger, invert_target."
        )
    finite = values[numpy.isfinite(values)]
    if not finite.size:
        raise ValueError("The image has no finite value, so no inside; give another image.")
    if finite[0] == finite[-1]:
        kind = "" if len(finite) == len(values) else "finite "
        raise ValueError(
            f"The image has no surface: all {kind}values are {finite[0]:g}. Choose another label "
            "or file."
        )
    raise ValueError(
        f"The image has no inside: its finite values are from {finite[0]:g} to {finite[-1]:g}, "
        "none below 0. "
        "Give target_iso_value, the value at the surface, and, if the values inside are larger, "
        "invert_target."
    )


def as_level_set(image: Any, level: float, above: bool) -> Any:
    """Returns an image that is 0 at the level and negative inside; `image` if it is already so."""
    if not above and level == 0:
        return image
    own, values = _with_point_values(image)
    over = values.astype(float) - level
    return _like(own, "distance", -over if above else over)


def converter_of_series(images: list[Any]) -> Callable[[Any], Any]:
    """Returns a function that converts all images of a series in one way, found from `images`.

    If only two values occur in `images`, the images are masks, which become labels: 1 inside, 0
    outside. Other images become level sets, negative inside. Raises ValueError as `level_of_series`
    does.
    """
    own = [_at_pixels(one) for one in images]
    values = numpy.concatenate([values for _, values in own])
    if len(numpy.unique(values[numpy.isfinite(values)])) == 2:
        border = numpy.concatenate([_at_border(*one) for one in own])
        mask_level, is_above = _usual_level(values, border)
        return _label_converter(mask_level, is_above)
    level, above = level_of_series(images)
    return lambda image: as_level_set(image, level, above)


def _label_converter(level: float, above: bool) -> Callable[[Any], Any]:
    """Returns a function that converts masks to labels; it warns of the first NaN or infinity."""
    is_told = False

    def convert(image: Any) -> Any:
        nonlocal is_told
        own, values = _at_pixels(image)
        bad = values.size - numpy.count_nonzero(numpy.isfinite(values))
        if bad and not is_told:
            is_told = True
            warn(
                f"{bad} of {values.size} values of the image are not finite. In this mask NaN "
                "counts as outside, and infinity by its sign; replace them by finite values."
            )
        return _like(own, "label", (values > level if above else values < level).astype("u1"))

    return convert


def _at_pixels(image: Any) -> tuple[Any, Any]:
    """Returns an image and its values; for cell values, the image's points are cell centres."""
    if image.GetPointData().GetScalars() is not None or image.GetCellData().GetScalars() is None:
        return _with_point_values(image)
    values = vtk_to_numpy(image.GetCellData().GetScalars())
    centres, low = image.NewInstance(), image.GetExtent()[::2]
    centres.CopyStructure(image)
    centres.SetDimensions([max(n - 1, 1) for n in image.GetDimensions()])
    turn, sides = image.GetDirectionMatrix(), image.GetSpacing()
    away = [sides[j] * (low[j] + 0.5 * (image.GetDimensions()[j] > 1)) for j in range(3)]
    centres.SetOrigin(
        [
            image.GetOrigin()[i] + sum(turn.GetElement(i, j) * away[j] for j in range(3))
            for i in range(3)
        ]
    )
    return centres, values


def _like(image: Any, name: str, values: Any) -> Any:
    other = image.NewInstance()
    other.CopyStructure(image)
    add_array(other, name, values)
    other.GetPointData().SetActiveScalars(name)
    return other


def _at_border(image: Any, values: Any) -> Any:
    """Returns the values at the faces of the image's box."""
    cube = values.reshape(image.GetDimensions()[::-1])
    return numpy.concatenate([cube.take((0, -1), axis).ravel() for axis in range(3)])


def _usual_level(values: Any, border: Any) -> tuple[float, bool]:
    values = values[numpy.isfinite(values)]
    low, high = (float(values.min()), float(values.max())) if values.size else (0.0, 0.0)
    is_mask = low < high and bool(numpy.all((values == low) | (values == high)))
    if is_mask and low < 0:
        return 0.5 * (low + high), bool(numpy.mean(border == low) > 0.5)
    if is_mask or not (low > -_OVER and 1.0 - _OVER < high < 1.0 + _OVER):
        return (0.5 * (low + high), True) if is_mask else (0.0, False)
    is_fraction = numpy.mean(numpy.minimum(abs(values), abs(values - 1.0)) < _FULL) > 0.5
    return (0.5, True) if is_fraction else (0.0, False)


def _with_point_values(image: Any) -> tuple[Any, Any]:
    """Returns the image, with cell values converted to point values, and the point values."""
    if image.GetPointData().GetScalars() is None and image.GetCellData().GetScalars() is not None:
        image = output_of(vtkCellDataToPointData(), image)
    scalars = image.GetPointData().GetScalars()
    if scalars is None or scalars.GetNumberOfComponents() != 1:
        raise ValueError(
            "The image has no active scalars with one component; set them, or give another image."
        )
    return image, vtk_to_numpy(scalars)


def _voxel_size(image: Any) -> float:
    """Returns the smallest spacing of an axis with more than one point."""
    sides = [s for s, n in zip(image.GetSpacing(), image.GetDimensions()) if n > 1]
    return float(min(sides or image.GetSpacing()))


def _on_the_lattice(image: Any) -> tuple[Any, Any]:
    """Returns a copy whose origin is moved to a node of the filter's lattice, and the offset.

    If the image has equal spacings and is not rotated, all points of the copy are nodes, so the
    filter does not interpolate values.
    """
    origin = numpy.array(image.GetOrigin())
    place = numpy.rint(origin / _voxel_size(image)) * _voxel_size(image)
    moved = copy_of(image)
    moved.SetOrigin(*place)
    return moved, origin - place
