"""Surfaces of a label of thick slices: the faces of its pixels, a windowed sinc, and the skin.

The skin stays within half a pixel of the faces along x and y, and within half a slice along z; it
has the volume of the pixels. The knot and its radius are known, so the errors can be printed.

Run: python3 labels.py [--output FOLDER]
"""

import active_implicit_surfaces as active
import numpy as np
from active_implicit_surfaces.measures import measure
from film_strip import CLAY, output_folder, skin_actor, write_film_strip
from knot_label import distance_to_knot, make_label, smooth_by_sinc
from vtkmodules.util.numpy_support import vtk_to_numpy


def main():
    folder = output_folder(__doc__)
    image, volume = make_label()
    skins = {
        "faces of the pixels": next(iter(active.frames([image], fps=1, target_noise=0))).skin,
        "windowed sinc": smooth_by_sinc(image),
        "skin": next(iter(active.frames([image], fps=1))).skin,
    }
    for name, skin in skins.items():
        error = np.abs(distance_to_knot(vtk_to_numpy(skin.GetPoints().GetData()))).mean()
        share = 100 * (abs(measure(skin)["volume"]) / volume - 1)
        print(f"{name}: mean error {error:.3f}, volume {share:+.2f} % from the label's")
    pictures = [[skin_actor(skin, CLAY)] for skin in skins.values()]
    write_film_strip(folder / "labels.png", pictures, view=(0.3, -1, 0.8), width=2000)
    print(f"wrote {folder / 'labels.png'}")


if __name__ == "__main__":
    main()
