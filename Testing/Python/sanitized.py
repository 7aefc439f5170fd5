"""Detects the address sanitizer, which slows programs down and uses terabytes of addresses."""

import ctypes
import os
import resource

IS_SANITIZED = hasattr(ctypes.CDLL(None), "__asan_init")
# Set by the presets with sanitizers, and by the preset coverage, whose line counters are slow too.
SLOWNESS = int(os.environ.get("ACTIVE_TEST_SLOWNESS", "1"))


def limit_memory(most):
    """Limits the address space [bytes]."""
    if not IS_SANITIZED:
        resource.setrlimit(resource.RLIMIT_AS, (most, most))
