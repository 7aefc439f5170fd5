"""The skin over the splash of 992 particles holds what the package promises, in all 41 steps.

Run: python3 test_splash.py
"""

import unittest

import numpy
from active_implicit_surfaces import vtkSkeletonPotential
from scenes import PARTICLE_RADIUS, PARTICLE_THRESHOLD, STEPS, VOXEL, splash
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D, vtkPolyDataConnectivityFilter
from vtkmodules.vtkFiltersCore import vtkImplicitPolyDataDistance
from vtkmodules.vtkImagingHybrid import vtkSampleFunction


def sides_of_triangles(skin):
    """From and to which point each side of each triangle runs, as one number each way."""
    triangles = vtk_to_numpy(skin.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    start = triangles.ravel().astype(numpy.int64)
    end = numpy.roll(triangles, -1, axis=1).ravel().astype(numpy.int64)
    count = skin.GetNumberOfPoints()
    return start * count + end, end * count + start


def is_closed_manifold_and_oriented(skin):
    """Each side occurs once, and once the other way: two triangles at each edge, turned alike."""
    there, back = sides_of_triangles(skin)
    unique = numpy.unique(there)
    return len(unique) == len(there) and numpy.array_equal(unique, numpy.sort(back))


def number_of_pieces(skin):
    pieces = vtkPolyDataConnectivityFilter()
    pieces.SetInputData(skin)
    pieces.SetExtractionModeToAllRegions()
    pieces.Update()
    return pieces.GetNumberOfExtractedRegions()


def surface_of(particles):
    """The particles' own surface at this moment, sampled on the same lattice as the skin."""
    potential = vtkSkeletonPotential()
    potential.SetInput(particles)
    potential.SetRadius(PARTICLE_RADIUS)
    potential.SetThreshold(PARTICLE_THRESHOLD)
    bounds = [0.0] * 6
    potential.GetSkeletonBounds(bounds)
    nodes = [(int(numpy.floor(a / VOXEL)), int(numpy.ceil(b / VOXEL))) for a, b in zip(bounds[::2], bounds[1::2])]
    samples = vtkSampleFunction()
    samples.SetImplicitFunction(potential)
    samples.SetModelBounds([VOXEL * end for pair in nodes for end in pair])
    samples.SetSampleDimensions([high - low + 1 for low, high in nodes])
    samples.ComputeNormalsOff()
    contour = vtkFlyingEdges3D()
    contour.SetInputConnection(samples.GetOutputPort())
    contour.SetValue(0, 0.0)
    contour.Update()
    return contour.GetOutput()


def distances(points, surface):
    distance = vtkImplicitPolyDataDistance()
    distance.SetInput(surface)
    values = vtkDoubleArray()
    distance.FunctionValue(points.GetPoints().GetData(), values)
    return numpy.abs(vtk_to_numpy(values))
