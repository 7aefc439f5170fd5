"""Writes the example states splash.pvsm and morph.pvsm, which ParaView opens with the plugin.

Run: pvbatch save_states.py [--output DIR]
"""

import argparse
from pathlib import Path

from paraview.simple import (
    ActiveImplicitSurface,
    ActiveImplicitSurfaceFunctions,
    AssignViewToLayout,
    CreateRenderView,
    GetAnimationScene,
    Hide,
    RenameSource,
    ResetCamera,
    ResetSession,
    SaveState,
    Show,
    XMLPolyDataReader,
)

DATA = Path(__file__).resolve().parents[2] / "Testing" / "Data" / "sph_drop.vtp"


def save(skin, path, time):
    """Saves a state with a view of the skin. The state names data files without their folder."""
    RenameSource("Skin", skin)
    view = CreateRenderView()
    AssignViewToLayout(view)
    shown = Show(skin, view)
    shown.ColorArrayName = [None, ""]
    shown.DiffuseColor = [0.36, 0.66, 0.86]
    view.CameraPosition, view.CameraViewUp = [0.4, 0.5, 1.0], [0, 1, 0]
    ResetCamera(view)
    GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
    GetAnimationScene().AnimationTime = time
    SaveState(str(path))
    path.write_text(path.read_text().replace(str(DATA), DATA.name))
    print(f"wrote {path}")
    ResetSession()


parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--output", type=Path, default=Path("output"), metavar="DIR")
folder = parser.parse_args().output
folder.mkdir(parents=True, exist_ok=True)

particles = XMLPolyDataReader(FileName=str(DATA))
splash = ActiveImplicitSurface(Input=particles, TimeScale=1 / 25, ParticleSpacing=0.085)
Hide(particles)
save(splash, folder / "splash.pvsm", 25)

bounds = [-1, 1, -1, 1, -1, 1]
morph = ActiveImplicitSurfaceFunctions(
    InitialFunction="Superquadric", ModelBounds=bounds, Attraction=4
)
morph.InitialFunction.Toroidal = 1
morph.TargetFunction.Radius = 0.6
save(morph, folder / "morph.pvsm", 0.5)
