"""Writes a film of meshes in one USD file, by the library usd-core."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

import numpy

from .data_objects import points_of
from .file_names import has_number, replacing
from .glb import TO_Y, linear_light, turned_up
from .mesh_writers import (
    arrays_of,
    origin_for_floats,
    polygons_of,
    warn_of_losses,
    warn_of_rounding,
)
from .runner import Sink
from .times import rate_of

USD_SUFFIXES = (".usdc", ".usda")
_MOST_INT = 2**31  # first integer that does not fit into 32 bits
_NEEDED = "usd-core is not installed; pip install usd-core, or write skin_####.glb or skin_####.vtp"


def check_usd(path: Path) -> None:
    """Raises OSError if usd-core is missing, or the name has a frame number."""
    if has_number(path):
        raise OSError(
            f"{path} holds all frames in one file; remove the frame number from the name."
        )
    try:
        import pxr.Usd  # noqa: F401
    except ImportError as error:
        raise OSError(f"{path} cannot be written: {_NEEDED}.") from error


class UsdFilm(Sink):
    """Writes meshes over time as one prim, "/skin", of a USD file.

    Points, polygons, normals, velocities [length per unit of `times`], colours (displayColor, as
    linear light without alpha) and arrays (primvars) have a sample at each time. Time codes are
    times multiplied by fps.

    - path (Path): film.usdc or, as text, film.usda.
    - times (list of float): time of each step [time].
    - fps (float, optional): time codes per unit of time [1/time]. Default: the mean number of
      frames per unit of time if 1 to 240, else 25.
    - up ({"x", "y", "z", "-x", "-y", "-z"}): axis of the data that points up. y and z set the
      stage's up axis; for other axes the prim is rotated to y.
    - time_scale (float): time of the velocities per unit of `times`, the filter's TimeScale.
      Default: 1.
    """

    def __init__(
        self, path: Path, times: list[float], fps: float | None, up: str, time_scale: float = 1.0
    ) -> None:
        self.path, self.fps, self.up = path, fps or rate_of(times), up
        self._time_scale = time_scale
        self._codes = [round(time * self.fps, 6) for time in times]
        self._ending, self._origin, self._wide = ExitStack(), None, dict[str, bool]()

    def __enter__(self) -> UsdFilm:
        from pxr import Gf, Usd, UsdGeom

        temporary = self._ending.enter_context(replacing(self.path))
        self._stage = stage = Usd.Stage.CreateNew(str(temporary))
        UsdGeom.SetStageUpAxis(stage, "Z" if self.up == "z" else "Y")
        UsdGeom.SetStageMetersPerUnit(stage, 1.0)
        stage.SetTimeCodesPerSecond(self.fps)
        stage.SetFramesPerSecond(self.fps)
        stage.SetStartTimeCode(self._codes[0])
        stage.SetEndTimeCode(self._codes[-1])
        self._mesh = UsdGeom.Mesh.Define(stage, "/skin")
        stage.SetDefaultPrim(self._mesh.GetPrim())
        self._mesh.CreateSubdivisionSchemeAttr("none")
        self._ending.push(self._close)
        if self.up in TO_Y and self.up != "z":
            x, y, z, w = TO_Y[self.up]
            self._mesh.AddOrientOp().Set(Gf.Quatf(w, x, y, z))
        return self

    def __exit__(self, *error: Any) -> None:
        self._ending.__exit__(*error)

    def _close(self, kind: Any, *_: Any) -> None:
        stage = self._stage
        del self._mesh, self._stage
        if kind is None:
            with self._converting():
                stage.Save()

    @contextmanager
    def _converting(self) -> Iterator[None]:
        """Converts errors of the library to OSError."""
        from pxr import Tf

        try:
            yield
        except Tf.ErrorException as error:
            raise OSError(
                f"{self.path} cannot be written; check the folder and its free space."
            ) from error

    def add(self, step: int, data: Any) -> None:
        """Writes the mesh of a step."""
        with self._converting():
            self._write(step, data)

    def _write(self, step: int, data: Any) -> None:
        from pxr import UsdGeom, Vt

        warn_of_losses(self.path.suffix, data)
        if self._origin is None and data.GetNumberOfPoints():
            self._origin = self._move(origin_for_floats(data))
        origin = 0.0 if self._origin is None else self._origin
        warn_of_rounding(self.path.suffix, data, origin)
        mesh, time, points = self._mesh, self._codes[step], (points_of(data) - origin).astype("f4")
        normals, colours, others = arrays_of(data)
        polygons = polygons_of(data)
        counts = [numpy.full(len(corners), corners.shape[1]) for corners in polygons]
        corners = [corners.ravel() for corners in polygons]
        low_high = numpy.array([points.min(0), points.max(0)]) if len(points) else points[:0]
        velocity = others.pop("Velocity", None)
        velocity = None if velocity is None else self._time_scale * velocity
        vectors = {"Points": points, "Extent": low_high, "Normals": normals, "Velocities": velocity}
        for name, values in vectors.items():
            if values is not None:
                vector = Vt.Vec3fArray.FromNumpy(numpy.ascontiguousarray(values, dtype="f4"))
                getattr(mesh, f"Create{name}Attr")().Set(vector, time)
        for name, parts in (("Counts", counts), ("Indices", corners)):
            joined = numpy.concatenate([numpy.zeros(0, "i4"), *parts]).astype("i4")
            getattr(mesh, f"CreateFaceVertex{name}Attr")().Set(Vt.IntArray.FromNumpy(joined), time)
        mesh.SetNormalsInterpolation(UsdGeom.Tokens.vertex)
        if colours is not None:
            others["displayColor"] = linear_light(colours)[:, :3]
        for name, values in others.items():
            self._add_primvar(name, values, time)
        if self.path.suffix == ".usdc":
            self._stage.Save()  # frees the memory of the frame

    def _move(self, origin: Any) -> Any:
        """Moves the prim to an origin, in double precision; returns the origin."""
        from pxr import Gf, UsdGeom

        if origin.any():
            others = self._mesh.GetOrderedXformOps()
            own = self._mesh.AddTranslateOp(UsdGeom.XformOp.PrecisionDouble)
            moved = origin if self.up == "z" else turned_up(self.up, origin)
            own.Set(Gf.Vec3d(*moved.tolist()))
            self._mesh.SetXformOpOrder([own, *others])  # the last operation applies first
        return origin

    def _add_primvar(self, name: str, values: Any, time: float) -> None:
        """Sets a vertex array as a primvar: integers, floats, vectors, or rows of another width."""
        from pxr import Sdf, UsdGeom, Vt

        kind, array, wide = Sdf.ValueTypeNames.FloatArray, Vt.FloatArray, values.shape[1]
        if name == "displayColor":
            kind, array = Sdf.ValueTypeNames.Color3fArray, Vt.Vec3fArray
        elif wide == 3:
            kind, array = Sdf.ValueTypeNames.Float3Array, Vt.Vec3fArray
        elif wide == 1 and values.dtype.kind in "iu":
            kind, array = Sdf.ValueTypeNames.Int64Array, Vt.Int64Array
            is_wide = len(values) > 0 and (values.min() < -_MOST_INT or values.max() >= _MOST_INT)
            if not self._wide.setdefault(name, is_wide):
                if is_wide:
                    raise OSError(
                        f"{self.path}: array {name} needs 64-bit integers, but has 32-bit ones in "
                        "earlier frames; write a file for each frame, such as skin_####.vtp."
                    )
                kind, array = Sdf.ValueTypeNames.IntArray, Vt.IntArray  # Blender has int32 only
        plain = re.sub(r"\W|^(?=\d)", "_", name, flags=re.ASCII)
        interface = UsdGeom.PrimvarsAPI(self._mesh)
        own = interface.CreatePrimvar(plain, kind, UsdGeom.Tokens.vertex, wide if wide != 3 else -1)
        whole = {Vt.Int64Array: "i8", Vt.IntArray: "i4"}
        rows = values if wide == 3 else values.ravel()
        own.Set(array.FromNumpy(numpy.ascontiguousarray(rows, dtype=whole.get(array, "f4"))), time)
