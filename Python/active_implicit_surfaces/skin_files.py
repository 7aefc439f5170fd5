"""Reads and writes skins and other meshes; writes particles."""

from __future__ import annotations

import importlib
import io
import json
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkReverseSense
from vtkmodules.vtkFiltersGeometry import vtkCompositeDataGeometryFilter

from .contours import contour, usual_level
from .data_objects import (
    add_array,
    array_names,
    as_shape,
    blocks_of,
    has_polygons,
    output_of,
    points_of,
    texts_of,
    vtk_points,
)
from .file_names import replacing, suffix_of
from .glb import check_glb, display_colours, write_glb
from .images import IMAGE_SUFFIXES
from .mesh_writers import (
    triangles_of,
    warn_of_coarse,
    warn_of_losses,
    write_obj,
    write_ply,
    write_stl,
)
from .messages import listening, quiet
from .particle_files import PARTICLE_SUFFIXES
from .vtk_files import check_readable, read_vtk

# Writers: a function, or module and class.
MESH_WRITERS: dict[str, Any] = {
    ".vtp": ("vtkmodules.vtkIOXML", "vtkXMLPolyDataWriter"),
    ".ply": write_ply,
    ".obj": write_obj,
    ".stl": write_stl,
    ".vtk": ("vtkmodules.vtkIOLegacy", "vtkPolyDataWriter"),
    ".glb": write_glb,
    ".vdb": ("active_implicit_surfaces.vtkActiveIO", "vtkActiveVDBWriter"),
}
SKIN_SUFFIXES = (".vtp", ".ply", ".obj", ".stl", ".glb", ".vdb")
MESH_SUFFIXES = (
    *(".vtp", ".stl", ".obj", ".ply", ".vtk", ".vtu", ".vtm", ".vdb", ".glb"),
    *IMAGE_SUFFIXES,
)
INPUT_SUFFIXES = tuple(sorted({*PARTICLE_SUFFIXES, *MESH_SUFFIXES}))
PARTICLE_OUT_SUFFIXES = (".vtp", ".ply", ".vtk", ".csv", ".xyz", ".json", ".npz")


def check_suffix(path: Path, known: tuple[str, ...], what: str) -> None:
    """Raises ValueError if the extension of `path` is not in `known`."""
    if suffix_of(path) not in known:
        raise ValueError(f"{path}: {what} are written as {', '.join(known)}.")


def write_mesh(path: Path, mesh: Any, port: Any = None, up: str = "y", **settings: Any) -> None:
    """Writes a mesh in the format of the extension, atomically: completely or not at all.

    Warns of losses as `warn_of_losses` does.

    - mesh (vtkPolyData; for a .vdb also vtkImageData): for a .vdb of a skin, pass the filter's own
      output, whose grid is then written.
    - port (vtkAlgorithmOutput, optional): output port of the mesh's source, from which a .vdb gets
      its frame number.
    - up ({"x", "y", "z", "-x", "-y", "-z"}): axis of the data that points up, for a .glb, in which
      y is up. Default: "y".
    - **settings: methods to call on the writer, and their arguments, such as
      ``SetVoxelSize=0.1``; only for a .vdb, .vtp or .vtk.

    Raises OSError if the file cannot be written.
    """
    suffix = suffix_of(path)
    warn_of_losses(suffix, mesh)
    if suffix in (".stl", ".glb") or suffix in (".ply", ".obj") and mesh.GetNumberOfStrips():
        mesh = triangles_of(mesh)
    with replacing(path) as temporary:
        if callable(MESH_WRITERS[suffix]):
            MESH_WRITERS[suffix](temporary, mesh, **({"up": up} if suffix == ".glb" else {}))
            return
        module, name = MESH_WRITERS[suffix]
        writer = getattr(importlib.import_module(module), name)()
        _prepare_writer(writer, suffix, mesh)
        for setting, value in settings.items():
            getattr(writer, setting)(value)
        if suffix == ".vtp":
            writer.WriteToOutputStringOn()  # VTK 9.1 crashes when the disk is full
        else:
            writer.SetFileName(str(temporary))
        if suffix == ".vdb" and port is None and mesh.GetNumberOfPoints() == 0:
            surface = _skin_of_nothing()
            port = surface.GetOutputPort()
        if suffix == ".vdb" and port is not None:
            writer.SetInputConnection(port)
        else:
            writer.SetInputData(mesh)
        with quiet(), listening(writer) as heard:
            writer.Write()
        if suffix == ".vtp" and not heard.errors and not writer.GetErrorCode():
            temporary.write_text(writer.GetOutputString(), encoding="utf-8")
        if heard.errors or writer.GetErrorCode() or not temporary.exists():
            said = heard.errors[0] if heard.errors else "check the folder and its free space."
            raise OSError(f"{path} cannot be written: {said}")


def read_shape(path: Path, parts: Sequence[Path] = ()) -> Any:
    """Reads a mesh or an image; joins the file and `parts`, if any, into one mesh.

    With `parts`, images are contoured. A mesh without points becomes an empty vtkPolyData.
    Raises OSError if a file cannot be read, or holds data other than a mesh or an image.
    """
    if parts:
        return output_of(vtkAppendPolyData(), *map(_surface_in, (path, *parts)))
    suffix = suffix_of(path)
    if suffix not in MESH_SUFFIXES:
        raise OSError(f"{path}: meshes and images are read from {', '.join(MESH_SUFFIXES)}.")
    data = _read_glb(path) if suffix == ".glb" else read_vtk(path)
    count = data.GetNumberOfElements(vtkDataObject.POINT)  # surface_of drops loose points
    if data.IsA("vtkCompositeDataSet"):
        data = surface_of(data)
    _check_corners(path, data)
    if data.IsA("vtkImageData"):
        return data
    if not data.IsA("vtkPointSet"):
        raise OSError(f"{path} has no mesh: it holds a {data.GetClassName()}.")
    if count == 0:
        return data if data.IsA("vtkPolyData") else vtkPolyData()  # an empty skin
    try:
        shape = as_shape(data)
        warn_of_coarse(path, shape)
        return shape
    except ValueError as error:
        raise OSError(f"{path} is no mesh: {error}") from error


def _surface_in(path: Path) -> Any:
    shape = read_shape(path)
    if not shape.IsA("vtkImageData"):
        return shape
    level, above = usual_level(shape)
    return contour(shape, level, above=above)


def holds_particles(path: Path) -> bool | None:
    """Returns True if a file has particles, False if a mesh or an image, None if no points.

    Particles are a vtkPolyData without polygons, or another point set with no cells but vertices. A
    vtkPolyData without points counts as particles if it is from a .vdb. If the extension allows
    only particles, or only meshes and images, the file is not read. Raises OSError for an unknown
    extension, or if the file cannot be read.
    """
    suffix = suffix_of(path)
    if suffix not in INPUT_SUFFIXES:
        raise OSError(f"{path}: input files are read from {', '.join(INPUT_SUFFIXES)}.")
    if suffix not in PARTICLE_SUFFIXES or suffix not in MESH_SUFFIXES:
        return suffix in PARTICLE_SUFFIXES
    data = read_vtk(path)
    count = data.GetNumberOfElements(vtkDataObject.POINT)
    if data.IsA("vtkCompositeDataSet"):
        data = surface_of(data)
    if not data.IsA("vtkPointSet") or (count == 0 and suffix != ".vdb"):
        return None if data.IsA("vtkPointSet") else False
    if data.IsA("vtkPolyData"):
        return not has_polygons(data)
    return all(data.GetCellType(i) in (1, 2) for i in range(data.GetNumberOfCells()))


def surface_of(blocks: Any) -> Any:
    """Returns the surfaces of all blocks as one mesh."""
    return output_of(vtkCompositeDataGeometryFilter(), blocks)


def write_particles(path: Path, cloud: Any) -> None:
    """Writes points and the arrays that the format can hold, atomically."""
    suffix = suffix_of(path)
    if suffix in (".vtp", ".ply", ".vtk"):
        write_mesh(path, _with_vertices(cloud) if cloud.GetNumberOfPoints() else cloud)
        return
    warn_of_losses(suffix, cloud)
    positions, arrays = points_of(cloud), _arrays_of(cloud)
    with replacing(path) as temporary:
        if suffix == ".npz":
            held = io.BytesIO()  # savez would also report errors when its file is deleted
            numpy.savez(held, positions=positions, **arrays)
            temporary.write_bytes(held.getbuffer())
        elif suffix == ".xyz":
            head = "" if len(positions) else "x y z"  # an empty file cannot be read
            numpy.savetxt(temporary, positions, fmt=_format_of(positions), header=head)
        elif suffix == ".csv":
            _write_csv(temporary, positions, arrays)
        else:
            listed = {name: values.tolist() for name, values in arrays.items()}
            text = json.dumps({"positions": positions.tolist(), **listed})
            temporary.write_text(text, encoding="utf-8")


def _prepare_writer(writer: Any, suffix: str, mesh: Any) -> None:
    if suffix == ".vtp":
        writer.SetDataModeToBinary()  # VTK 9.1 reads this mode with any libexpat
        writer.SetCompressionLevel(1)  # half of the time of VTK's level 5, and files of that size
    if suffix == ".vtk":
        writer.SetFileTypeToBinary()
    if suffix == ".vdb" and mesh.IsA("vtkPolyData"):
        names = array_names(mesh.GetPointData())
        writer.SetWriteVelocity("Velocity" in names)
        writer.SetWritePointArrays(bool(set(names) - {"Normals", "Velocity"}))


def _skin_of_nothing() -> Any:
    """Returns a filter whose skin and grid are empty."""
    from . import vtkActiveImplicitSurface

    surface = vtkActiveImplicitSurface()
    surface.SetInputData(vtkPolyData())
    surface.SetParticleSpacing(1.0)
    surface.Update()
    return surface


def _check_corners(path: Path, data: Any) -> None:
    """Raises OSError if a vtkPolyData's cell refers to a missing point; VTK does not check."""
    if not data.IsA("vtkPolyData"):
        return
    for cells in (data.GetVerts(), data.GetLines(), data.GetPolys(), data.GetStrips()):
        corners = vtk_to_numpy(cells.GetConnectivityArray())
        if corners.size and (corners.min() < 0 or corners.max() >= data.GetNumberOfPoints()):
            raise OSError(
                f"{path} cannot be read: a cell refers to a missing point; write the file again."
            )


def _read_glb(path: Path) -> Any:
    from vtkmodules.vtkIOGeometry import vtkGLTFReader

    check_readable(path)
    is_own, has_meshes, origin = check_glb(path)
    if is_own and not has_meshes:
        return vtkPolyData()  # an empty skin
    reader = vtkGLTFReader()
    reader.SetApplyDeformationsToGeometry(not is_own)  # own: not rotated by its node
    reader.SetFileName(str(path))
    with quiet(), listening(reader) as heard:
        reader.Update()
        mesh = surface_of(_turned_outward(reader.GetOutputDataObject(0)))
    if heard.errors or mesh.GetNumberOfPoints() == 0:
        said = (
            heard.errors[0] if heard.errors else "it holds no mesh, or is damaged; write it again."
        )
        raise OSError(f"{path} cannot be read: {said.rstrip('.')}.")
    if origin is not None:
        mesh.SetPoints(vtk_points(points_of(mesh) + origin))
    light = mesh.GetPointData().GetArray("COLOR_0")
    if light is not None and light.GetDataTypeAsString() == "float":
        colours = display_colours(vtk_to_numpy(light))
        mesh.GetPointData().RemoveArray("COLOR_0")
        add_array(mesh, "RGBA"[: colours.shape[1]], colours)
    return mesh


def _turned_outward(nodes: Any) -> Any:
    """Reverses the polygons of meshes that a node of the .glb mirrors, as glTF demands."""
    for mesh in blocks_of(nodes):
        matrix = mesh.GetFieldData().GetArray("globalTransform")
        if matrix is not None and numpy.linalg.det(vtk_to_numpy(matrix).reshape(4, 4)) < 0:
            mesh.ShallowCopy(output_of(vtkReverseSense(), mesh))
    return nodes


def _with_vertices(cloud: Any) -> Any:
    """Adds a vertex cell for each point; some programs show only cells."""
    from vtkmodules.vtkFiltersCore import vtkMaskPoints  # missing in some installations

    vertices = vtkMaskPoints()
    vertices.SetOnRatio(1)
    vertices.SetMaximumNumberOfPoints(max(1, cloud.GetNumberOfPoints()))
    vertices.GenerateVerticesOn()
    vertices.SingleVertexPerCellOn()
    return output_of(vertices, cloud)


def _arrays_of(cloud: Any) -> dict[str, Any]:
    own, found = cloud.GetPointData(), dict[str, Any]()
    for name in array_names(own):
        array, texts = own.GetArray(name), texts_of(own, name)
        if array is not None or texts is not None:
            found[name] = texts if array is None else vtk_to_numpy(array)
    return found


def _write_csv(path: Path, positions: Any, arrays: dict[str, Any]) -> None:
    names, columns, formats = list[str](), list[Any](), list[str]()
    for name, values in [("", positions), *arrays.items()]:
        wide = 1 if values.ndim == 1 else values.shape[1]
        names += [_quoted(name)] if wide == 1 else [_quoted(f"{name}:{i}") for i in range(wide)]
        formats += [_format_of(values)] * wide
        own = [[_quoted(text) for text in values]] if values.dtype.kind == "U" else None
        columns += own or values.reshape(len(positions), wide).T.tolist()
    form = ",".join(formats) + "\n"
    with path.open("w", encoding="utf-8") as file:
        file.write(",".join(["x", "y", "z", *names[3:]]) + "\n")
        file.writelines(form % row for row in zip(*columns))


def _quoted(text: str) -> str:
    """Quotes a cell of a .csv if it contains a quote, a comma or a line break."""
    return '"' + text.replace('"', '""') + '"' if re.search('[",\n]', text) else text


def _format_of(values: Any) -> str:
    """Returns the % format that keeps all digits of the values."""
    if values.dtype.kind != "f":
        return "%s" if values.dtype.kind == "U" else "%d"
    return "%.9g" if values.dtype.itemsize <= 4 else "%.17g"
