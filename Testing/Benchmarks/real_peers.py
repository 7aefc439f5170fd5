"""Surfaces by other programs and by single filters, for real_data.py.

real_data.py starts this file as a program for OVITO, which loads a Qt of its own:
python3 real_peers.py ovito METHOD PDB FOLDER (METHOD: alpha or density).
"""

import resource
import subprocess
import sys
import sysconfig
import time
from pathlib import Path

import numpy as np

VDW = {"H": 1.2, "C": 1.7, "N": 1.55, "O": 1.52, "S": 1.8}  # Angstrom

# The settings RECOMMENDED of skin_makers.py, as options of the program splashsurf.
SPLASHSURF = (
    "-l 2.0 -c 1.0 -t 0.6 --mesh-smoothing-weights=on --mesh-smoothing-iters 25 "
    "--mesh-cleanup=on --normals=on --normals-smoothing-iters 10 -q"
)


def run(command):
    """Runs a program; returns wall-clock and CPU seconds."""

    def cpu():
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        return used.ru_utime + used.ru_stime

    print("$", " ".join(map(str, command)), flush=True)
    began, before = time.perf_counter(), cpu()
    subprocess.run(command, check=True)
    return time.perf_counter() - began, cpu() - before


def splashsurf(files, folder, radius):
    """Makes meshes of a series of files, whose names have {} for the number; returns seconds."""
    folder.mkdir(exist_ok=True)
    program = Path(sysconfig.get_path("scripts")) / "pysplashsurf"
    names = ["-o", folder / "skin_{}.ply", "-r", str(radius)]
    return run([program, "reconstruct", files, *names, *SPLASHSURF.split()])


def ovito(method, atoms, folder):
    """Makes the surfaces of all frames by OVITO; `method` is alpha or density. Returns seconds."""
    folder.mkdir(exist_ok=True)
    return run([sys.executable, __file__, "ovito", method, atoms, folder])


def run_ovito(method, atoms, folder):
    """Uses van der Waals radii. The alpha shape's radius of 4 A is OVITO's default."""
    from ovito.io import export_file, import_file
    from ovito.modifiers import ConstructSurfaceModifier

    def set_radii(frame, data):
        types = data.particles_.particle_types_
        for kind in list(types.types):
            types.type_by_id_(kind.id).radius = VDW[kind.name.lstrip("0123456789")[0]]

    methods = ConstructSurfaceModifier.Method
    settings = {
        "alpha": {"method": methods.AlphaShape, "radius": 4.0},
        "density": {"method": methods.GaussianDensity, "grid_resolution": 100},
    }
    pipeline = import_file(atoms)
    pipeline.modifiers.append(set_radii)
    pipeline.modifiers.append(ConstructSurfaceModifier(**settings[method]))
    for frame in range(pipeline.source.num_frames):
        surface = pipeline.compute(frame).surfaces["surface"]
        export_file(surface, f"{folder}/skin_{frame}.vtk", "vtk/trimesh")


def image_of(labels, affine):
    """Returns the values as VTK's image. The affine map must have no rotation."""
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonDataModel import vtkImageData

    image = vtkImageData()
    image.SetDimensions(labels.shape)
    image.SetSpacing(np.diag(affine)[:3])
    image.SetOrigin(affine[:3, 3])
    image.GetPointData().SetScalars(numpy_to_vtk(labels.ravel(order="F"), deep=True))
    return image


def windowed_sinc(labels, label, affine):
    """Meshes by vtkDiscreteMarchingCubes and by windowed sinc, and the seconds of both together."""
    from vtkmodules.vtkFiltersCore import vtkWindowedSincPolyDataFilter
    from vtkmodules.vtkFiltersGeneral import vtkDiscreteMarchingCubes

    cubes, sinc = vtkDiscreteMarchingCubes(), vtkWindowedSincPolyDataFilter()
    cubes.SetInputData(image_of(labels, affine))
    cubes.SetValue(0, label)
    sinc.SetInputConnection(cubes.GetOutputPort())
    sinc.SetNumberOfIterations(20)
    sinc.SetPassBand(0.1)
    sinc.BoundarySmoothingOff()
    sinc.FeatureEdgeSmoothingOff()
    sinc.NonManifoldSmoothingOn()
    sinc.NormalizeCoordinatesOn()
    began = time.perf_counter()
    sinc.Update()
    return cubes.GetOutput(), sinc.GetOutput(), time.perf_counter() - began


def skin_of_label(labels, label, affine):
    from active_implicit_surfaces import vtkActiveImplicitSurface

    surface = vtkActiveImplicitSurface()
    surface.SetInputData(image_of((labels == label).astype(np.uint8), affine))
    began = time.perf_counter()
    surface.Update()
    return surface.GetOutput(), time.perf_counter() - began


def level_of(values, level):
    """The surface at a level of an image whose voxels are 1 long."""
    from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D

    edges = vtkFlyingEdges3D()
    edges.SetInputData(image_of(values, np.eye(4)))
    edges.SetValue(0, level)
    edges.Update()
    return edges.GetOutput()


if __name__ == "__main__":
    run_ovito(*sys.argv[2:])
