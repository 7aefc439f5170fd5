"""Writes the skin over a splash as a series of narrow-band .vdb files, with its velocity.

Run: python3 write_vdb.py
"""

import time
from pathlib import Path

from active_implicit_surfaces import (
    vtkActiveImplicitSurface,
    vtkActiveVDBReader,
    vtkActiveVDBWriter,
)
from film_strip import output_folder, skin_actor, write_film_strip
from vtkmodules.vtkFiltersCore import vtkContourFilter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

DATA = Path(__file__).resolve().parents[2] / "Testing" / "Data" / "sph_drop.vtp"
FRAMES, SECONDS_PER_STEP = 4, 1 / 25

folder = output_folder(__doc__)
particles = vtkXMLPolyDataReader()
particles.SetFileName(str(DATA))
surface = vtkActiveImplicitSurface()
surface.SetInputConnection(particles.GetOutputPort())
surface.SetTimeScale(SECONDS_PER_STEP)  # the file numbers its time steps 0, 1, 2 ...
surface.SetVoxelSize(0.03)
surface.SetKernelRadius(0.17)
surface.SetParticleThreshold(0.7)
surface.SetAttraction(100)
surface.ComputeVelocityOn()

writer = vtkActiveVDBWriter()  # WriteAllTimeStepsOn() and one Write() would write all 41 frames
writer.SetInputConnection(surface.GetOutputPort())
writer.SetFileName(str(folder / "splash.####.vdb"))
writer.SetUnits("m")
writer.WriteVelocityOn()
reader = vtkActiveVDBReader()
for frame in range(FRAMES):
    surface.UpdateTimeStep(frame)
    start = time.perf_counter()
    if not writer.Write():
        raise SystemExit("the file was not written")
    name = folder / f"splash.{frame:04}.vdb"
    print(f"{name.name}: {name.stat().st_size} bytes, {time.perf_counter() - start:.2f} s")
    reader.AddFileName(str(name))

reader.UpdateTimeStep(FRAMES - 1)
for i in range(reader.GetNumberOfGrids()):
    voxels = reader.GetGridActiveVoxels(i)
    print(f"{reader.GetGridName(i)}: {reader.GetGridClass(i)}, {voxels} active voxels")
contour = vtkContourFilter()
contour.SetInputConnection(reader.GetOutputPort())
contour.SetValue(0, 0.0)
contour.Update()
picture = folder / "write_vdb.png"
skins = [[skin_actor(surface.GetOutput())], [skin_actor(contour.GetOutput())]]
write_film_strip(picture, skins, view=(0.4, 0.5, 1), width=1200, floor=0)
print(f"wrote {picture}: the skin, and to the right what was read back")
