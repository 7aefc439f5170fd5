"""Saves the state that the screenshot of ParaView shows; see Testing/ParaView/screenshot."""

import sys

from paraview.simple import (
    GetActiveViewOrCreate,
    GetAnimationScene,
    Hide,
    RenameSource,
    ResetCamera,
    SaveState,
    Show,
)

sys.path.append("Testing/ParaView")
from scenes import splash  # noqa: E402

STATE = "build/paraview/splash.pvsm"

surface, particles = splash(VoxelSize=0.03)
RenameSource("Splash", particles)
RenameSource("Skin", surface)
view = GetActiveViewOrCreate("RenderView")
shown = Show(surface, view)
shown.ColorArrayName = [None, ""]
shown.DiffuseColor = [0.36, 0.66, 0.86]
Hide(particles, view)
view.CameraPosition = [0.4, 0.5, 1.0]
view.CameraFocalPoint = [0, 0, 0]
view.CameraViewUp = [0, 1, 0]
ResetCamera(view)
GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
GetAnimationScene().AnimationTime = 25
SaveState(STATE)
