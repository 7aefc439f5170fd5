"""Active implicit surfaces: moving surfaces ("skins") over particles, lines and shapes, in VTK.

>>> from active_implicit_surfaces import vtkActiveImplicitSurface, vtkSkeletonPotential

`help(vtkActiveImplicitSurface)` shows every property with its default and, if the property is a
number, its range and any unit. Functions and classes:

skin(particles)          the skin over one frame of particles
frames(series)           the skins over a series of particles, each from the previous skin
morph(a, b, duration)    the skins from one shape to another
LiveSurface              a skin that follows a simulation as it runs
ParticleSeries           particles or images over time, a source of a pipeline
history, plot_history    area, volume, pieces and events of a skin over time
"""

import importlib

# Written by CMake when it copies this file into the build folder.
__version__ = "@PROJECT_VERSION@"

from . import vtk_build

vtk_build.refuse_another()

try:
    # Base classes have to be imported before the classes derived from them.
    import vtkmodules.vtkCommonDataModel
    import vtkmodules.vtkCommonExecutionModel  # noqa: F401
    import vtkmodules.vtkIOImage  # noqa: F401
except ImportError as error:
    raise ImportError(
        "active_implicit_surfaces needs VTK's Python modules, vtkmodules, for this Python. Install "
        "the VTK that active_implicit_surfaces was built with: cvista by pip install "
        "'pyvista[cvista]', PyPI's VTK by pip install vtk, or Debian's VTK by apt install "
        f"python3-vtk9 (then run /usr/bin/python3). The cause was: {error}"
    ) from error

vtk_build.check()

# Readers and writers are an option of the build.
_HAS_IO = "@ACTIVE_BUILD_IO@".upper() in ("1", "ON", "TRUE", "YES")

try:
    from .vtkActiveShapes import *
    from .vtkActiveSurfaces import *

    if _HAS_IO:
        from .vtkActiveIO import *
        from .vtkActiveIO import vtkActiveEXRReader
except ImportError as error:
    raise ImportError(
        "active_implicit_surfaces found VTK, but its own compiled library does not load. Build and "
        "install the package with this Python (cmake -DPython3_EXECUTABLE=...), and import the "
        f"installed package, not the source folder. The cause was: {error}"
    ) from error

if _HAS_IO:
    vtkActiveEXRReader.RegisterWithFactory()  # vtkImageReader2Factory then knows .exr

# Modules of the Python functions and classes; unlike the VTK classes, these need numpy.
_FUNCTIONS = {
    "ActiveSurfaceWarning": "messages",
    "Frame": "runner",
    "LiveSurface": "live",
    "ParticleSeries": "series",
    "frames": "api",
    "history": "histories",
    "morph": "morphing",
    "plot_history": "histories",
    "skin": "api",
}


def __getattr__(name):
    if name not in _FUNCTIONS:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module("." + _FUNCTIONS[name], __name__), name)


def __dir__():
    return sorted([*globals(), *_FUNCTIONS])
