"""Reads atoms from .xyz, .gro and .pdb files; adds elements and the elements' radii."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from itertools import takewhile
from pathlib import Path
from typing import Any

import numpy

from .messages import few, warn
from .tables import FIELD, SYMBOLS, Frame, Frames, number

_DEFAULT = "species:S:1:pos:R:3"
_PAIR = re.compile(r"""([A-Za-z_][\w-]*)\s*=\s*("[^"]*"|'[^']*'|\{[^}]*\}|\[[^]]*\]|[^\s,]+)""")
_SYMBOLS = ("species", "element", "elements", "symbol", "symbols", "name", "atom_name")
_NUMBERS = ("z", "numbers", "atomic_number", "atomic_numbers")
# In atoms' names in capitals, the letter after C, H, N, O, P or S is a position in the molecule, as
# in CA and HG, except in the names of the elements _UNPLACED.
_PLACED, _UNPLACED = "CHNOPS", ("CL", "CU", "NA", "SE")
_ALONE = "CHNOPSBDFIK"  # elements of one letter that may begin a longer atom name
_IONS = {"SOD": "Na", "CLA": "Cl", "POT": "K", "CAL": "Ca", "CES": "Cs", "LIT": "Li"}  # CHARMM's
_LARGEST_RADIUS = 10.0  # larger entries of the table mean an unknown radius
_ANGSTROM = 0.1  # in nanometres, the unit of a .gro
_CELL = ((6, 15), (15, 24), (24, 33), (33, 40), (40, 47), (47, 54))  # columns of CRYST1


def read_molecule(lines: list[str]) -> Frames:
    """Reads the frames of an .xyz file whose first line is the number of atoms.

    Returns the frames and their times. The times are None unless each comment line has a `time=` or
    `t=`, and the times increase.
    """
    frames: list[Frame] = []
    times, place = [], 0
    while place < len(lines):
        if not lines[place].strip():
            place += 1
            continue
        if not re.fullmatch(r"\s*\d+\s*", lines[place]):
            raise ValueError(
                f"line {place + 1} is not the number of atoms of a frame; correct this line, or "
                "the number of atoms of the frame before"
            )
        count = int(lines[place])
        comment = lines[place + 1] if place + 1 < len(lines) else ""
        pairs = {name.lower(): value.strip("\"'{}[]") for name, value in _PAIR.findall(comment)}
        frames.append(_read_frame(lines[place + 2 : place + 2 + count], count, place, pairs))
        times.append(next((number(pairs[name]) for name in ("time", "t") if name in pairs), None))
        place += 2 + count
    add_elements(frames)
    known = [time for time in times if time is not None]
    are_times = len(known) == len(frames) and all(a < b for a, b in zip(known, known[1:]))
    return frames, known if are_times else None


def _read_frame(lines: list[str], count: int, place: int, pairs: dict[str, str]) -> Frame:
    rows = [line.split() for line in lines]
    columns = _columns_of(pairs.get("properties") or _usual_properties(rows))
    width = max(first + size for _, _, first, size in columns)
    if len(rows) < count:
        raise ValueError(
            f"it has fewer atoms than the {count} that line {place + 1} declares; write it again"
        )
    short = next((i for i, row in enumerate(rows) if len(row) < width), None)
    if short is not None:
        raise ValueError(
            f"line {place + 3 + short} has {len(rows[short])} column(s), but an atom has {width}; "
            f"correct this line, or the number of atoms in line {place + 1}, which is {count}"
        )
    frame: Frame = {}
    for name, kind, first, size in columns:
        _add_column(frame, name, kind, [row[first : first + size] for row in rows])
    frame[FIELD] = _cell_in(pairs)
    return frame


def _usual_properties(rows: list[list[str]]) -> str:
    """Returns Properties for a plain .xyz: symbol (if any), x, y, z, then columns of numbers."""
    width = min(map(len, rows), default=4)
    if width == 3 and all(number(cell) is not None for row in rows for cell in row):
        return "pos:R:3"
    are_numbers = (all(number(row[i]) is not None for row in rows) for i in range(4, width))
    extra = enumerate(takewhile(bool, are_numbers), start=4)
    return ":".join([_DEFAULT, *(f"column {i}:R:1" for i, _ in extra)])


def _columns_of(properties: str) -> list[tuple[str, str, int, int]]:
    """Returns name, kind, first column and width of each property."""
    words, found, first = properties.split(":"), [], 0
    for name, kind, size in zip(words[::3], words[1::3], words[2::3]):
        if kind not in ("S", "R", "I", "L") or not size.isdigit():
            break
        found.append((name, kind, first, int(size)))
        first += int(size)
    if len(words) != 3 * len(found) or not any(
        name.lower() in ("pos", "positions", "position") and kind in "RI" and size == 3
        for name, kind, _, size in found
    ):
        raise ValueError(
            f"its Properties={properties} are malformed, or name no positions; write them as in "
            f"{_DEFAULT}"
        )
    return found


def _add_column(frame: Frame, name: str, kind: str, cells: list[list[str]]) -> None:
    lower, size = name.lower(), len(cells[0]) if cells else 1
    if size == 1 and (lower in _NUMBERS or (kind == "S" and lower in _SYMBOLS)):
        frame.setdefault(SYMBOLS, [cell[0] for cell in cells])
    if kind == "S":
        if size == 1:
            frame[name] = numpy.array([cell[0] for cell in cells], dtype=str)
        return
    if kind == "L":
        cells = [["1" if cell.lower() in ("t", "true", "1") else "0" for cell in c] for c in cells]
    try:
        values = numpy.array(cells, dtype=float if kind == "R" else int)
    except ValueError as error:
        numbers = [[number(cell) for cell in row] for row in cells]
        if kind != "R" or any(None in row for row in numbers):
            raise ValueError(
                f"its column {name} has a value of a wrong type ({error}); correct it"
            ) from error
        values = numpy.array(numbers, dtype=float)
    if lower in ("pos", "positions", "position"):
        frame["positions"] = values.reshape(-1, 3)
    else:
        frame[name] = values[:, 0] if size == 1 and cells else values


def _finite(words: Sequence[str]) -> list[float]:
    """Returns the words that are finite numbers, as numbers."""
    found = map(number, words)
    return [each for each in found if each is not None and math.isfinite(each)]


def _cell_in(pairs: dict[str, str]) -> dict[str, Any]:
    """Returns a cell's edges, a flag for each edge (1: periodic), any origin; {} without a cell."""
    if "lattice" not in pairs:
        return {}
    words = re.split(r"[\s,]+", pairs["lattice"].strip())
    numbers = _finite(words)
    if not len(words) == len(numbers) == 9:
        raise ValueError(f'its Lattice is "{pairs["lattice"]}", not 9 numbers; correct it')
    repeats = [word[0].lower() in "t1" for word in (pairs.get("pbc") or "T T T").split()]
    cell = {
        "Lattice": numpy.array(numbers, dtype=float).reshape(3, 3),
        "pbc": numpy.array([repeats], dtype="u1"),
    }
    corner = [float(word) for word in re.split(r"[\s,]+", pairs.get("origin", "").strip()) if word]
    return {**cell, "Origin": numpy.array([corner])} if len(corner) == 3 else cell


def add_elements(frames: list[Frame], unit: float = 1.0, are_names: bool = False) -> None:
    """Adds atomic numbers, radii and element symbols if any symbol has a known radius.

    Radii and element symbols that a frame has already are kept. If `are_names` is true, symbols
    are read as names of atoms; else `_elements_of` decides. `unit` is the length of one Angstrom in
    the unit of the positions.
    """
    from vtkmodules.vtkDomainsChemistry import vtkPeriodicTable

    table = vtkPeriodicTable()
    listed = [frame.pop(SYMBOLS, None) for frame in frames]
    symbols = {symbol for own in listed for symbol in own or ()}
    found = (
        {name: _number(name, _guess(_letters_of(name), table), table) for name in symbols}
        if are_names
        else _elements_of(symbols, table)
    )
    radii = {number: table.GetVDWRadius(number) for number in {0, *found.values()}}
    radii = {n: radius if radius < _LARGEST_RADIUS else 0.0 for n, radius in radii.items()}
    unknown = sorted(symbol for symbol, number in found.items() if not radii[number])
    are_known = len(unknown) < len(found)
    has_radii = all("radius" in frame for frame in frames)
    for frame, own in zip(frames, listed):
        if own is not None and (are_known or not found):
            numbers = [found[symbol] for symbol in own]
            names = [table.GetSymbol(n) if n else "" for n in numbers]
            frame.setdefault("element", numpy.array(names, dtype=str))
            frame["atomic_number"] = numpy.array(numbers, dtype="u1")
            usual = unit * numpy.array([radii[n] for n in numbers], dtype="f4")
            frame.setdefault("radius", usual)
    if unknown:
        effect = "get the radius 0" if are_known else "get no radius"
        effect += ". Write elements in the file, or choose an array of radii."
        effect = "keep the radii of the file." if has_radii else effect
        warn(
            f"{few(unknown)}: there is no element of this symbol, or no known radius; these atoms "
            f"{effect}"
        )


def _elements_of(symbols: set[str], table: Any) -> dict[str, int]:
    """Returns the atomic number of each symbol, 0 if unknown.

    All symbols are read as names of atoms, with a warning, if any symbol is a name but no element
    (CB, OW), or if the symbols fit the backbone of a protein: CA is the only symbol, or CA, C and N
    are among the symbols.
    """
    letters = {symbol: _letters_of(symbol) for symbol in symbols}
    as_elements = {symbol: _number(symbol, own, table) for symbol, own in letters.items()}
    as_names = {
        symbol: _number(symbol, _guess(own, table), table) for symbol, own in letters.items()
    }
    is_chain = {"CA"} == symbols or {"CA", "C", "N"} <= symbols
    if not is_chain and all(as_elements[symbol] or not as_names[symbol] for symbol in symbols):
        doubtful = sorted(s for s, own in letters.items() if _may_be_a_name(own, as_elements[s]))
        if doubtful:
            said = [f"{symbol} is {table.GetSymbol(as_elements[symbol])}" for symbol in doubtful]
            warn(
                f"Symbols in capital letters are read as elements: {few(said)}. If these "
                "are names of atoms, write elements in the file."
            )
        return as_elements
    other = sorted(s for s, z in as_names.items() if z and z != table.GetAtomicNumber(s))
    meant = [f"{symbol} is {table.GetSymbol(as_names[symbol])}" for symbol in other]
    warn(
        f"The file has names of atoms, from which elements are guessed: {few(meant)}. If a "
        "guess is wrong, write elements in the file."
    )
    return as_names


def _may_be_a_name(letters: str, element: int) -> bool:
    """Returns True if an element's symbol may also be an atom's name, such as HG or CD."""
    is_pair = len(letters) == 2 and letters.isupper() and letters not in _UNPLACED
    return bool(element) and is_pair and letters[0] in _PLACED


def _letters_of(name: str) -> str:
    return re.sub(r"[^A-Za-z]", "", name)


def _number(symbol: str, element: str, table: Any) -> int:
    if symbol.isdigit():
        return int(symbol) if 0 < int(symbol) <= table.GetNumberOfElements() else 0
    return int(table.GetAtomicNumber(element)) if element else 0


def _guess(name: str, table: Any) -> str:
    """Guesses an element from the letters of an atom's name: C for CA, FE for FE; "" for none."""
    upper = name.upper()
    if upper in _IONS:
        return _IONS[upper]
    is_cased = len(name) == 2 and name[0].isupper() and name[1].islower()
    if (is_cased or upper in _UNPLACED) and table.GetAtomicNumber(name):
        return name
    if upper[:1] not in _PLACED and table.GetAtomicNumber(upper[:2]):
        return upper[:2]
    return upper[:1] if upper[:1] in _ALONE else ""


def read_gro(path: Path) -> Frames:
    """Returns the frames of a .gro [nm], and their times.

    The times are None unless each title has a `t=`, and the times increase.
    """
    lines = path.read_text(encoding="latin-1").splitlines()
    frames, times, place = list[Frame](), list[float](), 0
    while place < len(lines) and (lines[place].strip() or not frames):
        if not re.fullmatch(r"\s*\d+\s*", "".join(lines[place + 1 : place + 2])):
            other = ", or the number of atoms of the frame before" if frames else ""
            raise ValueError(f"line {place + 2} is not the number of atoms; correct it{other}")
        end = place + 2 + int(lines[place + 1])
        if len(lines) <= end:
            raise ValueError(
                f"it ends before the {lines[place + 1].strip()} atoms that line {place + 2} "
                "declares, or before their box; write it again"
            )
        frames.append(_read_gro_frame(dict(enumerate(lines[place + 2 : end], start=place + 3))))
        frames[-1][FIELD] = _edges_of(lines[end])
        times += _finite(re.findall(r"\bt\s*=\s*([-+.\deE]+)", lines[place])[-1:])
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
    """Returns the edges of a box from its line in a .gro: sides, then off-diagonal entries.

    Blanks between the numbers may be missing if all numbers have five decimals.
    """
    are_apart = all(cell.count(".") < 2 for cell in line.split())
    words = line.split() if are_apart else re.findall(r"-?\d+\.\d{5}", line)
    cells = _finite(words)
    if len(words) != len(cells) or len(cells) not in (3, 9):
        raise ValueError(f'its box is "{line.strip()}", not 3 or 9 numbers; correct it')
    x, y, z, *rest = cells
    xy, xz, yx, yz, zx, zy = rest or 6 * [0.0]
    return {"Lattice": numpy.array([[x, xy, xz], [yx, y, yz], [zx, zy, z]])}


def read_pdb(path: Path) -> Frames:
    """Reads the models of a .pdb as frames; uses the first of alternate locations of an atom.

    Arrays: "residue" (number of the residue in its chain), "chain" (letter of the chain), "resname"
    (name of the residue), "name" (name of the atom), "hetero" (1 for HETATM, 0 for ATOM).
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
        raise ValueError("it has no ATOM or HETATM line; choose a file with atoms")
    frames = [{**_read_pdb_frame(lines), FIELD: field} for lines in models if lines]
    add_elements(frames, are_names=True)
    return frames, None


def _read_pdb_frame(lines: dict[int, str]) -> Frame:
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
    """Returns a cell's edges from CRYST1 (lengths, angles); {} if all lengths are 1: no cell."""
    (a, b, c), (cos_bc, cos_ac, cos_ab) = cell[:3], numpy.cos(numpy.radians(cell[3:]))
    sine = max(1e-9, math.sqrt(max(0.0, 1 - cos_ab**2)))
    slant = (cos_bc - cos_ac * cos_ab) / sine
    height = math.sqrt(max(0.0, 1 - cos_ac**2 - slant**2))
    edges = [[a, 0, 0], [b * cos_ab, b * sine, 0], [c * cos_ac, c * slant, c * height]]
    return {} if a == b == c == 1 else {"Lattice": numpy.round(edges, 9)}


def _symbol_of(residue: str, name: str) -> str:
    """Returns an atom's name in capitals, such as CA.

    If the residue has the same name, the atom is an ion: returns an element symbol, such as Na.
    """
    return name.capitalize() if name.upper() == residue.upper() else name.upper()


def _numbers_in(lines: dict[int, str], columns: Sequence[tuple[int, int]]) -> Any:
    """Returns the numbers in columns of `lines`, a dict whose keys are the file's line numbers."""
    table = numpy.empty((len(lines), len(columns)))
    for row, (place, line) in enumerate(lines.items()):
        try:
            table[row] = [float(line[start:end]) for start, end in columns]
        except ValueError as error:
            raise ValueError(
                f"line {place} lacks a valid position, velocity, residue number or cell; correct it"
            ) from error
    return table
