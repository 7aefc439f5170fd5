"""Runs the splash with a limit of address space, a number of MiB above the use after its first
step. Prints the errors of step 3, and the hash of its skin without the limit.

Run: python3 memory_program.py <MiB> (test_limits.py does)
"""

import resource
import sys

from contents import Contents
from listener import Listener, sentence_of
from scenes import splash

PAGE = resource.getpagesize()


def limit_memory(more):
    with open("/proc/self/statm", encoding="ascii") as numbers:
        used = int(numbers.read().split()[0]) * PAGE
    resource.setrlimit(resource.RLIMIT_AS, (used + more, resource.RLIM_INFINITY))


def main():
    _, surface = splash()
    surface.SetVoxelSize(0.018)
    surface.SetNumberOfThreads(2)
    # Starts the threads now: glibc ends a program that has no memory for a thread's own variables.
    surface.UpdateTimeStep(0)
    listener = Listener(surface)
    limit_memory(int(float(sys.argv[1]) * 2**20))
    surface.UpdateTimeStep(3)
    said = [sentence_of(error) for error in listener.errors]
    resource.setrlimit(resource.RLIMIT_AS, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
    listener.forget()
    surface.UpdateTimeStep(3)
    contents = Contents()
    contents.outputs(surface)
    print(repr((said, listener.errors, contents.hash())))


if __name__ == "__main__":
    main()
