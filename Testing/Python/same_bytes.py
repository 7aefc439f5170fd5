"""Table of the runs whose bytes must not change, and their common helpers."""

from active_implicit_surfaces import vtkActiveImplicitSurface
from contents import Contents, no_errors
from same_bytes_shapes import BOX
from shapes import with_properties
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkImplicitFunction

RUNS = {}  # by name: (group, function of a Contents)
THREADS = {"number": 0}  # of every surface; 0: all threads
VOXEL = 0.06
POINTS = vtkDataObject.FIELD_ASSOCIATION_POINTS


def run(group):
    """Registers a function as a run: it passes its results to its argument, a Contents."""

    def add(function):
        assert function.__name__ not in RUNS, function.__name__
        RUNS[function.__name__] = (group, function)
        return function

    return add


def hash_of(name):
    contents = Contents()
    RUNS[name][1](contents)
    return contents.hash()


def make(target=None, initial=None, arrays=None, **properties):
    """A surface from its target and initial shape (functions, data or algorithms), names of
    arrays by their indices, and properties by their names."""
    surface = vtkActiveImplicitSurface()
    surface.SetVoxelSize(VOXEL)
    surface.SetAttraction(4)
    surface.SetParticleModelToSum()  # older baselines use this model, and:
    surface.SetTimeIntegrationToExplicit()
    surface.CreatePartsOff()
    surface.SetNumberOfThreads(THREADS["number"])
    connect(surface, 0, surface.SetTargetFunction, target)
    connect(surface, 1, surface.SetInitialFunction, initial)
    if isinstance(target, vtkImplicitFunction):
        surface.SetModelBounds(BOX)
    for number, name in (arrays or {}).items():
        surface.SetInputArrayToProcess(number, int(number == 4), 0, POINTS, name)
    return with_properties(surface, properties)


def connect(surface, port, set_function, shape):
    if isinstance(shape, vtkDataObject):
        surface.SetInputDataObject(port, shape)
    elif isinstance(shape, vtkImplicitFunction):
        set_function(shape)
    elif shape is not None:
        surface.SetInputConnection(port, shape.GetOutputPort())


def follow(contents, surface, *times, may_be_empty=False):
    for time in times:
        with no_errors(surface):
            surface.UpdateTimeStep(time)
        contents.outputs(surface, may_be_empty)


def rest(contents, surface):
    surface.SetEvolutionModeToEquilibrium()
    with no_errors(surface):
        surface.Update()
    contents.outputs(surface)
