"""Functions for the examples: a picture of a surface at several times, and its history as text."""

import argparse
from pathlib import Path

from paraview import servermanager
from paraview.simple import (
    AssignViewToLayout,
    CreateLayout,
    CreateRenderView,
    ResetCamera,
    SaveScreenshot,
    Show,
)

SIZE = 400


def output_folder(description):
    """Creates and returns the folder that the option --output names."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--output", type=Path, default=Path("output"), metavar="DIR")
    folder = parser.parse_args().output
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def save_moments(surface, times, picture):
    """Saves one picture of several views side by side, each with the surface at its own time."""
    layout = CreateLayout("Moments")
    cell = 0
    for i, time in enumerate(times):
        view = CreateRenderView(ViewTime=time, UseCache=0, OrientationAxesVisibility=0)
        view.ViewSize = [SIZE, SIZE]
        AssignViewToLayout(view, layout, cell)
        left = len(times) - i
        cell = layout.SplitHorizontal(cell, 1 / left) + 1 if left > 1 else cell
        shown = Show(surface, view)
        shown.ColorArrayName = [None, ""]
        shown.DiffuseColor = [0.95, 0.66, 0.46]
        view.CameraPosition = [0.45, 0.45, 1.0]
        view.CameraFocalPoint = [0, 0, 0]
        ResetCamera(view)
        view.ViewTime = time
    SaveScreenshot(str(picture), layout, ImageResolution=[SIZE * len(times), SIZE])
    print(f"wrote {picture}")


def print_history(surface, column, every):
    """Prints every `every`th value of a column of the history, which is output port 2."""
    surface.UpdatePipeline(surface.TimestepValues[-1])
    table = servermanager.Fetch(surface, idx=2)
    for row in range(0, table.GetNumberOfRows(), every):
        time = table.GetValueByName(row, "Time").ToDouble()
        print(f"at {time:.1f}: {column} {table.GetValueByName(row, column).ToDouble():.3f}")
