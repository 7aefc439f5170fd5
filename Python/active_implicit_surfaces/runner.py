"""Runs a loop over frames; passes each frame to sinks, such as files, a film or a progress bar."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any, NamedTuple

from .data_objects import copy_of, like
from .file_names import write_index
from .messages import listening, warn


class Frame(NamedTuple):
    """Named tuple of a time and the skin at this time."""

    time: float
    skin: Any


class Sink:
    """Receiver of the frames of a run; a context manager, which exits at the end of the run."""

    def __enter__(self) -> Any:
        return self

    def __exit__(self, kind: Any, *_: Any) -> None:
        """Finishes the output; `kind` is None unless the run has failed."""

    def add(self, step: int, data: Any) -> None:
        """Receives the data of a step."""


class FileSeries(Sink):
    """Writes a file for each frame, and, after a run without error, the index if one is given.

    - index (Path, optional): a .pvd or .series file that lists `names` with their `times`.
    """

    def __init__(
        self,
        names: list[Path],
        write: Callable[[Path, Any], Any],
        index: Path | None = None,
        times: Sequence[float] = (),
    ) -> None:
        self.names, self._write, self._index, self._times = names, write, index, times

    def __exit__(self, kind: Any, *_: Any) -> None:
        if kind is None and self._index:
            write_index(self._index, self.names, self._times)

    def add(self, step: int, data: Any) -> None:
        self._write(self.names[step], data)


def run(make: Callable[[int], Any], steps: Iterable[int], sinks: Iterable[Sink] = ()) -> None:
    """Makes the data of each step and passes them to the sinks, in order."""
    with ExitStack() as stack:
        own = [stack.enter_context(sink) for sink in sinks]
        for step in steps:
            data = make(step)
            for sink in own:
                sink.add(step, data)


class Skins:
    """Iterator over the skins of a filter at some times."""

    surface: Any
    times: list[float]
    source: Any = None
    _example: Any = None
    _progress: Callable[[int, int], None] | None = None
    _loop: Iterator[Frame] | None = None

    def __len__(self) -> int:
        return len(self.times)

    def __next__(self) -> Frame:
        """Returns the next frame; next() has its own position, independent of for loops."""
        if self._loop is None:
            self._loop = iter(self)
        return next(self._loop)

    def __iter__(self) -> Iterator[Frame]:
        for step, time in enumerate(self.times):
            skin = copy_of(self.make(step))
            if self._progress:
                self._progress(step + 1, len(self))
            yield Frame(time, like(self._example, skin))

    def make(self, step: int) -> Any:
        """Returns the filter's own output at a step; the next step overwrites this output."""
        update(self.surface, self.times[step], self.source)
        return self.surface.GetOutput()


def check_mode(surface: Any, count: int) -> None:
    """Raises ValueError for more than one frame in the mode EQUILIBRIUM, which has no time."""
    if count > 1 and surface.GetEvolutionMode() == surface.EQUILIBRIUM:
        raise ValueError(
            f"evolution_mode equilibrium makes one skin, but there are {count} frames; leave "
            "evolution_mode out, or, except in a morph, give one frame."
        )


def update(surface: Any, time: float, source: Any = None) -> None:
    """Updates a filter to a time.

    Raises the exception of the source, or ValueError if the filter reports an error.
    """
    with listening(*filter(None, (surface, source))) as heard:
        surface.UpdateTimeStep(time)
    if source is not None and source.failure is not None:
        raise source.failure
    heard.raise_error(ValueError)
    warn(*heard.warnings)
