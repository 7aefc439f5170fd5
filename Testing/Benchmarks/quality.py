"""Quality of a skin over particles: size, flatness, drops, sheets, lag, flicker, births; prints a
table.

Run: python3 quality.py [--scenes pool,splash,...] [--voxel 1,0.5] [--size 8000]
         [--config "name: Property=value ..."] ... [--label name] [--set Property=value ...]
         [--scene-folder FOLDER] [--pictures FOLDER]

Each --config is a column: the filter after Set<Property>(value), with the voxel size and the ids,
times in seconds. A value is a number, in particle radii if it ends in r (3.4r), in their squares if
in r2. --set and --label add one column. By default, the columns are the filter's defaults and the
configuration KernelRadius=3.4r ParticleThreshold=0.7 Attraction=100. The next column has the
figures of commit b67f7a4, for voxels of r and with seconds measured at another time. If
pysplashsurf is installed, two columns have splashsurf with the settings that its README recommends,
with and without its cleanup of the mesh ("no cleanup").

All makers make each frame in turns, at voxels of one particle radius r and then of 0.5 r. "speed
over" is the ratio of the medians of seconds: above 1 the column is faster.

The scenes are those of Examples/Python/fluid_scenes.py. r is half of the particles' spacing. "rest"
is the volume N (2 r)^3 and the height of this volume in the box:

- flatness (pool): angle of the top's triangles to the mean normal of those within 3 r, by area,
  more than 4 r from the walls; height over rest of the top;
- drops kept (pool): fraction of the single and paired particles above the pool that are inside;
  isolated (splash, dam): those with at most two neighbours within 3.2 r;
- sheet: fraction of the layer's cells whose middle is inside, weighted by their longest side, for
  whole cells (sides up to 2.6 r) and torn ones (a side beyond 4 r, which should give 0);
- lag (ball): distance of the centre of the skin's volume behind that of the particles;
- flicker: second difference in time of the top's height over fixed columns; for slosh it includes
  the water's own acceleration, which is the same for all makers;
- births (fountain, rain): frames until a new particle is inside; in rain also the volume of a new
  drop's skin in its first frame, relative to that four frames later.

--pictures renders a frame of each scene, columns side by side (needs a display, as of `bash
Testing/with_display`). Scenes are made at their first use, which takes minutes.
"""

import argparse
import statistics
import sys
import tempfile
from pathlib import Path

import b67f7a4

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "Examples" / "Python"))
from fluid_scenes import load_scene  # noqa: E402
from skin_geometry import Skin  # noqa: E402
from skin_makers import SplashSurf, living_skin, numbers, splash_surfs  # noqa: E402
from skin_measures import MEASURES  # noqa: E402
from vtkmodules.vtkCommonCore import vtkLogger  # noqa: E402

PICTURED = {"pool": 11, "splash": 10, "dam": 14, "fountain": 32, "rain": 24, "sheet": 15}
VIEW = (0.4, 0.5, 1.0)
SECONDS = "seconds per frame"
COMMON = [
    "defaults:",
    "kernels: KernelRadius=3.4r ParticleThreshold=0.7 Attraction=100",
]


def arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--scenes", default=",".join(MEASURES))
    parser.add_argument("--voxel", type=numbers, default="1,0.5", help="in particle radii")
    parser.add_argument("--size", type=int, default=8000, help="particles of the splash")
    parser.add_argument("--config", action="append", default=[])
    parser.add_argument("--label", default="set")
    parser.add_argument("--set", action="extend", nargs="+", default=[])
    parser.add_argument("--scene-folder", type=Path)
    parser.add_argument("--pictures", type=Path)
    chosen = parser.parse_args()
    chosen.scenes = chosen.scenes.split(",")
    if unknown := [name for name in chosen.scenes if name not in MEASURES]:
        parser.error(f"no scene {', '.join(unknown)}; there are {', '.join(MEASURES)}")
    if chosen.set:
        chosen.config.append(f"{chosen.label}: {' '.join(chosen.set)}")
    return chosen


def before(name, voxel):
    """Figures of b67f7a4."""
    if voxel != 1:
        return {}
    own, theirs = b67f7a4.SECONDS[name]
    speed = {SECONDS: own, "speed over splashsurf": theirs / own}
    return b67f7a4.QUALITY.get(name, {}) | speed


def measure(name, scene, makers, voxel):
    frames = zip(*(maker.make(scene, voxel) for maker in makers), strict=True)  # in turns
    columns, skins = [], []
    for results in zip(*frames, strict=True):
        skins.append([skin for skin, _ in results])
        columns.append(MEASURES[name](scene, [Skin(skin) for skin in skins[-1]], voxel))
        columns[-1][SECONDS] = statistics.median(seconds for _, seconds in results[1:])
    for maker, theirs in zip(makers, columns, strict=True):
        if isinstance(maker, SplashSurf):
            for column in columns:
                column[f"speed over {maker.name}"] = theirs[SECONDS] / column[SECONDS]
    return columns, skins


def tell(name, columns):
    for figure in columns[0]:
        values = "".join(
            f"{column[figure]:15.3f}" if figure in column else f"{'-':>15}" for column in columns
        )
        print(f"{name:9} {figure:38}{values}", flush=True)


def write_picture(folder, name, skins):
    from film_strip import skin_actor, write_film_strip

    folder.mkdir(parents=True, exist_ok=True)
    shown = [[skin_actor(skin)] for skin in skins if skin.GetNumberOfPolys()]
    if shown:
        write_film_strip(folder / f"{name}.png", shown, view=VIEW, width=1000 * len(shown))


def load_scenes(chosen):
    folder = chosen.scene_folder or Path(tempfile.gettempdir()) / "fluid_scenes"
    sizes = {"splash": {"size_of": chosen.size}}
    return {name: load_scene(name, folder, **sizes.get(name, {})) for name in chosen.scenes}


def main():
    chosen = arguments()
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_ERROR)  # warnings would tear the table
    ours = [living_skin(config) for config in chosen.config or COMMON]
    makers = [*ours, *splash_surfs()]
    if makers == ours:
        print("splashsurf: left out, as it is not installed (pip install pysplashsurf)")
    heads = [maker.name[:14] for maker in makers]
    heads.insert(len(ours), "b67f7a4")
    scenes = load_scenes(chosen)
    for factor in chosen.voxel:
        print(f"{f'voxel {factor:g} r':48}" + "".join(f"{head:>15}" for head in heads))
        for name, scene in scenes.items():
            columns, skins = measure(name, scene, makers, factor * 0.5 * scene.spacing)
            columns.insert(len(ours), before(name, factor))
            tell(name, columns)
            if chosen.pictures and name in PICTURED:
                shown = [frames[min(PICTURED[name], len(frames) - 1)] for frames in skins]
                write_picture(chosen.pictures, f"{name}_{factor:g}r", shown)
    if chosen.pictures:
        print(f"pictures, in the columns' order without empty skins: {chosen.pictures}")


if __name__ == "__main__":
    main()
