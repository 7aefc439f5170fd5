"""Seconds per frame on ranks of MPI and on threads, over a pool of particles.

Run: python3 rank_speed.py [<particles>]     (default: 250000)

The pool is that of large.py. Each rank provides the particles of a slab and, if there are several
ranks, has one thread. Times are those of the slowest rank until it has its part of the skin: the
median of the frames after the first, and the first frame, which includes the start. Memory is the
peak of a rank, less its memory before the first skin, for the rank with the most.
"""

import argparse
import os
import statistics
import subprocess
import sys
import time
from pathlib import Path

import large
import numpy
from active_implicit_surfaces import LiveSurface

RUNS = [(1, 1), (1, 2), (2, 1), (4, 1), (16, 1)]  # ranks, threads


def find_ranks():
    """Returns the controller (VTK keeps no reference), allgather, rank, number of ranks."""
    from mpi4py import MPI  # it starts MPI
    from vtkmodules.vtkParallelCore import vtkMultiProcessController
    from vtkmodules.vtkParallelMPI import vtkMPIController

    controller = vtkMPIController()
    controller.Initialize()
    vtkMultiProcessController.SetGlobalController(controller)
    ranks = MPI.COMM_WORLD
    return controller, ranks.allgather, ranks.rank, ranks.size


def measure(particles, threads, is_parallel):
    controller, gather, rank, size = None, (lambda own: [own]), 0, 1
    if is_parallel:
        controller, gather, rank, size = find_ranks()
    live = LiveSurface(particle_spacing=2 * large.R, voxel_size=large.R, number_of_threads=threads)
    seconds, before = [], None
    for places, _, ids in large.pool(particles).frames:
        order = numpy.argsort(places[:, 0], kind="stable")
        own = numpy.sort(numpy.array_split(order, size)[rank])
        before = before or large.begin_peak()
        gather(None)  # all begin together
        start = time.perf_counter()
        live.advance(places[own], 1 / 25, ids=ids[own])
        seconds.append(max(gather(time.perf_counter() - start)))
    most = max(gather(large.peak() - before)) / 1e6
    if rank == 0:
        print("figures:", statistics.median(seconds[1:]), seconds[0], most)
    del controller


def run_one(ranks, threads, particles):
    program = [sys.executable, __file__, str(particles), "--threads", str(threads)]
    if ranks > 1:
        shell = Path(__file__).resolve().parents[1] / "with_ranks"
        program = ["bash", str(shell), str(ranks), *program, "--parallel"]
    environment = {**os.environ, "VTK_SMP_MAX_THREADS": str(threads)}
    told = subprocess.run(
        program, check=True, capture_output=True, text=True, env=environment
    ).stdout
    return [float(figure) for figure in told.split("figures:")[1].split()]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("particles", nargs="?", type=int, default=250_000)
    parser.add_argument("--threads", type=int, help=argparse.SUPPRESS)
    parser.add_argument("--parallel", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.threads:
        measure(options.particles, options.threads, options.parallel)
        return
    print(f"{options.particles:,} particles")
    heads = [f"{'ranks':>6} {'threads':>8}"]
    heads += [f"{name:>9} {ratio:>7}" for name, ratio in (("s/frame", "speed"), ("first", "speed"))]
    print(*heads, f"{'MB/rank':>9} {'share':>7}")
    alone = None
    for ranks, threads in RUNS:
        *seconds, most = run_one(ranks, threads, options.particles)
        alone = alone or [*seconds, most]
        speeds = "".join(
            f" {s:>9.2f} {a / s:>7.2f}" for a, s in zip(alone[:2], seconds, strict=True)
        )
        print(f"{ranks:>6} {threads:>8}{speeds} {most:>9.0f} {most / alone[-1]:>7.2f}", flush=True)


if __name__ == "__main__":
    main()
