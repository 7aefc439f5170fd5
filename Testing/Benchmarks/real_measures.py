"""Measures of meshes and atoms for real_data.py."""

import numpy as np
from skin_geometry import Skin
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkFeatureEdges, vtkPolyDataConnectivityFilter


def is_closed(mesh):
    edges = vtkFeatureEdges()
    edges.SetInputData(mesh)
    edges.FeatureEdgesOff()
    edges.ManifoldEdgesOff()
    edges.Update()
    return mesh.GetNumberOfPolys() > 0 and edges.GetOutput().GetNumberOfCells() == 0


def pieces_of(mesh):
    if mesh.GetNumberOfPolys() == 0:
        return 0
    parts = vtkPolyDataConnectivityFilter()
    parts.SetInputData(mesh)
    parts.SetExtractionModeToAllRegions()
    parts.Update()
    return parts.GetNumberOfExtractedRegions()


def flicker(skins, spacing, first=30):
    """Median absolute second difference in time of the heights [r], from frame `first` on."""
    corners = skins[-1].corners.reshape(-1, 3)
    low, high = corners.min(axis=0), corners.max(axis=0)
    lines = [np.linspace(low[a] + 2 * spacing, high[a] - 2 * spacing, 20) for a in (0, 2)]
    columns = np.stack(np.meshgrid(*lines), axis=-1).reshape(-1, 2)
    heights = np.array([skin.heights(columns, 10 * high[1], low[1]) for skin in skins[first:]])
    return np.nanmedian(np.abs(np.diff(heights, n=2, axis=0))) / (0.5 * spacing)


def faces_of(inside):
    """Centres of the faces between voxels inside and outside, in units of voxels."""
    padded, centers = np.pad(inside, 1), []
    for axis in range(3):
        places = np.argwhere(np.diff(padded.astype(np.int8), axis=axis)) - 1.0
        places[:, axis] += 0.5
        centers.append(places)
    return np.concatenate(centers)


def edge_angle(mesh):
    return angles_and_distances(mesh)[0].mean()


def turn_of(mesh):
    """Angle between the normals of triangles that share an edge, per distance of their centers."""
    angles, distances = angles_and_distances(mesh)
    return angles.sum() / distances.sum()


def angles_and_distances(mesh):
    """Angles of normals [deg] and distances of centers, of triangles that share an edge."""
    corners = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    skin = Skin(mesh)
    normals, centers = skin.area_vectors(), skin.centers()
    normals /= np.linalg.norm(normals, axis=1)[:, None] + 1e-300
    edges = np.sort(np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]]))
    order = np.lexsort(edges.T)
    edges, owners = edges[order], np.tile(np.arange(len(corners)), 3)[order]
    shared = np.flatnonzero((edges[1:] == edges[:-1]).all(axis=1))
    one, other = owners[shared], owners[shared + 1]
    cosines = (normals[one] * normals[other]).sum(axis=1)
    distances = np.linalg.norm(centers[one] - centers[other], axis=1)
    return np.degrees(np.arccos(np.clip(cosines, -1, 1))), distances


def volume_with_probe(places, radii, probe, samples=200000):
    """Volume of a solvent-excluded body by random points, extrapolated to infinitely many dots.

    A point within the balls enlarged by the probe is inside if all free dots on these balls are
    farther from the point than the probe's radius.
    """
    from scipy.spatial import cKDTree

    low, high = places.min(axis=0) - 4, places.max(axis=0) + 4
    points = np.random.default_rng(0).uniform(low, high, (samples, 3))
    kinds = [(radius, cKDTree(places[radii == radius])) for radius in np.unique(radii)]
    near = np.any([tree.query(points)[0] < radius + probe for radius, tree in kinds], axis=0)
    volumes = []
    for count in (200, 400):
        dots = cKDTree(free_dots(places, radii + probe, count))
        inside = (dots.query(points[near])[0] > probe).sum()
        volumes.append(np.prod(high - low) * inside / samples)
    return 2 * volumes[1] - volumes[0]


def free_dots(places, radii, count):
    """Dots on the surfaces of the balls, outside all other balls."""
    from scipy.spatial import cKDTree

    steps = np.arange(count) + 0.5
    height, angle = 1 - 2 * steps / count, np.pi * (1 + 5**0.5) * steps
    across = np.sqrt(1 - height * height)
    sphere = np.stack([across * np.cos(angle), across * np.sin(angle), height], axis=1)
    free = []
    for ball, near in enumerate(cKDTree(places).query_ball_point(places, radii + radii.max())):
        near.remove(ball)
        dots = places[ball] + radii[ball] * sphere
        gaps = ((dots[:, None] - places[near]) ** 2).sum(axis=2) - radii[near] ** 2
        free.append(dots[(gaps > 0).all(axis=1)])
    return np.concatenate(free)
