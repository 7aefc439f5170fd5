"""Runs active-surface as python3 -m active_implicit_surfaces."""

import sys

from .commands import main

if __name__ == "__main__":
    sys.exit(main())
