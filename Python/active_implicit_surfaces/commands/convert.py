"""active-surface convert: converts files from one format to another."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any, NamedTuple

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData

from .. import runner
from ..choice import choose_in, labels_of, note_once
from ..contours import contour, usual_level
from ..data_objects import points_of
from ..file_names import (
    Listing,
    check_distinct,
    expand,
    make_folder_of,
    names_of,
    numbers_of,
    running_numbers,
    suffix_of,
)
from ..messages import few, warn
from ..particle_files import PARTICLE_SUFFIXES, open_particles
from ..runner import FileSeries, Sink
from ..skin_files import (
    INPUT_SUFFIXES,
    MESH_SUFFIXES,
    MESH_WRITERS,
    PARTICLE_OUT_SUFFIXES,
    check_suffix,
    holds_particles,
    read_shape,
    write_mesh,
    write_particles,
)
from ..times import places_of, times_at
from ..usd_film import USD_SUFFIXES, UsdFilm, check_usd
from ..vtk_files import open_vtk
from .effects import check_effects
from .options import Parser, add_choice_options, add_help, add_up_option, positive, wrapped
from .outputs import each_label
from .progress import Progress
from .view import lie

_FOG_LEVEL = 0.5
_MESHES = (*MESH_WRITERS, *USD_SUFFIXES)


class _Conversion(NamedTuple):
    """Loader and writer of a step, frame numbers, and files read."""

    load: Callable[[int], Any]
    numbers: list[int]
    files: list[Path]
    write: Callable[[Path, Any], None]


def run(arguments: list[str]) -> int:
    """Runs the command; returns its exit code."""
    parser = make_parser()
    options = parser.parse_args(arguments)
    output = Path(options.output).expanduser()
    options.output = str(output)
    known = tuple(dict.fromkeys((*_MESHES, *PARTICLE_OUT_SUFFIXES)))
    try:
        check_suffix(output, known, "files")
    except ValueError as error:
        parser.error(str(error))
    listing = expand(options.files, INPUT_SUFFIXES)
    files = listing.files
    already = [file for file in files if suffix_of(file) == suffix_of(output) == ".vdb"]
    if already:
        raise OSError(f"{already[0]} is a .vdb already; copy it, or write another format.")
    has_settings = options.level is not None or options.voxel_size is not None
    check_effects(parser, options, output, [_way(files[0], output)] if has_settings else [])
    holds_particles = _holds_particles(files[0], output)

    def labels() -> list[int]:
        is_cloud = holds_particles
        return labels_of(
            open_particles(options.files).load(0) if is_cloud else read_shape(files[0])
        )

    for own in each_label(options, labels, len(files) > 1, ""):
        _convert(own, listing, _particles if holds_particles else _shapes)
    return 0


def _convert(options: Any, listing: Listing, kind: Callable[..., _Conversion]) -> None:
    output = Path(options.output)
    make_folder_of(output)
    load, numbers, used, write = kind(options, listing, output)
    if options.where:
        of_label = [] if options.label is None else [f"label={options.label}"]
        load = _warning_of_none(load, " and ".join(options.where + of_label), len(numbers))
    is_usd = suffix_of(output) in USD_SUFFIXES
    names = [output] if is_usd else names_of(output, numbers)
    check_distinct(used, names)
    sink: Sink = FileSeries(names, write)
    if is_usd:
        check_usd(output)
        places = places_of(running_numbers(listing.files)) if len(numbers) > 1 else range(1)
        sink = UsdFilm(output, listing.times or times_at(places, None), None, options.up or "y")
    progress = Progress(len(numbers), quiet=options.quiet or len(numbers) == 1)
    runner.run(load, range(len(numbers)), [sink, progress])


def _warning_of_none(load: Callable[[int], Any], where: str, count: int) -> Callable[[int], Any]:
    """Wraps `load` to warn of steps in which nothing meets the conditions."""

    def load_with_note(step: int) -> Any:
        data = load(step)
        if data.GetNumberOfPoints() == 0:
            warn(f"Frame {step + 1} of {count} is empty: nothing in it meets {where}.")
        return data

    return load_with_note


def make_parser() -> Parser:
    parser = Parser(
        "active-surface convert",
        "FILE ... -o NAME [options]",
        "Converts meshes, level sets and images to meshes and .vdb, particles to particles.\n"
        + wrapped(f"Meshes and images from {', '.join(MESH_SUFFIXES)} to {', '.join(_MESHES)};")
        + "\n"
        + wrapped(
            f"particles from {', '.join(PARTICLE_SUFFIXES)} to {', '.join(PARTICLE_OUT_SUFFIXES)}."
        ),
    )
    parser.add_argument("files", nargs="+", metavar="FILE", help=argparse.SUPPRESS)
    parser.add_argument(
        "-o", "--output", required=True, metavar="NAME", help="output; #### is the frame number"
    )
    parser.add_argument(
        "--voxel-size",
        type=positive,
        metavar="X",
        help="voxel size for meshes to .vdb (default: longest side / 64)",
    )
    parser.add_argument(
        "--level",
        type=float,
        metavar="X",
        help="value at the surface of an image (default: in a .vdb 0 of a level set, 0.5 of a fog "
        "or of values >= 0; otherwise 0.5 of fractions, the middle of a mask's two values, else 0)",
    )
    add_choice_options(parser)
    add_up_option(parser, "estimated; y in USD", "in a .glb or USD")
    parser.add_argument("--quiet", action="store_true", help="print no progress")
    add_help(parser)
    return parser


def _way(file: Path, output: Path) -> str:
    """Returns the kind of a conversion: "particles", "mesh_to_vdb", "image_to_mesh" ..."""
    if _holds_particles(file, output):
        return "particles"
    kind = "image" if read_shape(file).IsA("vtkImageData") else "mesh"
    return f"{kind}_to_{'vdb' if suffix_of(output) == '.vdb' else 'mesh'}"


def _holds_particles(path: Path, output: Path) -> bool:
    found = holds_particles(path)
    return suffix_of(output) not in _MESHES if found is None else found  # None: an empty skin


def _particles(options: Any, listing: Listing, output: Path) -> _Conversion:
    if suffix_of(output) not in PARTICLE_OUT_SUFFIXES:
        raise OSError(
            f"{output}: particles are written as {', '.join(PARTICLE_OUT_SUFFIXES)}; "
            "`active-surface skin` makes a skin over them."
        )
    series = open_particles(options.files, where=options.where or (), label=options.label)
    return _Conversion(series.load, series.numbers, series.files, write_particles)


def _shapes(options: Any, listing: Listing, output: Path) -> _Conversion:
    is_vdb = suffix_of(output) == ".vdb"
    if suffix_of(output) not in _MESHES:
        raise OSError(f"{output}: meshes and images are written as {', '.join(_MESHES)}.")
    note = note_once() if len(listing.frames) > 1 else None
    up = options.up  # up axis of a .glb: from the first file with points, for all files

    def load(step: int) -> Any:
        file, *parts = listing.frames[step]
        whole = read_shape(file, parts=parts)
        shape = choose_in(file, whole, options.where or (), options.label, note)
        is_contour = shape.IsA("vtkImageData") and not is_vdb
        return _contour(file, shape, options) if is_contour else shape

    def write(name: Path, shape: Any) -> None:
        nonlocal up
        settings: dict[str, Any] = {}
        if is_vdb and options.voxel_size and shape.IsA("vtkPolyData"):
            settings["SetVoxelSize"] = options.voxel_size
        if up is None and suffix_of(name) == ".glb" and shape.GetNumberOfPoints():
            box = numpy.reshape(shape.GetBounds(), (3, 2)).T
            up = lie(box[0], box[1], points_of(shape).mean(axis=0))
        write_mesh(name, shape, up=up or "y", **settings)

    used = [file for parts in listing.frames for file in parts]
    return _Conversion(load, numbers_of(listing.files), used, write)


def _contour(file: Path, image: Any, options: Any) -> Any:
    """Returns the surface of an image or a grid; an empty surface if the image has no points.

    The surface is also empty if all values of a .vdb are equal, as for a skin that has vanished.
    Raises OSError if any other image has no surface.
    """
    if image.GetNumberOfPoints() == 0:
        return vtkPolyData()
    try:
        if suffix_of(file) != ".vdb":
            level, above = usual_level(image, options.level)
            if above and options.level is not None:
                warn(
                    f"Inside is above {level:g}, because the image is a mask or volume fractions, "
                    "or most values at its border are lower."
                )
        else:
            level, above = _level_of_grid(file, image)
        level = level if options.level is None else options.level
        surface = contour(image, level, above=above)
    except ValueError as error:
        raise OSError(f"{file}: {error}") from error
    scalars = image.GetPointData().GetScalars() or image.GetCellData().GetScalars()
    # The .vdb of a skin that has vanished is constant.
    may_be_empty = suffix_of(file) == ".vdb" and scalars and len({*scalars.GetRange()}) == 1
    if surface.GetNumberOfPoints() == 0 and scalars is not None and not may_be_empty:
        raise OSError(_about_no_surface(file, image, scalars, level, options))
    return surface


def _about_no_surface(file: Path, image: Any, scalars: Any, level: float, options: Any) -> str:
    every = vtk_to_numpy(scalars)
    values = every[numpy.isfinite(every)]
    if not values.size:
        return f"{file} has no surface: none of its values is finite; choose another file."
    low, high = values.min(), values.max()
    if low == high:
        value = low if options.label is None else options.label
        kind = "" if values.size == every.size else "finite "
        return f"{file} has no surface: all its {kind}values are {value:g}; choose another file."
    labels = list[int]()
    with suppress(ValueError):
        labels = labels_of(image) if options.level is None and low >= 0 else []
    return (
        f"{file} has no surface at the level {level:g}: its values are from {low:g} to {high:g}; "
        "choose another --level or file"
        + (f", or a --label of {few(labels, 20)}." if labels else ".")
    )


def _level_of_grid(file: Path, image: Any) -> tuple[float, bool]:
    """Returns the level of a .vdb, and True if inside is above, as in a fog.

    A level set has the level 0, inside below. A file whose grids have no class, as written from
    images, follows `usual_level` if a value is negative. Other grids have the level 0.5, inside
    above.
    """
    reader = open_vtk(file)
    classes = {*map(reader.GetGridClass, range(reader.GetNumberOfGrids()))}
    if "level set" in classes:
        return 0.0, False
    scalars = image.GetPointData().GetScalars()
    is_plain = "fog volume" not in classes and scalars is not None
    if is_plain and numpy.any(vtk_to_numpy(scalars) < 0):
        return usual_level(image)
    return _FOG_LEVEL, True
