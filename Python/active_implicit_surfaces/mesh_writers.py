"""Writes meshes as .ply, .obj and .stl, and particles as .ply.

VTK's own writers of these formats drop point arrays; some writers also drop normals or digits.
"""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkTriangleFilter

from .data_objects import array_names, output_of, points_of
from .messages import warn

# Contents of a mesh that a format can store, besides points and polygons.
_NUMBERS = ("normals", "colours", "numbers")
_EVERYTHING = (*_NUMBERS, "words", "cells", "lines")
_HELD: dict[str, tuple[str, ...]] = {
    **dict.fromkeys((".vtp", ".vtk"), _EVERYTHING),
    **dict.fromkeys((".ply", ".glb", ".usdc", ".usda"), _NUMBERS),
    ".vdb": (*_NUMBERS, "cells", "lines"),
    **dict.fromkeys((".csv", ".json", ".npz"), (*_NUMBERS, "words")),
    ".obj": ("normals", "colours", "lines"),
    ".stl": ("normals",),  # normals of its triangles
    ".xyz": (),
}
_ROUNDING = 1.0 / 64.0  # allowed displacement by single precision, as a fraction of an edge
_EXACT_INTEGERS = 1 << 24  # up to here single precision has all integers
_PLY_TYPES = {"u1": "uchar", "i4": "int", "f4": "float", "f8": "double"}


def arrays_of(data: Any) -> tuple[Any, Any, dict[str, Any]]:
    """Returns normals, colours (0 to 255), and the other numeric point arrays by name.

    Colours are the first array of bytes with 3 or 4 components. Normals or colours that are missing
    are None.
    """
    roles, others = dict[str, Any](), dict[str, Any]()
    for role, name, array in _point_arrays(data):
        if role != "words":
            values = vtk_to_numpy(array).reshape(-1, array.GetNumberOfComponents())
            (others if role == "numbers" else roles)[name if role == "numbers" else role] = values
    return roles.get("normals"), roles.get("colours"), others


def _point_arrays(data: Any) -> list[tuple[str, str, Any]]:
    """Returns a tuple (role, name, array) for each point array."""
    own, found = data.GetPointData(), list[tuple[str, str, Any]]()
    for i in range(own.GetNumberOfArrays()):
        array, role = own.GetAbstractArray(i), "numbers"
        kind = array.GetDataTypeAsString()
        if array is own.GetNormals():
            role = "normals"
        elif not array.IsA("vtkDataArray") or kind == "bit":
            role = "words"
        elif kind == "unsigned char" and array.GetNumberOfComponents() in (3, 4):
            role = "numbers" if any(one == "colours" for one, _, _ in found) else "colours"
        found.append((role, array.GetName() or f"array_{i}", array))
    return found


def warn_of_losses(suffix: str, data: Any) -> None:
    """Warns of point arrays, cell arrays and lines that a format cannot store.

    Names formats that can store them. For a .vdb, warns only of point arrays.
    """
    found = [(role, name) for role, name, _ in _point_arrays(data)]
    found += [("cells", f"{name} (of cells)") for name in array_names(data.GetCellData())]
    if data.IsA("vtkPolyData") and data.GetNumberOfLines():
        found.append(("lines", "the lines"))
    lost = {name: role for role, name in found if role not in _HELD.get(suffix, _EVERYTHING)}
    if lost:
        others = (".csv", ".npz", ".vtp") if suffix == ".xyz" else (".vtp", ".ply")
        better = [one for one in others if set(lost.values()) <= set(_HELD[one])]
        these, them = ("these are", "them") if len(lost) > 1 else ("this is", "it")
        warn(
            f"A {suffix} file cannot hold {', '.join(lost)}, so {these} left out; write "
            f"{' or '.join(better)} to keep {them}."
        )


def origin_for_floats(mesh: Any) -> Any:
    """Returns the centre of a mesh's box if single precision is too coarse for points; else zeros.

    The centre is rounded to single precision.
    """
    points = points_of(mesh)
    if _rounding(points) <= _ROUNDING * edge_of(mesh):
        return numpy.zeros(3)
    return (0.5 * (points.min(axis=0) + points.max(axis=0))).astype("f4").astype(float)


def warn_of_rounding(suffix: str, mesh: Any, origin: Any = 0.0) -> None:
    """Warns if rounding to single precision moves points visibly, or changes integers.

    Points are rounded relative to `origin`. Integers are those of point arrays, if the format
    stores such arrays.
    """
    rounding, edge = _rounding(points_of(mesh) - origin), edge_of(mesh)
    if rounding > _ROUNDING * edge:
        near = _rounding(points_of(mesh) - origin_for_floats(mesh)) <= _ROUNDING * edge
        hint = f", or move the data near the origin before writing a {suffix}" if near else ""
        warn(
            f"A {suffix} file rounds points to single precision, by up to {rounding:.2g} here, "
            f"where edges are about {edge:.2g} long; write .ply, .obj or .vtp{hint}."
        )
    if "numbers" in _HELD.get(suffix, _EVERYTHING) and (large := _large_integers(mesh)):
        warn(
            f"A {suffix} file stores arrays in single precision, which rounds integers beyond "
            f"{_EXACT_INTEGERS}, as in {', '.join(large)}; write .vtp to keep them."
        )


def _large_integers(mesh: Any) -> list[str]:
    """Returns the names of point arrays with integers that single precision cannot hold."""
    return [
        name
        for name, values in arrays_of(mesh)[2].items()
        if values.dtype.kind in "iu" and numpy.abs(values).max(initial=0) > _EXACT_INTEGERS
    ]


def warn_of_coarse(path: Path, mesh: Any) -> None:
    """Warns if a file's points, in single precision, are too coarse for the edges of its mesh."""
    points = points_of(mesh)
    if points.dtype.itemsize > 4 or len(points) == 0:
        return
    step, edge = float(numpy.spacing(numpy.abs(points).max())), edge_of(mesh)
    if 0.5 * step > _ROUNDING * edge:
        warn(
            f"{path}: single precision has rounded the points to steps of up to {step:.2g}, but "
            f"edges are about {edge:.2g} long; write the file in double precision, or data near "
            "the origin."
        )


def edge_of(mesh: Any) -> float:
    """Returns the median length of the polygons' first edges; infinite without polygons."""
    points = points_of(mesh)
    ends = [points[corners[:, :2]].astype(float) for corners in polygons_of(mesh)]
    lengths = [numpy.linalg.norm(end[:, 1] - end[:, 0], axis=1) for end in ends]
    return float(numpy.median(numpy.concatenate(lengths))) if lengths else math.inf


def _rounding(points: Any) -> float:
    return float(numpy.abs(points - points.astype("f4")).max(initial=0.0))


def write_ply(path: Path, mesh: Any) -> None:
    """Writes points, polygons and numeric point arrays; vectors become name_x, name_y ...

    Vectors of more than 4 components become name_0, name_1 ..., normals nx, ny and nz, colours red,
    green, blue and alpha.
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
    warn_of_rounding(".stl", mesh)
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
    """Writes points (x y z, then colours as r g b), normals, polygons and lines."""
    table, (normals, colours, _) = points_of(mesh), arrays_of(mesh)
    form = "v" + 3 * (" %.9g" if table.dtype.itemsize <= 4 else " %.17g")
    if colours is not None:
        table, form = numpy.hstack([table, colours[:, :3] / 255.0]), form + 3 * " %.4g"
    parts, corner = [(form, table)], " %d"
    if normals is not None:
        parts.append(("vn %.6g %.6g %.6g", normals))
        corner = " %d//%d"
    for ids in polygons_of(mesh):
        repeated = numpy.repeat(ids + 1, corner.count("%"), axis=1)
        parts.append(("f" + ids.shape[1] * corner, repeated))
    parts += [("l" + ids.shape[1] * " %d", ids + 1) for ids in _corners(mesh.GetLines(), 2)]
    with path.open("w", encoding="ascii") as file:
        file.writelines(["# no vertices\n"] if len(table) == 0 else [])
        for form, rows in parts:
            file.writelines(form % tuple(row) + "\n" for row in rows.tolist())


def polygons_of(mesh: Any) -> list[Any]:
    """Returns point ids of polygons: a list with an array (n, k) for each number k of corners.

    If the mesh has strips, its polygons and strips are cut into triangles.
    """
    return _corners((triangles_of(mesh) if mesh.GetNumberOfStrips() else mesh).GetPolys(), 3)


def triangles_of(mesh: Any) -> Any:
    """Cuts polygons and strips into triangles, if the mesh has strips or larger polygons.

    Lines and vertices are then left out. Else returns the mesh itself.
    """
    if mesh.GetNumberOfStrips() or (
        mesh.GetNumberOfPoints() and mesh.GetPolys().IsHomogeneous() != 3
    ):
        cut = vtkTriangleFilter()
        cut.PassLinesOff()
        cut.PassVertsOff()
        return output_of(cut, mesh)
    return mesh


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
    """Returns a tuple (name, key of _PLY_TYPES, values) for each property of a .ply's vertices."""
    normals, colours, others = arrays_of(mesh)
    parts = [(["x", "y", "z"], points_of(mesh))]
    if normals is not None:
        parts.append((["nx", "ny", "nz"], normals.astype("f4")))
    if colours is not None:
        parts.append((["red", "green", "blue", "alpha"], colours))
    parts += [(_components(name, values.shape[1]), values) for name, values in others.items()]
    found = dict[str, tuple[str, str, Any]]()
    for names, values in parts:
        for name, column in zip(names, values.T):
            while name in found:
                name += "_"
            found[name] = name, _ply_kind(values), column
    return list(found.values())


def _components(name: str, count: int) -> list[str]:
    plain = re.sub(r"[^!-~]", "_", name)  # no spaces, ASCII only
    if count == 1:
        return [plain]
    return [f"{plain}_{one}" for one in ("xyzw" if count <= 4 else range(count))][:count]


def _ply_kind(values: Any) -> str:
    """Returns the key of _PLY_TYPES whose type stores these numbers exactly; f8 if none does."""
    if values.dtype.kind == "f":
        return "f4" if values.dtype.itemsize <= 4 else "f8"
    if values.dtype == "u1":
        return "u1"
    bounds = numpy.iinfo("i4")
    fits = values.size == 0 or (values.min() >= bounds.min and values.max() <= bounds.max)
    return "i4" if fits else "f8"
