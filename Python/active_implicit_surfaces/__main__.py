"""python3 -m active_implicit_surfaces is active-surface."""

import sys

from .commands import main

if __name__ == "__main__":
    sys.exit(main())
