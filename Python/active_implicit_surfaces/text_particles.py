"""Reads particles from .csv, .xyz, .json, .npy and .npz files as numpy arrays.

Each reader returns a list of frames (dictionaries of arrays, one of them "positions"), and the
times of the frames, None if the file has no times.
"""

from __future__ import annotations

import contextlib
import csv
import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy

from .atom_files import read_molecule
from .tables import POSITIONS, Frame, Frames, number, read_table

_UTF_16 = (b"\xff\xfe", b"\xfe\xff")
_HEAD = 1 << 16  # bytes at the start of a file that are searched for times


def read_csv(path: Path) -> Frames:
    """Reads a table with or without a header."""
    return read_table(_text_of(path.read_bytes()))


def time_of_csv(path: Path) -> float | None:
    """Returns the time of a table; None unless the first 64 KiB have one time."""
    with path.open("rb") as file:
        head = file.read(_HEAD)
    try:
        times = read_table(_text_of(head[: head.rfind(b"\n")] if len(head) == _HEAD else head))[1]
    except (ValueError, csv.Error):
        return None
    return times[0] if times and len(times) == 1 else None


def _text_of(content: bytes) -> str:
    """Decodes text as UTF-8, else by its byte order mark, else as Latin-1."""
    for encoding in ("utf-8-sig", *(("utf-16",) if content[:2] in _UTF_16 else ()), "latin-1"):
        with contextlib.suppress(UnicodeDecodeError):
            text = content.decode(encoding)
            break
    if "\0" in text:
        raise ValueError("it is no text, or UTF-16 without a byte order mark")
    if not text.strip():
        raise ValueError("it is empty")
    return text


def read_xyz(path: Path) -> Frames:
    """Reads a table of columns x y z, frames of a molecule (count, elements), or 32-bit floats."""
    content = path.read_bytes()
    if b"\0" in content[:4096] and content[:2] not in _UTF_16:
        if len(content) % 12:
            raise ValueError(
                "it is neither text nor 32-bit floats x y z (its size is no multiple of 12 bytes); "
                "copy or write it again"
            )
        return [{"positions": numpy.frombuffer(content, "<f4").reshape(-1, 3)}], None
    text = _text_of(content)
    if re.match(r"\s*\d+[ \t]*(\r?\n|$)", text):
        return read_molecule(text.splitlines())
    return read_table(text)


def read_json(path: Path) -> Frames:
    """Reads a list of positions, an object of arrays, or a list with an object per particle."""
    data = json.loads(path.read_text(encoding="utf-8"))
    if isinstance(data, list) and data and all(isinstance(row, dict) for row in data):
        data = {name: [row.get(name) for row in data] for name in data[0]}  # one row per dictionary
    if isinstance(data, list):
        return _from_arrays({"positions": _even_array("list", data)})
    if not isinstance(data, dict):
        raise ValueError(
            "it is neither a list of positions nor an object of arrays; write it as one of these"
        )
    return _from_arrays(
        {
            # pandas writes a column as an object of its rows.
            name: _even_array(
                f'array "{name}"', [*values.values()] if isinstance(values, dict) else values
            )
            for name, values in data.items()
        }
    )


def _even_array(what: str, values: Any) -> Any:
    try:
        found = numpy.array(values)
    except ValueError:
        raise ValueError(
            f"its {what} has rows of different lengths or depths; write rows of one form"
        ) from None
    if (
        found.dtype == object
        and found.ndim == 1
        and all(isinstance(cell, (str, type(None))) for cell in values)
    ):
        return numpy.array([cell or "" for cell in values])
    return found


def read_numpy(path: Path) -> Frames:
    """Reads an array (n, 3) or (frames, n, 3), other arrays, and "fps" or "times".

    If there is an array "counts", the number of particles of each frame, the other arrays hold the
    rows of all frames one after another.
    """
    with path.open("rb") as file:
        try:
            found = numpy.load(file, allow_pickle=False)
            plain = isinstance(found, numpy.ndarray)
            arrays = {"positions": found} if plain else {name: found[name] for name in found.files}
        except ValueError as error:
            if "allow_pickle" in str(error):
                raise ValueError(
                    "it is no .npy or .npz, or it has Python objects, which may contain code and "
                    "are not loaded; save arrays of numbers (PySPH: .hdf5, which needs h5py)"
                ) from None
            raise
        return _from_arrays(arrays)


def _from_arrays(arrays: Mapping[str, Any]) -> Frames:
    names = {name.lower(): name for name in arrays}
    found = next((names[name] for name in (*POSITIONS, "x") if name in names), None)
    if found is None and len(arrays) == 1:
        found = next(iter(arrays))
    if found is None or (found.lower() == "x" and ("y" in names) != ("z" in names)):
        raise ValueError(
            f"it has no array of positions, but {', '.join(arrays) or 'nothing'}; add an array "
            'named "positions"'
        )
    if found.lower() == "x" and "y" in names:
        arrays = {**arrays, "positions": _stacked([arrays[names[n]] for n in "xyz"])}
        found = "positions"
    positions = arrays[found]
    positions = positions.reshape(0, 3) if positions.shape == (0,) else positions
    if positions.dtype.kind not in "iuf":
        raise ValueError("its positions have values that are not numbers; write numbers only")
    if positions.ndim not in (2, 3) or positions.shape[-1] != 3:
        raise ValueError(
            f"its positions have the shape {positions.shape}; they need the shape (n, 3) or "
            "(frames, n, 3)"
        )
    counts = arrays.get("counts")
    if counts is not None and positions.ndim == 2 and _are_counts(counts, positions):
        return _cut(arrays, found, counts)
    moving = positions if positions.ndim == 3 else positions[None]
    frames = [{"positions": frame} for frame in moving]
    for name, values in arrays.items():
        if name != found:
            _share(frames, name, values, positions)
    return frames, _times(arrays, len(frames)) if positions.ndim == 3 else None


def _stacked(axes: list[Any]) -> Any:
    if len({axis.shape for axis in axes}) > 1:
        raise ValueError("its arrays x, y and z differ in shape; correct them")
    return numpy.stack(axes, axis=-1)


def _are_counts(counts: Any, positions: Any) -> bool:
    """Returns True if `counts` has the number of particles of each frame.

    Returns False if `counts` has a value for each particle; raises ValueError if neither holds.
    """
    if counts.ndim != 1:
        return False
    are_natural = counts.dtype.kind in "iu" and bool((counts >= 0).all())
    if are_natural and int(counts.sum()) == len(positions):
        return True
    if counts.shape == positions.shape[:1]:
        return False
    if not are_natural:
        raise ValueError(
            'its array "counts" has values that are not whole numbers of 0 or more; correct it'
        )
    raise ValueError(
        f'its array "counts" adds up to {int(counts.sum())}, but there are {len(positions)} '
        "positions; correct one of the two"
    )


def _cut(arrays: Mapping[str, Any], found: str, counts: Any) -> Frames:
    """Splits concatenated arrays into frames."""
    ends = numpy.cumsum(counts)
    rows = {
        "positions" if name == found else name: values
        for name, values in arrays.items()
        if values.shape[:1] == (ends[-1],) and values.dtype.kind in "biufU" and values.ndim < 3
    }
    frames = [
        {name: values[end - count : end] for name, values in rows.items()}
        for count, end in zip(counts, ends)
    ]
    return frames, _times(arrays, len(frames))


def _share(frames: list[Frame], name: str, values: Any, positions: Any) -> None:
    """Adds an array to the frames, if its shape matches the particles."""
    if values.dtype.kind not in "biufU":
        return
    if values.shape[: positions.ndim - 1] == positions.shape[:-1]:
        for frame, own in zip(frames, values if positions.ndim == 3 else values[None]):
            frame[name] = own
    elif positions.ndim == 3 and values.shape[:1] == positions.shape[1:2]:
        for frame in frames:
            frame[name] = values


def _numbers(name: str, values: Any) -> list[float]:
    if values.dtype.kind not in "iuf":
        raise ValueError(f'its array "{name}" has values that are not numbers; correct it')
    return [float(time) for time in values]


def _times(arrays: Mapping[str, Any], count: int) -> list[float] | None:
    for name in ("times", "time"):
        if name in arrays and arrays[name].shape == (count,):
            return _numbers(name, arrays[name])
    if "times" in arrays and arrays["times"].ndim == 1:
        raise ValueError(
            f'its array "times" has {len(arrays["times"])} value(s) for {count} frame(s); '
            "write one for each frame"
        )
    if "fps" in arrays and arrays["fps"].size == 1:
        rate = number(str(arrays["fps"].ravel()[0]))
        if rate is None or not 0 < rate < numpy.inf:
            said = arrays["fps"].ravel()[0]
            raise ValueError(f'its "fps" is {said}, not a finite number above 0; correct it')
        return [step / rate for step in range(count)]
    return None
