"""Two fluids in a box, a heavy one under a light one, whose skins share the surface between them.

The skin of the heavy fluid follows its particles from frame to frame, and is the obstacle of the
light fluid's skin: no point of the light skin is deeper than 0.2 voxel in the heavy skin. A change
of an obstacle restarts the motion, so each frame of the light skin is independent of the frame
before, and the light skin flickers more than the heavy skin. Where both skins meet air or a wall,
their edges are round, with a groove between them.

Particles of the two fluids have to stay apart: fluids that mix have no surface between them.

Run: python3 two_fluids.py [--output FOLDER]
"""

import active_implicit_surfaces as active
import numpy as np
from active_implicit_surfaces.measures import measure
from film_strip import CLAY, output_folder, skin_actor, write_film_strip
from two_layers import write_fluids


def skins_of(path, spacing):
    """Yields for each frame the heavy skin, the light skin, and the function of the heavy skin."""
    options = {"particle_spacing": spacing}
    first = active.frames(path, where="phase=1", **options)
    light = active.ParticleSeries(path, where="phase=2")
    for step, (_, heavy_skin) in enumerate(first):
        function = first.surface.GetSkinFunction()
        light_skin = active.skin(light.frame(step), obstacle_function=function, **options)
        yield heavy_skin, light_skin, function


def main():
    folder, spacing, pictures = output_folder(__doc__), 0.04, []
    path = folder / "two_fluids.npz"
    write_fluids(path, spacing, 7)
    counts = [np.count_nonzero(np.load(path)["phase"][0] == phase) for phase in (1, 2)]
    for step, (heavy, light, _) in enumerate(skins_of(path, spacing)):
        shares = [
            measure(skin)["volume"] / (count * spacing**3)
            for skin, count in zip((heavy, light), counts)
        ]
        print(f"frame {step}: volumes {shares[0]:.3f} and {shares[1]:.3f} of their particles'")
        if step in (0, 3, 6):
            pictures.append([skin_actor(heavy, CLAY), skin_actor(light)])
    write_film_strip(folder / "two_fluids.png", pictures, view=(0.35, 0.25, 1), width=2000)
    print(f"wrote {folder / 'two_fluids.png'}")


if __name__ == "__main__":
    main()
