"""A closed skin as arrays of numpy: triangles, volumes, heights, signed distances."""

import numpy as np
from fluid_solver import pairs_within
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import mutable, vtkDoubleArray
from vtkmodules.vtkCommonDataModel import vtkStaticCellLocator
from vtkmodules.vtkFiltersCore import vtkImplicitPolyDataDistance, vtkPolyDataConnectivityFilter


class Skin:
    def __init__(self, data):
        self.data = data
        self.empty = data.GetNumberOfPolys() == 0
        if self.empty:
            self.corners = np.empty((0, 3, 3))
            return
        points = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
        triangles = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
        self.corners = points[triangles]

    def centers(self):
        return self.corners.mean(axis=1)

    def area_vectors(self):
        a, b, c = np.moveaxis(self.corners, 1, 0)
        return 0.5 * np.cross(b - a, c - a)

    def volume(self):
        a, b, c = np.moveaxis(self.corners, 1, 0)
        return (a * np.cross(b, c)).sum() / 6

    def centroid(self):
        """Centroid of the volume within."""
        a, b, c = np.moveaxis(self.corners, 1, 0)
        volumes = (a * np.cross(b, c)).sum(axis=1) / 6
        return (volumes[:, None] * (a + b + c) / 4).sum(axis=0) / volumes.sum()

    def distances(self, places):
        """Signed distances, negative within."""
        if self.empty or len(places) == 0:
            return np.full(len(places), np.inf)
        function, values = vtkImplicitPolyDataDistance(), vtkDoubleArray()
        function.SetInput(self.data)
        function.FunctionValue(numpy_to_vtk(np.asarray(places, float), deep=True), values)
        return vtk_to_numpy(values).copy()

    def heights(self, columns, top, bottom):
        """Height of the first hit from above at each (x, z); NaN if there is none."""
        heights = np.full(len(columns), np.nan)
        if self.empty:
            return heights
        locator = vtkStaticCellLocator()
        locator.SetDataSet(self.data)
        locator.BuildLocator()
        t, part, hit = mutable(0.0), mutable(0), [0.0] * 3
        for index, (x, z) in enumerate(columns):
            ends = (x, top, z), (x, bottom, z)
            if locator.IntersectWithLine(*ends, 0.0, t, hit, [0.0] * 3, part):
                heights[index] = hit[1]
        return heights

    def part_at(self, place):
        parts = vtkPolyDataConnectivityFilter()
        parts.SetInputData(self.data)
        parts.SetExtractionModeToClosestPointRegion()
        parts.SetClosestPoint(place)
        parts.Update()
        return Skin(parts.GetOutput())


def neighbours(places, reach):
    pairs = pairs_within(np.asarray(places, float).T, reach)
    return np.bincount(np.concatenate(pairs), minlength=len(places))


def clusters(places, reach):
    """Labels of the points: points connected by steps of at most `reach` have the same label."""
    first, second = pairs_within(np.asarray(places, float).T, reach)
    label = np.arange(len(places))
    while True:
        before = label.copy()
        np.minimum.at(label, first, before[second])
        np.minimum.at(label, second, before[first])
        if (label == before).all():
            return label
