"""Dependency of a wheel on its VTK, which the environment variable ACTIVE_VTK chooses.

scikit-build-core calls dynamic_metadata() when it writes the wheel's metadata; see pyproject.toml.
"""

import os
from importlib.metadata import version

# By value of ACTIVE_VTK: the distribution with the SDK, and the one with the libraries.
SDKS = {"cvista": ("cvista-sdk", "cvista[all]"), "sdk": ("vtk-sdk", "vtk")}


def dynamic_metadata(settings, project):
    choice = os.environ.get("ACTIVE_VTK", "cvista")
    if choice == "system":
        return {}
    if choice not in SDKS:
        raise ValueError(f"ACTIVE_VTK has to be cvista, sdk or system, not {choice!r}.")
    sdk, libraries = SDKS[choice]
    return {"dependencies": [f"{libraries}=={version(sdk)}"]}  # C++ libraries fit one version only
