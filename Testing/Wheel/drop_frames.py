"""Prints the hashes of the drop's skins, frame by frame, to compare two builds."""

import hashlib
from pathlib import Path

from active_implicit_surfaces import vtkActiveImplicitSurface
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

DATA = Path(__file__).resolve().parents[1] / "Data" / "sph_drop.vtp"

particles = vtkXMLPolyDataReader()
particles.SetFileName(str(DATA))
surface = vtkActiveImplicitSurface()
surface.SetInputConnection(particles.GetOutputPort())
surface.SetTimeScale(1 / 25)  # the file's time steps are numbered 0, 1, 2 ...
surface.SetParticleSpacing(0.085)
surface.SetVoxelSize(0.03)
for step in range(41):
    surface.UpdateTimeStep(step)
    skin = surface.GetOutput()
    parts = hashlib.sha256()
    for array in (skin.GetPoints().GetData(), skin.GetPointData().GetNormals()):
        parts.update(vtk_to_numpy(array).tobytes())
    parts.update(vtk_to_numpy(skin.GetPolys().GetConnectivityArray()).astype("i8").tobytes())
    print(step, skin.GetNumberOfPolys(), parts.hexdigest())
