"""Random cases of test_random_ranks.py: a seed gives the same cases on any number of ranks.

Run: python3 random_ranks_program.py <seed> <cases> <folder> [--alone]; without --alone, under
mpiexec.
"""

import sys
from random import Random

import numpy
from random_cases import VALUES, draw_change
from ranks import POINTS, Keeper, Particles, at_random, begin, in_blocks, make_surface

STEPS = 4
SPACING = 0.1
LONG = ("EvolutionMode",)  # converging takes as long as it takes, and ranks do not share it


def on_one(step, count, pieces):
    return numpy.full(count, step % pieces)


class Motion:
    """particles(step): a body, a sheet and drops far away that move; with ids, some are born, some
    die."""

    def __init__(self, seed, has_ids):
        draw = numpy.random.default_rng(seed)
        self.has_ids = has_ids
        self.seed = seed
        self.size = draw.uniform(0.3, 1) * numpy.array([1.0, 0.7, 0.5])
        count = int(draw.integers(20, 600))
        self.places = draw.uniform(-1, 1, (count, 3)) * self.size
        self.places[: count // 5, 2] = 0.05 * self.places[: count // 5, 0] - self.size[2]
        self.places[-3:] += draw.uniform(-3, 3, 3)
        self.ways = 0.15 * draw.normal(size=3) + 0.03 * draw.normal(size=(count, 3))
        self.share = draw.choice([0.0, 0.05, 0.3])  # of those that are not there at a step
        self.radii = 2 / 3 * SPACING * draw.uniform(0.7, 1.4, count)
        self.radii[0] *= draw.choice([1.0, 6.0])

    def __call__(self, step):
        draw = numpy.random.default_rng((self.seed, step))
        ids = numpy.arange(len(self.places))
        if self.has_ids:
            ids = draw.permutation(ids[draw.uniform(size=len(ids)) >= self.share])
        places = self.places[ids] + step * self.ways[ids]
        return {"position": places, "id": ids, "radius": self.radii[ids], "heat": ids + step}


def draw_properties(random):
    """Draws properties that matter for ranks, and up to three others."""
    properties = {
        "VoxelSize": random.choice((0.08, 0.12)),
        "ParticleModel": random.randint(0, 1),
        "ParticleSpacing": SPACING,
        "TimeIntegration": random.choice((0, 1)),
        "Tension": random.choice(VALUES["Tension"]),
        "CreateParts": random.randint(0, 1),
        "ComputeVelocity": random.randint(0, 1),
        "PassTargetArrays": random.randint(0, 1),
        "OutputPotential": random.randint(0, 1),
    }
    for name, value in (draw_change(random) for _ in range(random.randint(0, 3))):
        if name not in LONG:
            properties.setdefault(name, value)
    return properties | {"MaximumNumberOfActiveVoxels": 3_000_000}


def make_case(random, rank):
    motion = Motion(random.randrange(1 << 30), random.random() < 0.8)
    owners = random.choice((at_random, in_blocks, on_one) if motion.has_ids else (in_blocks,))
    surface = make_surface(Particles(STEPS, motion, owners))
    properties = draw_properties(random)
    for name, value in properties.items():
        getattr(surface, "Set" + name)(*(value if isinstance(value, tuple) else (value,)))
    surface.SetNumberOfThreads(1 + rank % 2)
    if motion.has_ids:
        surface.SetInputArrayToProcess(1, 0, 0, POINTS, "id")
    if random.random() < 0.5:
        surface.SetInputArrayToProcess(0, 0, 0, POINTS, "radius")
    times = [random.choice((0.5 * random.randint(0, 6), random.uniform(0, 3))) for _ in range(2)]
    return surface, properties, times


def main():
    seed, cases, folder = sys.argv[1:4]
    ranks = begin("--alone" in sys.argv)
    keeper = Keeper(ranks, folder)
    for case in range(int(cases)):
        surface, properties, times = make_case(Random(f"{seed} {case}"), ranks.rank)
        if ranks.rank == 0:
            print(f"case {case} of seed {seed}:", properties, times, flush=True)
        for request, time in enumerate(times):
            keeper.update(f"{case}_{request}", surface, time)


if __name__ == "__main__":
    main()
