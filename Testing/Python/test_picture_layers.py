# ctest: PICTURE
"""Depth, normals and motion of a skin match the baseline, with more precision than 8 bits have.

A cube moves towards a ball, seen along its diagonal. The baseline is an .exr. Tolerances per pixel:
depth 1e-4 (the buffer's step here is 1e-7; another rounding of vertices is amplified by slopes of
some hundreds), a normal's component 2e-3 (a half's step near 1 is 1e-3), motion a hundredth of a
pixel. At most 1 of 200 pixels may belong to another surface: other systems rasterise silhouettes
differently. To renew the baseline: view the .exr that the failed test leaves in the folder, and
copy it over.

Run: python3 test_picture_layers.py -V <baseline.png> -T <folder>
"""

import argparse
import sys
from pathlib import Path

import numpy
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from active_implicit_surfaces import render, vtkActiveEXRReader, vtkActiveImplicitSurface
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkBox, vtkSphere
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow

TOLERANCES = {"Z": 1e-4, "N": 2e-3, "forward": 1e-2, "id": 0}
MOST_OTHERS = 1 / 200
SIZE = 96, 72


def skin_on_its_way():
    cube, ball = vtkBox(), vtkSphere()
    cube.SetBounds(-0.6, 0.6, -0.6, 0.6, -0.6, 0.6)
    ball.SetRadius(0.9)
    surface = vtkActiveImplicitSurface()
    surface.SetModelBounds(-1, 1, -1, 1, -1, 1)
    surface.SetVoxelSize(0.05)
    surface.SetInitialFunction(cube)
    surface.SetTargetFunction(ball)
    surface.SetAttraction(2)
    surface.SetComputeVelocity(True)
    surface.UpdateTimeStep(0.2)
    return surface.GetOutput()


def window_with(skin):
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(skin)
    actor = vtkActor()
    actor.SetMapper(mapper)
    renderer = vtkRenderer()
    renderer.AddActor(actor)
    renderer.GetActiveCamera().SetPosition(3, 4, 5)
    renderer.ResetCamera()
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0)
    window.SetSize(SIZE)
    window.AddRenderer(renderer)
    return window


def read(path):
    reader = vtkActiveEXRReader()
    reader.SetFileName(str(path))
    reader.Update()
    data = reader.GetOutput().GetPointData()
    count = SIZE[0] * SIZE[1]
    return {name: vtk_to_numpy(data.GetArray(name)).reshape(count, -1) for name in TOLERANCES}


parser = argparse.ArgumentParser()
parser.add_argument("-V", type=Path, required=True)
parser.add_argument("-T", type=Path, required=True)
arguments = parser.parse_args()
made = arguments.T / "test_picture_layers.exr"
render.write_exr(window_with(skin_on_its_way()), made, frame_duration=1 / 25)
layers, baseline = read(made), read(arguments.V.with_suffix(".exr"))
failed = False
for name, tolerance in TOLERANCES.items():
    off = numpy.abs(layers[name].astype(float) - baseline[name]).max(axis=1)
    others = (off > tolerance).mean()
    print(f"{name}: {others:.2%} of the pixels are off by more than {tolerance}")
    failed = failed or others > MOST_OTHERS
sys.exit(1 if failed else 0)
