"""Particles of .csv, .xyz, .json, .npy and .npz files as arrays of numpy.

Each reader gives a list of frames, dictionaries of arrays with the positions as "positions", and
the times of the frames if the file tells them.
"""

from __future__ import annotations

import csv
import json
import re
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy

Frame = dict[str, Any]
Frames = tuple[list[Frame], "list[float] | None"]

_POSITIONS = ("positions", "position", "points", "point", "vertices", "coordinates", "pos", "x")
_AXES = {"x": 0, "y": 1, "z": 2, "0": 0, "1": 1, "2": 2}


def read_csv(path: Path) -> Frames:
    """Columns x, y, z by their names (Points:0, pos_x, P[x] ... too), or the first three."""
    comments, head, after = _first_lines(path)
    if not head and comments:  # no particles, under a header as that of numpy.savetxt
        head = comments.pop().strip().lstrip("# ")
    if not head:
        raise ValueError("it is empty")
    delimiter = next((mark for mark in ",;\t" if mark in head), None)
    first = _split(head, delimiter)
    is_header = not all(_is_number(cell) for cell in first)
    names = first if is_header else _names_in(comments, delimiter, len(first))
    data = after if is_header else head
    example = _split(data, delimiter) if data else first
    usable = [i for i, cell in enumerate(example) if _is_number(cell)] if data else None
    columns = list(range(len(first))) if usable is None else usable
    table = _load_table(path, delimiter, len(comments) + is_header, columns)
    if not names:
        return [_headless(table)], None
    return [_group({names[i]: table[:, place] for place, i in enumerate(columns)})], None


def read_xyz(path: Path) -> Frames:
    """Columns x y z; frames of a molecule, with count and elements; or raw 32-bit floats."""
    content = path.read_bytes()
    if not content.strip():
        raise ValueError("it is empty")
    if b"\0" in content[:4096]:
        if len(content) % 12:
            raise ValueError("it is no text, and its size is not a multiple of three 32-bit floats")
        return [{"positions": numpy.frombuffer(content, "<f4").reshape(-1, 3)}], None
    lines = content.decode("utf-8").splitlines()
    if re.fullmatch(r"\s*\d+\s*", lines[0]):
        return _read_molecule(lines), None
    return [_headless(_load_table(path, None, 0, None))], None


def read_json(path: Path) -> Frames:
    """A list of positions, or an object of arrays with "positions"."""
    data = json.loads(path.read_text(encoding="utf-8"))
    if isinstance(data, list):
        positions = _even_array("list", data)
        return _from_arrays({"positions": positions if data else positions.reshape(0, 3)})
    if not isinstance(data, dict):
        raise ValueError("it is neither a list of positions nor an object of arrays")
    return _from_arrays(
        {name: _even_array(f'array "{name}"', values) for name, values in data.items()}
    )


def _even_array(what: str, values: Any) -> Any:
    try:
        return numpy.array(values)
    except ValueError:
        raise ValueError(f"its {what} has rows of different lengths") from None


def read_numpy(path: Path) -> Frames:
    """An array (n, 3) or (frames, n, 3), by itself or with others, "fps" or "times".

    With "counts", the particles of each frame, the rows of the frames follow each other.
    """
    with path.open("rb") as file:
        found = numpy.load(file, allow_pickle=False)
        if isinstance(found, numpy.ndarray):
            return _from_arrays({"positions": found})
        return _from_arrays({name: found[name] for name in found.files})


def _first_lines(path: Path) -> tuple[list[str], str, str]:
    """The comments, and the two lines after them."""
    comments: list[str] = []
    with path.open(newline="", encoding="utf-8-sig") as file:
        line = file.readline()
        while line.lstrip().startswith("#"):
            comments.append(line)
            line = file.readline()
        return comments, line.strip(), file.readline().strip()


def _names_in(comments: list[str], delimiter: str | None, count: int) -> list[str]:
    """Those in the last comment, as of numpy.savetxt, if it has one for each column."""
    names = _split(comments[-1].strip().lstrip("# "), delimiter) if comments else []
    return names if len(names) == count and not any(map(_is_number, names)) else []


def _split(line: str, delimiter: str | None) -> list[str]:
    if delimiter is None:
        return line.split()
    return [cell.strip() for cell in next(csv.reader([line], delimiter=delimiter))]


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True


def _load_table(path: Path, delimiter: str | None, skip: int, columns: Any) -> Any:
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message=".*no data")
        try:
            table = numpy.loadtxt(
                path,
                delimiter=delimiter,
                skiprows=skip,
                usecols=columns,
                ndmin=2,
                encoding="utf-8-sig",
            )
        except ValueError as error:
            raise ValueError(_find_fault(path, delimiter, skip, columns) or str(error)) from error
    return table.reshape(0, len(columns)) if table.size == 0 and columns else table


def _find_fault(path: Path, delimiter: str | None, skip: int, columns: Any) -> str:
    """What is wrong with the first row that is no row of the table; empty if nothing is found."""
    width = 0
    with path.open(newline="", encoding="utf-8-sig") as file:
        for number, line in enumerate(file, start=1):
            text = line.split("#")[0].strip()
            if number <= skip or not text:
                continue
            cells = _split(text, delimiter)
            width = width or (max(columns) + 1 if columns else len(cells))
            if len(cells) < width or (not columns and len(cells) > width):
                return f"line {number} has {len(cells)} column(s), others have {width}"
            chosen = [cells[i] for i in columns] if columns else cells
            wrong = next((cell for cell in chosen if not _is_number(cell)), None)
            if wrong is not None:
                return f'line {number} has "{wrong}" in place of a number'
    return ""


def _headless(table: Any) -> Frame:
    if table.shape[1] < 3:
        raise ValueError(f"it has {table.shape[1]} column(s) of numbers, not x, y and z")
    more = {f"column {i}": table[:, i] for i in range(3, table.shape[1])}
    return {"positions": table[:, :3], **more}


def _group(columns: Mapping[str, Any]) -> Frame:
    """Columns a:0 a:1 a:2, a[0] ..., a_x ..., ax ay az as vectors a; x y z as positions."""
    vectors: dict[str, dict[int, Any]] = {}
    for name, values in columns.items():
        plain = re.sub(r"\[([012xyzXYZ])\]$", r":\1", name.strip().strip('"'))
        plain = re.sub(r"\s*[\[(][^])]*[\])]\s*$", "", plain)
        parts = re.fullmatch(r"(.*?)[:_. ]?([xyzXYZ]|(?<=[:_])[012])", plain)
        base, axis = (parts[1], _AXES[parts[2].lower()]) if parts else (plain, -1)
        vectors.setdefault(base, {})[axis] = values
    frame: Frame = {}
    for base, parts_of in vectors.items():
        is_vector = sorted(parts_of) == [0, 1, 2]
        name = "positions" if is_vector and base.lower() in ("", *_POSITIONS, "p") else base
        if is_vector:
            frame[name] = numpy.stack([parts_of[axis] for axis in range(3)], axis=1)
            continue
        for axis, values in parts_of.items():
            frame[base if axis < 0 else f"{base}{'xyz'[axis]}"] = values
    if "positions" not in frame:
        raise ValueError(f"it has no columns x, y and z of numbers; it has {', '.join(columns)}")
    return frame


def _read_molecule(lines: list[str]) -> list[Frame]:
    frames, place = [], 0
    while place < len(lines) and lines[place].strip():
        count = int(lines[place])
        rows = [line.split() for line in lines[place + 2 : place + 2 + count]]
        if len(rows) < count or any(len(row) < 4 for row in rows):
            raise ValueError(f"it has fewer atoms than the {count} that line {place + 1} says")
        positions = numpy.array([row[1:4] for row in rows], dtype=float).reshape(-1, 3)
        numbers, reaches = _elements(rows)
        frames.append({"positions": positions, "atomic_number": numbers, "reach": reaches})
        place += 2 + count
    return frames


def _elements(rows: list[list[str]]) -> tuple[Any, Any]:
    """Atomic numbers, and the reaches with which a lone atom has its van der Waals radius."""
    from vtkmodules.vtkDomainsChemistry import vtkPeriodicTable

    from .presets import REACH_OF_ATOM

    table = vtkPeriodicTable()
    found = {row[0]: (0, 0.0) for row in rows}
    for symbol in found:
        name = symbol.strip("0123456789")
        number = int(symbol) if symbol.isdigit() else table.GetAtomicNumber(name)
        found[symbol] = number, REACH_OF_ATOM * table.GetVDWRadius(number)
    numbers, reaches = zip(*(found[row[0]] for row in rows)) if rows else ((), ())
    return numpy.array(numbers, dtype="u1"), numpy.array(reaches, dtype="f4")


def _from_arrays(arrays: Mapping[str, Any]) -> Frames:
    names = {name.lower(): name for name in arrays}
    found = next((names[name] for name in _POSITIONS if name in names), None)
    if found is None and all(name in names for name in "xyz"):
        arrays = {**arrays, "positions": numpy.stack([arrays[names[n]] for n in "xyz"], axis=-1)}
        found = "positions"
    if found is None and len(arrays) == 1:
        found = next(iter(arrays))
    if found is None or (found.lower() == "x" and "y" in names and "z" not in names):
        raise ValueError(f"it has no array of positions; it has {', '.join(arrays) or 'nothing'}")
    if found.lower() == "x" and "y" in names:
        arrays = {**arrays, "positions": numpy.stack([arrays[names[n]] for n in "xyz"], axis=-1)}
        found = "positions"
    positions = arrays[found]
    if positions.dtype.kind not in "iuf":
        raise ValueError(f'its array "{found}" holds values that are not numbers')
    if positions.ndim not in (2, 3) or positions.shape[-1] != 3:
        raise ValueError(
            f'its array "{found}" has the shape {positions.shape}, where positions are n rows (or '
            "frames of n rows) of 3 numbers"
        )
    counts = arrays.get("counts")
    if counts is not None and positions.ndim == 2:
        if int(counts.sum()) == len(positions):
            return _cut(arrays, found, counts)
        if counts.shape != positions.shape[:1]:  # else it is one of the particles'
            raise ValueError(
                f'its array "counts" adds up to {int(counts.sum())}, where "{found}" has '
                f"{len(positions)} rows"
            )
    moving = positions if positions.ndim == 3 else positions[None]
    frames = [{"positions": frame} for frame in moving]
    for name, values in arrays.items():
        if name != found:
            _share(frames, name, values, positions)
    return frames, _times(arrays, len(frames)) if positions.ndim == 3 else None


def _cut(arrays: Mapping[str, Any], found: str, counts: Any) -> Frames:
    """The frames of arrays whose rows follow each other."""
    ends = numpy.cumsum(counts)
    rows = {
        "positions" if name == found else name: values
        for name, values in arrays.items()
        if values.shape[:1] == (ends[-1],) and values.dtype.kind in "biuf" and values.ndim < 3
    }
    frames = [
        {name: values[end - count : end] for name, values in rows.items()}
        for count, end in zip(counts, ends)
    ]
    return frames, _times(arrays, len(frames))


def _share(frames: list[Frame], name: str, values: Any, positions: Any) -> None:
    """Gives an array to the frames, if its shape is that of the particles'."""
    if values.dtype.kind not in "biuf":
        return
    if values.shape[: positions.ndim - 1] == positions.shape[:-1]:
        for frame, own in zip(frames, values if positions.ndim == 3 else values[None]):
            frame[name] = own
    elif positions.ndim == 3 and values.shape[:1] == positions.shape[1:2]:
        for frame in frames:
            frame[name] = values


def _times(arrays: Mapping[str, Any], count: int) -> list[float] | None:
    for name in ("times", "time"):
        if name in arrays and arrays[name].shape == (count,):
            return [float(time) for time in arrays[name]]
    if "times" in arrays and arrays["times"].ndim == 1:
        raise ValueError(f'its array "times" has {len(arrays["times"])} for {count} frames')
    if "fps" in arrays and arrays["fps"].size == 1:
        rate = float(arrays["fps"].ravel()[0])
        if not rate > 0:
            raise ValueError(f'its "fps" is {rate:g}, where it is a number above 0')
        return [step / rate for step in range(count)]
    return None
