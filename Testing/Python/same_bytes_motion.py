"""Runs: every kind of motion, controls, walls, steady states, and requests for times in any
order."""

from same_bytes import follow, make, rest, run
from same_bytes_shapes import Steps, ball, block, cloud, scattered, two_balls, union
from same_bytes_targets import births_and_deaths

TIMES = (0.0, 0.2, 0.5)


def grow(**properties):
    target = union(ball(0.4, (0.3, 0, 0)), block(-0.7, 0.2, -0.3, 0.3, -0.2, 0.2))
    return make(target, ball(0.5), **properties)


def split(**properties):
    return make(two_balls(), ball(0.6), Tension=0.005, TimeStepSize=0.2, **properties)


@run("motion")
def parts_split(contents):
    follow(contents, split(), 1.0, 2.0)


@run("motion")
def parts_merge(contents):
    follow(contents, make(ball(0.7), two_balls(), TimeStepSize=0.2), 1.0, 2.0)


@run("motion")
def a_part_vanishes(contents):
    surface = make(ball(0.4, (-0.45, 0, 0)), two_balls(), TimeStepSize=0.2)
    follow(contents, surface, 1.0, 2.0)


@run("motion")
def all_vanishes(contents):
    surface = make(ball(0.3, (0.6, 0, 0)), ball(0.3, (-0.6, 0, 0)))
    follow(contents, surface, 1.0, may_be_empty=True)
    assert surface.GetOutput().GetNumberOfPoints() == 0


@run("motion")
def with_tension(contents):
    follow(contents, grow(Tension=0.02), *TIMES)


@run("motion")
def by_tension_alone(contents):
    surface = make(ball(0.3), block(-0.7, 0.7, -0.4, 0.4, -0.4, 0.4), Attraction=0, Tension=0.05)
    follow(contents, surface, *TIMES)


@run("motion")
def in_small_steps(contents):
    follow(contents, grow(CFL=0.4, Tension=0.01), *TIMES)


@run("motion")
def target_as_it_is(contents):
    follow(contents, grow(NormalizeTarget=0), *TIMES)


@run("motion")
def target_within_reach(contents):
    follow(contents, grow(TargetReach=0.07), *TIMES)


@run("motion")
def target_at_a_level(contents):
    follow(contents, grow(TargetIsoValue=-0.03), *TIMES)


@run("motion")
def target_inverted(contents):
    surface = make(ball(0.5), block(-0.7, 0.7, -0.7, 0.7, -0.7, 0.7), InvertTarget=1)
    surface.SetModelBounds(-1, 1, -1, 1, -1, 1)
    follow(contents, surface, 0.1)


@run("motion")
def target_evaluation_at_nodes(contents):
    follow(contents, grow(TargetEvaluation=1), *TIMES)


@run("motion")
def target_evaluation_at_closest_points(contents):
    follow(contents, grow(TargetEvaluation=2), *TIMES)


@run("motion")
def gradient_scheme_central(contents):
    follow(contents, grow(GradientScheme=0), *TIMES)


@run("motion")
def paper_faithful(contents):
    surface = grow(Tension=0.005, Attraction=1)
    surface.PaperFaithful()
    follow(contents, surface, 0.0, 0.1)


@run("motion")
def paper_scheme_with_other_choices(contents):
    for evaluation in range(3):
        surface = grow(PaperScheme=1, TargetEvaluation=evaluation, GradientScheme=1, Attraction=1)
        follow(contents, surface, 0.1)


@run("motion")
def clock_and_time_scale(contents):
    surface = grow(StartTime=3.0, TimeStepSize=0.25, NumberOfTimeSteps=5, TimeScale=0.7)
    follow(contents, surface, 3.0, 3.3, 4.0, 9.0)


@run("controls")
def volume_by_a_penalty(contents):
    surface = grow(VolumeControl=1, VolumeStiffness=2, Tension=0.02, TargetVolume=0.6)
    follow(contents, surface, *TIMES)
    follow(contents, grow(VolumeControl=1), *TIMES)


@run("controls")
def area_by_a_penalty(contents):
    surface = grow(AreaControl=1, AreaStiffness=2, Tension=0.02, TargetArea=4)
    follow(contents, surface, *TIMES)
    follow(contents, grow(AreaControl=1), *TIMES)


@run("controls")
def volume_and_area_by_penalties(contents):
    follow(contents, split(VolumeControl=1, AreaControl=1, VolumeStiffness=0.5), 1.0, 2.0)


@run("controls")
def rest_with_penalties(contents):
    rest(contents, grow(VolumeControl=1, AreaControl=1, AreaStiffness=0.2, RestTolerance=0.05))


@run("exact controls")
def volume_exactly(contents):
    follow(contents, grow(VolumeControl=2, Tension=0.02), *TIMES)


@run("exact controls")
def volume_exactly_of_a_number(contents):
    follow(contents, grow(VolumeControl=2, TargetVolume=0.6), *TIMES)


@run("exact controls")
def volume_exactly_through_a_split(contents):
    follow(contents, split(VolumeControl=2), 1.0, 2.0)


@run("exact controls")
def area_exactly(contents):
    follow(contents, grow(AreaControl=2, Tension=0.02), *TIMES)


@run("exact controls")
def area_exactly_and_volume_by_a_penalty(contents):
    follow(contents, grow(AreaControl=2, VolumeControl=1, TargetArea=3.5), *TIMES)


@run("exact controls")
def rest_with_exact_volume(contents):
    rest(contents, grow(VolumeControl=2, Tension=0.02, RestTolerance=0.05))


@run("exact controls")
def walls_and_exact_volume(contents):
    follow(contents, walled(VolumeControl=2), *TIMES)


def walled(**properties):
    surface = make(ball(0.8), ball(0.4), BoundedDomain=1, **properties)
    surface.SetModelBounds(-0.55, 0.55, -0.63, 0.9, -1, 0.5)
    return surface


@run("walls")
def walls_around_a_function(contents):
    follow(contents, walled(), *TIMES)
    follow(contents, walled(Tension=0.01, TargetIsoValue=0.05), *TIMES)


@run("walls")
def walls_around_particles(contents):
    surface = make(cloud(scattered(40)), BoundedDomain=1, KernelRadius=0.5)
    surface.SetModelBounds(-0.4, 0.5, -0.33, 0.33, -0.5, 0.4)
    follow(contents, surface, 0.0, 0.3)


@run("walls")
def fluid_rests_on_walls(contents):
    lattice = [(x, y, z) for x in range(5) for y in range(5) for z in range(3)]
    jitter = scattered(75), scattered(75, seed=2)
    steps = {
        0.5 * i: cloud([[0.2 * n + 0.1 + 0.08 * d for n, d in zip(*pair)] for pair in pairs])
        for i, pairs in enumerate(zip(lattice, shifts) for shifts in jitter)
    }
    nodes = {"ParticleModel": 1, "TimeIntegration": 1, "CreateParts": 1, "Attraction": -1}
    surface = make(Steps(steps), BoundedDomain=1, ParticleSpacing=0.2, **nodes)
    surface.SetModelBounds(0, 1, 0, 1, 0, 1)
    follow(contents, surface, 0.0, 0.3, 0.5)


@run("walls")
def walls_at_rest(contents):
    rest(contents, walled())


@run("rest")
def rest_on_the_target(contents):
    rest(contents, grow())


@run("rest")
def rest_under_tension(contents):
    rest(contents, grow(Tension=0.03, RestTolerance=0.01))


@run("rest")
def rest_is_cut_off(contents):
    rest(contents, grow(MaximumNumberOfSubsteps=7, Tension=0.03))


@run("rest")
def rest_of_particles(contents):
    rest(contents, make(cloud(scattered(40)), ball(0.6), KernelRadius=0.45))


@run("rest")
def rest_of_a_part_while_another_moves(contents):
    def balls(way):
        return cloud([(-0.6, 0, 0), (0.5, way, 0)])

    target = Steps({float(i): balls(0.05 * i) for i in range(5)})
    follow(contents, make(target, KernelRadius=0.8), 2.0, 4.0)


def back_and_forth(contents, **properties):
    surface = make(births_and_deaths(), arrays={1: "name"}, KernelRadius=0.35, **properties)
    follow(contents, surface, 2.0, 0.4, 1.0, 1.5, 0.0, 1.0, 2.0)


@run("times")
def times_back_and_forth(contents):
    back_and_forth(contents)


@run("times")
def times_back_and_forth_without_checkpoints(contents):
    back_and_forth(contents, CheckpointInterval=0)


@run("times")
def times_back_and_forth_with_every_checkpoint(contents):
    back_and_forth(contents, CheckpointInterval=1)


@run("times")
def times_back_and_forth_without_memory(contents):
    back_and_forth(contents, CheckpointInterval=1, CheckpointMemory=0)


@run("times")
def times_outside_and_in_between(contents):
    follow(contents, split(), -1.0, 0.33, 0.35, 0.33, 1e9, 0.33)


@run("times")
def times_added_in_situ(contents):
    source = Steps({float(i): cloud([(0.1 * i, 0, 0), (0, 0.1 * i, 0)]) for i in range(2)})
    surface = make(source, KernelRadius=0.6)
    surface.SetModelBounds(-1, 1, -1, 1, -1, 1)
    follow(contents, surface, 1.0)
    source.steps[2.0] = cloud([(0.25, 0, 0), (0, 0.25, 0)])
    source.Modified()
    follow(contents, surface, 2.0, 1.5)
