"""Seconds a frame and memory over many particles, by the filter's defaults and by pysplashsurf.

Run: python3 large.py [<particles> ...]     (250,000 1,000,000 4,000,000 unless said)

A pool half as deep as wide, without walls, its particles 2 r apart and off their places by an
eighth of that, under waves as high as a tenth of its width. Voxels are one r; the filter is told
the spacing, the voxels and the ids. Frames after the first one count. Each maker runs in a process
of its own: memory is what it takes at the peak beyond what it has with the particles read, over
their number. splashsurf smooths as quality.py says. Takes a minute for each million particles, and
2 kB for each one.
"""

import resource
import statistics
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy
from skin_makers import LivingSkin, SplashSurf, pysplashsurf

FRAMES = 4
R = 1.0
MAKERS = {
    "ours": lambda: LivingSkin("defaults", [("ParticleSpacing", "2r")]),
    "splashsurf": SplashSurf,
}


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


def peak():
    return 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def measure(maker, particles):
    """Prints the number of particles, seconds a frame, and bytes for each particle."""
    scene = pool(particles)
    before = peak()
    seconds = [cost for _, cost in MAKERS[maker]().make(scene, R)]
    count = len(scene.frames[0][0])
    print(count, statistics.median(seconds[1:]), (peak() - before) / count)


def main():
    if len(sys.argv) == 4 and sys.argv[1] == "--one":
        measure(sys.argv[2], int(sys.argv[3]))
        return
    print(f"{'particles':>12} {'maker':>12} {'s/frame':>9} {'bytes/particle':>15}")
    for particles in map(int, sys.argv[1:] or ["250000", "1000000", "4000000"]):
        for maker in MAKERS:
            if maker == "splashsurf" and pysplashsurf is None:
                continue
            command = [sys.executable, Path(__file__), "--one", maker, str(particles)]
            told = subprocess.run(command, check=True, capture_output=True, text=True).stdout
            count, seconds, size = told.split()[-3:]
            print(
                f"{int(count):12,} {maker:>12} {float(seconds):9.2f} {float(size):15.0f}",
                flush=True,
            )


if __name__ == "__main__":
    main()
