"""Tries the cases on its standard input, one on each line, and prints the result of each.

The program has two gigabytes of address space, and for each case 120 seconds of processor time,
which is independent of other load. With the address sanitizer, memory is not limited, and the time
is longer.
"""

import resource
import sys
import traceback
from ast import literal_eval

from random_checks import check
from sanitized import SLOWNESS, limit_memory

MEMORY = 2 << 30  # bytes of address space
# With NormalizeTarget off and AreaControl EXACT, a case can need 45 seconds.
SECONDS = 120 * SLOWNESS


def allow_a_case():
    used = resource.getrusage(resource.RUSAGE_SELF)
    limit = int(used.ru_utime + used.ru_stime) + SECONDS
    resource.setrlimit(resource.RLIMIT_CPU, (limit, resource.RLIM_INFINITY))


def outcome(case):
    """Failure, or an empty text, and counts."""
    try:
        return "", check(case)
    except AssertionError as failure:
        return str(failure) or traceback.format_exc(), {}
    except Exception:
        return traceback.format_exc().replace("Traceback", "Exception", 1), {}


def main():
    limit_memory(MEMORY)
    for line in sys.stdin:
        allow_a_case()
        print("> " + repr(outcome(literal_eval(line))), flush=True)


if __name__ == "__main__":
    main()
