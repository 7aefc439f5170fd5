"""A knot in an image of thick slices, as a segmentation of a scan gives it, for labels.py."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals, vtkWindowedSincPolyDataFilter
from vtkmodules.vtkFiltersGeneral import vtkDiscreteMarchingCubes

SPACING = np.array([0.6, 0.6, 2.4])
RADIUS = 3.6


def distance_to_knot(points):
    """Returns the signed distance of points to the tube around a trefoil, negative inside."""
    t = np.linspace(0, 2 * np.pi, 600)
    knot = np.stack(
        [np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -1.4 * np.sin(3 * t)], -1
    )
    parts = np.array_split(points, max(1, len(points) // 20000))
    near = [np.min([((part - 7 * x) ** 2).sum(1) for x in knot], axis=0) for part in parts]
    return np.sqrt(np.concatenate(near)) - RADIUS


def make_label():
    """Returns an image, 1 in the knot and 0 elsewhere, and the volume of the pixels that are 1."""
    axes = [np.arange(-27, 27, side) for side in SPACING[:2]]
    axes.append(np.arange(-16, 16, SPACING[2]))
    z, y, x = np.meshgrid(*axes[::-1], indexing="ij")
    inside = distance_to_knot(np.stack([x, y, z], -1).reshape(-1, 3)) < 0
    image = vtkImageData()
    image.SetDimensions(*z.shape[::-1])
    image.SetSpacing(SPACING)
    image.SetOrigin([axis[0] for axis in axes])
    image.GetPointData().SetScalars(numpy_to_vtk(inside.astype("u1"), deep=True))
    return image, np.count_nonzero(inside) * SPACING.prod()


def smooth_by_sinc(image, label=1):
    cubes, sinc = vtkDiscreteMarchingCubes(), vtkWindowedSincPolyDataFilter()
    cubes.SetInputData(image)
    cubes.SetValue(0, label)
    sinc.SetInputConnection(cubes.GetOutputPort())
    sinc.SetNumberOfIterations(20)
    sinc.SetPassBand(0.1)
    sinc.NormalizeCoordinatesOn()
    normals = vtkPolyDataNormals()
    normals.SetInputConnection(sinc.GetOutputPort())
    normals.SplittingOff()
    normals.Update()
    return normals.GetOutput()
