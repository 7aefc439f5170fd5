"""active-surface skin: skins over a series of particles or images."""

from __future__ import annotations

import argparse
from bisect import bisect_left
from pathlib import Path
from typing import Any, NamedTuple

import numpy

from .. import runner
from ..api import frames
from ..file_names import suffix_of
from ..messages import few
from ..particle_files import TARGET_SUFFIXES, ParticleFiles, labels_in, open_particles
from ..presets import PRESETS
from ..series import TemporalSource
from ..times import times_between
from .effects import check_effects
from .options import (
    MAIN_PROPERTIES,
    Parser,
    add_choice_options,
    add_help,
    add_picture_options,
    add_property_options,
    frame_range,
    positive,
    preset_help,
    properties_of,
    times_list,
    whole,
    wrapped,
)
from .outputs import Outputs, add_output_options, each_label
from .progress import Progress
from .resume import Resumption
from .view import find_view

_DEFAULT = "skin_####.vtp"
_DESCRIBED = (  # options that affect skins, besides properties and arrays
    *("where", "label", "minimum_piece", "minimum_volume", "frames", "preroll", "output_fps"),
    *("preset", "probe", "periodic"),
)
_ARRAYS = ("ids", "radii", "strengths", "velocities")


def run(arguments: list[str]) -> int:
    """Runs the command; returns its exit code."""
    parser = make_parser()
    options = parser.parse_args(arguments)
    chosen = properties_of(options, parser)
    if options.resume and options.render and suffix_of(options.render) in (".mp4", ".ogv"):
        parser.error("a film cannot be resumed; render to frame.####.png")
    if options.resume and options.render and not options.output:
        parser.error("--resume needs files of skins; add -o skin_####.vtp")
    for name in ("preset", "ids", "strengths", "velocities") if options.probe is not None else ():
        if getattr(options, name):
            parser.error(f"--{name} has no effect with --probe")
    files: Any = open_particles(options.files) if options.labels else ()
    for own in each_label(options, lambda: labels_in(files), len(files) > 1, _DEFAULT):
        _run(parser, own, chosen)
    return 0


def _run(parser: Parser, options: Any, chosen: dict[str, Any]) -> None:
    outputs = Outputs(parser, options)
    where, label = options.where or [], options.label
    files = open_particles(
        options.files, fps=options.fps, times=options.times, where=where, label=label
    )
    plan = _plan(options, files)
    outputs.plan(plan.numbers, files.files)
    arrays = {role: getattr(options, role) for role in _ARRAYS if getattr(options, role)}
    source = TemporalSource(files.load, files.times, files.kind, any_order=True)
    way = frames(
        source if len(plan.steps) == len(files) else source.part(plan.steps),
        where=where + ([] if label is None else [f"label={label}"]),
        minimum_piece=options.minimum_piece or 1,
        minimum_volume=options.minimum_volume or 0.0,
        probe=options.probe,
        periodic=bool(options.periodic),
        preset=options.preset,
        arrays=arrays,
        **chosen,
    )
    way.times = plan.times
    probes = options.probe is not None
    facts = [
        "image" if files.kind == "vtkImageData" else "atoms" if probes else "particles",
        *(["series"] if len(plan.steps) > 1 else []),
    ]
    check_effects(parser, options, outputs.output, facts, way.surface)
    told = ((name, getattr(options, name)) for name in _DESCRIBED)
    described = {name: value for name, value in told if value is not None}
    described |= {**arrays, **chosen}
    is_kept = outputs.output and not outputs.is_usd
    kept = Resumption(Path(options.output), described, plan.files) if is_kept else None
    first = kept.bind(way, outputs.names, options.resume) if kept else 0
    if first == len(way) and (options.history or options.plot):
        way.make(first - 1)  # the saved state's history is available after an update
    sinks = outputs.sinks(way, lambda: _find_view(options, files, kept), options.preset or "water")
    progress = Progress(len(way), first, options.quiet)
    runner.run(way.make, range(first, len(way)), [*sinks, *filter(None, [kept]), progress])


class _Plan(NamedTuple):
    """Steps to read; times and numbers of the skins; the last file that each skin needs."""

    steps: list[int]
    times: list[float]
    numbers: list[int]
    files: list[Path]


def _plan(options: Any, files: ParticleFiles) -> _Plan:
    """Plans the skins over the frames of `files`, by --frames, --preroll and --output-fps."""
    low, high, stride = options.frames or (None, None, 1)
    first, last = (files.numbers[i] if n is None else n for i, n in ((0, low), (-1, high)))
    wanted = [
        step
        for step, number in enumerate(files.numbers)
        if first <= number <= last and (number - first) % stride == 0
    ]
    if not wanted:
        own = few(files.numbers) + (f" {files.numbers[-1]}" if len(files) > 8 else "")
        raise ValueError(
            f"--frames {first}:{last}:{stride} selects no frame; the frames are {own}."
        )
    before = range(wanted[0] - stride * (options.preroll or 0), wanted[0], stride)
    steps = [*(step for step in before if step >= 0), *wanted]
    if not options.output_fps:
        chosen = [(files.times[step], files.numbers[step]) for step in wanted]
    else:
        start, end = files.times[wanted[0]], files.times[wanted[-1]]
        every = enumerate(times_between(files.times, options.output_fps))
        rounding = 1e-6 / options.output_fps
        chosen = [(time, i) for i, time in every if start - rounding <= time <= end + rounding]
        chosen = [(min(max(time, start), end), i) for time, i in chosen]
    times = [time for time, _ in chosen]
    needed = [bisect_left(files.times, time, hi=len(files) - 1) for time in times]
    read = [files.names[step] for step in needed]
    return _Plan(steps, times, [number for _, number in chosen], read)


def make_parser() -> Parser:
    parser = Parser(
        "active-surface skin",
        "FILE ... [-o skin_####.vtp] [--render film.mp4] [options]",
        wrapped(
            "Makes skins over particles or images: one for each frame, usually evolved from the "
            f"previous. Files: {' '.join(TARGET_SUFFIXES)}; several files, 'p_*.vtp', p_####.vtp, "
            "a folder, a .series or a .pvd are a series."
        ),
        epilog=f"presets:\n{preset_help()}\n\nProperties of the filter are options, such as "
        "--particle-model sum (list: --help-properties).",
    )
    parser.add_argument("files", nargs="+", metavar="FILE", help=argparse.SUPPRESS)
    add_output_options(parser, _DEFAULT)
    parser.add_argument(
        "--preset",
        choices=PRESETS,
        metavar="NAME",
        help="named set of properties (see below)",
    )
    parser.add_argument(
        "--probe",
        type=float,
        metavar="X",
        help="radius of a probe that rolls over atoms (water: 1.4 Angstrom)",
    )
    add_property_options(parser, tuple(MAIN_PROPERTIES))
    _add_input_options(parser)
    add_picture_options(parser, "estimated")
    more = parser.add_argument_group("more")
    more.add_argument("--resume", action="store_true", help="continue an interrupted run")
    more.add_argument(
        "--index",
        metavar="NAME",
        help="name of the .pvd or .series that lists the skins, or none: write no list",
    )
    more.add_argument(
        "--history", metavar="NAME", help="write a .csv of volume, area, pieces, events ..."
    )
    more.add_argument(
        "--plot", metavar="NAME", help="write a plot of the history: .png, .svg, .pdf"
    )
    more.add_argument("--quiet", action="store_true", help="print no progress")
    add_help(more, properties=True)
    return parser


def _add_input_options(parser: Parser) -> None:
    files = parser.add_argument_group("of the files")
    files.add_argument(
        "--fps",
        type=positive,
        metavar="X",
        help="frames per second (default: times in the files, else 25)",
    )
    add_choice_options(files, "the first, middle and last frame")
    told = "omit clusters of fewer than N particles; or --minimum-volume X"
    files.add_argument("--minimum-piece", type=whole, metavar="N", help=told)
    files.add_argument("--minimum-volume", type=positive, help=argparse.SUPPRESS)
    told = "first, last, step; --preroll N starts N steps before A"
    files.add_argument("--frames", type=frame_range, metavar="A:B:C", help=told)
    files.add_argument("--preroll", type=whole, help=argparse.SUPPRESS)
    files.add_argument(
        "--output-fps",
        type=positive,
        metavar="X",
        help="skins per unit of time, also between frames",
    )
    told = "use the periodic box in the files; or --periodic-bounds"
    files.add_argument("--periodic", action="store_true", default=None, help=told)
    files.add_argument(
        "--times",
        type=times_list,
        metavar="T,T...",
        help="times of the frames, or FIRST:LAST:COUNT",
    )
    told = "array of ids (default: by name); also --radii, --strengths, --velocities"
    for role in _ARRAYS:
        text = told if role == "ids" else argparse.SUPPRESS
        files.add_argument(f"--{role}", metavar="NAME", help=text)


def _find_view(options: Any, files: Any, kept: Resumption | None) -> tuple[Any, str]:
    """Returns the points in view and the up axis; a resumed run uses saved values."""
    if kept and kept.view:
        return numpy.array(kept.view[0]), str(kept.view[1])
    has_balls = options.preset in ("molecule", "grains") or options.probe is not None
    radii = options.radii or ("radius" if has_balls else None)
    held, up = find_view(files, radii)
    if kept:
        kept.view = [held.tolist(), up]
    return held, up
