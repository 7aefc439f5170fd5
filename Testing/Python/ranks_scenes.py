"""The splash on ranks, and the runs that ranks_program.py knows."""

import numpy
from ranks import POINTS, Particles, at_random, make_surface
from scenes import DATA
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

RUNS = {}
STEPS = 7


def run(function):
    RUNS[function.__name__] = function
    return function


def splash_particles():
    """particles(step) of the splash, of which some are born and some die at each step."""
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(DATA / "sph_drop.vtp"))

    def particles(step):
        reader.UpdateTimeStep(5 * step)
        position = vtk_to_numpy(reader.GetOutput().GetPoints().GetData()).copy()
        ids = numpy.arange(len(position))
        lives = (ids % 11 != step) & ((ids % 7 < 5) | (ids % 7 + step > 8))
        heat = numpy.sin(ids + step)
        order = numpy.random.default_rng(step).permutation(ids[lives])
        return {"position": position[order], "id": ids[order], "heat": heat[order]}

    return particles


def make_splash(**others):
    source = Particles(STEPS, splash_particles(), at_random)
    properties = {
        "TimeScale": 1 / 5,
        "ParticleSpacing": 0.085,
        "ComputeVelocity": True,
        "TangentialVelocity": True,
        "PassTargetArrays": True,
        "OutputPotential": True,
        **others,
    }
    surface = make_surface(source, **properties)
    surface.SetInputArrayToProcess(1, 0, 0, POINTS, "id")
    return source, surface
