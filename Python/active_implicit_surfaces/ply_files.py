"""Reads .ply files in place of VTK's reader, which reads beyond the end of an incomplete file and
ignores unknown properties.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData

from .data_objects import add_array, cell_array, vtk_points
from .messages import warn
from .tables import group_columns

_TYPES = {
    **dict.fromkeys(("char", "int8"), "i1"),
    **dict.fromkeys(("uchar", "uint8"), "u1"),
    **dict.fromkeys(("short", "int16"), "i2"),
    **dict.fromkeys(("ushort", "uint16"), "u2"),
    **dict.fromkeys(("int", "int32"), "i4"),
    **dict.fromkeys(("uint", "uint32"), "u4"),
    **dict.fromkeys(("float", "float32"), "f4"),
    **dict.fromkeys(("double", "float64"), "f8"),
}
_ORDERS = {"binary_little_endian": "<", "binary_big_endian": ">", "ascii": ""}
_COLOURS = ("red", "green", "blue", "alpha")
_TEXTURES = (("u", "v"), ("s", "t"), ("texture_u", "texture_v"))
_CORNERS = ("vertex_indices", "vertex_index")
_ENDS_EARLY = "it is damaged: it ends before the end of its last element"


class _Property(NamedTuple):
    """Column of an element; for lists also the type of their lengths."""

    name: str
    kind: str
    length_kind: str = ""


class _Element(NamedTuple):
    name: str
    rows: int
    properties: list[_Property]


class _DamageError(ValueError):
    """Damage of a file; the text describes it."""


def read_ply(path: Path) -> Any:
    """Reads a mesh or points of a .ply; scalar properties of vertices and polygons become arrays.

    Lists other than vertex indices are left out, with a warning. If the file also has strips,
    scalar properties of polygons are left out, with a warning.

    Raises OSError if the file is damaged, or lacks vertices or the vertex indices of its faces.
    """
    try:
        content = path.read_bytes()
        order, elements, start = _read_header(content)
        if not order:
            content, start = _doubles_of(content[start:]), 0
        found: dict[str, dict[str, Any]] = {}
        for element in elements:
            columns, start = _read_element(content, start, order, element)
            found.setdefault(element.name, columns)
        return _mesh_of(path, found)
    except (ValueError, KeyError, IndexError, OverflowError) as error:
        what = str(error) if isinstance(error, _DamageError) else "it is damaged, or no .ply"
        raise OSError(f"{path} cannot be read: {what}; write the file again, as a .ply.") from error


def _read_header(content: bytes) -> tuple[str, list[_Element], int]:
    """Returns the byte order ("" for text), the elements, and the offset of their data."""
    end = content.index(b"end_header")
    start = content.index(b"\n", end) + 1
    text = content[:end].decode("latin-1").replace("\r\n", "\n")
    lines = [re.split("[ \t]+", line.rstrip(" \t")) for line in text.rstrip("\n").split("\n")]
    if lines[0] != ["ply"]:
        raise ValueError
    order, elements = "", list[_Element]()
    for words in lines[1:]:
        if words[:1] == ["format"]:
            order = _ORDERS[words[1]]
        elif words[:1] == ["element"]:
            elements.append(_Element(words[1], int(words[2]), []))
        elif words[:1] == ["property"]:
            is_list = words[1] == "list"
            if len(words) != (5 if is_list else 3):
                raise ValueError
            kinds = [_TYPES[name] for name in (words[3:1:-1] if is_list else words[1:2])]
            elements[-1].properties.append(_Property(words[-1], *kinds))
        elif words[:1] not in (["comment"], ["obj_info"]):
            raise ValueError
    if any(each.rows < 0 or (each.rows and not each.properties) for each in elements):
        raise ValueError
    return order, elements, start


def _doubles_of(text: bytes) -> bytes:
    """Converts the numbers of a text to binary doubles."""
    try:
        return numpy.array(text.split(), dtype="<f8").tobytes()
    except ValueError:
        raise _DamageError("it is damaged: a row has a value that is no number") from None


def _read_element(
    content: bytes, start: int, order: str, element: _Element
) -> tuple[dict[str, Any], int]:
    """Returns an element's columns and the offset of its end; fast if list lengths do not vary."""
    if element.rows == 0:
        return {}, start
    first, _ = _read_row(content, start, order, element)
    fields: list[Any] = []
    for i, each in enumerate(element.properties):
        if each.length_kind:
            fields.append((f"length {i}", _stored(order, each.length_kind)))
        fields.append((str(i), _stored(order, each.kind), numpy.shape(first[i])))
    end = start + element.rows * numpy.dtype(fields).itemsize
    if end <= len(content):
        table = numpy.frombuffer(content, fields, element.rows, start)
        lengths = (table[name] for name, *_ in fields if name.startswith("length"))
        if all((own == own[0]).all() for own in lengths):
            columns = enumerate(element.properties)
            return {each.name: table[str(i)].astype(each.kind) for i, each in columns}, end
    rows = []
    for _ in range(element.rows):
        row, start = _read_row(content, start, order, element)
        rows.append(row)
    return {
        each.name: list(column) if each.length_kind else numpy.array(column).astype(each.kind)
        for each, column in zip(element.properties, zip(*rows))
    }, start


def _stored(order: str, kind: str) -> str:
    return order + kind if order else "<f8"  # text


def _read_row(content: bytes, start: int, order: str, element: _Element) -> tuple[list[Any], int]:
    """Returns the numbers and the lists of a row, and the offset of its end."""

    def take(kind: str, count: int) -> Any:
        nonlocal start
        values = numpy.zeros(0, _stored(order, kind))
        if start + count * values.itemsize > len(content):
            raise _DamageError(_ENDS_EARLY)
        if count:
            values = numpy.frombuffer(content, values.dtype, count, start)
        start += values.nbytes
        return values

    row: list[Any] = []
    for each in element.properties:
        if each.length_kind:
            row.append(take(each.kind, max(int(take(each.length_kind, 1)[0]), 0)))
        else:
            row.append(take(each.kind, 1)[0])
    return row, start


def _mesh_of(path: Path, found: dict[str, dict[str, Any]]) -> Any:
    mesh, vertices, faces = vtkPolyData(), found.get("vertex"), dict(found.get("face", {}))
    if vertices is None:
        raise _DamageError("it has no vertices")
    numbers = {name: own for name, own in vertices.items() if _is_number(own)}
    groups = group_columns([*numbers])
    if vertices and "positions" not in groups:
        raise _DamageError("its vertices have no x, y and z")
    columns = [*numbers.values()]
    arrays = dict[str, Any]()
    for name, own in groups.items():
        values = numpy.stack([columns[i] for i in own], axis=-1)
        arrays[name] = values if len(own) > 1 else values[:, 0]
    if arrays:
        mesh.SetPoints(vtk_points(arrays.pop("positions")))
    if faces:
        corners = [faces.pop(name, None) for name in _CORNERS]
        rows = next((own for own in corners if own is not None), None)
        if rows is None:
            raise _DamageError("its faces have no vertex_indices")
        mesh.SetPolys(_polygons(rows, mesh.GetNumberOfPoints()))
    _add_arrays(mesh, mesh.GetPointData(), arrays)
    if strips := _strips(found.get("tristrips", {})):
        mesh.SetStrips(_polygons(strips, mesh.GetNumberOfPoints()))
        if beside := [name for name, own in faces.items() if _is_number(own)]:
            warn(
                f"{path}: properties of polygons are left out, because the file also has strips: "
                f"{', '.join(beside)}."
            )
    else:
        numbers = {name: own for name, own in faces.items() if _is_number(own)}
        _add_arrays(mesh, mesh.GetCellData(), numbers)
    for owner, own_columns in (("vertices", vertices), ("polygons", faces)):
        if lost := [name for name, own in own_columns.items() if not _is_number(own)]:
            warn(f"{path}: list properties of {owner} are left out: {', '.join(lost)}.")
    return mesh


def _is_number(column: Any) -> bool:
    return isinstance(column, numpy.ndarray) and column.ndim == 1


def _polygons(rows: Sequence[Any], count: int) -> Any:
    if isinstance(rows, numpy.ndarray):  # of equal length
        ids, lengths = rows.reshape(-1).astype(numpy.int64), [rows.shape[1]] * len(rows)
    else:
        ids, lengths = numpy.concatenate(rows).astype(numpy.int64), [*map(len, rows)]
    if ids.size and (ids.min() < 0 or ids.max() >= count):
        raise _DamageError("it is damaged: a polygon refers to a vertex that does not exist")
    return cell_array(numpy.cumsum(numpy.array([0, *lengths])), ids)


def _strips(columns: dict[str, Any]) -> list[Any]:
    """Returns the strips of an element "tristrips": lists in which -1 ends a strip."""
    rows = next((columns[name] for name in _CORNERS if name in columns), None)
    if columns and rows is None:
        raise _DamageError("its tristrips have no vertex_indices")
    strips: list[Any] = []
    for row in map(numpy.asarray, () if rows is None else rows):
        strips += [part[part != -1] for part in numpy.split(row, numpy.flatnonzero(row == -1))]
    return [own for own in strips if own.size > 2]


def _add_arrays(mesh: Any, attributes: Any, arrays: dict[str, Any]) -> None:
    """Adds arrays; Normals, RGB or RGBA (bytes) and TCoords have the names of VTK's reader."""
    left = {name.removeprefix("diffuse_"): values for name, values in arrays.items()}
    if {*_COLOURS[:3]} <= {*left}:
        colours = numpy.stack([left.pop(name) for name in _COLOURS if name in left], axis=-1)
        if colours.dtype.kind == "f":  # fractions
            colours = numpy.rint(255 * colours.clip(0, 1))
        name = "RGBA"[: colours.shape[1]]
        add_array(mesh, name, colours.astype("u1"), attributes)
        attributes.SetActiveScalars(name)
    if left.get("n", numpy.zeros(0)).ndim == 2:
        add_array(mesh, "Normals", left.pop("n"), attributes)
        attributes.SetActiveNormals("Normals")
    for pair in _TEXTURES:
        if {*pair} <= {*left}:
            add_array(mesh, "TCoords", numpy.stack([*map(left.pop, pair)], axis=-1), attributes)
            attributes.SetActiveTCoords("TCoords")
    for name, values in left.items():
        add_array(mesh, name, values, attributes)
