"""One shape becomes another in a given time."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from vtkmodules.vtkCommonExecutionModel import vtkTrivialProducer

from . import properties, vtkActiveImplicitSurface
from .api import Frame, copy_of
from .data_objects import as_shape, is_vtk, like
from .messages import listening, warn_all

_LEGS = 4000  # of a voxel, at most, in which the way is looked for
_NEAR = 0.25  # voxels from the target: arrived
_STILL = 20  # legs in which the volume is the same to five digits: what is off the target stays


class morph:
    """The skins on the way from one shape to another, which it reaches at the end.

    No points correspond: the surface moves along its normal, splits and merges. What the other
    shape has apart from the first one does not grow: let the shapes overlap.

    Parameters
    ----------
    a, b : vtkPolyData, vtkImageData, vtkImplicitFunction, or an object with `vertices` and `faces`
        Closed meshes, or images (inside is below `target_iso_value`). PyVista's, trimesh's and
        meshio's objects are taken too.
    duration : float
        The time at which `b` is reached, to half a voxel.
    frames : int
        Number of skins, the first and the last included.
    progress : callable(int, int), optional
        Called after each skin with the number of those done and of all.
    **options
        Properties of vtkActiveImplicitSurface in snake case, such as ``voxel_size=0.02``. Two
        functions need ``model_bounds``.

    Yields
    ------
    Frame
        `time` and `skin`, a vtkPolyData (a pyvista.PolyData if `a` is PyVista's).

    Attributes
    ----------
    surface : vtkActiveImplicitSurface

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
    at 1.0: 0.8
    at 2.0: 1.0
    """

    def __init__(
        self,
        a: Any,
        b: Any,
        duration: float = 1.0,
        *,
        frames: int = 25,
        progress: Callable[[int, int], None] | None = None,
        **options: Any,
    ) -> None:
        if not 0 < duration < float("inf"):
            raise ValueError(f"duration has to be more than 0 and finite, not {duration}.")
        if int(frames) != frames or frames < 2:
            raise ValueError(f"frames have to be 2 or more, not {frames}.")
        self.times = [duration * i / (frames - 1) for i in range(frames)]
        self.surface = vtkActiveImplicitSurface()
        self._example, self._progress = a, progress
        self._producers: list[Any] = []
        self._connect(a, b)
        properties.put(self.surface, options)
        if "attraction" not in options:
            self._arrive(duration, options)
        self.surface.SetNumberOfTimeSteps(frames)
        self.surface.SetTimeStepSize(duration / (frames - 1))

    def __len__(self) -> int:
        return len(self.times)

    def __iter__(self) -> Iterator[Frame]:
        for step, time in enumerate(self.times):
            _update(self.surface, time)
            if self._progress:
                self._progress(step + 1, len(self))
            yield Frame(time, like(self._example, copy_of(self.surface.GetOutput())))

    def _connect(self, a: Any, b: Any) -> None:
        if _is_function(a):
            self.surface.SetInitialFunction(a)
        else:
            self.surface.SetInputConnection(1, self._producer(a))
        if _is_function(b):
            self.surface.SetTargetFunction(b)
        else:
            self.surface.SetInputConnection(0, self._producer(b))

    def _producer(self, shape: Any) -> Any:
        producer = vtkTrivialProducer()
        producer.SetOutput(as_shape(shape))
        self._producers.append(producer)
        return producer.GetOutputPort()

    def _arrive(self, duration: float, options: dict[str, Any]) -> None:
        """Chooses the Attraction that takes the skin to the target in the duration.

        With a TargetReach of a voxel the skin goes at one speed, Attraction * TargetReach, and the
        way depends on Attraction * time alone: so it is gone once, to see how long it is.
        """
        surface = self.surface
        voxel = surface.GetVoxelSize() or _find_voxel(surface)
        surface.SetVoxelSize(voxel)
        if "target_reach" not in options:
            surface.SetTargetReach(voxel)
        reach = surface.GetTargetReach()
        surface.SetAttraction(1.0)
        surface.SetTimeStepSize(voxel / reach)
        surface.SetNumberOfTimeSteps(_LEGS + 1)
        tension = surface.GetTension()
        surface.SetTension(0.0)  # its rate belongs to the duration
        legs = _count_legs(surface, reach, voxel)
        surface.SetTension(tension)
        surface.SetAttraction(legs * voxel / reach / duration)


def _count_legs(surface: Any, reach: float, voxel: float) -> int:
    """Legs until the skin is on the target everywhere, or does not come nearer.

    The history tells the largest speed of a leg, which is the distance from the target, up to
    TargetReach, at the place that is farthest from it.
    """
    volumes: list[float] = []
    for leg in range(1, _LEGS + 1):
        _update(surface, leg * surface.GetTimeStepSize(), warns=False)
        if surface.GetOutput().GetNumberOfPoints() == 0:
            return leg
        history = surface.GetHistory()
        if history.GetValueByName(leg, "MaxSpeed").ToDouble() < min(_NEAR * voxel, 0.5 * reach):
            return max(1, leg - 1)
        volumes = [*volumes[1 - _STILL :], history.GetValueByName(leg, "Volume").ToDouble()]
        if len(volumes) == _STILL and max(volumes) - min(volumes) < 1e-5 * max(volumes):
            return max(1, leg - _STILL)
    return _LEGS


def _find_voxel(surface: Any) -> float:
    """The VoxelSize that the filter chooses."""
    _update(surface, 0.0, warns=False)
    surface.Update(1)
    return float(surface.GetPotential().GetSpacing()[0])


def _is_function(shape: Any) -> bool:
    return is_vtk(shape) and bool(shape.IsA("vtkImplicitFunction"))


def _update(surface: Any, time: float, warns: bool = True) -> None:
    with listening(surface) as heard:
        surface.UpdateTimeStep(time)
    heard.raise_error(ValueError)
    if warns:  # the way that is gone to know its length says the same as the one after it
        warn_all(heard.warnings)
