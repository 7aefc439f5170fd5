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

import fnmatch
import glob
import json
import math
import os
import re
import xml.etree.ElementTree as ElementTree
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

# Placeholders for the number of a frame: ####, %04d, $F4, {} and {:04d}.
_NUMBER = re.compile(r"#+|%0?\d*d|\$F\d*|\{(?::0?\d*d)?\}")
INDEX_SUFFIXES = (".pvd", ".series")
_NOTES = (".txt", ".dat")  # ignored in a folder with other files
_ROUNDING = 1e-12  # tolerance of equal times, relative to the index's largest time


class Listing(NamedTuple):
    """Files (parts) of each frame; times, if from an index; a warning about the names, or ""."""

    frames: list[tuple[Path, ...]]
    times: list[float] | None = None
    note: str = ""

    @property
    def files(self) -> list[Path]:
        """Returns the first file of each frame."""
        return [parts[0] for parts in self.frames]


def natural_key(name: str | Path, numbers: re.Pattern[str] | None = None) -> list[Any]:
    """Returns a sort key that compares numbers, with decimals and exponent, by value.

    `numbers` finds the numbers. Without `numbers`, a minus after a letter or digit is a hyphen.
    """
    parts = (numbers or _numbers_in([str(name)])).split(str(name))
    return [_value(part) if i % 2 else part for i, part in enumerate(parts)]


def _value(text: str) -> float:
    return int(text) if text.lstrip("-").isdigit() else float(text)


def _numbers_in(names: list[str]) -> re.Pattern[str]:
    """Returns a pattern that finds the numbers in the names of a series.

    At the first character in which the names differ, if a name has a minus and another name a digit
    (t-1, t0), minuses are signs; else a minus after a letter or digit is a hyphen (run-1, run-2). A
    dot separates two counters if the numbers cannot be decimals (1.9, 1.10).
    """
    start = len(os.path.commonprefix(names))
    after = {name[start : start + 1] for name in names}
    sign = "-?" if "-" in after and any(map(str.isdigit, after)) else r"(?:(?<![^\W_])-)?"
    decimals = [part for name in names for part in re.findall(r"(?<=\d\.)\d+", name)]
    are_counters = len({*map(len, decimals)}) > 1 and any(
        len(part) > 1 and part.endswith("0") for part in decimals
    )
    more = "" if are_counters else r"(?:\.\d+)?(?:[eE][-+]?\d+)?"
    return re.compile(rf"({sign}\d+{more})")


def suffix_of(name: str | Path) -> str:
    """Returns the extension in lower case: .vtp of a.VTP, .series of a.vtp.series.

    .nii.gz and .bgeo.gz are one extension; LAMMPS names such as dump.100 have the extension .dump.
    """
    lower = Path(name).name.lower()
    if re.fullmatch(r"(.*\.)?dump[._]?(.*\.)?\d+", lower):
        return ".dump"
    double = next((one for one in (".nii.gz", ".bgeo.gz") if lower.endswith(one)), "")
    return double or Path(lower).suffix


def expand(names: str | Path | Sequence[str | Path], known: Sequence[str] = ()) -> Listing:
    """Returns the files that names, patterns and folders, or one index, stand for.

    Only the name of a file, not that of its folder, may be a pattern. A folder stands for its
    series of files with `known` extensions. Raises OSError if no name is given, a file is missing,
    a pattern fits no file, a folder has no series or several, or an index cannot be read or lists
    no file.
    """
    several = [names] if isinstance(names, (str, Path)) else names
    given = [Path(name).expanduser() for name in several]
    if len(given) == 1 and suffix_of(given[0]) in INDEX_SUFFIXES:
        return read_index(given[0])
    found = [file for name in given for file in _expand_one(name, known)]
    files = list(dict.fromkeys(found))
    twice = [str(file) for file, count in Counter(found).items() if count > 1]
    numbers = _numbers_in(list(map(str, files)))
    if len({natural_key(file, numbers)[0] for file in files}) == 1:  # else the user's own order
        files.sort(key=lambda file: natural_key(file, numbers))
    if not files:
        raise OSError("No files are given; name files, a pattern or a folder.")
    note = f"{twice[0]} is named more than once; it is used as one frame." if twice else ""
    return Listing([(file,) for file in files], note=note or _describe_two_numbers(files, numbers))


def _describe_two_numbers(files: list[Path], numbers: re.Pattern[str]) -> str:
    """Returns a note if names have two running numbers, in all pairs; else "".

    One of the numbers may count the parts of a frame.
    """
    parts = [tuple(numbers.split(str(file))[1::2]) for file in files]
    columns = [sorted({*column}, key=float) for column in zip(*parts)]
    running = [column for column in columns if len(column) > 1]
    if (
        len({*map(len, parts)}) != 1
        or len(running) != 2
        or len(files) != math.prod(map(len, running))
    ):
        return ""
    first, second = (f"{column[0]} to {column[-1]}" for column in running)
    return (
        f"The names have two running numbers, {first} and {second}, and each file is a frame. If "
        "one number counts the parts of a frame, list the files with part= in a .pvd."
    )


def _expand_one(path: Path, known: Sequence[str]) -> list[Path]:
    if path.is_dir():
        return _files_in(path, known)
    if path.exists():
        return [path]
    there = os.listdir(path.parent) if path.parent.is_dir() else []
    there = [name for name in there if not name.startswith(".")]
    parts, is_pattern = _NUMBER.split(path.name), glob.has_magic(path.name)
    if len(parts) > 1:
        numbers = r"-?\d+".join(map(re.escape, parts))
        found, is_pattern = [name for name in there if re.fullmatch(numbers, name)], True
    else:
        found = fnmatch.filter(there, path.name)
        found = found or fnmatch.filter(there, path.name.replace("[", "[[]"))
    if not found:
        what = "No file fits the pattern" if is_pattern else "There is no file"
        hint = "; its folder does not exist"
        if glob.has_magic(str(path.parent)) or _NUMBER.search(str(path.parent)):
            hint += ", and only the name of a file may be a pattern"
        raise OSError(f"{what} {path}{'' if path.parent.is_dir() else hint}.")
    numbers_in = _numbers_in(found)
    found.sort(key=lambda name: natural_key(name, numbers_in))
    return [path.parent / name for name in found]


def _files_in(folder: Path, known: Sequence[str]) -> list[Path]:
    """Returns the sorted files of a folder; raises OSError for no file or several series."""
    found = [path for path in folder.iterdir() if path.is_file() and suffix_of(path) in known]
    found = [path for path in found if not path.name.startswith(".")]
    found = [path for path in found if suffix_of(path) not in _NOTES] or found
    if not found:
        raise OSError(
            f"{folder} cannot be read: the folder has no file with extension {', '.join(known)}; "
            "choose another folder."
        )
    numbers = _numbers_in([path.name for path in found])
    parts = [numbers.split(path.name) for path in found]
    # Prefers #### to *, because run_* would also match run_old_1, a name of another series.
    are_whole = all(number.lstrip("-").isdigit() for own in parts for number in own[1::2])
    series = Counter(("####" if are_whole else "*").join(own[::2]) for own in parts)
    if len(series) > 1 and (len({*map(suffix_of, found)}) > 1 or max(series.values()) > 1):
        raise OSError(
            f"{folder} cannot be read: the folder has several series, {', '.join(sorted(series))}; "
            f"choose one, such as {folder / min(series)}."
        )
    return sorted(found, key=lambda path: natural_key(path.name, numbers))


def read_index(index: Path) -> Listing:
    """Reads the frames and times of a .pvd or a .series.

    Parts with the same time are one frame. If a part is listed twice for a time, as after a
    restart, the later entry counts.
    """
    try:
        text = index.read_text(encoding="utf-8")
        entries = _read_pvd(text) if suffix_of(index) == ".pvd" else _read_series(text)
        if not all(math.isfinite(time) for time, _, _ in entries):
            raise ValueError("a time is not finite")
    except FileNotFoundError:
        raise OSError(f"There is no file {index}.") from None
    except OSError as error:
        raise OSError(f"{index} cannot be read: {error.strerror}.") from error
    except (KeyError, TypeError) as error:
        raise OSError(
            f"{index} is no index of a series of files: it needs "
            f"{'`file`' if suffix_of(index) == '.pvd' else 'a list `files`, and `name` and `time`'}"
            " in each entry; correct it."
        ) from error
    except (ValueError, ElementTree.ParseError) as error:
        raise OSError(f"{index} is no index of a series of files: {error}; correct it.") from error
    if not entries:
        raise OSError(f"{index} lists no files.")
    frames: list[dict[str, str]] = []
    times: list[float] = []
    left_out: list[str] = []
    least = _ROUNDING * max(abs(time) for time, _, _ in entries)
    for time, part, name in sorted(entries, key=lambda entry: entry[0]):
        if not times or time - times[-1] > least:
            times.append(time)
            frames.append({})
        if frames[-1].get(part, name) != name:
            left_out.append(frames[-1][part])
        frames[-1][part] = name
    parts = [tuple(_beside(index, name) for name in frame.values()) for frame in frames]
    note = left_out and (
        f"{index} lists several files for one time, as after a restart; the last entry is used. "
        f"Number of files left out: {len(left_out)}, such as {left_out[0]}. If the files are "
        "parts of one frame, number the parts with part= in a .pvd."
    )
    return Listing(parts, times, note or "")


def _beside(index: Path, name: str) -> Path:
    """Returns the path of a file that an index lists with folder separators of Unix or Windows."""
    path = index.parent / name
    return path if path.exists() else index.parent / name.replace("\\", "/")


def _read_pvd(text: str) -> list[tuple[float, str, str]]:
    """Returns time, part and file of each entry."""
    return [
        (
            float(one.get("timestep", 0)),
            " ".join(one.get(key, "") for key in ("group", "part", "name")),
            one.attrib["file"],
        )
        for one in ElementTree.fromstring(text).iter("DataSet")
    ]


def _read_series(text: str) -> list[tuple[float, str, str]]:
    return [(float(one["time"]), "", str(one["name"])) for one in json.loads(text)["files"]]


def write_index(index: Path, files: Sequence[Path], times: Sequence[float]) -> None:
    """Writes a .pvd or a .series, atomically, with paths relative to the index's folder."""
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
    """Returns True if a name has a placeholder for the frame number."""
    return _NUMBER.search(Path(name).name) is not None


def numbered(name: str | Path, number: int) -> Path:
    """Returns the name of a frame: the number, with at least four digits, replaces ####.

    A minus counts as a digit. ## stands for at least two digits. Without a placeholder, skin.ply
    becomes skin_0007.ply.
    """
    path = Path(name)
    mark = _NUMBER.search(path.name)
    if mark is None:
        return path.with_name(f"{path.stem}_{number:04}{path.suffix}")
    return path.with_name(_with_number(path.name, mark, number))


def _with_number(name: str, mark: re.Match[str], number: int) -> str:
    text = mark[0]
    digits = len(text) if text[0] == "#" else int(re.sub(r"\D", "", text) or 1)
    return f"{name[: mark.start()]}{number:0{digits}}{name[mark.end() :]}"


def labelled(name: str | Path, label: int, is_series: bool, is_one_of_several: bool) -> Path:
    """Returns the name for a label; the label replaces the first #### if frames do not need it.

    A series needs one ####, one frame needs none. If no #### is left for the label, the label is
    added to the name if there are several labels.
    """
    path = Path(name)
    marks = list(_NUMBER.finditer(path.name))
    if len(marks) > is_series:
        return path.with_name(_with_number(path.name, marks[0], label))
    if not is_one_of_several:
        return path
    if not marks:
        return path.with_name(f"{path.stem}_{label}{path.suffix}")
    start = marks[0].start()
    return path.with_name(f"{path.name[:start]}{label}_{path.name[start:]}")


def names_of(name: str | Path, numbers: Sequence[int]) -> list[Path]:
    """Returns the names of numbered frames; for one frame `name` itself, unless it has a ####."""
    is_series = len(numbers) > 1 or has_number(name)
    return [numbered(name, number) if is_series else Path(name) for number in numbers]


def numbers_of(files: Sequence[str | Path]) -> list[int]:
    """Returns the result of running_numbers if it has only integers; else 0, 1, 2 ..."""
    numbers = running_numbers(files)
    whole = [number for number in numbers if isinstance(number, int)]
    return whole if len(whole) == len(numbers) else list(range(len(files)))


def running_numbers(files: Sequence[str | Path]) -> list[float]:
    """Returns a number for each name.

    If the names differ only in one number, which increases, returns its values; else 0, 1, 2 ...
    """
    names = list(map(str, files))
    parts = list(map(_numbers_in(names).split, names))
    places = range(min(map(len, parts), default=0))
    differing = [place for place in places if len({part[place] for part in parts}) > 1]
    if len(differing) == 1 and len(set(map(len, parts))) == 1 and differing[0] % 2 == 1:
        numbers = [_value(part[differing[0]]) for part in parts]
        if all(before < after for before, after in zip(numbers, numbers[1:])):
            return numbers
    return list(range(len(files)))


def check_distinct(inputs: Iterable[Path], outputs: Iterable[Path]) -> None:
    """Raises OSError if an output file is also an input file."""
    read = {file.resolve() for file in inputs}
    for name in outputs:
        if name.resolve() in read:
            raise OSError(f"{name} is one of the input files; choose another --output.")


def without_number(name: str | Path) -> Path:
    """Returns the name without placeholder: skin.vtp for skin_####.vtp, also for ####.vtp."""
    path = Path(name)
    stem = _NUMBER.sub("", path.stem).strip("._- ")
    return path.with_name((stem or "skin") + path.suffix)


def make_folder_of(path: Path) -> None:
    """Makes the folder of a file if it does not exist.

    Raises OSError if the folder cannot be made.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OSError(f"The folder {path.parent} cannot be made: {error.strerror}.") from error


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Yields a temporary name to write to; renames the file to `path`, or on errors deletes it.

    Raises OSError if the file cannot be written, or `path` is a folder, a pipe or a device.
    """
    if path.exists() and not path.is_file():
        raise OSError(
            f"{path} cannot be written: it is a folder, a pipe or a device; choose another name."
        )
    temporary = path.with_name(f".{os.getpid()}.{path.name}")
    try:
        yield temporary
        os.replace(temporary, path)
    except OSError as error:
        said = f"{path} cannot be written: {error.strerror}."
        if error.strerror is None:
            said = str(error).replace(temporary.name, path.name)
        raise OSError(said) from error
    finally:
        temporary.unlink(missing_ok=True)
