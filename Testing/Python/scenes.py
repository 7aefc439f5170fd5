"""Common scenes of the tests: the splash of particles, and the two metamorphoses of the paper."""

import sys
from pathlib import Path

from active_implicit_surfaces import vtkActiveImplicitSurface
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

DATA = Path(__file__).resolve().parents[1] / "Data"
sys.path.append(str(DATA.parents[1] / "Examples" / "Python"))
STEPS = 41
VOXEL = 0.03
PARTICLE_SPACING = 0.085


def splash():
    particles = vtkXMLPolyDataReader()
    particles.SetFileName(str(DATA / "sph_drop.vtp"))
    surface = vtkActiveImplicitSurface()
    surface.SetInputConnection(particles.GetOutputPort())
    surface.SetTimeScale(1 / 25)
    surface.SetVoxelSize(VOXEL)
    surface.SetParticleSpacing(PARTICLE_SPACING)
    surface.SetAttraction(100)
    return particles, surface


def tube_to_box():
    """The example's bent tube that becomes a box, times 0 to 3 (Figure 5 of the paper)."""
    from morph_same_topology import make_surface  # VTK's rendering, which other scenes do not need

    return make_surface()


def star_to_balls():
    """The example's star that becomes two balls, times 0 to 3 (Figure 6 of the paper)."""
    from morph_topology import make_surface

    return make_surface()
