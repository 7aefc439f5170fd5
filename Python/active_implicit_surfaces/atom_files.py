"""Reads atoms from .gro and .pdb files, which have fixed columns, as frames of a molecule."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy

from .molecules import add_elements
from .tables import FIELD, SYMBOLS, Frame, Frames

_ANGSTROM = 0.1  # in the nanometres of a .gro
_CELL = ((6, 15), (15, 24), (24, 33), (33, 40), (40, 47), (47, 54))  # columns of CRYST1


def read_gro(path: Path) -> Frames:
    """Reads the frames of a .gro [nm]; the times are read from the titles."""
    lines = path.read_text(encoding="latin-1").splitlines()
    frames, times, place = list[Frame](), list[float](), 0
    while place < len(lines) and (lines[place].strip() or not frames):
        if not re.fullmatch(r"\s*\d+\s*", "".join(lines[place + 1 : place + 2])):
            raise ValueError(f"line {place + 2} is not the number of atoms")
        end = place + 2 + int(lines[place + 1])
        if len(lines) <= end:
            raise ValueError(
                f"it has fewer atoms than the {lines[place + 1].strip()} of line {place + 2}"
            )
        frames.append(_read_gro_frame(dict(enumerate(lines[place + 2 : end], start=place + 3))))
        frames[-1][FIELD] = _edges_of(lines[end])
        times += map(float, re.findall(r"\bt\s*=\s*([-+.\deE]+)", lines[place])[-1:])
        place = end + 1
    add_elements(frames, _ANGSTROM, are_names=True)
    increase = all(before < after for before, after in zip(times, times[1:]))
    return frames, times if len(times) == len(frames) and increase else None


def _read_gro_frame(lines: dict[int, str]) -> Frame:
    dots = [found.start() + 20 for found in re.finditer(r"\.", next(iter(lines.values()), "")[20:])]
    width = dots[1] - dots[0] if len(dots) > 2 else 8
    starts = range(20, 20 + 6 * width, width)
    ends = [len(line.rstrip()) for line in lines.values()]
    are_moving = bool(lines) and min(ends) > starts[5]  # else some lines have no velocity
    columns = [(start, start + width) for start in starts][: 6 if are_moving else 3]
    table = _numbers_in(lines, columns)
    names = [(line[5:10].strip(), line[10:15].strip()) for line in lines.values()]
    frame: Frame = {
        "positions": table[:, :3],
        "residue": _numbers_in(lines, [(0, 5)])[:, 0].astype(int),
        "resname": numpy.array([residue for residue, _ in names], dtype=str),
        "name": numpy.array([name for _, name in names], dtype=str),
        SYMBOLS: [_symbol_of(residue, name) for residue, name in names],
    }
    return {**frame, "Velocity": table[:, 3:]} if table.shape[1] > 3 else frame


def _edges_of(line: str) -> Frame:
    """Reads the box of a .gro: sides, then off-diagonal entries; long numbers have no blanks."""
    are_apart = all(cell.count(".") < 2 for cell in line.split())
    cells = [*map(float, line.split() if are_apart else re.findall(r"-?\d+\.\d{5}", line))]
    if len(cells) not in (3, 9):
        raise ValueError(f"its box has {len(cells)} numbers, not 3 or 9")
    x, y, z, *rest = cells
    xy, xz, yx, yz, zx, zy = rest or 6 * [0.0]
    return {"Lattice": numpy.array([[x, xy, xz], [yx, y, yz], [zx, zy, z]])}


def read_pdb(path: Path) -> Frames:
    """Reads the models of a .pdb as frames; of alternate locations of an atom the first one.

    "residue" is the number in the chain, "chain" the letter of the chain, "resname" and "name"
    the names of residue and atom; "hetero" is 1 for HETATM.
    """
    models, field, seen = [dict[int, str]()], Frame(), set[str]()
    for place, line in enumerate(path.read_text(encoding="latin-1").splitlines(), start=1):
        if line.startswith("MODEL ") and models[-1]:
            models.append({})
            seen.clear()
        elif line.startswith(("ATOM  ", "HETATM")):
            own = line[12:16] + line[17:27]
            if line[16:17].strip() == "" or own not in seen:
                models[-1][place] = line
                seen.add(own)
        elif line.startswith("CRYST1"):
            field = _cell_of(_numbers_in({place: line}, _CELL)[0])
    if not models[0]:
        raise ValueError("it has no ATOM")
    frames = [{**_read_model(lines), FIELD: field} for lines in models if lines]
    add_elements(frames, are_names=True)
    return frames, None


def _read_model(lines: dict[int, str]) -> Frame:
    texts = {"resname": (17, 20), "name": (12, 16), "chain": (21, 22)}
    return {
        "positions": _numbers_in(lines, [(30, 38), (38, 46), (46, 54)]),
        "residue": _numbers_in(lines, [(22, 26)])[:, 0].astype(int),
        "hetero": numpy.array([line.startswith("HETATM") for line in lines.values()], dtype="u1"),
        **{
            name: numpy.array([line[slice(*cut)].strip() for line in lines.values()], dtype=str)
            for name, cut in texts.items()
        },
        SYMBOLS: [
            line[76:78].strip().capitalize() or _symbol_of(line[17:20].strip(), line[12:16].strip())
            for line in lines.values()
        ],
    }


def _cell_of(cell: Any) -> Frame:
    """Returns the edges of CRYST1 (lengths, angles); empty if all lengths are 1, for no cell."""
    (a, b, c), (cos_bc, cos_ac, cos_ab) = cell[:3], numpy.cos(numpy.radians(cell[3:]))
    sine = max(1e-9, math.sqrt(max(0.0, 1 - cos_ab**2)))
    slant = (cos_bc - cos_ac * cos_ab) / sine
    height = math.sqrt(max(0.0, 1 - cos_ac**2 - slant**2))
    edges = [[a, 0, 0], [b * cos_ab, b * sine, 0], [c * cos_ac, c * slant, c * height]]
    return {} if a == b == c == 1 else {"Lattice": numpy.round(edges, 9)}


def _symbol_of(residue: str, name: str) -> str:
    """Returns an atom's name in capitals; for an ion (a residue of its own) the element."""
    return name.capitalize() if name.upper() == residue.upper() else name.upper()


def _numbers_in(lines: dict[int, str], columns: Sequence[tuple[int, int]]) -> Any:
    """Reads numbers from columns of `lines`, whose keys are line numbers of the file."""
    table = numpy.empty((len(lines), len(columns)))
    for row, (place, line) in enumerate(lines.items()):
        try:
            table[row] = [float(line[start:end]) for start, end in columns]
        except ValueError as error:
            raise ValueError(f"line {place} has no number where one is expected") from error
    return table
