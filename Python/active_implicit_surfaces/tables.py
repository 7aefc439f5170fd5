"""Reads tables of numbers from text. Separator, quotes, decimal mark and header are detected; a
column of times or frame numbers splits the rows into frames.
"""

from __future__ import annotations

import contextlib
import csv
import math
import re
import warnings
from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy

from .messages import few, warn

Frame = dict[str, Any]
# Frames (or functions that read a frame), and the times of the frames, None if the file has none.
Frames = tuple[Sequence[Frame | Callable[[], Frame]], "list[float] | None"]
FIELD, SYMBOLS = "\0field", "\0symbols"  # keys of a frame that no column has as its name

POSITIONS = (
    *("positions", "position", "points", "point", "vertices", "coordinates", "coordinate"),
    *("coords", "coord", "pos"),
)
_OTHERS = ("location", "locations", "centroid", "center", "centre", "r")  # of columns only
_LENGTHS = ("m", "mm", "cm", "km", "um", "nm", "in", "ft")
# Names of vectors that may be the positions, the most certain first.
_RANKS = {name: rank for rank, name in enumerate(("", *POSITIONS, *_OTHERS, *_LENGTHS, "p"))}
_AXES = dict(zip("xyzijk012", 3 * (0, 1, 2)))
_UNIT = re.compile(r"\s*[\[(](?![ijkxyz012][\])])[^])]*[\])]\s*$", re.IGNORECASE)
_AXIS_LAST = re.compile(
    r"(.*?)(?:\[([012ijkxyz])\]|[-:_. ]?([xyz])|[:_]([012]))", re.IGNORECASE | re.DOTALL
)
_AXIS_FIRST = re.compile(r"([xyz])[-:_. /]?(.+)", re.IGNORECASE)
_TIMES, _COUNTS = ("time", "times", "timevalue", "t"), ("frame", "timestep", "time_step", "step")
_SEPARATORS = ("\t", ";", "|", ",", None)  # None: whitespace
# "Na" is absent, because it is sodium.
_MISSING = frozenset(("", "-", *"na NA n/a N/A null Null NULL none None NONE".split()))
_COMMENT = re.compile(r"^\s*(?:#|%|//|!)+\s*")
_DECIMAL_COMMA = re.compile(r"([-+]?\d*),(\d+(?:[eE][-+]?\d+)?)")
_FORTRAN = re.compile(r"(?<=[\d.])[dD](?=[-+]?\d+$)")  # 1.5D-3
_ABOUT_COMMAS = "; name each column, or, if commas are decimal marks, separate columns by ;"
_SAMPLED = 40  # lines searched for the header and for the types of columns


class _Form(NamedTuple):
    """Format of a table: `width` columns; `columns` are the indices of the columns of numbers."""

    separator: str | None
    names: list[str]
    start: int
    has_commas: bool = False
    columns: Sequence[int] = ()
    width: int = 0


def read_table(text: str) -> Frames:
    """Reads the positions from columns named x, y, z, and the other columns as arrays.

    Names such as Points:0, pos_x and P[x] also mark positions. Without names, the positions are the
    first three columns of numbers; a column of row numbers before four or more is left out.
    """
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    form = _examine(lines, _find_header(lines) or _find_numbers(lines))
    names = [form.names[i] for i in form.columns] if form.names else []
    columns = group_columns(names)
    texts = {_plain(name): i for i, name in enumerate(form.names) if i not in form.columns}
    texts = {name: i for name, i in texts.items() if name and name not in columns}
    if form.names and "positions" not in columns:
        said = f"; text is in {few(texts)}" if texts else ""
        raise ValueError(_no_positions(names) + said)
    table = _load(lines, form)
    if not form.names:
        return [_headless(table)], None
    frame = {name: table[:, own if len(own) > 1 else own[0]] for name, own in columns.items()}
    return _split_by_time({**frame, **_load_texts(lines, form, texts, len(table))})


def group_columns(names: Sequence[str]) -> dict[str, list[int]]:
    """Groups named columns into arrays; returns the name of each array with its columns' indices.

    a:0 a:1 a:2, a[0] ..., a_x ..., ax ay az, x-a y-a z-a form a vector a. The array "positions" is
    x y z, else a vector named pos, points or the like. Columns without a name are left out.
    """
    plain = [*map(_plain, names)]
    vectors = _vectors_in(plain, _AXIS_LAST, (2, 3, 4), 1)
    rest = ["" if any(i in own for own in vectors.values()) else one for i, one in enumerate(plain)]
    vectors |= _vectors_in(rest, _AXIS_FIRST, (1,), 2)
    ranked = [base for base in vectors if base.lower() in _RANKS]
    positions = min(ranked, key=lambda base: _RANKS[base.lower()], default=None)
    found: dict[str, list[int]] = {}
    for i, name in enumerate(plain):
        base = next((base for base, own in vectors.items() if i in own), None)
        if base is not None:
            found["positions" if base == positions else base] = vectors[base]
        elif name:
            found.setdefault(name, [i])
    return found


def _plain(name: str) -> str:
    """Returns the name of a column without quotes and unit."""
    return _UNIT.sub("", name.strip("\"' "))


def _vectors_in(
    names: Sequence[str], form: re.Pattern[str], axes: Sequence[int], base: int
) -> dict[str, list[int]]:
    """Returns the columns of 3D vectors; `axes`, `base`: groups of `form` for axis and name."""
    columns: dict[str, dict[int, int]] = {}
    for i, name in enumerate(names):
        if parts := form.fullmatch(name):
            axis = _AXES[next(filter(None, map(parts.group, axes))).lower()]
            columns.setdefault(parts[base], {}).setdefault(axis, i)
    return {name: [own[0], own[1], own[2]] for name, own in columns.items() if len(own) == 3}


def _no_positions(names: Sequence[str]) -> str:
    named = few(filter(None, names)) or "no named column of numbers"
    return f"it has no columns x, y and z of numbers (name, correct or add them); it has {named}"


def _split(line: str, separator: str | None) -> list[str]:
    line = " ".join(line.split()) if separator is None else line
    quote = "'" if "'" in line and '"' not in line else '"'
    rows = csv.reader([line], delimiter=separator or " ", quotechar=quote, skipinitialspace=True)
    return [cell.strip() for cell in next(rows, [])]


def number(cell: str, has_commas: bool = True) -> float | None:
    """Returns the number in a cell; NaN if the cell is empty or "NA" or the like; None for text."""
    if cell in _MISSING:
        return math.nan
    try:
        return float(_FORTRAN.sub("e", _DECIMAL_COMMA.sub(r"\1.\2", cell) if has_commas else cell))
    except ValueError:
        return None


def _is_number(cell: str) -> bool:
    return cell not in _MISSING and number(cell) is not None


def _rows(lines: list[str], start: int) -> list[int]:
    """Returns the indices of the lines with data among the 40 lines from `start`."""
    rows = range(start, min(len(lines), start + _SAMPLED))
    return [i for i in rows if lines[i].strip() and not _COMMENT.match(lines[i])]


def _find_header(lines: list[str]) -> _Form | None:
    """Returns the format by the header, which names positions, or None if there is no header.

    The header may be a comment. Raises ValueError if rows do not fit the header.
    """
    misfit = ""
    for place, line in enumerate(lines[:_SAMPLED]):
        text = _COMMENT.sub("", line)
        for separator in _SEPARATORS:
            names = _split(text, separator)
            if len(names) < 3 or "positions" not in group_columns(names):
                continue
            rows = _rows(lines, place + 1)
            cells = _split(lines[rows[0]], separator) if rows else names
            is_text = any(number(cell) is None for cell in cells)
            if rows and is_text and not any(map(_is_number, cells)):
                rows = rows[1:]  # the first row has units
            start = rows[0] if rows else len(lines)
            if not names[-1] and len(cells) == len(names) - 1:
                names = names[:-1]
            if len(cells) == len(names) or (len(cells) == len(names) + 1 and not cells[-1]):
                return _Form(separator, names, start)
            if len(cells) == len(names) + 1 and _are_row_names(lines, rows, separator):
                return _Form(separator, ["", *names], start)
            misfit = misfit if text != line else _about_misfit(rows[0], cells, place, names)
    if misfit:
        raise ValueError(misfit)
    return None


def _are_row_names(lines: list[str], rows: list[int], separator: str | None) -> bool:
    """Returns True if rows start with a row name, for which R's headers have no column."""
    heads = [number(_split(lines[i], separator)[0]) for i in rows]
    steps = {after - before for before, after in zip(heads, heads[1:]) if before and after}
    return steps <= {1.0} and len({_split(lines[i], separator)[0] for i in rows}) == len(rows)


def _about_misfit(row: int, cells: list[str], place: int, names: list[str]) -> str:
    said = (
        f"line {row + 1} has {len(cells)} column(s), but the header, line {place + 1}, has "
        f"{len(names)}"
    )
    are_commas = len(cells) > len(names)
    return said + (_ABOUT_COMMAS if are_commas else "; fix it")


def _find_numbers(lines: list[str]) -> _Form:
    """Finds the first line of at least three numbers; the line of text before may be a header."""
    rows = _rows(lines, 0)
    for place, row in enumerate(rows):
        for separator in _SEPARATORS:
            cells = _split(lines[row], separator)
            if sum(map(_is_number, cells)) < 3:
                continue
            names = _split(lines[rows[place - 1]], separator) if place else []
            is_header = len(names) == len(cells) and not any(map(_is_number, names))
            return _Form(separator, names if is_header else [], row)
    first = _split(lines[rows[0]], "," if "," in lines[rows[0]] else None) if rows else []
    if first and all(map(_is_number, first)):
        raise ValueError(
            f"it has {len(first)} column(s) of numbers; write at least three, x, y and z"
        )
    raise ValueError(_no_positions(first) if rows else "it is empty")


def _examine(lines: list[str], form: _Form) -> _Form:
    """Completes the format: decimal mark, columns of numbers, and width."""
    rows = [_split(lines[i], form.separator) for i in _rows(lines, form.start)]
    cells = [cell for row in rows for cell in row]
    has_commas = any(map(_DECIMAL_COMMA.fullmatch, cells)) and not any(
        "." in cell and number(cell, False) is not None for cell in cells
    )
    columns = []
    width = len(form.names or (rows[0] if rows else ()))
    for i in range(width):
        held = [row[i] for row in rows if len(row) > i and row[i] not in _MISSING]
        if not held or number(held[0], has_commas) is not None:
            columns.append(i)
    return form._replace(has_commas=has_commas, columns=columns, width=width)


def _load(lines: list[str], form: _Form) -> Any:
    """Reads the columns of numbers, one row for each line."""
    rows = lines[form.start :]
    if not _rows(rows, 0):
        return numpy.zeros((0, len(form.columns)))
    is_whole = not form.names and form.columns == list(range(form.width))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            if form.has_commas and form.separator == ",":
                raise ValueError  # decimal commas within quotes
            if form.has_commas:
                rows = [row.replace(",", ".") for row in rows]
            return _parse(rows, form, None if is_whole else form.columns, float)
        except (ValueError, UserWarning):
            return _load_by_rows(lines, form, is_whole)


def _parse(rows: list[str], form: _Form, columns: Sequence[int] | None, kind: type) -> Any:
    return numpy.loadtxt(
        rows, kind, delimiter=form.separator, usecols=columns, ndmin=2, quotechar='"'
    )


def _load_by_rows(lines: list[str], form: _Form, is_whole: bool) -> Any:
    """Slower fallback of `_load`: accepts empty cells, and names the line of the first error."""
    table = []
    for place, cells in _cells_of(lines, form):
        if len(cells) <= max(form.columns) or (is_whole and len(cells) > form.width):
            raise ValueError(
                f"line {place} has {len(cells)} column(s), not {form.width} as other lines; fix it"
            )
        values = [number(cells[i], form.has_commas) for i in form.columns]
        if None in values:
            wrong = cells[form.columns[values.index(None)]]
            raise ValueError(f'line {place} has "{wrong}" in place of a number; correct it')
        table.append(values)
    return numpy.array(table, dtype=float)


def _cells_of(lines: list[str], form: _Form) -> Iterator[tuple[int, list[str]]]:
    """Yields the line number and the cells of each row."""
    for place, line in enumerate(lines[form.start :], start=form.start + 1):
        text = line.split("#")[0] if form.separator is None else line
        if text.strip() and not _COMMENT.match(text):
            yield place, _split(text, form.separator)


def _load_texts(lines: list[str], form: _Form, columns: dict[str, int], count: int) -> Frame:
    """Reads `count` rows of the columns of text; missing cells become empty texts."""
    table, numbers, rows = (
        numpy.empty((0, len(columns)), str),
        [*columns.values()],
        lines[form.start :],
    )
    if columns and count and not any("'" in row or "#" in row for row in rows):
        with contextlib.suppress(ValueError):
            table = numpy.char.strip(_parse(rows, form, numbers, str))
    if columns and len(table) != count:
        cells = [[*own, *len(form.names) * [""]] for _, own in _cells_of(lines, form)]
        table = numpy.array([[row[i] for i in numbers] for row in cells], dtype=str)
    return {name: table[:, i] for i, name in enumerate(columns)}


def _headless(table: Any) -> Frame:
    if table.shape[1] < 3:
        raise ValueError(
            f"it has {table.shape[1]} column(s) of numbers; write at least three, x, y and z"
        )
    first = 0
    if table.shape[1] > 3 and len(table) > 2 and _counts_rows(table[:, 0]):
        first = 1
        warn(
            "its first column numbers the rows, so the next three are used as x, y and z; name the "
            "columns if this is wrong."
        )
    more = {f"column {i}": table[:, i] for i in range(first + 3, table.shape[1])}
    return {"positions": table[:, first : first + 3], **more}


def _counts_rows(column: Any) -> bool:
    return column[0] in (0, 1) and bool((numpy.diff(column) == 1).all())


def _split_by_time(frame: Frame) -> Frames:
    """Splits the rows into frames by the column of times or of frame numbers, if any."""
    numbers = [name for name, values in frame.items() if values.dtype.kind != "U"]
    lower = {name if name in ("t", "T") else name.lower(): name for name in numbers}
    name = next((name for name in (*_TIMES, *_COUNTS) if name in lower), None)
    if name is None or len(frame["positions"]) == 0:
        return [frame], None
    column = frame[lower[name]]
    known = numpy.isfinite(column)
    if not known.any():
        return [frame], None
    if not known.all():
        warn(f"{(~known).sum()} row(s) without a finite {lower[name]} are left out.")
        frame, column = {key: values[known] for key, values in frame.items()}, column[known]
    times, steps = numpy.unique(column, return_inverse=True)
    order = numpy.argsort(steps, kind="stable")
    cuts = numpy.cumsum(numpy.bincount(steps, minlength=1))[:-1]
    pieces = {key: numpy.split(values[order], cuts) for key, values in frame.items()}
    frames = [{key: parts[i] for key, parts in pieces.items()} for i in range(len(cuts) + 1)]
    return frames, None if name in _COUNTS else times.tolist()
