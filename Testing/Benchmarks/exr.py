"""Time to write and to read a picture of 1920 x 1080 with all layers, on one core.

The picture is the splash's skin at step 20, framed as in a shot, with a floor behind it that fills
the rest (--bare: without). Channels are those of active_implicit_surfaces.render: RGBA, N and
forward HALF, Z and P FLOAT, id UINT. Times are processor times, the best of five.

Run: bash Testing/with_display python3 Testing/Benchmarks/exr.py [--bare]
"""

import os
import sys
import tempfile
import time
from pathlib import Path

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from active_implicit_surfaces import (
    render,
    vtkActiveEXRReader,
    vtkActiveEXRWriter,
    vtkActiveImplicitSurface,
)
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow

DATA = Path(__file__).resolve().parents[1] / "Data" / "sph_drop.vtp"


def skin():
    particles = vtkXMLPolyDataReader()
    particles.SetFileName(str(DATA))
    surface = vtkActiveImplicitSurface()
    surface.SetInputConnection(particles.GetOutputPort())
    surface.SetTimeScale(1 / 25)
    surface.SetVoxelSize(0.03)
    surface.SetKernelRadius(0.17)
    surface.SetParticleThreshold(0.7)
    surface.SetAttraction(100)
    surface.SetComputeVelocity(True)
    surface.UpdateTimeStep(20)
    return surface.GetOutput()


def actor_of(data):
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(data)
    actor = vtkActor()
    actor.SetMapper(mapper)
    return actor


def picture(bare):
    window, renderer = vtkRenderWindow(), vtkRenderer()
    window.SetOffScreenRendering(True)
    window.SetSize(1920, 1080)
    window.AddRenderer(renderer)
    renderer.AddActor(actor_of(skin()))
    renderer.GetActiveCamera().SetPosition(0.4, 0.5, 1)
    renderer.ResetCamera()
    renderer.GetActiveCamera().Zoom(1.7)
    if not bare:
        floor = vtkPlaneSource()
        floor.SetOrigin(-40, 0, 40)
        floor.SetPoint1(40, 0, 40)
        floor.SetPoint2(-40, 0, -40)
        floor.Update()
        renderer.AddActor(actor_of(floor.GetOutput()))
    renderer.ResetCameraClippingRange()
    began = time.perf_counter()
    image = render.capture(window, frame_duration=1 / 25)
    print(f"rendered in {time.perf_counter() - began:.2f} s")
    ids = vtk_to_numpy(image.GetPointData().GetArray("id"))
    print(f"covered: {(ids == 1).mean():.0%} skin, {(ids == 2).mean():.0%} floor")
    return image


def best_of_five(action):
    seconds = []
    for _ in range(5):
        began = time.process_time()
        action()
        seconds.append(time.process_time() - began)
    return min(seconds)


image = picture("--bare" in sys.argv)
os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
with tempfile.TemporaryDirectory() as folder:
    path = Path(folder) / "a.exr"
    writer, reader = vtkActiveEXRWriter(), vtkActiveEXRReader()
    writer.SetInputData(image)
    writer.SetFileName(str(path))
    writer.SetColorEncodingToSRGB()
    for name in ("RGBA", "N", "forward"):
        writer.AssignPixelType(name, writer.HALF)
    reader.SetFileName(str(path))
    for name, compression, level in (
        ("NONE", writer.NONE, 1),
        ("ZIP, level 1", writer.ZIP, 1),
        ("ZIP, level 4", writer.ZIP, 4),
        ("ZIPS, level 1", writer.ZIPS, 1),
        ("PIZ", writer.PIZ, 1),
    ):
        writer.SetCompression(compression)
        writer.SetCompressionLevel(level)
        write = best_of_five(writer.Write)
        read = best_of_five(lambda: (reader.Modified(), reader.Update()))
        size = path.stat().st_size / 1e6
        print(f"{name:14} written in {write:.2f} s, read in {read:.2f} s, {size:.1f} MB")
