"""Motion blur by the vectors of an .exr file: each pixel is a mean along its path.

Run: python3 motion_blur.py [--output FOLDER]
"""

from pathlib import Path

import active_implicit_surfaces as active
import numpy as np
from active_implicit_surfaces import render, scene, vtkActiveEXRReader
from film_strip import output_folder, write_pixels
from vtkmodules.util.numpy_support import vtk_to_numpy

DATA = Path(__file__).resolve().parents[2] / "Testing" / "Data" / "sph_drop.vtp"
STEP, SIZE, SAMPLES, REACH = 9, (640, 400), 24, 24  # REACH: largest blur [pixels]


def widest(vectors):
    """Returns the longest vector within REACH of each pixel, so that blur exceeds the outline."""
    for axis in (0, 1):
        shifted = [np.roll(vectors, shift, axis) for shift in range(-REACH, REACH + 1, 2)]
        longest = np.argmax([(v * v).sum(axis=2) for v in shifted], axis=0)
        vectors = np.take_along_axis(np.array(shifted), longest[None, :, :, None], 0)[0]
    return vectors


def blurred(light, vectors):
    rows, columns = np.indices(light.shape[:2])
    length, far = np.linalg.norm(vectors, axis=2), widest(vectors)
    total, reach = np.zeros_like(light), np.linalg.norm(far, axis=2)
    for share in np.linspace(-0.5, 0.5, SAMPLES):
        x = np.clip(np.rint(columns - share * far[..., 0]), 0, SIZE[0] - 1).astype(int)
        y = np.clip(np.rint(rows - share * far[..., 1]), 0, SIZE[1] - 1).astype(int)
        passes = np.maximum(length, length[y, x]) >= 2 * abs(share) * reach
        total += np.where(passes[..., None], light[y, x], light)
    return total / SAMPLES


folder = output_folder(__doc__)
options = {"voxel_size": 0.03, "particle_spacing": 0.1, "compute_velocity": True}
frames = active.frames(DATA, **options)
*_, (_, skin) = (frame for _, frame in zip(range(STEP + 1), frames))
held = vtk_to_numpy(skin.GetPoints().GetData())
studio = scene.Scene(held, SIZE, soft=False)
studio.show(skin)
render.write_exr(studio.window, folder / "motion_blur.exr", frame_duration=1 / 25)

reader = vtkActiveEXRReader()
reader.SetFileName(str(folder / "motion_blur.exr"))
reader.Update()
layers = reader.GetOutput().GetPointData()
light, vectors = (
    vtk_to_numpy(layers.GetArray(name)).reshape(SIZE[1], SIZE[0], -1).astype(np.float32)
    for name in ("RGBA", "forward")
)
light = np.concatenate([light, blurred(light, vectors)], axis=1)[..., :3].clip(0, 1)
pixels = np.rint(255 * light ** (1 / 2.2)).astype(np.uint8)
write_pixels(folder / "motion_blur.png", pixels)
print(f"up to {np.linalg.norm(vectors, axis=2).max():.0f} pixels of motion")
