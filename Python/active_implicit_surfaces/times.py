"""Times of frames, given or computed from frames per second."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

FRAMES_PER_SECOND = 25.0  # default without other information


def check_times(times: Iterable[float]) -> list[float]:
    """Returns the times as a list.

    Raises TypeError if the times are no numbers; ValueError if there are no times, or the times are
    not finite or do not increase.
    """
    own = _numbers_in(times)
    if not own:
        raise ValueError("There are no frames or no times; give at least one frame.")
    do_increase = all(after > before for before, after in zip(own, own[1:]))
    if not do_increase or not all(map(math.isfinite, own)):
        raise ValueError(
            "Times have to be finite, and have to increase from frame to frame; sort the frames by "
            "time, and remove repeated, infinite and NaN times."
        )
    return own


def check_number(name: str, value: Any) -> None:
    """Raises TypeError, with the name of the keyword, if a value is no number."""
    try:
        if isinstance(value, str):
            raise TypeError
        float(value)
    except (TypeError, ValueError, OverflowError) as error:
        raise TypeError(f"{name} has to be a number, not {value!r}.") from error


def one_for_each(times: Any, count: int) -> list[float]:
    """Returns the times as a list.

    Raises TypeError if the times are no numbers, ValueError if there are not `count` times.
    """
    own = _numbers_in(times)
    if len(own) != count:
        raise ValueError(
            f"The number of times is {len(own)}, but that of frames is {count}; give one time for "
            "each frame."
        )
    return own


def _numbers_in(times: Any) -> list[float]:
    try:
        return [float(time) for time in times]
    except (TypeError, ValueError) as error:
        raise TypeError(f"times has to be a sequence of numbers, not {times!r}.") from error


def times_at(places: Iterable[float], fps: float | None) -> list[float]:
    """Converts positions counted in frames to times; the rate is `fps`, or 25 if `fps` is None."""
    rate = FRAMES_PER_SECOND if fps is None else check_rate(fps)
    return [place / rate for place in places]


def check_rate(fps: float) -> float:
    """Returns `fps`.

    Raises TypeError if `fps` is no number, ValueError unless it is finite and more than 0.
    """
    check_number("fps", fps)
    if not 0 < fps < float("inf"):
        raise ValueError(f"Frames per second have to be finite and more than 0, not {fps:g}.")
    return fps


def places_of(numbers: Sequence[float]) -> list[float]:
    """Converts frame numbers to positions: the first is 0, the least difference is 1."""
    step = min((after - before for before, after in zip(numbers, numbers[1:])), default=1)
    return [round((number - numbers[0]) / step, 6) for number in numbers]


def times_between(times: Sequence[float], fps: float) -> list[float]:
    """Returns times at intervals of 1/fps, from the first to at most the last given time."""
    count = int((times[-1] - times[0]) * check_rate(fps) * (1.0 + 1e-9) + 1e-6)
    return [min(times[0] + i / fps, times[-1]) for i in range(count + 1)]


def rate_of(times: Sequence[float]) -> float:
    """Returns the mean frame rate of the times if it is 1 to 240, else 25."""
    if len(times) < 2:
        return FRAMES_PER_SECOND
    rate = (len(times) - 1) / (times[-1] - times[0])
    return rate if 1.0 <= rate <= 240.0 else FRAMES_PER_SECOND
