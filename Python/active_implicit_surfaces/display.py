"""X display for pictures, if VTK needs a display: the user's, else a virtual display."""

from __future__ import annotations

import ctypes
import os
import shutil
import signal
import subprocess

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  makes the windows that draw
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkRenderingCore import vtkRenderWindow

_PR_SET_PDEATHSIG = 1  # of Linux's prctl


def vtk_version() -> tuple[int, ...]:
    """Returns VTK's version: (9, 1) for 9.1.0."""
    return tuple(int(part) for part in vtkVersion.GetVTKVersion().split(".")[:2])


def find_display() -> None:
    """Starts a virtual display if VTK needs a display to draw, and DISPLAY is not set.

    The display ends with the calling thread, so call find_display from a thread that stays alive.

    Raises OSError if the program Xvfb is missing, or does not start.
    """
    needs = vtk_version() < (9, 4) and "vtkXOpenGL" in vtkRenderWindow().GetClassName()
    if not needs or os.environ.get("DISPLAY"):
        return
    if shutil.which("Xvfb") is None:
        raise OSError(
            "Pictures need an X display: DISPLAY is not set, and the program Xvfb, a virtual "
            "display, is not on PATH; install it (Debian: xvfb)."
        )
    os.environ["DISPLAY"] = ":" + _start_server()


def _start_server() -> str:
    """Starts Xvfb and returns the display number that Xvfb has chosen."""
    # Without -noreset, Xvfb resets when the last window closes, and the next window fails.
    command = "Xvfb -displayfd 1 -screen 0 1280x1024x24 -noreset -nolisten tcp"
    server = subprocess.Popen(
        command.split(),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        start_new_session=True,  # Ctrl+C must not end Xvfb before the file is finished
        preexec_fn=_end_with_parent,
    )
    assert server.stdout is not None
    number = server.stdout.readline().decode().strip()
    if not number.isdigit():
        server.terminate()
        raise OSError("Pictures need an X display: set DISPLAY, because Xvfb does not start.")
    return number


def _end_with_parent() -> None:
    ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGTERM)
