"""Sources of a VTK pipeline for particles over time.

>>> import numpy
>>> from active_implicit_surfaces import ParticleSeries, vtkActiveImplicitSurface
>>> grid = numpy.stack(numpy.meshgrid(*3 * [numpy.arange(6.0)]), -1).reshape(-1, 3)
>>> source = ParticleSeries(lambda time: grid + [time, 0, 0], times=[0, 0.5, 1])
>>> surface = vtkActiveImplicitSurface()
>>> surface.SetInputConnection(source.GetOutputPort())
>>> surface.SetParticleSpacing(1)
>>> surface.UpdateTimeStep(1)
1
>>> round(surface.GetOutput().GetCenter()[0], 1)
3.5
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

from .choice import choose, conditions, note_once, without_small_pieces
from .contours import converter_of_series
from .data_objects import as_particles, is_vtk
from .particle_files import open_particles
from .times import check_times, one_for_each, times_at

_ROUNDING = 1e-6  # tolerance before a number of particles is rounded up


class TemporalSource(VTKPythonAlgorithmBase):  # type: ignore[misc]
    """VTK source whose output at time step i is the result of a function of i.

    Parameters
    ----------
    load : callable(int)
        Returns the data of a step: a vtkDataObject of `output_type`, or particles in a form that
        `as_particles` accepts. The data of two steps are cached.
    times : sequence of float
        Increasing times [time].
    output_type : str
        VTK class of the data. Default: "vtkPolyData".
    any_order : bool
        True if `load` may be called for the middle and last step before the steps in between.
        Default: False.

    Attributes
    ----------
    failure : Exception or None
        Exception of `load` in the last update; the output is then empty.
    """

    def __init__(
        self,
        load: Callable[[int], Any],
        times: Sequence[float],
        output_type: str = "vtkPolyData",
        *,
        any_order: bool = False,
    ) -> None:
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType=output_type)
        self.times = check_times(times)
        self.failure: Exception | None = None
        self._load = load
        self._kept: dict[int, Any] = {}
        self._first: int | None = None  # first step with points
        self._output_type = output_type
        self._any_order = any_order
        self._whole: TemporalSource | None = None

    def frame(self, step: int) -> Any:
        """Returns the data of a step, as a vtkDataObject."""
        if step not in self._kept:
            data = self._read(step)
            for old in sorted(self._kept)[:-1]:
                del self._kept[old]
            self._kept[step] = data
        return self._kept[step]

    def _read(self, step: int) -> Any:
        data = self._load(step)
        return data if is_vtk(data) and data.IsA(self._output_type) else as_particles(data)

    def frames_that_tell(self) -> list[Any]:
        """Returns the first frame with points; with `any_order`, also the middle and last frame.

        A middle or last frame is left out if it is not later than the first, or cannot be loaded.
        """
        if self._whole:
            return self._whole.frames_that_tell()
        first, last = self.first_frame(), len(self.times) - 1
        frames = [first]
        for step in sorted({last // 2, last} if self._any_order else set()):
            if step > (self._first or 0):
                with suppress(Exception):  # raised again when the run comes to this frame
                    frames.append(self._read(step))
        return frames

    def first_frame(self) -> Any:
        """Returns the first frame with points (emitters start empty), else the first frame."""
        if self._whole:
            return self._whole.first_frame()
        if self._first is None:
            self._first = next(filter(self._has_points, range(len(self.times))), 0)
        return self.frame(self._first)

    def part(self, steps: Sequence[int]) -> TemporalSource:
        """Returns a source of the given steps; lengths are estimated from the whole series."""
        times = [self.times[step] for step in steps]
        own = TemporalSource(lambda i: self.frame(steps[i]), times, self._output_type)
        own._whole = self
        return own

    def leave_out_pieces(self, minimum: int, volume: float, spacing: float) -> int:
        """Removes particles in clusters of fewer than `minimum` particles or less than `volume`
        [length^3].

        A particle has the volume `spacing`^3. If `spacing` is 0, all particles stay. Returns
        `minimum`, or the number of particles in `volume` if larger. Raises ValueError for images.
        """
        least = math.ceil(volume / spacing**3 - _ROUNDING) if spacing else 0
        minimum = max(minimum, least)
        if self._output_type == "vtkImageData":
            raise ValueError(
                "minimum_piece and minimum_volume need particles, not an image; leave them out."
            )
        self._change(lambda data: without_small_pieces(as_particles(data), minimum, spacing))
        return minimum

    def use_usual_level(self) -> None:
        """Converts masks to labels, 1 inside, and other images to level sets, negative inside.

        All images get the same level, which is found in the images of `frames_that_tell`. Particles
        are not changed. Raises ValueError if the images have several labels or no inside.
        """
        if self._output_type == "vtkImageData":
            self._change(converter_of_series(self.frames_that_tell()))

    def _change(self, change: Callable[[Any], Any]) -> None:
        load = self._load
        self._load = lambda step: change(load(step))
        self._kept, self._first = {}, None

    def _has_points(self, step: int) -> bool:
        frame = self.frame(step)
        return not frame.IsA("vtkPointSet") or frame.GetNumberOfPoints() > 0

    def step_of(self, time: float) -> int:
        """Returns the last step not after a time; the first step for earlier times."""
        return max(0, bisect_right(self.times, time) - 1)

    def RequestInformation(self, request: Any, inputs: Any, outputs: Any) -> int:
        info, key = outputs.GetInformationObject(0), vtkStreamingDemandDrivenPipeline
        info.Set(key.TIME_STEPS(), self.times, len(self.times))
        info.Set(key.TIME_RANGE(), [self.times[0], self.times[-1]], 2)
        return 1

    def RequestData(self, request: Any, inputs: Any, outputs: Any) -> int:
        info = outputs.GetInformationObject(0)
        time = info.Get(vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP())
        self.failure = None
        try:
            data = self.frame(self.step_of(self.times[0] if time is None else time))
        except Exception as error:  # an exception may not cross the pipeline
            self.failure = error
            return 0
        self.GetOutputData(outputs, 0).ShallowCopy(data)
        return 1


class ParticleSeries(TemporalSource):
    """VTK source with time steps, from particles or images in arrays, files or a function.

    Parameters
    ----------
    frames : iterable of particles or of files, one file, pattern or folder, or callable(time)
        Particles in a form that `as_particles` accepts, or images. A function returns the particles
        or the image of a time. Files are of the formats that `active-surface skin` reads. A
        vtkPolyData without `where` keeps its cells: polygons are a mesh, lines a skeleton.
    times : sequence of float, optional
        Time of each frame [time], increasing; required for a callable.
    fps : float, optional
        Frames per unit of time [1/time], more than 0, instead of `times`: the times are 0, 1/fps,
        2/fps ..., and gaps in the numbers of files are gaps in time. Default: the times in the
        files, else 25 frames per unit of time. Time steps 0, 1, 2 ... in one VTK file are
        numbers of frames, not times.
    where : str or sequence of str, optional
        Selects particles that meet all conditions: "Type=1", "T>300", "id!=3,4", "resname=LIG".

    Raises
    ------
    ValueError
        The times do not increase, or their number is not that of the frames; `times` and `fps` are
        both given; no frame is given; `fps` is out of range; a condition is malformed.
    TypeError
        A callable is given without `times`, `frames` is neither iterable nor callable, or `times`
        or `fps` has a wrong type.
    OSError
        A file does not exist or cannot be read.

    Examples
    --------
    >>> import numpy
    >>> from active_implicit_surfaces import ParticleSeries
    >>> series = ParticleSeries(numpy.zeros((3, 5, 3)), fps=10)
    >>> len(series), series.times, series.frame(2).GetNumberOfPoints()
    (3, [0.0, 0.1, 0.2], 5)
    """

    def __init__(
        self,
        frames: Any,
        *,
        times: Sequence[float] | None = None,
        fps: float | None = None,
        where: str | Sequence[str] = (),
    ) -> None:
        where = [where] if isinstance(where, str) else [*(where or ())]  # used for each frame
        conditions(where)
        if times is not None and fps is not None:
            raise ValueError("Give either times or fps, not both.")
        load, found, kind = _loader(frames, times, fps)
        is_image = kind == "vtkImageData"
        read = (lambda step: _as_image(load(step))) if is_image else load
        as_points = (lambda image: image) if is_image else as_particles
        note = note_once() if len(found) > 1 else None
        chosen = (lambda step: choose(as_points(read(step)), where, note=note)) if where else read
        super().__init__(chosen, found, kind, any_order=not callable(frames))

    def __len__(self) -> int:
        return len(self.times)


def _loader(
    frames: Any, times: Sequence[float] | None, fps: float | None
) -> tuple[Callable[[int], Any], Sequence[float], str]:
    """Returns the loader of a step, the times, and the class of the data."""
    if callable(frames):
        if times is None:
            raise TypeError("A function of time needs `times`; give the times of the frames.")
        own = check_times(times)
        first = frames(own[0])
        return lambda step: frames(own[step]) if step else first, own, _kind_of(first)
    is_whole = isinstance(frames, (Sequence, Path)) or hasattr(frames, "shape")
    if not is_whole and not hasattr(frames, "__iter__"):
        raise TypeError(
            f"An object of type {type(frames).__name__} is no series of particles; give a list of "
            "frames, names of files, or a function of time; for one frame, call skin()."
        )
    held = frames if is_whole else list(frames)
    if isinstance(held, (str, Path)) or _are_paths(held):
        files = open_particles(held, fps=fps, times=times)
        return files.load, files.times, files.kind
    count = len(held)
    own = times_at(range(count), fps) if times is None else one_for_each(times, count)
    return held.__getitem__, own, _kind_of(held[0] if len(held) else None)


def _kind_of(data: Any) -> str:
    is_image = is_vtk(data) and data.IsA("vtkImageData")
    return "vtkImageData" if is_image else "vtkPolyData"


def _as_image(data: Any) -> Any:
    """Returns `data` if it is an image; raises TypeError for other data."""
    if not (is_vtk(data) and data.IsA("vtkImageData")):
        raise TypeError(
            f"A frame is of type {type(data).__name__}, but the first frame is an image; give only "
            "images, or only particles."
        )
    return data


def _are_paths(frames: Any) -> bool:
    is_list = isinstance(frames, (list, tuple)) and len(frames) > 0
    return is_list and all(isinstance(frame, (str, Path)) for frame in frames)
