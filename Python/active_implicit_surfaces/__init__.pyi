# What the package holds, for type checkers. VTK's own classes have no complete annotations.
from typing import Any

from .api import frames as frames
from .api import skin as skin
from .histories import history as history
from .histories import plot_history as plot_history
from .live import LiveSurface as LiveSurface
from .messages import ActiveSurfaceWarning as ActiveSurfaceWarning
from .morphing import morph as morph
from .runner import Frame as Frame
from .series import ParticleSeries as ParticleSeries

__version__: str

vtkActiveEXRReader: Any
vtkActiveEXRWriter: Any
vtkActiveImplicitSurface: Any
vtkActiveVDBReader: Any
vtkActiveVDBWriter: Any
vtkGridPotential: Any
vtkSkeletonPotential: Any
