"""Solvent-excluded surface of atoms as an image of distances, exact at the image's points.

A probe, a ball, rolls over the atoms; points that it cannot reach are inside. With radius 0 the
surface is the van der Waals surface.

>>> from active_implicit_surfaces.solvent import excluded_distance
>>> image = excluded_distance([[0, 0, 0], [3, 0, 0]], [1.7, 1.7], probe=1.4, voxel=0.25)
>>> image.GetScalarRange()
(-0.5, 0.5)
"""

from __future__ import annotations

from typing import Any

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData

from .accessible import Arcs, Neighbours, chunks, exposed_arcs, find_neighbours, ranges
from .data_objects import add_array

BAND = 2.0  # distance from the surface with exact values, in voxels
MOST_POINTS = 100_000_000  # limit for an image
MOST_PAIRS = 20_000_000  # limit for pairs of atoms whose accessible balls overlap
VOXEL = 0.25  # relative to the root mean square radius
_SIDE = 4  # points along an edge of a block
_CHORD = 0.1  # voxels lost by flat triangles, per curvature of 1/voxel
_INSIDE = 1e-9  # relative to a radius: tolerance of points on a ball's surface


def usual_voxel(radii: Any) -> float:
    """Returns a quarter of the root mean square radius, usually 0.3 to 0.45 Angstrom."""
    return VOXEL * float(numpy.sqrt(numpy.mean(numpy.square(radii))))


def excluded_distance(centers: Any, radii: Any, probe: float, voxel: float) -> Any:
    """Returns signed distances to the solvent-excluded surface, negative inside.

    Parameters
    ----------
    centers : array (n, 3)
        Centres of the atoms [length].
    radii : array (n,)
        Van der Waals radii [length]; atoms without a radius are ignored.
    probe : float
        Radius of the probe [length]; 0 or more.
    voxel : float
        Spacing of the image's points [length]; their coordinates are multiples of the spacing.

    Returns
    -------
    vtkImageData
        Image with the point array "distance" [length], clamped to two voxels.

    Raises
    ------
    ValueError
        No atom has a radius, or the image would be too large.
    """
    radii = numpy.asarray(radii, float).reshape(-1)
    balls = numpy.column_stack([numpy.asarray(centers, float).reshape(-1, 3), radii])
    balls = numpy.unique(balls[(radii > 0) & numpy.isfinite(balls).all(axis=1)], axis=0)
    if len(balls) == 0:
        raise ValueError("No atom has a radius, so a probe has nothing to roll over.")
    centers, radii = balls[:, :3], balls[:, 3] + probe
    grid = _Grid(centers, balls[:, 3], voxel, BAND * voxel, probe)
    _check_overlaps(centers, radii, probe)
    near = find_neighbours(centers, radii)
    arcs = exposed_arcs(centers, radii, near)
    grid.add_balls(centers, radii)
    grid.add_patches(centers, radii, near, arcs)
    grid.add_arcs(arcs)
    return grid.image()


def _check_overlaps(centers: Any, radii: Any, probe: float) -> None:
    """Raises ValueError if the probe touches too many atoms at once."""
    size = 2.0 * radii.max()
    cells = numpy.floor((centers - centers.min(axis=0)) / size)
    _, counts = numpy.unique(cells, axis=0, return_counts=True)
    if 4 * int((counts.astype(numpy.int64) ** 2).sum()) > MOST_PAIRS:
        raise ValueError(
            f"A probe of {probe:g} touches too many atoms at once; reduce its radius. The usual "
            "probe, water, has 1.4 Angstrom, in the length unit of the atoms."
        )


def empty_image(voxel: float) -> Any:
    """Returns an image of distances with an empty inside, for a frame without atoms."""
    image = vtkImageData()
    image.SetDimensions(2, 2, 2)
    image.SetSpacing(*3 * [voxel])
    add_array(image, "distance", numpy.full(8, BAND * voxel), image.GetPointData())
    image.GetPointData().SetActiveScalars("distance")
    return image


def for_triangles(image: Any) -> Any:
    """Corrects distances so that a skin of flat triangles has the volume of the round surface.

    Triangles with corners on a ball of r voxels lie 0.2 / r voxels inside the ball on average. The
    correction is 0.1 of the distance's Laplacian, which is the curvature [1/voxel].
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


class _Grid:
    """Blocks of 4 x 4 x 4 points near atoms, with the state of the distance for each point.

    `depth` is the depth of the point in its deepest accessible ball, `owner` the index of this
    ball, `exit` the least distance found so far to possible centres of the probe.
    """

    def __init__(self, centers: Any, radii: Any, voxel: float, band: float, probe: float) -> None:
        self.voxel, self.band, self.probe = voxel, band, probe
        margin = radii[:, None] + (BAND + 1) * voxel
        self.low = numpy.floor((centers - margin).min(axis=0) / voxel).astype(numpy.int64)
        high = numpy.ceil((centers + margin).max(axis=0) / voxel).astype(numpy.int64)
        self.shape = (high - self.low) // _SIDE + 1
        count = int(numpy.prod(self.shape.astype(float))) * _SIDE**3
        if count > MOST_POINTS:
            least = voxel * (count / MOST_POINTS) ** (1 / 3)
            raise ValueError(
                f"An image of voxels of {voxel:g} around the atoms has {count} points, more than "
                f"{MOST_POINTS}; set the voxel size to {least:.2g} or more."
            )
        self.corners = numpy.stack(numpy.meshgrid(*3 * [numpy.arange(_SIDE)], indexing="ij"), -1)
        self.corners = self.corners.reshape(-1, 3)
        self.blocks = numpy.zeros(0, numpy.int64)
        self.depth = self.exit = self.owner = numpy.zeros((0, _SIDE**3))

    def add_balls(self, centers: Any, radii: Any) -> None:
        """Finds depth and owner of all points that are not far outside."""
        keys, balls = self._blocks_near(centers, radii + max(0.0, self.band - self.probe))
        order = numpy.lexsort((balls, keys))
        keys, balls = keys[order], balls[order]
        self.blocks, firsts, counts = numpy.unique(keys, return_index=True, return_counts=True)
        self.depth = numpy.full((len(self.blocks), _SIDE**3), -numpy.inf)
        self.owner = numpy.zeros(self.depth.shape, numpy.int64)
        for own in chunks(counts * _SIDE**3):
            pairs = slice(firsts[own][0], firsts[own][-1] + counts[own][-1])
            away = self._starts(keys[pairs]) - centers[balls[pairs]]
            x, y, z = ((away[..., None] + self.voxel * numpy.arange(_SIDE)) ** 2).swapaxes(0, 1)
            away = x[:, :, None, None] + y[:, None, :, None] + z[:, None, None, :]
            depth = radii[balls[pairs], None] - numpy.sqrt(away.reshape(len(x), -1))
            deepest = numpy.maximum.reduceat(depth, firsts[own] - firsts[own][0], axis=0)
            self.depth[own] = deepest
            rows = numpy.repeat(numpy.arange(own.stop - own.start), counts[own])
            pair, point = numpy.nonzero(depth == deepest[rows])
            self.owner[own.start + rows[pair], point] = balls[pairs][pair]
        self.exit = numpy.where(self.depth > 0, numpy.inf, self.depth)

    def add_patches(self, centers: Any, radii: Any, near: Neighbours, arcs: Arcs) -> None:
        """Sets the exit radially out of the owner of a point, if no other ball covers it."""
        is_open = near.counts == 0
        is_open[arcs.balls] = True
        reached = (self.depth > 0) & (self.depth < self.probe + self.band) & is_open[self.owner]
        row, corner = numpy.nonzero(reached)
        owner = self.owner[row, corner]
        for own in chunks(near.counts[owner] + 1):
            points = self._starts(self.blocks[row[own]]) + self.voxel * self.corners[corner[own]]
            ball = owner[own]
            way = points - centers[ball]
            length = numpy.linalg.norm(way, axis=1)[:, None]
            goal = centers[ball] + way * (radii[ball, None] / numpy.maximum(length, 1e-300))
            rows, others = near.expand(ball)
            away = ((goal[rows] - centers[others]) ** 2).sum(axis=1)
            blocked = numpy.zeros(len(ball), bool)
            blocked[rows[away < (radii[others] * (1 - _INSIDE)) ** 2]] = True
            free = numpy.flatnonzero(~blocked) + own.start
            self.exit[row[free], corner[free]] = self.depth[row[free], corner[free]]

    def add_arcs(self, arcs: Arcs) -> None:
        """Updates the exits with the nearest points of the arcs."""
        wanted = numpy.isinf(self.exit) & (self.depth < self.probe + self.band)
        holds = numpy.zeros(int(numpy.prod(self.shape)), bool)
        holds[self.blocks[wanted.any(axis=1)]] = True
        short = arcs.halves < 0.5 * numpy.pi
        chord = numpy.where(short, numpy.cos(arcs.halves), 0.0)[:, None] * arcs.radii[:, None]
        middles = arcs.centers + chord * arcs.axes[:, 0]
        widths = numpy.where(short, numpy.sin(arcs.halves), 1.0) * arcs.radii
        keys, numbers = self._blocks_near(middles, widths + self.probe + self.band, holds)
        order = numpy.argsort(keys, kind="stable")
        keys, numbers = keys[order], numbers[order]
        found, firsts, counts = numpy.unique(keys, return_index=True, return_counts=True)
        own_rows = numpy.searchsorted(self.blocks, found)
        for own in chunks(counts * _SIDE**3):
            pairs = slice(firsts[own][0], firsts[own][-1] + counts[own][-1])
            some = arcs.rows(numbers[pairs])
            away = self._starts(keys[pairs]) - some.centers
            places = numpy.einsum("ikj,ij->ik", some.axes, away)[:, :, None]
            places = places + some.axes @ (self.voxel * self.corners.T)
            distances = _distances_to(some, *places.swapaxes(0, 1))
            least = numpy.minimum.reduceat(distances, firsts[own] - firsts[own][0], axis=0)
            known = self.exit[own_rows[own]]
            self.exit[own_rows[own]] = numpy.where(wanted[own_rows[own]], least, known)

    def image(self) -> Any:
        """Returns the distances as an image."""
        values = numpy.full((int(numpy.prod(self.shape)), _SIDE**3), self.band, dtype=numpy.float32)
        values[self.blocks] = numpy.clip(self.probe - self.exit, -self.band, self.band)
        values = values.reshape(*self.shape, *3 * [_SIDE]).transpose(2, 5, 1, 4, 0, 3)
        image = vtkImageData()
        image.SetDimensions(*map(int, self.shape * _SIDE))
        image.SetSpacing(*3 * [self.voxel])
        image.SetOrigin(*(self.voxel * self.low))
        add_array(image, "distance", values.reshape(-1), image.GetPointData())
        image.GetPointData().SetActiveScalars("distance")
        return image

    def _starts(self, keys: Any) -> Any:
        """Returns the first point of each block, an array (n, 3)."""
        block = numpy.stack(numpy.unravel_index(keys, self.shape), axis=-1)
        return self.voxel * (block * _SIDE + self.low)

    def _blocks_near(self, centers: Any, reaches: Any, holds: Any = None) -> tuple[Any, Any]:
        """Returns pairs of a block and a ball that touches the block."""
        edge = _SIDE * self.voxel
        half = 0.5 * (_SIDE - 1) * self.voxel
        start = self.voxel * self.low + half  # centre of the first block
        low, high = centers - reaches[:, None] - half, centers + reaches[:, None] + half
        first = numpy.maximum(numpy.ceil((low - start) / edge), 0).astype(numpy.int64)
        last = numpy.minimum(numpy.floor((high - start) / edge), self.shape - 1).astype(numpy.int64)
        sizes = numpy.maximum(last - first + 1, 0)
        counts, found = sizes.prod(axis=1), list[Any]()
        for own in chunks(counts):
            rows = numpy.repeat(numpy.arange(own.start, own.stop), counts[own])
            index = ranges(numpy.zeros(own.stop - own.start, numpy.int64), counts[own])
            _, wide, deep = sizes[rows].T
            place = numpy.stack([index // (wide * deep), index // deep % wide, index % deep], -1)
            place += first[rows]
            outside = numpy.abs(start + edge * place - centers[rows]) - half
            away = (numpy.maximum(outside, 0.0) ** 2).sum(axis=1)
            keys = numpy.ravel_multi_index(tuple(place.T), self.shape)
            near = away <= reaches[rows] ** 2
            near &= True if holds is None else holds[keys]
            found.append((keys[near], rows[near]))
        none = [(numpy.zeros(0, numpy.int64), numpy.zeros(0, numpy.int64))]
        keys, rows = (numpy.concatenate(own) for own in zip(*(found or none)))
        return keys, rows


def _distances_to(arcs: Arcs, x: Any, y: Any, z: Any) -> Any:
    """Returns distances (n, m) of m points, in the axes of each of n arcs, to the arc."""
    radius, half = arcs.radii[:, None], arcs.halves[:, None]
    cos, sin, y = numpy.cos(half), numpy.sin(half), numpy.abs(y)
    inwards = numpy.hypot(x, y) - radius
    to_end = (x - radius * cos) ** 2 + (y - radius * sin) ** 2
    ahead = (y * cos <= x * sin) | (half >= numpy.pi)
    return numpy.sqrt(z**2 + numpy.where(ahead, inwards**2, to_end))
