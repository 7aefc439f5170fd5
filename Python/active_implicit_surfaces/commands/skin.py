"""active-surface skin: skins over a series of particle files."""

from __future__ import annotations

import argparse
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import Any

import numpy

from .. import vtkActiveImplicitSurface
from ..api import configure, update
from ..file_names import (
    INDEX_SUFFIXES,
    check_distinct,
    has_number,
    make_folder_of,
    numbered,
    suffix_of,
    without_number,
    write_index,
)
from ..particle_files import PARTICLE_SUFFIXES, open_particles
from ..presets import PRESETS
from ..series import TemporalSource
from ..skin_files import SKIN_SUFFIXES, check_suffix, write_mesh
from .effects import check_effects
from .options import (
    MAIN_PROPERTIES,
    PICTURE_SIZE,
    Parser,
    add_film_option,
    add_help,
    add_picture_options,
    add_property_options,
    positive,
    preset_help,
    properties_of,
    times_list,
)
from .progress import Progress
from .resume import Resumption
from .view import find_view

_ARRAYS = ("ids", "radii", "strengths", "velocities")


def run(arguments: list[str]) -> int:
    """Runs the command; returns its exit code."""
    parser = make_parser()
    options = parser.parse_args(arguments)
    chosen = properties_of(options, parser)
    _check_names(options, parser)
    files = open_particles(options.files, fps=options.fps, times=options.times)
    job = _Job(options, files, chosen)
    facts = ["particles", *(["series"] if len(job.times) > 1 else [])]
    check_effects(parser, options, job.output, facts, job.surface)
    job.run()
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
    parser.add_argument(
        "-o",
        "--output",
        metavar="NAME",
        help=f"name of the skins, #### for the number: {', '.join(SKIN_SUFFIXES)} "
        "(default: skin_####.vtp, and none with --render alone)",
    )
    add_film_option(parser)
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


def _check_names(options: Any, parser: Parser) -> None:
    try:
        if options.output:
            check_suffix(Path(options.output), SKIN_SUFFIXES, "skins")
        if options.render:
            from ..film import FILM_SUFFIXES

            check_suffix(Path(options.render), FILM_SUFFIXES, "films")
    except ValueError as error:
        parser.error(str(error))
    is_index = not options.index or suffix_of(options.index) in INDEX_SUFFIXES
    if not is_index and options.index != "none":
        parser.error(f"an index is a .pvd or a .series, or none, not {options.index}")
    if options.resume and options.render and suffix_of(options.render) in (".mp4", ".ogv"):
        parser.error("a film cannot go on where it was cut off; render to frame.####.png")
    if options.resume and options.render and not options.output:
        parser.error("--resume goes on with skins; say their name, -o skin_####.vtp")


class _Job:
    """One run over a series."""

    def __init__(self, options: Any, files: Any, chosen: dict[str, Any]) -> None:
        self.options, self.files = options, files
        self.times = files.times
        self.output = _output_name(options)
        if self.output:
            check_distinct(files.files, map(self.name_of, range(len(self.times))))
        for name in (self.output, options.render and Path(options.render)):
            if name:
                make_folder_of(name)
        self.source = TemporalSource(files.load, self.times, any_order=True)
        self.surface = vtkActiveImplicitSurface()
        self.surface.SetInputConnection(self.source.GetOutputPort())
        arrays = {role: getattr(options, role) for role in _ARRAYS if getattr(options, role)}
        configure(self.surface, self.source, preset=options.preset, arrays=arrays, **chosen)
        if options.render and suffix_of(options.render) == ".exr":
            self.surface.ComputeVelocityOn()
        described = {"preset": options.preset, **arrays, **chosen}
        self.resumption = Resumption(self.output, described, files.names) if self.output else None

    def run(self) -> None:
        first = 0
        if self.resumption and self.options.resume:
            first = self._find_first()
        elif self.resumption:
            self.resumption.forget()
        progress = Progress(len(self.times), first, self.options.quiet)
        with ExitStack() as stack:
            film = stack.enter_context(self._film()) if self.options.render else None
            done = first
            try:
                for step in range(first, len(self.times)):
                    self._make(step, film)
                    done = step + 1
                    progress(done)
            except BaseException:
                self._keep_state(done, first)
                raise
        self._finish(done, first)
        progress.finish()

    def _find_first(self) -> int:
        """The first frame that is to be made; the filter has the state before it."""
        assert self.resumption is not None
        first = self.resumption.load(self.surface, self.times)
        missing = [step for step in range(first) if not self.name_of(step).exists()]
        if missing:
            raise OSError(
                f"{self.name_of(missing[0])} is no longer there; run without --resume to make all "
                "skins anew."
            )
        return first

    def name_of(self, step: int) -> Path:
        assert self.output is not None
        is_series = len(self.times) > 1 or has_number(self.output)
        return numbered(self.output, self.files.numbers[step]) if is_series else self.output

    def _make(self, step: int, film: Any) -> None:
        update(self.surface, self.times[step], self.source)
        skin = self.surface.GetOutput()
        if self.output:
            write_mesh(self.name_of(step), skin, self.surface.GetOutputPort(), self._up())
        if film:
            film.add(step, skin, self.files.numbers[step])
        if self.resumption:
            self.resumption.save(self.surface, self.times, step + 1)

    def _keep_state(self, done: int, first: int) -> None:
        # After an error the filter is still at the last frame that it has finished.
        if self.resumption and done > first:
            with suppress(OSError):  # the first error is the one to tell
                self.resumption.save(self.surface, self.times, done, now=True)

    def _finish(self, done: int, first: int) -> None:
        if not (self.output and self.resumption):
            return
        if not self.options.resume:
            self.resumption.forget()
        elif done > first:  # else the state is there already
            self.resumption.save(self.surface, self.times, done, now=True)
        if (len(self.times) > 1 or self.options.index) and self.options.index != "none":
            names = [self.name_of(step) for step in range(len(self.times))]
            write_index(_index_name(self.options.index, self.output), names, self.times)

    def _film(self) -> Any:
        from ..film import Film, check_film
        from ..scene import COLORS, Scene

        path = Path(self.options.render)
        check_film(path, len(self.times))
        held, up = self._find_view()
        scene = Scene(
            held,
            self.options.size or PICTURE_SIZE,
            self.options.up or up,
            COLORS[self.options.preset or "water"],
            soft=suffix_of(path) != ".exr",
            ground=not self.options.no_ground,
        )
        return Film(path, scene, self.times, self.options.fps)

    def _up(self) -> str:
        """The axis of the data that is up in a .glb, as it is in pictures."""
        assert self.output is not None
        return "y" if suffix_of(self.output) != ".glb" else self.options.up or self._find_view()[1]

    def _find_view(self) -> tuple[Any, str]:
        """What the camera holds, and the axis that is up; of a run that goes on, as before."""
        kept = self.resumption.view if self.resumption else None
        if kept:
            return numpy.array(kept[0]), str(kept[1])
        reaches = "reach" if self.options.preset == "molecule" else self.options.radii
        held, up = find_view(self.files, reaches, self.options.ids, self.options.velocities)
        if self.resumption:
            self.resumption.view = [held.tolist(), up]
        return held, up


def _output_name(options: Any) -> Path | None:
    if options.output:
        return Path(options.output)
    return None if options.render else Path("skin_####.vtp")


def _index_name(given: str | None, output: Path) -> Path:
    if given:
        return Path(given)
    plain = without_number(output)
    return plain.with_suffix(".pvd") if plain.suffix == ".vtp" else Path(f"{plain}.series")
