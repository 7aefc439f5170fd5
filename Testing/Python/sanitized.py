"""Whether the address sanitizer watches: programs are slower, and use terabytes of addresses."""

import ctypes
import resource

IS_SANITIZED = hasattr(ctypes.CDLL(None), "__asan_init")
SLOWNESS = 10 if IS_SANITIZED else 1


def limit_memory(most):
    """Of addresses [bytes]."""
    if not IS_SANITIZED:
        resource.setrlimit(resource.RLIMIT_AS, (most, most))
