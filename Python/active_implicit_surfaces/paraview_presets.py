"""Applies the presets of `active-surface skin --preset` in ParaView's Python and macros.

>>> from active_implicit_surfaces.presets import PRESETS
>>> sorted(PRESETS)
['grains', 'molecule', 'paper', 'viscous']
"""

from __future__ import annotations

from typing import Any

from vtkmodules.vtkCommonDataModel import vtkDataObject

from . import properties, vtkActiveImplicitSurface
from .presets import PRESETS, apply_preset
from .series import TemporalSource

_RADIUS = 0  # index of SetInputArrayToProcess
# Properties that users set too: kept, unless the value is that of another preset.
_LENGTHS = {"VoxelSize", "KernelRadius", "RadiusArray"}


def apply(name: str, surface: Any = None) -> dict[str, Any]:
    """Sets the properties of a preset on a filter Active Implicit Surface of a ParaView session.

    The values appear in the panel, where the user can change them, and are saved in state files.
    Values depend on the particles at the first time step (their radii, and their spacing unless
    Particle Spacing is set), the median time between two steps, and Time Scale. The particles are
    sent to the client. Properties that only other presets set return to their defaults, except a
    voxel size, a kernel radius or a radius array that the user has set.

    Parameters
    ----------
    name : {"viscous", "molecule", "grains", "paper"}
    surface : proxy, optional
        Result of paraview.simple.ActiveImplicitSurface(). Default: the active source.

    Returns
    -------
    dict
        Values of the properties that the preset has set, by the properties' names in ParaView.

    Raises
    ------
    ValueError
        There is no such preset, or the source is no Active Implicit Surface over particles.
    """
    from paraview import servermanager, simple

    proxy = simple.GetActiveSource() if surface is None else surface
    if proxy is None or proxy.GetXMLName() != "ActiveImplicitSurface":
        raise ValueError(
            "The source is no Active Implicit Surface. Select an Active Implicit Surface over "
            "particles in the Pipeline Browser, or give it to apply() as surface=."
        )
    target = proxy.Input
    times = [float(time) for time in proxy.TimestepValues] or [0.0]
    target.UpdatePipeline(times[0])
    particles = servermanager.Fetch(target)
    if not particles.IsA("vtkPointSet"):
        raise ValueError(
            f"A preset needs particles, not a {particles.GetClassName()}; connect a point set."
        )
    given = {"particle_spacing": proxy.ParticleSpacing, "time_scale": proxy.TimeScale}
    given = properties.given(given)
    frames = TemporalSource(lambda step: particles, times)
    chosen = _changes(name, frames, given)
    for other in PRESETS:
        changes = _changes(other, frames, given)
        for key in set(changes) - set(chosen):
            if key not in _LENGTHS or _values(getattr(proxy, key)) == _values(changes[key]):
                setattr(proxy, key, _default_of(key))
    for key, value in chosen.items():
        setattr(proxy, key, value)
    proxy.UpdateVTKObjects()
    return chosen


def _changes(name: str, frames: TemporalSource, given: dict[str, Any]) -> dict[str, Any]:
    """Returns the values that a preset changes on a new filter, by ParaView's property names."""
    plain = vtkActiveImplicitSurface()
    apply_preset(plain, frames, name, None, given)
    found = {
        one.name: value
        for one in properties.every()
        if one.kind != "object" and (value := getattr(plain, "Get" + one.name)()) != one.default
    }
    radii = plain.GetInputArrayInformation(_RADIUS).Get(vtkDataObject.FIELD_NAME())
    return {**found, "RadiusArray": ["POINTS", radii]} if radii else found


def _values(value: Any) -> list[str]:
    """Returns the elements of a value as texts; ParaView returns a list, or one value itself."""
    return [str(part) for part in ([value] if isinstance(value, (int, float)) else value)]


def _default_of(key: str) -> Any:
    none = ["POINTS", ""]
    return none if key == "RadiusArray" else getattr(vtkActiveImplicitSurface(), "Get" + key)()
