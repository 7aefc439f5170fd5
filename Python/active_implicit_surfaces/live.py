"""The skin of a running simulation, frame by frame."""

from __future__ import annotations

import math
import os
from typing import Any

from vtkmodules.vtkCommonDataModel import vtkDataObject

from . import properties, vtkActiveImplicitSurface
from .api import configure
from .data_objects import as_particles, copy_of, like
from .messages import listening, warn
from .series import TemporalSource
from .times import check_number


class LiveSurface:
    """Skin over a running simulation: `advance` reads a frame's particles and returns their skin.

    The cost of a call does not depend on the number of earlier frames. If `particle_spacing` is
    given, no preset is given, and the first frame has particles, the skins are bitwise identical to
    those of `frames` at the same times, except the array "Velocity".

    Parameters
    ----------
    start : float
        Time of the first frame [time]. Default: 0.
    resume : str, optional
        A .vdb written by `save` in a run with the same options. The first call of `advance` then
        has to pass the particles of the saved time, and returns the saved skin.
    preset, arrays, **options
        See `frames`. An unknown keyword raises TypeError.

    Attributes
    ----------
    surface : vtkActiveImplicitSurface
        The filter, for example for `history`.
    time : float or None
        Time of the last skin; None before the first skin.

    Examples
    --------
    >>> import numpy
    >>> import active_implicit_surfaces as active
    >>> grid = numpy.stack(numpy.meshgrid(*3 * [numpy.arange(6.0)]), -1).reshape(-1, 3)
    >>> surface = active.LiveSurface(particle_spacing=1)
    >>> for step in range(3):
    ...     skin = surface.advance(grid + [0, 0.5 * step, 0], 0.1)
    >>> f"at {surface.time:.1f} its centre is at {skin.GetCenter()[1]:.1f}"
    'at 0.2 its centre is at 3.5'
    """

    def __init__(
        self,
        *,
        start: float = 0.0,
        resume: str | os.PathLike[str] | None = None,
        preset: str | None = None,
        arrays: dict[str, str] | None = None,
        **options: Any,
    ) -> None:
        for keyword in options:
            properties.find(keyword)
        check_number("start", start)
        if not math.isfinite(start):
            raise ValueError(f"start has to be finite, not {start}.")
        self.surface = vtkActiveImplicitSurface()
        self.surface.SetStartTime(float(start))
        self.time: float | None = None
        self._resume = None if resume is None else os.fspath(resume)
        self._options = {"preset": preset, "arrays": arrays, **options}

    def advance(self, particles: Any, dt: float, **arrays: Any) -> Any:
        """Advances by `dt` to these particles and returns their skin.

        Parameters
        ----------
        particles
            See `skin`. The filter shares the memory of arrays if possible. You may overwrite the
            arrays for the next call.
        dt : float
            Time since the last call [time], more than 0 and finite. In the first call, `dt` does
            not change the time of the skin, which is `start` or the time saved in `resume`; a
            preset derives its rates from this `dt`.
        **arrays
            Point arrays: ``ids=``, ``velocities=``, or any name.

        Returns
        -------
        vtkPolyData
            The skin; a pyvista.PolyData if the particles are PyVista's.

        Raises
        ------
        ValueError
            `dt`, a value or an array does not fit, or the filter reports an error. The next call
            continues the motion.
        TypeError
            The argument `arrays` of the class has an unknown key, or particles or a value have a
            wrong type.
        """
        check_number("dt", dt)
        if not 0 < dt < float("inf"):
            raise ValueError(f"dt has to be more than 0 and finite, not {dt}.")
        cloud = as_particles(particles, **arrays)
        if self.time is None:
            first = TemporalSource(lambda step: cloud, [self.surface.GetStartTime()])
            configure(self.surface, first, interval=dt, **self._options)
        with listening(self.surface) as heard:
            file = self._resume if self.time is None else None
            if file is None or self.surface.LoadState(file):
                self.surface.Advance(cloud, dt)
        heard.raise_error(ValueError)
        warn(*heard.warnings)
        skin = copy_of(self.surface.GetOutput())
        self.time = skin.GetInformation().Get(vtkDataObject.DATA_TIME_STEP())
        return like(particles, skin)

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes the state at the last frame to a .vdb, for `resume`.

        Raises ValueError if there is no state, or the file cannot be written.
        """
        with listening(self.surface) as heard:
            self.surface.SaveState(os.fspath(file))
        heard.raise_error(ValueError)
