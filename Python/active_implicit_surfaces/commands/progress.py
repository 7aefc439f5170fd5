"""Progress of a series: a bar on a terminal, else a line from time to time."""

from __future__ import annotations

import sys
import time
from typing import Any

from ..runner import Sink

_BAR, _SECONDS_BETWEEN_LINES = 30, 10.0


class Progress(Sink):
    """Prints to `stream` (default: stderr) the number of finished frames, speed and time left."""

    def __init__(self, total: int, done: int = 0, quiet: bool = False, stream: Any = None) -> None:
        self.stream = stream or sys.stderr
        self.total, self.first, self.done, self.quiet = total, done, done, quiet
        self.is_terminal = hasattr(self.stream, "isatty") and self.stream.isatty()
        self.start = self.said = time.monotonic()

    def add(self, step: int, data: Any = None) -> None:
        """Counts the frames up to this step as finished."""
        self.done = step + 1
        now = time.monotonic()
        if self.quiet:
            return
        if self.is_terminal:
            filled = _BAR * self.done // max(1, self.total)
            bar = "#" * filled + "-" * (_BAR - filled)
            self.stream.write(f"\r[{bar}] {self.text(now)}\x1b[K")
        elif now - self.said >= _SECONDS_BETWEEN_LINES:
            self.stream.write(self.text(now) + "\n")
            self.said = now
        self.stream.flush()

    def text(self, now: float) -> str:
        """Returns a text such as "12 of 41 frames, 3.2 frames/s, 0:09 left"."""
        count = self.done - self.first
        rate = count / max(now - self.start, 1e-9)
        words = f"{self.done} of {self.total} frames, {rate:.3g} frames/s"
        if self.done < self.total and count:
            words += f", {_clock((self.total - self.done) / rate)} left"
        return words

    def __exit__(self, kind: Any, *_: Any) -> None:
        if kind is None and not self.quiet:
            text = self.text(time.monotonic())
            self.stream.write(f"\r{text}\x1b[K\n" if self.is_terminal else text + "\n")
            self.stream.flush()


def _clock(seconds: float) -> str:
    minutes, left = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{left:02}" if hours else f"{minutes}:{left:02}"
