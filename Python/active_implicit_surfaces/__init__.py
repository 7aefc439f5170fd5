"""Active implicit surfaces: living skins over particles, skeletons and shapes, as VTK filters.

>>> from active_implicit_surfaces import vtkActiveImplicitSurface, vtkSkeletonPotential

`help(vtkActiveImplicitSurface)` shows every property with its unit, range and default.
"""

# Written by CMake when it copies this file into the build folder.
__version__ = "@PROJECT_VERSION@"

try:
    # The base classes must be known before the classes derived from them.
    import vtkmodules.vtkCommonDataModel
    import vtkmodules.vtkCommonExecutionModel  # noqa: F401
    import vtkmodules.vtkIOImage  # noqa: F401
except ImportError as error:
    raise ImportError(
        "active_implicit_surfaces needs VTK's Python modules for this Python; install them "
        f"(Debian: python3-vtk9, then run /usr/bin/python3). The cause was: {error}"
    ) from error

from . import vtk_build

vtk_build.check()

# Readers and writers are an option of the build.
_HAS_IO = "@ACTIVE_BUILD_IO@".upper() in ("1", "ON", "TRUE", "YES")

try:
    from .vtkActivePotentials import *
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
    vtkActiveEXRReader.RegisterWithFactory()  # so that vtkImageReader2Factory knows .exr
