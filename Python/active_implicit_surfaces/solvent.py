"""Solvent-excluded surface of atoms as an image of distances, exact near the surface.

A probe, a ball, rolls over the atoms; points that the probe cannot reach are inside. A probe of
radius 0 gives the van der Waals surface. Possible centres of the probe are outside the accessible
balls, whose radii are atom plus probe (Lee and Richards, J. Mol. Biol. 55, 1971). The possible
centre nearest to a point in these balls lies on the surface of one of the balls, or on an arc where
two of the surfaces meet (Connolly, J. Appl. Cryst. 16, 1983).

>>> from active_implicit_surfaces.solvent import excluded_distance
>>> image = excluded_distance([[0, 0, 0], [3, 0, 0]], [1.7, 1.7], probe=1.4, voxel=0.25)
>>> image.GetScalarRange()
(-0.5, 0.5)
"""

from __future__ import annotations

from typing import Any

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdList
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkStaticPointLocator

from .data_objects import add_array, as_particles

BAND = 2.0  # distance from the surface with exact values, in voxels
MOST_POINTS = 100_000_000  # limit for an image
MOST_PAIRS = 20_000_000  # limit for pairs of atoms whose accessible balls overlap
VOXEL = 0.25  # default voxel size, relative to the root mean square radius
_CHORD = 0.1  # voxels lost by flat triangles, per curvature of 1/voxel
_INSIDE = 1e-9  # relative to a radius: tolerance of points on a ball's surface
_NARROWEST = 1e-9  # least length of an arc [rad]
_FEW = 12  # nearest neighbours; they cover most circles within a molecule
_TURN = 2.0 * numpy.pi


def usual_voxel(radii: Any) -> float:
    """Returns the default voxel size, a quarter of the root mean square radius of the atoms."""
    return VOXEL * float(numpy.sqrt(numpy.mean(numpy.square(radii))))


def excluded_distance(centers: Any, radii: Any, probe: float, voxel: float) -> Any:
    """Returns signed distances to the solvent-excluded surface, negative inside.

    - centers (array (n, 3)): centres of the atoms [length].
    - radii (array (n,)): van der Waals radii [length]; atoms are ignored unless the radius is
      finite and more than 0, and the centre finite.
    - probe (float): radius of the probe [length]; 0 or more.
    - voxel (float): spacing of the image's points [length]; their coordinates are multiples of the
      spacing.

    Returns vtkImageData: image with the point array "distance" [length], clamped to +-2 voxels.

    Raises ValueError if all atoms are ignored, the probe touches too many pairs of atoms, or the
    image would be too large.
    """
    radii = numpy.asarray(radii, float).reshape(-1)
    balls = numpy.column_stack([numpy.asarray(centers, float).reshape(-1, 3), radii])
    balls = numpy.unique(balls[(radii > 0) & numpy.isfinite(balls).all(axis=1)], axis=0)
    if len(balls) == 0:
        raise ValueError(
            "No atom has a radius above 0 and a finite position, so there is no surface; give "
            "elements or radii."
        )
    grid = _Grid(balls[:, :3], balls[:, 3], voxel, probe)
    _check_overlaps(grid.centers, grid.radii, probe)
    grid.add_balls()
    near = _neighbours(grid.centers, grid.radii)
    for ball, others in enumerate(near):
        grid.add_patch(ball, others)
    for ball, others in enumerate(near):
        grid.add_arcs(ball, others)
    return grid.image()


def _check_overlaps(centers: Any, radii: Any, probe: float) -> None:
    """Raises ValueError if the probe touches too many pairs of atoms."""
    size = 2.0 * radii.max()
    cells = numpy.floor((centers - centers.min(axis=0)) / size)
    _, counts = numpy.unique(cells, axis=0, return_counts=True)
    pairs = 4 * int((counts.astype(numpy.int64) ** 2).sum())
    if pairs > MOST_PAIRS:
        raise ValueError(
            f"A probe of radius {probe:g} touches too many pairs of atoms at once, an estimated "
            f"{pairs:.3g}, more than {MOST_PAIRS:g}. Select fewer atoms, reduce the radius, "
            "or correct units: probe (water: 1.4 Angstrom), radii and positions need one unit of "
            "length."
        )


def empty_image(voxel: float) -> Any:
    """Returns an image of distances without negative values, for a frame without atoms."""
    return _image_of(numpy.full((2, 2, 2), BAND * voxel), voxel, numpy.zeros(3))


def for_triangles(image: Any) -> Any:
    """Corrects distances so that a skin of flat triangles has the volume of the round surface.

    Triangles with corners on a ball of radius r [voxel] lie 0.2 / r voxels inside the ball on
    average. The correction is 0.1 of the distance's Laplacian, the sum of the two principal
    curvatures [1/voxel].
    """
    array = image.GetPointData().GetScalars()
    values = vtk_to_numpy(array).reshape(image.GetDimensions()[::-1])
    laplacian = -6.0 * values
    for axis in range(3):
        last = values.shape[axis] - 1
        for first in (-1, 1):
            places = numpy.clip(numpy.arange(first, first + last + 1), 0, last)
            laplacian += values.take(places, axis=axis)
    most = BAND * image.GetSpacing()[0]
    rounder = numpy.clip(values - _CHORD * laplacian, -most, most)
    add_array(image, array.GetName(), rounder.reshape(-1), image.GetPointData())
    return image


def _image_of(values: Any, voxel: float, origin: Any) -> Any:
    image = vtkImageData()
    image.SetDimensions(*values.shape)
    image.SetSpacing(*3 * [voxel])
    image.SetOrigin(*origin)
    add_array(image, "distance", values.ravel(order="F"), image.GetPointData())
    image.GetPointData().SetActiveScalars("distance")
    return image


class _Grid:
    """Grid of points near atoms, with three values at each point.

    - owner: index of the accessible ball in which the point is deepest.
    - depth: depth of the point in this ball, negative outside all accessible balls.
    - exit: least distance found so far from the point to a possible centre of the probe; equal to
      `depth` outside all accessible balls.
    """

    def __init__(self, centers: Any, radii: Any, voxel: float, probe: float) -> None:
        self.centers, self.radii = centers, radii + probe
        self.voxel, self.band, self.probe = voxel, BAND * voxel, probe
        self.low, self.shape = _lattice_around(centers, radii, voxel)
        count = least_count = int(numpy.prod(self.shape.astype(float)))
        if count > MOST_POINTS:
            least = voxel
            while least_count > MOST_POINTS:  # the margin grows with the voxel
                least *= 1.03 * (least_count / MOST_POINTS) ** (1 / 3)  # 3 % more: the text rounds
                least_count = numpy.prod(_lattice_around(centers, radii, least)[1].astype(float))
            raise ValueError(
                f"An image of voxels of {voxel:g} around the atoms has {count} points, more than "
                f"{MOST_POINTS}; set the voxel size to {least:.3g} or more."
            )
        self.depth = numpy.full(self.shape, -numpy.inf, "f4")
        self.owner = numpy.zeros(self.shape, "i4")
        self.exit = self.depth

    def add_balls(self) -> None:
        """Finds depth and owner of the points within max(`probe`, `band`) of an atom."""
        for ball, (center, radius) in enumerate(zip(self.centers, self.radii)):
            box, axes = self._box(center, radius + max(0.0, self.band - self.probe))
            x, y, z = ((axis - own) ** 2 for axis, own in zip(axes, center))
            depth = radius - numpy.sqrt(x[:, None, None] + y[:, None] + z)
            is_deeper = depth > self.depth[box]
            self.depth[box][is_deeper] = depth[is_deeper]
            self.owner[box][is_deeper] = ball
        self.exit = numpy.where(self.depth > 0, numpy.float32(numpy.inf), self.depth)

    def add_patch(self, ball: int, others: Any) -> None:
        """Sets `exit` to `depth` at the points of a ball whose nearest surface point is uncovered.

        A point of the ball's surface is uncovered if no other ball contains the point.
        """
        center, radius = self.centers[ball], self.radii[ball]
        box, axes = self._box(center, radius)
        depth = self.depth[box]
        is_own = (self.owner[box] == ball) & (depth > 0) & (depth < self.probe + self.band)
        places, points = _points_in(axes, is_own)
        if not len(points):
            return
        way = points - center
        length = numpy.linalg.norm(way, axis=1)[:, None]
        goals = center + way * (radius / numpy.maximum(length, 1e-300))
        is_free = numpy.ones(len(goals), bool)
        for own in (others[:_FEW], others[_FEW:]):
            (left,) = numpy.nonzero(is_free)
            away = _squares(goals[left], self.centers[own])
            is_free[left] = (away >= (self.radii[own] * (1 - _INSIDE)) ** 2).all(axis=1)
        free = tuple(place[is_free] for place in places)
        self.exit[box][free] = depth[free]

    def add_arcs(self, ball: int, others: Any) -> None:
        """Reduces `exit` to the distance from a ball's arcs, except where `add_patch` set it."""
        for center, radius, half, axes in _arcs_of(ball, others, self.centers, self.radii):
            is_short = half < 0.5 * numpy.pi
            middle = center + (radius * numpy.cos(half) * axes[0] if is_short else 0.0)
            width = radius * (numpy.sin(half) if is_short else 1.0)
            box, lines = self._box(middle, width + self.probe + self.band)
            depth, exit = self.depth[box], self.exit[box]
            is_wanted = (depth > 0) & (exit != depth) & (depth < self.probe + self.band)
            places, points = _points_in(lines, is_wanted)
            x, y, z = axes @ (points - center).T
            found = _distances_to(radius, half, x, numpy.abs(y), z)
            exit[places] = numpy.minimum(exit[places], found)

    def image(self) -> Any:
        """Returns the distances as an image."""
        values = numpy.clip(self.probe - self.exit, -self.band, self.band)
        return _image_of(values.astype("f4"), self.voxel, self.voxel * self.low)

    def _box(self, center: Any, reach: float) -> tuple[Any, list[Any]]:
        """Returns the box around a ball: slices of the grid, and coordinates along each axis."""
        first = numpy.ceil((center - reach) / self.voxel).astype(numpy.int64) - self.low
        end = numpy.floor((center + reach) / self.voxel).astype(numpy.int64) - self.low + 1
        first, end = first.clip(0, self.shape), end.clip(0, self.shape)
        axes = [self.voxel * numpy.arange(*cut) for cut in zip(first + self.low, end + self.low)]
        return tuple(map(slice, first, end)), axes


def _lattice_around(centers: Any, radii: Any, voxel: float) -> tuple[Any, Any]:
    """Returns the lowest node and the shape of the lattice around balls, in voxels."""
    margin = radii[:, None] + (BAND + 1) * voxel
    low = numpy.floor((centers - margin).min(axis=0) / voxel).astype(numpy.int64)
    high = numpy.ceil((centers + margin).max(axis=0) / voxel).astype(numpy.int64)
    return low, high - low + 1


def _points_in(axes: list[Any], chosen: Any) -> tuple[Any, Any]:
    """Returns the indices and the positions of the chosen points of a box."""
    places = numpy.nonzero(chosen)
    return places, numpy.stack([axis[own] for axis, own in zip(axes, places)], axis=1)


def _squares(points: Any, others: Any) -> Any:
    return ((points[:, None] - others) ** 2).sum(axis=2)


def _neighbours(centers: Any, radii: Any) -> list[Any]:
    """Returns the balls that each ball overlaps, nearest first."""
    locator, found, near = vtkStaticPointLocator(), vtkIdList(), list[Any]()
    cloud = as_particles(centers)
    locator.SetDataSet(cloud)
    locator.BuildLocator()
    for ball, (center, radius) in enumerate(zip(centers, radii)):
        locator.FindPointsWithinRadius(radius + radii.max(), center, found)
        others = numpy.array([found.GetId(i) for i in range(found.GetNumberOfIds())])
        away = ((centers[others] - center) ** 2).sum(axis=1)
        own = (away < (radius + radii[others]) ** 2) & (others != ball)
        near.append(others[own][numpy.lexsort((others[own], away[own]))])
    return near


def _arcs_of(ball: int, near: Any, centers: Any, radii: Any) -> Any:
    """Yields the arcs, uncovered by other balls, where a ball meets balls of higher index.

    An arc has a centre, a radius, half of its angle, and three axes as rows: towards the middle of
    the arc, across the first axis in the plane of the circle, and normal to the plane.
    """
    second = near[near > ball]
    way = centers[second] - centers[ball]
    distance = numpy.linalg.norm(way, axis=1)
    meet = distance > numpy.abs(radii[ball] - radii[second])
    second, way, distance = second[meet], way[meet], distance[meet]
    axis = way / distance[:, None]
    along = (distance**2 + radii[ball] ** 2 - radii[second] ** 2) / (2 * distance)
    middles = centers[ball] + along[:, None] * axis
    sizes = numpy.sqrt(numpy.maximum(radii[ball] ** 2 - along**2, 0.0))
    one = numpy.cross(axis, numpy.eye(3)[numpy.abs(axis).argmin(axis=1)])
    one /= numpy.linalg.norm(one, axis=1)[:, None]
    frames = numpy.stack([one, numpy.cross(axis, one), axis], axis=1)
    left = numpy.arange(len(second))
    for others in (near[:_FEW], near):
        if not len(left):
            return
        away = centers[others] - middles[left, None]
        x, y = numpy.einsum("ijk,ilk->lij", away, frames[left, :2])
        excess = (away**2).sum(axis=2) + sizes[left, None] ** 2 - radii[others] ** 2
        scale = 2.0 * sizes[left, None] * numpy.hypot(x, y)
        covers = (excess < scale) & (others != second[left, None])
        rows, low, high = _gaps(covers, numpy.arctan2(y, x), excess, scale)
        left = left[rows] if others is near else left[numpy.unique(rows)]
    for place, start, end in zip(left, low, high):
        turned, half = 0.5 * (start + end), 0.5 * (end - start)
        (x, y, z), cos, sin = frames[place], numpy.cos(turned), numpy.sin(turned)
        axes = numpy.stack([cos * x + sin * y, cos * y - sin * x, z])
        yield middles[place], sizes[place], half, axes


def _gaps(covers: Any, angles: Any, excess: Any, scale: Any) -> tuple[Any, Any, Any]:
    """Returns the uncovered arcs of circles: row (index of the circle), start, end in [0, 2 pi]."""
    with numpy.errstate(divide="ignore", invalid="ignore"):
        half = numpy.where(excess <= -scale, numpy.pi, numpy.arccos(excess / scale))
    starts = numpy.where(covers, (angles - half) % _TURN, 0.0)
    ends = numpy.where(covers, starts + 2 * half, 0.0)
    none = numpy.zeros((len(covers), 1))
    starts = numpy.hstack([starts, numpy.zeros(starts.shape), none + _TURN])
    ends = numpy.hstack([numpy.minimum(ends, _TURN), ends - _TURN, none + _TURN])
    order = starts.argsort(axis=1)
    starts, ends = (numpy.take_along_axis(own, order, 1) for own in (starts, ends))
    reached = numpy.maximum.accumulate(numpy.hstack([none, ends[:, :-1]]), axis=1)
    rows, places = numpy.nonzero(starts > reached + _NARROWEST)
    return rows, reached[rows, places], starts[rows, places]


def _distances_to(radius: float, half: float, x: Any, y: Any, z: Any) -> Any:
    """Returns distances from an arc to points x, y, z in the axes of the arc, with y >= 0."""
    cos, sin = numpy.cos(half), numpy.sin(half)
    to_end = (x - radius * cos) ** 2 + (y - radius * sin) ** 2
    is_ahead = (y * cos <= x * sin) | (half >= numpy.pi)
    inwards = (numpy.hypot(x, y) - radius) ** 2
    return numpy.sqrt(z**2 + numpy.where(is_ahead, inwards, to_end))
