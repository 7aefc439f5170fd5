"""Checks that Python finds the VTK that this package was built with.

Two copies of VTK crash a process without an exception, so the check runs before the compiled
libraries load.
"""

import ctypes
import importlib
import os
import sys

# Written by CMake when it copies this file into the build folder.
VERSION = "@VTK_VERSION@"
LIBRARY = "@vtk_library@"  # file name of VTK's library in the compiled libraries, or empty
PACKAGE = "@vtk_package@"  # vtkmodules, or cvista: a build of VTK that PyVista can use
BUILT_FOR = "@built_for@"


def is_loaded(library: str) -> bool:
    """Returns True if a library of this ELF name is loaded, or if this cannot be found out."""
    if not library or not hasattr(os, "RTLD_NOLOAD"):
        return True  # static VTK, or no ELF: only the version is checked
    try:
        ctypes.CDLL(library, mode=os.RTLD_NOLOAD | os.RTLD_LAZY)
    except OSError:
        return False
    return True


def refuse_another() -> None:
    """Raises ImportError if the process has loaded VTK from another package, as PyVista may."""
    for name in tuple(sys.modules):
        root, _, rest = name.partition(".")
        if rest == "vtkCommonCore" and root != PACKAGE and not PACKAGE.startswith("@"):
            raise ImportError(
                f"active_implicit_surfaces was built with the VTK of the package {PACKAGE}, but "
                f"this program has loaded that of {root}; a program cannot have both. Import VTK "
                f"from {PACKAGE} only. For PyVista, set the environment variable "
                f"PYVISTA_VTK_BACKEND to {backend_of(PACKAGE)} "
                f"(it is {os.environ.get('PYVISTA_VTK_BACKEND', 'not set')}) before PyVista is "
                "imported."
            )


def check() -> None:
    """Raises ImportError unless Python finds the VTK that the package was built with."""
    if VERSION.startswith("@"):
        return  # source folder without libraries
    core = importlib.import_module(f"{PACKAGE}.vtkCommonCore")
    found: str = core.vtkVersion.GetVTKVersion()
    if found.split(".")[:2] == VERSION.split(".")[:2] and is_loaded(LIBRARY):
        return
    raise ImportError(
        f"active_implicit_surfaces was built with VTK {VERSION}, for {BUILT_FOR}, but this Python "
        f"finds another VTK, {found}, in {os.path.dirname(core.__file__ or '')}; one program "
        "cannot have both. Remove that VTK from the environment (if it is from PyPI: pip uninstall "
        f"{backend_of(PACKAGE)}), so that the VTK of the build is found, or build "
        "active_implicit_surfaces with that VTK."
    )


def backend_of(package: str) -> str:
    """Returns PyVista's name for the VTK of a Python package; PyPI has VTK by the same name."""
    return package.removesuffix("modules")
