"""One mesh becomes another and arrives on time: the year of the paper becomes another year.

Run: python3 morph_meshes.py [--output FOLDER]
"""

import active_implicit_surfaces as active
from film_strip import CLAY, output_folder, skin_actor, write_film_strip
from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkTriangleFilter
from vtkmodules.vtkFiltersModeling import vtkLinearExtrusionFilter
from vtkmodules.vtkRenderingFreeType import vtkVectorText

DURATION, FRAMES = 2.0, 21


def solid(word):
    """Returns a word as a closed mesh of extruded letters."""
    letters, extruded = vtkVectorText(), vtkLinearExtrusionFilter()
    triangles, closed = vtkTriangleFilter(), vtkCleanPolyData()
    letters.SetText(word)
    extruded.SetInputConnection(letters.GetOutputPort())
    extruded.SetExtrusionTypeToVectorExtrusion()
    extruded.SetVector(0, 0, 0.35)
    triangles.SetInputConnection(extruded.GetOutputPort())
    closed.SetInputConnection(triangles.GetOutputPort())
    closed.Update()
    return closed.GetOutput()


folder = output_folder(__doc__)
way = active.morph(solid("1998"), solid("2026"), DURATION, frames=FRAMES, voxel_size=0.02)
pictures = []
for time, skin in way:
    if round(time / DURATION * (FRAMES - 1)) in (0, 7, 14, 20):
        print(f"at {time:.1f} s: {skin.GetNumberOfPolys()} triangles", flush=True)
        pictures.append([skin_actor(skin, CLAY)])
picture = folder / "morph_meshes.png"
write_film_strip(picture, pictures[:2], pictures[2:], view=(0.2, 0.35, 1), width=1600, floor=0)
print(f"wrote {picture}")
