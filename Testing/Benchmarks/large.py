"""Seconds per frame and memory over many particles, for the filter's defaults and for
pysplashsurf.

Run: python3 large.py [--voxel 1,0.5] [<particles> ...]   (default: 250000 1000000 4000000)

The scene is a pool half as deep as wide, without walls, under waves as high as a tenth of its
width. Its particles are 2 r apart, with random displacements whose standard deviation along each
axis is an eighth of that. The filter gets the spacing, the voxels and the ids. splashsurf has the
settings of quality.py, with and without its cleanup of the mesh ("no cleanup"). Each maker has a
separate process, and the makers make each frame in turns; frames after the first one count. "over
splashsurf" is the ratio of the medians of seconds: above 1 the row is faster. Memory is the peak of
a maker, less its memory after the particles were made, over their number. The row b67f7a4 has the
figures of that commit, measured at another time.

Needs one to two minutes per million particles at voxels of r, two to four at 0.5 r, and up to 6 kB
per particle.
"""

import argparse
import contextlib
import resource
import statistics
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import b67f7a4
import numpy
from skin_makers import LivingSkin, numbers, splash_surfs

FRAMES = 4
R = 1.0


def pool(particles):
    across = round((2 * particles) ** (1 / 3))
    deep = across // 2
    places = numpy.stack(
        numpy.meshgrid(*map(numpy.arange, (across, across, deep)), indexing="ij"), axis=-1
    ).reshape(-1, 3)
    rest = 2 * R * (places + numpy.random.default_rng(1).normal(0, 0.125, places.shape))
    wave_number = 2 * numpy.pi / (2 * R * across)
    frames = []
    for frame in range(FRAMES):
        waves = numpy.sin(2 * wave_number * rest[:, 0] - 0.35 * frame)
        waves += numpy.cos(wave_number * rest[:, 1] - 0.25 * frame)
        rise = numpy.zeros_like(rest)
        rise[:, 2] = rest[:, 2] * 0.05 * (across / deep) * waves
        frames.append(((rest + rise).astype(numpy.float32), None, numpy.arange(len(rest))))
    return SimpleNamespace(frames=frames, spacing=2 * R)


def all_makers():
    return [LivingSkin("defaults", [("ParticleSpacing", "2r")]), *splash_surfs()]


def begin_peak():
    """Resets the peak of this process's memory; returns the bytes that it has now."""
    Path("/proc/self/clear_refs").write_text("5")
    return peak()


def peak():
    """Most bytes that this process has had since begin_peak."""
    return 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def make_when_asked(name, particles, voxel):
    """Makes a frame for each line of input. Prints the number of particles, the seconds, and the
    peak so far of bytes per particle."""
    (maker,) = [maker for maker in all_makers() if maker.name == name]
    scene = pool(particles)
    begun, count = begin_peak(), len(scene.frames[0][0])
    frames = maker.make(scene, voxel)
    for _ in sys.stdin:
        _, seconds = next(frames)
        print(count, seconds, (peak() - begun) / count, flush=True)


def begin(name, particles, voxel):
    command = [sys.executable, __file__, str(particles), "--voxel", str(voxel), "--one", name]
    return subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)


def ask(process):
    process.stdin.write("\n")
    process.stdin.flush()
    line = process.stdout.readline()
    if not line:
        sys.exit("one of the makers ended")
    return [float(figure) for figure in line.split()]


def measure(names, particles, voxel):
    """Number of particles, and for each maker its seconds per frame and bytes per particle."""
    lines = {name: [] for name in names}
    with contextlib.ExitStack() as stack:
        processes = {name: stack.enter_context(begin(name, particles, voxel)) for name in names}
        for _ in range(FRAMES):
            for name, process in processes.items():
                lines[name].append(ask(process))
    rows = {
        name: (statistics.median(seconds for _, seconds, _ in frames[1:]), frames[-1][2])
        for name, frames in lines.items()
    }
    return int(lines[names[0]][0][0]), rows


def tell(head, rows, references):
    """Prints rows; `references` are the seconds of the makers to compare each row with."""
    for name, (seconds, size) in rows.items():
        line = f"{head} {name:>12} {seconds:8.2f} {size:15.0f}"
        print(line + "".join(f"{theirs / seconds:17.2f}" for theirs in references), flush=True)


def arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("particles", nargs="*", type=int, default=[250_000, 1_000_000, 4_000_000])
    parser.add_argument("--voxel", type=numbers, default="1,0.5", help="in r")
    parser.add_argument("--one", help=argparse.SUPPRESS)
    return parser.parse_args()


def main():
    chosen = arguments()
    if chosen.one:
        make_when_asked(chosen.one, chosen.particles[0], chosen.voxel[0] * R)
        return
    names = [maker.name for maker in all_makers()]
    print(
        f"{'particles':>12} {'voxel':>6} {'maker':>12} {'s/frame':>8} {'bytes/particle':>15}"
        + "".join(f"{'over ' + name:>17}" for name in names[1:])
    )
    for voxel in chosen.voxel:
        for particles in chosen.particles:
            count, rows = measure(names, particles, voxel)
            head = f"{count:12,} {voxel:4g} r"
            tell(head, rows, [rows[name][0] for name in names[1:]])
            if voxel == 1 and particles in b67f7a4.LARGE:
                own, theirs = b67f7a4.LARGE[particles]
                tell(head, {"b67f7a4": own}, [theirs[0]])


if __name__ == "__main__":
    main()
