"""Runs: every kind of target, and every kind of initial shape."""

from active_implicit_surfaces import (
    vtkActiveImplicitSurface,
    vtkActiveVDBReader,
    vtkActiveVDBWriter,
    vtkGridPotential,
    vtkSkeletonPotential,
)
from same_bytes import POINTS, THREADS, follow, make, run
from same_bytes_shapes import (
    BOX,
    Steps,
    ball,
    block,
    brick,
    cloud,
    globe,
    image,
    lines,
    quadric,
    scattered,
    strip,
    two_balls,
    union,
)
from scenes import splash as make_splash

CORNERS = [(-0.6, -0.2, 0), (0, 0.3, 0.1), (0.5, -0.1, -0.2), (0.1, -0.6, 0.2)]
KERNELS = range(3)  # WYVILL, CUBIC_SPLINE, METABALL


def moved(positions, way):
    return [(x + way, y, z) for x, y, z in positions]


@run("targets")
def particles(contents):
    follow(contents, make(cloud(scattered(40)), KernelRadius=0.4), 0.0, 0.3)


@run("targets")
def particles_with_radii_and_strengths(contents):
    target = cloud(
        scattered(30),
        size=[0.0625 + i / 512 for i in range(30)],
        weight=[1 - i / 64 for i in range(30)],
    )
    follow(contents, make(target, arrays={0: "size", 2: "weight"}), 0.0, 0.3)


@run("targets")
def particles_with_an_estimated_radius(contents):
    follow(contents, make(cloud(scattered(60, seed=5))), 0.0, 0.2)


@run("targets")
def particles_of_every_kernel_and_threshold(contents):
    for kernel in KERNELS:
        target = cloud(scattered(20))
        surface = make(
            target, KernelRadius=0.5, ParticleKernel=kernel, ParticleThreshold=0.3 + 0.1 * kernel
        )
        follow(contents, surface, 0.2)


def births_and_deaths():
    """Ids 0 to 29, 5 to 34, and 10 to 19 in another order."""
    start = scattered(40)
    steps = {}
    for time, ids in ((0.0, range(30)), (1.0, range(5, 35)), (2.0, reversed(range(10, 20)))):
        ids = list(ids)
        steps[time] = cloud(moved([start[i] for i in ids], 0.1 * time), name=ids)
    return Steps(steps)


@run("targets")
def particles_are_born_and_die(contents):
    surface = make(births_and_deaths(), arrays={1: "name"}, KernelRadius=0.35)
    follow(contents, surface, 0.0, 0.5, 1.0, 1.75, 2.0)


@run("targets")
def particles_of_anisotropic_kernels(contents):
    surface = make(births_and_deaths(), arrays={1: "name"}, ParticleModel=1, ParticleSpacing=0.2)
    follow(contents, surface, 0.0, 0.5, 1.0, 1.75, 2.0)


@run("targets")
def particles_with_nothing_set(contents):
    """Estimates spacing, kernel radius, voxel size and attraction."""
    surface = vtkActiveImplicitSurface()
    surface.SetNumberOfThreads(THREADS["number"])
    target = births_and_deaths()
    surface.SetInputConnection(target.GetOutputPort())
    surface.SetInputArrayToProcess(1, 0, 0, POINTS, "name")
    surface.UpdateTimeStep(0.5)
    contents.outputs(surface)


@run("targets")
def particles_move_by_their_numbers(contents):
    target = Steps({0.0: cloud(scattered(20)), 1.0: cloud(moved(scattered(20), 0.25))})
    follow(contents, make(target, KernelRadius=0.4), 0.5, 1.0)


@run("targets")
def particles_that_do_not_match_fade(contents):
    target = Steps({0.0: cloud(scattered(20)), 1.0: cloud(scattered(25, seed=3))})
    follow(contents, make(target, KernelRadius=0.4), 0.5, 1.0)


@run("targets")
def particles_that_end_leave_nothing(contents):
    target = Steps({0.0: cloud([(0, 0, 0)]), 1.0: cloud([]), 5.0: cloud([])})
    surface = make(target, KernelRadius=0.7, Attraction=8)
    follow(contents, surface, 1.0, 5.0, may_be_empty=True)
    assert surface.GetOutput().GetNumberOfPoints() == 0


@run("targets")
def splash(contents):
    surface = make_splash()[1]
    surface.SetVoxelSize(0.07)
    surface.SetInputArrayToProcess(1, 0, 0, 0, "id")
    follow(contents, surface, 2.0, 4.5)


@run("targets")
def skeleton(contents):
    target = lines(CORNERS, (0, 1, 2), (1, 3))
    follow(contents, make(target, KernelRadius=0.5), 0.0, 0.3)


@run("targets")
def skeleton_with_radii_moves(contents):
    sizes = [0.15, 0.25, 0.2, 0.175]
    steps = {
        time: lines(moved(CORNERS, way), (0, 1, 2), (1, 3), size=sizes)
        for time, way in ((0.0, 0.0), (1.0, 0.2), (2.0, 0.1))
    }
    follow(contents, make(Steps(steps), arrays={0: "size"}), 0.5, 1.0, 1.7)


@run("targets")
def mesh(contents):
    follow(contents, make(brick()), 0.0, 0.4)


@run("targets")
def mesh_moves(contents):
    steps = {0.0: brick(), 1.0: brick((0.4, 0.4, 0.4), (0.2, 0, 0)), 2.0: globe(0.6)}
    follow(contents, make(Steps(steps)), 0.5, 1.0, 2.0)


@run("targets")
def mesh_with_open_edges_becomes_a_shell(contents):
    follow(contents, make(strip(), MeshThickness=0.35), 0.0, 0.4)


@run("targets")
def image_of_samples(contents):
    follow(contents, make(image(quadric(1, 2, 0.7)), VoxelSize=0.12), 0.0, 0.4)


@run("targets")
def image_inverted_at_a_level(contents):
    target = image(lambda x, y, z: x, G=lambda x, y, z: 1 - x * x - 2 * y * y - z * z)
    surface = make(target, arrays={3: "G"}, TargetIsoValue=0.7, InvertTarget=1)
    follow(contents, surface, 0.0, 0.4)


@run("targets")
def image_moves(contents):
    shapes = quadric(1, 2, 0.7), quadric(2, 1, 1), quadric(1, 1, 1)
    steps = {float(time): image(shape) for time, shape in enumerate(shapes)}
    follow(contents, make(Steps(steps)), 0.5, 1.0, 2.0)


@run("targets")
def labels_move(contents):
    def label(at):
        return image(lambda x, y, z: 1.0 * ((x - at) ** 2 + y * y + z * z < 0.5))

    steps = {0.5 * time: label(0.2 * time) for time in range(3)}
    surface = make(Steps(steps), CreateParts=1, TimeIntegration=1, VoxelSize=0.12, Attraction=-1)
    follow(contents, surface, 0.0, 0.25, 0.5, 1.0)


@run("targets")
def level_set_of_a_file(contents):
    with contents.file("ball.vdb", contents.vdb) as path:
        writer = vtkActiveVDBWriter()
        source = make(ball(0.6), NumberOfTimeSteps=1)
        writer.SetInputConnection(source.GetOutputPort())
        writer.SetFileName(path)
        assert writer.Write()
        reader = vtkActiveVDBReader()
        reader.SetFileName(path)
        reader.OutputDenseOff()
        follow(contents, make(reader), 0.0, 0.2)
        follow(contents, make(ball(0.4), reader), 0.0, 0.2)


@run("targets")
def functions_of_vtk(contents):
    for target in (
        ball(0.6),
        block(-0.5, 0.4, -0.3, 0.3, -0.4, 0.6),
        union(*(ball(0.4, (0.3, 0, 0)), block(-0.7, 0.2, -0.3, 0.3, -0.2, 0.2))),
    ):
        follow(contents, make(target, ball(0.5)), 0.4)


@run("targets")
def functions_of_ours(contents):
    bones = vtkSkeletonPotential()
    bones.SetInput(lines(CORNERS, (0, 1, 2), (1, 3)))
    bones.SetRadius(0.5)
    follow(contents, make(bones), 0.0, 0.2)
    stone = vtkGridPotential()
    stone.SetInput(brick())
    stone.SetVoxelSize(0.1)
    follow(contents, make(stone, ball(0.5)), 0.0, 0.4)


@run("targets")
def skin_of_another_filter(contents):
    other = make(two_balls(), NumberOfTimeSteps=1)
    other.Update()
    follow(contents, make(other.GetSkinFunction(), ball(0.7)), 0.0, 0.4)
    follow(contents, make(other, ball(0.7), ModelBounds=BOX), 0.0, 0.4)


@run("starts")
def start_on_a_function(contents):
    follow(contents, make(ball(0.4), two_balls(0.3, 0.4)), 0.0, 0.3)


@run("starts")
def start_on_a_mesh(contents):
    follow(contents, make(ball(0.4), brick()), 0.0, 0.3)


@run("starts")
def start_on_an_open_mesh(contents):
    follow(contents, make(ball(0.4), strip(), MeshThickness=0.3), 0.0, 0.3)


@run("starts")
def start_on_an_image(contents):
    start = image(lambda x, y, z: z, G=quadric(1, 1, 3, 0.0))
    surface = make(ball(0.4), start, arrays={4: "G"}, TargetIsoValue=0.3)
    follow(contents, surface, 0.0, 0.3)


@run("starts")
def start_in_default_bounds(contents):
    follow(contents, make(globe(0.6), image(quadric(1, 2, 1, 0.25)), VoxelSize=-1), 0.0, 0.1)
