"""Presets: named sets of property values, scaled to the data.

Lengths scale with the particle spacing or the particles' radii. Rates scale with 1 / (time between
two frames).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdList
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkStaticPointLocator

from .data_objects import finite_points, has_polygons, points_of

PRESETS = {
    "viscous": "for honey, lava and mud, and for noisy particles: rounder and flatter",
    "molecule": "for atoms: balls that merge where they touch; radii from the elements, or --radii",
    "grains": "for piling sand and beads: separate balls; radii: --radii, array radius, or spacing",
    "paper": "the published scheme (kernels), for comparison: each particle is visible",
}
# The kernel WYVILL, (1 - q^2)^3, has the value ATOM_LEVEL at q = 0.7947. Because kernels are only
# slightly larger than the atoms, touching atoms merge only near their contact.
ATOM_LEVEL, REACH_OF_ATOM = 0.05, 1.0 / 0.7947
_RADII = 0  # index of SetInputArrayToProcess
_SAMPLED = 2000  # particles whose neighbours are searched
_NEIGHBOURS = 3
_VOXELS_OF_GRAIN = 3.0  # voxels per radius: the volume of 1,000 touching grains is exact to 3 %
_COARSE = 0.1  # largest step between single-precision positions, in particle spacings
_STEPS = 6.0  # distances fall by a factor e^6 per frame, as by the automatic Attraction


def apply_preset(
    surface: Any, source: Any, name: str, interval: float | None, options: Mapping[str, Any]
) -> None:
    """Sets a preset's properties; `options`, which the caller sets later, override the preset."""
    if name not in PRESETS:
        raise ValueError(f"There is no preset {name!r}; there are {', '.join(PRESETS)}.")
    if name in ("molecule", "grains"):
        _show_balls(surface, source, name == "grains", options)
        return
    spacing = options.get("particle_spacing") or series_spacing(source.frames_that_tell())
    step = (interval or median_step(source.times)) * options.get("time_scale", 1.0)
    if name == "paper":
        surface.PaperFaithful()
        # The speed is proportional to a sum of kernels, which falls by about 1 over half a spacing.
        surface.SetAttraction(_STEPS / step * 0.5 * spacing)
    else:
        _smooth(surface, spacing, options.get("attraction"), step)


def estimate_spacing(cloud: Any) -> float:
    """Estimates the spacing as the median distance to the third nearest particle.

    For two or three particles, uses the distance to the farthest particle. Returns 0 for fewer than
    two particles. Unlike the filter's estimate, does not depend on radii and periodic boxes.
    """
    cloud = finite_points(cloud)
    count = cloud.GetNumberOfPoints()
    if count < 2:
        return 0.0
    locator, nearest = vtkStaticPointLocator(), vtkIdList()
    locator.SetDataSet(cloud)
    locator.BuildLocator()
    points = vtk_to_numpy(cloud.GetPoints().GetData())
    distances = []
    for i in numpy.linspace(0, count - 1, min(count, _SAMPLED)).astype(int):
        locator.FindClosestNPoints(_NEIGHBOURS + 1, points[i], nearest)
        others = [nearest.GetId(j) for j in range(nearest.GetNumberOfIds())]
        distances.append(float(numpy.linalg.norm(points[others] - points[i], axis=1).max()))
    return float(numpy.median(distances))


def describe_precision(cloud: Any, spacing: float) -> list[str]:
    """Returns a list with a warning if single precision is too coarse for a spacing; else []."""
    points = points_of(finite_points(cloud))
    if points.dtype.itemsize > 4 or len(points) == 0:
        return []
    step = float(numpy.spacing(numpy.abs(points).max()))
    if not spacing or step <= _COARSE * spacing:
        return []
    return [
        f"The particles' positions are of single precision, with steps of up to {step:.2g} here, "
        f"where their spacing is {spacing:g}; use double precision, or data near the origin."
    ]


def is_point_cloud(data: Any) -> bool:
    """Returns True for a vtkPolyData without polygons and lines, and for other point sets."""
    if data.IsA("vtkPolyData"):
        return not has_polygons(data) and data.GetNumberOfLines() == 0
    return bool(data.IsA("vtkPointSet"))


def series_spacing(frames: list[Any]) -> float:
    """Returns the least positive spacing that is estimated in a frame; 0 if there is none.

    Frames with less than a tenth of the largest number of particles, as early spray, are ignored.
    """
    clouds = [frame for frame in frames if is_point_cloud(frame)]
    most = max((cloud.GetNumberOfPoints() for cloud in clouds), default=0)
    found = [estimate_spacing(cloud) for cloud in clouds if cloud.GetNumberOfPoints() >= 0.1 * most]
    return min((spacing for spacing in found if spacing > 0), default=0.0)


def _smooth(surface: Any, spacing: float, attraction: float | None, step: float) -> None:
    attraction = 0.5 * _STEPS / step if attraction is None else attraction
    surface.SetParticleModelToAnisotropic()
    surface.SetAttraction(attraction)
    surface.SetTension(6.0 * attraction * (0.5 * spacing) ** 2)


def median_step(times: list[float]) -> float:
    """Returns the median time between two frames; 1 if there is only one frame."""
    steps = numpy.diff(times)
    return float(numpy.median(steps)) if len(steps) else 1.0


def _show_balls(surface: Any, source: Any, are_grains: bool, options: Mapping[str, Any]) -> None:
    """Sets the model SUM with short kernels.

    Radii are the chosen array, or, if none is chosen and "kernel_radius" is not in `options`, the
    array "radius". Without an array, the kernel radius is that in `options`, else one that follows
    from the spacing.
    """
    first = source.first_frame()
    name = surface.GetInputArrayInformation(_RADII).Get(vtkDataObject.FIELD_NAME())
    name = name or ("" if "kernel_radius" in options else "radius")
    radii = first.GetPointData().GetArray(name) if name and first.GetNumberOfPoints() else None
    spacing = options.get("particle_spacing") or estimate_spacing(first)
    radius = 0.5 * spacing if radii is None else float(numpy.median(vtk_to_numpy(radii)))
    surface.SetParticleModelToSum()
    surface.SetParticleThreshold(ATOM_LEVEL)
    surface.SetVoxelSize(radius / _VOXELS_OF_GRAIN if are_grains else spacing / 3.0)
    if radii is not None:
        points = vtkDataObject.FIELD_ASSOCIATION_POINTS
        surface.SetInputArrayToProcess(_RADII, 0, 0, points, radii.GetName())
    elif "kernel_radius" not in options:
        overlap = 1.0 if are_grains else 2.6  # of radius, half of the spacing
        surface.SetKernelRadius(overlap * REACH_OF_ATOM * radius)
