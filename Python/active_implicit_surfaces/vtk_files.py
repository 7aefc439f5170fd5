"""Reads files by readers of VTK and of this package; the readers' errors become OSError.

VTK's readers of .obj and .stl accept any bytes, or crash, so this module checks such files first.
From an .obj, this module reads colours and digits that VTK drops, and it removes VTK's array of
group numbers.
"""

from __future__ import annotations

import importlib
import mmap
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkCommonDataModel import vtkPolyData

from .data_objects import add_array, copy_of, vtk_points
from .file_names import suffix_of
from .images import IMAGE_SUFFIXES, read_image
from .mesh_writers import origin_for_floats
from .messages import listening, quiet
from .ply_files import read_ply

# Extension: module and class of the reader.
READERS = {
    ".vtp": ("vtkmodules.vtkIOXML", "vtkXMLPolyDataReader"),
    ".vtu": ("vtkmodules.vtkIOXML", "vtkXMLUnstructuredGridReader"),
    ".pvtp": ("vtkmodules.vtkIOXML", "vtkXMLPPolyDataReader"),
    ".pvtu": ("vtkmodules.vtkIOXML", "vtkXMLPUnstructuredGridReader"),
    ".vtm": ("vtkmodules.vtkIOXML", "vtkXMLMultiBlockDataReader"),
    ".vti": ("vtkmodules.vtkIOXML", "vtkXMLImageDataReader"),
    **dict.fromkeys((".nii", ".nii.gz"), ("vtkmodules.vtkIOImage", "vtkNIFTIImageReader")),
    **dict.fromkeys((".mha", ".mhd"), ("vtkmodules.vtkIOImage", "vtkMetaImageReader")),
    **dict.fromkeys((".nrrd", ".nhdr"), ("vtkmodules.vtkIOImage", "vtkNrrdReader")),
    ".vtk": ("vtkmodules.vtkIOLegacy", "vtkGenericDataObjectReader"),
    ".vtkhdf": ("vtkmodules.vtkIOHDF", "vtkHDFReader"),
    ".stl": ("vtkmodules.vtkIOGeometry", "vtkSTLReader"),
    ".obj": ("vtkmodules.vtkIOGeometry", "vtkOBJReader"),
    ".vdb": ("active_implicit_surfaces.vtkActiveIO", "vtkActiveVDBReader"),
}
_NOT_OF_CORNERS = (b"#", b"g", b"o", b"s", b"mtllib", b"usemtl", b"vt", b"vn")
_CORNER = re.compile(rb"(-?\d+)(?:/(-?\d*)(?:/(-?\d*))?)?")
_ENDS_OF_LINES = re.compile(rb"\\\r?\n")  # joined with the next line

_NO_POINTS = "No Points element available"
_NO_RANGE = "Error reading InformationKey"  # VTK writes, but cannot read, a range of NaN
_ABOUT_APPENDED_DATA = (
    " If the file is complete: VTK 9.1 cannot read appended data with libexpat 2.5.0-1+deb12u2; "
    "write the file with SetDataModeToBinary (in ParaView: Data Mode Binary)."
)


def read_vtk(path: Path) -> Any:
    """Returns the data object that a file holds, at the first of its time steps."""
    if suffix_of(path) == ".ply":
        check_readable(path)
        return read_ply(path)
    reader = _reader_of(path)
    if suffix_of(path) in IMAGE_SUFFIXES[1:]:
        return read_image(path, reader, lambda reader: update(reader, path))
    if suffix_of(path) == ".stl" and _is_empty_stl(path):
        return vtkPolyData()
    return update(reader, path)


def check_readable(path: Path) -> None:
    """Raises OSError if a file does not exist, cannot be opened, or is empty."""
    try:
        with path.open("rb") as file:
            if not file.read(1):
                raise OSError(f"{path} is empty.")
    except OSError as error:
        if error.strerror is None:
            raise
        raise OSError(f"{path} cannot be read: {error.strerror}.") from error


def open_vtk(path: Path) -> Any:
    """Returns a reader that has read the file's metadata: times, grids."""
    reader = _reader_of(path)
    with quiet(), listening(reader) as heard:
        reader.UpdateInformation()
    _check(path, heard.errors)
    return reader


def _reader_of(path: Path) -> Any:
    check_readable(path)
    suffix = suffix_of(path)
    if suffix == ".obj":
        _check_obj(path)
    if suffix == ".stl":
        _check_stl(path)
    module, name = READERS[suffix]
    try:
        reader = getattr(importlib.import_module(module), name)()
    except ImportError as error:
        raise OSError(
            f"{path} cannot be read: this installation has no {name}; convert the file."
        ) from error
    if suffix == ".vtkhdf" and not hasattr(reader, "GetNumberOfSteps"):
        _check_steps(path)
    reader.SetFileName(str(path))
    return reader


def _check_steps(path: Path) -> None:
    """Raises OSError if a .vtkhdf has time steps that this VTK would read as one data set."""
    with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content:
        if content.find(b"NSteps") >= 0:
            raise OSError(
                f"{path} has time steps, which VTK {vtkVersion.GetVTKVersion()} cannot read from "
                "a .vtkhdf; write a file for each step, and a .pvd, or use VTK 9.3 or later."
            )


def update(reader: Any, path: Path, time: float | None = None) -> Any:
    """Returns the output of a reader at a time step, by default the first."""
    with quiet() as said, listening(reader) as heard:
        if time is None:
            reader.Update()
        else:
            reader.UpdateTimeStep(time)
    failed = hasattr(reader, "GetErrorCode") and reader.GetErrorCode() != 0
    _check(path, heard.errors or said.errors, failed)
    data = reader.GetOutputDataObject(0)
    if data is None:
        raise OSError(f"{path} cannot be read: its format or extension is wrong; write it again.")
    if suffix_of(path) == ".obj":
        _add_vertices(path, data)
    return data


def _check(path: Path, errors: list[str], failed: bool = False) -> None:
    errors = [
        said
        for said in errors
        if _NO_RANGE not in said and not (_NO_POINTS in said and _is_empty(path))
    ]
    if errors or failed:
        said = (
            errors[0].removeprefix(f"The file {path} cannot be read: ").rstrip(".")
            if errors
            else "it is damaged, or the extension is wrong; write it again"
        )
        raise OSError(f"{path} cannot be read: {said}.{_hint(path)}")


def _is_empty(path: Path) -> bool:
    """Returns True if the first MiB of a VTK XML file has NumberOfPoints, all of them 0."""
    with path.open("rb") as file:
        counts = re.findall(rb'NumberOfPoints="(\d+)"', file.read(1 << 20))
    return bool(counts) and not any(map(int, counts))


def _hint(path: Path) -> str:
    """Returns a hint for appended data with VTK 9.1, which fails with libexpat of Debian 12."""
    is_old = vtkVersion.GetVTKVersion().startswith("9.1.")
    if not is_old or suffix_of(path) not in (".vtp", ".vtu", ".vti", ".pvtp", ".pvtu"):
        return ""
    with path.open("rb") as file:
        is_appended = b"<AppendedData" in file.read(1 << 20)
    return _ABOUT_APPENDED_DATA if is_appended else ""


def _check_obj(path: Path) -> None:
    """Checks the cells of a .obj.

    Raises OSError if data begin without a vertex, or a cell has no corners, corners of different
    forms, or a corner that is malformed or refers to a missing vertex, texture or normal.
    """
    counts = {b"v": 0, b"vt": 0, b"vn": 0}
    faces = []
    for cells in _rows(path):
        if not counts[b"v"] and cells[0] != b"v" and not cells[0].startswith(_NOT_OF_CORNERS):
            raise OSError(
                f"{path} cannot be read: its data begin without a vertex, v x y z; write it again."
            )
        if cells[0] in counts:
            counts[cells[0]] += 1
        elif cells[0] in (b"f", b"l", b"p"):
            # Negative indices count back from the last v, vt or vn before this line.
            faces.append((cells[1:], tuple(counts.values())))
    whole = tuple(counts.values())
    for corners, so_far in faces:
        forms = {_check_corner(path, corner, whole, so_far) for corner in corners}
        if len(forms) > 1 or not forms:
            raise OSError(
                f"{path} cannot be read: a polygon, line or point has no corners, or corners of "
                "different forms (v, v/vt, v//vn); correct it."
            )


def _add_vertices(path: Path, data: Any) -> None:
    """Adds the vertex colours of an .obj (v x y z r g b), and coordinates in doubles if needed."""
    data.GetCellData().RemoveArray("GroupIds")
    rows = [cells[1:7] for cells in _rows(path) if cells[0] == b"v"]
    if data.GetNumberOfPoints() == 0:
        return
    try:
        places = numpy.array([cells[:3] for cells in rows], dtype=float)
        shades = numpy.array([cells[3:] for cells in rows if len(cells) == 6], dtype=float)
    except ValueError as error:
        raise OSError(
            f"{path} cannot be read: a coordinate or colour is missing or no number; correct it."
        ) from error
    points = vtk_to_numpy(data.GetPoints().GetData())
    are_alike = len(points) == len(places) and numpy.allclose(points, places, rtol=1e-6, atol=0)
    if len(shades) == len(rows):
        numbers = numpy.arange(len(places)) if are_alike else _vertices_of(points, places)
        add_array(data, "RGB", numpy.rint(255 * shades.clip(0, 1)).astype("u1")[numbers])
    exact = copy_of(data)
    exact.SetPoints(vtk_points(places))
    if are_alike and origin_for_floats(exact).any():
        data.SetPoints(exact.GetPoints())


def _vertices_of(points: Any, places: Any) -> Any:
    """Returns the vertex index of each point; VTK repeats vertices that have several normals."""
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
    """Returns True for each part (vertex, texture, normal) of a corner, or raises OSError."""
    found = _CORNER.fullmatch(corner)
    if found is None:
        raise OSError(
            f"{path} cannot be read: a corner is none of v, v/vt, v//vn, v/vt/vn; correct it."
        )
    for number, count, before in zip(found.groups(), whole, so_far):
        place = int(number or 0)
        if place > count or place < -before or (number and place == 0):
            raise OSError(
                f"{path} cannot be read: a corner refers to a missing vertex, texture or normal; "
                "correct it."
            )
    return tuple(bool(number) for number in found.groups())


def _is_empty_stl(path: Path) -> bool:
    """Returns True for a binary file (no "solid" first) without triangles; VTK reads it as text."""
    content = path.read_bytes() if path.stat().st_size == 84 else b""
    return content[80:] == bytes(4) and not content.lstrip().lower().startswith(b"solid")


def _check_stl(path: Path) -> None:
    """Raises OSError if a binary file (no "solid" first) is too short for its triangles."""
    with path.open("rb") as file:
        head = file.read(84)
    size, count = path.stat().st_size, int.from_bytes(head[80:84], "little")
    if not head.lstrip().lower().startswith(b"solid") and size < 84 + 50 * count:
        raise OSError(
            f"{path} cannot be read: it is incomplete or no .stl: it has {size} bytes, but a "
            f"header and its {count} triangles take {84 + 50 * count}; write it again."
        )
