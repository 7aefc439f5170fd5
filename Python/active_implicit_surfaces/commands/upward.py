"""Which axis of a series of particles points up: how they fall tells it, else how they lie.

Particles in free flight all have one acceleration, that of gravity, whatever else they do; forces
in a fluid differ from particle to particle, and those of what turns or swings have opposites. So
the acceleration that many particles have in common is gravity, if few have the opposite one.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

from ..api import usual_ids
from ..data_objects import array_names

_PARTICLES = 2000  # of a frame whose acceleration is looked at
_ACCELERATIONS, _CANDIDATES = 20000, 256  # of a series
_ALIKE = 0.1  # accelerations that differ by less than this share of them are the same
# Of accelerations of up to 1 in all directions, 0.1 ** 3 at most are so near to any one. What falls
# is 20 times as many, of all that are half as large at least: what rests does not count.
_SHARE, _FEWEST = 0.02, 10
_OPPOSITES = 0.25  # for each one that falls
_ALONG = 0.9  # cosine of gravity and the axis
# Of coordinates and speeds: smaller differences are of their rounding, as in text of six digits.
_ROUNDING = 1e-5
_LOWER, _FLATTER = 0.05, 1.5  # of the box: by how much of it, by what factor
_VELOCITIES = ("velocity", "velocities", "vel", "v")


class _Frame(NamedTuple):
    step: int
    time: float
    points: Any
    ids: Any
    velocities: Any


class Fall:
    """Looks at one frame of a series after the other for what falls.

    Parameters
    ----------
    ids, velocities : str, optional
        Names of the arrays. Default: those that are called so.
    """

    def __init__(self, ids: str | None = None, velocities: str | None = None) -> None:
        self._names = ids, velocities
        self._last: list[_Frame] = []
        self._by_velocities: list[Any] = []
        self._by_places: list[Any] = []

    def add(self, step: int, time: float, cloud: Any) -> None:
        """The particles of a step; accelerations are those of steps that follow each other."""
        ids, velocities = (_array(cloud, name) for name in self._names)
        frame = _Frame(
            step,
            time,
            vtk_to_numpy(cloud.GetPoints().GetData()),
            _array(cloud, usual_ids(cloud)) if ids is None else ids,
            _usual_velocities(cloud) if velocities is None else velocities,
        )
        if self._last and self._last[-1].step + 1 != step:
            self._last = []
        self._last = [*self._last[-2:], frame]
        self._by_velocities.append(_of_velocities(self._last[-2:]))
        self._by_places.append(_of_places(self._last))

    def up(self) -> str | None:
        """The axis against which particles fall, as "y" or "-z"; None if this cannot be told."""
        for parts in (self._by_velocities, self._by_places):
            gravity = _common(numpy.concatenate([*parts, numpy.empty((0, 3))]))
            if gravity is None:
                continue
            axis = int(abs(gravity).argmax())
            if abs(gravity[axis]) >= _ALONG * numpy.linalg.norm(gravity):
                return ("-" if gravity[axis] > 0 else "") + "xyz"[axis]
        return None


def lie(low: Any, high: Any, mean: Any) -> str:
    """The one of y and z along which particles lie low in their box, or flat; z if neither."""
    sides = high - low
    place = (mean - low) / numpy.maximum(sides, 1e-300)
    if abs(place[1] - place[2]) >= _LOWER:
        return "y" if place[1] < place[2] else "z"
    return "y" if sides[2] >= _FLATTER * sides[1] else "z"


def _array(cloud: Any, name: str | None) -> Any:
    array = cloud.GetPointData().GetArray(name) if name else None
    return None if array is None else vtk_to_numpy(array)


def _usual_velocities(cloud: Any) -> Any:
    arrays = cloud.GetPointData()
    for name in array_names(arrays):
        if name.lower() in _VELOCITIES and arrays.GetArray(name) is not None:
            return _array(cloud, name)
    return None


def _of_velocities(frames: list[_Frame]) -> Any:
    """Accelerations of particles from their velocities in two frames."""
    rows = _same_particles(frames)
    speeds = [frame.velocities for frame in frames]
    if len(frames) < 2 or any(
        v is None or v.shape != f.points.shape for v, f in zip(speeds, frames)
    ):
        return numpy.empty((0, 3))
    first, second = (v[row].astype(float) for v, row in zip(speeds, rows))
    return _without_rounding(second - first, first) / (frames[1].time - frames[0].time)


def _of_places(frames: list[_Frame]) -> Any:
    """Accelerations of particles from their places in three frames."""
    if len(frames) < 3:
        return numpy.empty((0, 3))
    rows = _same_particles(frames)
    first, second, third = (f.points[row].astype(float) for f, row in zip(frames, rows))
    before, after = numpy.diff([frame.time for frame in frames])
    bend = (third - second) * (before / after) - (second - first)
    return _without_rounding(bend, second) * (2.0 / (before * (before + after)))


def _without_rounding(differences: Any, values: Any) -> Any:
    """The finite ones of the differences, those that are of rounding as 0."""
    finite = numpy.isfinite(differences).all(axis=1) & numpy.isfinite(values).all(axis=1)
    differences, values = differences[finite], values[finite]
    if len(values):
        small = numpy.linalg.norm(differences, axis=1) <= _ROUNDING * abs(values).max()
        differences[small] = 0.0
    return differences


def _same_particles(frames: list[_Frame]) -> list[Any]:
    """The rows of some particles in each frame: by ids; without, if there are as many in each."""
    first, *others = frames
    stride = 1 + len(first.points) // _PARTICLES
    if any(frame.ids is None for frame in frames):
        is_same = all(len(frame.points) == len(first.points) for frame in others)
        return [slice(None, None, stride) if is_same else slice(0)] * len(frames)
    wanted = first.ids[::stride]
    rows = [_rows_of(wanted, frame.ids) for frame in frames]
    there = numpy.all([row >= 0 for row in rows], axis=0)
    return [row[there] for row in rows]


def _rows_of(wanted: Any, ids: Any) -> Any:
    """Where these ids are; -1 where they are not."""
    if len(ids) == 0:
        return numpy.full(len(wanted), -1)
    order = numpy.argsort(ids, kind="stable")
    place = numpy.searchsorted(ids, wanted, sorter=order)
    rows = order[numpy.minimum(place, len(ids) - 1)]
    return numpy.where(ids[rows] == wanted, rows, -1)


def _common(accelerations: Any) -> Any:
    """The acceleration that many have in common, and few have opposite; None without one."""
    own = accelerations[:: 1 + len(accelerations) // _ACCELERATIONS]
    moving = own[own.any(axis=1)]
    if len(moving) < _FEWEST:
        return None

    def alike(one: Any) -> Any:
        return numpy.linalg.norm(own - one, axis=1) <= _ALIKE * numpy.linalg.norm(one)

    candidates = moving[:: 1 + len(moving) // _CANDIDATES]
    best = max(candidates, key=lambda one: int(alike(one).sum()))
    best = own[alike(best)].mean(axis=0)
    count, opposite = int(alike(best).sum()), int(alike(-best).sum())
    large = int((numpy.linalg.norm(own, axis=1) >= 0.5 * numpy.linalg.norm(best)).sum())
    is_common = count >= max(_FEWEST, _SHARE * large) and opposite <= _OPPOSITES * count
    return best if is_common else None
