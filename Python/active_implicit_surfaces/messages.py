"""Converts messages of VTK's objects to exceptions and warnings of Python."""

from __future__ import annotations

import re
import warnings
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import Any

from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow


class ActiveSurfaceWarning(UserWarning):
    """Warning of the filter or of a function of this package."""


class Messages:
    """Error and warning texts that `listening` has collected."""

    def __init__(self) -> None:
        self.errors: list[str] = []
        self.warnings: list[str] = []

    def raise_error(self, kind: type[Exception]) -> None:
        """Raises the first error text, if any, as an exception of `kind`."""
        if self.errors:
            raise kind(self.errors[0])


def plain(text: str) -> str:
    """Returns the text of a VTK message without source line and object address."""
    text = re.sub(r"^\s*(ERROR|Warning|Generic Warning): In .*?, line \d+\n", "", text)
    return " ".join(re.sub(r"^\S+ \((0x)?[0-9a-fA-F]+\): ", "", text).split())


@contextmanager
def listening(*algorithms: Any) -> Iterator[Messages]:
    """Collects the errors and warnings of algorithms instead of printing them."""
    heard, observers = Messages(), []
    for algorithm in algorithms:
        for event, said in (("ErrorEvent", heard.errors), ("WarningEvent", heard.warnings)):
            observers.append((algorithm, algorithm.AddObserver(event, _collector(said))))
        if hasattr(algorithm, "GetExecutive"):
            # Errors of the executive only report that the algorithm failed.
            executive = algorithm.GetExecutive()
            observers.append((executive, executive.AddObserver("ErrorEvent", lambda *_: None)))
    try:
        yield heard
    finally:
        for thing, observer in observers:
            thing.RemoveObserver(observer)


class quiet:
    """Collects messages of VTK's readers, parsers and writers instead of printing them."""

    def __enter__(self) -> quiet:
        self._shown = vtkOutputWindow.GetInstance()
        self._verbosity = vtkLogger.GetCurrentVerbosityCutoff()
        self._window = vtkStringOutputWindow()
        vtkOutputWindow.SetInstance(self._window)
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
        return self

    def __exit__(self, *_: Any) -> None:
        vtkOutputWindow.SetInstance(self._shown)
        vtkLogger.SetStderrVerbosity(self._verbosity)

    @property
    def errors(self) -> list[str]:
        """Returns the error texts collected so far."""
        said = self._window.GetOutput() or ""
        text = said.decode("latin-1") if isinstance(said, bytes) else said  # bytes: no valid UTF-8
        parts = re.split(r"\n(?=ERROR: |Warning: |Generic Warning: )", text)
        return [plain(part) for part in parts if part.startswith("ERROR: ")]


def few(words: Iterable[Any], most: int = 8) -> str:
    """Joins the first words or numbers as "a, b, c ..."."""
    listed = [str(word) for word in words]
    return ", ".join(listed[:most]) + " ..." * (len(listed) > most)


def warn(*messages: str) -> None:
    """Issues each text as an ActiveSurfaceWarning."""
    for text in messages:
        warnings.warn(text, ActiveSurfaceWarning, stacklevel=3)


def _collector(said: list[str]) -> Callable[..., None]:
    def collect(caller: Any, event: str, text: str | None) -> None:
        if text:  # readers forward another reader's message without text
            said.append(plain(text))

    collect.CallDataType = "string0"  # type: ignore[attr-defined]
    return collect
