"""Reads medical images by VTK's readers, and corrects three errors of the readers.

VTK accepts a .mha or .nrrd whose end is missing, reads the first of three .nrrd axes as components,
and ignores the origin of a .nii.
"""

from __future__ import annotations

import gzip
import math
import re
import tempfile
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDataArray

from .messages import quiet, warn

IMAGE_SUFFIXES = (".vti", ".nii", ".nii.gz", ".nrrd", ".nhdr", ".mha", ".mhd")
_FIELD = re.compile(r"(?m)^[ \t]*([^#:=\n]+?)[ \t]*[:=]+[ \t]*(.*?)[ \t\r]*$")
_TURNS = ("TransformMatrix", "Rotation", "Orientation")  # fields of a .mha with the rotation
_ALONG = 0.999  # least cosine of the angle between parallel axes of image and space
_DAMAGE = (ValueError, KeyError, OverflowError, EOFError, zlib.error, gzip.BadGzipFile)


def read_image(path: Path, reader: Any, update: Callable[[Any], Any]) -> Any:
    """Reads a file of IMAGE_SUFFIXES other than .vti by `reader`, VTK's reader of this format.

    `update` updates a reader and returns its output. Raises OSError if the file is damaged or
    incomplete, or has an unsupported encoding.
    """
    try:
        if ".nii" in path.name.lower()[-7:]:
            return _read_nifti(path, reader, update)
        fields, values = _parts_of(path)
        if path.suffix.lower() in (".nrrd", ".nhdr"):
            return _read_nrrd(path, fields, values, reader, update)
        _check_size(reader, len(values))
        image = update(reader)
        turn = next((name for name in _TURNS if fields.get(name)), "")
        words = fields[turn].split() if turn else "1 0 0 0 1 0 0 0 1".split()
        if len(words) != 9:
            raise ValueError(
                f"its {turn} has {len(words)} number(s), not 9; write an image of three axes"
            )
        axes = numpy.array(words, dtype=float).reshape(3, 3)
        return _place(path, image, image.GetOrigin(), axes)
    except _DAMAGE as error:
        said = f"it has no {error}" if isinstance(error, KeyError) else str(error)
        raise OSError(f"{path} cannot be read: {said.rstrip('.')}.") from error


def _check_size(reader: Any, size: int) -> None:
    """Raises ValueError if the header is invalid, or describes more than `size` [bytes]."""
    with quiet() as said:
        reader.UpdateInformation()
    if said.errors:
        told = [text for text in said.errors if "returned failure for request" not in text]
        raise ValueError(told[0] if told else "its header is invalid; write it again")
    low_high = reader.GetDataExtent()
    count = math.prod(high - low + 1 for low, high in zip(low_high[::2], low_high[1::2]))
    width = vtkDataArray.GetDataTypeSize(reader.GetDataScalarType())
    needed = count * width * reader.GetNumberOfScalarComponents()
    if not 0 < needed <= size:
        raise ValueError(
            f"its header describes {needed} bytes of values, but the number has to be from 1 to "
            f"{size}, the size of the data; write it again"
        )


def _read_nifti(path: Path, reader: Any, update: Callable[[Any], Any]) -> Any:
    """Reads a .nii with its origin and its scale of values."""
    with (gzip.open if path.suffix.lower() == ".gz" else open)(path, "rb") as file:
        _check_size(reader, len(file.read()))
    image = update(reader)
    matrix = reader.GetSFormMatrix() or reader.GetQFormMatrix()
    if matrix is not None:
        rows = numpy.array([[matrix.GetElement(i, j) for j in range(4)] for i in range(3)])
        image = _place(path, image, rows[:, 3], rows[:, :3].T)
    slope, start = reader.GetRescaleSlope(), reader.GetRescaleIntercept()
    scalars = image.GetPointData().GetScalars()
    if (slope, start) not in ((1.0, 0.0), (0.0, 0.0)):
        scaled = numpy_to_vtk(vtk_to_numpy(scalars) * slope + start, deep=True)
        scaled.SetName(scalars.GetName())
        image.GetPointData().SetScalars(scaled)
    return image


def _parts_of(path: Path) -> tuple[dict[str, str], bytes]:
    """Returns the fields of the header, and the values as uncompressed bytes."""
    content, is_meta = path.read_bytes(), ".mh" in path.suffix.lower()
    end = re.search(rb"ElementDataFile\s*=.*\n?" if is_meta else rb"\r?\n\r?\n|\s*\Z", content)
    if end is None:
        raise ValueError("it has no ElementDataFile")
    fields = dict(_FIELD.findall(content[: end.end()].decode("latin-1")))
    names = (fields.get(key) for key in ("ElementDataFile", "data file", "datafile"))
    name = next(filter(None, names), "LOCAL")
    body = content[end.end() :]
    if name.upper() != "LOCAL":
        try:
            body = (path.parent / name).read_bytes()
        except OSError as error:
            raise ValueError(f"its data file {name} cannot be read: {error.strerror}") from error
    if fields.get("encoding", "").lower() in ("gz", "gzip"):
        body, fields["encoding"] = gzip.decompress(body), "raw"
    if is_meta and not {"NDims", "DimSize", "ElementType"} <= fields.keys():
        raise ValueError("its header lacks NDims, DimSize or ElementType; write it again")
    if fields.get("encoding", "raw").lower() != "raw":
        raise ValueError(f"its encoding is {fields['encoding']}; write the values as raw or gzip")
    if fields.get("CompressedData", "").lower() == "true":
        body = zlib.decompressobj(wbits=47).decompress(body)
    return fields, body[max(0, int(fields.get("byte skip", 0))) :]


def _read_nrrd(
    path: Path, fields: dict[str, str], values: bytes, reader: Any, update: Callable[[Any], Any]
) -> Any:
    """Reads a .nrrd: VTK reads only the values; spacing and position are set here."""
    sizes = fields["sizes"].split()
    if len(sizes) not in (3, 4) or not 0 < math.prod(map(int, sizes)) <= len(values):
        raise ValueError(
            "it does not have three axes of at least one point each, or its "
            f"{len(values)} bytes of values are too few for {' x '.join(sizes)} values; write a "
            "complete image of three axes"
        )
    lines = [f"{name}: {fields.get(name, 'little')}" for name in ("type", "endian", "encoding")]
    lines = ["NRRD0004", *lines, "dimension: 4", f"sizes: {' '.join(['1', *sizes][-4:])}", "", ""]
    with tempfile.TemporaryDirectory() as folder:
        plain = Path(folder) / "image.nrrd"
        plain.write_bytes("\n".join(lines).encode("latin-1") + values)
        reader.SetFileName(str(plain))
        _check_size(reader, len(values))
        image = update(reader)
    vectors = re.findall(r"\(([^)]*)\)", fields.get("space directions", ""))
    axes = numpy.array([[float(word) for word in own.split(",")] for own in vectors])
    if axes.shape != (3, 3):
        spacings = [float(word) for word in fields.get("spacings", "1 1 1").split()[-3:]]
        axes = numpy.diag([abs(x) if x and math.isfinite(x) else 1.0 for x in spacings])
    image.SetSpacing(*numpy.linalg.norm(axes, axis=1))
    origin = fields.get("space origin", "(0,0,0)").strip("() ").split(",")
    if len(origin) != 3:
        raise ValueError(f"its space origin has {len(origin)} number(s), not 3; correct it")
    return _place(path, image, list(map(float, origin)), axes)


def _place(path: Path, image: Any, origin: Any, axes: Any) -> Any:
    """Sets the origin of an image, whose axes are rows of `axes`; warns if the image is oblique.

    Values are reordered if axes are mirrored or permuted.
    """
    image.SetOrigin(*origin)
    lengths = numpy.linalg.norm(axes, axis=1, keepdims=True)
    axes = axes / numpy.where(lengths > 0, lengths, 1)
    order = abs(axes).argmax(axis=1)  # axis of space nearest to each axis of the image
    signs = axes[range(3), order]
    if sorted(order) != [0, 1, 2] or not (abs(signs) >= _ALONG).all():
        warn(
            f"{path}: the image is sheared, or rotated by an angle that is no multiple of 90 "
            "degrees. The shear or rotation is ignored; resample the image along x, y and z."
        )
    elif (order != (0, 1, 2)).any() or (signs < 0).any():
        _move_rows(image, order.tolist(), signs)
    return image


def _move_rows(image: Any, order: list[int], signs: Any) -> None:
    size, spacing, origin = image.GetDimensions(), image.GetSpacing(), [*image.GetOrigin()]
    scalars = image.GetPointData().GetScalars()
    values = vtk_to_numpy(scalars).reshape(*size[::-1], -1)
    for i in range(3):
        if signs[i] < 0:
            values = numpy.flip(values, 2 - i)
            origin[order[i]] -= (size[i] - 1) * spacing[i]
    back = [order.index(axis) for axis in range(3)]
    values = values.transpose(2 - back[2], 2 - back[1], 2 - back[0], 3)
    moved = numpy_to_vtk(values.reshape(-1, values.shape[3]), deep=True)
    moved.SetName(scalars.GetName())
    image.SetDimensions(*(size[i] for i in back))
    image.SetSpacing(*(spacing[i] for i in back))
    image.SetOrigin(*origin)
    image.GetPointData().SetScalars(moved)
