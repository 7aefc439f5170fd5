"""Names of files: patterns, the natural order, indices of series, numbered outputs.

>>> from active_implicit_surfaces import file_names
>>> sorted(["f10.vtp", "f9.vtp"], key=file_names.natural_key)
['f9.vtp', 'f10.vtp']
>>> str(file_names.numbered("skin_####.ply", 7))
'skin_0007.ply'
>>> file_names.numbers_of(["f10.vtp", "f20.vtp"]), file_names.numbers_of(["a.vtp", "b.vtp"])
([10, 20], [0, 1])
"""

from __future__ import annotations

import glob
import json
import os
import re
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

# ####, %04d, $F4 and {}: where a pattern has the number of a frame.
_NUMBER = re.compile(r"#+|%0?\d*d|\$F\d*|\{\}")
INDEX_SUFFIXES = (".pvd", ".series")


def natural_key(name: str | Path) -> list[Any]:
    """For sorting: runs of digits count as numbers."""
    parts = re.split(r"(\d+)", str(name))
    return [int(part) if i % 2 else part for i, part in enumerate(parts)]


def suffix_of(name: str | Path) -> str:
    """The extension in lower case: of skin.VTP it is .vtp, of skin.vtp.series .series."""
    return Path(name).suffix.lower()


def expand(names: str | Path | Sequence[str | Path]) -> tuple[list[Path], list[float] | None]:
    """The files that names, patterns and indices stand for, and the times that an index tells.

    Raises
    ------
    OSError
        A file is missing, a pattern fits none, or an index cannot be read.
    """
    given = [names] if isinstance(names, (str, Path)) else list(names)
    if len(given) == 1 and suffix_of(given[0]) in INDEX_SUFFIXES:
        return read_index(Path(given[0]))
    files: list[Path] = []
    for name in given:
        files += _expand_one(str(name))
    if len({natural_key(file)[0] for file in files}) == 1:  # else the user's own order
        files.sort(key=natural_key)
    if not files:
        raise OSError("There are no files.")
    return files, None


def _expand_one(name: str) -> list[Path]:
    if os.path.exists(name):
        return [Path(name)]
    is_numbered = _NUMBER.search(name) is not None
    pattern = _NUMBER.sub("*", name) if is_numbered else name
    found = sorted(glob.glob(pattern), key=natural_key)
    if is_numbered:
        numbers = ".*".join(re.escape(part) for part in _NUMBER.split(name)).replace(".*", r"\d+")
        found = [file for file in found if re.fullmatch(numbers, file)]
    if not found:
        what = "No file fits the pattern" if glob.has_magic(pattern) else "There is no file"
        raise OSError(f"{what} {name}.")
    return [Path(file) for file in found]


def read_index(index: Path) -> tuple[list[Path], list[float]]:
    """The files and times of a .pvd or a .series."""
    try:
        text = index.read_text(encoding="utf-8")
        entries = _read_pvd(text) if suffix_of(index) == ".pvd" else _read_series(text)
    except FileNotFoundError:
        raise OSError(f"There is no file {index}.") from None
    except (ValueError, KeyError, TypeError, ElementTree.ParseError) as error:
        raise OSError(f"{index} is no index of a series of files: {error}.") from error
    if not entries:
        raise OSError(f"{index} lists no files.")
    entries.sort(key=lambda entry: entry[1])
    return [index.parent / name for name, _ in entries], [time for _, time in entries]


def _read_pvd(text: str) -> list[tuple[str, float]]:
    sets = ElementTree.fromstring(text).iter("DataSet")
    return [(one.attrib["file"], float(one.attrib["timestep"])) for one in sets]


def _read_series(text: str) -> list[tuple[str, float]]:
    return [(str(one["name"]), float(one["time"])) for one in json.loads(text)["files"]]


def write_index(index: Path, files: Sequence[Path], times: Sequence[float]) -> None:
    """Writes a .pvd or a .series of files in the index' own folder, as a whole or not at all."""
    names = [os.path.relpath(file, index.parent) for file in files]
    with replacing(index) as temporary:
        text = _pvd(names, times) if suffix_of(index) == ".pvd" else _series(names, times)
        temporary.write_text(text, encoding="utf-8")


def _pvd(names: Sequence[str], times: Sequence[float]) -> str:
    root = ElementTree.Element("VTKFile", type="Collection", version="0.1")
    collection = ElementTree.SubElement(root, "Collection")
    for name, time in zip(names, times):
        ElementTree.SubElement(collection, "DataSet", timestep=repr(time), part="0", file=name)
    ElementTree.indent(root)
    return '<?xml version="1.0"?>\n' + ElementTree.tostring(root, encoding="unicode") + "\n"


def _series(names: Sequence[str], times: Sequence[float]) -> str:
    files = [{"name": name, "time": time} for name, time in zip(names, times)]
    return json.dumps({"file-series-version": "1.0", "files": files}, indent=1) + "\n"


def has_number(name: str | Path) -> bool:
    """Whether a name says where the number of a frame stands."""
    return _NUMBER.search(Path(name).name) is not None


def numbered(name: str | Path, number: int) -> Path:
    """The name of a frame: its number in place of the #### (with so many digits at least)."""
    path = Path(name)
    mark = _NUMBER.search(path.name)
    if mark is None:
        return path.with_name(f"{path.stem}_{number:04}{path.suffix}")
    text = mark[0]
    digits = len(text) if text[0] == "#" else int(re.sub(r"\D", "", text) or 1)
    return path.with_name(f"{path.name[: mark.start()]}{number:0{digits}}{path.name[mark.end() :]}")


def numbers_of(files: Sequence[str | Path]) -> list[int]:
    """The numbers of the frames: those by which the names of files differ, else 0, 1, 2 ..."""
    parts = [re.split(r"(\d+)", str(file)) for file in files]
    places = range(min(map(len, parts), default=0))
    differing = [place for place in places if len({part[place] for part in parts}) > 1]
    if len(differing) == 1 and len(set(map(len, parts))) == 1 and differing[0] % 2 == 1:
        numbers = [int(part[differing[0]]) for part in parts]
        if all(before < after for before, after in zip(numbers, numbers[1:])):
            return numbers
    return list(range(len(files)))


def check_distinct(inputs: Iterable[Path], outputs: Iterable[Path]) -> None:
    """Raises OSError if a file would be written over one that is read."""
    read = {file.resolve() for file in inputs}
    for name in outputs:
        if name.resolve() in read:
            raise OSError(f"{name} is one of the files that are read; choose another --output.")


def without_number(name: str | Path) -> Path:
    """The name of the series: skin_####.vtp is skin.vtp."""
    path = Path(name)
    stem = _NUMBER.sub("", path.stem).strip("._- ")
    return path.with_name((stem or "skin") + path.suffix)


def make_folder_of(path: Path) -> None:
    """Makes the folder of a file, where it is not there.

    Raises
    ------
    OSError
        It cannot be made.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OSError(f"The folder {path.parent} cannot be made: {error.strerror}.") from error


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """A name to write under; then the file gets its own, as a whole or not at all.

    Raises
    ------
    OSError
        The file cannot be written there.
    """
    temporary = path.with_name(f".{os.getpid()}.{path.name}")
    try:
        yield temporary
        os.replace(temporary, path)
    except OSError as error:
        if error.strerror is None:
            raise
        raise OSError(f"{path} cannot be written: {error.strerror}.") from error
    finally:
        temporary.unlink(missing_ok=True)
