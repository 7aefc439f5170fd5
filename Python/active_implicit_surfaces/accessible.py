"""Boundary of a union of balls: exact distances from inside, by its patches, arcs and corners.

With radii of atoms plus that of a probe this is the solvent-accessible surface (Lee and Richards,
J. Mol. Biol. 55, 1971). The surface point nearest to an inner point lies on a ball, on the circle
where two balls meet, or where three do (Connolly, J. Appl. Cryst. 16, 1983). VTK has no such class.

>>> import numpy
>>> from active_implicit_surfaces.accessible import exposed_arcs
>>> arcs = exposed_arcs(numpy.array([[0.0, 0, 0], [2, 0, 0]]), numpy.array([1.25, 1.25]))
>>> arcs.centers.tolist(), arcs.radii.tolist(), arcs.halves.round(3).tolist()
([[1.0, 0.0, 0.0]], [0.75], [3.142])
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy

_CHUNK = 1 << 20  # numbers in a temporary array
_NARROWEST = 1e-9  # of an arc [rad]
_FEW = 12  # neighbours, which cover most circles within a molecule


class Arcs(NamedTuple):
    """Arcs of circles, symmetric about the first axis of each.

    Attributes
    ----------
    centers : array (n, 3)
    radii, halves : array (n,)
        Radius of the circle, and half of the angle, at most pi.
    axes : array (n, 3, 3)
        Rows: direction of the arc's middle, direction across it, axis of the circle.
    balls : array (n, 2)
        Indices of the two balls that meet in the arc.
    """

    centers: Any
    radii: Any
    halves: Any
    axes: Any
    balls: Any

    def rows(self, chosen: Any) -> Arcs:
        """Returns the chosen arcs."""
        return Arcs(*(values[chosen] for values in self))


class Neighbours(NamedTuple):
    """Neighbour lists: ball i has `counts[i]` `others` from `starts[i]` on, nearest first."""

    starts: Any
    counts: Any
    others: Any

    def expand(self, balls: Any, most: int | None = None) -> tuple[Any, Any]:
        """Returns positions in `balls`, repeated for each neighbour, and the neighbours."""
        counts = self.counts[balls] if most is None else numpy.minimum(self.counts[balls], most)
        rows = numpy.repeat(numpy.arange(len(balls)), counts)
        return rows, self.others[ranges(self.starts[balls], counts)]


def ranges(starts: Any, counts: Any) -> Any:
    """Concatenates the ranges [start, start + count) of all starts."""
    ends = numpy.cumsum(counts)
    return numpy.arange(ends[-1] if len(ends) else 0) + numpy.repeat(starts - ends + counts, counts)


def chunks(counts: Any) -> Iterator[slice]:
    """Consecutive rows whose counts sum to about a million, at least one row each."""
    ends, start = numpy.cumsum(counts), 0
    while start < len(ends):
        limit = (ends[start - 1] if start else 0) + _CHUNK
        end = max(start + 1, int(numpy.searchsorted(ends, limit, side="right")))
        yield slice(start, end)
        start = end


def find_neighbours(centers: Any, radii: Any) -> Neighbours:
    """Returns the balls that each ball overlaps."""
    size = 2.0 * radii.max()
    cells = numpy.floor((centers - centers.min(axis=0)) / size).astype(numpy.int64) + 1
    strides = numpy.cumprod([1, *(cells.max(axis=0) + 2)[:2]])
    keys = cells @ strides
    order = numpy.argsort(keys, kind="stable")
    ordered, pairs = keys[order], []
    for offset in numpy.stack(numpy.meshgrid(*3 * [[-1, 0, 1]]), -1).reshape(-1, 3) @ strides:
        first = numpy.searchsorted(ordered, keys + offset)
        counts = numpy.searchsorted(ordered, keys + offset, side="right") - first
        for own in chunks(counts):
            rows = numpy.repeat(numpy.arange(own.start, own.stop), counts[own])
            others = order[ranges(first[own], counts[own])]
            away = ((centers[rows] - centers[others]) ** 2).sum(axis=1)
            near = (away < (radii[rows] + radii[others]) ** 2) & (rows != others)
            pairs.append((rows[near], others[near], away[near]))
    rows, others, away = (numpy.concatenate(own) for own in zip(*pairs))
    counts = numpy.bincount(rows, minlength=len(centers))
    return Neighbours(numpy.cumsum(counts) - counts, counts, others[numpy.lexsort((away, rows))])


def exposed_arcs(centers: Any, radii: Any, neighbours: Neighbours | None = None) -> Arcs:
    """Returns the arcs where two balls meet outside all others."""
    near = neighbours or find_neighbours(centers, radii)
    first, second = near.expand(numpy.arange(len(centers)))
    circles = _circles(centers, radii, first, second)
    found = []
    for own in chunks(near.counts[circles.balls[:, 0]]):
        part = circles.rows(own)
        rows, starts, ends = _covered(part, centers, radii, near, _FEW)
        part = part.rows(numpy.unique(_gaps(rows, starts, ends, len(part.radii))[0]))
        rows, starts, ends = _covered(part, centers, radii, near)
        rows, low, high = _gaps(rows, starts, ends, len(part.radii))
        middle, half = 0.5 * (low + high), 0.5 * (high - low)
        axes = part.axes[rows]
        cos, sin = numpy.cos(middle)[:, None], numpy.sin(middle)[:, None]
        along = cos * axes[:, 0] + sin * axes[:, 1]
        across = cos * axes[:, 1] - sin * axes[:, 0]
        axes = numpy.stack([along, across, axes[:, 2]], axis=1)
        found.append((part.centers[rows], part.radii[rows], half, axes, part.balls[rows]))
    if not found:
        return circles
    return Arcs(*(numpy.concatenate(values) for values in zip(*found)))


def _circles(centers: Any, radii: Any, first: Any, second: Any) -> Arcs:
    """Returns the whole circles where pairs of balls meet, each pair once."""
    once = first < second
    first, second = first[once], second[once]
    way = centers[second] - centers[first]
    distance = numpy.linalg.norm(way, axis=1)
    meet = distance > numpy.abs(radii[first] - radii[second])
    first, second, way, distance = first[meet], second[meet], way[meet], distance[meet]
    axis = way / distance[:, None]
    along = (distance**2 + radii[first] ** 2 - radii[second] ** 2) / (2 * distance)
    least = numpy.eye(3)[numpy.abs(axis).argmin(axis=1)]
    one = numpy.cross(axis, least)
    one /= numpy.linalg.norm(one, axis=1)[:, None]
    return Arcs(
        centers[first] + along[:, None] * axis,
        numpy.sqrt(numpy.maximum(radii[first] ** 2 - along**2, 0.0)),
        numpy.full(len(first), numpy.pi),
        numpy.stack([one, numpy.cross(axis, one), axis], axis=1),
        numpy.stack([first, second], axis=1),
    )


def _covered(
    circles: Arcs, centers: Any, radii: Any, near: Neighbours, most: int | None = None
) -> tuple[Any, Any, Any]:
    """Returns rows of circles, and start and end of the angles [0, 2 pi] that other balls cover.

    With `most`, only this number of nearest neighbours of each ball is tested.
    """
    rows, third = near.expand(circles.balls[:, 0], most)
    other = third != circles.balls[rows, 1]
    rows, third = rows[other], third[other]
    away = centers[third] - circles.centers[rows]
    x, y = (numpy.einsum("ij,ij->i", away, circles.axes[rows, i]) for i in range(2))
    radius = circles.radii[rows]
    excess = (away**2).sum(axis=1) + radius**2 - radii[third] ** 2
    scale = 2.0 * radius * numpy.hypot(x, y)
    covers = excess < scale
    rows, x, y, excess, scale = (own[covers] for own in (rows, x, y, excess, scale))
    with numpy.errstate(divide="ignore", invalid="ignore"):
        half = numpy.where(excess <= -scale, numpy.pi, numpy.arccos(excess / scale))
    start = (numpy.arctan2(y, x) - half) % (2 * numpy.pi)
    end = start + 2 * half
    beyond = end > 2 * numpy.pi
    return (
        numpy.concatenate([rows, rows[beyond]]),
        numpy.concatenate([start, numpy.zeros(beyond.sum())]),
        numpy.concatenate([numpy.minimum(end, 2 * numpy.pi), end[beyond] - 2 * numpy.pi]),
    )


def _gaps(rows: Any, starts: Any, ends: Any, count: int) -> tuple[Any, Any, Any]:
    """Returns rows, and start and end angles of the gaps between the intervals of a row.

    A gap across the angle 0 stays in one piece, so its end may exceed 2 pi.
    """
    turn, every = 2 * numpy.pi, numpy.arange(count)
    rows = numpy.concatenate([rows, every, every])
    starts = numpy.concatenate([starts, numpy.zeros(count), numpy.full(count, turn)])
    ends = numpy.concatenate([ends, numpy.zeros(count), numpy.full(count, turn)])
    order = numpy.lexsort((starts, rows))
    rows, starts, ends = rows[order], starts[order], ends[order]
    reached = numpy.maximum.accumulate(ends + 10.0 * rows) - 10.0 * rows
    is_gap = (rows[1:] == rows[:-1]) & (starts[1:] > reached[:-1] + _NARROWEST)
    rows, low, high = rows[1:][is_gap], reached[:-1][is_gap], starts[1:][is_gap]
    touches = numpy.bincount(rows[low == 0.0], minlength=count) > 0
    touches &= numpy.bincount(rows[high == turn], minlength=count) > 0
    whole = (low == 0.0) & (high == turn)
    ends_here = touches[rows] & (high == turn) & ~whole
    begins_here = touches[rows] & (low == 0.0) & ~whole
    high[ends_here] = turn + high[begins_here]
    return rows[~begins_here], low[~begins_here], high[~begins_here]
