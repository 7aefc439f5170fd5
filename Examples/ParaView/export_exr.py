"""Writes two .exr files of the splash: the layers of a view, for compositing, and a slice of the
potential.

Run: pvbatch export_exr.py [--output DIR]
"""

from pathlib import Path

from active_implicit_surfaces import render
from moments import output_folder
from paraview.simple import (
    ActiveImplicitSurface,
    ExtractSubset,
    GetActiveViewOrCreate,
    OutputPort,
    ResetCamera,
    SaveData,
    Show,
    XMLPolyDataReader,
)
from vtkmodules.util.numpy_support import vtk_to_numpy

DATA = Path(__file__).resolve().parents[2] / "Testing" / "Data" / "sph_drop.vtp"
STEP = 25

folder = output_folder(__doc__)
skin = ActiveImplicitSurface(
    Input=XMLPolyDataReader(FileName=str(DATA)),
    TimeScale=1 / 25,
    VoxelSize=0.05,
    ParticleSpacing=0.085,
    ComputeVelocity=1,  # [length/time], for the layer "forward"
)

skin.UpdatePipeline(STEP)
view = GetActiveViewOrCreate("RenderView")
view.ViewSize = [640, 480]
view.OrientationAxesVisibility = 0
view.ViewTime = STEP
shown = Show(skin, view)
shown.ColorArrayName = [None, ""]
view.CameraPosition = [0.4, 0.5, 1.0]
view.CameraFocalPoint = [0, 0, 0]
ResetCamera(view)
window = view.GetRenderWindow()
layered = folder / "pv_layers.exr"
layers = render.write_exr(window, layered, renderer=view.GetRenderer(), frame_duration=1 / 25)
ids = vtk_to_numpy(layers.GetPointData().GetArray("id"))
print(f"wrote {layered}: the skin in {(ids > 0).sum()} pixels")

# Save Data writes an image of one slice, with all arrays, into an .exr.
extent = list(skin.GetDataInformation(1).GetExtent())
extent[4] = extent[5] = (extent[4] + extent[5]) // 2
middle = ExtractSubset(Input=OutputPort(skin, 1), VOI=extent)
middle.UpdatePipeline(STEP)
SaveData(str(folder / "pv_potential.exr"), proxy=middle)
print(f"wrote {folder / 'pv_potential.exr'}: z = {middle.GetDataInformation().GetBounds()[4]:.2f}")
