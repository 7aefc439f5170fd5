"""Pictures for the examples: several frames in one PNG, with the same camera and light."""

import argparse
import math
from pathlib import Path

from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkMath
from vtkmodules.vtkCommonDataModel import vtkBoundingBox, vtkImageData
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkFiltersCore import vtkImageAppend
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource
from vtkmodules.vtkImagingCore import vtkExtractVOI, vtkImageShrink3D
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkCamera,
    vtkGlyph3DMapper,
    vtkLight,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkWindowToImageFilter,
)
from vtkmodules.vtkRenderingOpenGL2 import vtkRenderStepsPass, vtkSSAOPass

PAPER = (0.96, 0.96, 0.95)
WATER = (0.36, 0.66, 0.86)
CLAY = (0.95, 0.66, 0.46)
VIEW_ANGLE = 14.0
FINENESS = 2  # supersampling factor of a frame
BORDER = 12  # pixels cut off: the shade in corners ends before the picture does

# Key, fill and rim light relative to the camera: direction, color, intensity.
LIGHTS = (
    ((-1.0, 1.4, 1.2), (1.00, 0.97, 0.92), 0.80),
    ((1.3, 0.1, 0.8), (0.85, 0.92, 1.00), 0.45),
    ((0.2, 1.0, -0.8), (1.00, 1.00, 1.00), 0.30),
)


def output_folder(description):
    """Creates and returns the folder that the option --output names."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--output", type=Path, default=Path("output"), metavar="DIR")
    folder = parser.parse_args().output
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def skin_actor(surface, color=WATER):
    """Returns an actor for a copy of a surface; later changes of the surface do not show."""
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(_copy(surface))
    return _actor(mapper, color)


def ball_actor(points, radius, color=CLAY):
    """Returns an actor with a ball at each point; later changes of the points do not show."""
    ball = vtkSphereSource()
    ball.SetRadius(radius)
    ball.SetThetaResolution(24)
    ball.SetPhiResolution(16)
    mapper = vtkGlyph3DMapper()
    mapper.SetInputData(_copy(points))
    mapper.SetSourceConnection(ball.GetOutputPort())
    mapper.ScalingOff()
    return _actor(mapper, color)


def colored(actor, array):
    """Returns the actor, shown in the colors of a point array of bytes, R G B."""
    mapper = actor.GetMapper()
    mapper.ScalarVisibilityOn()
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SetColorModeToDirectScalars()
    mapper.SelectColorArray(array)
    return actor


def write_film_strip(file_name, *rows, view=(0.45, 0.45, 1.0), width=1920, floor=None):
    """Writes a picture of rows of frames; a frame is a list of actors. One camera fits all frames.

    `view` is the direction from the scene to the camera. `floor` is the height y of a floor, or
    None for no floor.
    """
    actors = [actor for row in rows for frame in row for actor in frame]
    camera, aspect = _camera_that_fits(actors, view)
    ground = [] if floor is None else [_floor_actor(actors, floor)]
    frame_width = width // max(len(row) for row in rows)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0)
    size = (frame_width, round(frame_width / aspect))
    window.SetSize(*(FINENESS * (side + 2 * BORDER) for side in size))
    larger = 1.0 + 2.0 * BORDER / size[1]
    half = math.atan(larger * math.tan(math.radians(VIEW_ANGLE / 2)))
    camera.SetViewAngle(math.degrees(2 * half))
    lines = [[_shoot(window, frame + ground, camera) for frame in row] for row in rows]
    _write_png(file_name, _append([_append(line, 0) for line in reversed(lines)], 1))


def write_pixels(file_name, pixels):
    """Writes an array of bytes [row from below, column, R G B] as a PNG."""
    image = vtkImageData()
    image.SetDimensions(pixels.shape[1], pixels.shape[0], 1)
    image.GetPointData().SetScalars(numpy_to_vtk(pixels.reshape(-1, 3)))
    _write_png(file_name, image)


def _write_png(file_name, image):
    writer = vtkPNGWriter()
    writer.SetFileName(str(file_name))
    writer.SetInputData(image)
    writer.Write()


def _copy(data):
    copy = data.NewInstance()
    copy.DeepCopy(data)
    return copy


def _actor(mapper, color):
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetColor(color)
    look.SetAmbient(0.32)
    look.SetDiffuse(0.72)
    look.SetSpecular(0.35)
    look.SetSpecularPower(40)
    return actor


def _floor_actor(actors, height):
    """Returns a floor in the color of the background, visible only by the shade on the floor."""
    bounds = vtkBoundingBox()
    for actor in actors:
        bounds.AddBounds(actor.GetBounds())
    center, reach = [0.0] * 3, bounds.GetDiagonalLength()
    bounds.GetCenter(center)
    plane = vtkPlaneSource()
    plane.SetOrigin(center[0] - reach, height, center[2] + reach)
    plane.SetPoint1(center[0] + reach, height, center[2] + reach)
    plane.SetPoint2(center[0] - reach, height, center[2] - reach)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(plane.GetOutputPort())
    actor = _actor(mapper, PAPER)
    actor.GetProperty().SetAmbient(1.0)
    actor.GetProperty().SetDiffuse(0.0)
    actor.GetProperty().SetSpecular(0.0)
    return actor


def _camera_that_fits(actors, view):
    """Returns a camera in the direction `view`, and the ratio of its picture's width to height."""
    camera = vtkCamera()
    camera.SetPosition(view)
    camera.SetViewAngle(VIEW_ANGLE)
    seen, center, lengths = _bounds_seen_by(camera, actors), [0.0] * 3, [0.0] * 3
    seen.GetCenter(center)
    seen.GetLengths(lengths)
    lengths = [length + 0.10 * lengths[1] for length in lengths]
    back = vtkMatrix4x4()
    vtkMatrix4x4.Invert(camera.GetViewTransformMatrix(), back)
    middle = back.MultiplyPoint((*center, 1.0))[:3]
    distance = lengths[1] / 2 / math.tan(math.radians(VIEW_ANGLE / 2)) + lengths[2] / 4
    camera.SetFocalPoint(middle)
    vtkMath.Normalize(away := list(view))
    camera.SetPosition([m + distance * a for m, a in zip(middle, away)])
    return camera, lengths[0] / lengths[1]


def _bounds_seen_by(camera, actors):
    """Returns the bounding box of the actors' points along the camera's axes."""
    bounds = vtkBoundingBox()
    turned = vtkTransformPolyDataFilter()
    turned.SetTransform(camera.GetViewTransformObject())
    for actor in actors:
        turned.SetInputData(actor.GetMapper().GetInput())
        turned.Update()
        bounds.AddBounds(turned.GetOutput().GetBounds())
    return bounds


def _shoot(window, actors, camera):
    """One frame as an image."""
    renderer = vtkRenderer()
    renderer.SetBackground(PAPER)
    renderer.AutomaticLightCreationOff()
    for direction, color, intensity in LIGHTS:
        light = vtkLight()
        light.SetLightTypeToCameraLight()
        light.SetPosition(direction)
        light.SetFocalPoint(0.0, 0.0, 0.0)
        light.SetColor(color)
        light.SetIntensity(intensity)
        renderer.AddLight(light)
    for actor in actors:
        renderer.AddActor(actor)
    renderer.SetActiveCamera(camera)
    renderer.ResetCameraClippingRange()
    renderer.SetPass(_shade_in_corners(camera))
    window.AddRenderer(renderer)
    picture = vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    smaller = vtkImageShrink3D()
    smaller.SetInputConnection(picture.GetOutputPort())
    smaller.SetShrinkFactors(FINENESS, FINENESS, 1)
    smaller.MeanOn()
    smaller.Update()
    inner = vtkExtractVOI()
    inner.SetInputData(smaller.GetOutput())
    width, height = (side // FINENESS - BORDER - 1 for side in window.GetSize())
    inner.SetVOI(BORDER, width, BORDER, height, 0, 0)
    inner.Update()
    window.RemoveRenderer(renderer)
    return inner.GetOutput()


def _shade_in_corners(camera):
    """Returns a render pass of ambient occlusion; its radius is 0.2 times the view's height."""
    seen = camera.GetDistance() * math.radians(VIEW_ANGLE)
    shade = vtkSSAOPass()
    shade.SetRadius(0.2 * seen)
    shade.SetBias(0.008 * seen)
    shade.SetKernelSize(96)
    shade.BlurOn()
    shade.SetDelegatePass(vtkRenderStepsPass())
    return shade


def _append(images, axis):
    strip = vtkImageAppend()
    strip.SetAppendAxis(axis)
    for image in images:
        strip.AddInputData(image)
    strip.Update()
    return strip.GetOutput()
