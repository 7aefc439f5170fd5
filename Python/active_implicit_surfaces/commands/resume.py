"""Resumes an interrupted run from the filter's state and options, saved next to the skins."""

from __future__ import annotations

import json
import time
from contextlib import nullcontext, suppress
from pathlib import Path
from typing import Any

from .. import properties
from ..file_names import replacing, without_number
from ..messages import listening
from ..runner import Sink, Skins

_SECONDS_BETWEEN_STATES = 20.0


class Resumption(Sink):
    """State of a run, saved at most every 20 s; after bind(), a sink of the run.

    At the end of the run, the state is saved if the run has failed or is kept, else removed.

    - output (Path): name of the series of skins; the state is in hidden files of the same folder.
    - description (dict): options that the skins depend on; a run with other options cannot be
      resumed.
    - files (list of Path): last file read for each frame. Files of finished frames must not
      change, except that a single file of several frames may get more frames.

    Attributes:
    - view (list or None): points in view and up axis of pictures, saved to keep the camera when
      frames are added.
    """

    def __init__(self, output: Path, description: dict[str, Any], files: list[Path]) -> None:
        stem = without_number(output).stem
        self.state = output.with_name(f".{stem}.state.vdb")
        self.notes = output.with_name(f".{stem}.state.json")
        self.description = json.loads(json.dumps(description))
        self.view: list[Any] | None = None
        self._files = files
        self._saved = time.monotonic()
        self._way, self._is_kept, self._first, self._done = Skins(), False, 0, 0

    def load(self, surface: Any, times: list[float]) -> int:
        """Restores the filter's state; returns the number of finished frames, 0 without a state.

        Raises OSError if the state cannot be read; ValueError if the state belongs to another run.
        """
        if not self.state.exists() or not self.notes.exists():
            return 0
        try:
            notes = json.loads(self.notes.read_text(encoding="utf-8"))
            done, past, then = int(notes["done"]), [*notes["times"]], dict(notes["options"])
            files, view = [[*file] for file in notes["files"]], notes.get("view")
            # A preset chooses by the interval and spacing of the series, which may have grown.
            properties.put(surface, dict(notes["properties"]))
            if view:
                view = [[[float(x) for x in point] for point in view[0]], str(view[1])]
        except (ValueError, KeyError, TypeError, IndexError) as error:
            raise OSError(
                f"{self.notes} is damaged; remove the file to make all skins again."
            ) from error
        self._compare(then, past, times[:done])
        self._compare_files(files)
        with listening(surface) as heard:
            surface.LoadState(str(self.state))
        if heard.errors:  # without the first part, which the second says too, and the own advice
            said = heard.errors[0].partition(";")[0]
            said = said.removeprefix(f"No state of a surface can be loaded from {self.state}: ")
            raise OSError(f"{said}; run without --resume to make all skins again.")
        self.view = view
        return done

    def save(self, surface: Any, times: list[float], done: int, now: bool = False) -> None:
        """Saves the state after a frame; within 20 s of the last save, only if `now` is true."""
        if not now and time.monotonic() - self._saved < _SECONDS_BETWEEN_STATES:
            return
        before = self.notes.read_bytes() if self.notes.exists() else None
        self.notes.unlink(missing_ok=True)  # a state without notes is invalid
        with listening(surface) as heard:
            surface.SaveState(str(self.state))
        if heard.errors and before is not None:  # the previous state still exists
            self.notes.write_bytes(before)
        heard.raise_error(OSError)
        notes = {
            "done": done,
            "times": times[:done],
            "options": self.description,
            "files": [_mark(file) for file in self._files[:done]],
            "properties": properties.values(surface),
            "view": self.view,
        }
        with replacing(self.notes) as temporary:
            temporary.write_text(json.dumps(notes), encoding="utf-8")
        self._saved = time.monotonic()

    def bind(self, way: Skins, names: list[Path], is_kept: bool) -> int:
        """Binds the state to a run; returns the first frame to make.

        If `is_kept` is False, removes the saved state and returns 0.

        Raises the errors of load(), and OSError if the skin of an earlier frame is missing.
        """
        self._way, self._is_kept = way, is_kept
        if not is_kept:
            self.forget()
            return 0
        self._first = self._done = self.load(way.surface, way.times)
        missing = [name for name in names[: self._first] if not name.exists()]
        if missing:
            raise OSError(f"{missing[0]} is missing; run without --resume to make all skins again.")
        return self._first

    def add(self, step: int, data: Any) -> None:
        self._done = step + 1
        self.save(self._way.surface, self._way.times, self._done)

    def __exit__(self, kind: Any, *_: Any) -> None:
        if kind is None and not self._is_kept:
            self.forget()
        elif self._done > self._first:  # else the state has been saved
            # After an error the filter is still at the last finished frame. An OSError of saving
            # must not replace the first error.
            with nullcontext() if kind is None else suppress(OSError):
                self.save(self._way.surface, self._way.times, self._done, now=True)

    def forget(self) -> None:
        """Removes the state."""
        self.notes.unlink(missing_ok=True)
        self.state.unlink(missing_ok=True)

    def _compare(self, then: dict[str, Any], past: list[float], times: list[float]) -> None:
        for name in sorted({*then, *self.description}):
            before, now = then.get(name), self.description.get(name)
            if before != now:
                raise ValueError(
                    f"The skins so far were made {_with(name, before)}, but further skins would be "
                    f"made {_with(name, now)}; run without --resume to make all skins again."
                )
        if past != times:
            raise ValueError(
                "The times of the frames differ from those of the skins so far; run without "
                "--resume to make all skins again."
            )

    def _compare_files(self, then: list[list[Any]]) -> None:
        may_grow = len({*self._files}) == 1 < len(self._files)  # one file of several frames
        for before, file in zip(then, self._files):
            now = _mark(file)
            if before != now and not (may_grow and before[0] == now[0]):
                what = "has since changed" if before[0] == now[0] else f"is in place of {before[0]}"
                raise ValueError(
                    f"The skins so far were made from other files: {now[0]} {what}; run without "
                    "--resume to make all skins again."
                )


def _mark(file: Path) -> list[Any]:
    """Returns [name, size, mtime in ns]."""
    own = file.stat()
    return [str(file), own.st_size, own.st_mtime_ns]


def _with(name: str, value: Any) -> str:
    if value is None:
        return f"without {name}"
    if isinstance(value, list):  # frames are FIRST:LAST:STEP
        parts = ["" if one is None else str(one) for one in value]
        value = (":" if name == "frames" else " ").join(parts)
    return f"with {name} {value}"
