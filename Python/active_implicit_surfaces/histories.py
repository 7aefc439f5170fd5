"""History of a skin (area, volume, pieces, events) as arrays, a plot or a table."""

from __future__ import annotations

import csv
import importlib
from collections.abc import Sequence
from contextlib import nullcontext, suppress
from pathlib import Path
from typing import Any

import numpy

from .file_names import replacing, suffix_of
from .messages import listening
from .runner import Sink

PLOT_SUFFIXES = (".png", ".svg", ".pdf")
_PLOTTED = ("Volume", "Area", "Components")


def history(surface: Any) -> dict[str, Any]:
    """Returns the history of a filter: for each column, an array with a value for each row.

    Parameters
    ----------
    surface : vtkActiveImplicitSurface, frames, morph or LiveSurface

    Returns
    -------
    dict of str to array
        The keys are Time, Area, Volume, Components, Voids, Event and more.
        ``pandas.DataFrame(history(surface))`` makes a table of pandas.

    Raises
    ------
    ValueError
        There is no history yet, or this is another rank than rank 0.
    TypeError
        `surface` is another object.

    Examples
    --------
    >>> import numpy
    >>> import active_implicit_surfaces as active
    >>> grid = numpy.stack(numpy.meshgrid(*3 * [numpy.arange(6.0)]), -1).reshape(-1, 3)
    >>> way = active.frames([grid, grid + 1], fps=10, particle_spacing=1)
    >>> skins = list(way)
    >>> active.history(way)["Time"]
    array([0. , 0.1])
    """
    surface = getattr(surface, "surface", surface)
    if not hasattr(surface, "GetHistory"):
        raise TypeError(
            f"An object of type {type(surface).__name__} has no history; give a "
            "vtkActiveImplicitSurface, or an object of frames, morph or LiveSurface."
        )
    with listening(surface) as heard:
        table = surface.GetHistory()
    heard.raise_error(ValueError)
    if table is None or table.GetNumberOfRows() == 0:
        raise ValueError(
            "There is no history; update the surface first. On several MPI ranks, only rank 0 has "
            "the history."
        )
    columns = [table.GetColumn(i) for i in range(table.GetNumberOfColumns())]
    rows = range(table.GetNumberOfRows())
    return {one.GetName(): numpy.array([one.GetValue(row) for row in rows]) for one in columns}


def plot_history(surface: Any, columns: Sequence[str] = _PLOTTED, axes: Any = None) -> Any:
    """Plots columns of a filter's history over time, and marks its events.

    Parameters
    ----------
    surface : vtkActiveImplicitSurface, frames, morph or LiveSurface
        A filter that has been updated, or an object that contains such a filter.
    columns : sequence of str
        Columns of the history: Substeps, MaxSpeed, Area, Volume, ActiveVoxels, Components, Voids,
        EulerCharacteristic, Outside. Default: Volume, Area, Components.
    axes : sequence of matplotlib axes, optional
        One for each column. Default: a new figure of matplotlib.

    Returns
    -------
    list of matplotlib axes
        One for each column.

    Raises
    ------
    ImportError
        No axes are given, and matplotlib is not installed.
    ValueError
        The history has no such column, there is no history, or the numbers of `columns` and `axes`
        differ.
    TypeError
        `surface` is another object.
    """
    held, columns = history(surface), [columns] if isinstance(columns, str) else columns
    if unknown := [name for name in columns if name not in held]:
        raise ValueError(f"The history has no column {unknown[0]!r}; it has {', '.join(held)}.")
    if axes is None:
        rows = _matplotlib("pyplot").subplots(len(columns), 1, sharex=True, squeeze=False)[1]
        axes = rows[:, 0]
    drawn = list(axes)
    if len(drawn) != len(columns):
        raise ValueError(
            f"There are {len(drawn)} axes for {len(columns)} columns; give as many axes as columns."
        )
    times = held["Time"]
    events = [(time, text) for time, text in zip(times, held["Event"]) if text]
    for place, name in zip(drawn, columns):
        place.plot(times, held[name])
        place.set_ylabel(name)
        for time, _ in events:
            place.axvline(time, linestyle=":", linewidth=0.8, color="gray")
    if drawn:
        for time, text in events:
            height = drawn[0].get_ylim()[1]
            drawn[0].annotate(text, (time, height), rotation=45, fontsize="small")
        drawn[-1].set_xlabel("Time")
    return drawn


class HistoryFile(Sink):
    """Writes a filter's history at the end of a run, also if the run fails.

    The file is a table (.csv), or a plot by matplotlib (.png, .svg, .pdf).
    """

    def __init__(self, path: Path, surface: Any) -> None:
        self._path, self._surface = path, surface
        is_plot = suffix_of(path) != ".csv"
        self._figure = is_plot and _matplotlib("figure").Figure((8.0, 8.0), layout="constrained")

    def __exit__(self, kind: Any, *_: Any) -> None:
        with suppress(ValueError) if kind else nullcontext():
            held = history(self._surface)
            with replacing(self._path) as temporary:
                if self._figure:
                    axes = self._figure.subplots(len(_PLOTTED), 1, sharex=True)
                    plot_history(self._surface, axes=axes)
                    self._figure.savefig(temporary)
                    return
                with temporary.open("w", newline="") as file:
                    rows = csv.writer(file)
                    rows.writerow(held)
                    rows.writerows(zip(*(column.tolist() for column in held.values())))


def _matplotlib(part: str) -> Any:
    try:
        return importlib.import_module("matplotlib." + part)
    except ImportError as error:
        raise ImportError(
            "Plots need matplotlib, which is not installed; install it (Debian: "
            "python3-matplotlib), give plot_history axes of your own, or write a .csv."
        ) from error
