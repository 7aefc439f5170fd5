"""Area, volume, pieces, voids and open edges of a mesh.

>>> from vtkmodules.vtkFiltersSources import vtkCubeSource
>>> from active_implicit_surfaces.measures import measure
>>> cube = vtkCubeSource()
>>> _ = cube.Update()
>>> found = measure(cube.GetOutput())
>>> found["area"], found["volume"], found["pieces"], found["open edges"]
(6.0, 1.0, 1, 0)
"""

from __future__ import annotations

from typing import Any

import numpy

from .data_objects import points_of
from .mesh_writers import polygons_of


def measure(mesh: Any) -> dict[str, Any]:
    """Measures the polygons and strips of a vtkPolyData; coincident points are merged.

    Returns a dict: "area" [length^2]; "volume" [length^3], negative if polygons face inward;
    "pieces", the number of connected surfaces of positive volume; "voids", the number of connected
    surfaces of negative volume; "open edges", the number of edges that have only one polygon.
    """
    places, numbers = numpy.unique(points_of(mesh), axis=0, return_inverse=True)
    places, fans = places.astype(float), [numpy.zeros((0, 3), int)]
    edges = [numpy.zeros((0, 2), int)]
    for corners in (numbers.reshape(-1)[own] for own in polygons_of(mesh)):
        for i in range(1, corners.shape[1] - 1):
            fans.append(corners[:, [0, i, i + 1]])
        for i in range(corners.shape[1]):
            edges.append(corners[:, [i - 1, i]])
    faces = numpy.concatenate(fans)
    a, b, c = (
        (places[faces[:, i]] - places.mean(axis=0) for i in range(3))
        if len(faces)
        else 3 * [numpy.zeros((0, 3))]
    )
    volumes = numpy.einsum("ij,ij->i", a, numpy.cross(b, c)) / 6.0
    parts = numpy.bincount(_parts(faces, len(places))[faces[:, 0]], volumes)
    first, second = numpy.sort(numpy.concatenate(edges)).astype(numpy.int64).T
    keys = (first * len(places) + second)[first != second]
    _, counts = numpy.unique(keys, return_counts=True)
    return {
        "area": float(numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1).sum() / 2.0),
        "volume": float(volumes.sum()),
        "pieces": int((parts > 0).sum()),
        "voids": int((parts < 0).sum()),
        "open edges": int((counts == 1).sum()),
    }


def _parts(faces: Any, count: int) -> Any:
    """Returns for each point the lowest point id of its connected surface."""
    lowest = numpy.arange(count)
    while len(faces):
        own = lowest[faces].min(axis=1)
        lower = lowest.copy()
        for i in range(3):
            numpy.minimum.at(lower, faces[:, i], own)
        lower = lower[lower]
        if numpy.array_equal(lower, lowest):
            break
        lowest = lower
    return lowest
