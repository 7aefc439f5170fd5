"""Moves and scales the second shape of a metamorphosis to the first one."""

from __future__ import annotations

from typing import Any

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

from .data_objects import vtk_points

FITS = ("none", "centre", "box")
_FAR = 1.5  # largest ratio of sizes


def fitted(shape: Any, model: Any, fit: str) -> Any:
    """Returns the shape, moved and scaled to the model.

    - shape, model (vtkPolyData or vtkImageData)
    - fit (str): "none": unchanged. "centre": moved to the centre of the model's bounds. "box":
      scaled to the longest side of these bounds too.
    """
    centre, size = _box(shape)
    to_centre, to_size = _box(model)
    if fit == "none" or size == 0 or to_size == 0:
        return shape
    scale = to_size / size if fit == "box" else 1.0
    moved = shape.NewInstance()
    moved.ShallowCopy(shape)
    if shape.IsA("vtkImageData"):
        moved.SetOrigin(*(to_centre + scale * (numpy.array(shape.GetOrigin()) - centre)))
        moved.SetSpacing(*(scale * numpy.array(shape.GetSpacing())))
        return moved
    places = vtk_to_numpy(shape.GetPoints().GetData()).astype(float)
    moved.SetPoints(vtk_points(to_centre + scale * (places - centre)))
    return moved


def describe_difference(first: Any, last: Any) -> str:
    """Returns a warning if two shapes differ much in size or position; else nothing."""
    (centre, size), (to_centre, to_size) = _box(first), _box(last)
    if size == 0 or to_size == 0:
        return ""
    apart = float(numpy.linalg.norm(to_centre - centre))
    if 1 / _FAR <= to_size / size <= _FAR and apart <= 0.5 * max(size, to_size):
        return ""
    return (
        f"The first shape is {size:g} long and the last one {to_size:g}; their centres are "
        f"{apart:g} apart. If these are other units or another place, fit brings the last one to "
        "the first: --fit box, or centre."
    )


def _box(shape: Any) -> tuple[Any, float]:
    """Returns centre and longest side of the bounds; zeros for a shape without points."""
    if shape.GetNumberOfPoints() == 0:
        return numpy.zeros(3), 0.0
    bounds = numpy.array(shape.GetBounds()).reshape(3, 2)
    return bounds.mean(axis=1), float(numpy.ptp(bounds, axis=1).max())
