"""A molecule whose atoms move: cyclohexane turns from one chair into the other.

Run: python3 molecule.py [--output FOLDER]
"""

import active_implicit_surfaces as active
import numpy as np
from active_implicit_surfaces.data_objects import as_particles
from film_strip import colored, output_folder, skin_actor, write_film_strip

FRAMES = 25
# Five sixths of the van der Waals radii of carbon and hydrogen [angstrom].
RADII = 0.834 * np.repeat([1.7, 1.1], [6, 12])
IDS = np.arange(18)
COLORS = np.repeat(np.array([[90, 95, 105], [235, 238, 240]], np.uint8), [6, 12], axis=0)


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


def atoms(pucker):
    """Returns carbons in a ring, in turn above and below by `pucker`, with two hydrogens each."""
    angles = np.arange(6) * np.pi / 3
    height = pucker * (-1.0) ** np.arange(6)
    carbons = np.stack([1.46 * np.cos(angles), height, 1.46 * np.sin(angles)], axis=1)
    before, after = np.roll(carbons, 1, axis=0) - carbons, np.roll(carbons, -1, axis=0) - carbons
    outward, across = -unit(before + after), unit(np.cross(before, after))
    hydrogens = [carbons + 1.09 * (0.577 * outward + side * across) for side in (0.816, -0.816)]
    return np.concatenate([carbons, *hydrogens])


folder, pictures = output_folder(__doc__), []
puckers = 0.25 * np.cos(np.linspace(0, np.pi, FRAMES))
series = [as_particles(atoms(pucker), ids=IDS, radii=RADII, Color=COLORS) for pucker in puckers]
options = {"preset": "molecule", "voxel_size": 0.15, "pass_target_arrays": True}
for _, skin in active.frames(series, fps=25, **options):
    pictures.append([colored(skin_actor(skin), "Color")])
print(f"{FRAMES} frames, the last one of {skin.GetNumberOfPolys()} triangles")
write_film_strip(folder / "molecule.png", pictures[:: FRAMES // 4], view=(0.3, 0.35, 1))
print(f"wrote {folder / 'molecule.png'}")
