"""The splash's skin as pictures for compositing: .exr files with depth, normals and motion vectors.

Run: python3 render_exr.py
"""

from pathlib import Path

import numpy
from active_implicit_surfaces import render, vtkActiveEXRWriter, vtkActiveImplicitSurface
from film_strip import output_folder, skin_actor
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow

DATA = Path(__file__).resolve().parents[2] / "Testing" / "Data" / "sph_drop.vtp"
SECONDS_PER_STEP, FIRST, LAST = 1 / 25, 18, 22

folder = output_folder(__doc__)
particles = vtkXMLPolyDataReader()
particles.SetFileName(str(DATA))
surface = vtkActiveImplicitSurface()
surface.SetInputConnection(particles.GetOutputPort())
surface.SetTimeScale(SECONDS_PER_STEP)  # the file numbers its time steps 0, 1, 2 ...
surface.SetVoxelSize(0.03)
surface.SetKernelRadius(0.17)
surface.SetParticleThreshold(0.7)
surface.SetAttraction(100)
surface.SetComputeVelocity(True)  # per second, by TimeScale

renderer, window = vtkRenderer(), vtkRenderWindow()
window.SetOffScreenRendering(True)
window.SetAlphaBitPlanes(True)  # alpha marks the skin
window.SetSize(960, 540)
window.AddRenderer(renderer)
camera = renderer.GetActiveCamera()
camera.SetPosition(0.4, 0.5, 1)
writer = vtkActiveEXRWriter()
writer.SetFramesPerSecond(1 / SECONDS_PER_STEP)
for step in range(FIRST, LAST + 1):
    surface.UpdateTimeStep(step)
    renderer.RemoveAllViewProps()
    renderer.AddActor(skin_actor(surface.GetOutput()))
    if step == FIRST:
        renderer.ResetCamera()
        camera.Zoom(1.45)
    renderer.ResetCameraClippingRange()
    writer.AddAttribute("time", step * SECONDS_PER_STEP)
    path = folder / f"splash.{step:04}.exr"
    image = render.write_exr(window, path, frame_duration=SECONDS_PER_STEP, writer=writer)
    steps = vtk_to_numpy(image.GetPointData().GetArray("forward"))
    print(f"step {step}: up to {numpy.linalg.norm(steps, axis=1).max():.1f} pixels of motion")

picture = folder / "render_exr.png"  # colors of the last picture, for viewing
png = vtkPNGWriter()
png.SetFileName(str(picture))
png.SetInputData(image)
png.Write()
print(f"wrote {folder / 'splash.####.exr'} and {picture}")
