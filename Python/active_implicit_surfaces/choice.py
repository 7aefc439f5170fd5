"""Chooses what counts before the skin is made: conditions on arrays, labels, size of pieces.

>>> import numpy
>>> from active_implicit_surfaces import choice
>>> from active_implicit_surfaces.data_objects import as_particles
>>> cloud = as_particles(numpy.eye(3), Type=[1, 3, 3], T=[300, 310, 290])
>>> choice.choose(cloud, ["Type=3", "T>300"]).GetNumberOfPoints()
1
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataObject

from .data_objects import add_array, array_names, has_polygons
from .messages import few

_FORM = re.compile(r"(?P<name>[^=<>!]+)(?P<sign>==?|!=|<=|>=|<|>)(?P<values>[^=<>!]+)")
_COMPONENT = re.compile(r"(?P<name>.+)[_:.\[](?P<axis>[xyz012])\]?")
_COMPARE: dict[str, Callable[..., Any]] = {
    **dict.fromkeys(("=", "=="), numpy.isin),
    "!=": lambda values, others: ~numpy.isin(values, others),
    "<": lambda values, others: values < others[0],
    "<=": lambda values, others: values <= others[0],
    ">": lambda values, others: values > others[0],
    ">=": lambda values, others: values >= others[0],
}
_MARK = "active_implicit_surfaces chosen"
_LABEL_ARRAYS = ("label", "labels")
_MOST_LABELS = 1000  # distinct values of an image; more are no labels
_LINK = 1.5  # spacings between neighbours of one piece


class Condition(NamedTuple):
    """The name of an array, a sign, and numbers."""

    name: str
    sign: str
    values: list[float]


def conditions(where: str | Sequence[str]) -> list[Condition]:
    """Conditions from text: "Type=1", "Type=1,3", "T>300", "id!=7".

    Raises
    ------
    ValueError
        Text of another form.
    """
    found = []
    for text in [where] if isinstance(where, str) else where:
        form = _FORM.fullmatch(text)
        try:
            values = [float(value) for value in form["values"].split(",")] if form else []
        except ValueError:
            values = []
        if form is None or not values or (len(values) > 1 and form["sign"][0] in "<>"):
            raise ValueError(
                f"{text!r} is no condition, which compares one array with numbers; write NAME=1, "
                "NAME=1,2 or NAME!=1, NAME<1, NAME>=1, several as conditions of their own."
            )
        found.append(Condition(form["name"].strip(), form["sign"], values))
    return found


def choose(data: Any, where: str | Sequence[str] = (), label: int | None = None) -> Any:
    """The points of a cloud, or the polygons of a mesh, that meet all conditions.

    An array of vectors counts by its length, or as v_x, v:0 ... by a component; x, y and z are the
    position unless arrays have these names. Polygons count if all their points do, or by an array
    of cells.

    A label chooses those whose array "label" or "labels" has it; an image becomes 1 there and 0
    elsewhere.

    Raises
    ------
    ValueError
        There is no such array, an image has no such label, or a condition is for an image.
    """
    if label is not None and data.GetNumberOfPoints():
        data = _choose_label(data, label)
    for condition in conditions(where):
        if data.GetNumberOfPoints() == 0:
            return data
        if not data.IsA("vtkPointSet"):
            raise ValueError(
                "Conditions choose particles and polygons; of an image, choose labels."
            )
        values, is_of_cells = _values_of(data, condition.name)
        chosen = _COMPARE[condition.sign](values, condition.values)
        if not chosen.all():
            data = _marked(data, chosen.astype("u1"), is_of_cells)
    return data


def _values_of(data: Any, name: str) -> tuple[Any, bool]:
    """One number for each point, or for each cell, and whether it is for cells."""
    arrays = (data.GetPointData().GetArray(name), data.GetCellData().GetArray(name))
    for is_of_cells, array in enumerate(arrays):
        if array is not None:
            values = vtk_to_numpy(array)
            return numpy.linalg.norm(values, axis=1) if values.ndim > 1 else values, bool(
                is_of_cells
            )
    if name in ("x", "y", "z"):
        return vtk_to_numpy(data.GetPoints().GetData())[:, "xyz".index(name)], False
    if component := _COMPONENT.fullmatch(name):
        axis = "xyz012".index(component["axis"]) % 3
        for is_of_cells, attributes in enumerate((data.GetPointData(), data.GetCellData())):
            array = attributes.GetArray(component["name"])
            if array is not None and array.GetNumberOfComponents() > axis:
                return vtk_to_numpy(array)[:, axis], bool(is_of_cells)
    listed = ", ".join(["x", "y", "z", *array_names(data.GetPointData())])
    raise ValueError(f"There is no array {name!r} to choose by; there are {listed}.")


def _marked(data: Any, marks: Any, is_of_cells: bool) -> Any:
    from vtkmodules.vtkFiltersCore import vtkThreshold, vtkThresholdPoints
    from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter

    own = data.NewInstance()
    own.ShallowCopy(data)
    add_array(own, _MARK, marks, own.GetCellData() if is_of_cells else None)
    one = vtkThreshold() if has_polygons(data) or is_of_cells else vtkThresholdPoints()
    kind = "CELLS" if is_of_cells else "POINTS"
    one.SetInputArrayToProcess(0, 0, 0, getattr(vtkDataObject, f"FIELD_ASSOCIATION_{kind}"), _MARK)
    one.SetInputData(own)
    if isinstance(one, vtkThreshold):
        one.SetLowerThreshold(0.5)
        one.SetUpperThreshold(1.5)
        outside = vtkGeometryFilter()
        outside.SetInputConnection(one.GetOutputPort())
        outside.Update()
        found = outside.GetOutput()
    else:
        one.ThresholdByUpper(0.5)
        one.Update()
        found = one.GetOutput()
    for attributes in (found.GetPointData(), found.GetCellData()):
        attributes.RemoveArray(_MARK)
    found.SetFieldData(data.GetFieldData())
    return found


def labels_of(data: Any) -> list[int]:
    """The labels of an image, of its points or cells, but 0; or those of an array of particles.

    Raises
    ------
    ValueError
        There are none: no integers, or more than a thousand values.
    """
    values = numpy.unique(_labels_in(data))
    if values.dtype.kind not in "iu" and not numpy.array_equal(values, values.round()):
        raise ValueError("There are no labels: the values are no whole numbers.")
    if len(values) > _MOST_LABELS:
        raise ValueError(f"There are no labels: the values are {len(values)} different ones.")
    return [int(value) for value in values if value != 0 or not data.IsA("vtkImageData")]


def _choose_label(data: Any, label: int) -> Any:
    values = _labels_in(data)
    if not data.IsA("vtkImageData"):
        name = next(name for name in _LABEL_ARRAYS if _has(data, name))
        return choose(data, f"{name}={label}")
    if not (values == label).any():
        there = few(labels_of(data), 20)
        raise ValueError(f"The image has no label {label}; it has {there}.")
    return image_of_label(data, label)


def image_of_label(data: Any, label: int) -> Any:
    """An image that is 1 where another has a label, and 0 elsewhere."""
    is_there = _labels_in(data) == label
    own = data.NewInstance()
    own.CopyStructure(data)
    is_of_points = data.GetPointData().GetScalars() is not None
    attributes = own.GetPointData() if is_of_points else own.GetCellData()
    add_array(own, "label", is_there.astype("u1"), attributes)
    attributes.SetActiveScalars("label")
    return own


def _has(data: Any, name: str) -> bool:
    return bool(data.GetPointData().HasArray(name) or data.GetCellData().HasArray(name))


def _labels_in(data: Any) -> Any:
    if data.IsA("vtkImageData"):
        scalars = data.GetPointData().GetScalars() or data.GetCellData().GetScalars()
        return numpy.empty(0, int) if scalars is None else vtk_to_numpy(scalars)
    for name in _LABEL_ARRAYS:
        if _has(data, name):
            return _values_of(data, name)[0]
    raise ValueError("There is no array 'label' or 'labels'; choose by another one: where NAME=3.")


def without_small_pieces(cloud: Any, minimum: int, spacing: float) -> Any:
    """The particles of clusters with a minimum of them.

    Neighbours are at most 1.5 spacings apart.
    """
    from vtkmodules.vtkFiltersPoints import vtkEuclideanClusterExtraction

    if cloud.GetNumberOfPoints() == 0 or not 0 < spacing < float("inf"):
        return cloud
    clusters = vtkEuclideanClusterExtraction()
    clusters.SetInputData(cloud)
    clusters.SetRadius(_LINK * spacing)
    clusters.SetExtractionModeToAllClusters()
    clusters.ColorClustersOn()
    clusters.Update()
    found = clusters.GetOutput()
    ids = vtk_to_numpy(found.GetPointData().GetArray("ClusterId"))
    found.GetPointData().RemoveArray("ClusterId")
    return _marked(found, (numpy.bincount(ids)[ids] >= minimum).astype("u1"), False)
