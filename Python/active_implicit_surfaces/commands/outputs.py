"""Outputs of the commands skin and morph: skins, their index, films, histories and plots."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Callable, Iterable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

from ..file_names import (
    INDEX_SUFFIXES,
    check_distinct,
    labelled,
    make_folder_of,
    names_of,
    suffix_of,
    without_number,
)
from ..histories import PLOT_SUFFIXES, HistoryFile
from ..runner import FileSeries, Sink, Skins
from ..skin_files import SKIN_SUFFIXES, check_suffix, write_mesh
from ..usd_film import USD_SUFFIXES, UsdFilm, check_usd
from .options import PICTURE_SIZE, Parser


def add_output_options(parser: Parser, default: str) -> None:
    """Adds -o and --render."""
    parser.add_argument(
        "-o",
        "--output",
        metavar="NAME",
        help=f"files of skins (#### is the frame number): {', '.join(SKIN_SUFFIXES)}; or one "
        f"file of all frames: .usdc, .usda (default: {default}; with --render: none)",
    )
    parser.add_argument(
        "--render",
        metavar="FILM",
        help="pictures: film.mp4, film.ogv, frame.####.png or frame.####.exr",
    )


def each_label(
    options: Namespace, find: Callable[[], list[int]], is_series: bool, default: str
) -> Iterator[Namespace]:
    """Yields for each label the options of a run, with names of outputs for this label.

    Without labels, yields the options of one run. `find` returns the labels for --label all;
    `default` is the output's name if neither -o nor --render is given. Raises OSError if `find`
    returns no label.
    """
    if not (options.output or getattr(options, "render", None)):
        options.output = default
    if options.labels is None:
        yield Namespace(**vars(options), label=None)
        return
    labels = find() if options.labels == "all" else options.labels
    if not labels:
        raise OSError(
            "--label all has found no label. active-surface skin searches the first, middle and "
            "last frame, convert the first frame, and morph the file FIRST. The value 0 in an "
            "image is no label. Choose other files, or, in skin, give numbers, such as --label 3."
        )
    for label in labels:
        own = Namespace(**vars(options), label=label)
        for key in ("output", "render", "index", "history", "plot"):
            name = getattr(own, key, None)
            is_one = not is_series or suffix_of(name or "") in USD_SUFFIXES
            if name and name != "none":
                setattr(own, key, str(labelled(name, label, not is_one, len(labels) > 1)))
        yield own


class Outputs:
    """File names of a run's outputs, and the sinks that write them.

    Attributes:
    - output (Path or None): name of the skins, from -o or the default; None if --render is given
      without -o.
    - names (list of Path): file of each frame. The list is empty before plan() is called, if
      `output` is None, and if `output` is a .usdc or .usda, which has all frames.
    """

    def __init__(self, parser: Parser, options: Any) -> None:
        self.options, self.numbers, self.names = options, list[int](), list[Path]()
        for key in ("output", "render", "index", "history", "plot"):
            if getattr(options, key, None):
                setattr(options, key, str(Path(getattr(options, key)).expanduser()))
        self.output = Path(options.output) if options.output else None
        self.render = Path(options.render) if options.render else None
        index = getattr(options, "index", None)
        self.is_usd = bool(self.output) and suffix_of(str(self.output)) in USD_SUFFIXES
        if self.is_usd and (index or getattr(options, "resume", False)):
            option = "--index" if index else "--resume"
            parser.error(
                f"{option} has no effect on {self.output}, one file of all frames; leave out "
                f"{option}"
            )
        try:
            if self.output:
                check_suffix(self.output, (*SKIN_SUFFIXES, *USD_SUFFIXES), "skins")
            if self.render:
                from ..film import FILM_SUFFIXES

                check_suffix(self.render, FILM_SUFFIXES, "films")
            if plot := getattr(options, "plot", None):
                check_suffix(Path(plot), PLOT_SUFFIXES, "plots")
            if history := getattr(options, "history", None):
                check_suffix(Path(history), (".csv",), "histories")
        except ValueError as error:
            parser.error(str(error))
        if index not in (None, "none") and suffix_of(index) not in INDEX_SUFFIXES:
            parser.error(
                f"--index has to be none, or a name with extension .pvd or .series, not {index}"
            )

    def plan(self, numbers: list[int], inputs: Iterable[Path]) -> None:
        """Chooses the names of the numbered frames, and makes the folders of all outputs.

        Raises OSError if a file of the skins is one of the `inputs`, or a folder cannot be made.
        """
        self.numbers = numbers
        self.names = names_of(self.output, numbers) if self.output and not self.is_usd else []
        if self.is_usd and self.output:
            check_usd(self.output)
        check_distinct(inputs, [self.output] if self.is_usd and self.output else self.names)
        more = [getattr(self.options, key, None) for key in ("index", "history", "plot")]
        for name in filter(None, (self.output, self.render, *more)):
            make_folder_of(Path(name))

    def sinks(self, way: Skins, find_view: Callable[[], tuple[Any, str]], color: str) -> list[Sink]:
        """Returns the sinks of a run; `find_view` returns the points in view and the up axis."""
        view, found = cache(find_view), list[Sink]()

        def up() -> str:
            return str(self.options.up or view()[1])

        def write(path: Path, skin: Any) -> None:
            axis = up() if suffix_of(path) == ".glb" else "y"
            write_mesh(path, skin, way.surface.GetOutputPort(), axis)

        if self.is_usd and self.output:
            way.surface.ComputeVelocityOn()
            scale = way.surface.GetTimeScale()
            found.append(UsdFilm(self.output, way.times, self._fps(), up(), scale))
        elif self.output:
            found.append(FileSeries(self.names, write, self._index(self.output), way.times))
        if self.render:
            found.append(self._film(self.render, way, view()[0], up(), color))
        for key in ("history", "plot"):
            if name := getattr(self.options, key, None):
                found.append(HistoryFile(Path(name), way.surface))
        return found

    def _film(self, path: Path, way: Skins, held: Any, up: str, color: str) -> Sink:
        from ..film import Film, check_film
        from ..scene import COLORS, Scene

        check_film(path)
        is_exr = suffix_of(path) == ".exr"
        if is_exr:
            way.surface.ComputeVelocityOn()
        size, ground = self.options.size or PICTURE_SIZE, not self.options.no_ground
        scene = Scene(held, size, up, COLORS[color], soft=not is_exr, ground=ground)
        scale = way.surface.GetTimeScale()
        return Film(path, scene, way.times, self.numbers, self._fps(), scale)

    def _fps(self) -> float | None:
        return getattr(self.options, "output_fps", None) or getattr(self.options, "fps", None)

    def _index(self, output: Path) -> Path | None:
        given = getattr(self.options, "index", None)
        if given == "none" or not (given or len(self.names) > 1):
            return None
        plain = without_number(output)
        usual = plain.with_suffix(".pvd") if plain.suffix == ".vtp" else Path(f"{plain}.series")
        return Path(given) if given else usual
