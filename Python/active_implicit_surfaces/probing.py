"""Converts atoms to images of their solvent-excluded surface; adds atoms' arrays to the skin.

>>> import active_implicit_surfaces as active
>>> skin = active.skin([[0, 0, 0], [3, 0, 0]], radii=[1.7, 1.7], probe=1.4)
>>> skin.GetNumberOfPolys() > 500
True
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Mapping
from typing import Any

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdList
from vtkmodules.vtkCommonDataModel import vtkStaticPointLocator

from .data_objects import array_names, as_particles
from .presets import median_step
from .series import TemporalSource
from .solvent import empty_image, excluded_distance, for_triangles, usual_voxel

_RADII = "radius"
_ADVICE = "give radii by arrays= of frames(), radii= of skin() or --radii of the command"
_FOLLOWING = 24.0  # distances to the target fall by a factor e^24 per step


class ProbedAtoms:
    """Solvent-excluded surface of each frame of atoms.

    - probe (float): radius of the probe [length], 0 or more.
    - preset (None): any preset raises ValueError.
    - arrays (dict): {"radii": name of the array of radii}; without the key, the name is "radius".
      Any other key raises ValueError.
    - options (dict): properties of the filter, which the constructor changes. "voxel_size", if
      missing or 0, becomes a quarter of the root mean square radius in the first frame with atoms.
      "attraction", if missing, becomes so large that the skin follows the atoms closely.
      "pass_target_arrays" is removed, as `add_arrays` does this work.

    Attributes:
    - source (TemporalSource): source of an image of distances for each frame of atoms.
    """

    def __init__(
        self,
        atoms: TemporalSource,
        probe: float,
        preset: str | None,
        arrays: Mapping[str, str],
        options: dict[str, Any],
    ) -> None:
        first, idle = atoms.first_frame(), sorted({*arrays} - {"radii"})
        if not 0 <= probe < float("inf"):
            raise ValueError(f"The probe's radius has to be finite and 0 or more, not {probe:g}.")
        if first.IsA("vtkImageData"):
            raise ValueError("A probe needs atoms, but the input is an image; leave probe out.")
        if preset is not None or idle:
            other = f"preset {preset}" if preset else f"array of {idle[0]}"
            raise ValueError(f"With a probe the {other} has no effect; leave it out.")
        self._atoms, self._probe, self._radii = atoms, probe, arrays.get("radii") or _RADII
        sizes = self._radii_of(first)
        usual = usual_voxel(sizes[sizes > 0]) if (sizes > 0).any() else 1.0
        self._voxel = options["voxel_size"] = options.get("voxel_size") or usual
        # With the filter's factor, e^6, the skin lags 0.2 Angstrom behind atoms that move by 1.5
        # Angstrom per step.
        step = median_step(atoms.times) * options.get("time_scale", 1.0)
        options.setdefault("attraction", _FOLLOWING / step)
        self._passes = options.pop("pass_target_arrays", False)
        self.source = TemporalSource(self._image, atoms.times, "vtkImageData", any_order=True)

    def _radii_of(self, atoms: Any) -> Any:
        array = atoms.GetPointData().GetArray(self._radii)
        if array is None:
            raise ValueError(
                f"The atoms have no array of numbers {self._radii!r}, but a probe needs van der "
                f"Waals radii; {_ADVICE}. With elements in an .xyz, .pdb or .dump, leave "
                "radii out."
            )
        if array.GetNumberOfComponents() != 1:
            raise ValueError(
                f"The array {self._radii!r} has {array.GetNumberOfComponents()} components, but "
                f"radii need one number for each atom; {_ADVICE}."
            )
        return vtk_to_numpy(array)

    def _image(self, step: int) -> Any:
        atoms = self._atoms.frame(step)
        if atoms.GetNumberOfPoints() == 0:
            return empty_image(self._voxel)
        points = vtk_to_numpy(atoms.GetPoints().GetData())
        return for_triangles(
            excluded_distance(points, self._radii_of(atoms), self._probe, self._voxel)
        )

    def add_arrays(self, skin: Any, time: float) -> None:
        """Adds to each point of a skin the arrays of the nearest atom, for `pass_target_arrays`.

        The atoms are those of the step nearest to `time`. Arrays of the skin are not replaced.
        """
        if not self._passes:
            return
        times = self._atoms.times
        after = min(bisect_left(times, time), len(times) - 1)
        step = min(max(0, after - 1), after, key=lambda i: abs(times[i] - time))
        atoms = as_particles(self._atoms.frame(step))
        if atoms.GetNumberOfPoints() == 0:
            return
        nearest = _nearest_points(atoms, skin)
        given, own = atoms.GetPointData(), skin.GetPointData()
        held = array_names(own)
        for name in array_names(given):
            if name not in held:
                array = given.GetAbstractArray(name)
                of_skin = array.NewInstance()
                of_skin.SetName(name)
                of_skin.SetNumberOfComponents(array.GetNumberOfComponents())
                of_skin.SetNumberOfTuples(nearest.GetNumberOfIds())
                array.GetTuples(nearest, of_skin)
                own.AddArray(of_skin)


def _nearest_points(cloud: Any, mesh: Any) -> Any:
    """Returns for each point of a mesh the index of the nearest point of a cloud."""
    found = vtkIdList()
    locator = vtkStaticPointLocator()
    locator.SetDataSet(cloud)
    locator.BuildLocator()
    count = mesh.GetNumberOfPoints()
    found.SetNumberOfIds(count)
    for i in range(count):
        found.SetId(i, locator.FindClosestPoint(mesh.GetPoint(i)))
    return found
