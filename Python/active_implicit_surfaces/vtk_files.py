"""Reads files by readers of VTK and of this package; their errors become OSError."""

from __future__ import annotations

import importlib
import mmap
import re
from pathlib import Path
from typing import Any

from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkCommonDataModel import vtkPolyData

from .file_names import suffix_of
from .images import IMAGE_SUFFIXES, read_image
from .mesh_checks import add_vertices, check_obj, check_stl, is_empty_stl
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
# Checks before VTK's reader, which accepts any bytes or crashes.
_CHECKS = {".obj": check_obj, ".stl": check_stl}

_NO_POINTS = "No Points element available"
_ABOUT_APPENDED_DATA = (
    " If it is whole: VTK 9.1 cannot read appended data with libexpat 2.5.0-1+deb12u2; write it "
    "with SetDataModeToBinary (in ParaView: Data Mode Binary)."
)


def read_vtk(path: Path) -> Any:
    """Returns the data object that a file holds, at the first of its time steps."""
    if suffix_of(path) == ".ply":
        check_readable(path)
        return read_ply(path)
    reader = _reader_of(path)
    if suffix_of(path) in IMAGE_SUFFIXES[1:]:
        return read_image(path, reader, lambda reader: update(reader, path))
    if suffix_of(path) == ".stl" and is_empty_stl(path):
        return vtkPolyData()
    return update(reader, path)


def check_readable(path: Path) -> None:
    """Raises OSError if there is no such file, or it cannot be opened or is empty."""
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
    if suffix in _CHECKS:
        _CHECKS[suffix](path)
    module, name = READERS[suffix]
    try:
        reader = getattr(importlib.import_module(module), name)()
    except ImportError as error:
        raise OSError(f"{path} cannot be read: this installation has no {name}.") from error
    if suffix == ".vtkhdf" and not hasattr(reader, "GetNumberOfSteps"):
        _check_steps(path)
    reader.SetFileName(str(path))
    return reader


def _check_steps(path: Path) -> None:
    """Raises OSError if a .vtkhdf has time steps, which this VTK would read as one."""
    with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content:
        if content.find(b"NSteps") >= 0:
            raise OSError(
                f"{path} has time steps, which VTK {vtkVersion.GetVTKVersion()} cannot read from "
                "a .vtkhdf; write a file for each step, and a .pvd, or use VTK 9.3 or later."
            )


def update(reader: Any, path: Path, time: float | None = None) -> Any:
    """Returns the output of a reader at a time step."""
    with quiet() as said, listening(reader) as heard:
        if time is None:
            reader.Update()
        else:
            reader.UpdateTimeStep(time)
    failed = hasattr(reader, "GetErrorCode") and reader.GetErrorCode() != 0
    _check(path, heard.errors or said.errors, failed)
    data = reader.GetOutputDataObject(0)
    if data is None:
        raise OSError(f"{path} cannot be read: it is damaged, or not what its extension says.")
    if suffix_of(path) == ".obj":
        add_vertices(path, data)
    return data


def _check(path: Path, errors: list[str], failed: bool = False) -> None:
    errors = [said for said in errors if not (_NO_POINTS in said and _is_empty(path))]
    if errors or failed:
        said = errors[0].rstrip(".") if errors else "it is damaged, or not what its extension says"
        raise OSError(f"{path} cannot be read: {said}.{_hint(path)}")


def _is_empty(path: Path) -> bool:
    """Returns True if a file of VTK's XML formats has no points, and so no array of them."""
    with path.open("rb") as file:
        counts = re.findall(rb'NumberOfPoints="(\d+)"', file.read(1 << 20))
    return bool(counts) and not any(map(int, counts))


def _hint(path: Path) -> str:
    """Returns a hint on Debian 12, whose VTK 9.1 fails at appended data with its libexpat."""
    is_old = vtkVersion.GetVTKVersion().startswith("9.1.")
    if not is_old or suffix_of(path) not in (".vtp", ".vtu", ".vti", ".pvtp", ".pvtu"):
        return ""
    with path.open("rb") as file:
        is_appended = b"<AppendedData" in file.read(1 << 20)
    return _ABOUT_APPENDED_DATA if is_appended else ""
