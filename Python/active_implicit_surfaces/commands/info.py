"""active-surface info: describes the contents of files."""

from __future__ import annotations

import argparse
import csv
import json
import math
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

from ..choice import are_whole, choose, labels_of, note_once
from ..data_objects import array_names, finite_points, texts_of
from ..file_names import expand, suffix_of
from ..measures import measure
from ..mesh_writers import polygons_of
from ..messages import few, listening, quiet
from ..particle_files import (
    PARTICLE_SUFFIXES,
    ParticleFiles,
    open_particles,
)
from ..presets import estimate_spacing
from ..skin_files import INPUT_SUFFIXES, MESH_SUFFIXES, holds_particles, read_shape
from ..vtk_files import check_readable, open_vtk
from .options import Parser, add_choice_options, add_help, wrapped

_MOST_LABELS, _MOST_TEXTS = 100, 20


def run(arguments: list[str]) -> int:
    """Runs the command; returns its exit code."""
    parser = make_parser()
    options = parser.parse_args(arguments)
    where, labels = options.where or [], options.labels or []
    if labels == "all":
        first = expand(options.files, INPUT_SUFFIXES).files[0]
        labels = labels_of(_shape_in(first) or open_particles(options.files).load(0))
    found: dict[str, Any] = {}
    for label in labels:
        found[f"label {label}"] = describe(options.files, where, label)
    frames = expand(options.files, INPUT_SUFFIXES).frames
    if options.csv:
        _print_csv(_measure_all(frames, where, labels))
        return 0
    found = found or describe(options.files, where)
    if len(frames) > 1 and found.get("holds") == "a mesh":
        found["each"] = _measure_all(frames, where)
    if options.json:
        print(json.dumps(found, indent=1))
    else:
        print("\n".join(_lines(found)))
    return 0


def make_parser() -> Parser:
    parser = Parser(
        "active-surface info",
        "FILE ... [--json] [--csv]",
        wrapped(
            "Describes a file or a series: points, bounds, spacing, arrays, times; for meshes "
            "area, volume, pieces, voids and open edges; the grids of a .vdb, and whether the "
            "filter can resume from it; the layers of an .exr; the labels of an image."
        ),
    )
    parser.add_argument("files", nargs="+", metavar="FILE", help=argparse.SUPPRESS)
    add_choice_options(parser)
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--json", action="store_true", help="print as JSON")
    form.add_argument("--csv", action="store_true", help="print measures of each mesh as a table")
    add_help(parser)
    return parser


def describe(
    names: list[str], where: Sequence[str] = (), label: int | None = None
) -> dict[str, Any]:
    """Returns a description of the first file, for JSON; of particles, of first and last frame."""
    files = [file for parts in expand(names, INPUT_SUFFIXES).frames for file in parts]
    suffix = suffix_of(files[0])
    if suffix == ".exr":
        return _describe_exr(files)
    if suffix == ".vdb":
        grids = _describe_vdb(files)
        if all(grid["type"] != "points" for grid in grids["grids"]):
            return grids
    if (shape := _shape_in(files[0])) is not None:
        shape = choose(shape, where, label)
        return {"files": len(files), "file": str(files[0]), **_describe_shape(shape)}
    if suffix not in PARTICLE_SUFFIXES:
        raise OSError(f"{files[0]}: info reads {', '.join(INPUT_SUFFIXES)}, .exr.")
    return _describe_particles(open_particles(names, where=where, label=label), files)


def _describe_particles(series: ParticleFiles, files: list[Path]) -> dict[str, Any]:
    first = series.load(0)
    found = {
        "files": len(files),
        "file": str(files[0]),
        "holds": "particles",
        "frames": len(series),
        "times": [series.times[0], series.times[-1]],
        **_points(first),
        "spacing": estimate_spacing(first),
        "arrays": _arrays(first),
    }
    field = first.GetFieldData()
    for name in array_names(field):
        found[name] = vtk_to_numpy(field.GetArray(name)).ravel().tolist()
    if len(series) > 1:
        last = series.load(len(series) - 1)
        found["last frame"] = {**_points(last), "arrays": _arrays(last)}
    return found


def _points(data: Any) -> dict[str, Any]:
    count = data.GetNumberOfPoints()
    found: dict[str, Any] = {"points": count}
    if count:
        finite = finite_points(data)
        if finite.GetNumberOfPoints():
            found["bounds"] = [round(value, 9) for value in finite.GetBounds()]
        if finite.GetNumberOfPoints() < count:
            found["points that are not finite"] = count - finite.GetNumberOfPoints()
    return found


def _arrays(data: Any) -> dict[str, str]:
    arrays, found = data.GetPointData(), {}
    for i in range(arrays.GetNumberOfArrays()):
        array = arrays.GetAbstractArray(i)
        text = f"{array.GetDataTypeAsString()}"
        if array.GetNumberOfComponents() > 1:
            text += f" x {array.GetNumberOfComponents()}"
        if array.IsA("vtkDataArray") and array.GetNumberOfTuples():
            text += _range_of(vtk_to_numpy(array))
        name = array.GetName() or f"array {i}"
        texts = texts_of(arrays, name)
        found[name] = text if texts is None else _count_texts(texts)
    return found


def _range_of(values: numpy.ndarray) -> str:
    """Returns text with the range of an array, or of its vectors' lengths.

    The text also has the number of values that are not finite. Each part begins with a comma.
    """
    lengths = values if values.ndim == 1 else numpy.linalg.norm(values.astype(float), axis=1)
    finite = lengths[numpy.isfinite(lengths)]
    text = (
        f", {'length ' * (values.ndim > 1)}{finite.min():g} to {finite.max():g}"
        if finite.size
        else ""
    )
    missing = int(lengths.size - finite.size)
    return text + f", {missing} not finite" * (missing > 0)


def _count_texts(texts: Any) -> str:
    values, counts = numpy.unique(texts, return_counts=True)
    listed = [f"{value or repr('')} {count}" for value, count in zip(values.tolist(), counts)]
    return f"texts, {few(listed, _MOST_TEXTS)}"


def _shape_in(path: Path) -> Any:
    """Returns the mesh or image of a file; None for particles, a .vdb, or another format."""
    is_shape = suffix_of(path) in MESH_SUFFIXES and suffix_of(path) != ".vdb"
    return read_shape(path) if is_shape and not holds_particles(path) else None


def _describe_shape(shape: Any) -> dict[str, Any]:
    if shape.IsA("vtkImageData"):
        return {
            "holds": "an image",
            "points": list(shape.GetDimensions()),
            "spacing": list(shape.GetSpacing()),
            "bounds": list(shape.GetBounds()),
            **_labels(shape),
            "arrays": _arrays(shape),
        }
    found = measure(shape)
    edges = found.pop("open edges")
    return {
        "holds": "a mesh",
        **_points(shape),
        "polygons": sum(map(len, polygons_of(shape))),
        **found,
        "closed": "yes" if edges == 0 else f"no, {edges} open edges",
        "arrays": _arrays(shape),
    }


def _measure_all(
    frames: list[tuple[Path, ...]], where: Sequence[str], labels: Sequence[int] = ()
) -> list[dict[str, Any]]:
    """Returns the measures of each mesh, or of each label of each mesh."""
    found, note = [], note_once() if len(frames) > 1 else None
    for file, *parts in frames:
        shape = read_shape(file, parts=parts)
        if shape.IsA("vtkImageData"):
            raise OSError(
                f"{file} is an image, but only meshes are measured; convert it to a mesh, or "
                "leave it out."
            )
        for label in labels or (None,):
            mesh = choose(shape, where, label, note=note)
            own = {} if label is None else {"label": label}
            points = mesh.GetNumberOfPoints()
            found.append({"file": str(file), **own, "points": points, **measure(mesh)})
    return found


def _labels(image: Any) -> dict[str, Any]:
    """Returns the number of points or cells of each label except 0.

    Returns {} if there are over 100 labels, or values that are not whole numbers.
    """
    scalars = image.GetPointData().GetScalars() or image.GetCellData().GetScalars()
    values = None if scalars is None else vtk_to_numpy(scalars)
    if values is None or values.ndim > 1:
        return {}
    labels, counts = numpy.unique(values[values != 0], return_counts=True)
    if len(labels) > _MOST_LABELS or not are_whole(labels):
        return {}
    names = (str(int(label)) for label in labels)
    return {"labels": dict(zip(names, counts.tolist()))}


def _describe_vdb(files: list[Path]) -> dict[str, Any]:
    reader = open_vtk(files[0])
    grids = [_describe_grid(reader, i) for i in range(reader.GetNumberOfGrids())]
    found: dict[str, Any] = {"files": len(files), "file": str(files[0]), "grids": grids}
    if any(grid["name"] == "potential" for grid in grids):
        found["state"] = "yes: the filter's LoadState resumes from it"
    for name in ("creator", "time", "frame", "units"):
        if text := reader.GetMetadata(name):
            found[name] = text
    return found


def _describe_grid(reader: Any, i: int) -> dict[str, Any]:
    box, size = [0] * 6, [0.0] * 3
    reader.GetGridBox(i, box)
    reader.GetGridVoxelSize(i, size)
    return {
        "name": reader.GetGridName(i),
        "type": reader.GetGridType(i) + (" (half)" if reader.GetGridIsHalfFloat(i) else ""),
        "class": reader.GetGridClass(i),
        "active voxels": reader.GetGridActiveVoxels(i),
        "voxel size": size,
        "box": box,
    }


def _describe_exr(files: list[Path]) -> dict[str, Any]:
    from .. import vtkActiveEXRReader

    check_readable(files[0])
    reader = vtkActiveEXRReader()
    reader.SetFileName(str(files[0]))
    with quiet(), listening(reader) as heard:
        reader.Update()
    heard.raise_error(OSError)
    image = reader.GetOutput()
    return {
        "files": len(files),
        "file": str(files[0]),
        "holds": "a picture",
        "pixels": list(image.GetDimensions()[:2]),
        "layers": _arrays(image),
    }


def _print_csv(rows: list[dict[str, Any]]) -> None:
    table = csv.DictWriter(sys.stdout, [name.replace(" ", "_") for name in rows[0]])
    table.writeheader()
    table.writerows({name.replace(" ", "_"): value for name, value in row.items()} for row in rows)


def _lines(found: dict[str, Any], indent: str = "") -> list[str]:
    lines = []
    for name, value in found.items():
        if isinstance(value, dict):
            lines.append(f"{indent}{name}:" + ("" if value else " none"))
            lines += _lines(value, indent + "  ")
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            lines.append(f"{indent}{name}:")
            for one in value:
                lines += [f"{indent}  {_one_line(one)}"]
        else:
            lines.append(f"{indent}{name}: {_text(value, _digits_of(value))}")
    return lines


def _digits_of(values: Any) -> int:
    """Returns how many digits to print: 6, or more if bounds differ little, as map coordinates."""
    if not isinstance(values, list) or not all(isinstance(value, float) for value in values):
        return 6
    ends = values[: len(values) // 2 * 2]
    apart = max((b - a for a, b in zip(ends[::2], ends[1::2])), default=0.0)
    most = max(map(abs, ends), default=0.0)
    return 6 + max(0, math.ceil(math.log10(most / apart))) if most > 0 and apart > 0 else 6


def _one_line(found: dict[str, Any]) -> str:
    return ", ".join(f"{name} {_text(value)}" for name, value in found.items())


def _text(value: Any, digits: int = 6) -> str:
    if isinstance(value, list):
        return " ".join(_text(one, digits) for one in value) or "none"
    return f"{value:.{digits}g}" if isinstance(value, float) else str(value)
