"""Runs the splash with a limit of address space, a number of MiB above the use before the task.
Tasks: "update" to step 3, "save" and "load" the state of step 3, "mesh" (vtkGridPotential).
Prints the errors of the task, of the same task without the limit, and the hash of the skin.

Run: python3 memory_program.py TASK MiB FILE (test_limits.py does)
"""

import resource
import sys

from active_implicit_surfaces import vtkGridPotential
from contents import Contents
from listener import Listener, sentence_of
from scenes import splash
from vtkmodules.vtkFiltersSources import vtkSphereSource

PAGE = resource.getpagesize()


def limit_memory(more):
    with open("/proc/self/statm", encoding="ascii") as numbers:
        used = int(numbers.read().split()[0]) * PAGE
    resource.setrlimit(resource.RLIMIT_AS, (used + more, resource.RLIM_INFINITY))


def fill_memory(room):
    """Allocates all memory except the given number of bytes, in small blocks that also fill what
    the program has freed. Returns the blocks as a linked list."""
    blocks = None
    try:
        while True:
            blocks = (bytes(512), blocks)
    except MemoryError:
        for _ in range(room // 512):
            blocks = blocks[1]
    return blocks


def ball_mesh():
    ball = vtkSphereSource()
    ball.SetThetaResolution(200)
    ball.SetPhiResolution(200)
    ball.Update()
    return ball.GetOutput()


def main():
    _, surface = splash()
    surface.SetVoxelSize(0.018)
    surface.SetNumberOfThreads(2)
    # Starts the threads before memory is limited: glibc ends a program that has no memory for a
    # thread's own variables.
    surface.UpdateTimeStep(0)
    task, more, file = sys.argv[1:]
    potential = vtkGridPotential()
    potential.SetInput(ball_mesh())

    def evaluate():
        potential.Modified()
        potential.EvaluateFunction(0, 0, 0)

    tasks = {
        "mesh": evaluate,
        "update": lambda: surface.UpdateTimeStep(3),
        "save": lambda: surface.SaveState(file),
        "load": lambda: surface.LoadState(file),
    }
    if task != "update":
        surface.UpdateTimeStep(3)
        surface.SaveState(file)
    listener = Listener(potential if task == "mesh" else surface)
    room = int(float(more) * 2**20)
    limit_memory(room)
    blocks = fill_memory(room) if task != "update" else None
    tasks[task]()
    del blocks
    said = [sentence_of(error) for error in listener.errors]
    resource.setrlimit(resource.RLIMIT_AS, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
    listener.forget()
    tasks[task]()
    surface.UpdateTimeStep(3)
    contents = Contents()
    contents.outputs(surface)
    print(repr((said, listener.errors, contents.hash())))


if __name__ == "__main__":
    main()
