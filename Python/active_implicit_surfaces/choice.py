"""Selects particles and polygons by conditions, labels or size of clusters, and voxels by labels.

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
from pathlib import Path
from typing import Any, NamedTuple

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkPolyData

from .data_objects import add_array, array_names, copy_of, has_polygons, output_of, texts_of
from .mesh_writers import triangles_of
from .messages import few, warn

_FORM = re.compile(r"(?P<name>[^=<>!]+)(?P<sign>==?|!=|<=|>=|<|>)(?P<values>.+)")
_VALUE = re.compile(  # with or without quotes, up to the next comma
    r"""\s*(?:"([^"]*)"|'([^']*)'|([^,=<>!"]*[^,=<>!"\s]))\s*(?:,(?=.)|$)"""
)
_COMPONENT = re.compile(r"(?P<name>.+)[_:.\[](?P<axis>[xyz012])\]?")
_COMPARE = {
    "<": numpy.less,
    "<=": numpy.less_equal,
    ">": numpy.greater,
    ">=": numpy.greater_equal,
}
_MARK = "active_implicit_surfaces chosen"
_LABEL_ARRAYS = ("label", "labels")
_MOST_LABELS = 1000  # largest number of distinct labels
_MOST_LISTED = 20  # distinct values of an array in a message
_LINK = 1.5  # largest distance of neighbours in a cluster, in spacings


class Condition(NamedTuple):
    """Array name, comparison sign, and values as text."""

    name: str
    sign: str
    values: list[str]


def conditions(where: str | Sequence[str]) -> list[Condition]:
    """Parses conditions: "Type=1", "Type=1,3", "T>300", "id!=7", "resname=LIG", 'name="a, b"'.

    Raises ValueError if a text is not of this form.
    """
    found = []
    for text in [where] if isinstance(where, str) else where:
        form = _FORM.fullmatch(text)
        values = _split_values(form["values"]) if form else []
        is_order = form is not None and form["sign"] in _COMPARE
        if form is None or not values or (is_order and (len(values) > 1 or not _number(values[0]))):
            raise ValueError(
                f"{text!r} is no condition. A condition compares one array with numbers or texts: "
                "NAME=1, NAME=Na,Cl, NAME!=1, NAME<1, NAME>=1. Give each condition separately."
            )
        found.append(Condition(form["name"].strip(), form["sign"], values))
    return found


def _split_values(text: str) -> list[str]:
    """Splits text at commas outside quotes, and removes quotes; returns [] if text is malformed."""
    values, place = list[str](), 0
    while place < len(text):
        found = _VALUE.match(text, place)
        if found is None:
            return []
        values.append(next(part for part in found.groups() if part is not None))
        place = found.end()
    return values


def _number(text: str) -> list[float]:
    """Returns [number], or [] if the text is no number."""
    try:
        return [float(text)]
    except ValueError:
        return []


def choose(
    data: Any,
    where: str | Sequence[str] = (),
    label: int | None = None,
    note: Callable[[str], None] | None = None,
) -> Any:
    """Selects the points of a cloud, or the polygons of a mesh, that meet all conditions.

    A vector is compared by its length, or by a component such as v_x or v:0. x, y and z are the
    coordinates unless arrays have these names. A cell array selects polygons; a point array of a
    mesh selects the polygons whose points all meet the condition. Strips are cut into triangles.

    A `label` selects points or polygons by the array "label" or "labels". For an image, returns an
    image that is 1 at the label and 0 elsewhere. Data without points are returned unchanged.

    Raises ValueError if the array has none of the values after =. Warns of each other value after =
    or != that the array lacks. If `note` is given, `note` is called with the message instead of
    the error or the warning.

    Raises ValueError also if an array does not exist, < or > compares texts, numbers are compared
    with texts, an image lacks the label, a condition is malformed, or conditions are for an image.
    """
    if (where or label is not None) and data.IsA("vtkPolyData") and data.GetNumberOfStrips():
        data = triangles_of(data)
    if label is not None and data.GetNumberOfPoints():
        data = _choose_label(data, label)
    for condition in conditions(where):
        if data.GetNumberOfPoints() == 0:
            return data
        if not data.IsA("vtkPointSet"):
            raise ValueError(
                "Conditions select particles or polygons, not voxels; leave the conditions out, or "
                "choose a label of the image by the option --label of active-surface."
            )
        values, is_of_cells = _values_of(data, condition.name)
        chosen = _meets(values, condition, note)
        if not chosen.all():
            data = _marked(data, chosen.astype("u1"), is_of_cells)
    return data


def choose_in(file: str | Path, *arguments: Any) -> Any:
    """Selects by `choose` from the data of a file; errors name the file."""
    try:
        return choose(*arguments)
    except ValueError as error:
        raise ValueError(f"{file}: {error}") from error


def _meets(values: Any, condition: Condition, note: Callable[[str], None] | None) -> Any:
    """Returns an array that is True for each value that meets the condition, else False."""
    name, sign, wanted = condition
    is_text = values.dtype.kind == "U"
    numbers = [number for text in wanted for number in _number(text)]
    if sign in _COMPARE and not is_text:
        return _COMPARE[sign](values, numbers[0])
    if sign in _COMPARE or (not is_text and len(numbers) < len(wanted)):
        kind = "texts, which are compared by = and != only" if is_text else "numbers, not texts"
        raise ValueError(f"The array {name!r} holds {kind}; {_describe_values(name, values)}.")
    others = numpy.array(wanted if is_text else numbers)
    found = numpy.isin(values, others)
    absent = [text for text, other in zip(wanted, others) if not (values == other).any()]
    if absent:
        said = f"There is no {name}={','.join(absent)}; {_describe_values(name, values)}."
        if note is None and sign != "!=" and not found.any():
            raise ValueError(said)
        (note or warn)(said)
    return ~found if sign == "!=" else found


def _describe_values(name: str, values: Any) -> str:
    """Describes an array for a message: all distinct values, the first few values, or the range."""
    distinct = numpy.unique(values)
    if values.dtype.kind == "U" or len(distinct) <= _MOST_LISTED:
        listed = (repr("") if value == "" else value for value in distinct.tolist())
        return f"{name} is {few(listed, _MOST_LISTED)}"
    return f"{name} is from {numpy.nanmin(values):.9g} to {numpy.nanmax(values):.9g}"


def note_once() -> Callable[[str], None]:
    """Returns a `note` for `choose` that warns of the same absent values once in a series."""
    noted = set[str]()

    def note(said: str) -> None:
        value = said.partition(";")[0]
        if value not in noted:
            noted.add(value)
            warn(f"In a frame: {said[0].lower()}{said[1:]}")

    return note


def _values_of(data: Any, name: str) -> tuple[Any, bool]:
    """Returns one value per point or cell, and True if the array is a cell array."""
    held = ((data.GetPointData(), False), (data.GetCellData(), True))
    for attributes, is_of_cells in held:
        if (array := attributes.GetArray(name)) is not None:
            values = vtk_to_numpy(array)
            return numpy.linalg.norm(values, axis=1) if values.ndim > 1 else values, is_of_cells
        if (texts := texts_of(attributes, name)) is not None:
            return texts, is_of_cells
    if name in ("x", "y", "z"):
        return vtk_to_numpy(data.GetPoints().GetData())[:, "xyz".index(name)], False
    if component := _COMPONENT.fullmatch(name):
        axis = "xyz012".index(component["axis"]) % 3
        for attributes, is_of_cells in held:
            array = attributes.GetArray(component["name"])
            if array is not None and array.GetNumberOfComponents() > max(axis, 1):
                return vtk_to_numpy(array)[:, axis], is_of_cells
    held_names = [one for attributes, _ in held for one in array_names(attributes)]
    listed = ", ".join(["x", "y", "z", *held_names])
    raise ValueError(f"There is no array {name!r} to choose by; there are {listed}.")


def _marked(data: Any, marks: Any, is_of_cells: bool) -> Any:
    from vtkmodules.vtkFiltersCore import vtkThreshold, vtkThresholdPoints
    from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter

    own = copy_of(data)
    add_array(own, _MARK, marks, own.GetCellData() if is_of_cells else None)
    is_of_mesh = has_polygons(data) or is_of_cells
    one = vtkThreshold() if is_of_mesh else vtkThresholdPoints()
    kind = "CELLS" if is_of_cells else "POINTS"
    one.SetInputArrayToProcess(0, 0, 0, getattr(vtkDataObject, f"FIELD_ASSOCIATION_{kind}"), _MARK)
    one.SetLowerThreshold(1.0)
    one.SetUpperThreshold(1.0)
    found = output_of(one, own)
    found = output_of(vtkGeometryFilter(), found) if is_of_mesh else found
    for attributes in (found.GetPointData(), found.GetCellData()):
        attributes.RemoveArray(_MARK)
    found.SetFieldData(data.GetFieldData())
    return found


def labels_of(data: Any) -> list[int]:
    """Returns the labels of an image except 0, or all labels of particles or a mesh.

    Raises ValueError if particles or a mesh have no array "label" or "labels", a value is no
    integer (a text, 1.5, NaN), or there are more than a thousand distinct values.
    """
    values = numpy.unique(_labels_in(data))
    if values.dtype.kind == "U":
        raise ValueError("There are no labels: the values are texts; select by --where NAME=TEXT.")
    if not are_whole(values):
        raise ValueError(
            "There are no labels: not all values are whole numbers; leave out --label."
        )
    if len(values) > _MOST_LABELS:
        raise ValueError(
            f"The array has {len(values)} different values, more than {_MOST_LABELS}, so labels "
            "are not listed; give a label that the array has, or leave out --label."
        )
    return [int(value) for value in values if value != 0 or not data.IsA("vtkImageData")]


def are_whole(numbers: Any) -> bool:
    """Returns True if all numbers are whole, none infinite or NaN."""
    return bool(numpy.isfinite(numbers).all() and (numbers == numbers.round()).all())


def _choose_label(data: Any, label: int) -> Any:
    values = _labels_in(data)
    if not data.IsA("vtkImageData"):
        name = next(name for name in _LABEL_ARRAYS if _has(data, name))
        return choose(data, f"{name}={label}", note=lambda _: None)  # this frame may lack the label
    if not (values == label).any():
        there = few(labels_of(data), 20) or "none"
        raise ValueError(f"The image has no label {label}; it has {there}.")
    return image_of_label(data, label)


def image_of_label(data: Any, label: int) -> Any:
    """Returns an image that is 1 where `data` has the label, and 0 elsewhere."""
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
    raise ValueError(
        "There is no array 'label' or 'labels'; select by another array: --where NAME=3."
    )


def without_small_pieces(cloud: Any, minimum: int, spacing: float) -> Any:
    """Removes particles of clusters of fewer than `minimum` particles; keeps the particles' order.

    Neighbours in a cluster are at most 1.5 times `spacing` apart. All particles are kept if
    `spacing` is 0 or infinite.
    """
    from vtkmodules.vtkFiltersPoints import vtkEuclideanClusterExtraction

    if cloud.GetNumberOfPoints() == 0 or not 0 < spacing < float("inf"):
        return cloud
    numbers = numpy.arange(cloud.GetNumberOfPoints())
    bare, clusters = vtkPolyData(), vtkEuclideanClusterExtraction()
    bare.SetPoints(cloud.GetPoints())
    add_array(bare, _MARK, numbers)
    clusters.SetRadius(_LINK * spacing)
    clusters.SetExtractionModeToAllClusters()
    clusters.ColorClustersOn()
    found = output_of(clusters, bare).GetPointData()  # in another order
    ids = vtk_to_numpy(found.GetArray("ClusterId"))
    kept = vtk_to_numpy(found.GetArray(_MARK))[numpy.bincount(ids)[ids] >= minimum]
    return _marked(cloud, numpy.isin(numbers, kept).astype("u1"), False)
