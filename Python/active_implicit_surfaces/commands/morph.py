"""active-surface morph: one shape becomes another."""

from __future__ import annotations

import argparse
from itertools import product
from pathlib import Path
from typing import Any

import numpy

from .. import runner
from ..choice import choose_in, labels_of
from ..morphing import FITS, morph
from ..skin_files import MESH_SUFFIXES, read_shape
from .effects import check_effects
from .options import (
    Parser,
    add_choice_options,
    add_help,
    add_picture_options,
    add_property_options,
    positive,
    properties_of,
    wrapped,
)
from .outputs import Outputs, add_output_options, each_label
from .progress import Progress

_DEFAULT = "morph_####.vtp"


def run(arguments: list[str]) -> int:
    """Runs the command; returns its exit code."""
    parser = make_parser()
    options = parser.parse_args(arguments)
    chosen = properties_of(options, parser)
    if options.frames < 2:
        parser.error("--frames has to be 2 or more, because it counts the first and the last skin")
    options.files = [Path(name).expanduser() for name in (options.first, options.last)]
    shapes = [read_shape(file) for file in options.files]
    for own in each_label(options, lambda: labels_of(shapes[0]), True, _DEFAULT):
        _run(parser, own, chosen, shapes)
    return 0


def _run(parser: Parser, options: Any, chosen: dict[str, Any], shapes: list[Any]) -> None:
    outputs = Outputs(parser, options)
    shapes = [
        choose_in(file, shape, options.where or (), options.label)
        for file, shape in zip(options.files, shapes)
    ]
    facts = ["mesh" for shape in shapes if shape.IsA("vtkPolyData")]
    check_effects(parser, options, outputs.output, ["series", *facts])
    outputs.plan(list(range(options.frames)), options.files)
    duration, count = options.duration, options.frames
    way = morph(shapes[0], shapes[1], duration, frames=count, fit=options.fit, **chosen)
    sinks = outputs.sinks(way, lambda: (_corners_of(shapes), "y"), "paper")
    runner.run(way.make, range(count), [*sinks, Progress(count, quiet=options.quiet)])


def make_parser() -> Parser:
    parser = Parser(
        "active-surface morph",
        "FIRST LAST [-o morph_####.vtp] [--render film.mp4] [options]",
        "One shape becomes another at the end of the duration: the surface moves along its\n"
        "normal, splits and merges. Parts of only one of the shapes grow or shrink.\n"
        + wrapped(f"Closed meshes and images: {', '.join(MESH_SUFFIXES)}."),
        epilog="Properties of the filter are options, such as --number-of-threads 1;\n"
        "list them by --help-properties.",
    )
    parser.add_argument("first", metavar="FIRST", help=argparse.SUPPRESS)
    parser.add_argument("last", metavar="LAST", help=argparse.SUPPRESS)
    add_output_options(parser, _DEFAULT)
    parser.add_argument(
        "--duration",
        type=positive,
        default=1.0,
        metavar="X",
        help="time of the last skin, which is LAST unless properties such as --attraction "
        "prevent this (default: 1)",
    )
    parser.add_argument(
        "--frames",
        type=int,
        default=25,
        metavar="N",
        help="number of skins, including the first and last (default: 25)",
    )
    parser.add_argument(
        "--fit",
        choices=FITS,
        nargs="?",
        const="box",
        default="none",
        help="move LAST to FIRST; box (bare --fit) also scales LAST (default: none)",
    )
    add_choice_options(parser, "FIRST")
    add_property_options(parser, ("voxel_size", "tension"))
    add_picture_options(parser, "y")
    more = parser.add_argument_group("more")
    more.add_argument("--quiet", action="store_true", help="print no progress")
    add_help(more, properties=True)
    return parser


def _corners_of(shapes: list[Any]) -> Any:
    """Returns the corners of the shapes' bounding boxes."""
    boxes = [shape.GetBounds() for shape in shapes]
    return numpy.array([corner for box in boxes for corner in product(box[:2], box[2:4], box[4:])])
