"""The command line: `active-surface`, or `python3 -m active_implicit_surfaces`.

Exit codes: 0 success, 1 error of data or machine, 2 error of the command line, 130 interrupted.
"""

from __future__ import annotations

import functools
import importlib
import os
import sys
import warnings
from argparse import SUPPRESS
from collections.abc import Sequence

from .. import __version__
from ..messages import ActiveSurfaceWarning
from .options import Parser, add_help

COMMANDS = {
    "skin": "makes skins over particles or images, as files and films",
    "morph": "changes one shape into another",
    "info": "describes files: points, bounds, spacing, arrays, times",
    "convert": "converts skins, meshes, images and particles to other formats",
}


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs a command line and returns its exit code."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    try:
        return _run(given)
    except SystemExit as end:  # raised by argparse
        return int(end.code or 0)
    except KeyboardInterrupt:
        print("\nactive-surface: interrupted.", file=sys.stderr)
        return 130
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except (OSError, ValueError, TypeError, ImportError, MemoryError) as error:
        print(f"active-surface: {_sentence(error)}", file=sys.stderr)
        return 1


def _run(given: list[str]) -> int:
    listed = "\n".join(f"  {name:<9}{text}" for name, text in COMMANDS.items())
    parser = Parser(
        "active-surface",
        "COMMAND ...",
        "Makes moving surfaces (skins) over particles, and metamorphoses.\n\ncommands:\n" + listed,
        epilog="Run 'active-surface COMMAND --help' for the options of a command.",
    )
    add_help(parser)
    parser.add_argument("--version", action="version", version=f"active-surface {__version__}")
    parser.add_argument("command", nargs="?", choices=COMMANDS, metavar="COMMAND", help=SUPPRESS)
    if not given:
        parser.print_help()
        return 2
    command = parser.parse_args(given[:1]).command
    module = importlib.import_module("." + command, __name__)
    with warnings.catch_warnings():
        warnings.simplefilter("always", ActiveSurfaceWarning)
        # A warning is shown once, even if each frame causes it.
        show = functools.cache(_show_note)
        warnings.showwarning = lambda message, *_, **__: show(str(message))
        return int(module.run(given[1:]))


def _show_note(text: str) -> None:
    print(f"active-surface: note: {text}", file=sys.stderr)


def _sentence(error: BaseException) -> str:
    text = " ".join(str(error).split()) or type(error).__name__
    if isinstance(error, MemoryError):
        text = f"There is not enough memory ({text})."
    return text if text.endswith((".", "?", "!")) else text + "."
