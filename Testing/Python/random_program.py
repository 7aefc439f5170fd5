"""Tries the cases on its standard input, one to a line, and tells of each what was found.

It has two gigabytes, and for each case 20 seconds of the processor's time, whatever the machine
does meanwhile.
"""

import resource
import sys
import traceback
from ast import literal_eval

from random_checks import check

MEMORY = 2 << 30  # bytes of address space
SECONDS = 20


def allow_a_case():
    used = resource.getrusage(resource.RUSAGE_SELF)
    limit = int(used.ru_utime + used.ru_stime) + SECONDS
    resource.setrlimit(resource.RLIMIT_CPU, (limit, resource.RLIM_INFINITY))


def outcome(case):
    """What failed, or nothing, and what was counted."""
    try:
        return "", check(case)
    except AssertionError as failure:
        return str(failure) or traceback.format_exc(), {}
    except Exception:
        return traceback.format_exc().replace("Traceback", "Exception", 1), {}


def main():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    for line in sys.stdin:
        allow_a_case()
        print("> " + repr(outcome(literal_eval(line))), flush=True)


if __name__ == "__main__":
    main()
