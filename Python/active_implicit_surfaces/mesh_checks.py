"""Checks that .obj and .stl are complete: VTK's readers accept any bytes, or crash.

VTK's reader also drops colours and digits of an .obj, and adds an array of group numbers.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData

from .data_objects import add_array, vtk_points
from .mesh_writers import origin_for_floats

_NOT_OF_CORNERS = (b"#", b"g", b"o", b"s", b"mtllib", b"usemtl", b"vt", b"vn")
_CORNER = re.compile(rb"(-?\d+)(?:/(-?\d*)(?:/(-?\d*))?)?")
_ENDS_OF_LINES = re.compile(rb"\\\r?\n")  # joined with the next line


def check_obj(path: Path) -> None:
    """Raises OSError unless each polygon corner refers to existing vertices and normals."""
    counts = {b"v": 0, b"vt": 0, b"vn": 0}
    faces = []
    for cells in _rows(path):
        if not counts[b"v"] and cells[0] != b"v" and not cells[0].startswith(_NOT_OF_CORNERS):
            raise OSError(f"{path} cannot be read: it is no .obj, which begins with vertices.")
        if cells[0] in counts:
            counts[cells[0]] += 1
        elif cells[0] in (b"f", b"l", b"p"):
            # Negative numbers count from the last point so far.
            faces.append((cells[1:], tuple(counts.values())))
    whole = tuple(counts.values())
    for corners, so_far in faces:
        forms = {_check_corner(path, corner, whole, so_far) for corner in corners}
        if len(forms) > 1 or not forms:
            raise OSError(f"{path} cannot be read: it is damaged; a polygon is incomplete.")


def add_vertices(path: Path, data: Any) -> None:
    """Adds the vertex colours of an .obj, `v x y z r g b`, and all digits of its coordinates."""
    data.GetCellData().RemoveArray("GroupIds")
    rows = [cells[1:7] for cells in _rows(path) if cells[0] == b"v"]
    if data.GetNumberOfPoints() == 0:
        return
    try:
        places = numpy.array([cells[:3] for cells in rows], dtype=float)
        shades = numpy.array([cells[3:] for cells in rows if len(cells) == 6], dtype=float)
    except ValueError as error:
        raise OSError(f"{path} cannot be read: it is damaged; a vertex has no numbers.") from error
    points = vtk_to_numpy(data.GetPoints().GetData())
    are_alike = len(points) == len(places) and numpy.allclose(points, places, rtol=1e-6, atol=0)
    if len(shades) == len(rows):
        numbers = numpy.arange(len(places)) if are_alike else _vertices_of(points, places)
        add_array(data, "RGB", numpy.rint(255 * shades.clip(0, 1)).astype("u1")[numbers])
    exact = vtkPolyData()
    exact.ShallowCopy(data)
    exact.SetPoints(vtk_points(places))
    if are_alike and origin_for_floats(exact).any():
        data.SetPoints(exact.GetPoints())


def _vertices_of(points: Any, places: Any) -> Any:
    """Returns the vertex of each point; VTK repeats vertices that have several normals."""
    both = numpy.concatenate([places.astype(points.dtype), points])
    _, first, numbers = numpy.unique(both, axis=0, return_index=True, return_inverse=True)
    return first[numbers.reshape(-1)[len(places) :]]


def _rows(path: Path) -> Iterator[list[bytes]]:
    for line in _ENDS_OF_LINES.sub(b" ", path.read_bytes()).splitlines():
        cells = line.split()
        if cells:
            yield cells


def _check_corner(
    path: Path, corner: bytes, whole: tuple[int, ...], so_far: tuple[int, ...]
) -> tuple[bool, ...]:
    """Returns which of vertex, texture and normal the corner has; raises OSError if damaged."""
    found = _CORNER.fullmatch(corner)
    if found is None:
        raise OSError(f"{path} cannot be read: it is damaged; a polygon has no numbers.")
    for number, count, before in zip(found.groups(), whole, so_far):
        place = int(number or 0)
        if place > count or place < -before or (number and place == 0):
            raise OSError(f"{path} cannot be read: it is damaged; a polygon has no such corners.")
    return tuple(bool(number) for number in found.groups())


def is_empty_stl(path: Path) -> bool:
    """Returns True for a binary file without triangles, which VTK would read as text."""
    content = path.read_bytes() if path.stat().st_size == 84 else b""
    return content[80:] == bytes(4) and not content.lstrip().lower().startswith(b"solid")


def check_stl(path: Path) -> None:
    """Raises OSError if a binary file has not the triangles of its header: VTK does not check."""
    with path.open("rb") as file:
        head = file.read(84)
    size, count = path.stat().st_size, int.from_bytes(head[80:84], "little")
    if not head.lstrip().lower().startswith(b"solid") and size < 84 + 50 * count:
        raise OSError(
            f"{path} cannot be read: it is damaged; it has {size} bytes, and its {count} triangles "
            f"take {84 + 50 * count}."
        )
