"""Metamorphosis: one shape becomes another in a given time."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

from . import properties, vtkActiveImplicitSurface
from .contours import as_level_set, level_of_series
from .data_objects import as_shape, copy_of, is_vtk, vtk_points
from .messages import warn
from .runner import Skins, check_mode
from .times import check_number

FITS = ("none", "centre", "box")
_FAR = 1.5  # largest ratio of the shapes' sizes without a warning
_OF_DURATION = {"arrival_time", "number_of_time_steps", "start_time", "time_step_size"}


class morph(Skins):
    """Iterator over the skins from a first shape to a second shape.

    No point correspondence is needed: the surface moves along its normal, splits and merges. Unless
    ``attraction`` is given, each point of the surface moves at constant speed and arrives at the
    end. Parts that only `a` has shrink. Parts that only `b` has grow, unless
    ``create_parts=False``.

    Parameters
    ----------
    a, b : vtkPolyData, vtkImageData, vtkImplicitFunction, or an object with `vertices` and `faces`
        First and last shape. Meshes have to be closed. Images may be masks of a label, volume
        fractions (inside above 0.5) or distances (inside below 0); for other images set
        ``target_iso_value`` and ``invert_target``. Objects of PyVista, trimesh and meshio are
        accepted.
    duration : float
        Time of the last skin [time], more than 0. Unless properties such as ``attraction`` or
        ``tension`` prevent this, the last skin is `b`, to about a tenth of a voxel if the shapes
        are meshes, images of distances or functions that are distances. Default: 1.
    frames : int
        Number of skins, including the first and the last; 2 or more. Default: 25.
    fit : str
        Before the morph, moves `b` to `a`, for shapes in different units or positions. "none" does
        not move `b`; "centre" moves the centre of its bounds to that of `a`; "box" also scales `b`,
        to the longest side of the bounds of `a`. Default: "none".
    progress : callable(int, int), optional
        Called after each skin with the numbers of finished skins and of all skins.
    **options
        Properties of vtkActiveImplicitSurface in snake case, such as ``voxel_size=0.02``. If `a`
        and `b` are functions without bounds, set ``model_bounds``.

    Yields
    ------
    Frame
        Named tuple (time, skin). The skin is a vtkPolyData, or a pyvista.PolyData if `a` is of
        PyVista.

    Raises
    ------
    ValueError
        A value is out of range, `frames` is no whole number, a shape is not usable, a skin is empty
        although `b` is not, or the filter reports an error, whose text is the exception's message.
    TypeError
        A keyword is unknown (the message names a similar keyword, if any), or is replaced by
        `duration` and `frames`; a shape or another value has a wrong type; or `fit` is given with a
        function.

    Warns
    -----
    UserWarning
        The filter warns. Or, for meshes and images after `fit`, the longest sides of the bounds of
        `a` and `b` differ by a factor of more than 1.5, or the centres of the bounds are farther
        apart than half of the longer of these sides.

    Attributes
    ----------
    surface : vtkActiveImplicitSurface
        The filter, for example for `history`.

    Examples
    --------
    >>> from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkSphereSource
    >>> import active_implicit_surfaces as active
    >>> cube, ball = vtkCubeSource(), vtkSphereSource()
    >>> ball.SetRadius(1)
    >>> ball.SetThetaResolution(32)
    >>> ball.SetPhiResolution(32)
    >>> for source in (cube, ball):
    ...     _ = source.Update()
    >>> way = active.morph(cube.GetOutput(), ball.GetOutput(), duration=2, frames=3, voxel_size=0.1)
    >>> for time, skin in way:
    ...     print(f"at {time}: {skin.GetBounds()[1]:.1f}")
    at 0.0: 0.5
    at 1.0: 0.7
    at 2.0: 1.0
    """

    def __init__(
        self,
        a: Any,
        b: Any,
        duration: float = 1.0,
        *,
        frames: int = 25,
        fit: str = "none",
        progress: Callable[[int, int], None] | None = None,
        **options: Any,
    ) -> None:
        check_number("duration", duration)
        if not 0 < duration < float("inf"):
            raise ValueError(f"duration has to be more than 0 and finite, not {duration}.")
        for name in _OF_DURATION & set(options):
            raise TypeError(f"morph has duration and frames in place of {name}; leave {name} out.")
        frames = _count_of(frames)
        if fit not in FITS:
            raise ValueError(f"fit has to be one of {', '.join(FITS)}, not {fit!r}.")
        self.times = [duration * i / (frames - 1) for i in range(frames)]
        self.surface = vtkActiveImplicitSurface()
        self._example, self._progress = a, progress
        options = properties.given(options)
        self._connect(a, b, fit, not {"target_iso_value", "invert_target"} & set(options))
        properties.put(self.surface, options)
        check_mode(self.surface, frames)
        self._expects_skin = _is_function(b) or as_shape(b).GetNumberOfPoints() > 0
        if "attraction" not in options:
            self.surface.SetArrivalTime(duration)
        self.surface.SetNumberOfTimeSteps(frames)
        self.surface.SetTimeStepSize(duration / (frames - 1))

    def make(self, step: int) -> Any:
        """Returns the skin at a step, as Skins.make does.

        Raises ValueError if the skin is empty, but `b` is not.
        """
        skin = super().make(step)
        if self._expects_skin and skin.GetNumberOfPoints() == 0:
            raise ValueError(
                f"There is no skin at the time {self.times[step]:g}. If create_parts is off and "
                "the shapes do not overlap, give fit; if parts are thinner than two voxels, reduce "
                "voxel_size; if tension is set, reduce it; if nothing is inside a shape, set "
                "target_iso_value for an image, mesh_thickness for an open mesh."
            )
        return skin

    def _connect(self, a: Any, b: Any, fit: str, has_usual_level: bool) -> None:
        first, last = (
            _prepared(shape, which, has_usual_level) for shape, which in ((a, "first"), (b, "last"))
        )
        if _is_function(first) or _is_function(last):
            if fit != "none":
                raise TypeError(
                    "fit needs two meshes or images: a function has no box; leave fit out."
                )
        else:
            last = _fitted(last, first, fit)
            if said := _describe_difference(first, last):
                warn(said)
        set_last, set_first = self.surface.SetTargetFunction, self.surface.SetInitialFunction
        for port, (shape, set_function) in enumerate(((last, set_last), (first, set_first))):
            if _is_function(shape):
                set_function(shape)
            else:
                self.surface.SetInputDataObject(port, shape)


def _count_of(frames: Any) -> int:
    """Returns the number of frames; raises ValueError unless whole and 2 or more."""
    try:
        count = int(frames)
    except (TypeError, ValueError, OverflowError):
        count = 0
    if count != frames or count < 2:
        raise ValueError(f"frames has to be a whole number of 2 or more, not {frames!r}.")
    return count


def _prepared(shape: Any, which: str, has_usual_level: bool) -> Any:
    """Returns a shape as a function, a mesh or an image.

    Images become level sets if `has_usual_level` is true. Errors name the shape by `which`.
    """
    if _is_function(shape):
        return shape
    try:
        own = as_shape(shape)
        is_converted = has_usual_level and own.IsA("vtkImageData")
        return as_level_set(own, *level_of_series([own])) if is_converted else own
    except (TypeError, ValueError) as error:
        raise type(error)(f"The {which} shape: {error}") from error


def _is_function(shape: Any) -> bool:
    return is_vtk(shape) and bool(shape.IsA("vtkImplicitFunction"))


def _fitted(shape: Any, model: Any, fit: str) -> Any:
    """Returns the shape, moved and scaled to the model; see `fit` of `morph`."""
    centre, size = _box(shape)
    to_centre, to_size = _box(model)
    if fit == "none" or size == 0 or to_size == 0:
        return shape
    scale = to_size / size if fit == "box" else 1.0
    moved = copy_of(shape)
    if shape.IsA("vtkImageData"):
        moved.SetOrigin(*(to_centre + scale * (numpy.array(shape.GetOrigin()) - centre)))
        moved.SetSpacing(*(scale * numpy.array(shape.GetSpacing())))
        return moved
    places = vtk_to_numpy(shape.GetPoints().GetData()).astype(float)
    moved.SetPoints(vtk_points(to_centre + scale * (places - centre)))
    return moved


def _describe_difference(first: Any, last: Any) -> str:
    """Returns a warning if two shapes differ much in size or position; else ""."""
    (centre, size), (to_centre, to_size) = _box(first), _box(last)
    if size == 0 or to_size == 0:
        return ""
    apart = float(numpy.linalg.norm(to_centre - centre))
    if 1 / _FAR <= to_size / size <= _FAR and apart <= 0.5 * max(size, to_size):
        return ""
    return (
        f"The longest side of the bounds is {size:g} for the first shape, {to_size:g} for the "
        f"last; the centres of the bounds are {apart:g} apart. If the shapes differ in unit or "
        "place, fit the last to the first by the option fit: box for size and place, centre for "
        "place."
    )


def _box(shape: Any) -> tuple[Any, float]:
    """Returns centre and longest side of the bounds; zeros for a shape without points."""
    if shape.GetNumberOfPoints() == 0:
        return numpy.zeros(3), 0.0
    bounds = numpy.array(shape.GetBounds()).reshape(3, 2)
    return bounds.mean(axis=1), float(numpy.ptp(bounds, axis=1).max())
