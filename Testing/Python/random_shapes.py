"""Shapes for random cases, each made from its name and the seed of a generator: targets of every
kind, static and moving, initial shapes, obstacles.

A target consists of the attracting object (a function, data or an algorithm) and the names of its
arrays by the indices of SetInputArrayToProcess.
"""

from random import Random

import numpy
from active_implicit_surfaces import vtkGridPotential, vtkSkeletonPotential
from same_bytes_shapes import (
    Steps,
    add_array,
    ball,
    block,
    brick,
    cloud,
    globe,
    image,
    lines,
    quadric,
    strip,
    two_balls,
    union,
)
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (
    vtkImplicitBoolean,
    vtkMultiBlockDataSet,
    vtkPlane,
    vtkPolyData,
    vtkQuadric,
    vtkSuperquadric,
    vtkTable,
)

STEP = 0.25  # interval of the time steps of a moving target


class Source(Steps):
    """Time steps of a target. Requests fail while `fails` is set."""

    fails = False

    def RequestData(self, request, inputs, outputs):
        return 0 if self.fails else super().RequestData(request, inputs, outputs)


def moving(make, random):
    return Source({i * STEP: make(i) for i in range(random.randint(3, 5))})


def place(random, half=0.5):
    return tuple(random.uniform(-half, half) for _ in range(3))


def places(random, most=40):
    return [place(random) for _ in range(random.randint(1, most))]


def some_arrays(random, count):
    """Optional arrays of particles, and their indices."""
    arrays, numbers = {}, {}
    if random.random() < 0.3:
        arrays["size"] = [random.uniform(0.2, 0.5) for _ in range(count)]
        numbers[0] = "size"
    if random.random() < 0.3:
        arrays["weight"] = [random.uniform(0.5, 1.5) for _ in range(count)]
        numbers[2] = "weight"
    return arrays, numbers


def particles(random):
    positions = places(random)
    arrays, numbers = some_arrays(random, len(positions))
    return cloud(positions, **arrays), numbers


def moved(position, way, share):
    return tuple(x + share * w for x, w in zip(position, way))


def births_and_deaths(random):
    """Particles with ids. Each step has some of them, in any order, and sometimes none."""
    positions = places(random)
    ways = [place(random, 0.2) for _ in positions]

    def at(i):
        ids = [j for j in range(len(positions)) if random.random() < 0.8]
        ids = [] if random.random() < 0.1 else random.sample(ids, len(ids))
        return cloud([moved(positions[j], ways[j], i) for j in ids], name=ids)

    return moving(at, random), {1: "name"}


def emitter(random):
    """Particles that leave one point, a few more at each step; matched by ids or by their
    indices."""
    origin = place(random, 0.2)
    ways = [place(random, 0.3) for _ in range(5 * random.randint(1, 5))]

    def at(i):
        count = len(ways) * (i + 1) // 5
        ages = [i - 5 * j // len(ways) for j in range(count)]
        positions = [moved(origin, ways[j], ages[j]) for j in range(count)]
        return cloud(positions, name=list(range(count)))

    return moving(at, random), random.choice(({}, {1: "name"}))


def unmatched_particles(random):
    return moving(lambda i: cloud(places(random, 20)), random), {}


def growing_crowd(random):
    """Particles without ids whose number may grow, up to 200, and which may move by more than
    their spacing."""
    count, factor = random.randint(1, 20), random.choice((1, 2, 4, 10))
    way = place(random, 1.0)

    def at(i):
        return cloud([moved(place(random), way, i) for _ in range(min(count * factor**i, 200))])

    return moving(at, random), {}


def as_table(points):
    table = vtkTable()
    positions = numpy.array([points.GetPoint(i) for i in range(points.GetNumberOfPoints())])
    for axis, values in zip("xyz", positions.reshape(-1, 3).T):
        column = numpy_to_vtk(values, deep=True)
        column.SetName(axis)
        table.AddColumn(column)
    for i in range(points.GetPointData().GetNumberOfArrays()):
        table.AddColumn(points.GetPointData().GetArray(i))
    return table


def as_blocks(points, random):
    """Blocks of the same particles. Some blocks are empty, and some are nested."""
    count = points.GetNumberOfPoints()
    cuts = sorted(random.randint(0, count) for _ in range(random.randint(0, 3)))
    blocks = vtkMultiBlockDataSet()
    for low, high in zip([0, *cuts], [*cuts, count]):
        block, inner = rows_of(points, range(low, high)), vtkMultiBlockDataSet()
        if random.random() < 0.3:
            inner.SetBlock(random.randint(0, 2), block)
            block = inner
        blocks.SetBlock(blocks.GetNumberOfBlocks() + random.randint(0, 1), block)
    return blocks


def rows_of(points, rows):
    part = vtkPolyData()
    part.SetPoints(vtkPoints())
    part.GetPoints().SetDataType(points.GetPoints().GetDataType())
    part.GetPointData().CopyAllocate(points.GetPointData())
    for row in rows:
        copy = part.GetPoints().InsertNextPoint(points.GetPoint(row))
        part.GetPointData().CopyData(points.GetPointData(), row, copy)
    return part


def in_another_form(kind, change):
    """Returns a maker of particles, static or moving, that applies `change` to each step."""

    def make(random):
        target, numbers = kind(random)
        if isinstance(target, Source):
            return Source({t: change(d, random) for t, d in target.steps.items()}), numbers
        return change(target, random), numbers

    return make


def table(random):
    kind = random.choice((particles, births_and_deaths, emitter))
    return in_another_form(kind, lambda points, _: as_table(points))(random)


def blocks(random):
    return in_another_form(random.choice((particles, births_and_deaths, emitter)), as_blocks)(
        random
    )


def a_skeleton(random):
    positions = [place(random) for _ in range(random.randint(2, 6))]
    chain = list(range(len(positions)))
    cut = random.randint(1, len(chain))
    chains = [part for part in (chain[:cut], chain[cut - 1 :]) if len(part) > 1]
    return lines(positions, *chains)


def skeleton(random):
    return a_skeleton(random), {}


def now_and_then_nothing(make, random):
    return vtkPolyData() if random.random() < 0.1 else make(random)


def moving_skeleton(random):
    return moving(lambda i: now_and_then_nothing(a_skeleton, random), random), {}


def a_mesh(random):
    if random.random() < 0.5:
        return globe(random.uniform(0.2, 0.7))
    return brick([random.uniform(0.15, 0.5) for _ in range(3)], place(random, 0.3))


def mesh(random):
    return a_mesh(random), {}


def moving_mesh(random):
    return moving(lambda i: now_and_then_nothing(a_mesh, random), random), {}


def open_mesh(random):
    return strip(), {}


def an_image(random):
    level = random.uniform(0.05, 0.4)
    first = quadric(*(random.uniform(0.7, 3) for _ in range(3)), level)
    way = random.uniform(-0.5, 0.5)
    second = quadric(*(random.uniform(1, 3) for _ in range(3)), level)
    both = random.random() < 0.5

    def value(x, y, z):
        return (first(x, y, z) * second(x - way, y, z)) if both else first(x, y, z)

    return image(value, count=random.randint(9, 15), G=second)


def image_target(random):
    return an_image(random), random.choice(({}, {3: "G"}))


def moving_image(random):
    seed = random.randint(0, 1000)
    count = Random(seed)  # same size at all steps
    frames = [an_image(Random(seed)), an_image(count)]
    return moving(lambda i: frames[i % 2], random), random.choice(({}, {3: "G"}))


def a_mask(random, count=None):
    """A label map with pixels of a random size, in an image that may cut the labelled body."""
    sizes = [random.uniform(1, 8) for _ in range(3)]
    level = random.uniform(0.2, 2.0)
    inside = quadric(*sizes, level)

    def value(x, y, z):
        return 3 * (inside(x, y, z) < 0)

    mask = image(value, count=count or random.randint(5, 15))
    add_array(mask.GetPointData(), "F", vtk_to_numpy(mask.GetPointData().GetScalars()), "u1")
    mask.GetPointData().SetActiveScalars("F")
    mask.SetSpacing([x * random.choice((0.5, 1.0)) for x in mask.GetSpacing()])
    return mask


def mask(random):
    return a_mask(random), {}


def moving_mask(random):
    count, seed = random.randint(5, 12), random.randint(0, 1000)
    frames = [a_mask(Random(seed + i), count) for i in range(3)]
    for frame in frames:
        frame.SetSpacing(frames[0].GetSpacing())
    return moving(lambda i: frames[i % 3], random), {}


def a_ball(random):
    return ball(random.uniform(0.2, 0.7), place(random, 0.3))


def a_block(random):
    low = [random.uniform(-0.7, 0) for _ in range(3)]
    return block(*(bound for x in low for bound in (x, x + random.uniform(0.2, 0.8))))


def some_balls(random):
    return union(*(a_ball(random) for _ in range(random.randint(1, 4))))


def balls_apart(random):
    return two_balls(random.uniform(0.3, 0.5), random.uniform(0.2, 0.45))


def a_difference(random):
    difference = vtkImplicitBoolean()
    difference.SetOperationTypeToDifference()
    difference.AddFunction(ball(random.uniform(0.5, 0.7)))
    difference.AddFunction(a_ball(random))
    return difference


def an_ellipsoid(random):
    function = vtkQuadric()
    function.SetCoefficients(
        *(random.uniform(1, 4) for _ in range(3)), 0, 0, 0, 0, 0, 0, -random.uniform(0.2, 0.8)
    )
    return function


def a_superquadric(random):
    function = vtkSuperquadric()
    function.SetSize(random.uniform(0.4, 0.8))
    function.SetPhiRoundness(random.uniform(0.3, 1.5))
    function.SetThetaRoundness(random.uniform(0.3, 1.5))
    return function


def a_half_space(random):
    plane = vtkPlane()
    plane.SetOrigin(place(random, 0.3))
    plane.SetNormal(random.choice(((1, 0, 0), (0, -1, 0), (0.6, 0, 0.8))))
    return plane


def a_potential(random):
    """An implicit function of this package."""
    if random.random() < 0.5:
        function = vtkSkeletonPotential()
        kind = random.choice((particles, skeleton))
        function.SetInput(kind(random)[0])
        function.SetParticleModel(random.randint(0, 1) if kind is particles else 0)
        function.SetRadius(random.uniform(0.3, 0.6))
        return function
    function = vtkGridPotential()
    function.SetInput(random.choice((a_mesh, an_image))(random))
    function.SetVoxelSize(0.15)
    return function


FUNCTIONS = (
    a_ball,
    a_block,
    some_balls,
    balls_apart,
    a_difference,
    an_ellipsoid,
    a_superquadric,
    a_half_space,
    a_potential,
)
PARTICLES = (
    particles,
    births_and_deaths,
    births_and_deaths,
    emitter,
    unmatched_particles,
    growing_crowd,
    table,
    blocks,
)
OTHERS = (
    skeleton,
    moving_skeleton,
    mesh,
    moving_mesh,
    open_mesh,
    image_target,
    moving_image,
    mask,
    moving_mask,
)


def shape_of(kind):
    """Returns a maker of a shape that has no array names."""
    return lambda random: (kind(random), {})


TARGETS = {kind.__name__: shape_of(kind) for kind in FUNCTIONS}
TARGETS |= {kind.__name__: kind for kind in (*PARTICLES, *OTHERS)}
INITIALS = {kind.__name__: shape_of(kind) for kind in (*FUNCTIONS, a_mesh, an_image)}
OBSTACLES = {kind.__name__: shape_of(kind) for kind in FUNCTIONS}
SHAPES = {"target": TARGETS, "initial": INITIALS, "obstacle": OBSTACLES}


def make_shape(role, shape):
    if shape is None:
        return None, {}
    name, seed = shape
    return SHAPES[role][name](Random(seed))
