"""Skins of a splash of 992 particles in one loop, with default properties, and a film strip.

Run: python3 skin_and_film.py
"""

from pathlib import Path

import active_implicit_surfaces as active
from film_strip import output_folder, skin_actor, write_film_strip

DATA = Path(__file__).resolve().parents[2] / "Testing" / "Data" / "sph_drop.vtp"

folder = output_folder(__doc__)
frames = []
for time, skin in active.frames(DATA):
    if round(25 * time) in (5, 10, 15, 20):
        print(f"at {time:.2f} s: {skin.GetNumberOfPolys()} triangles", flush=True)
        frames.append([skin_actor(skin)])
picture = folder / "skin_and_film.png"
write_film_strip(picture, frames, view=(0.4, 0.5, 1), floor=0)
print(f"wrote {picture}")
