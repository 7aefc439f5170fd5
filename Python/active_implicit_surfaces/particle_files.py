"""Particles from files of many kinds, one or a series, as frames of a ParticleSeries."""

from __future__ import annotations

import importlib
import re
import zipfile
import zlib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkFiltersCore import vtkAppendFilter

from . import text_particles
from .data_objects import as_particles
from .file_names import expand, numbers_of, suffix_of
from .messages import listening, quiet
from .obj_files import check_obj
from .ply_files import check_ply
from .series import check_times, times_at
from .stl_files import check_stl

# Extension: module and class of the reader.
_VTK_READERS = {
    ".vtp": ("vtkmodules.vtkIOXML", "vtkXMLPolyDataReader"),
    ".vtu": ("vtkmodules.vtkIOXML", "vtkXMLUnstructuredGridReader"),
    ".pvtp": ("vtkmodules.vtkIOXML", "vtkXMLPPolyDataReader"),
    ".pvtu": ("vtkmodules.vtkIOXML", "vtkXMLPUnstructuredGridReader"),
    ".vti": ("vtkmodules.vtkIOXML", "vtkXMLImageDataReader"),
    ".vtk": ("vtkmodules.vtkIOLegacy", "vtkGenericDataObjectReader"),
    ".vtkhdf": ("vtkmodules.vtkIOHDF", "vtkHDFReader"),
    ".ply": ("vtkmodules.vtkIOPLY", "vtkPLYReader"),
    ".stl": ("vtkmodules.vtkIOGeometry", "vtkSTLReader"),
    ".obj": ("vtkmodules.vtkIOGeometry", "vtkOBJReader"),
    ".vdb": ("active_implicit_surfaces.vtkActiveIO", "vtkActiveVDBReader"),
}
# What looks a file through before VTK's reader, which takes, or crashes at, any bytes.
_CHECKS = {".ply": check_ply, ".obj": check_obj, ".stl": check_stl}
_TEXT_READERS = {
    ".csv": text_particles.read_csv,
    ".xyz": text_particles.read_xyz,
    ".json": text_particles.read_json,
    ".npy": text_particles.read_numpy,
    ".npz": text_particles.read_numpy,
}
PARTICLE_SUFFIXES = tuple(
    suffix for suffix in (*_VTK_READERS, *_TEXT_READERS) if suffix not in (".vti", ".stl", ".obj")
)


# What zipfile raises besides; of these NotImplementedError is a RuntimeError.
_DAMAGE_OF_ARCHIVES = (zipfile.BadZipFile, zlib.error, RuntimeError, OverflowError)

_ABOUT_APPENDED_DATA = (
    " If it is whole: VTK 9.1 cannot read appended data with libexpat 2.5.0-1+deb12u2; write it "
    "with SetDataModeToBinary (in ParaView: Data Mode Binary)."
)


class ParticleFiles:
    """The frames of a series of files, or of one file that has several.

    Attributes
    ----------
    times : list of float
    names : list of Path
        The file of each frame.
    numbers : list of int
        Those in the names of the files, if they differ by them, else 0, 1, 2 ...
    """

    def __init__(self, names: list[Path], loaders: list[Any], times: Sequence[float]) -> None:
        self.names, self._loaders, self.times = names, loaders, check_times(times)
        self.numbers = numbers_of(names)

    def __len__(self) -> int:
        return len(self.times)

    def load(self, step: int) -> Any:
        """The particles of a frame, a vtkPolyData.

        Raises
        ------
        OSError
            The file cannot be read, or has no particles.
        """
        return self._loaders[step]()


def open_particles(
    names: str | Path | Sequence[str | Path],
    *,
    fps: float | None = None,
    times: Sequence[float] | None = None,
) -> ParticleFiles:
    """Files of particles as frames; patterns, .series and .pvd too.

    Times are `times`, else as `fps` says, else those of the index or of the files, else 25 frames
    per second. Where numbers of files are left out, the time between is as much longer.
    """
    files, told = expand(names)
    if len(files) == 1:
        loaders, own = _open_one(files[0])
        told = own if told is None or len(loaders) > 1 else told
    else:
        loaders = [_later(file) for file in files]
        told = told or _times_inside(files)
    if times is not None:
        if len(times) != len(loaders):
            raise ValueError(f"There are {len(times)} times for {len(loaders)} frames.")
        told = list(times)
    elif fps is not None or told is None:
        places = _places(numbers_of(files)) if len(files) > 1 else range(len(loaders))
        told = times_at(places, fps)
    return ParticleFiles(files * (len(loaders) // len(files)), loaders, told)


def read_vtk(path: Path, time: float | None = None, **settings: Any) -> Any:
    """What a reader of VTK or of this package makes of a file, at one of its time steps."""
    reader = _vtk_reader(path, **settings)
    return _update(reader, path, time)


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


def _places(numbers: Sequence[int]) -> list[float]:
    """Where frames are, in steps of the least difference of their numbers."""
    step = min(after - before for before, after in zip(numbers, numbers[1:]))
    return [(number - numbers[0]) / step for number in numbers]


def _later(path: Path) -> Any:
    return lambda: _open_one(path)[0][0]()


def _open_one(path: Path) -> tuple[list[Any], list[float] | None]:
    """A function for each frame of a file, and the times that it tells."""
    check_readable(path)
    suffix = suffix_of(path)
    if suffix in _TEXT_READERS:
        frames, times = _read_text(path)
        return [_maker(path, frame) for frame in frames], times
    if suffix not in PARTICLE_SUFFIXES:
        raise OSError(
            f"{path}: particles are read from {', '.join(PARTICLE_SUFFIXES)}, not from "
            f"{suffix or 'a file without an extension'}."
        )
    reader = _vtk_reader(path)
    with quiet(), listening(reader) as heard:
        reader.UpdateInformation()
    _check(path, heard.errors)
    steps = _time_steps(reader)
    if len(steps) < 2:
        return [lambda: _points_of(path, _update(reader, path))], None
    # These readers number the steps that a file holds.
    counted = steps == [float(i) for i in range(len(steps))]
    loaders = [_step_loader(path, reader, time) for time in steps]
    return loaders, None if counted else steps


def _step_loader(path: Path, reader: Any, time: float) -> Any:
    def load() -> Any:
        data = _update(reader, path, time)
        copy = data.NewInstance()
        copy.DeepCopy(data)  # the readers of such files write the next step into the same arrays
        return _points_of(path, copy)

    return load


def _read_text(path: Path) -> text_particles.Frames:
    try:
        return _TEXT_READERS[suffix_of(path)](path)
    except OSError as error:
        if error.strerror is None:  # with a sentence of our own
            raise
        raise OSError(f"{path} cannot be read as particles: {error.strerror}.") from error
    except (ValueError, KeyError, IndexError, UnicodeDecodeError, EOFError) as error:
        said = str(error).partition("\n")[0].rstrip(".")
        raise OSError(f"{path} cannot be read as particles: {said}.") from error
    except _DAMAGE_OF_ARCHIVES as error:
        raise OSError(f"{path} cannot be read as particles: it is damaged.") from error


def _maker(path: Path, frame: text_particles.Frame) -> Any:
    def make() -> Any:
        try:
            return as_particles(
                frame["positions"], **{k: v for k, v in frame.items() if k != "positions"}
            )
        except (TypeError, ValueError) as error:
            raise OSError(f"{path} cannot be read as particles: {error}") from error

    return make


def _vtk_reader(path: Path, **settings: Any) -> Any:
    check_readable(path)
    suffix = suffix_of(path)
    if suffix in _CHECKS:
        _CHECKS[suffix](path)
    module, name = _VTK_READERS[suffix]
    try:
        reader = getattr(importlib.import_module(module), name)()
    except ImportError as error:
        raise OSError(f"{path} cannot be read: this installation has no {name}.") from error
    for setting, value in settings.items():
        getattr(reader, setting)(value)
    reader.SetFileName(str(path))
    return reader


def _time_steps(reader: Any) -> list[float]:
    info = reader.GetOutputInformation(0)
    return list(info.Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS()) or ())


def _update(reader: Any, path: Path, time: float | None = None) -> Any:
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
    return data


def _check(path: Path, errors: list[str], failed: bool = False) -> None:
    if errors or failed:
        said = errors[0].rstrip(".") if errors else "it is damaged, or not what its extension says"
        raise OSError(f"{path} cannot be read: {said}.{_hint(path)}")


def _hint(path: Path) -> str:
    """What may be wrong with a whole file: Debian 12's VTK 9.1 beside its newer libexpat."""
    is_old = vtkVersion.GetVTKVersion().startswith("9.1.")
    if not is_old or suffix_of(path) not in (".vtp", ".vtu", ".vti", ".pvtp", ".pvtu"):
        return ""
    with path.open("rb") as file:
        is_appended = b"<AppendedData" in file.read(1 << 20)
    return _ABOUT_APPENDED_DATA if is_appended else ""


def _points_of(path: Path, data: Any) -> Any:
    """The points of whatever data set that is, with their arrays."""
    if data.IsA("vtkCompositeDataSet"):
        data = _append_blocks(data)
    if not data.IsA("vtkPointSet"):
        raise OSError(f"{path} has no particles: it holds a {data.GetClassName()}.")
    return as_particles(data)


def _append_blocks(data: Any) -> Any:
    together, blocks = vtkAppendFilter(), data.NewIterator()
    while not blocks.IsDoneWithTraversal():
        together.AddInputData(blocks.GetCurrentDataObject())
        blocks.GoToNextItem()
    together.Update()
    return together.GetOutput()


def _times_inside(files: list[Path]) -> list[float] | None:
    """The times that all files of VTK's XML kind tell in their heads, if they increase."""
    if any(suffix_of(file) not in (".vtp", ".vtu", ".vdb") for file in files):
        return None
    times: list[float] = []
    for file in files:
        time = _time_of_vdb(file) if suffix_of(file) == ".vdb" else _time_of_xml(file)
        if time is None or (times and time <= times[-1]):
            return None
        times.append(time)
    return times


def _time_of_xml(path: Path) -> float | None:
    check_readable(path)
    with path.open("rb") as file:
        head = file.read(16384)
    found = re.search(rb'<(?:Data)?Array[^>]*Name="TimeValue"[^>]*NumberOfTuples="1"[^>]*>', head)
    value = re.search(rb'RangeMin="([^"]+)"', found[0]) if found else None
    return float(value[1]) if value else None


def _time_of_vdb(path: Path) -> float | None:
    reader = _vtk_reader(path)
    with quiet(), listening(reader) as heard:
        reader.UpdateInformation()
    _check(path, heard.errors)
    text = reader.GetMetadata("time")
    return float(text) if text else None
