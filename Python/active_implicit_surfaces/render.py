"""Converts the content of a vtkRenderWindow to layers for compositing programs.

>>> from active_implicit_surfaces import render
>>> render.write_exr(window, "picture.exr", frame_duration=1 / 24)

Layers, as point arrays of the image that capture() returns, and their channels in the file::

    RGBA     R G B A, HALF      the picture, in the file as linear light; see `encoding`
    Z        Z, FLOAT           distance from the camera along its axis [world units], with
                                perspective and without; `far` where nothing is
    P        P.X P.Y P.Z, FLOAT position in the world minus `origin`; 0 where nothing is
    N        N.X N.Y N.Z, HALF  unit normal in world coordinates, as the data has it (outward on a
                                closed skin), not turned to the camera; 0 where nothing is
    forward  forward.u .v, HALF motion until the next frame [pixels], u to the right, v up; 0 where
                                nothing is, or nothing moves
    id       id, UINT           1 for the renderer's first actor, 2 for its second and so on; 0
                                where nothing is

Z and P are read from the depth buffer, so both contain every opaque object of the renderer. N, id
and velocities are known only for actors whose mapper has a data set (vtkPolyDataMapper,
vtkDataSetMapper) or blocks of data sets, as in ParaView; for other actors, N, id and velocities are
0. The known surfaces are rendered again, without lights, with values in place of colors.
Translucent objects, and objects of other renderers on top, are only in the picture. Layers are
sampled at the pixels' centers; only the picture is antialiased. The picture has the window's 8 bits
and alpha. Alpha is 0 on a background whose BackgroundAlpha is 0. If this background is black, as
with `apart`, colors are premultiplied by alpha, as OpenEXR requires.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkImageData
from vtkmodules.vtkCommonMath import vtkMatrix4x4

from .data_objects import add_array, copy_of
from .glb import linear_light
from .messages import listening, warn
from .surface_values import distances_along_axis, surface_values

try:
    from .vtkActiveIO import vtkActiveEXRWriter
except ImportError as error:
    raise ImportError(
        "active_implicit_surfaces.render writes .exr files, which this build leaves out "
        "(ACTIVE_BUILD_IO is off); build the package with ACTIVE_BUILD_IO on."
    ) from error

FAR = 1e10  # value of the background in Blender; finite, so that image filters produce no NaN
# Relative tolerance of the distances of one surface. The depth buffer has 24 bits, of which
# perspective leaves about 14 far away.
_SAME_DEPTH = 1e-4
_COARSE = 3e-5  # largest step of single precision, over the camera's distance: 0.1 pixel


def write_exr(
    window: Any,
    file_name: str | os.PathLike[str],
    *,
    frame_duration: float = 1.0,
    writer: Any = None,
    **options: Any,
) -> Any:
    """Writes the content of the window as an .exr file with layers.

    Parameters
    ----------
    window : vtkRenderWindow
    file_name : str or path
    frame_duration : float
        Time until the next frame [time of the velocities]. Default: 1.
    writer : vtkActiveEXRWriter, optional
        Writer with other settings (compression, attributes). write_exr sets the writer's input,
        file name, pixel types, matrices and color encoding.
    **options
        Options of capture(). Default of `origin`: 0, or the camera's focal point if single
        precision is too coarse there, as for map coordinates; a warning and the attribute
        worldOrigin then name this point.

    Returns
    -------
    vtkImageData
        Result of capture().

    Raises
    ------
    OSError
        The file cannot be written.
    ValueError
        See capture().
    """
    if "origin" not in options:
        options["origin"] = _origin_of(options.get("renderer") or _renderer_of(window))
    image = capture(window, frame_duration=frame_duration, **options)
    writer = writer or vtkActiveEXRWriter()
    pictures = "RGBA", *(options.get("apart") or ())
    for name in (*pictures, "N", "forward"):
        writer.AssignPixelType(name, vtkActiveEXRWriter.HALF)
    renderer = options.get("renderer") or _renderer_of(window)
    origin = options["origin"]
    to_camera, to_picture = camera_matrices(renderer, origin)
    if origin is not None or hasattr(writer, "world_origin"):  # or the writer has an earlier one
        writer.world_origin = (0.0, 0.0, 0.0) if origin is None else tuple(origin)
        writer.AddAttribute("worldOrigin", " ".join(f"{x:.17g}" for x in writer.world_origin))
    writer.SetWorldToCamera(to_camera)
    writer.SetWorldToNDC(to_picture)
    written, apart = image, options.get("apart")
    is_linear = options.get("encoding", "srgb") == "linear"
    writer.SetColorEncodingToSRGB()
    if is_linear or apart is not None:
        writer.SetColorEncodingToLinear()
    if apart is not None and not is_linear:
        written = copy_of(image)
        for name in pictures:
            add_array(written, name, _light(vtk_to_numpy(image.GetPointData().GetArray(name))))
    with listening(writer) as heard:
        writer.SetFileName(str(file_name))
        writer.SetInputData(written)
        writer.Write()
    if writer.GetErrorCode():
        raise OSError(heard.errors[0] if heard.errors else f"{file_name} cannot be written.")
    return image


def capture(
    window: Any,
    *,
    renderer: Any = None,
    velocity: str = "Velocity",
    frame_duration: float = 1.0,
    camera_after: Any = None,
    encoding: str = "srgb",
    far: float = FAR,
    apart: Mapping[str, Any] | None = None,
    origin: Sequence[float] | None = None,
) -> Any:
    """Renders the window and returns its layers as point arrays of an image.

    Parameters
    ----------
    window : vtkRenderWindow
    renderer : vtkRenderer, optional
        Renderer to capture; it has to fill the window. Default: the first of the window.
    velocity : str
        Name of a point array of 3 components [length/time] along the data's axes; surfaces without
        this array stand still. Default: "Velocity".
    frame_duration : float
        Time until the next frame [time of the velocities]. Default: 1.
    camera_after : vtkCamera, optional
        The camera of the next frame. Default: the camera does not move.
    encoding : {"srgb", "linear"}
        Meaning of the window's colors: "srgb" for display colors (usual in VTK), "linear" for
        linear light. RGBA holds the window's 8 bits; write_exr converts sRGB to linear light.
        Default: "srgb".
    far : float
        Z of the background [length]. Default: 1e10.
    apart : dict of vtkActor, optional
        Actors that have separate layers and are in no other layer: ``{"ground": actor}`` gives the
        arrays "ground" (in the file ground.R, .G, .B, .A) and "ground.Z". With a dict, even an
        empty one, the background is left out, so alpha is the coverage by the layer's actors.
        Default: None, no separate layers; the background is in the picture.
    origin : (float, float, float), optional
        Point of the world [length] that is subtracted from P, which has single precision.
        Default: 0.

    Returns
    -------
    vtkImageData

    Raises
    ------
    ValueError
        The encoding is unknown, the window cannot draw or has no renderer, or the renderer does not
        fill the window.
    """
    if encoding not in ("srgb", "linear"):
        raise ValueError(f'encoding has to be "srgb" or "linear", not {encoding!r}.')
    if window.GetClassName() == "vtkRenderWindow":
        raise ValueError(
            "The window cannot draw: it was made before VTK's OpenGL was loaded; import "
            "vtkmodules.vtkRenderingOpenGL2, or active_implicit_surfaces.render, before the "
            "window is made."
        )
    renderer = renderer or _renderer_of(window)
    if tuple(renderer.GetViewport()) != (0.0, 0.0, 1.0, 1.0):
        raise ValueError("The renderer does not fill the window; call SetViewport(0, 0, 1, 1).")
    place = (0.0, 0.0, 0.0) if origin is None else origin
    settings = velocity, frame_duration, camera_after, far, place
    if apart is None:
        return _image(window, _layers(window, renderer, *settings))
    with _only(renderer, lambda actor: actor not in apart.values()):
        layers = _layers(window, renderer, *settings)
    for name, actor in apart.items():
        with _only(renderer, lambda other, actor=actor: other is actor):
            own = _layers(window, renderer, *settings)
        layers |= {name: own["RGBA"], f"{name}.Z": own["Z"]}
    return _image(window, layers)


def _layers(
    window: Any,
    renderer: Any,
    velocity: str,
    frame_duration: float,
    camera_after: Any,
    far: float,
    origin: Sequence[float],
) -> dict[str, Any]:
    window.Render()
    size = window.GetSize()
    picture = _picture(window, size)
    depth, values = surface_values(window, renderer, velocity)
    camera = renderer.GetActiveCamera()
    projection = _projection(renderer, camera)
    places, distances = _places(depth, size, projection, camera)
    hit = depth < 1.0
    seen = hit & (values["distance"] <= distances * (1.0 + _SAME_DEPTH))
    after = _projection(renderer, camera_after or camera)
    moved = places + frame_duration * numpy.where(seen[:, None], values["velocity"], 0.0)
    steps = _pixels(moved, after, size) - _pixels(places, projection, size)
    return {
        "RGBA": picture,
        "Z": numpy.where(hit, distances, far),
        "P": numpy.where(hit[:, None], places - origin, 0.0),
        "N": numpy.where(seen[:, None], _unit(values["normal"]), 0.0),
        "forward": numpy.where(hit[:, None], steps, 0.0),
        "id": numpy.where(seen, numpy.rint(values["id"]), 0).astype(numpy.uint32),
    }


@contextmanager
def _only(renderer: Any, is_shown: Any) -> Iterator[None]:
    """Hides the background, and the actors that `is_shown` rejects, while the context lasts."""
    hidden = [one for one in renderer.GetActors() if one.GetVisibility() and not is_shown(one)]
    color, alpha = renderer.GetBackground(), renderer.GetBackgroundAlpha()
    renderer.SetBackground(0.0, 0.0, 0.0)
    renderer.SetBackgroundAlpha(0.0)
    for actor in hidden:
        actor.VisibilityOff()
    try:
        yield
    finally:
        for actor in hidden:
            actor.VisibilityOn()
        renderer.SetBackground(color)
        renderer.SetBackgroundAlpha(alpha)


def _light(picture: Any) -> Any:
    """Converts display colors to linear light; both are premultiplied by alpha."""
    alpha = picture[:, 3:] / 255.0
    plain = picture[:, :3] / numpy.where(alpha > 0.0, alpha, 1.0)
    light = linear_light(numpy.minimum(plain, 255.0)) * alpha
    return numpy.hstack([light, alpha]).astype(numpy.float32)


def camera_matrices(renderer: Any, origin: Sequence[float] | None = None) -> Any:
    """Returns the camera as the matrices worldToCamera and worldToNDC of OpenEXR.

    Parameters
    ----------
    renderer : vtkRenderer
    origin : (float, float, float), optional
        Point [length] to which coordinates of the world are relative. Default: 0.

    Returns
    -------
    (vtkMatrix4x4, vtkMatrix4x4)
        The first matrix maps the world to the camera (x right, y up, z ahead). The second maps the
        world to the picture ((0, 0) upper left, (1, 1) lower right).
    """
    camera = renderer.GetActiveCamera()
    to_camera = numpy.diag([1.0, 1.0, -1.0, 1.0]) @ _numbers(camera.GetViewTransformMatrix())
    to_unit = numpy.array([[0.5, 0, 0, 0.5], [0, -0.5, 0, 0.5], [0, 0, 1, 0], [0, 0, 0, 1]])
    moved = numpy.eye(4)
    moved[:3, 3] = 0.0 if origin is None else origin
    to_picture = to_unit @ _projection(renderer, camera)
    return _matrix(to_camera @ moved), _matrix(to_picture @ moved)


def _origin_of(renderer: Any) -> tuple[float, ...] | None:
    """Returns the camera's focal point, and warns, if float32 is too coarse there; else None."""
    camera = renderer.GetActiveCamera()
    focus = numpy.array(camera.GetFocalPoint(), "f4")
    if numpy.spacing(numpy.abs(focus).max()) <= _COARSE * camera.GetDistance():
        return None
    origin = tuple(focus.astype(float).tolist())
    listed = " ".join(f"{value:.17g}" for value in origin)
    warn(
        f"P, worldToCamera and worldToNDC of the .exr are relative to worldOrigin, {listed}: "
        "single precision is too coarse here. Add worldOrigin to P for positions in the world."
    )
    return origin


def _renderer_of(window: Any) -> Any:
    renderer = window.GetRenderers().GetFirstRenderer()
    if renderer is None:
        raise ValueError("The window has no renderer; add one (AddRenderer).")
    return renderer


def _numbers(matrix: Any) -> Any:
    return numpy.array([[matrix.GetElement(i, j) for j in range(4)] for i in range(4)])


def _matrix(numbers: Any) -> Any:
    matrix = vtkMatrix4x4()
    matrix.DeepCopy(numbers.ravel())
    return matrix


def _projection(renderer: Any, camera: Any) -> Any:
    """Returns the projection matrix from world coordinates to the cube [-1, 1]^3."""
    aspect = renderer.GetTiledAspectRatio()
    return _numbers(camera.GetCompositeProjectionTransformMatrix(aspect, -1, 1))


def _picture(window: Any, size: tuple[int, int]) -> Any:
    colors = vtkUnsignedCharArray()
    window.GetRGBACharPixelData(0, 0, size[0] - 1, size[1] - 1, 0, colors)
    return vtk_to_numpy(colors).reshape(-1, 4).copy()


def _places(depth: Any, size: tuple[int, int], projection: Any, camera: Any) -> Any:
    """Returns each pixel's world position at its depth, and the distance along the camera axis."""
    x = (numpy.arange(size[0]) + 0.5) / size[0] * 2.0 - 1.0
    y = (numpy.arange(size[1]) + 0.5) / size[1] * 2.0 - 1.0
    cube = numpy.empty((len(depth), 4))
    cube[:, 0] = numpy.tile(x, size[1])
    cube[:, 1] = numpy.repeat(y, size[0])
    cube[:, 2] = 2.0 * depth - 1.0
    cube[:, 3] = 1.0
    world = cube @ numpy.linalg.inv(projection).T
    places = world[:, :3] / world[:, 3:]
    return places, distances_along_axis(places, camera)


def _pixels(places: Any, projection: Any, size: tuple[int, int]) -> Any:
    """Projects points into the picture [pixels from the lower left]."""
    clip = places @ projection[:, :3].T + projection[:, 3]
    return (clip[:, :2] / clip[:, 3:] + 1.0) * 0.5 * numpy.array(size)


def _unit(vectors: Any) -> Any:
    finite = numpy.where(numpy.isfinite(vectors), vectors, 0.0)
    lengths = numpy.linalg.norm(finite, axis=1, keepdims=True)
    return finite / numpy.where(lengths > 0.0, lengths, 1.0)


def _image(window: Any, layers: dict[str, Any]) -> Any:
    image = vtkImageData()
    image.SetDimensions(*window.GetSize(), 1)
    for name, numbers in layers.items():
        add_array(image, name, numbers.astype("f4") if numbers.dtype == float else numbers)
    image.GetPointData().SetActiveScalars("RGBA")
    image.GetInformation().Remove(vtkDataObject.DATA_TIME_STEP())
    return image
