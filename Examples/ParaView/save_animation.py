"""Frames 10 to 25 of the splash as an animation: pictures, and skins as a series of .vtp files.

Run: pvbatch save_animation.py [--output DIR]
"""

from pathlib import Path

from moments import output_folder
from paraview.simple import (
    ActiveImplicitSurface,
    GetActiveViewOrCreate,
    GetAnimationScene,
    Hide,
    OutputPort,
    ResetCamera,
    SaveAnimation,
    SaveData,
    Show,
    XMLPolyDataReader,
)

DATA = Path(__file__).resolve().parents[2] / "Testing" / "Data" / "sph_drop.vtp"
FRAMES = [10, 25]  # the first and the last

folder = output_folder(__doc__)
particles = XMLPolyDataReader(FileName=str(DATA))
skin = ActiveImplicitSurface(
    Input=particles,
    TimeScale=1 / 25,
    VoxelSize=0.05,
    ParticleSpacing=0.085,
    ComputeVelocity=1,  # [length/time], for motion blur in other programs
)

view = GetActiveViewOrCreate("RenderView")
view.ViewSize = [640, 480]
view.OrientationAxesVisibility = 0
shown = Show(skin, view)
shown.ColorArrayName = [None, ""]
Hide(particles, view)
view.CameraPosition = [0.4, 0.5, 1.0]
view.CameraFocalPoint = [0, 0, 0]
ResetCamera(view)

scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
SaveAnimation(str(folder / "pv_frame.png"), view, FrameWindow=FRAMES, SuffixFormat=".%.4d")
SaveData(
    str(folder / "pv_animated.vtp"),
    proxy=OutputPort(skin, 0),
    DataMode="Binary",  # ParaView 5.11 reads this mode with any libexpat
    Writetimestepsasfileseries=1,
    Firsttimestep=FRAMES[0],
    Lasttimestep=FRAMES[1],
    Filenamesuffix="_%.4d",
)
print(f"wrote {folder / 'pv_frame.png'} and pv_animated.vtp, frames {FRAMES[0]} to {FRAMES[1]}")
