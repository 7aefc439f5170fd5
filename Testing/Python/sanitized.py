"""Whether the address sanitizer watches: programs are slower, and use terabytes of addresses."""

import ctypes
import os
import resource

IS_SANITIZED = hasattr(ctypes.CDLL(None), "__asan_init")
# As the preset says; counters of lines are slow too.
SLOWNESS = int(os.environ.get("ACTIVE_TEST_SLOWNESS", "1"))


def limit_memory(most):
    """Of addresses [bytes]."""
    if not IS_SANITIZED:
        resource.setrlimit(resource.RLIMIT_AS, (most, most))
