"""Van der Waals balls, and solvent-excluded surfaces for probes of 1.4 and 4 angstrom.

Run: python3 solvent.py [--output FOLDER]
"""

import active_implicit_surfaces as active
import numpy as np
from active_implicit_surfaces.data_objects import as_particles
from active_implicit_surfaces.measures import measure
from film_strip import colored, output_folder, skin_actor, write_film_strip

TURNS, PER_TURN, RISE, RADIUS = 3.2, 14, 4.6, 4.6  # of a coil of atoms [angstrom]
COLORS = np.array([[232, 140, 92], [94, 150, 205], [240, 205, 110], [120, 180, 130]], np.uint8)

angles = np.linspace(0, TURNS * 2 * np.pi, round(TURNS * PER_TURN))
coil = RADIUS * np.stack([np.cos(angles), 0 * angles, np.sin(angles)], axis=1)
coil[:, 1] = RISE * angles / (2 * np.pi)
sides = coil[1::3] * [1.4, 1, 1.4]
centers = np.concatenate([coil, sides])
radii = np.repeat([1.7, 1.52], [len(coil), len(sides)])  # carbon and oxygen
residues = np.concatenate([np.arange(len(coil)) // 6, np.arange(len(sides)) // 2])
atoms = as_particles(centers, radii=radii, residue=residues, Color=COLORS[residues % 4])

folder, pictures = output_folder(__doc__), []
for probe in (0.0, 1.4, 4.0):
    skin = active.skin(atoms, radii="radius", probe=probe, voxel_size=0.25, pass_target_arrays=True)
    found = measure(skin)
    print(f"probe {probe}: area {found['area']:.0f} A^2, volume {found['volume']:.0f} A^3")
    pictures.append([colored(skin_actor(skin), "Color")])
write_film_strip(folder / "solvent.png", pictures, view=(0.3, 0.25, 1))
print(f"wrote {folder / 'solvent.png'}")
