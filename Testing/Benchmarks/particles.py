"""Time per frame of a smoothed skin over moving particles, compared with pysplashsurf and
OpenVDB.

Run: python3 particles.py quick|full <threads> <path of ParticlesToLevelSet>

Scenes: the splash in Testing/Data (992 particles), and pools of 25,600 and 250,000 particles under
waves. All particles have the radius r = 0.05 and are 2 r apart, 25 frames a second; voxel = 1, 0.75
and 0.5 r. All makers make the same frames in turns, and each ratio is of two times for the same
frame:

- frame: vtkActiveImplicitSurface with the voxel size, the spacing and otherwise its defaults;
  triangles with normals. The first frame, the start, is reported separately, as later frames
  continue from it.
- pysplashsurf (PyPI): its recommended smoothing, 25 weighted iterations, with normals, without the
  optional mesh cleanup.
- OpenVDB: ParticlesToLevelSet with spheres of 2 r, which close the gaps, four smoothing steps,
  volumeToMesh, without normals; in a process of its own (ParticlesToLevelSet.cxx).

For the cost of a steady frame, a frame of the splash is repeated eleven times after the start: the
last three times count.

Times are processor times with one thread, else wall times. quick omits the large pool, and the fine
voxels of the smaller one. Lines and JSON are as in Measuring.h.
"""

import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SIZE, THREADS, OPENVDB = sys.argv[1], int(sys.argv[2]), sys.argv[3]
# Set before any thread starts.
os.environ["RAYON_NUM_THREADS"] = os.environ["VTK_SMP_MAX_THREADS"] = str(THREADS)
if THREADS == 1:
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "Examples" / "Python"))
import numpy  # noqa: E402
from active_implicit_surfaces import vtkActiveImplicitSurface  # noqa: E402
from particle_series import ParticleSeries  # noqa: E402
from skin_makers import RECOMMENDED, pysplashsurf  # noqa: E402
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader  # noqa: E402

DATA = Path(__file__).resolve().parents[1] / "Data" / "sph_drop.vtp"
R = 0.05
FRAMES_PER_SECOND = 25


def splash(count):
    reader, frames = vtkXMLPolyDataReader(), []
    reader.SetFileName(str(DATA))
    for step in range(16, 16 + count):
        reader.UpdateTimeStep(step)
        frames.append(vtk_to_numpy(reader.GetOutput().GetPoints().GetData()).copy())
    return frames


def pool(across, deep, count):
    """Waves of deep water: each particle moves on a circle that shrinks with depth."""
    i, j, k = numpy.meshgrid(*map(numpy.arange, (across, across, deep)), indexing="ij")
    rest = 2 * R * numpy.stack([i, j, k - deep], axis=-1).reshape(-1, 3).astype(float)
    rest += numpy.random.default_rng(1).normal(0, 0.1 * R, rest.shape)
    wave_number = 2 * numpy.pi / (20 * 2 * R)
    frames = []
    for frame in range(count):
        phase = wave_number * (rest[:, 0] + 0.5 * rest[:, 1]) - 6.0 * frame / FRAMES_PER_SECOND
        height = 4 * R * numpy.exp(wave_number * rest[:, 2])
        offset = numpy.stack([-height * numpy.sin(phase), 0 * phase, height * numpy.cos(phase)])
        frames.append((rest + offset.T).astype(numpy.float32))
    return frames


def series_of(frames):
    return ParticleSeries([(frame,) for frame in frames], rate=1)


def make_skin(series, voxel):
    surface = vtkActiveImplicitSurface()
    surface.SetInputConnection(series.GetOutputPort())
    surface.SetTimeScale(1 / FRAMES_PER_SECOND)
    surface.SetVoxelSize(voxel)
    surface.SetParticleSpacing(2 * R)
    surface.SetNumberOfThreads(THREADS)
    return surface


def seconds_of(action):
    clock = time.process_time if THREADS == 1 else time.perf_counter
    began = clock()
    action()
    return clock() - began


def reconstruct(particles, voxel):
    settings = RECOMMENDED | {"mesh_cleanup": False, "normals_smoothing_iters": None}
    pysplashsurf.reconstruction_pipeline(
        particles,
        particle_radius=R,
        cube_size=voxel / R,
        multi_threading=THREADS > 1,
        **settings,
    )


def openvdb_seconds(program, folder, particles, voxel):
    path = Path(folder) / "positions"
    path.write_bytes(numpy.ascontiguousarray(particles, numpy.float32).tobytes())
    program.stdin.write(f"{path} {2 * R} {voxel}\n")
    program.stdin.flush()
    return float(program.stdout.readline().split()[0])


def tell(case, name, unit, costs):
    median, least, largest = statistics.median(costs), min(costs), max(costs)
    print(
        f"particles {case:28} {THREADS:2} thr  {name:44} "
        f"{median:9.4g} ({least:.4g} .. {largest:.4g}) {unit}",
        flush=True,
    )
    figure = {"part": "particles", "case": case, "threads": THREADS, "name": name, "unit": unit}
    figure |= {"median": median, "min": least, "max": largest}
    if "ACTIVE_BENCHMARK_RESULTS" in os.environ:
        with open(os.environ["ACTIVE_BENCHMARK_RESULTS"], "a") as file:
            file.write(json.dumps(figure) + "\n")


def compare(scene, frames, factor, program, folder):
    voxel, case = factor * R, f"{scene}, voxel {factor} r"
    skin = make_skin(series_of(frames), voxel)
    tell(case, "start", "s", [seconds_of(lambda: skin.UpdateTimeStep(0))])
    costs = {name: [] for name in ("frame", "pysplashsurf", "OpenVDB")}
    for step in range(1, len(frames)):
        costs["frame"].append(seconds_of(lambda step=step: skin.UpdateTimeStep(step)))
        if pysplashsurf:
            costs["pysplashsurf"].append(
                seconds_of(lambda step=step: reconstruct(frames[step], voxel))
            )
        costs["OpenVDB"].append(openvdb_seconds(program, folder, frames[step], voxel))
    for name, theirs in costs.items():
        if theirs:
            tell(case, name, "s", theirs)
    for name in ("pysplashsurf", "OpenVDB"):
        ratios = [theirs / own for theirs, own in zip(costs[name], costs["frame"])]
        if ratios:
            tell(case, f"frame over {name}", "x", ratios)


def hold_still(factor, count=12):
    surface = make_skin(series_of(splash(1) * count), factor * R)
    surface.UpdateTimeStep(0)
    costs = [seconds_of(lambda step=step: surface.UpdateTimeStep(step)) for step in range(1, count)]
    case = f"splash held still, voxel {factor} r"
    tell(case, "frame that settles", "s", costs[:3])
    tell(case, "frame at rest", "s", costs[-3:])


def main():
    if not pysplashsurf:
        print("pysplashsurf: left out, as it is not installed (pip install pysplashsurf)")
    quick = SIZE == "quick"
    with (
        tempfile.TemporaryDirectory() as folder,
        subprocess.Popen(
            [OPENVDB, str(THREADS)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        ) as program,
    ):
        for factor in (1, 0.75, 0.5):
            compare("splash", splash(4 if quick else 8), factor, program, folder)
            if factor == 1 or not quick:
                compare("25k", pool(40, 16, 3 if quick else 5), factor, program, folder)
            if not quick:
                compare("250k", pool(100, 25, 4), factor, program, folder)
        program.stdin.close()
    hold_still(0.5)


if __name__ == "__main__":
    main()
