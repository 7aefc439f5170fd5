"""Images of medicine by VTK's readers, which do not see that the end of a .mha or .nrrd is missing,
take the first of three axes of a .nrrd as one of components, and leave out the origin of a .nii.
"""

from __future__ import annotations

import gzip
import math
import re
import struct
import tempfile
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

from .messages import warn_all

IMAGE_SUFFIXES = (".vti", ".nii", ".nii.gz", ".nrrd", ".nhdr", ".mha", ".mhd")
_FIELD = re.compile(r"(?m)^[ \t]*([^#:=\n]+?)[ \t]*[:=]+[ \t]*(.*?)[ \t\r]*$")
# Of MetaIO's types, whose reader prints where values are missing.
_BYTES = {"SHORT": 2, "INT": 4, "LONG": 4, "FLOAT": 4, "LONG_LONG": 8, "DOUBLE": 8}
# Of the numbers that a .nii has for its types.
_BITS = {2: 8, 4: 16, 8: 32, 16: 32, 64: 64, 128: 24, 256: 8, 512: 16, 768: 32, 1024: 64, 1280: 64}
_DAMAGE = (ValueError, KeyError, OverflowError, EOFError, zlib.error, gzip.BadGzipFile)


def read_nifti(path: Path, reader: Any, update: Callable[[Any], Any]) -> Any:
    """The image of a .nii or .nii.gz with its origin and scale of values."""
    _check_nifti(path)
    image = update(reader)
    matrix = reader.GetSFormMatrix() or reader.GetQFormMatrix()
    if matrix is not None:
        rows = numpy.array([[matrix.GetElement(i, j) for j in range(4)] for i in range(3)])
        image.SetOrigin(*rows[:, 3])
        _tell_turned(path, rows[:, :3].T)
    slope, start = reader.GetRescaleSlope(), reader.GetRescaleIntercept()
    scalars = image.GetPointData().GetScalars()
    if scalars is not None and (slope, start) not in ((1.0, 0.0), (0.0, 0.0)):
        scaled = numpy_to_vtk(vtk_to_numpy(scalars) * slope + start, deep=True)
        scaled.SetName(scalars.GetName())
        image.GetPointData().SetScalars(scaled)
    return image


def _check_nifti(path: Path) -> None:
    """Raises OSError unless there are as many values as the header says."""
    try:
        with (gzip.open if path.suffix.lower() == ".gz" else open)(path, "rb") as file:
            content = file.read()
        order = "<" if content[:4] in (b"\x5c\1\0\0", b"\x1c\2\0\0") else ">"
        is_first = struct.unpack_from(order + "i", content)[0] == 348
        dims = struct.unpack_from(
            order + ("8h" if is_first else "8q"), content, 40 if is_first else 16
        )
        kind, bits = struct.unpack_from(order + "hh", content, 70 if is_first else 12)
    except (*_DAMAGE, struct.error) as error:
        raise OSError(f"{path} cannot be read: it is damaged; {error}.") from error
    count = math.prod(dims[1 : 1 + max(0, min(dims[0], 7))])
    is_known = _BITS.get(kind) == bits and 1 <= dims[0] <= 7
    if not is_known or not 0 < count * bits // 8 < len(content) or min(dims[1 : dims[0] + 1]) < 1:
        raise OSError(
            f"{path} cannot be read: it is damaged; it has {len(content)} bytes for "
            f"{' x '.join(map(str, dims[1:4]))} values of {bits} bits."
        )


def read_meta_or_nrrd(path: Path, reader: Any, update: Callable[[Any], Any]) -> Any:
    """The image of a .mha, .mhd, .nrrd or .nhdr.

    Raises
    ------
    OSError
        It is damaged, or `update`, which gives what a reader makes, says so.
    """
    try:
        fields, values = _parts_of(path)
        image = (
            update(reader) if "DimSize" in fields else _nrrd(path, fields, values, reader, update)
        )
    except _DAMAGE as error:
        said = f"it has no {error}" if isinstance(error, KeyError) else str(error)
        raise OSError(f"{path} cannot be read: {said}.") from error
    scalars = image.GetPointData().GetScalars()
    needed = scalars.GetDataSize() * scalars.GetDataTypeSize() if scalars else 1
    if needed > len(values):
        raise OSError(
            f"{path} cannot be read: it is damaged; it has {len(values)} of {needed} bytes."
        )
    return image


def _parts_of(path: Path) -> tuple[dict[str, str], bytes]:
    """The header, and the values without compression."""
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
            raise ValueError(f"its data are in {name}: {error.strerror}") from error
    if fields.get("encoding", "").lower() in ("gz", "gzip"):
        body, fields["encoding"] = gzip.decompress(body), "raw"
    if is_meta and not {"NDims", "DimSize", "ElementType"} <= fields.keys():
        raise ValueError("it has no NDims, DimSize or ElementType")
    if fields.get("encoding", "raw").lower() != "raw":
        raise ValueError(
            f"its encoding is {fields['encoding']}, which is not read; write raw or gzip"
        )
    if fields.get("CompressedData", "").lower() == "true":
        body = zlib.decompressobj(wbits=47).decompress(body)
    body = body[max(0, int(fields.get("byte skip", 0))) :]
    count = math.prod(int(word) for word in fields["DimSize" if is_meta else "sizes"].split())
    count *= int(fields.get("ElementNumberOfChannels", 1)) * _BYTES.get(
        fields.get("ElementType", "").upper().removeprefix("MET_").removeprefix("U"), 1
    )
    if not 0 < count <= len(body):
        raise ValueError(f"it has {len(body)} of at least {count} bytes")
    return fields, body


def _nrrd(
    path: Path, fields: dict[str, str], values: bytes, reader: Any, update: Callable[[Any], Any]
) -> Any:
    """What VTK makes of the values alone, placed in space."""
    sizes = fields["sizes"].split()
    if len(sizes) not in (3, 4):
        raise ValueError(f"it has {len(sizes)} axes, not 3")
    lines = [f"{name}: {fields.get(name, 'little')}" for name in ("type", "endian", "encoding")]
    lines = ["NRRD0004", *lines, "dimension: 4", f"sizes: {' '.join(['1', *sizes][-4:])}", "", ""]
    with tempfile.TemporaryDirectory() as folder:
        plain = Path(folder) / "image.nrrd"
        plain.write_bytes("\n".join(lines).encode("latin-1") + values)
        reader.SetFileName(str(plain))
        image = update(reader)
    vectors = re.findall(r"\(([^)]*)\)", fields.get("space directions", ""))
    axes = numpy.array([[float(word) for word in own.split(",")] for own in vectors])
    if axes.shape != (3, 3):
        spacings = [float(word) for word in fields.get("spacings", "1 1 1").split()[-3:]]
        axes = numpy.diag([abs(x) if x and math.isfinite(x) else 1.0 for x in spacings])
    image.SetSpacing(*numpy.linalg.norm(axes, axis=1))
    image.SetOrigin(*map(float, fields.get("space origin", "(0,0,0)").strip("() ").split(",")))
    _tell_turned(path, axes)
    return image


def _tell_turned(path: Path, axes: Any) -> None:
    """Warns if the axes of an image, which are rows, are not x, y and z."""
    if (numpy.diag(axes) < 0.999 * numpy.linalg.norm(axes, axis=1)).any():
        warn_all([f"{path}: the image is turned or mirrored in space, which is left out."])
