"""What VTK's objects say, as exceptions and warnings of Python."""

from __future__ import annotations

import re
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any


class ActiveSurfaceWarning(UserWarning):
    """What the filter warns of, as its sentence."""


class Messages:
    """The sentences that an algorithm says while it is listened to."""

    def __init__(self) -> None:
        self.errors: list[str] = []
        self.warnings: list[str] = []

    def raise_error(self, kind: type[Exception]) -> None:
        """Raises the first error, if there was one."""
        if self.errors:
            raise kind(self.errors[0])


def plain(text: str) -> str:
    """The sentence of a message, without the place in the code and the object's address."""
    text = re.sub(r"^(ERROR|Warning): In .*?, line \d+\n", "", text)
    return " ".join(re.sub(r"^\S+ \((0x)?[0-9a-fA-F]+\): ", "", text).split())


@contextmanager
def listening(*algorithms: Any) -> Iterator[Messages]:
    """Collects the errors and warnings of algorithms, which then are not printed."""
    heard, observers = Messages(), []
    for algorithm in algorithms:
        for event, said in (("ErrorEvent", heard.errors), ("WarningEvent", heard.warnings)):
            observers.append((algorithm, algorithm.AddObserver(event, _collector(said))))
        if hasattr(algorithm, "GetExecutive"):
            # What the pipeline adds to an error does not say more.
            executive = algorithm.GetExecutive()
            observers.append((executive, executive.AddObserver("ErrorEvent", lambda *_: None)))
    try:
        yield heard
    finally:
        for thing, observer in observers:
            thing.RemoveObserver(observer)


def warn_all(messages: list[str]) -> None:
    """Passes warnings of the filter on to Python's."""
    for text in messages:
        warnings.warn(text, ActiveSurfaceWarning, stacklevel=3)


def _collector(said: list[str]) -> Callable[..., None]:
    def collect(caller: Any, event: str, text: str) -> None:
        said.append(plain(text))

    collect.CallDataType = "string0"  # type: ignore[attr-defined]
    return collect
