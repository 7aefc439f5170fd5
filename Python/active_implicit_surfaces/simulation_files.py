"""Reads particles of simulations: .bgeo, dumps of LAMMPS, .hdf5 of PySPH.

The functions return frames (or functions that read a frame) and times, like `text_particles`.
"""

from __future__ import annotations

import contextlib
import functools
import gzip
import mmap
import re
import struct
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy

from .atom_files import add_elements
from .tables import FIELD, SYMBOLS, Frame, Frames, group_columns, number

_BGEO, _NEWER_BGEO = b"BgeoV", b"\x7fNSJ"
_BGEO_TYPES = {0: ">f4", 1: ">i4", 4: ">i4", 5: ">f4"}  # 4: the index of a text
# _DUMP: start of a frame. _OPENINGS: suffixes of the position columns (as in xs, xu and xsu), s for
# fractions of the box, u for unwrapped positions.
_DUMP = re.compile(
    rb"^(?:ITEM: UNITS\r?\n.*\n)?(?:ITEM: TIME\r?\n(?P<time>.*)\n)?ITEM: TIMESTEP", re.MULTILINE
)
_OPENINGS = ("", "u", "s", "su")
_ITEMS = ("NUMBER OF ATOMS", "BOX BOUNDS", "ATOMS")
_WHOLE = ("id", "type", "mol", "proc", "ix", "iy", "iz")


def read_bgeo(path: Path) -> Frames:
    """Reads points and attributes of Houdini's classic format, used by partio and SPlisHSPlasH."""
    content = path.read_bytes()
    try:
        content = gzip.decompress(content) if content[:2] == b"\x1f\x8b" else content
    except (OSError, EOFError, zlib.error) as error:
        raise ValueError(f"it is damaged ({error})") from error
    if content[:4] == _NEWER_BGEO:
        raise ValueError("it is Houdini's newer .bgeo; save it as .bhclassic, or as .vdb points")
    if content[:5] != _BGEO:
        raise ValueError("it is no .bgeo")
    try:
        _, count, _, _, _, attributes = struct.unpack_from(">6i", content, 5)
        fields: list[Any] = [("positions", ">f4", (4,))]
        start, texts = 41, dict[str, list[str]]()
        for _ in range(attributes):
            field, listed, start = _read_attribute(content, start)
            fields.append(field)
            texts[field[0]] = listed
        rows = numpy.frombuffer(content, fields, count, start)
    except (struct.error, ValueError) as error:
        raise ValueError(f"it is damaged ({error})") from error
    frame = {name: rows[name].astype(kind[1:]) for name, kind, _ in fields}
    for name, listed in texts.items():
        if frame[name].ndim == 1 and listed:  # -1: no text
            frame[name] = numpy.array([*listed, ""])[frame[name].clip(-1, len(listed))]
    return [{**frame, "positions": frame["positions"][:, :3]}], None


def _read_attribute(
    content: bytes, start: int
) -> tuple[tuple[str, str, tuple[int, ...]], list[str], int]:
    """Returns name, kind and shape of an attribute, its texts, and the offset of the next one."""

    def take(form: str) -> Any:
        nonlocal start
        values = struct.unpack_from(form, content, start)
        start += struct.calcsize(form)
        return values

    def take_text() -> str:
        return str(take(f"{take('>H')[0]}s")[0].decode("latin-1"))

    name, listed = take_text(), list[str]()
    width, kind = take(">Hi")
    if kind not in _BGEO_TYPES:
        raise ValueError(f"its attribute {name} is of the unknown kind {kind}")
    if kind == 4:
        listed = [take_text() for _ in range(take(">i")[0])]
    else:
        take(f"{4 * width}x")  # default value
    return (name, _BGEO_TYPES[kind], (width,) if width > 1 else ()), listed, start


def read_dump(path: Path) -> Frames:
    """Opens the frames of a text dump of LAMMPS; a frame is read when it is used."""
    with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content:
        found = [(head.start(), head["time"]) for head in _DUMP.finditer(content)]
        is_binary, end = b"\0" in content[:4096], len(content)
    if not found:
        raise ValueError(
            "it is binary; write it as text"
            if is_binary
            else "it is no dump of LAMMPS; choose another file"
        )
    ends = [*(start for start, _ in found[1:]), end]
    frames = [functools.partial(_read_dumped, path, *cut) for cut in zip(dict(found), ends)]
    times = [float(time) for _, time in found if time]
    return frames, times if len(times) == len(frames) else None


def _read_dumped(path: Path, start: int, end: int) -> Frame:
    with path.open("rb") as file:
        file.seek(start)
        text = file.read(end - start).decode("latin-1")
    parts = (part.partition("\n") for part in text.split("ITEM: ")[1:])
    found = [(head, body) for head, _, body in parts]
    items = {key: own for own in found for key in _ITEMS if own[0].startswith(key)}
    try:
        count = int(items["NUMBER OF ATOMS"][1])
        names, rows = items["ATOMS"][0].split()[1:], items["ATOMS"][1].splitlines()
        field, origin = _box_of(*items["BOX BOUNDS"])
    except (KeyError, ValueError) as error:
        raise ValueError(f"a frame is incomplete or damaged ({error}); write it again") from error
    if len(rows) < count:
        raise ValueError(f"a frame has only {len(rows)} of {count} atoms; write the file again")
    cells = _cells_of(rows[0], names) if count else [""] * len(names)
    used = [i for i, (name, cell) in enumerate(zip(names, cells)) if number(cell) is not None]
    table = _table_of(rows[:count], used) if count else numpy.zeros((0, 99))
    opening = next((one for one in _OPENINGS if "x" + one in names), "")
    columns = group_columns([re.sub(f"^([xyz]){opening}$", r"\1", names[i]) for i in used])
    if "positions" not in columns:
        raise ValueError(
            "its atoms have no columns x y z (or xs, xu, xsu ...) of numbers; the "
            f"columns are {', '.join(names)}; write the dump with x y z"
        )
    frame: Frame = {FIELD: field}
    for name, own in columns.items():
        values = table[:, own if len(own) > 1 else own[0]]
        frame[name] = values.astype(int) if name in _WHOLE else values
    if opening.startswith("s"):
        frame["positions"] = origin + frame["positions"] @ field["Lattice"]
    for i in set(range(len(names))) - set(used):
        frame[names[i]] = numpy.array([row.split()[i] for row in rows[:count]], dtype=str)
    if "element" in names and count:
        frame[SYMBOLS] = [row.split()[names.index("element")] for row in rows[:count]]
        add_elements([frame])
    return frame


def _cells_of(row: str, names: list[str]) -> list[str]:
    cells = row.split()
    if len(cells) < len(names):
        raise ValueError(
            f"an atom has {len(cells)} column(s), but its frame names {len(names)}; write the file "
            "again"
        )
    return cells


def _table_of(rows: list[str], columns: list[int]) -> Any:
    try:
        return numpy.loadtxt(rows, usecols=columns, ndmin=2)
    except ValueError as error:
        for row in rows:
            cells = row.split()
            if len(cells) <= max(columns) or None in (number(cells[i]) for i in columns):
                raise ValueError(f'a frame has the row "{row}" for an atom; correct it') from error
        raise


def _box_of(head: str, body: str) -> tuple[Frame, Any]:
    """Returns the arrays Lattice, Origin and pbc of the box, and the box's origin."""
    rows = numpy.array([[float(cell) for cell in line.split()] for line in body.splitlines()])
    if rows.shape not in ((3, 2), (3, 3), (3, 4)):
        raise ValueError("its BOX BOUNDS are not 3 rows of 2 to 4 numbers")
    if rows.shape == (3, 4):
        edges, origin = rows[:, :3], rows[:, 3]
    else:
        xy, xz, yz = rows[:, 2] if rows.shape == (3, 3) else numpy.zeros(3)
        low = [min(0, xy, xz, xy + xz), min(0, yz), 0]  # corners of a slanted box
        high = [max(0, xy, xz, xy + xz), max(0, yz), 0]
        origin, size = rows[:, 0] - low, rows[:, 1] - high - rows[:, 0] + low
        edges = numpy.diag(size) + [[0, 0, 0], [xy, 0, 0], [xz, yz, 0]]
    sides = [[word == "pp" for word in head.split()[-3:]]]
    return {"Lattice": edges, "Origin": origin[None], "pbc": numpy.array(sides)}, origin


def read_pysph(path: Path) -> Frames:
    """Opens particles of all kinds, with the arrays that all kinds have, as one frame.

    The array "array" of the frame names the kind of each particle. Kinds without particles are
    left out.
    """
    with _hdf5(path) as file:
        solver = file.get("solver_data")
        time = None if solver is None else solver.attrs.get("t")
    return [functools.partial(_read_kinds, path)], None if time is None else [float(time)]


@contextlib.contextmanager
def _hdf5(path: Path) -> Iterator[Any]:
    try:
        import h5py
    except ImportError as error:
        raise ValueError("it needs h5py (Debian: python3-h5py, PyPI: h5py)") from error
    try:
        with h5py.File(path) as file:
            yield file
    except (OSError, KeyError, AttributeError, TypeError) as error:
        raise ValueError(
            f"it is damaged, or no .hdf5 of PySPH ({error}); write it again"
        ) from error


def _read_kinds(path: Path) -> Frame:
    with _hdf5(path) as file:
        parts = [_read_arrays(kind["arrays"], name) for name, kind in file["particles"].items()]
    parts = [part for part in parts if len(part["array"])] or parts[:1]
    held = [name for name in parts[0] if all(name in part for part in parts)] if parts else []
    if not {*"xyz"} <= {*held}:
        raise ValueError("it has no particles, or some lack x, y or z; write x, y and z for all")
    frame = {name: numpy.concatenate([part[name] for part in parts]) for name in held}
    for name, axes in (("positions", "xyz"), ("Velocity", "uvw")):
        if {*axes} <= frame.keys():
            frame[name] = numpy.stack([frame.pop(axis) for axis in axes], axis=1)
    return frame


def _read_arrays(group: Any, kind: str) -> Frame:
    """Returns the arrays of the particles of one kind, with the name of the kind."""
    arrays = Frame(array=numpy.full(len(group["x"]), kind))
    for name, own in group.items():
        stride = int(own.attrs.get("stride", 1))
        if own.attrs.get("stored", True):
            arrays[name] = own[()].reshape(-1, stride) if stride > 1 else own[()]
    return arrays
