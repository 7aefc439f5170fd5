"""Makes skins over a splash of 992 particles: a mesh for each frame, and a picture of one frame.

Run: pvbatch coat_particles.py [--output DIR]
"""

import argparse
from pathlib import Path

from paraview.simple import (
    ActiveImplicitSurface,
    GetActiveViewOrCreate,
    Hide,
    OutputPort,
    ResetCamera,
    SaveData,
    SaveScreenshot,
    Show,
    XMLPolyDataReader,
)

DATA = Path(__file__).resolve().parents[2] / "Testing" / "Data" / "sph_drop.vtp"

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--output", type=Path, default=Path("output"), metavar="DIR")
folder = parser.parse_args().output
folder.mkdir(parents=True, exist_ok=True)

particles = XMLPolyDataReader(FileName=str(DATA))
skin = ActiveImplicitSurface(
    Input=particles,
    TimeScale=1 / 25,  # the file numbers its time steps 0, 1, 2 ...
    VoxelSize=0.03,
    ParticleSpacing=0.085,
)
SaveData(
    str(folder / "pv_skin.vtp"),
    proxy=OutputPort(skin, 0),
    DataMode="Binary",  # ParaView 5.11 reads this mode with any libexpat
    Writetimestepsasfileseries=1,
    Filenamesuffix="_%.4d",
)

view = GetActiveViewOrCreate("RenderView")
view.ViewSize = [1200, 800]
view.ViewTime = 25
view.OrientationAxesVisibility = 0
shown = Show(skin, view)
shown.ColorArrayName = [None, ""]
shown.DiffuseColor = [0.36, 0.66, 0.86]
Hide(particles, view)
view.CameraPosition = [0.4, 0.5, 1.0]
view.CameraFocalPoint = [0, 0, 0]
view.CameraViewUp = [0, 1, 0]
ResetCamera(view)
SaveScreenshot(str(folder / "coat_particles_paraview.png"), view)
print(f"wrote {folder / 'pv_skin_0000.vtp'} to pv_skin_0040.vtp and a picture")
