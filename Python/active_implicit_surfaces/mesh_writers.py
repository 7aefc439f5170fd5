"""Meshes and particles as .ply, .obj and .stl.

VTK's own writers leave out normals, point arrays and digits, and write no mesh without points.
"""

from __future__ import annotations

import re
import warnings
from pathlib import Path
from typing import Any, NamedTuple

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

from .messages import ActiveSurfaceWarning

# What a format holds of a mesh, besides points and polygons: all that _contents() finds, or less.
_NUMBERS = ("normals", "texture", "colours", "numbers")
_EVERYTHING = (*_NUMBERS, "words", "cells", "lines")
_HELD: dict[str, tuple[str, ...]] = {
    **dict.fromkeys((".vtp", ".vtk"), _EVERYTHING),
    **dict.fromkeys((".ply", ".glb", ".csv", ".json", ".npz"), _NUMBERS),
    ".obj": ("normals", "texture", "colours", "lines"),
    ".stl": ("normals",),  # those of its triangles
    ".xyz": (),
}
_PLY_TYPES = {"u1": "uchar", "i4": "int", "f4": "float", "f8": "double"}


class PointArrays(NamedTuple):
    """Normals, texture coordinates and colours (0 to 255), or None; other arrays by their names."""

    others: dict[str, Any]
    normals: Any = None
    texture: Any = None
    colours: Any = None


def points_of(data: Any) -> Any:
    """Coordinates, an array (n, 3)."""
    points = data.GetPoints()
    return vtk_to_numpy(points.GetData()) if points else numpy.zeros((0, 3), "f4")


def arrays_of(data: Any) -> PointArrays:
    """Point arrays of numbers; the first one of bytes with 3 or 4 components holds the colours."""
    roles, others = dict[str, Any](), dict[str, Any]()
    for role, name, array in _point_arrays(data):
        if role == "words":
            continue
        values = vtk_to_numpy(array).reshape(-1, array.GetNumberOfComponents())
        if role == "numbers":
            others[name] = values
        else:
            roles[role] = values
    return PointArrays(others, **roles)


def _point_arrays(data: Any) -> list[tuple[str, str, Any]]:
    """The role of each point array in a file, its name, and itself."""
    own, found = data.GetPointData(), list[tuple[str, str, Any]]()
    for i in range(own.GetNumberOfArrays()):
        array, role = own.GetAbstractArray(i), "numbers"
        count, kind = array.GetNumberOfComponents(), array.GetDataTypeAsString()
        if array is own.GetNormals():
            role = "normals"
        elif array is own.GetTCoords() and count == 2:
            role = "texture"
        elif not array.IsA("vtkDataArray") or kind == "bit":
            role = "words"
        elif (
            kind == "unsigned char" and count in (3, 4) and "colours" not in (r for r, *_ in found)
        ):
            role = "colours"
        found.append((role, array.GetName() or f"array_{i}", array))
    return found


def warn_of_losses(suffix: str, data: Any) -> None:
    """Warns of arrays that a file of this extension cannot hold; says which formats have them."""
    held = _HELD.get(suffix, _EVERYTHING)
    lost = [(kind, what, name) for kind, what, name in _contents(data) if kind not in held]
    if not lost:
        return
    parts = []
    for what in dict.fromkeys(what for _, what, _ in lost):
        names = [name for _, other, name in lost if other == what and name]
        parts.append(f"{what}{'s' * (len(names) > 1)} {_listed(names)}".strip())
    others = (".csv", ".json", ".npz", ".vtp") if suffix == ".xyz" else (".vtp", ".ply", ".glb")
    better = [one for one in others if {kind for kind, _, _ in lost} <= set(_HELD[one])]
    verb, pronoun = ("is", "it") if len(lost) == 1 and lost[0][2] else ("are", "them")
    warnings.warn(
        f"The {_listed(parts)} {verb} left out, because a {suffix} file cannot hold {pronoun}; "
        f"write {_listed(better or ['.vtp'], 'or')} to keep {pronoun}.",
        ActiveSurfaceWarning,
        stacklevel=3,
    )


def write_ply(path: Path, mesh: Any) -> None:
    """Writes points, polygons and point arrays: those of several components as name_x, name_y ...

    Colours are red, green, blue and alpha, texture coordinates s and t.
    """
    columns = _columns(mesh)
    rows = numpy.empty(mesh.GetNumberOfPoints(), [(name, "<" + kind) for name, kind, _ in columns])
    for name, _, values in columns:
        rows[name] = values
    polygons = polygons_of(mesh)
    count = "uchar" if all(corners.shape[1] < 256 for corners in polygons) else "int"
    head = ["ply", "format binary_little_endian 1.0", f"element vertex {len(rows)}"]
    head += [f"property {_PLY_TYPES[kind]} {name}" for name, kind, _ in columns]
    head += [f"element face {sum(map(len, polygons))}"]
    head += [f"property list {count} int vertex_indices", "end_header\n"]
    with path.open("wb") as file:
        file.write("\n".join(head).encode("ascii"))
        file.write(rows.tobytes())
        for corners in polygons:
            width = corners.shape[1]
            kind = [("n", "u1" if count == "uchar" else "<i4"), ("ids", "<i4", (width,))]
            faces = numpy.empty(len(corners), kind)
            faces["n"], faces["ids"] = width, corners
            file.write(faces.tobytes())


def write_stl(path: Path, mesh: Any) -> None:
    """Writes triangles, each with its own normal."""
    places = [points_of(mesh)[corners] for corners in polygons_of(mesh)]
    corners = numpy.concatenate([numpy.zeros((0, 3, 3)), *places])
    normals = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = numpy.linalg.norm(normals, axis=1, keepdims=True)
    facets = numpy.zeros(len(corners), [("numbers", "<f4", (4, 3)), ("count", "<u2")])
    facets["numbers"][:, 0] = normals / numpy.where(lengths > 0, lengths, 1)
    facets["numbers"][:, 1:] = corners
    with path.open("wb") as file:
        file.write(b"binary".ljust(80) + len(facets).to_bytes(4, "little"))
        file.write(facets.tobytes())


def write_obj(path: Path, mesh: Any) -> None:
    """Writes points, with colours as r g b behind x y z, texture coordinates, normals and cells."""
    points, arrays = points_of(mesh), arrays_of(mesh)
    form, table = "v" + 3 * (" %.9g" if points.dtype.itemsize <= 4 else " %.17g"), points
    if arrays.colours is not None:
        table, form = numpy.hstack([points, arrays.colours[:, :3] / 255.0]), form + 3 * " %.4g"
    parts, corner = [(form, table)], " %d"
    if arrays.texture is not None:
        parts.append(("vt %.9g %.9g", arrays.texture[:, :2]))
        corner += "/%d"
    if arrays.normals is not None:
        parts.append(("vn %.6g %.6g %.6g", arrays.normals))
        corner += "/%d" if arrays.texture is not None else "//%d"
    for ids in polygons_of(mesh):
        repeated = numpy.repeat(ids + 1, corner.count("%"), axis=1)
        parts.append(("f" + ids.shape[1] * corner, repeated))
    parts += [("l" + ids.shape[1] * " %d", ids + 1) for ids in _corners(mesh.GetLines(), 2)]
    with path.open("w", encoding="ascii") as file:
        for form, rows in parts:
            file.writelines(form % tuple(row) + "\n" for row in rows.tolist())


def polygons_of(mesh: Any) -> list[Any]:
    """Corners of the polygons, an array (n, k) for each number of corners k."""
    return _corners(mesh.GetPolys(), 3)


def _corners(cells: Any, least: int) -> list[Any]:
    if cells.GetNumberOfCells() == 0:
        return []
    ids, starts = (
        vtk_to_numpy(array) for array in (cells.GetConnectivityArray(), cells.GetOffsetsArray())
    )
    sizes = numpy.diff(starts)
    wide = ((size, starts[:-1][sizes == size]) for size in numpy.unique(sizes[sizes >= least]))
    return [ids[first[:, None] + numpy.arange(size)] for size, first in wide]


def _columns(mesh: Any) -> list[tuple[str, str, Any]]:
    """The properties of a vertex in a .ply: name, type, values."""
    arrays, found = arrays_of(mesh), list[tuple[str, str, Any]]()
    parts: list[tuple[Any, Any]] = [("x y z".split(), points_of(mesh))]
    parts += [("nx ny nz".split(), arrays.normals), ("s t".split(), arrays.texture)]
    parts += [("red green blue alpha".split(), arrays.colours)]
    parts += arrays.others.items()
    taken = set[str]()
    for names, values in parts:
        if values is None:
            continue
        kind = "f4" if values is arrays.normals else _ply_kind(values)
        for i in range(values.shape[1]):
            name = names[i] if isinstance(names, list) else _component(names, i, values.shape[1])
            while name in taken:
                name += "_"
            taken.add(name)
            found.append((name, kind, values[:, i]))
    return found


def _component(name: str, i: int, count: int) -> str:
    plain = re.sub(r"[^!-~]", "_", name)  # neither spaces nor what is not ASCII
    if count == 1:
        return plain
    return f"{plain}_{'xyzw'[i] if count <= 4 else i}"


def _ply_kind(values: Any) -> str:
    """The type of a .ply that has these numbers as they are, as far as there is one."""
    if values.dtype.kind == "f":
        return "f4" if values.dtype.itemsize <= 4 else "f8"
    if values.dtype == "u1":
        return "u1"
    bounds = numpy.iinfo("i4")
    fits = values.size == 0 or (values.min() >= bounds.min and values.max() <= bounds.max)
    return "i4" if fits else "f8"


def _contents(data: Any) -> list[tuple[str, str, str]]:
    """What a mesh has besides its points: its kind, what it is in a sentence, its name."""
    found = [(role, "point array", name) for role, name, _ in _point_arrays(data)]
    cells = data.GetCellData()
    names = map(cells.GetArrayName, range(cells.GetNumberOfArrays()))
    found += [("cells", "cell array", name or "") for name in names]
    if data.IsA("vtkPolyData") and data.GetNumberOfLines():
        found.append(("lines", "lines", ""))
    return found


def _listed(words: list[str], joint: str = "and") -> str:
    """a, b and c."""
    return f" {joint} ".join(filter(None, [", ".join(words[:-1]), *words[-1:]]))
