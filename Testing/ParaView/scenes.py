"""Scene of the tests in ParaView: the coarse splash, and the bytes of its outputs."""

from pathlib import Path

from paraview import servermanager
from paraview.simple import ActiveImplicitSurface, XMLPolyDataReader
from vtkmodules.util.numpy_support import vtk_to_numpy

DATA = Path(__file__).resolve().parents[1] / "Data" / "sph_drop.vtp"


def splash(**properties):
    particles = XMLPolyDataReader(FileName=str(DATA))
    return ActiveImplicitSurface(Input=particles, **(COARSE | properties)), particles


IN_USE = tuple(
    name + "InUse"
    for name in (
        "VoxelSize ParticleSpacing KernelRadius TargetReach Attraction Tension TargetNoise".split()
    )
)

COARSE = {
    "TimeScale": 1 / 25,
    "VoxelSize": 0.12,
    "ParticleSpacing": 0.085,
    "Attraction": 100,
}


def skin_bytes(surface, time):
    surface.UpdatePipeline(time)
    return bytes_of(servermanager.Fetch(surface, idx=0))


def triangles_at(surface, time):
    """Points and normals of each triangle as bytes, sorted, as ranks make triangles in another
    order."""
    surface.UpdatePipeline(time)
    skin = servermanager.Fetch(surface, idx=0)
    assert skin.GetNumberOfPolys() > 100, "there is next to no skin"
    corners = vtk_to_numpy(skin.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    points = vtk_to_numpy(skin.GetPoints().GetData())[corners]
    normals = vtk_to_numpy(skin.GetPointData().GetNormals())[corners]
    return sorted(a.tobytes() + b.tobytes() for a, b in zip(points, normals))


def bytes_of(skin):
    arrays = [skin.GetPoints().GetData(), skin.GetPolys().GetConnectivityArray()]
    arrays += [
        skin.GetPointData().GetArray(i) for i in range(skin.GetPointData().GetNumberOfArrays())
    ]
    assert skin.GetNumberOfPolys() > 100, "there is next to no skin"
    return [vtk_to_numpy(array).tobytes() for array in arrays]
