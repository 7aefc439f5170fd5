"""Distance of a skin over moving particles from that of a converged run, frame by frame.

Run: python3 converged.py [--scenes pool,slosh,splash,...] [--size N] [--every N]
                          [--config "name: Property=value ..."] ...

The converged run makes explicit substeps with a CFL of 0.1, with default values of all other
properties. The other runs differ from the defaults by their own properties. Columns, over all
frames after the first four: mean and 99th percentile of the distances from every fifth vertex of a
run to the converged skin [voxels], and number of frames in which the two skins have different
numbers of parts. The last column is the median of seconds per frame, without the first frame.
Voxels are one particle radius. Scenes are those of quality.py. Needs minutes for each scene.
"""

import argparse
import statistics
import sys
import tempfile
from pathlib import Path

import numpy as np
from skin_makers import living_skin
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLogger
from vtkmodules.vtkFiltersCore import vtkImplicitPolyDataDistance

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "Examples" / "Python"))
from fluid_scenes import load_scene  # noqa: E402
from real_measures import pieces_of  # noqa: E402

FIRST = 4
EVERY = 5  # step through the vertices
CONVERGED = "converged: TimeIntegration=0 CFL=0.1"
CONFIGS = ["default:", "half as long: CFL=0.5", "explicit: TimeIntegration=0"]


def arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--scenes", default="pool,slosh,ball,sheet,rain,fountain,splash,dam")
    parser.add_argument("--size", type=int, default=2000, help="particles of the splash")
    parser.add_argument("--every", type=int, default=1, help="of the frames: all goes faster")
    parser.add_argument("--config", action="append", default=[])
    parser.add_argument("--scene-folder", type=Path)
    return parser.parse_args()


def distances(skin, converged):
    if 0 in (skin.GetNumberOfPolys(), converged.GetNumberOfPolys()):
        return []
    distance = vtkImplicitPolyDataDistance()
    distance.SetInput(converged)
    points = vtk_to_numpy(skin.GetPoints().GetData())[::EVERY]
    return [abs(distance.EvaluateFunction(x)) for x in points.astype(float)]


def measure(scene, config, converged):
    voxel = 0.5 * scene.spacing
    far, others, seconds = [], 0, []
    for frame, (skin, cost) in enumerate(living_skin(config).make(scene, voxel)):
        seconds.append(cost)
        if frame >= FIRST:
            far += distances(skin, converged[frame])
            others += pieces_of(skin) != pieces_of(converged[frame])
    far = np.array(far) / voxel
    return far.mean(), np.percentile(far, 99), others, statistics.median(seconds[1:])


def main():
    chosen = arguments()
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_ERROR)  # warnings would tear the table
    folder = chosen.scene_folder or Path(tempfile.gettempdir()) / "fluid_scenes"
    print(f"{'':26}{'mean':>8}{'p99':>8}{'other parts':>13}{'seconds':>9}")
    for name in chosen.scenes.split(","):
        options = {"size_of": chosen.size} if name == "splash" else {}
        scene = load_scene(name, folder, **options)
        scene.frames = scene.frames[:: chosen.every]
        converged = [skin for skin, _ in living_skin(CONVERGED).make(scene, 0.5 * scene.spacing)]
        for config in chosen.config or CONFIGS:
            mean, p99, others, seconds = measure(scene, config, converged)
            label = f"{name}, {config.partition(':')[0]}"
            print(f"{label:26}{mean:8.3f}{p99:8.2f}{others:13}{seconds:9.3f}", flush=True)


if __name__ == "__main__":
    main()
