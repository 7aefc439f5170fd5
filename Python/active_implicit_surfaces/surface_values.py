"""Renders the nearest surface in each pixel of a window: depth, normal, velocity and actor."""

from __future__ import annotations

from typing import Any

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkFloatArray
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkPolyDataNormals
from vtkmodules.vtkFiltersGeneral import vtkTransformFilter
from vtkmodules.vtkFiltersGeometry import vtkCompositeDataGeometryFilter, vtkGeometryFilter
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer
from vtkmodules.vtkRenderingOpenGL2 import (
    vtkCameraPass,
    vtkRenderPassCollection,
    vtkSequencePass,
)

from .data_objects import add_array, output_of

try:
    from vtkmodules.vtkRenderingOpenGL2 import vtkValuePass
except ImportError as error:
    raise ImportError(
        "active_implicit_surfaces.render needs vtkValuePass, which the VTK of vtkmodules "
        "does not have; write pictures as .png, or build the package with VTK of Debian or PyPI."
    ) from error

_POINT_FIELD = 3  # VTK_SCALAR_MODE_USE_POINT_FIELD_DATA for vtkValuePass


def distances_along_axis(points: Any, camera: Any) -> Any:
    """Returns the distances of points from the camera, along the axis of the camera."""
    return (points - camera.GetPosition()) @ numpy.array(camera.GetDirectionOfProjection())


def surface_values(window: Any, renderer: Any, velocity: Any) -> Any:
    """Returns the depth buffer, and a dict of arrays: values of the nearest surface in each pixel.

    The arrays are "normal", "velocity", "id" and "distance"; they are infinite where no surface is.
    """
    samples = window.GetMultiSamples()
    window.SetMultiSamples(0)
    try:
        depth = _render_depth(window, renderer)
        values = _render_values(window, renderer, _stand_in(renderer, velocity))
    finally:
        window.SetMultiSamples(samples)
    return depth, values


def _render_depth(window: Any, renderer: Any) -> Any:
    """Returns the depth buffer of a renderer.

    Meanwhile hides the other renderers in the same layer and above, which may clear the buffer.
    ParaView's axes and its camera orientation widget have such renderers, visible or not.
    """
    later = [
        other
        for other in window.GetRenderers()
        if other is not renderer and other.GetDraw() and other.GetLayer() >= renderer.GetLayer()
    ]
    for other in later:
        other.DrawOff()
    try:
        window.Render()
        size = window.GetSize()
        depth = vtkFloatArray()
        window.GetZbufferData(0, 0, size[0] - 1, size[1] - 1, depth)
    finally:
        for other in later:
            other.DrawOn()
    return vtk_to_numpy(depth).astype(float)


def _stand_in(renderer: Any, velocity: Any) -> Any:
    """Returns the surfaces of all actors as one mesh, with values as point arrays, or None."""
    surfaces = list[Any]()
    camera = renderer.GetActiveCamera()
    actors, index = renderer.GetActors(), 0
    actors.InitTraversal()
    while (actor := actors.GetNextActor()) is not None:
        index += 1
        surface = _surface_of(actor, velocity)
        if surface is not None:
            surfaces.append(_with_values(surface, velocity, index, camera))
    return output_of(vtkAppendPolyData(), *surfaces) if surfaces else None


def _surface_of(actor: Any, velocity: Any) -> Any:
    """Returns an actor's opaque surface, in world coordinates and with normals, or None."""
    mapper = actor.GetMapper()
    if not actor.GetVisibility() or mapper is None or actor.HasTranslucentPolygonalGeometry():
        return None
    data = mapper.GetInputDataObject(0, 0)
    if data is None or mapper.IsA("vtkGlyph3DMapper"):
        return None
    has_blocks = data.IsA("vtkCompositeDataSet")
    if not has_blocks and not data.IsA("vtkDataSet"):
        return None
    outside = vtkCompositeDataGeometryFilter() if has_blocks else vtkGeometryFilter()
    surface = output_of(outside, data)
    if surface.GetNumberOfCells() == 0:
        return None
    if surface.GetPointData().GetNormals() is None:
        normals = vtkPolyDataNormals()
        normals.SplittingOff()
        surface = output_of(normals, surface)
    surface.GetPointData().SetActiveVectors(velocity)
    to_world, turned = vtkTransform(), vtkTransformFilter()
    to_world.SetMatrix(actor.GetMatrix())
    turned.SetTransform(to_world)
    return output_of(turned, surface)


def _with_values(surface: Any, velocity: Any, index: int, camera: Any) -> Any:
    """Returns the surface with only the arrays that are rendered."""
    only = surface.NewInstance()
    only.CopyStructure(surface)
    count = surface.GetNumberOfPoints()
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
    source = surface.GetPointData()
    speeds = source.GetArray(velocity)
    if speeds is None or speeds.GetNumberOfComponents() != 3:
        speeds = numpy.zeros((count, 3))
    else:
        speeds = vtk_to_numpy(speeds)
    values = {
        "normal": vtk_to_numpy(source.GetNormals()),
        "velocity": speeds,
        "id": numpy.full(count, index),
        "distance": distances_along_axis(points, camera),
    }
    for name, numbers in values.items():
        add_array(only, name, numpy.asarray(numbers, dtype=numpy.float32))
    return only


def _render_values(window: Any, renderer: Any, surface: Any) -> Any:
    """Returns the arrays of the surface in each pixel, rendered by vtkValuePass."""
    shape = {"normal": 3, "velocity": 3, "id": 1, "distance": 1}
    pixels = window.GetSize()[0] * window.GetSize()[1]
    if surface is None:
        return {
            name: numpy.full((pixels, count) if count > 1 else pixels, numpy.inf)
            for name, count in shape.items()
        }
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(surface)
    actor = vtkActor()
    actor.SetMapper(mapper)
    drawn = vtkRenderer()
    drawn.AddActor(actor)
    drawn.SetActiveCamera(renderer.GetActiveCamera())
    values, passes = vtkValuePass(), vtkRenderPassCollection()
    passes.AddItem(values)
    sequence, camera_pass = vtkSequencePass(), vtkCameraPass()
    sequence.SetPasses(passes)
    camera_pass.SetDelegatePass(sequence)
    drawn.SetPass(camera_pass)
    others = list(window.GetRenderers())
    for other in others:
        window.RemoveRenderer(other)
    window.AddRenderer(drawn)
    try:
        _draw(window, drawn, values, "id", 1)  # VTK 9.1 draws the first array without depth
        return {name: _draw(window, drawn, values, name, shape[name]) for name in shape}
    finally:
        values.ReleaseGraphicsResources(window)
        window.RemoveRenderer(drawn)
        for other in others:
            window.AddRenderer(other)


def _draw(window: Any, renderer: Any, values: Any, name: str, count: int) -> Any:
    values.SetInputArrayToProcess(_POINT_FIELD, name)
    drawn = []
    for component in range(count):
        values.SetInputComponentToProcess(component)
        window.Render()
        drawn.append(vtk_to_numpy(values.GetFloatImageDataArray(renderer)).astype(float))
    numbers = numpy.stack(drawn, axis=1) if count > 1 else drawn[0]
    # The background is NaN, and comparisons with NaN are false.
    return numpy.where(numpy.isnan(numbers), numpy.inf, numbers)
