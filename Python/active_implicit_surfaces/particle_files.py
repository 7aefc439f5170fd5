"""Reads particles or images from one file or a series, as the frames of a ParticleSeries."""

from __future__ import annotations

import csv
import functools
import re
import warnings
import zipfile
import zlib
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkFiltersCore import vtkAppendFilter

from . import atom_files, simulation_files, text_particles
from .choice import choose, conditions, image_of_label, labels_of, note_once
from .data_objects import (
    add_array,
    array_names,
    as_particles,
    blocks_of,
    has_polygons,
    output_of,
)
from .file_names import expand, numbers_of, running_numbers, suffix_of
from .images import IMAGE_SUFFIXES
from .messages import ActiveSurfaceWarning, warn
from .tables import FIELD, Frame
from .times import check_times, one_for_each, places_of, times_at
from .vtk_files import READERS, check_readable, open_vtk, read_vtk, update

_TABLES = (".csv", ".tsv", ".txt", ".dat")
_OWN_READERS = {
    **dict.fromkeys(_TABLES, text_particles.read_csv),
    **dict.fromkeys((".xyz", ".extxyz"), text_particles.read_xyz),
    ".json": text_particles.read_json,
    ".npy": text_particles.read_numpy,
    ".npz": text_particles.read_numpy,
    ".gro": atom_files.read_gro,
    ".pdb": atom_files.read_pdb,
    **dict.fromkeys((".bgeo", ".bgeo.gz", ".bhclassic"), simulation_files.read_bgeo),
    **dict.fromkeys((".lammpstrj", ".dump"), simulation_files.read_dump),
    ".hdf5": simulation_files.read_pysph,
}
PARTICLE_SUFFIXES = tuple(
    suffix
    for suffix in (*READERS, ".ply", *_OWN_READERS)
    if suffix not in (".stl", ".obj", *IMAGE_SUFFIXES)
)
TARGET_SUFFIXES = (*PARTICLE_SUFFIXES, *IMAGE_SUFFIXES)

# Exceptions of zipfile for damaged archives. NotImplementedError is a RuntimeError.
_DAMAGE_OF_ARCHIVES = (zipfile.BadZipFile, zlib.error, RuntimeError, OverflowError)

_ABOUT_MESHES = " The commands convert and morph use the mesh's surface."


class ParticleFiles:
    """Frames of a series of files, or of one file with several frames.

    Attributes:
    - names (list of Path): file of each frame, or the first of its parts.
    - files (list of Path): all files.
    - numbers (list of int): frame numbers from the names; see file_names.numbers_of.
    """

    def __init__(
        self,
        frames: list[tuple[Path, ...]],
        loaders: list[Any],
        times: Sequence[float],
        where: str | Sequence[str],
        label: int | None,
    ) -> None:
        self.names = [parts[0] for parts in frames] * (len(loaders) // len(frames))
        self.files = [file for parts in frames for file in parts]
        self._loaders, self.times = loaders, check_times(times)
        self._where, self._label = where, label
        conditions(where)
        self._note_absent = note_once() if len(loaders) > 1 else None
        self.numbers = numbers_of(self.names)

    def __len__(self) -> int:
        return len(self.times)

    def load(self, step: int) -> Any:
        """Returns the selected particles of a frame as a vtkPolyData, or an image.

        Raises OSError if the file cannot be read, or its data are no point set or image, and
        ValueError as `choose` does. In a series, however, images may lack the label, and a
        condition's value that no particle has causes only a warning.
        """
        data = self._loaders[step]()
        if len(self) > 1 and data.IsA("vtkImageData") != (self.kind == "vtkImageData"):
            what = "an image" if data.IsA("vtkImageData") else "no image"
            raise OSError(
                f"{self.names[step]} is {what}, unlike {self.names[0]}; give only images, or only "
                "particles."
            )
        try:
            return self._choose(data)
        except ValueError as error:
            raise ValueError(f"{self.names[step]}: {error}") from error

    def _choose(self, data: Any) -> Any:
        if self._label is not None and data.IsA("vtkImageData") and len(self) > 1:
            return image_of_label(data, self._label)  # some frames may lack the label
        return choose(data, self._where, self._label, self._note_absent)

    @functools.cached_property
    def kind(self) -> str:
        """Returns the class of the frames: vtkPolyData, or vtkImageData for images."""
        is_image = suffix_of(self.names[0]) in IMAGE_SUFFIXES
        may_be = suffix_of(self.names[0]) in (".vtk", ".vdb")
        is_image = is_image or (may_be and self._loaders[0]().IsA("vtkImageData"))
        return "vtkImageData" if is_image else "vtkPolyData"


def open_particles(
    names: str | Path | Sequence[str | Path],
    *,
    fps: float | None = None,
    times: Sequence[float] | None = None,
    where: str | Sequence[str] = (),
    label: int | None = None,
) -> ParticleFiles:
    """Opens files of particles or images as frames; names may be patterns, folders or one index.

    `where` selects particles; `label` selects particles, or a label of images (see choice.choose).
    Times follow from `times`, else from `fps`, else from the index or the files, else from 25
    frames per second. If times follow from frames per second, gaps in the numbers of files are gaps
    in time.
    """
    listing, noted = expand(names, TARGET_SUFFIXES), set[str]()
    files, told = listing.files, listing.times
    if listing.note:
        warn(listing.note)
    if len(listing.frames) == 1 and len(listing.frames[0]) == 1:
        loaders, own = _open_one(files[0], noted)
        told = own if told is None or len(loaders) > 1 else told
    else:
        loaders = [_later(parts, noted) for parts in listing.frames]
        told = told or _times_inside(files)
    if times is not None:
        told = one_for_each(times, len(loaders))
    elif fps is not None or told is None:
        places = places_of(running_numbers(files)) if len(files) > 1 else range(len(loaders))
        told = times_at(places, fps)
    else:
        _check_own(files[0], told)
    return ParticleFiles(listing.frames, loaders, told, where, label)


def _check_own(path: Path, times: Sequence[float]) -> None:
    try:
        check_times(times)
    except ValueError as error:
        raise OSError(f"{path}: {error}") from error


def labels_in(files: ParticleFiles) -> list[int]:
    """Returns the labels of the first, the middle and the last frame."""
    steps = {0, len(files) // 2, len(files) - 1}
    return sorted({label for step in steps for label in labels_of(files.load(step))})


def _later(parts: tuple[Path, ...], noted: set[str]) -> Any:
    def load() -> Any:
        clouds = []
        for path in parts:
            loaders, _ = _open_one(path, noted)
            if len(loaders) > 1:
                _note(
                    noted,
                    path,
                    f"it has {len(loaders)} frames, but a series of files uses only the first "
                    "frame of each file; to use all frames, open only this file.",
                )
            clouds.append(loaders[0]())
        if len(clouds) > 1 and not all(cloud.IsA("vtkPointSet") for cloud in clouds):
            raise OSError(
                f"{parts[0]} is one of several parts of a frame, and some parts are images; write "
                "each image as one file: only particles can be in several parts."
            )
        if len(clouds) > 1 and (lost := _arrays_of_some(clouds)):
            _note(
                noted,
                parts[0],
                f"the array(s) {', '.join(lost)} are left out, because some parts of the frame "
                "lack them; write all arrays in all parts.",
            )
        return clouds[0] if len(clouds) == 1 else as_particles(_append(clouds))

    return load


def _note(noted: set[str], path: Path, text: str) -> None:
    """Warns about a file, once for each text in a series."""
    if text not in noted:
        noted.add(text)
        warn(f"{path}: {text}")


def _open_one(path: Path, noted: set[str]) -> tuple[list[Any], list[float] | None]:
    """Returns a loader for each frame of a file, and the frames' times (None if unknown)."""
    check_readable(path)
    suffix = suffix_of(path)
    if suffix in _OWN_READERS:
        reader = functools.partial(_OWN_READERS[suffix], path)
        frames, times = _read_own(path, noted, reader)
        return [_maker(path, frame, noted) for frame in frames], times
    if suffix in IMAGE_SUFFIXES:
        return [lambda: read_vtk(path)], None
    if suffix not in PARTICLE_SUFFIXES:
        if suffix in READERS:
            raise OSError(
                f"{path}: {suffix} is a format of meshes, not of particles.{_ABOUT_MESHES}"
            )
        raise OSError(
            f"{path}: particles or images are read from {', '.join(TARGET_SUFFIXES)}, not from "
            f"{suffix or 'a file without an extension'}."
        )
    if suffix == ".ply":
        return [lambda: _points_of(path, read_vtk(path), noted)], None
    reader = open_vtk(path)
    info = reader.GetOutputInformation(0)
    steps = list(info.Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS()) or ())
    if len(steps) < 2:
        return [lambda: _points_of(path, update(reader, path), noted)], None
    # Steps 0, 1, 2 ... count as numbers assigned by the reader, not as times of the file.
    counted = steps == [float(i) for i in range(len(steps))]
    loaders = [_step_loader(path, reader, time, noted) for time in steps]
    return loaders, None if counted else steps


def _step_loader(path: Path, reader: Any, time: float, noted: set[str]) -> Any:
    def load() -> Any:
        data = update(reader, path, time)
        copy = data.NewInstance()
        copy.DeepCopy(data)  # the readers of such files reuse the same arrays for the next step
        return _points_of(path, copy, noted)

    return load


def _read_own(path: Path, noted: set[str], read: Callable[[], Any]) -> Any:
    """Returns the result of a reader of this package; its warnings and errors name the file."""
    try:
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always", ActiveSurfaceWarning)
            found = read()
        for each in said:
            _note(noted, path, str(each.message))
        return found
    except OSError as error:
        if error.strerror is None:  # a message of our own
            raise
        raise OSError(f"{path} cannot be read as particles: {error.strerror}.") from error
    except (ValueError, TypeError, LookupError, EOFError, csv.Error) as error:
        said_first = str(error).partition("\n")[0].rstrip(".")
        raise OSError(f"{path} cannot be read as particles: {said_first}.") from error
    except _DAMAGE_OF_ARCHIVES as error:
        raise OSError(
            f"{path} cannot be read as particles: it is damaged or encrypted, or a number in it "
            "is too large; write it again."
        ) from error


def _maker(path: Path, frame: Frame | Callable[[], Frame], noted: set[str]) -> Any:
    def make() -> Any:
        held = _read_own(path, noted, frame) if callable(frame) else frame
        arrays = {k: v for k, v in held.items() if k not in ("positions", FIELD)}
        try:
            cloud = as_particles(held["positions"], **arrays)
            for name, values in held.get(FIELD, {}).items():
                add_array(cloud, name, values, cloud.GetFieldData())
            return cloud
        except (TypeError, ValueError) as error:
            raise OSError(f"{path} cannot be read as particles: {error}") from error

    return make


def _points_of(path: Path, data: Any, noted: set[str]) -> Any:
    """Returns an image, or the points of other data with their arrays; warns of a mesh."""
    if data.IsA("vtkCompositeDataSet"):
        data = _append([block for block in blocks_of(data) if block.IsA("vtkPointSet")])
    if data.IsA("vtkImageData"):
        return data
    if not data.IsA("vtkPointSet"):
        raise OSError(f"{path} has no particles: it holds a {data.GetClassName()}.")
    if has_polygons(data):
        _note(noted, path, f"it holds a mesh, whose corners are used as particles.{_ABOUT_MESHES}")
    return as_particles(data)


def _arrays_of_some(clouds: list[Any]) -> list[str]:
    """Returns the names of arrays that some, but not all, clouds with points have."""
    arrays = [cloud.GetPointData() for cloud in clouds if cloud.GetNumberOfPoints()]
    names = [set(array_names(own)) for own in arrays]
    return sorted(set[str]().union(*names) - set[str].intersection(*names)) if names else []


def _append(clouds: list[Any]) -> Any:
    """Returns the points of all clouds, with the arrays that all clouds with points have."""
    return output_of(vtkAppendFilter(), *(clouds or [vtkPolyData()]))


def _times_inside(files: list[Path]) -> list[float] | None:
    """Returns the time in each file; None unless each file has one time and the times increase."""
    readers = {
        **dict.fromkeys((".vtp", ".vtu", ".vti"), _time_of_xml),
        ".vdb": _time_of_vdb,
        **dict.fromkeys(_TABLES, text_particles.time_of_csv),
        **dict.fromkeys((".dump", ".lammpstrj", ".gro", ".hdf5"), _time_of_own),
    }
    times: list[float] = []
    for file in files:
        time = readers.get(suffix_of(file), lambda _: None)(file)
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


def _time_of_own(path: Path) -> float | None:
    check_readable(path)
    times = _read_own(path, set(), functools.partial(_OWN_READERS[suffix_of(path)], path))[1]
    return times[0] if times and len(times) == 1 else None


def _time_of_vdb(path: Path) -> float | None:
    text = open_vtk(path).GetMetadata("time")
    return float(text) if text else None
