"""Scene for pictures of skins: lights, ground, and a fixed camera."""

from __future__ import annotations

import math
from typing import Any

import numpy
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  draws
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkLight,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkWindowToImageFilter,
)
from vtkmodules.vtkRenderingOpenGL2 import vtkRenderStepsPass, vtkSSAOPass

PAPER = (0.96, 0.96, 0.95)
COLORS = {
    "water": (0.36, 0.66, 0.86),
    "viscous": (0.93, 0.68, 0.25),
    "molecule": (0.62, 0.78, 0.55),
    "grains": (0.86, 0.75, 0.56),
    "paper": (0.95, 0.66, 0.46),
}
VIEW_ANGLE = 20.0
FINENESS = 2  # supersampling factor of a picture
BORDER = 12  # pixels cut off: ambient occlusion is incomplete at the border of the picture
# Directions from the scene to the camera by up axis; with y or z up, x points to the right.
VIEWS = {"x": (0.5, 1.0, 0.45), "y": (0.45, 0.5, 1.0), "z": (0.45, -1.0, 0.5)}

# Key, fill and rim light relative to the camera: direction, color, intensity.
LIGHTS = (
    ((-1.0, 1.4, 1.2), (1.00, 0.97, 0.92), 0.80),
    ((1.3, 0.1, 0.8), (0.85, 0.92, 1.00), 0.45),
    ((0.2, 1.0, -0.8), (1.00, 1.00, 1.00), 0.30),
)


class Scene:
    """Renders skins with one fixed camera.

    - held (array (n, 3)): points in view; the ground is below all of them.
    - size ((int, int)): size of the pictures [pixels].
    - soft (bool): ambient occlusion; must be False for the layers of render.capture().

    Attributes:
    - apart (dict): the argument `apart` of render.capture(): {"ground": actor}, or {} without a
      ground.
    """

    def __init__(
        self,
        held: Any,
        size: tuple[int, int],
        up: str = "y",
        color: tuple[float, float, float] = COLORS["water"],
        soft: bool = True,
        ground: bool = True,
    ) -> None:
        self.size, self.soft = size, soft
        self.fineness, self.border = (FINENESS, BORDER) if soft else (1, 0)
        self.renderer, self.window = vtkRenderer(), vtkRenderWindow()
        self.mapper, self.actor = vtkPolyDataMapper(), vtkActor()
        self.mapper.ScalarVisibilityOff()
        self.actor.SetMapper(self.mapper)
        _set_look(self.actor.GetProperty(), color)
        self.renderer.AddActor(self.actor)
        self.renderer.SetBackground(PAPER)
        self._add_lights()
        points = numpy.asarray(held, dtype=float)
        axis, sign = "xyz".index(up[-1]), -1.0 if up[0] == "-" else 1.0
        self._place_camera(points, axis, sign)
        self.apart = {"ground": self._add_ground(points.min(0), points.max(0), axis, sign)}
        if not ground:
            self.renderer.RemoveActor(self.apart.pop("ground"))
        self.window.SetOffScreenRendering(True)
        self.window.SetMultiSamples(0 if soft else 8)
        self.window.SetSize(*(self.fineness * (side + 2 * self.border) for side in size))
        self.window.AddRenderer(self.renderer)

    def show(self, skin: Any) -> None:
        """Sets the skin of the scene."""
        self.mapper.SetInputData(skin)
        self.actor.SetVisibility(skin.GetNumberOfPoints() > 0)

    def picture(self) -> Any:
        """Renders the scene and returns a vtkImageData of RGB."""
        taken = vtkWindowToImageFilter()
        self.window.Render()
        taken.SetInput(self.window)
        taken.ReadFrontBufferOff()
        taken.Update()
        return self._inner_part(vtk_to_numpy(taken.GetOutput().GetPointData().GetScalars()))

    def _inner_part(self, pixels: Any) -> Any:
        """Returns an image without border, whose pixels are means of fineness x fineness pixels."""
        fineness, (width, height) = self.fineness, self.size
        start = fineness * self.border
        rows = pixels.reshape(-1, fineness * (width + 2 * self.border), 3)
        rows = rows[start : start + fineness * height, start : start + fineness * width]
        blocks = rows.reshape(height, fineness, width, fineness, 3).astype(numpy.uint16)
        means = numpy.rint(blocks.sum(axis=(1, 3)) / fineness**2).astype(numpy.uint8)
        image = vtkImageData()
        image.SetDimensions(width, height, 1)
        image.GetPointData().SetScalars(numpy_to_vtk(means.reshape(-1, 3), deep=True))
        return image

    def _add_lights(self) -> None:
        self.renderer.AutomaticLightCreationOff()
        for direction, color, intensity in LIGHTS:
            light = vtkLight()
            light.SetLightTypeToCameraLight()
            light.SetPosition(direction)
            light.SetFocalPoint(0.0, 0.0, 0.0)
            light.SetColor(color)
            light.SetIntensity(intensity)
            self.renderer.AddLight(light)

    def _place_camera(self, points: Any, up: int, sign: float) -> None:
        """Places the camera just far enough to show all points, with a margin of 8 %."""
        to_camera, upward = numpy.array(VIEWS["xyz"[up]]), sign * numpy.eye(3)[up]
        to_camera[up] *= sign
        to_camera = to_camera / numpy.linalg.norm(to_camera)
        right = numpy.cross(upward, to_camera)
        right = right / numpy.linalg.norm(right)
        axes = numpy.stack([right, numpy.cross(to_camera, right), to_camera])
        seen = points @ axes.T
        middle = 0.5 * (seen.min(axis=0) + seen.max(axis=0))
        seen = seen - middle
        half = math.tan(math.radians(VIEW_ANGLE / 2.0))
        across = numpy.abs(seen[:, 0]) / (half * self.size[0] / self.size[1])
        distance = float((seen[:, 2] + 1.08 * numpy.maximum(across, abs(seen[:, 1]) / half)).max())
        focus = middle @ axes
        camera = self.renderer.GetActiveCamera()
        camera.SetFocalPoint(focus)
        camera.SetPosition(focus + distance * to_camera)
        camera.SetViewUp(upward)
        larger = 1.0 + 2.0 * self.border / self.size[1]
        camera.SetViewAngle(2.0 * math.degrees(math.atan(half * larger)))
        if self.soft:
            self.renderer.SetPass(_shade_in_corners(2.0 * half * distance))

    def _add_ground(self, low: Any, high: Any, up: int, sign: float) -> Any:
        """Adds and returns a ground in the background color, visible only by ambient occlusion."""
        reach, height = (
            4.0 * float(numpy.linalg.norm(high - low)),
            min(sign * low[up], sign * high[up]),
        )
        first, second = numpy.eye(3)[(up + 1) % 3], numpy.eye(3)[(up + 2) % 3]
        middle = 0.5 * (low + high)
        middle[up] = sign * (height - 1e-3 * float((high - low).max()))
        plane, mapper, actor = vtkPlaneSource(), vtkPolyDataMapper(), vtkActor()
        plane.SetOrigin(middle - reach * (first + second))
        plane.SetPoint1(middle + reach * (first - second))
        plane.SetPoint2(middle + reach * (second - first))
        mapper.SetInputConnection(plane.GetOutputPort())
        actor.SetMapper(mapper)
        look = actor.GetProperty()
        look.SetColor(PAPER)
        look.SetAmbient(1.0)
        look.SetDiffuse(0.0)
        look.SetSpecular(0.0)
        self.renderer.AddActor(actor)
        self.renderer.ResetCameraClippingRange()
        return actor


def _set_look(look: Any, color: tuple[float, float, float]) -> None:
    look.SetColor(color)
    look.SetAmbient(0.32)
    look.SetDiffuse(0.72)
    look.SetSpecular(0.35)
    look.SetSpecularPower(40)


def _shade_in_corners(seen: float) -> Any:
    """Returns a render pass of ambient occlusion, of radius 0.2 times `seen`, the view's height."""
    shade = vtkSSAOPass()
    shade.SetRadius(0.2 * seen)
    shade.SetBias(0.008 * seen)
    shade.SetKernelSize(32)
    shade.BlurOn()
    shade.SetDelegatePass(vtkRenderStepsPass())
    return shade
