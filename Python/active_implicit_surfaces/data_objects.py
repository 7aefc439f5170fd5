"""Converts particles and meshes of Python libraries to data objects of VTK.

>>> import numpy
>>> from active_implicit_surfaces import data_objects
>>> points = data_objects.as_particles(numpy.zeros((4, 3)), ids=[7, 8, 9, 10])
>>> points.GetNumberOfPoints(), points.GetPointData().GetArray("id").GetValue(0)
(4, 7)
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Mapping
from typing import Any

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkObjectBase, vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter

from . import vtk_build

# Cells of meshio that are faces of a surface.
_FACES = ("triangle", "quad", "polygon")
_BOX = ("Lattice", "Origin", "pbc")  # field data of particles in a periodic box
_USUAL_IDS = ("id", "ids", "particle_id", "particleid", "pid")


def as_particles(particles: Any, **arrays: Any) -> Any:
    """Returns points and their arrays as a vtkPolyData; shares the memory of arrays if possible.

    - particles (array (n, 3), vtkPointSet, or an object with `points` or `vertices`): all points
      are used; cells are left out, and so are field data other than a periodic box.
    - **arrays (array (n,) or (n, k), optional): point arrays to add, named by the keyword, except
      that ``velocities`` is named "Velocity", ``ids`` "id", ``radii`` "radius", ``strengths``
      "strength".

    Raises TypeError if particles or arrays have a wrong type, or rows of positions differ in
    length; ValueError if positions or an array have another wrong shape.
    """
    points, own = _points_of(particles)
    cloud = vtkPolyData()
    cloud.SetPoints(points)
    if own is not None:
        cloud.GetPointData().ShallowCopy(own)
        for array in filter(None, map(particles.GetFieldData().GetArray, _BOX)):
            cloud.GetFieldData().AddArray(array)
    for name, values in {**_point_data(particles), **arrays}.items():
        if values is not None:
            add_array(cloud, STANDARD_NAMES.get(name, name), values)
    return cloud


def finite_points(cloud: Any) -> Any:
    """Returns `cloud` if all coordinates are finite, else its finite points, without arrays.

    The filter ignores points whose coordinates are not finite.
    """
    if cloud.GetNumberOfPoints() == 0:
        return cloud
    points = vtk_to_numpy(cloud.GetPoints().GetData())
    are_finite = numpy.isfinite(points).all(axis=1)
    if are_finite.all():
        return cloud
    kept = vtkPolyData()
    kept.SetPoints(vtk_points(points[are_finite]))
    return kept


# Keywords, and the names of the arrays that they set.
STANDARD_NAMES = {
    "velocities": "Velocity",
    "ids": "id",
    "radii": "radius",
    "strengths": "strength",
}


def as_shape(shape: Any) -> Any:
    """Returns a mesh or image as a vtkPolyData with polygons or lines, or as a vtkImageData.

    `shape` is a vtkPointSet or vtkImageData, or an object with `vertices` and `faces` (as
    trimesh's), or with `points` and `cells` (as meshio's).

    Raises ValueError if a VTK mesh has neither polygons nor lines, `cells` has no polygons, or
    `faces` is no table of numbers; TypeError if `shape` is another object.
    """
    if _is_vtk(shape, "vtkImageData"):
        return shape
    if _is_vtk(shape, "vtkPolyData"):
        if not has_polygons(shape) and shape.GetNumberOfLines() == 0:
            raise ValueError(
                "There are no polygons and no lines; give a mesh or, for a skin over points, use "
                "skin() or active-surface skin."
            )
        return shape
    if _is_vtk(shape, "vtkPointSet"):
        return as_shape(output_of(vtkGeometryFilter(), shape))
    if hasattr(shape, "vertices") and hasattr(shape, "faces"):
        return _mesh(shape.vertices, [shape.faces])
    if hasattr(shape, "points") and hasattr(shape, "cells"):
        return _mesh(shape.points, [c.data for c in shape.cells if c.type in _FACES])
    raise TypeError(
        f"A {type(shape).__name__} is no mesh and no image; give a vtkPolyData, a vtkImageData, or "
        "an object with the attributes `vertices` and `faces`, or `points` and `cells`."
    )


def output_of(algorithm: Any, *data: Any) -> Any:
    """Returns the output of a filter for one data set, or of an appending filter for several."""
    for one in data:
        (algorithm.AddInputData if len(data) > 1 else algorithm.SetInputData)(one)
    algorithm.Update()
    return algorithm.GetOutput()


def copy_of(data: Any) -> Any:
    """Returns a shallow copy, which stays as it is if the source's next update makes new arrays."""
    copy = data.NewInstance()
    copy.ShallowCopy(data)
    return copy


def like(example: Any, skin: Any) -> Any:
    """Returns the skin as a pyvista.PolyData if `example` is of PyVista, else the skin itself."""
    if type(example).__module__.partition(".")[0] == "pyvista":
        return sys.modules["pyvista"].wrap(skin)
    return skin


def is_vtk(thing: Any) -> bool:
    """Returns True for a VTK object. Raises TypeError for an object of another copy of VTK."""
    if isinstance(thing, vtkObjectBase):
        return True
    if hasattr(thing, "IsA") and hasattr(thing, "GetClassName"):
        raise TypeError(
            f"This {thing.GetClassName()} is of another VTK than that of active_implicit_surfaces, "
            f"which uses the package {vtk_build.PACKAGE}; use classes of that package. For "
            "PyVista, set the environment variable PYVISTA_VTK_BACKEND to "
            f"{vtk_build.backend_of(vtk_build.PACKAGE)} before PyVista is imported."
        )
    return False


def _is_vtk(thing: Any, name: str) -> bool:
    return is_vtk(thing) and bool(thing.IsA(name))


def _points_of(particles: Any) -> tuple[Any, Any]:
    """Returns the vtkPoints of particles, and the point data of a VTK object (else None)."""
    if is_vtk(particles):
        if not particles.IsA("vtkPointSet"):
            raise TypeError(
                f"A {particles.GetClassName()} is no set of particles; give a vtkPointSet, such as "
                "a vtkPolyData, or an array of n rows and 3 columns."
            )
        return particles.GetPoints() or vtkPoints(), particles.GetPointData()
    for name in ("points", "vertices"):
        if hasattr(particles, name):
            return vtk_points(getattr(particles, name)), None
    return vtk_points(particles), None


def vtk_points(positions: Any) -> Any:
    """Converts an array (n, 3) to vtkPoints."""
    try:
        if positions is None:
            raise TypeError
        numbers = numpy.asarray(_without_mask(positions))
        numbers = numbers if numbers.dtype in ("f4", "f8") else numbers.astype(float)
    except (TypeError, ValueError) as error:
        if isinstance(positions, (str, os.PathLike)):
            raise TypeError(
                f"{positions!r} is a name, not an array; to read a file, call frames(), or run "
                "active-surface skin."
            ) from error
        raise TypeError(
            f"A {type(positions).__name__} is no set of particles; give numbers in n rows and 3 "
            "columns, a vtkPointSet, or an object with the attribute `points` or `vertices`."
        ) from error
    if numbers.size == 0:
        numbers = numbers.reshape(0, 3)
    if numbers.ndim != 2 or numbers.shape[1] != 3:
        hint = ""
        if numbers.shape == (3,):
            hint = (
                " If this is a row of an array of positions, the whole array is one frame: give it "
                "to skin(), or a list of such arrays to frames()."
            )
        raise ValueError(
            "Positions have to be an array of n rows and 3 columns; the shape is "
            f"{numbers.shape}.{hint}"
        )
    points = vtkPoints()
    points.SetData(numpy_to_vtk(numpy.ascontiguousarray(numbers)))
    return points


def points_of(data: Any) -> Any:
    """Returns the coordinates of the points of `data`, an array (n, 3)."""
    points = data.GetPoints()
    return vtk_to_numpy(points.GetData()) if points else numpy.zeros((0, 3), "f4")


def _without_mask(values: Any) -> Any:
    """Replaces masked numbers by NaN; the filter ignores particles with NaN coordinates."""
    if not isinstance(values, numpy.ma.MaskedArray):
        return values
    kind = values.dtype if values.dtype.kind == "f" else float
    return numpy.ma.filled(values.astype(kind), numpy.nan)


def _point_data(particles: Any) -> Mapping[str, Any]:
    """Returns the point arrays of an object like meshio's, by name; {} for other objects."""
    if is_vtk(particles):
        return {}
    data = getattr(particles, "point_data", {})
    return data if isinstance(data, Mapping) else {}


def has_polygons(data: Any) -> bool:
    """Returns True for a vtkPolyData with polygons or strips."""
    return bool(data.IsA("vtkPolyData") and data.GetNumberOfPolys() + data.GetNumberOfStrips() > 0)


def blocks_of(data: Any) -> Iterator[Any]:
    """Yields the data sets in the blocks of a composite data set, at any depth."""
    blocks = data.NewIterator()
    while not blocks.IsDoneWithTraversal():
        yield blocks.GetCurrentDataObject()
        blocks.GoToNextItem()


def array_names(attributes: Any) -> list[str]:
    """Returns the names of the arrays of points, cells or fields; "" for arrays without a name."""
    return [attributes.GetArrayName(i) or "" for i in range(attributes.GetNumberOfArrays())]


def add_array(cloud: Any, name: str, values: Any, attributes: Any = None) -> None:
    """Adds an array to `attributes`, by default those of the points; shares memory if possible.

    Texts are copied to a vtkStringArray; masked numbers become NaN.
    """
    if numpy.ma.is_masked(values) and values.dtype.kind in "biuf":
        values = _without_mask(values)
    numbers = numpy.ascontiguousarray(values)
    if numbers.dtype == object and all(isinstance(value, str) for value in numbers.flat):
        numbers = numbers.astype(str)
    is_text = numbers.dtype.kind == "U" and numbers.ndim == 1
    if numbers.dtype == bool:
        numbers = numbers.astype("u1")
    if numbers.dtype.kind not in "iuf" and not is_text:
        raise TypeError(
            f'The array "{name}" has neither real numbers nor one text a row; leave it out.'
        )
    if numbers.dtype.itemsize == 2 and numbers.dtype.kind == "f":
        numbers = numbers.astype("f4")
    is_of_points = attributes is None
    if len(numbers.shape) not in (1, 2) or (
        is_of_points and len(numbers) != cloud.GetNumberOfPoints()
    ):
        raise ValueError(
            f'The array "{name}" has the shape {numbers.shape}; the shape has to be (n,) or '
            f"(n, k), where n is the number of particles, {cloud.GetNumberOfPoints()}."
        )
    array = _string_array(numbers) if is_text else numpy_to_vtk(numbers)
    array.SetName(name)
    (cloud.GetPointData() if is_of_points else attributes).AddArray(array)


def _string_array(texts: Any) -> Any:
    array = vtkStringArray()
    array.SetNumberOfValues(len(texts))
    for i, text in enumerate(texts.tolist()):
        array.SetValue(i, text)
    return array


def texts_of(attributes: Any, name: str) -> Any:
    """Returns the vtkStringArray `name` of one component as a numpy array; None if missing."""
    array = attributes.GetAbstractArray(name)
    if array is None or not array.IsA("vtkStringArray") or array.GetNumberOfComponents() != 1:
        return None
    return numpy.array([array.GetValue(i) for i in range(array.GetNumberOfValues())], dtype=str)


def cell_array(offsets: Any, ids: Any) -> Any:
    """Makes a vtkCellArray from offsets and point ids."""
    cells = vtkCellArray()
    cells.SetData(
        numpy_to_vtkIdTypeArray(offsets.astype(numpy.int64), deep=True),
        numpy_to_vtkIdTypeArray(ids.astype(numpy.int64), deep=True),
    )
    return cells


def _mesh(vertices: Any, kinds: list[Any]) -> Any:
    """Makes a mesh whose polygons are the rows of `kinds`, a list of arrays of point ids."""
    mesh = vtkPolyData()
    mesh.SetPoints(vtk_points(vertices))
    offsets, numbers = [numpy.zeros(1, dtype=numpy.int64)], []
    for rows in kinds:
        try:
            faces = numpy.ascontiguousarray(rows, dtype=numpy.int64)
        except (TypeError, ValueError) as error:
            raise ValueError(
                "Faces have to be rows of point ids, all rows of one length and of whole numbers."
            ) from error
        if faces.ndim != 2:
            raise ValueError(f"Faces have to be rows of point ids; the shape is {faces.shape}.")
        start = offsets[-1][-1]
        offsets.append(start + faces.shape[1] * numpy.arange(1, len(faces) + 1))
        numbers.append(faces.ravel())
    if not numbers:
        raise ValueError("The mesh has no triangles, quads or polygons; give a surface mesh.")
    mesh.SetPolys(cell_array(numpy.concatenate(offsets), numpy.concatenate(numbers)))
    return mesh


def usual_ids(cloud: Any) -> str:
    """Returns the name of the point array with a usual name of ids, such as "id"; "" for none."""
    if not hasattr(cloud, "GetPointData"):
        return ""
    arrays = cloud.GetPointData()
    usual = (arrays.GetArray(n) for n in array_names(arrays) if n.lower() in _USUAL_IDS)
    return next((own.GetName() for own in usual if own and own.GetNumberOfComponents() == 1), "")
