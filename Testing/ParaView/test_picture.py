"""Compares a view of the splash in ParaView with a baseline.

The picture remains in the test's output folder. To renew the baseline: view the picture, and copy
it over Testing/Baselines/test_paraview_splash.png. (A plain script: unittest's exit leaves the
windows of ParaView to X, which is an error.)
"""

import os
from pathlib import Path

from paraview.simple import GetActiveViewOrCreate, Hide, ResetCamera, SaveScreenshot, Show
from scenes import splash
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

NAME = "test_paraview_splash.png"
BASELINE = Path(__file__).resolve().parents[1] / "Baselines" / NAME
PICTURE = Path(os.environ.get("ACTIVE_TEST_OUTPUT", ".")) / NAME


def pixels(file):
    reader = vtkPNGReader()
    reader.SetFileName(str(file))
    reader.Update()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).astype(int)


surface, particles = splash(VoxelSize=0.06)
view = GetActiveViewOrCreate("RenderView")
view.ViewSize = [400, 300]
view.UseColorPaletteForBackground = 0
view.Background = [1, 1, 1]
view.OrientationAxesVisibility = 0
view.ViewTime = 20
shown = Show(surface, view)
shown.ColorArrayName = [None, ""]
shown.DiffuseColor = [0.36, 0.66, 0.86]
Hide(particles, view)
view.CameraPosition = [0.4, 0.5, 1.0]
view.CameraFocalPoint = [0, 0, 0]
view.CameraViewUp = [0, 1, 0]
ResetCamera(view)
SaveScreenshot(str(PICTURE), view)

# About 2000 of 120 000 pixels are on edges, and few of these may differ.
made, expected = pixels(PICTURE), pixels(BASELINE)
assert made.shape == expected.shape, "another size"
different = (abs(made - expected).max(axis=1) > 16).sum()
assert different < 200, f"{different} pixels are different"
