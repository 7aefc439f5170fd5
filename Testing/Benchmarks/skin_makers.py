"""Makers of a skin for each frame of a scene: the filter in some configuration, or splashsurf."""

import sys
import time
from pathlib import Path

import numpy as np
from active_implicit_surfaces import vtkActiveImplicitSurface
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkDataObject, vtkPolyData

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "Examples" / "Python"))
from fluid_scenes import RATE  # noqa: E402
from particle_series import ParticleSeries  # noqa: E402

try:
    import pysplashsurf
except ImportError:
    pysplashsurf = None


class LivingSkin:
    """The filter; each setting is (property, text), with times in seconds."""

    def __init__(self, name, settings):
        self.name, self.settings = name, settings
        for setting, _ in settings:
            if not hasattr(vtkActiveImplicitSurface, f"Set{setting}"):
                sys.exit(
                    f"{name}: vtkActiveImplicitSurface has no property {setting}; see its help()"
                )

    def make(self, scene, voxel):
        series, surface = ParticleSeries(scene.frames, RATE), vtkActiveImplicitSurface()
        surface.SetInputConnection(series.GetOutputPort())
        surface.SetInputArrayToProcess(1, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "id")
        surface.SetVoxelSize(voxel)
        for setting, text in self.settings:
            getattr(surface, f"Set{setting}")(value_of(text, 0.5 * scene.spacing))
        for step in range(len(scene.frames)):
            began = time.perf_counter()
            surface.UpdateTimeStep(step / RATE)
            seconds = time.perf_counter() - began
            skin = vtkPolyData()
            skin.DeepCopy(surface.GetOutput())
            yield skin, seconds


def living_skin(config):
    """Maker for "name: Property=value ..."."""
    name, colon, settings = config.partition(":")
    pairs = [tuple(setting.split("=", 1)) for setting in settings.split()]
    if not colon or any(len(pair) != 2 for pair in pairs):
        sys.exit(f'--config "{config}" is not of the form "name: Property=value ..."')
    return LivingSkin(name.strip(), pairs)


# Settings from the README of splashsurf 0.14.1, "Recommended settings" and "Weighted surface
# smoothing". That page recommends thresholds of 0.6 to 0.7, cubes (here: voxels) of 0.5 to 1
# particle radius, and one of two methods to remove slivers before the smoothing.
RECOMMENDED = {
    "smoothing_length": 2.0,
    "iso_surface_threshold": 0.6,
    "mesh_smoothing_weights": True,
    "mesh_smoothing_iters": 25,
    "mesh_cleanup": True,
    "compute_normals": True,
    "normals_smoothing_iters": 10,
}


class SplashSurf:
    def __init__(self, name, **others):
        self.name, self.settings = name, RECOMMENDED | others

    def make(self, scene, voxel):
        radius = 0.5 * scene.spacing
        for positions, _, _ in scene.frames:
            began = time.perf_counter()
            mesh, _ = pysplashsurf.reconstruction_pipeline(
                positions,
                particle_radius=radius,
                cube_size=voxel / radius,
                **self.settings,
            )
            seconds = time.perf_counter() - began
            yield as_poly_data(mesh), seconds


def splash_surfs():
    if not pysplashsurf:
        return []
    return [SplashSurf("splashsurf"), SplashSurf("no cleanup", mesh_cleanup=False)]


def numbers(text):
    """Numbers separated by commas."""
    return [float(number) for number in text.split(",")]


def value_of(text, radius):
    """A number, or a number of particle radii (3.4r) or of their squares (25r2), or a word."""
    for suffix, unit in (("r2", radius * radius), ("r", radius), ("", 1)):
        if suffix and not text.endswith(suffix):
            continue
        number = text.removesuffix(suffix)
        for kind in (int, float):
            try:
                return kind(number) * unit
            except ValueError:
                pass
    return text


def as_poly_data(mesh):
    skin, points, triangles = vtkPolyData(), vtkPoints(), vtkCellArray()
    points.SetData(numpy_to_vtk(np.asarray(mesh.mesh.vertices), deep=True))
    corners = np.asarray(mesh.mesh.triangles).astype(np.int64)
    triangles.SetData(3, numpy_to_vtkIdTypeArray(corners.ravel(), deep=True))
    skin.SetPoints(points)
    skin.SetPolys(triangles)
    normals = numpy_to_vtk(np.asarray(mesh.point_attributes["normals"]), deep=True)
    normals.SetName("Normals")
    skin.GetPointData().SetNormals(normals)
    return skin
