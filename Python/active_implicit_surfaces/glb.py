"""Triangles as a .glb, the binary file of glTF 2.0, of which VTK 9.1 writes the text form only."""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

_MAGIC, _VERSION, _JSON, _BIN = 0x46546C67, 2, 0x4E4F534A, 0x004E4942
_FLOAT, _UINT = 5126, 5125
_VERTICES, _INDICES = 34962, 34963


def write_glb(
    path: Path, mesh: Any, color: tuple[float, float, float] = (0.36, 0.66, 0.86)
) -> None:
    """Writes the triangles of a vtkPolyData with their points and normals."""
    points = vtk_to_numpy(mesh.GetPoints().GetData()).astype("<f4")
    triangles = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).astype("<u4")
    normals = mesh.GetPointData().GetNormals()
    parts = [(points, "VEC3", _FLOAT, _VERTICES)]
    attributes = {"POSITION": 0}
    if normals is not None:
        attributes["NORMAL"] = len(parts)
        parts.append((vtk_to_numpy(normals).astype("<f4"), "VEC3", _FLOAT, _VERTICES))
    indices = len(parts)
    parts.append((triangles, "SCALAR", _UINT, _INDICES))
    content = _describe(parts, attributes, indices, color)
    path.write_bytes(_pack(content, [part[0] for part in parts]))


def _describe(
    parts: list[Any], attributes: dict[str, int], indices: int, color: tuple[float, float, float]
) -> dict[str, Any]:
    views: list[dict[str, Any]] = []
    accessors: list[dict[str, Any]] = []
    start = 0
    for numbers, kind, component, target in parts:
        size = numbers.nbytes
        views.append({"buffer": 0, "byteOffset": start, "byteLength": size, "target": target})
        accessors.append(
            {
                "bufferView": len(accessors),
                "componentType": component,
                "count": len(numbers),
                "type": kind,
            }
        )
        start += size
    if len(parts[0][0]):
        accessors[0]["min"] = [float(value) for value in parts[0][0].min(axis=0)]
        accessors[0]["max"] = [float(value) for value in parts[0][0].max(axis=0)]
    surface = {"attributes": attributes, "indices": indices, "material": 0}
    look = {"baseColorFactor": [*color, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.3}
    return {
        "asset": {"version": "2.0", "generator": "active_implicit_surfaces"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [surface]}],
        "materials": [{"pbrMetallicRoughness": look}],
        "buffers": [{"byteLength": start}],
        "bufferViews": views,
        "accessors": accessors,
    }


def _pack(content: dict[str, Any], arrays: list[Any]) -> bytes:
    text = json.dumps(content, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    data = b"".join(numpy.ascontiguousarray(array).tobytes() for array in arrays)  # all of 4 bytes
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
