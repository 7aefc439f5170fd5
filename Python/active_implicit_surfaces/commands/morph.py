"""active-surface morph: one shape becomes another."""

from __future__ import annotations

import argparse
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import numpy

from ..file_names import (
    check_distinct,
    make_folder_of,
    numbered,
    suffix_of,
    without_number,
    write_index,
)
from ..fitting import FITS
from ..morphing import morph
from ..skin_files import MESH_SUFFIXES, SKIN_SUFFIXES, check_suffix, read_shape, write_mesh
from .effects import check_effects
from .options import (
    PICTURE_SIZE,
    Parser,
    add_film_option,
    add_help,
    add_picture_options,
    add_property_options,
    positive,
    properties_of,
    wrapped,
)
from .progress import Progress

DEFAULT = "morph_####.vtp"
_CORNERS = [(i, j, k) for i in (0, 1) for j in (0, 1) for k in (0, 1)]


def run(arguments: list[str]) -> int:
    """Runs the command; returns its exit code."""
    parser = make_parser()
    options = parser.parse_args(arguments)
    chosen = properties_of(options, parser)
    output = None if options.render and not options.output else Path(options.output or DEFAULT)
    try:
        if output:
            check_suffix(output, SKIN_SUFFIXES, "skins")
        if options.frames < 2:
            parser.error("frames are 2 at least, the first shape and the last")
    except ValueError as error:
        parser.error(str(error))
    shapes = [read_shape(Path(name)) for name in (options.first, options.last)]
    facts = ["mesh" for shape in shapes if shape.IsA("vtkPolyData")]
    facts += ["compute_velocity=on"] * (suffix_of(options.render or "") == ".exr")
    check_effects(parser, options, output, ["series", *facts])
    if output:
        planned = (numbered(output, step) for step in range(options.frames))
        check_distinct([Path(options.first), Path(options.last)], planned)
    for name in (output, options.render and Path(options.render)):
        if name:
            make_folder_of(name)
    count = options.frames
    way = morph(shapes[0], shapes[1], options.duration, frames=count, fit=options.fit, **chosen)
    if options.render and suffix_of(options.render) == ".exr":
        way.surface.ComputeVelocityOn()
    _write(options, shapes, way, output)
    return 0


def _write(options: Any, shapes: list[Any], way: morph, output: Path | None) -> None:
    progress = Progress(len(way), quiet=options.quiet)
    names: list[Path] = []
    with ExitStack() as stack:
        film = stack.enter_context(_film(options, shapes, way.times)) if options.render else None
        for step, frame in enumerate(way):
            if output:
                names.append(numbered(output, step))
                # The filter's own output, whose grid a .vdb has.
                skin, port = way.surface.GetOutput(), way.surface.GetOutputPort()
                write_mesh(names[-1], skin, port, options.up or "y")
            if film:
                film.add(step, frame.skin, step)
            progress(step + 1)
    if output:
        plain = without_number(output)
        is_vtp = plain.suffix == ".vtp"
        write_index(
            plain.with_suffix(".pvd") if is_vtp else Path(f"{plain}.series"), names, way.times
        )
    progress.finish()


def make_parser() -> Parser:
    parser = Parser(
        "active-surface morph",
        "FIRST LAST [-o morph_####.vtp] [--render film.mp4] [options]",
        "One shape becomes another: it moves along its normal, splits and merges, and arrives at\n"
        "the end of the duration. What only one of the shapes has grows, or shrinks.\n"
        + wrapped(f"Closed meshes and images: {', '.join(MESH_SUFFIXES)}."),
        epilog="Every property of the filter is an option too, as --number-of-threads 1:\n"
        "--help-properties, or --help all.",
    )
    parser.add_argument("first", metavar="FIRST", help=argparse.SUPPRESS)
    parser.add_argument("last", metavar="LAST", help=argparse.SUPPRESS)
    parser.add_argument(
        "-o",
        "--output",
        metavar="NAME",
        help=f"name of the skins, #### for the number: {', '.join(SKIN_SUFFIXES)} "
        "(default: morph_####.vtp, and none with --render alone)",
    )
    add_film_option(parser)
    parser.add_argument(
        "--duration", type=positive, default=1.0, metavar="X", help="time of the way (default: 1)"
    )
    parser.add_argument(
        "--frames",
        type=int,
        default=25,
        metavar="N",
        help="skins, both ends included (default: 25)",
    )
    parser.add_argument(
        "--fit",
        choices=FITS,
        nargs="?",
        const="box",
        default="none",
        help="bring LAST to the place of FIRST: centre, or box for its size too (default: none)",
    )
    add_property_options(parser, ("voxel_size", "tension"))
    add_picture_options(parser, "y")
    more = parser.add_argument_group("more")
    more.add_argument("--quiet", action="store_true", help="no progress")
    add_help(more, properties=True)
    return parser


def _film(options: Any, shapes: list[Any], times: list[float]) -> Any:
    from ..film import Film, check_film
    from ..scene import COLORS, Scene

    path = Path(options.render)
    check_film(path, options.frames)
    boxes = [shape.GetBounds() for shape in shapes]
    held = numpy.array([[box[i], box[2 + j], box[4 + k]] for box in boxes for i, j, k in _CORNERS])
    is_soft = suffix_of(path) != ".exr"
    up, has_ground = options.up or "y", not options.no_ground
    scene = Scene(held, options.size or PICTURE_SIZE, up, COLORS["paper"], is_soft, has_ground)
    return Film(path, scene, times)
