"""Compares a picture of a skin with its baseline: -V <baseline.png> -T <folder for differences>.

The comparison ignores smooth differences, so the skin is shown in flat, hard-edged bands of color,
chosen by one component of its normals. To renew a baseline: view the picture that the failed test
leaves in the folder, and copy it over the baseline.
"""

import sys

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow
from vtkmodules.vtkTestingRendering import vtkTesting

# The number of bands is odd, so that no two bands meet at 0, the value of flat parts.
BANDS = (
    (0.10, 0.10, 0.35),
    (0.90, 0.45, 0.10),
    (0.15, 0.55, 0.30),
    (0.95, 0.90, 0.55),
    (0.55, 0.10, 0.30),
    (0.35, 0.75, 0.95),
    (0.95, 0.60, 0.75),
)
MAXIMUM_ERROR = 10.0  # in units of a completely different pixel; the picture has 640 000


def same_as_baseline(skin, view, component):
    """Returns 0 if the skin, seen from the direction `view`, matches the baseline, else 1."""
    window = _window_with(_banded_actor(skin, component), view)
    window.Render()
    testing = vtkTesting()
    for argument in sys.argv[1:]:
        testing.AddArgument(argument)
    testing.SetRenderWindow(window)
    return 0 if testing.RegressionTest(MAXIMUM_ERROR) == vtkTesting.PASSED else 1


def _banded_actor(skin, component):
    colors = vtkLookupTable()
    colors.SetNumberOfTableValues(len(BANDS))
    for band, color in enumerate(BANDS):
        colors.SetTableValue(band, *color)
    colors.SetVectorModeToComponent()
    colors.SetVectorComponent(component)
    colors.SetTableRange(-1.0, 1.0)
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(skin)
    mapper.SetLookupTable(colors)
    mapper.UseLookupTableScalarRangeOn()
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("Normals")
    mapper.InterpolateScalarsBeforeMappingOn()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().LightingOff()
    return actor


def _window_with(actor, view):
    renderer = vtkRenderer()
    renderer.SetBackground(1.0, 1.0, 1.0)
    renderer.AddActor(actor)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(view)
    renderer.ResetCamera()
    camera.Zoom(1.2)
    window = vtkRenderWindow()
    window.SetMultiSamples(0)
    window.SetSize(800, 800)
    window.AddRenderer(renderer)
    return window
