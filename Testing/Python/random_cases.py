"""Random cases: a scene, properties, and operations on one filter, as a dictionary of literals.

    {"target": ("emitter", 5), "initial": None, "obstacle": ("a_ball", 3),
     "properties": {"Tension": 0.02}, "operations": [("time", 0.3), ("put", "CFL", 0.5), ...]}

`draw_case` draws one, `random_checks.check` tries it.
"""

import math

from active_implicit_surfaces import vtkActiveImplicitSurface
from properties import refused_values, rows_of
from random_shapes import FUNCTIONS, INITIALS, OBSTACLES, OTHERS, PARTICLES, TARGETS
from test_restart import DOES_NOT_RESTART, RESTARTS, half_box
from vtkmodules.vtkCommonDataModel import vtkImplicitFunction

# Coarse values: a case needs a fraction of a second.
BASE = {
    "VoxelSize": 0.15,
    "Attraction": 4.0,
    "MaximumNumberOfActiveVoxels": 60000,
    "MaximumNumberOfSubsteps": 30,
}
BOX = (-1.0, 1.0, -1.0, 1.0, -1.0, 1.0)
# Values instead of those from values_of_properties().
SPECIAL = {
    "VoxelSize": (0.1, 0.15, 0.2),
    "MaximumNumberOfActiveVoxels": (300, 3000, 60000),
    "NumberOfThreads": (1, 2, 3),
    "ModelBounds": (BOX, half_box(0.55), half_box(0.65)),
    "Transport": (0.0, 0.5, 1.0),
    "CFL": (0.3, 0.5, 1.0),
    "Anisotropy": (1.0, 2.0, 4.0, 9.0),
}
ROWS = rows_of(vtkActiveImplicitSurface)

# Values with which an update fails. Words stand for NaN and infinity, which have no literal.
REFUSED = (
    ("MaximumNumberOfActiveVoxels", 1),
    ("ModelBounds", (0.0, 1.0, 2.0, -2.0, 0.0, 1.0)),
    *(
        (row.name, value if math.isfinite(value) else str(value))
        for row in ROWS.values()
        for value in refused_values(row)
        if row.kind == "number"
    ),
)


def values_of_properties():
    """Values to draw from for each property that is no shape: those of SPECIAL, else the default
    and the values of test_restart.py, with twice and half of these for floats."""
    defaults = vtkActiveImplicitSurface()
    tried = {name: [value for _, value in cases] for name, cases in RESTARTS.items()}
    tried |= {name: [value] for name, (_, value) in DOES_NOT_RESTART.items()}
    found = {}
    for name, row in ROWS.items():
        if row.kind == "object":
            continue
        default = getattr(defaults, "Get" + name)()
        values = [default]
        for value in tried[name]:
            assert not isinstance(value, vtkImplicitFunction), name
            wide = isinstance(default, float)
            values += [value, 2 * value, value / 2] if wide else [value]
        found[name] = tuple(SPECIAL.get(name, values))
    return found


VALUES = values_of_properties()


def draw_shape(random, shapes, share=1.0):
    """A name and a seed, or None."""
    if random.random() >= share:
        return None
    return (random.choice(sorted(shapes)), random.randint(1, 10**6))


def draw_target(random):
    kinds = random.choice((PARTICLES, PARTICLES, FUNCTIONS, OTHERS, None))
    return draw_shape(random, [kind.__name__ for kind in kinds] if kinds else TARGETS)


def draw_change(random):
    name = random.choice(sorted(VALUES))
    return name, random.choice(VALUES[name])


def draw_properties(random, target):
    """Some properties, important ones more often."""
    properties = dict(draw_change(random) for _ in range(random.randint(0, 5)))
    if random.random() < 0.4:
        properties["TimeIntegration"] = random.choice((0, 1))
    if random.random() < 0.3:
        properties["Tension"] = random.choice(VALUES["Tension"])
    if random.random() < 0.3:
        properties["ParticleModel"] = random.randint(0, 1)
    if random.random() < 0.5:
        properties["ParticleSpacing"] = random.choice((0.2, 0.3))
    if random.random() < 0.3:
        properties["ComputeVelocity"] = 1
    if target[0] in {kind.__name__ for kind in FUNCTIONS}:
        properties.setdefault("ModelBounds", BOX)
    return properties


def draw_time(random):
    return random.choice(
        (
            0.1 * random.randint(0, 10),
            0.25 * random.randint(0, 4),
            random.uniform(-0.1, 1.2),
        )
    )


def draw_trouble(random):
    """An aborted, failing or refused operation during the motion to a time."""
    kind = random.choice(("abort", "fail", "refuse", "no target", "no file", "no folder", "damage"))
    if kind == "abort":
        return (kind, random.choice((1, 2, 4, 8, 16, 32)), draw_time(random))
    if kind == "refuse":
        return (kind, *random.choice(REFUSED), draw_time(random))
    return (kind, draw_time(random))


def draw_operation(random):
    draw = random.random()
    if draw < 0.45:
        return ("time", draw_time(random))
    if draw < 0.6:
        return ("put", *draw_change(random))
    if draw < 0.65:
        return ("piece", draw_time(random), random.randint(0, 2), 3)
    if draw < 0.7:
        return ("potential", draw_time(random))
    if draw < 0.75:
        return ("save and load",)
    if draw < 0.8:
        return ("initial", draw_shape(random, INITIALS, 0.7))
    if draw < 0.83:
        return ("obstacle", draw_shape(random, OBSTACLES, 0.5))
    return draw_trouble(random)


def draw_case(random):
    target = draw_target(random)
    return {
        "target": target,
        "initial": draw_shape(random, INITIALS, 0.4),
        "obstacle": draw_shape(random, OBSTACLES, 0.2),
        "properties": draw_properties(random, target),
        "operations": [draw_operation(random) for _ in range(random.randint(1, 6))]
        + [("time", draw_time(random))],
    }


def smaller_cases(case):
    """Cases that each omit one part of this one."""
    for i in range(len(case["operations"]) - 1):
        left = case["operations"][:i] + case["operations"][i + 1 :]
        yield {**case, "operations": left}
    for name in case["properties"]:
        left = {key: value for key, value in case["properties"].items() if key != name}
        yield {**case, "properties": left}
    for role in ("initial", "obstacle"):
        if case[role]:
            yield {**case, role: None}


def minimise(case, fails):
    """Reduces a failing case until it passes without any one of its parts. `fails` tries a case."""
    while True:
        for smaller in smaller_cases(case):
            if fails(smaller):
                case = smaller
                break
        else:
            return case
