"""View of a film: the points in view and the up axis, the same for a whole series."""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

from ..presets import estimate_spacing

_FRAMES = 64  # largest number of frames that are read
_LOWER, _FLATTER = 0.05, 1.5  # difference of heights, as a fraction of the box; ratio of sides
_STRAYS, _ROOM = 0.005, 0.25  # fraction of particles cut off at each side; enlargement
_SAMPLED = 2000  # particles of a frame that are searched for strays


def find_view(files: Any, reaches: str | None = None) -> tuple[Any, str]:
    """Returns points around the particles of up to 64 frames of a series, and the up axis, y or z.

    The points are the extremes of each frame in 26 directions, with a margin for the skin. Strays,
    such as drops that fly off, are out of view if their distance from the box of the other
    particles is more than a quarter of the longest side of this box.

    The up axis is the result of `lie` for the bounds and the mean position of all frames. For
    images the points are the corners of the first image's bounds, and the up axis is z.
    """
    axis = numpy.array([-1.0, 0.0, 1.0])
    ways = numpy.stack(numpy.meshgrid(axis, axis, axis), -1).reshape(-1, 3).T
    if files.kind == "vtkImageData":
        corners = product(*numpy.reshape(files.load(0).GetBounds(), (3, 2)))
        return numpy.array(list(corners)), "z"
    outermost, sampled, means = [], [], []
    last = len(files) - 1
    for step in sorted({round(i * last / (_FRAMES - 1)) for i in range(_FRAMES)}):
        cloud = files.load(step)
        if cloud.GetNumberOfPoints() == 0:
            continue
        points = vtk_to_numpy(cloud.GetPoints().GetData())
        points = points[numpy.isfinite(points).all(axis=1)]
        if len(points):
            outermost.append(points[(points @ ways).argmax(axis=0)])
            sampled.append(points[:: 1 + len(points) // _SAMPLED])
            means.append(points.mean(0))
    if not means:
        return numpy.array([[-0.5] * 3, [0.5] * 3]), "z"
    held = _without_strays(numpy.concatenate(outermost), numpy.concatenate(sampled))
    low, high = held.min(axis=0), held.max(axis=0)
    margin = max(0.02 * float((high - low).max()), _own_size(files.load(0), reaches), 1e-30)
    up = lie(low - margin, high + margin, numpy.mean(means, axis=0))
    return numpy.concatenate([held - margin, held + margin]), up


def lie(low: Any, high: Any, mean: Any) -> str:
    """Returns the up axis, y or z: the axis along which the mean is clearly lower in the box.

    If the mean is at about the same height along both axes, returns y if the box is clearly shorter
    along y than along z, else z.
    """
    sides = high - low
    place = (mean - low) / numpy.maximum(sides, 1e-300)
    if abs(place[1] - place[2]) >= _LOWER:
        return "y" if place[1] < place[2] else "z"
    return "y" if sides[2] >= _FLATTER * sides[1] else "z"


def _without_strays(outermost: Any, sampled: Any) -> Any:
    """Returns the outermost points; a few distant points are moved towards the other points."""
    low, high = numpy.quantile(sampled, [_STRAYS, 1.0 - _STRAYS], axis=0)
    room = _ROOM * float((high - low).max())
    return numpy.clip(outermost, low - room, high + room)


def _own_size(cloud: Any, reaches: str | None) -> float:
    """Estimates the largest distance of the skin from the particles."""
    array = cloud.GetPointData().GetArray(reaches) if reaches else None
    if array is not None and array.GetNumberOfTuples():
        return float(array.GetRange()[1])
    return 1.2 * estimate_spacing(cloud)
