"""Makes skins over a splash of 992 particles: a file for each frame, and a film strip.

Run: python3 coat_particles.py
"""

import json
import time
from pathlib import Path

from active_implicit_surfaces import vtkActiveImplicitSurface
from film_strip import ball_actor, output_folder, skin_actor, write_film_strip
from vtkmodules.vtkFiltersCore import vtkPolyDataConnectivityFilter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

DATA = Path(__file__).resolve().parents[2] / "Testing" / "Data" / "sph_drop.vtp"
STEPS, SECONDS_PER_STEP = 41, 1 / 25
PICTURED = (5, 10, 15, 20, 25, 39)

folder = output_folder(__doc__)
particles = vtkXMLPolyDataReader()
particles.SetFileName(str(DATA))
surface = vtkActiveImplicitSurface()
surface.SetInputConnection(particles.GetOutputPort())
surface.SetTimeScale(SECONDS_PER_STEP)  # the file numbers its time steps 0, 1, 2 ...
surface.SetParticleSpacing(0.085)
surface.SetVoxelSize(0.03)

components = vtkPolyDataConnectivityFilter()
components.SetExtractionModeToAllRegions()
writer = vtkXMLPolyDataWriter()
writer.SetDataModeToBinary()  # VTK 9.1 reads this mode with any libexpat
balls, skins, files, seconds = [], [], [], 0.0
for step in range(STEPS):
    start = time.perf_counter()
    surface.UpdateTimeStep(step)
    seconds += time.perf_counter() - start
    skin = surface.GetOutput()
    components.SetInputData(skin)
    components.Update()
    files.append({"name": f"skin_{step:04}.vtp", "time": step * SECONDS_PER_STEP})
    writer.SetFileName(str(folder / files[-1]["name"]))
    writer.SetInputData(skin)
    writer.Write()
    if step in PICTURED:
        balls.append([ball_actor(particles.GetOutput(), 0.05)])
        skins.append([skin_actor(skin)])
    pieces, triangles = components.GetNumberOfExtractedRegions(), skin.GetNumberOfPolys()
    print(f"{files[-1]['time']:.2f} s: {triangles} triangles in {pieces} piece(s)", flush=True)

series = folder / "skin.vtp.series"  # for ParaView, with the times in seconds
series.write_text(json.dumps({"file-series-version": "1.0", "files": files}))
picture = folder / "coat_particles.png"
write_film_strip(picture, balls, skins, view=(0.4, 0.5, 1), width=2400, floor=0)
print(f"{STEPS / seconds:.1f} frames/s; wrote {series} and {picture}")
