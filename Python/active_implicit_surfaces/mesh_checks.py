"""Checks that .obj and .stl are whole: VTK's readers take, or crash at, any bytes."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

_CORNER = re.compile(rb"(-?\d+)(?:/(-?\d*)(?:/(-?\d*))?)?")
_ENDS_OF_LINES = re.compile(rb"\\\r?\n")  # with the next line, one


def check_obj(path: Path) -> None:
    """Raises OSError unless each corner of a polygon names places and normals that are there."""
    counts = {b"v": 0, b"vt": 0, b"vn": 0}
    faces = []
    for cells in _rows(path):
        if cells[0] in counts:
            counts[cells[0]] += 1
        elif cells[0] in (b"f", b"l", b"p"):
            # Numbers below 0 count from the last one so far.
            faces.append((cells[1:], tuple(counts.values())))
    whole = tuple(counts.values())
    for corners, so_far in faces:
        forms = {_check_corner(path, corner, whole, so_far) for corner in corners}
        if len(forms) > 1 or not forms:
            raise OSError(f"{path} cannot be read: it is damaged; a polygon is incomplete.")


def _rows(path: Path) -> Iterator[list[bytes]]:
    for line in _ENDS_OF_LINES.sub(b" ", path.read_bytes()).splitlines():
        cells = line.split()
        if cells:
            yield cells


def _check_corner(
    path: Path, corner: bytes, whole: tuple[int, ...], so_far: tuple[int, ...]
) -> tuple[bool, ...]:
    """Which of place, texture and normal it has."""
    found = _CORNER.fullmatch(corner)
    if found is None:
        raise OSError(f"{path} cannot be read: it is damaged; a polygon has no numbers.")
    for number, count, before in zip(found.groups(), whole, so_far):
        place = int(number or 0)
        if place > count or place < -before or (number and place == 0):
            raise OSError(f"{path} cannot be read: it is damaged; a polygon has no such corners.")
    return tuple(bool(number) for number in found.groups())


def check_stl(path: Path) -> None:
    """Raises OSError unless a binary file has as many triangles as it says: VTK takes any."""
    with path.open("rb") as file:
        head = file.read(84)
    size, count = path.stat().st_size, int.from_bytes(head[80:84], "little")
    if not head.lstrip().startswith(b"solid") and size < 84 + 50 * count:
        raise OSError(
            f"{path} cannot be read: it is damaged; it has {size} bytes, and its {count} triangles "
            f"take {84 + 50 * count}."
        )
