"""What has happened to a skin, as a plot or a table."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from contextlib import nullcontext, suppress
from pathlib import Path
from typing import Any

from .file_names import replacing
from .messages import listening
from .runner import Sink


def plot_history(
    surface: Any, columns: Sequence[str] = ("Volume", "Area", "Components"), axes: Any = None
) -> Any:
    """Plots columns of a filter's history over time, and marks its events.

    Parameters
    ----------
    surface : vtkActiveImplicitSurface, frames, morph or LiveSurface
        What has a history so far.
    columns : sequence of str
        Columns of the history: Substeps, MaxSpeed, Area, Volume, ActiveVoxels, Components, Voids,
        EulerCharacteristic, Outside. Default: Volume, Area, Components.
    axes : matplotlib axes, optional
        One for each column. Default: a new figure of matplotlib.

    Returns
    -------
    list of axes

    Raises
    ------
    ImportError
        No axes were given, and matplotlib is not there.
    ValueError
        There is no such column, or no history.
    """
    table = _history_of(getattr(surface, "surface", surface))
    times = _column(table, "Time")
    values = [_column(table, name) for name in columns]
    drawn = _new_axes(len(columns)) if axes is None else list(axes)
    if len(drawn) != len(columns):
        raise ValueError(f"There are {len(drawn)} axes for {len(columns)} columns.")
    events = [(time, text) for time, text in zip(times, _column(table, "Event")) if text]
    for place, name, numbers in zip(drawn, columns, values):
        place.plot(times, numbers)
        place.set_ylabel(name)
        for time, _ in events:
            place.axvline(time, linestyle=":", linewidth=0.8, color="gray")
    if drawn:
        for time, text in events:
            height = drawn[0].get_ylim()[1]
            drawn[0].annotate(text, (time, height), rotation=45, fontsize="small")
        drawn[-1].set_xlabel("Time")
    return drawn


def _history_of(surface: Any) -> Any:
    with listening(surface) as heard:
        table = surface.GetHistory()
    heard.raise_error(ValueError)
    if table is None or table.GetNumberOfRows() == 0:
        raise ValueError("There is no history yet; update the surface first.")
    return table


def _column(table: Any, name: str) -> list[Any]:
    array = table.GetColumnByName(name)
    if array is None:
        names = ", ".join(table.GetColumnName(i) for i in range(table.GetNumberOfColumns()))
        raise ValueError(f"The history has no column {name!r}; it has {names}.")
    return [array.GetValue(row) for row in range(table.GetNumberOfRows())]


class HistoryFile(Sink):
    """Writes a filter's history as a .csv at the end of a run, also of one that fails."""

    def __init__(self, path: Path, surface: Any) -> None:
        self._path, self._surface = path, surface

    def __exit__(self, kind: Any, *_: Any) -> None:
        with suppress(ValueError) if kind else nullcontext():
            table = _history_of(self._surface)
            names = [table.GetColumnName(i) for i in range(table.GetNumberOfColumns())]
            with replacing(self._path) as temporary, temporary.open("w", newline="") as file:
                rows = csv.writer(file)
                rows.writerow(names)
                rows.writerows(zip(*(_column(table, name) for name in names)))


def _new_axes(count: int) -> list[Any]:
    try:
        from matplotlib import pyplot
    except ImportError as error:
        raise ImportError(
            "plot_history draws with matplotlib, which is not installed (Debian: "
            "python3-matplotlib); or give it axes of your own."
        ) from error
    _, axes = pyplot.subplots(count, 1, sharex=True, squeeze=False)
    return list(axes[:, 0])
