"""Properties of every valid skin; each check raises an AssertionError if a property is violated."""

import numpy
from shapes import points_of
from vtkmodules.util.numpy_support import vtk_to_numpy

# Unit vectors are computed in single precision, with a few roundings of 2^-24.
UNIT = 4 * 2.0**-24
# Fraction of a voxel within which rounding may change the sign at a node.
ON_THE_SKIN = 1e-3


def triangles_of(skin):
    return vtk_to_numpy(skin.GetPolys().GetConnectivityArray()).reshape(-1, 3).astype(numpy.int64)


def opposite_sides(triangles, count):
    """Returns for each side of a triangle the index of the reverse side, which another triangle
    has."""
    start, end = triangles.ravel(), numpy.roll(triangles, -1, axis=1).ravel()
    sides, reverse = start * count + end, end * count + start
    order = numpy.argsort(sides)
    in_order = sides[order]
    assert (in_order[1:] > in_order[:-1]).all(), "two triangles have a side in the same direction"
    found = numpy.searchsorted(in_order, reverse)
    found[found == len(order)] = 0
    assert (in_order[found] == reverse).all(), "a side of a triangle belongs to no other"
    return order[found]


def is_closed(skin):
    """Returns True if each side of a triangle is the reverse side of exactly one other."""
    try:
        opposite_sides(triangles_of(skin), skin.GetNumberOfPoints())
    except AssertionError:
        return False
    return True


def least_of_cycles(following):
    """For each element, the smallest one of its cycle of the permutation."""
    least = numpy.arange(len(following))
    while True:
        smaller = numpy.minimum(least, least[following])
        following = following[following]
        if (smaller == least).all():
            return least
        least = smaller


def check_manifold(triangles, count):
    """Checks that each side has one opposite, and that the triangles around a point form one
    ring."""
    assert (triangles.min(initial=0) >= 0) and (triangles.max(initial=-1) < count), "point numbers"
    assert len(numpy.unique(triangles)) == count, "points without triangles"
    opposite = opposite_sides(triangles, count)
    side = numpy.arange(3 * len(triangles))
    before = side - side % 3 + (side + 2) % 3
    rings = least_of_cycles(opposite[before])  # of the sides that start at a point
    assert len(numpy.unique(rings)) == count, "the triangles around a point are not one ring"


def check_normals(skin, points, triangles, voxel):
    normals = skin.GetPointData().GetNormals()
    if not normals or not len(points):
        return
    normals = vtk_to_numpy(normals).astype(float)
    lengths = numpy.linalg.norm(normals, axis=1)
    assert numpy.isfinite(lengths).all(), "a normal is not finite"
    worst = numpy.abs(lengths - 1).max(initial=0.0)
    assert worst <= UNIT, f"a normal has length 1 + {worst}"
    # The check weights triangles by area: slivers may be inverted, the skin as a whole may not.
    corners = points.astype(float)[triangles]
    sides = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area, characteristic = numpy.linalg.norm(sides, axis=1).sum() / 2, len(points) - len(sides) / 2
    # The lattice does not resolve the gradient around a part of one node, which has six points.
    if area < (voxel or 0) ** 2 or len(points) == 3 * characteristic:
        return
    outward = numpy.einsum("ij,ij->", sides, normals[triangles].sum(axis=1))
    assert outward > 0, "normals and triangles disagree on the outside"


def winding_numbers(corners, places):
    """Winding number of the triangles around each point: 1 within a skin, 0 outside. The solid
    angles are by Van Oosterom and Strackee's formula."""
    a, b, c = (corners[None, :, i] - places[:, None] for i in range(3))
    la, lb, lc = (numpy.linalg.norm(x, axis=2) for x in (a, b, c))
    above = numpy.einsum("ijk,ijk->ij", a, numpy.cross(b, c))
    below = (
        la * lb * lc
        + (a * b).sum(axis=2) * lc
        + (b * c).sum(axis=2) * la
        + (c * a).sum(axis=2) * lb
    )
    return numpy.arctan2(above, below).sum(axis=1) / (2 * numpy.pi)


def check_sides(function, corners, nodes, voxel):
    """Checks that the function's sign at nodes of the lattice matches the side of the mesh."""
    for node, turns in zip(nodes, winding_numbers(corners, nodes)):
        value = function.FunctionValue(node)
        if abs(value) > ON_THE_SKIN * voxel:
            inside = value < 0
            assert abs(turns - inside) < 0.01, f"at {node} F = {value}, but {turns} turns"


def some_nodes(points, voxel, count=24, seed=1):
    """Random nodes of the lattice within two voxels of the skin's box."""
    low = numpy.floor(points.min(axis=0) / voxel) - 2
    high = numpy.ceil(points.max(axis=0) / voxel) + 2
    draws = numpy.random.default_rng(seed).random((count, 3))
    return (low + numpy.floor(draws * (high - low + 1))) * voxel


def check_parts(history, points, triangles):
    """Checks the parts and Euler's characteristic in the last row against these triangles."""
    opposite = opposite_sides(triangles, len(points))
    least = numpy.arange(len(triangles))
    while True:
        own = least.copy()
        neighbours = least[opposite // 3].reshape(-1, 3)
        least = numpy.minimum(least, neighbours.min(axis=1, initial=len(least)))
        least = least[least]
        if (least == own).all():
            break
    row = history.GetNumberOfRows() - 1
    told = [
        history.GetValueByName(row, name).ToInt()
        for name in ("Components", "Voids", "EulerCharacteristic")
    ]
    characteristic = len(points) - len(triangles) // 2
    assert len(numpy.unique(least)) == told[0] + told[1], f"parts and hollows {told[:2]}"
    assert characteristic == told[2], f"Euler's characteristic {characteristic}, reported {told[2]}"


def check_history(history):
    for name in ("Time", "Area", "Volume", "MaxSpeed", "ActiveVoxels"):
        column = vtk_to_numpy(history.GetColumnByName(name))
        assert numpy.isfinite(column).all(), f"{name} of the history: {column}"


def check_skin(surface, voxel=None):
    """Checks for a closed manifold of finite points, oriented outward, or an empty skin, with unit
    normals and a finite history."""
    skin, history = surface.GetOutput(), surface.GetHistory()
    points, triangles = points_of(skin), triangles_of(skin)
    assert numpy.isfinite(points).all(), "a point is not finite"
    assert skin.GetNumberOfCells() == len(triangles), "cells other than triangles"
    check_manifold(triangles, len(points))
    check_normals(skin, points, triangles, voxel)
    check_history(history)
    if len(points) and voxel:
        nodes = some_nodes(points, voxel)
        check_sides(surface.GetSkinFunction(), points[triangles].astype(float), nodes, voxel)
