"""Skins of the same particles with three tensions, as in the paper's Figure 4.

Run: python3 three_tensions.py [--output FOLDER]
"""

from pathlib import Path

from active_implicit_surfaces import vtkActiveImplicitSurface
from film_strip import ball_actor, output_folder, skin_actor, write_film_strip
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

DATA = Path(__file__).resolve().parents[2] / "Testing" / "Data" / "sph_drop.vtp"
STEP, RADIUS = 24, 0.05
TENSIONS = (0, 0.5, 2)  # times Attraction * RADIUS ** 2

folder = output_folder(__doc__)
particles = vtkXMLPolyDataReader()
particles.SetFileName(str(DATA))
particles.UpdateTimeStep(STEP)
pictures = [[ball_actor(particles.GetOutput(), RADIUS)]]
for tension in TENSIONS:
    surface = vtkActiveImplicitSurface()
    surface.SetInputData(particles.GetOutput())
    surface.SetParticleModelToSum()
    surface.SetKernelRadius(3 * RADIUS)
    surface.SetTensionWeighting(False)  # same tension everywhere, as in the paper
    surface.SetVoxelSize(RADIUS / 2)
    surface.SetTension(tension * RADIUS**2)  # Attraction is 1
    surface.SetCreateParts(False)  # drops lost to tension do not reappear
    surface.UpdateTimeStep(1.0)
    skin = surface.GetOutput()
    print(f"tension {tension} r^2: {skin.GetNumberOfPolys()} triangles", flush=True)
    pictures.append([skin_actor(skin)])
write_film_strip(folder / "three_tensions.png", pictures, view=(0.4, 0.5, 1), floor=0)
print(f"wrote {folder / 'three_tensions.png'}")
