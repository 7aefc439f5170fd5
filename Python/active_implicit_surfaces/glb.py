"""Writes triangles as a .glb, binary glTF 2.0; VTK 9.1 writes only the text form of glTF."""

from __future__ import annotations

import json
import re
import struct
from pathlib import Path
from typing import Any

import numpy

from .data_objects import points_of
from .mesh_writers import (
    arrays_of,
    origin_for_floats,
    polygons_of,
    warn_of_rounding,
)

_ASSET = {"version": "2.0", "generator": "active_implicit_surfaces"}
_MAGIC, _VERSION, _JSON, _BIN = 0x46546C67, 2, 0x4E4F534A, 0x004E4942
_FLOAT, _UINT = 5126, 5125
_VERTICES, _INDICES = 34962, 34963
_SIZES = {5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4}
_KINDS = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}
_COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}

# Quaternions that turn an axis into y, which points up in glTF.
_HALF = 0.5**0.5
TO_Y = {
    "x": [0.0, 0.0, _HALF, _HALF],
    "-x": [0.0, 0.0, -_HALF, _HALF],
    "-y": [1.0, 0.0, 0.0, 0.0],
    "z": [-_HALF, 0.0, 0.0, _HALF],
    "-z": [_HALF, 0.0, 0.0, _HALF],
}


def write_glb(path: Path, mesh: Any, up: str = "y") -> None:
    """Writes the triangles of a vtkPolyData with their normals, colours and point arrays.

    Colours become COLOR_0, as linear light. Other arrays become _NAME in capital letters, as
    floats. Arrays of more than 4 components are split into _NAME_0 ...; if the arrays differ in
    their number of components, vectors are split into _NAME_X, _NAME_Y ...
    Vertices have the data's coordinates. If single precision is too coarse, vertices are relative
    to an origin, which the node's translation adds. The node rotates the data's axis `up` to y,
    which is up in glTF.
    """
    origin = origin_for_floats(mesh)
    warn_of_rounding(".glb", mesh, origin)
    triangles, (normals, colours, others) = polygons_of(mesh), arrays_of(mesh)
    attributes = {"POSITION": points_of(mesh) - origin, "NORMAL": normals}
    color = (0.36, 0.66, 0.86) if colours is None else (1.0, 1.0, 1.0)
    if colours is not None:
        attributes["COLOR_0"] = linear_light(colours)
    are_mixed = len({values.shape[1] for values in others.values()}) > 1
    for name, values in others.items():
        attributes |= _split(_attribute_of(name, attributes), values, are_mixed)
    parts = {name: one.astype("<f4") for name, one in attributes.items() if one is not None}
    if not triangles:  # glTF has no empty arrays
        path.write_bytes(_pack({"asset": _ASSET, "scene": 0, "scenes": [{}]}, []))
        return
    corners = triangles[0].ravel().astype("<u4")
    content = _describe(parts, corners, color, _place(up, origin))
    path.write_bytes(_pack(content, [*parts.values(), corners]))


def _place(up: str, origin: Any) -> dict[str, Any]:
    """Returns the transform of a node: translation by `origin`, then rotation of axis `up` to y."""
    turn = {"rotation": TO_Y[up]} if up in TO_Y else {}
    if not origin.any():
        return turn
    moved = turned_up(up, origin).tolist()
    return {**turn, "translation": moved, "extras": {"origin": origin.tolist()}}


def turned_up(up: str, vector: Any) -> Any:
    """Rotates a vector by the rotation that turns axis `up` into y."""
    if up not in TO_Y:
        return vector
    axis, w = numpy.array(TO_Y[up][:3]), TO_Y[up][3]
    return vector + 2.0 * numpy.cross(axis, numpy.cross(axis, vector) + w * vector)


def linear_light(colours: Any) -> Any:
    """Converts sRGB colours, 0 to 255, to linear light, 0 to 1; alpha is only scaled."""
    light = colours / 255.0
    display = light[:, :3]
    light[:, :3] = numpy.where(
        display <= 0.04045, display / 12.92, ((display + 0.055) / 1.055) ** 2.4
    )
    return light


def display_colours(light: Any) -> Any:
    """Converts linear light, 0 to 1, to sRGB colours, 0 to 255; a fourth component is alpha."""
    colours = light.clip(0.0, 1.0)
    plain = colours[:, :3]
    colours[:, :3] = numpy.where(
        plain <= 0.0031308, 12.92 * plain, 1.055 * plain ** (1 / 2.4) - 0.055
    )
    return numpy.rint(255.0 * colours).astype("u1")


def _attribute_of(name: str, taken: dict[str, Any]) -> str:
    attribute = "_" + re.sub(r"\W", "_", name.upper(), flags=re.ASCII)
    while attribute in taken:
        attribute += "_"
    return attribute


def _split(name: str, values: Any, are_mixed: bool) -> dict[str, Any]:
    """Splits a vector array if it has more than four components, or if `are_mixed`.

    Blender's importer (5.0) mixes up custom attributes of different widths, and fails.
    """
    count = values.shape[1]
    if count == 1 or (count <= 4 and not are_mixed):
        return {name: values}
    axes = "XYZW" if count <= 4 else [str(i) for i in range(count)]
    return {f"{name}_{axis}": values[:, i : i + 1] for i, axis in zip(range(count), axes)}


def _describe(
    parts: dict[str, Any], corners: Any, color: tuple[float, float, float], place: dict[str, Any]
) -> dict[str, Any]:
    views: list[dict[str, Any]] = []
    accessors: list[dict[str, Any]] = []
    start = 0
    for numbers in (*parts.values(), corners):
        size, is_index = numbers.nbytes, numbers is corners
        target = _INDICES if is_index else _VERTICES
        views.append({"buffer": 0, "byteOffset": start, "byteLength": size, "target": target})
        accessors.append(
            {
                "bufferView": len(accessors),
                "componentType": _UINT if is_index else _FLOAT,
                "count": len(numbers),
                "type": "SCALAR" if is_index else _KINDS[numbers.shape[1]],
            }
        )
        start += size
    accessors[0]["min"] = [float(value) for value in parts["POSITION"].min(axis=0)]
    accessors[0]["max"] = [float(value) for value in parts["POSITION"].max(axis=0)]
    attributes = {name: place for place, name in enumerate(parts)}
    surface = {"attributes": attributes, "indices": len(parts), "material": 0}
    look = {"baseColorFactor": [*color, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.3}
    return {
        "asset": _ASSET,
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, **place}],
        "meshes": [{"primitives": [surface]}],
        "materials": [{"pbrMetallicRoughness": look}],
        "buffers": [{"byteLength": start}],
        "bufferViews": views,
        "accessors": accessors,
    }


def _pack(content: dict[str, Any], arrays: list[Any]) -> bytes:
    text = json.dumps(content, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    data = b"".join(numpy.ascontiguousarray(array).tobytes() for array in arrays)  # 4-byte numbers
    size = 12 + 8 + len(text) + 8 + len(data)
    return b"".join(
        (
            struct.pack("<III", _MAGIC, _VERSION, size),
            struct.pack("<II", len(text), _JSON),
            text,
            struct.pack("<II", len(data), _BIN),
            data,
        )
    )


def check_glb(path: Path) -> tuple[bool, bool, Any]:
    """Checks accessors and references in a .glb, because VTK does not check.

    Returns three values: True if this package wrote the file, whose vertices then have the data's
    axes; True if the file has meshes; the origin to add to the vertices, or None for no origin.

    Raises OSError if an accessor, or a reference to an accessor, a mesh or a node, is not valid.
    """
    try:
        with path.open("rb") as file:
            magic, _, _, length, kind = struct.unpack("<5I", file.read(20))
            if magic != _MAGIC or kind != _JSON:
                raise ValueError
            content = json.loads(file.read(length))
            rest = file.read(8)
        _check_views(content, struct.unpack("<2I", rest)[0] if len(rest) == 8 else 0)
        for accessor in content.get("accessors", []):
            _check_accessor(content, accessor)
        for mesh in content.get("meshes", []):
            for primitive in mesh["primitives"]:
                _check_primitive(content["accessors"], primitive)
        _check_references(content)
        is_own, nodes = content.get("asset") == _ASSET, content.get("nodes", [])
        origin = nodes[0].get("extras", {}).get("origin") if is_own and nodes else None
        return is_own, bool(content.get("meshes")), origin and numpy.array(origin, float)
    except (ValueError, KeyError, TypeError, IndexError, AttributeError, struct.error) as error:
        raise OSError(
            f"{path} cannot be read: it is no valid .glb (glTF 2.0), or its meshes are compressed "
            "or sparse; write it again, without compression and sparse accessors."
        ) from error


def _check_views(content: Any, size: int) -> None:
    sizes = [
        int(buffer["byteLength"]) if "uri" in buffer else min(int(buffer["byteLength"]), size)
        for buffer in content.get("buffers", [])
    ]
    for view in content.get("bufferViews", []):
        start, length = int(view.get("byteOffset", 0)), int(view["byteLength"])
        if start < 0 or length < 0 or start + length > sizes[int(view["buffer"])]:
            raise ValueError


def _check_accessor(content: Any, accessor: Any) -> None:
    count = int(accessor["count"])
    own = _SIZES[int(accessor["componentType"])] * _COMPONENTS[accessor["type"]]
    view = content["bufferViews"][_natural(accessor["bufferView"])]  # VTK requires a view
    start, step = int(accessor.get("byteOffset", 0)), int(view.get("byteStride", own))
    if start < 0 or count < 1 or step < 0:
        raise ValueError
    if start + (count - 1) * step + own > int(view["byteLength"]):
        raise ValueError


def _check_primitive(accessors: Any, primitive: Any) -> None:
    attributes = primitive["attributes"]
    named = {name: accessors[_natural(place)] for name, place in attributes.items()}
    kinds = {"POSITION": "VEC3", "NORMAL": "VEC3"}
    for name, accessor in named.items():
        if accessor["type"] != kinds.get(name, accessor["type"]):
            raise ValueError
        if accessor["count"] != named["POSITION"]["count"] or accessor["componentType"] == _UINT:
            raise ValueError
    if "indices" in primitive:
        indices = accessors[_natural(primitive["indices"])]
        if indices["type"] != "SCALAR" or indices["componentType"] == _FLOAT:
            raise ValueError


def _check_references(content: Any) -> None:
    """Raises ValueError if a reference between scenes, nodes and meshes is invalid.

    A node may have only one parent, and a scene may refer only to nodes without a parent.
    """
    nodes, meshes = content.get("nodes", []), content.get("meshes", [])
    above = [0] * len(nodes)
    for node in nodes:
        if "mesh" in node and _natural(node["mesh"]) >= len(meshes):
            raise ValueError
        for child in node.get("children", []):
            above[_natural(child)] += 1
    scenes = content.get("scenes", [])
    if "scene" in content and _natural(content["scene"]) >= len(scenes):
        raise ValueError
    roots = [_natural(node) for scene in scenes for node in scene.get("nodes", [])]
    if any(above[root] for root in roots) or any(count > 1 for count in above):
        raise ValueError  # not a tree


def _natural(number: Any) -> int:
    if isinstance(number, bool) or not isinstance(number, int) or number < 0:
        raise ValueError
    return number
