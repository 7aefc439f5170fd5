"""Functions that make skins over particles: one frame, or a series."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from vtkmodules.vtkCommonDataModel import vtkDataObject

from . import properties, vtkActiveImplicitSurface
from .data_objects import STANDARD_NAMES, array_names, as_particles, copy_of, like, usual_ids
from .messages import warn
from .periodic import with_periodic_bounds
from .presets import (
    apply_preset,
    describe_precision,
    estimate_spacing,
    is_point_cloud,
    series_spacing,
)
from .probing import ProbedAtoms
from .runner import Skins, check_mode, update
from .series import ParticleSeries, TemporalSource
from .times import check_number, times_between

# Indices of SetInputArrayToProcess, and the keywords that choose such an array.
_ARRAYS = {"radii": 0, "ids": 1, "strengths": 2, "velocities": 5}
_POINTS = vtkDataObject.FIELD_ASSOCIATION_POINTS
_MANY = 100  # least number of particles whose median distance is meaningful
_FAR = 1.5  # largest factor, up or down, between a suitable spacing and the estimate
_SAME = 1.01
_LEAST_REACH = 1.2  # least kernel radius, in spacings


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
    """Returns the skin over one frame of particles.

    Parameters
    ----------
    particles : array (n, 3), vtkPointSet, or an object with `points` or `vertices`
        Objects of PyVista, meshio and trimesh are accepted. All points are particles; cells are
        ignored.
    radii : array (n,) or str, optional
        Radius of each particle's ball [length], or the name of a point array.
    strengths : array (n,) or str, optional
        Weight of each particle, or the name of a point array. With ``particle_model="anisotropic"``
        (default), weights of 0 or less give no skin, and weights above 1 count as 1. With "sum"
        larger weights give a larger ball, and negative weights remove skin of other particles.
    probe : float, optional
        See `frames`.
    preset : {"viscous", "molecule", "grains", "paper"}, optional
        Named set of property values. Properties that are given as options override the preset,
        unless their value is "automatic" or -1.
    arrays : dict of arrays, optional
        Further point arrays; ``pass_target_arrays=True`` passes them to the skin.
    **options
        Properties of vtkActiveImplicitSurface in snake case, such as ``particle_spacing=0.1``.

    Returns
    -------
    vtkPolyData
        Closed surface of triangles, by default with normals; on several ranks, each rank returns
        a part of the surface. A pyvista.PolyData if the particles are PyVista's.

    Raises
    ------
    ValueError
        A value or an array does not fit, or the filter reports an error, whose text is the
        exception's message.
    TypeError
        A keyword is unknown (the message names a similar keyword, if any), or particles or a value
        have a wrong type.

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
    options = properties.given(options)  # no keyword of frames or configure
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
    """Iterator over the skins of a series of particles or images.

    Each skin evolves from the previous one. Exception: without explicit substeps (property
    TimeIntegration), the skin over a mask is the smoothed mask.

    Parameters
    ----------
    particles : iterable of particles or files, pattern of files, ParticleSeries, or callable(time)
        See the parameter `frames` of ParticleSeries. Images may be masks of a label, volume
        fractions (inside above 0.5) or distances (inside below 0); for other images set
        ``target_iso_value`` and ``invert_target``.
    times : sequence of float, optional
        Times of the frames [time]; see ParticleSeries. If `particles` is a ParticleSeries, pass
        `times`, `fps` and `where` to the ParticleSeries instead.
    fps : float, optional
        Frames per unit of time [1/time]; see ParticleSeries.
    where : str or sequence of str, optional
        Selects particles that meet all conditions: "Type=1", "T>300", "id!=3,4", "resname=LIG".
    minimum_piece : int
        Least number of particles of a cluster; smaller clusters get no skin. Default: 1.
    minimum_volume : float
        Least volume of a cluster [length^3]; smaller clusters get no skin. The volume is the
        number of particles times the cube of the particle spacing. Default: 0.
    probe : float, optional
        Radius of a probe [length] that rolls over atoms (particles with radii); for water 1.4
        Angstrom. The skin is the solvent-excluded surface; for radius 0, the surface of the union
        of the atoms' balls. With ``pass_target_arrays=True`` the skin has the arrays of the nearest
        atom.
    periodic : bool
        Sets ``periodic_bounds`` to the box in the particles' field data: "Lattice" (edges as rows
        [length]), "Origin" and "pbc". Default: False.
    output_fps : float, optional
        Skins per unit of time [1/time], also between frames. Default: one skin for each frame.
    preset : {"viscous", "molecule", "grains", "paper"}, optional
        Named set of property values. Properties that are given as options override the preset,
        unless their value is "automatic" or -1.
    arrays : dict of str, optional
        Names of point arrays. The keys are "radii" (of balls), "ids", "strengths" and
        "velocities". Default of "ids": an array named id, ids, particle_id, particleid or pid, in
        upper or lower case. Default of "radii": with `probe`, the array "radius"; with the preset
        "molecule" or "grains" the array "radius", unless ``kernel_radius`` is given; else none.
    progress : callable(int, int), optional
        Called after each skin with the numbers of finished skins and of all skins.
    **options
        Properties of vtkActiveImplicitSurface in snake case.

    Yields
    ------
    Frame
        Named tuple (time, skin). The skin is a vtkPolyData, or a pyvista.PolyData if `particles`
        is a list of objects of PyVista.

    Raises
    ------
    ValueError
        A value, a time or an array does not fit, no particle is selected, or the filter reports an
        error, whose text is the exception's message.
    TypeError
        A keyword is unknown (the message names a similar keyword, if any), particles or a value
        have a wrong type, or `particles` is a function, but `times` are not given.
    OSError
        A file does not exist or cannot be read.

    Attributes
    ----------
    surface : vtkActiveImplicitSurface
        The filter, for example for `history`.
    source : TemporalSource
        Source of the particles or images. With `probe`, the source of images whose values are
        distances to the solvent-excluded surface.

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
        of_series = times is not None or fps is not None or where
        if isinstance(particles, ParticleSeries) and of_series:
            raise ValueError("Give `times`, `fps` and `where` to ParticleSeries, not to `frames`.")
        options = properties.given(options)
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
            conditions = where if isinstance(where, str) else " and ".join(where)
            fault = f"No frame has particles that meet {conditions}"
            fault = fault if conditions else "No frame has particles"
            more = f" in a cluster of {minimum_piece} or more" if minimum_piece > 1 else ""
            raise ValueError(f"{fault}{more}; relax the selection, or give more particles.")
        _check_names(arrays or {})
        if probe is not None:
            check_number("probe", probe)
            self._atoms = ProbedAtoms(self.source, probe, preset, arrays or {}, options)
            self.source, arrays = self._atoms.source, None
        elif not {"target_iso_value", "invert_target"} & set(options):
            self.source.use_usual_level()
        self.surface = vtkActiveImplicitSurface()
        self.surface.SetInputConnection(self.source.GetOutputPort())
        configure(self.surface, self.source, preset=preset, arrays=arrays, **options)
        own = self.source.times
        check_mode(self.surface, len(own))
        self.times = own if output_fps is None else times_between(own, output_fps)
        self._progress = progress
        self._example = particles[0] if isinstance(particles, (list, tuple)) and particles else None

    def make(self, step: int) -> Any:
        """Returns the filter's own output at a step.

        With a probe, adds the arrays of the nearest atoms if they are requested.
        """
        skin = super().make(step)
        if self._atoms:
            self._atoms.add_arrays(skin, self.times[step])
        return skin


def configure(
    surface: Any,
    source: TemporalSource,
    *,
    preset: str | None = None,
    arrays: dict[str, str] | None = None,
    interval: float | None = None,
    **options: Any,
) -> None:
    """Sets arrays and properties of a filter whose target is a source of particles or images."""
    options = properties.given(options)
    chosen = dict(arrays or {})
    _check_names(chosen)
    unknown = set(chosen) - set(_ARRAYS)
    if unknown:
        raise TypeError(f"The keys of `arrays` are {', '.join(_ARRAYS)}, not {unknown.pop()!r}.")
    first = source.first_frame()
    _check_arrays(first, chosen)
    frames = source.frames_that_tell() if first.IsA("vtkPointSet") else [first]
    if preset is not None and first.IsA("vtkImageData"):
        raise ValueError(
            f"The preset {preset} needs particles, not an image; leave out the preset."
        )
    if "ids" not in chosen:
        filled = [frame for frame in frames if frame.GetNumberOfPoints()]
        found = {usual_ids(frame) for frame in filled or [first]}
        chosen["ids"] = found.pop() if len(found) == 1 else ""  # "": the names differ
    for role, name in chosen.items():
        if name:
            surface.SetInputArrayToProcess(_ARRAYS[role], 0, 0, _POINTS, name)
    if preset is not None:
        apply_preset(surface, source, preset, interval, options)
    properties.put(surface, options)
    if is_point_cloud(first):
        is_given = bool({"particle_spacing", "kernel_radius"} & set(options))
        _settle_spacing(surface, source, frames, is_given, "radii" in chosen)


def _settle_spacing(
    surface: Any, source: TemporalSource, frames: list[Any], is_given: bool, has_radii: bool
) -> None:
    """Warns of lengths that do not fit the particles.

    If neither a spacing, a kernel radius nor radii are set, may set the estimated spacing.
    """
    own, spacing = series_spacing(frames), surface.GetParticleSpacing()
    warn(*describe_precision(frames[0], spacing if spacing > 0 else own))
    if not (spacing > 0 or surface.GetKernelRadius() > 0 or has_radii):
        first = estimate_spacing(frames[0])
        if own > 0 and (len(frames) > 1 or frames[0] is not source.frame(0)):
            surface.SetParticleSpacing(first if own / _SAME <= first <= _SAME * own else own)
    elif is_given and own > 0 and max(frame.GetNumberOfPoints() for frame in frames) >= _MANY:
        warn(*_describe_lengths(surface, own, has_radii))


def _describe_lengths(surface: Any, own: float, has_radii: bool) -> list[str]:
    """Returns [a warning] if a length does not fit `own`, the estimated spacing; else []."""
    spacing, radius = surface.GetParticleSpacing(), surface.GetKernelRadius()
    if spacing > 0 and not 1 / _FAR <= spacing / own <= _FAR:
        return [
            f"particle_spacing is {spacing:g}, but most neighbours are {own:g} apart; give about "
            f"{own:g}. Without radii a smaller spacing breaks the skin into drops, a larger one "
            "makes a lump."
        ]
    if 0 < radius < _LEAST_REACH * own and not spacing > 0 and not has_radii:
        return [
            f"kernel_radius is {radius:g}, but most neighbours are {own:g} apart, so "
            f"kernels reach few neighbours. Increase kernel_radius; or, if {radius:g} is the "
            f"particles' radius or spacing, give particle_spacing {own:g} instead."
        ]
    return []


def _check_names(chosen: dict[str, Any]) -> None:
    """Raises TypeError if a value of `chosen` is no name, such as an array of values."""
    for role, name in chosen.items():
        if name is not None and not isinstance(name, str):
            raise TypeError(
                f"In `arrays`, `{role}` is an object of type {type(name).__name__}, but has to be "
                "the name of a point array; add the array to the particles, and give its name."
            )


def _check_arrays(first: Any, chosen: dict[str, str]) -> None:
    """Raises ValueError if the first frame has particles, but lacks a chosen array."""
    arrays = first.GetPointData() if first.IsA("vtkPointSet") else None
    if arrays is None or first.GetNumberOfPoints() == 0:
        return
    names = array_names(arrays)
    for role, name in chosen.items():
        if name and name not in names:
            there = ", ".join(map(repr, filter(None, names)))
            others = f"there are {there}." if there else "there are no arrays."
            text = f"The particles have no point array {name!r}, chosen for {role}; "
            raise ValueError(text + others)


def _sort_arrays(given: dict[str, Any]) -> tuple[dict[str, str], dict[str, Any]]:
    """Returns two dicts: the array name of each given keyword; the arrays given as values."""
    names, values = {}, {}
    for role, array in given.items():
        if isinstance(array, str):
            names[role] = array
        elif array is not None:
            names[role], values[role] = STANDARD_NAMES[role], array
    return names, values
