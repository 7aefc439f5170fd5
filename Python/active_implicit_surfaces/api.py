"""Skins over particles as Python functions: one frame, a series, a simulation that still runs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from vtkmodules.vtkCommonDataModel import vtkDataObject

from . import properties, vtkActiveImplicitSurface
from .data_objects import STANDARD_NAMES, array_names, as_particles, like, usual_ids
from .messages import listening, warn
from .periodic import with_periodic_bounds
from .presets import (
    apply_preset,
    describe_precision,
    estimate_spacing,
    is_point_cloud,
    series_spacing,
)
from .probing import ProbedAtoms
from .runner import Skins, copy_of, update
from .series import ParticleSeries, TemporalSource
from .times import times_between

# Indices of SetInputArrayToProcess, and the keywords that choose such an array.
_ARRAYS = {"radii": 0, "ids": 1, "strengths": 2, "velocities": 5}
_MANY = 100  # particles, from which the distance of neighbours is meaningful
_FAR = 1.5  # factor up or down beyond which a length is unsuitable
_SAME = 1.01
_LEAST_REACH = 1.2  # of a kernel, in spacings


def skin(
    particles: Any,
    *,
    radii: Any = None,
    strengths: Any = None,
    probe: float | None = None,
    preset: str | None = None,
    arrays: dict[str, Any] | None = None,
    **options: Any,
) -> Any:
    """The skin over particles, as they are.

    Parameters
    ----------
    particles : array (n, 3), vtkPointSet, or an object with `points` or `vertices`
        PyVista's and meshio's, and trimesh's; all points count, cells do not.
    radii : array (n,) or str, optional
        Radius of each particle [length], which its ball shows; or the name of an array.
    strengths : array (n,) or str, optional
        Weight of each particle, or the name of an array; 0 is no particle.
    probe : float, optional
        See `frames`.
    preset : {"viscous", "molecule", "grains", "paper"}, optional
        A choice of properties; those that are given besides hold.
    arrays : dict of arrays, optional
        More point arrays; with ``pass_target_arrays=True`` the skin has them.
    **options
        Properties of vtkActiveImplicitSurface in snake case, such as ``particle_spacing=0.1``.

    Returns
    -------
    vtkPolyData
        Closed triangles with normals; a pyvista.PolyData if the particles are PyVista's.

    Raises
    ------
    ValueError
        The filter's own sentence where it cannot make a skin.
    TypeError
        An unknown keyword, with the nearest one, or particles of an unknown kind.

    Examples
    --------
    >>> import numpy
    >>> import active_implicit_surfaces as active
    >>> grid = numpy.stack(numpy.meshgrid(*3 * [numpy.arange(8.0)]), -1).reshape(-1, 3)
    >>> ball = active.skin(grid, particle_spacing=1)
    >>> ball.GetNumberOfPolys() > 1000
    True
    >>> active.skin(grid, particle_spcing=1)  # doctest: +ELLIPSIS
    Traceback (most recent call last):
    ...
    TypeError: ... no property 'particle_spcing'; did you mean 'particle_spacing'?
    """
    chosen, given = _sort_arrays({"radii": radii, "strengths": strengths})
    cloud = as_particles(particles, **given, **(arrays or {}))
    if probe is not None:
        one = frames([cloud], probe=probe, preset=preset, arrays=chosen, **options)
        return like(particles, next(one).skin)
    surface = vtkActiveImplicitSurface()
    source = TemporalSource(lambda step: cloud, [0.0])
    surface.SetInputConnection(source.GetOutputPort())
    configure(surface, source, preset=preset, arrays=chosen, **options)
    update(surface, 0.0, source)
    return like(particles, copy_of(surface.GetOutput()))


class frames(Skins):
    """The skins over a series of particles or images, each made from the one before.

    Parameters
    ----------
    particles : iterable of particles, ParticleSeries, pattern or list of files, or callable(time)
        See ParticleSeries. Images may be label masks, fractions of volume (0 to 1, inside above
        0.5) or distances (inside below 0), else give ``target_iso_value`` and ``invert_target``.
    times : sequence of float, optional
        See ParticleSeries [time].
    fps : float, optional
        See ParticleSeries [1/time].
    where : str or sequence of str, optional
        Conditions that the particles meet: "Type=1", "T>300", "id!=3,4", "x<0.5", "resname=LIG".
    minimum_piece : int
        Particles in clusters of fewer than these get no skin. Default: 1.
    minimum_volume : float
        Likewise for a smaller volume [length^3], spacing^3 for each particle. Default: 0.
    probe : float, optional
        Radius of a probe [length] that rolls over particles with radii, atoms: the skin is their
        solvent-excluded surface; of 0 their balls. For water and Angstroms 1.4. With
        ``pass_target_arrays=True`` it has the arrays of the nearest atom.
    periodic : bool
        Finds ``periodic_bounds`` in the particles' field data: "Lattice", edges as rows [length],
        "Origin" and "pbc", as files of molecules have them. Default: False.
    output_fps : float, optional
        Skins per second [1/time], frames in between included. Default: at the particles' times.
    preset : {"viscous", "molecule", "grains", "paper"}, optional
        A choice of properties; those that are given besides hold.
    arrays : dict of str, optional
        Names of the particles' arrays of ``radii`` (of balls), ``ids``, ``strengths``,
        ``velocities``. Default: as ids an array that is called id, ids, particle_id, particleid or
        pid, in small or capital letters; of the others none.
    progress : callable(int, int), optional
        Called after each frame with the number of those done and of all.
    **options
        Properties of vtkActiveImplicitSurface in snake case.

    Yields
    ------
    Frame
        `time` and `skin`, a vtkPolyData (a pyvista.PolyData if the particles are PyVista's).

    Raises
    ------
    ValueError
        The filter's own sentence where it cannot make a skin, or times that do not increase.
    TypeError
        An unknown keyword, with the nearest one, or particles of an unknown kind.
    OSError
        A file that cannot be read.

    Attributes
    ----------
    surface : vtkActiveImplicitSurface
        The filter, for its history and more.
    source : TemporalSource

    Examples
    --------
    >>> import numpy
    >>> import active_implicit_surfaces as active
    >>> grid = numpy.stack(numpy.meshgrid(*3 * [numpy.arange(6.0)]), -1).reshape(-1, 3)
    >>> rising = [grid + [0, 0.5 * step, 0] for step in range(3)]
    >>> for time, skin in active.frames(rising, fps=10, particle_spacing=1):
    ...     print(f"at {time} s its centre is at {skin.GetCenter()[1]:.1f}")
    at 0.0 s its centre is at 2.5
    at 0.1 s its centre is at 3.0
    at 0.2 s its centre is at 3.5
    """

    _atoms: ProbedAtoms | None = None

    def __init__(
        self,
        particles: Any,
        *,
        times: Sequence[float] | None = None,
        fps: float | None = None,
        where: str | Sequence[str] = (),
        minimum_piece: int = 1,
        minimum_volume: float = 0.0,
        probe: float | None = None,
        periodic: bool = False,
        output_fps: float | None = None,
        preset: str | None = None,
        arrays: dict[str, str] | None = None,
        progress: Callable[[int, int], None] | None = None,
        **options: Any,
    ) -> None:
        is_source = isinstance(particles, TemporalSource)
        self.source = (
            particles if is_source else ParticleSeries(particles, times=times, fps=fps, where=where)
        )
        if periodic:
            options = with_periodic_bounds(options, self.source)
        if minimum_piece > 1 or minimum_volume > 0:
            given = options.get("particle_spacing")
            spacing = given or series_spacing(self.source.frames_that_tell())
            minimum_piece = self.source.leave_out_pieces(minimum_piece, minimum_volume, spacing)
        if (where or minimum_piece > 1) and not self.source.first_frame().GetNumberOfPoints():
            told = where if isinstance(where, str) else " and ".join(where)
            told = f"No particle of any frame meets {told}" if told else "No frame has particles"
            more = f" in a piece of {minimum_piece} or more" if minimum_piece > 1 else ""
            raise ValueError(f"{told}{more}.")
        if probe is not None:
            self._atoms = ProbedAtoms(self.source, probe, preset, arrays or {}, options)
            self.source, arrays = self._atoms.source, None
        elif not {"target_iso_value", "invert_target"} & set(options):
            self.source.use_usual_level()
        self.surface = vtkActiveImplicitSurface()
        self.surface.SetInputConnection(self.source.GetOutputPort())
        configure(self.surface, self.source, preset=preset, arrays=arrays, **options)
        own = self.source.times
        self.times = own if output_fps is None else times_between(own, output_fps)
        self._progress = progress
        self._example = particles[0] if isinstance(particles, (list, tuple)) and particles else None

    def make(self, step: int) -> Any:
        """The filter's own output at a step, with the arrays of atoms if wanted."""
        skin = super().make(step)
        if self._atoms:
            self._atoms.add_arrays(skin, self.times[step])
        return skin


class LiveSurface:
    """A skin that follows a simulation as it runs: push particles, get the skin.

    A push costs one frame, however many there have been; the skins are the same, byte for byte, as
    those that `frames` makes of the finished series.

    Parameters
    ----------
    start : float
        Time of the first push.
    preset, arrays, **options
        As for `frames`.

    Attributes
    ----------
    surface : vtkActiveImplicitSurface
    time : float or None
        Of the last push.

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
        preset: str | None = None,
        arrays: dict[str, str] | None = None,
        **options: Any,
    ) -> None:
        for keyword in options:
            properties.find(keyword)
        self.surface = vtkActiveImplicitSurface()
        self.surface.SetStartTime(float(start))
        self.time: float | None = None
        self._options = {"preset": preset, "arrays": arrays, **options}

    def advance(self, particles: Any, dt: float, **arrays: Any) -> Any:
        """The skin a time `dt` after the last push, over these particles.

        Parameters
        ----------
        particles
            As for `skin`. They are read until the next push; change no array in the meantime.
        dt : float
            Time since the last push; of no meaning at the first one, which is at `start`.
        **arrays
            Point arrays: ``ids=``, ``velocities=``, or any name.

        Returns
        -------
        vtkPolyData

        Raises
        ------
        ValueError
            The filter's own sentence; the skin is as it was, and goes on with the next push.
        """
        if not 0 < dt < float("inf"):
            raise ValueError(f"dt has to be more than 0 and finite, not {dt}.")
        cloud = as_particles(particles, **arrays)
        if self.time is None:
            first = TemporalSource(lambda step: cloud, [self.surface.GetStartTime()])
            configure(self.surface, first, interval=dt, **self._options)
        with listening(self.surface) as heard:
            self.surface.Advance(cloud, dt)
        heard.raise_error(ValueError)
        warn(*heard.warnings)
        skin = copy_of(self.surface.GetOutput())
        self.time = skin.GetInformation().Get(vtkDataObject.DATA_TIME_STEP())
        return like(particles, skin)


def configure(
    surface: Any,
    source: TemporalSource,
    *,
    preset: str | None = None,
    arrays: dict[str, str] | None = None,
    interval: float | None = None,
    **options: Any,
) -> None:
    """Sets arrays and properties of a filter over a source of particles."""
    for keyword in options:
        properties.find(keyword)
    chosen = dict(arrays or {})
    unknown = set(chosen) - set(_ARRAYS)
    if unknown:
        raise TypeError(f"arrays are of {', '.join(_ARRAYS)}, not of {unknown.pop()!r}.")
    first = source.first_frame()
    _check_arrays(first, chosen)
    told = source.frames_that_tell() if first.IsA("vtkPointSet") else [first]
    if preset is not None and first.IsA("vtkImageData"):
        raise ValueError(f"The preset {preset} is of particles; images have none.")
    if "ids" not in chosen:
        found = {usual_ids(frame) for frame in told if frame.GetNumberOfPoints()}
        found = found or {usual_ids(first)}
        chosen["ids"] = found.pop() if len(found) == 1 else ""  # "": some frames lack them
    for role, name in chosen.items():
        if name:
            points = vtkDataObject.FIELD_ASSOCIATION_POINTS
            surface.SetInputArrayToProcess(_ARRAYS[role], 0, 0, points, name)
    if preset is not None:
        apply_preset(surface, source, preset, interval, options)
    properties.put(surface, options)
    if is_point_cloud(first):
        is_given = bool({"particle_spacing", "kernel_radius"} & set(options))
        _settle_spacing(surface, source, told, is_given, "radii" in chosen)


def _settle_spacing(
    surface: Any, source: TemporalSource, frames: list[Any], is_given: bool, has_radii: bool
) -> None:
    """Chooses a spacing if none is given, as the filter would; warns of a given one that is off."""
    own = series_spacing(frames)
    warn(*describe_precision(frames[0], surface.GetParticleSpacing() or own))
    if not (surface.GetParticleSpacing() or surface.GetKernelRadius() or has_radii):
        first = estimate_spacing(frames[0])
        if own > 0 and (len(frames) > 1 or frames[0] is not source.frame(0)):
            surface.SetParticleSpacing(first if own / _SAME <= first <= _SAME * own else own)
    elif is_given and own > 0 and max(frame.GetNumberOfPoints() for frame in frames) >= _MANY:
        warn(*_describe_lengths(surface, own))


def _describe_lengths(surface: Any, own: float) -> list[str]:
    """Sentences about a spacing or radius that does not fit the distance of neighbours."""
    spacing, radius = surface.GetParticleSpacing(), surface.GetKernelRadius()
    if spacing and not 1 / _FAR <= spacing / own <= _FAR:
        return [
            f"particle_spacing is {spacing:g}, but most neighbours are {own:g} apart: a skin falls "
            "into drops where it is too small, and is a lump where it is too large."
        ]
    if radius and not spacing and radius < _LEAST_REACH * own:
        return [
            f"kernel_radius is {radius:g}, but most neighbours are {own:g} apart, so that few are "
            f"reached. If {radius:g} is the particles' own radius or spacing, give "
            f"particle_spacing {own:g} instead."
        ]
    return []


def _check_arrays(first: Any, chosen: dict[str, str]) -> None:
    """Raises ValueError if the first frame, unless it is empty, has not all arrays."""
    arrays = first.GetPointData() if first.IsA("vtkPointSet") else None
    if arrays is None or first.GetNumberOfPoints() == 0:
        return
    names = array_names(arrays)
    for role, name in chosen.items():
        if name and name not in names:
            there = ", ".join(map(repr, filter(None, names)))
            raise ValueError(
                f"The particles have no point array {name!r}, chosen for {role}; "
                + (f"there are {there}." if there else "they have none.")
            )


def _sort_arrays(given: dict[str, Any]) -> tuple[dict[str, str], dict[str, Any]]:
    """The names of arrays, and the arrays themselves, of keywords that may be either."""
    names, values = {}, {}
    for role, array in given.items():
        if isinstance(array, str):
            names[role] = array
        elif array is not None:
            names[role], values[role] = STANDARD_NAMES[role], array
    return names, values
