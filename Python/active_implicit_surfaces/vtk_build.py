"""Which VTK this package was built with, and whether Python has found the same one.

Two copies of VTK in one process end it, without an exception. So this is asked before the compiled
libraries load.
"""

import ctypes
import os

from vtkmodules import vtkCommonCore

# Written by CMake when it copies this file into the build folder.
VERSION = "@VTK_VERSION@"
LIBRARY = "@vtk_library@"  # the name by which the compiled libraries ask for it; or empty
PYTHON = "@Python3_EXECUTABLE@"


def is_loaded(library):
    """Whether the process has a library of this name, in the ELF sense: then it is used again."""
    if not library or not hasattr(os, "RTLD_NOLOAD"):
        return True  # a static VTK, or a system without such names: the version has to do
    try:
        ctypes.CDLL(library, mode=os.RTLD_NOLOAD | os.RTLD_LAZY)
    except OSError:
        return False
    return True


def check():
    """An ImportError unless vtkmodules is of the VTK that the package was built with."""
    if VERSION.startswith("@"):
        return  # this is the source folder, where no library is: what is said of that holds
    found = vtkCommonCore.vtkVersion.GetVTKVersion()
    if found.split(".")[:2] == VERSION.split(".")[:2] and is_loaded(LIBRARY):
        return
    raise ImportError(
        f"active_implicit_surfaces was built with VTK {VERSION}, for {PYTHON}, but this Python "
        f"finds another VTK, {found}, in {os.path.dirname(vtkCommonCore.__file__)}; one program "
        "cannot have both. Remove that VTK from the environment (if it is from PyPI: pip uninstall "
        "vtk), so that the one of the build is found, or build active_implicit_surfaces with it."
    )
