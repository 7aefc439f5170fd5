"""Writes the initial files of the fuzzers (Testing/Fuzz/Corpus).

Run: python3 make_corpus.py, with the package and Testing/Python in PYTHONPATH
"""

from pathlib import Path
from random import Random
from shutil import copy

from active_implicit_surfaces import (
    vtkActiveEXRWriter,
    vtkActiveImplicitSurface,
    vtkActiveVDBWriter,
)
from active_implicit_surfaces.data_objects import as_particles
from same_bytes_shapes import add_array, ball
from vtkmodules.vtkCommonDataModel import vtkImageData

HERE = Path(__file__).resolve().parent
CORPUS = HERE / "Corpus"


def small_ball():
    """A ball away from the origin, within one node of the tree, so that files are small."""
    surface = vtkActiveImplicitSurface()
    surface.SetTargetFunction(ball(0.6, (3, 3, 3)))
    surface.SetModelBounds(2, 4, 2, 4, 2, 4)
    surface.SetVoxelSize(0.3)
    surface.UpdateTimeStep(0.2)
    return surface


def small_drop():
    """A skin of two particles, in the node scheme."""
    surface = vtkActiveImplicitSurface()
    surface.SetInputDataObject(as_particles([[3, 3, 3], [3.5, 3, 3]]))
    surface.SetParticleSpacing(0.6)
    surface.SetVoxelSize(0.3)
    surface.UpdateTimeStep(0.2)
    return surface


def write_grids(folder):
    surface = small_ball()
    for compression in (1, 2):  # uncompressed files are ten times as large
        writer = vtkActiveVDBWriter()
        writer.SetInputConnection(surface.GetOutputPort())
        writer.SetCompression(compression)
        writer.SetHalfFloat(compression == 1)
        writer.SetWriteDensity(compression == 2)
        writer.SetFileName(str(folder / f"ball_{compression}.vdb"))
        assert writer.Write()
    copy(HERE.parent / "Data" / "lattice_points.vdb", folder)


def write_pictures(folder):
    picture = vtkImageData()
    picture.SetDimensions(5, 4, 1)
    for name in ("Z", "F"):
        add_array(picture.GetPointData(), name, [i / 8 for i in range(20)])
    for compression in range(4):
        writer = vtkActiveEXRWriter()
        writer.SetInputDataObject(picture)
        writer.SetCompression(compression)
        writer.SetFileName(str(folder / f"picture_{compression}.exr"))
        writer.Write()


def write_bytes(folder, count=8, size=600):
    for seed in range(count):
        (folder / f"random_{seed}").write_bytes(Random(seed).randbytes(size))


def main():
    folders = {}
    for name in ("FuzzVDB", "FuzzEXR", "FuzzState", "FuzzPacked", "FuzzShapes", "FuzzTarget"):
        folders[name] = CORPUS / name
        folders[name].mkdir(parents=True, exist_ok=True)
    write_grids(folders["FuzzVDB"])
    write_pictures(folders["FuzzEXR"])
    assert small_ball().SaveState(str(folders["FuzzState"] / "ball.vdb"))
    assert small_drop().SaveState(str(folders["FuzzState"] / "drop.vdb"))
    write_bytes(folders["FuzzPacked"], size=60)
    write_bytes(folders["FuzzShapes"])
    write_bytes(folders["FuzzTarget"])


if __name__ == "__main__":
    main()
