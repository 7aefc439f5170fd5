"""active-surface skin: skins over a series of particle files."""

from __future__ import annotations

import argparse
from typing import Any

import numpy

from .. import runner
from ..api import frames
from ..file_names import suffix_of
from ..particle_files import PARTICLE_SUFFIXES, open_particles
from ..presets import PRESETS
from ..series import TemporalSource
from .effects import check_effects
from .options import (
    MAIN_PROPERTIES,
    Parser,
    add_help,
    add_picture_options,
    add_property_options,
    positive,
    preset_help,
    properties_of,
    times_list,
)
from .outputs import Outputs, add_output_options
from .progress import Progress
from .resume import Resumption
from .view import find_view

_ARRAYS = ("ids", "radii", "strengths", "velocities")


def run(arguments: list[str]) -> int:
    """Runs the command; returns its exit code."""
    parser = make_parser()
    options = parser.parse_args(arguments)
    chosen = properties_of(options, parser)
    outputs = Outputs(parser, options, "skin_####.vtp")
    if options.resume and options.render and suffix_of(options.render) in (".mp4", ".ogv"):
        parser.error("a film cannot go on where it was cut off; render to frame.####.png")
    if options.resume and not outputs.output:
        parser.error("--resume goes on with skins; say their name, -o skin_####.vtp")
    files = open_particles(options.files, fps=options.fps, times=options.times)
    outputs.plan(files.numbers, files.files)
    arrays = {role: getattr(options, role) for role in _ARRAYS if getattr(options, role)}
    source = TemporalSource(files.load, files.times, any_order=True)
    way = frames(source, preset=options.preset, arrays=arrays, **chosen)
    facts = ["particles", *(["series"] if len(way) > 1 else [])]
    check_effects(parser, options, outputs.output, facts, way.surface)
    described = {"preset": options.preset, **arrays, **chosen}
    kept = Resumption(outputs.output, described, files.names) if outputs.output else None
    first = kept.bind(way, outputs.names, options.resume) if kept else 0
    sinks = outputs.sinks(way, lambda: _find_view(options, files, kept), options.preset or "water")
    progress = Progress(len(way), first, options.quiet)
    runner.run(way.make, range(first, len(way)), [*sinks, *filter(None, [kept]), progress])
    return 0


def make_parser() -> Parser:
    parser = Parser(
        "active-surface skin",
        "FILE ... [-o skin_####.vtp] [--render film.mp4] [options]",
        "Skins over particles: one for each frame, each going on from the last.\n"
        f"Files: {', '.join(PARTICLE_SUFFIXES)};\n"
        "several, a pattern ('p_*.vtp', p_####.vtp), a folder, a .series or a .pvd are a series.",
        epilog="presets:\n" + preset_help() + "\n\nEvery property of the filter is an option "
        "too, as --particle-model sum:\n--help-properties, or --help all.",
    )
    parser.add_argument("files", nargs="+", metavar="FILE", help=argparse.SUPPRESS)
    add_output_options(parser, "skin_####.vtp")
    parser.add_argument("--preset", choices=PRESETS, help="what the particles are (see below)")
    add_property_options(parser, tuple(MAIN_PROPERTIES))
    _add_input_options(parser)
    add_picture_options(parser, "found")
    more = parser.add_argument_group("more")
    more.add_argument("--resume", action="store_true", help="go on where a run was cut off")
    more.add_argument("--index", metavar="NAME", help="the .pvd or .series of the skins, or none")
    more.add_argument("--quiet", action="store_true", help="no progress")
    add_help(more, properties=True)
    return parser


def _add_input_options(parser: Parser) -> None:
    files = parser.add_argument_group("of the files")
    files.add_argument(
        "--fps", type=positive, metavar="X", help="frames per second (default: as files say, or 25)"
    )
    files.add_argument("--times", type=times_list, metavar="T,T...", help="or FIRST:LAST:COUNT")
    for role, text in zip(_ARRAYS, ("ids (default: found)", "reaches", "strengths", "velocities")):
        files.add_argument(f"--{role}", metavar="NAME", help=f"point array of {text}")


def _find_view(options: Any, files: Any, kept: Resumption | None) -> tuple[Any, str]:
    """What the camera holds, and the axis that is up; of a run that goes on, as before."""
    if kept and kept.view:
        return numpy.array(kept.view[0]), str(kept.view[1])
    reaches = "reach" if options.preset == "molecule" else options.radii
    held, up = find_view(files, reaches, options.ids, options.velocities)
    if kept:
        kept.view = [held.tolist(), up]
    return held, up
