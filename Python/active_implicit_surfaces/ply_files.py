"""What a .ply holds beside the mesh, and whether it is whole: VTK's reader goes on beyond the end
of one that is not, and leaves out properties that it does not know.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any, NamedTuple

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk

from .data_objects import add_array
from .messages import warn_all
from .tables import group_columns

_LONGEST_HEADER = 1 << 16
_NUMBER = re.compile(rb"[-+.\w]+")
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
# Properties of which VTK's reader makes arrays of its own.
_KNOWN = frozenset(
    "nx ny nz red green blue alpha diffuse_red diffuse_green diffuse_blue u v s t texture_u "
    "texture_v intensity".split()
)
_COLOURS = ("red", "green", "blue", "alpha")
_ENDS_EARLY = "it is damaged: it ends before its elements do"
_ORDERS = {"binary_little_endian": "<", "binary_big_endian": ">", "ascii": ""}


class _Property(NamedTuple):
    """Of a list, the type of its count comes first."""

    name: str
    kinds: tuple[str, ...]
    are_vertices: bool


class _Element(NamedTuple):
    """Rows of the file; vertices: how many its lists may refer to."""

    name: str
    rows: int
    properties: list[_Property]
    vertices: int


def check_ply(path: Path) -> None:
    """Raises OSError unless a .ply has as much as its header says."""
    with path.open("rb") as file:
        head = file.read(_LONGEST_HEADER)
    try:
        order, elements, start = _read_header(head)
        if order:
            _check_binary(numpy.memmap(path, "u1", "r"), order, elements, start)
        else:
            _check_text(path, elements, start)
    except (ValueError, KeyError, IndexError) as error:
        what = str(error) if isinstance(error, _DamageError) else "its header is damaged"
        raise OSError(
            f"{path} cannot be read: {what}, or it is not what its extension says."
        ) from error


def add_properties(path: Path, data: Any) -> None:
    """Gives a data set the properties of the vertices that VTK leaves out as point arrays.

    Colours of 0 to 1, which VTK rounds to whole numbers, become bytes.
    """
    with path.open("rb") as file:
        head = file.read(_LONGEST_HEADER)
    order, elements, start = _read_header(head)
    _warn_of_faces(path, elements)
    vertex = elements[0]
    kinds = [(each.name, order + each.kinds[0]) for each in vertex.properties]
    names = [name for name, _ in kinds]
    is_table = all(len(each.kinds) == 1 for each in vertex.properties) and len({*names}) == len(
        names
    )
    if not is_table or vertex.rows != data.GetNumberOfPoints() or vertex.rows == 0:
        return
    if order:
        table = numpy.fromfile(path, kinds, vertex.rows, offset=start)
    else:
        skip = head[:start].count(b"\n")
        rows: dict[str, Any] = {"skiprows": skip, "max_rows": vertex.rows, "encoding": "latin-1"}
        try:
            table = numpy.loadtxt(path, kinds, None, ndmin=1, **rows)
        except ValueError as error:
            raise OSError(
                f"{path} cannot be read: it is damaged; a row has what is no number."
            ) from error
    for name, columns in group_columns(names).items():
        values = numpy.stack([table[names[i]] for i in columns], axis=-1)
        values = values.astype(values.dtype.newbyteorder("="))
        if name == "positions" and values.dtype == "f8":  # VTK's are of single precision
            data.GetPoints().SetData(numpy_to_vtk(values, deep=True))
        elif name != "positions" and not _KNOWN & {names[i].lower() for i in columns}:
            add_array(data, name, values if len(columns) > 1 else values[:, 0])
    shown = [name for name in _COLOURS if name in names and table[name].dtype.kind == "f"]
    if len(shown) >= 3:
        light = numpy.stack([table[name] for name in shown], axis=-1)
        add_array(data, "RGBA"[: len(shown)], numpy.rint(255 * light.clip(0, 1)).astype("u1"))


def _warn_of_faces(path: Path, elements: list[_Element]) -> None:
    own = [each for element in elements if element.name == "face" for each in element.properties]
    lost = [each.name for each in own if not each.are_vertices and each.name not in _KNOWN]
    if lost:
        warn_all([f"{path}: properties of polygons are left out: {', '.join(lost)}."])


class _DamageError(ValueError):
    """With what is wrong."""


def _read_header(head: bytes) -> tuple[str, list[_Element], int]:
    """The order of bytes, empty for text; the elements; where they begin."""
    end = head.index(b"end_header")
    start = head.index(b"\n", end) + 1
    text = head[:end].decode("latin-1").replace("\r\n", "\n")
    lines = [re.split("[ \t]+", line.rstrip(" \t")) for line in text.rstrip("\n").split("\n")]
    if lines[0] != ["ply"]:
        raise ValueError
    order, elements, vertices = "", [], 0
    for words in lines[1:]:
        if words[:1] == ["format"]:
            order = _ORDERS[words[1]]
        elif words[:1] == ["element"]:
            vertices = int(words[2]) if words[1] == "vertex" else vertices
            elements.append(_Element(words[1], int(words[2]), [], vertices))
        elif words[:1] == ["property"]:
            names = words[2:4] if words[1] == "list" else words[1:2]
            kinds = tuple(_TYPES[name] for name in names)
            are_vertices = len(kinds) == 2 and words[-1] in ("vertex_indices", "vertex_index")
            elements[-1].properties.append(_Property(words[-1], kinds, are_vertices))
        elif words[:1] not in (["comment"], ["obj_info"]):
            raise ValueError
    if any(element.rows < 0 for element in elements):
        raise ValueError
    _check_names(elements)
    return order, elements, start


def _check_names(elements: list[_Element]) -> None:
    """VTK wants these, unasked."""
    for element in elements:
        names = {each.name for each in element.properties if len(each.kinds) == 1}
        if element.name == "vertex" and not {"x", "y", "z"} <= names:
            raise _DamageError("its vertices have no x, y and z")
        if element.name == "face" and not any(each.are_vertices for each in element.properties):
            raise _DamageError("its faces have no vertex_indices")
    if all(element.name != "vertex" for element in elements):
        raise _DamageError("it has no vertices")
    if elements[0].name != "vertex":  # which VTK's reader may crash at
        raise _DamageError("its vertices are not its first element; write them first")


def _check_binary(content: Any, order: str, elements: list[_Element], start: int) -> None:
    place = start
    for element in elements:
        sizes = [numpy.dtype(each.kinds[0]).itemsize for each in element.properties]
        if place + element.rows * sum(sizes) > len(content):
            raise _DamageError(_ENDS_EARLY)
        if all(len(each.kinds) == 1 for each in element.properties):
            place += element.rows * sum(sizes)
        else:
            place = _skip_lists(content, order, element, place)


def _skip_lists(content: Any, order: str, element: _Element, place: int) -> int:
    """Where the rows end. Most often all lists are as long as the first row's."""
    if element.rows == 0:
        return place
    stride = _skip_row(content, order, element, place) - place
    rows = content[place : place + element.rows * stride]
    if len(rows) == element.rows * stride and _have_the_same_lists(rows, order, element, stride):
        return place + len(rows)
    for _ in range(element.rows):
        place = _skip_row(content, order, element, place)
    return place


def _have_the_same_lists(rows: Any, order: str, element: _Element, stride: int) -> bool:
    table, at = rows.reshape(element.rows, stride), 0
    for each in element.properties:
        size = numpy.dtype(each.kinds[0]).itemsize
        head = table[:, at : at + size]
        at += size
        if len(each.kinds) == 1:
            continue
        if (head != head[0]).any():
            return False
        width = _count(head[0], order, each) * numpy.dtype(each.kinds[1]).itemsize
        _check_items(table[:, at : at + width], order, element, each)
        at += width
    return True


def _skip_row(content: Any, order: str, element: _Element, place: int) -> int:
    for each in element.properties:
        size = numpy.dtype(each.kinds[0]).itemsize
        number = content[place : place + size]
        place += size
        if len(each.kinds) == 2 and len(number) == size:
            first = place
            place += _count(number, order, each) * numpy.dtype(each.kinds[1]).itemsize
            if place <= len(content):
                _check_items(content[first:place], order, element, each)
        if place > len(content):
            raise _DamageError(_ENDS_EARLY)
    return place


def _count(number: Any, order: str, each: _Property) -> int:
    return max(int(number.copy().view(order + each.kinds[0])[0]), 0)


def _check_items(items: Any, order: str, element: _Element, each: _Property) -> None:
    if each.are_vertices and items.size:
        _check_range(numpy.ascontiguousarray(items).view(order + each.kinds[1]), element)


def _check_range(numbers: Any, element: _Element) -> None:
    if numbers.size and (numbers.min() < 0 or numbers.max() >= element.vertices):
        raise _DamageError("it is damaged: a polygon has corners that are not there")


def _check_text(path: Path, elements: list[_Element], start: int) -> None:
    with path.open("rb") as file:
        file.seek(start)
        rows = (line.strip(b" \t\r\n").replace(b"\t", b" ").split(b" ") for line in file)
        for element in elements:
            for _ in range(element.rows):
                _check_row([cell for cell in next(rows, []) if cell], element)


def _check_row(cells: list[bytes], element: _Element) -> None:
    needed = 0
    for each in element.properties:
        is_list = len(each.kinds) == 2 and needed < len(cells)
        count = max(int(cells[needed]), 0) if is_list else 0
        needed += 1
        if each.are_vertices:
            items = numpy.array(cells[needed : needed + count], dtype=float)
            _check_range(items, element)
        needed += count
    if len(cells) < needed:
        raise _DamageError("it is damaged: a row has fewer numbers than its header says")
    if not all(map(_NUMBER.fullmatch, cells)):
        raise _DamageError("it is damaged: a row has what is no number")
