"""Periodic box of particles, from the field data of their files."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

_ROUNDING = 1e-6  # tolerance of equal boxes, relative to the longest edge


def periodic_bounds(frames: Iterable[Any]) -> tuple[float, ...]:
    """Returns the value of PeriodicBounds for particles in a box.

    - frames (iterable of vtkDataSet): data sets that have the field data "Lattice", edges of the
      box as rows [length]. Optional field data: "Origin", a corner of the box [length], and "pbc",
      a flag for each axis (1: periodic).

    Raises ValueError if there is no box, or if the box is slanted, not periodic, or changes.
    """
    boxes = [_box_of(frame) for frame in frames]
    size = max(abs(number) for number in boxes[0])
    for box in boxes:
        if numpy.abs(numpy.subtract(box, boxes[0])).max() > _ROUNDING * size:
            raise ValueError(
                f"The periodic box changes from {_text(boxes[0])} to {_text(box)}; the filter "
                "needs one box. Give periodic_bounds for all frames in place of periodic."
            )
    return boxes[0]


def with_periodic_bounds(options: dict[str, Any], source: Any) -> dict[str, Any]:
    """Returns options with the source's box; raises ValueError if they have periodic_bounds."""
    if "periodic_bounds" in options:
        raise ValueError("Give either periodic or periodic_bounds, not both.")
    return {**options, "periodic_bounds": periodic_bounds(source.frames_that_tell())}


def _text(box: tuple[float, ...]) -> str:
    ends = zip(box[::2], box[1::2])
    return " x ".join(f"[{a:.9g}, {b:.9g}]" if a < b else "(no period)" for a, b in ends)


def _box_of(frame: Any) -> tuple[float, ...]:
    field = frame.GetFieldData()
    arrays = {name: field.GetArray(name) for name in ("Lattice", "Origin", "pbc")}
    known = {name: vtk_to_numpy(array) for name, array in arrays.items() if array}
    if "Lattice" not in known:
        raise ValueError(
            "A frame has no particles with a box, which .xyz, .dump, .gro and .pdb files may have; "
            "give periodic_bounds in place of periodic."
        )
    for name, count in (("Lattice", 9), ("Origin", 3), ("pbc", 3)):
        if name in known and known[name].size != count:
            raise ValueError(
                f"The {name} of the box has {known[name].size} numbers, not {count}; correct it, "
                "or give periodic_bounds in place of periodic."
            )
    edges = known["Lattice"].reshape(3, 3)
    sides = numpy.diag(edges)
    if numpy.abs(edges - numpy.diag(sides)).max() > _ROUNDING * numpy.abs(edges).max():
        raise ValueError(
            "The box is slanted or rotated, but only a box along x, y and z can be periodic; "
            "leave periodic out."
        )
    low = known.get("Origin", numpy.zeros(3)).reshape(3)
    repeats = known.get("pbc", numpy.ones(3)).reshape(3).astype(bool) & (sides > 0)
    if not repeats.any():
        raise ValueError(
            "No side of the particles' box is periodic (pbc) and longer than 0; leave periodic out."
        )
    ends = [
        (float(a), float(a + side)) if own else (1.0, -1.0)
        for a, side, own in zip(low, sides, repeats)
    ]
    return tuple(number for end in ends for number in end)
