# ctest: LABELS contract
"""Each property of the surface restarts the motion when it changes, unless its comment says that it
does not.

Without a restart, the skin would still be that of the old value. The old and the new value
therefore have to give different skins in the scene of each property.

Run: python3 test_restart.py
"""

import unittest

from active_implicit_surfaces import vtkActiveImplicitSurface
from contents import Contents, no_errors
from properties import needed_values, other_values, put, restarts, rows_of
from same_bytes import POINTS, make
from same_bytes_shapes import (
    Steps,
    ball,
    block,
    brick,
    cloud,
    image,
    quadric,
    scattered,
    strip,
    two_balls,
    union,
)
from vtkmodules.vtkParallelCore import vtkDummyController

BEFORE, THEN, LATER = 0.2, 0.4, 0.6
COARSE = 0.1
NODES = {"TimeIntegration": 1, "CreateParts": 1}


def morph(**properties):
    return make(two_balls(0.3, 0.4), ball(0.5), VoxelSize=COARSE, **properties)


# A function and another that contains it have the same MTime if the inner one has changed last.
INNER = ball(0.6)
OUTER = union(INNER, ball(0.4, (0.4, 0, 0)))


def inner_target():
    INNER.Modified()
    return make(INNER, ball(0.5), VoxelSize=COARSE)


def inner_initial():
    INNER.Modified()
    return make(ball(0.5), INNER, VoxelSize=COARSE)


def round_obstacle():
    return morph(ObstacleFunction=ball(0.3, (0, 0.3, 0)))


def one_step():
    return morph(NumberOfTimeSteps=1)


def volume_penalty():
    return morph(VolumeControl=1)


def volume_exact():
    return morph(VolumeControl=2)


def to_rest():
    return morph(EvolutionMode=1, RestTolerance=0.02)


def walls():
    return make(ball(0.8), ball(0.4), VoxelSize=COARSE, BoundedDomain=1, ModelBounds=half_box(0.55))


def half_box(side):
    return (-side, side, -0.6, 0.6, -0.6, 0.6)


def particles(**properties):
    weights = [1 - i / 40 for i in range(20)]
    target = cloud(scattered(20), size=[0.07 + i / 400 for i in range(20)], weight=weights)
    return make(target, VoxelSize=COARSE, KernelRadius=0.4, **properties)


def body_of_particles():
    target = cloud(scattered(60))
    return make(target, VoxelSize=COARSE, ParticleModel=1, ParticleSpacing=0.3)


def followed_particles():
    return crossing_particles(Attraction=-1)


def smoothed_particles():
    steps = {
        i * BEFORE: cloud([(x + 0.1 * i, y, z) for x, y, z in scattered(60)]) for i in range(5)
    }
    return make(Steps(steps), VoxelSize=COARSE, ParticleModel=1, ParticleSpacing=0.3, **NODES)


def tense_particles():
    return make(
        cloud(scattered(20)),
        VoxelSize=COARSE,
        ParticleSpacing=0.3,
        Tension=0.01,
        **NODES,
    )


def appearing_particles():
    here = [(0, 0, 0), (0.3, 0, 0)]
    steps = {i * BEFORE: cloud(here + [(2 + i, 0, 0)] * (i > 0)) for i in range(5)}
    return make(Steps(steps), VoxelSize=COARSE, KernelRadius=0.6, CreateParts=1)


def crossing_particles(**properties):
    """Particles move straight if matched by index, and oscillate if matched by name."""
    steps = {}
    for i in range(5):
        names = [i % 2, 1 - i % 2]
        steps[i * BEFORE] = cloud([(-0.3, i / 10, 0), (0.3, i / 10, 0)], name=names)
    properties = {"Attraction": 15, **NODES, **properties}
    return make(Steps(steps), VoxelSize=COARSE, KernelRadius=0.6, **properties)


def crossing_by_substeps():
    return crossing_particles(TimeIntegration=0)


def particles_with_velocity():
    return crossing_particles(ComputeVelocity=1)


def shell():
    return make(strip(), VoxelSize=COARSE, MeshThickness=0.35)


def samples():
    target = image(quadric(1, 2, 1), G=quadric(2, 1, 1))
    return make(target, image(quadric(1, 1, 1), G=quadric(3, 1, 2)), VoxelSize=COARSE)


ROWS = rows_of(vtkActiveImplicitSurface)
# (scene, another value) for properties for which the rules of cases_of() have none.
CASES = {
    "Anisotropy": [(body_of_particles, 1.0)],
    "Attraction": [(morph, 2.0), (followed_particles, 1.0)],
    "BoundedDomain": [(walls, 0)],
    "CreateParts": [(appearing_particles, 0)],
    "EvolutionMode": [(morph, 1), (one_step, 1)],
    "InitialFunction": [(morph, ball(0.6)), (morph, None)],
    "InvertTarget": [(samples, 1)],
    "KernelRadius": [(particles, 0.5), (particles, -1.0)],
    "NumberOfTimeSteps": [(morph, 3)],
    "MaximumNumberOfSubsteps": [(to_rest, 3)],
    "MeshThickness": [(shell, 0.45)],
    "ModelBounds": [(walls, half_box(0.65))],
    "ObstacleFunction": [(morph, ball(0.3, (0, 0.3, 0))), (round_obstacle, None)],
    "ParticleModel": [(particles, 1), (body_of_particles, 0)],
    "ParticleSpacing": [(body_of_particles, 0.2), (body_of_particles, -1.0)],
    "ParticleThreshold": [(particles, 0.4)],
    "PeriodicBounds": [(body_of_particles, (-1.0, 1.0, -1.0, 1.0, 1.0, -1.0))],
    "RestTolerance": [(to_rest, 0.5)],
    "TargetFunction": [(morph, block(-0.5, 0.5, -0.4, 0.4, -0.3, 0.3))],
    "TargetIsoValue": [(morph, -0.03), (samples, 0.1)],
    "TargetNoise": [(morph, 0.05), (smoothed_particles, 0.0)],
    "TargetVolume": [(volume_penalty, 0.6), (volume_exact, 0.6)],
    "Tension": [(morph, 0.05), (smoothed_particles, 0.0)],
    "TensionWeighting": [(tense_particles, 0)],
    "TimeIntegration": [(smoothed_particles, 0)],
    "Transport": [(crossing_particles, 0.5)],
    # These do not restart it.
    "CheckpointMemory": [(morph, 0)],
    "Controller": [(morph, vtkDummyController())],  # of one process
    "PassTargetArrays": [(crossing_particles, 1)],
    "TangentialVelocity": [(particles_with_velocity, 0)],
}


def cases_of(row):
    """Returns pairs (scene, another value) for a property. Without an entry in CASES, the scene is
    of particles (group Particles) or a morph, with values of other properties that this property
    needs."""
    if row.name in CASES:
        return CASES[row.name]
    plain = particles if row.group == "Particles" else morph

    def scene():
        return plain(**needed_values(row))

    return [(scene, value) for value in other_values(row)]


RESTARTS = {name: cases_of(row) for name, row in ROWS.items() if restarts(row)}
DOES_NOT_RESTART = {name: cases_of(row)[0] for name, row in ROWS.items() if not restarts(row)}


def change_of(name, value):
    return lambda surface: put(surface, name, value)


def choose_array(number, name):
    port = int(number == 4)
    return lambda surface: surface.SetInputArrayToProcess(number, port, 0, POINTS, name)


def move_a_particle(surface):
    data = surface.GetInputDataObject(0, 0)
    data.GetPoints().SetPoint(0, 0.7, 0, 0)
    data.GetPoints().Modified()
    data.Modified()


# Other changes that restart the motion: (scene, change).
OTHER_CHANGES = {
    "array of radii": (particles, choose_array(0, "size")),
    "array of ids": (crossing_by_substeps, choose_array(1, "name")),
    "array of strengths": (particles, choose_array(2, "weight")),
    "array of values": (samples, choose_array(3, "G")),
    "array of values at the start": (samples, choose_array(4, "G")),
    "the target function itself": (
        morph,
        lambda surface: surface.GetTargetFunction().SetOperationTypeToIntersection(),
    ),
    "a target function as old": (inner_target, lambda surface: surface.SetTargetFunction(OUTER)),
    "an initial function as old": (
        inner_initial,
        lambda surface: surface.SetInitialFunction(OUTER),
    ),
    "the initial function itself": (
        morph,
        lambda surface: surface.GetInitialFunction().SetRadius(0.55),
    ),
    "the obstacle itself": (
        round_obstacle,
        lambda surface: surface.GetObstacleFunction().SetRadius(0.35),
    ),
    "the target data": (particles, move_a_particle),
    "other target data": (particles, lambda surface: surface.SetInputDataObject(0, brick())),
    "an initial shape": (particles, lambda surface: surface.SetInputDataObject(1, brick())),
    "no initial shape": (samples, lambda surface: surface.RemoveAllInputConnections(1)),
    "other initial data": (samples, lambda surface: surface.SetInputDataObject(1, brick())),
}


def update(surface, time):
    with no_errors(surface):
        surface.UpdateTimeStep(time)


def content(surface):
    found = Contents()
    found.outputs(surface)
    return found.hash()


def shape(surface):
    """Hash of points and triangles, without the arrays that properties of outputs control."""
    skin, bare = surface.GetOutput(), Contents()
    copied = type(skin)()
    copied.SetPoints(skin.GetPoints())
    copied.SetPolys(skin.GetPolys())
    bare.skin(copied)
    return bare.hash()


class Restart(unittest.TestCase):
    def assert_restarts(self, scene, change):
        old, fresh, surface = scene(), scene(), scene()
        change(fresh)
        update(old, THEN)
        update(fresh, THEN)
        self.assertNotEqual(content(old), content(fresh), "the change has no effect on the scene")

        update(surface, BEFORE)
        change(surface)
        surface.ResetCounters()
        update(surface, THEN)
        self.assertEqual(surface.GetSubsteps(), fresh.GetSubsteps(), "substeps since the start")
        self.assertEqual(content(surface), content(fresh), "what a new surface shows")

    def test_every_property_is_tried(self):
        self.assertEqual({name for name, cases in RESTARTS.items() if not cases}, set())
        self.assertLessEqual(set(CASES), set(ROWS))
        self.assertGreater(min(len(RESTARTS), 4 * len(DOES_NOT_RESTART)), 40)

    def test_what_shapes_the_motion_restarts_it(self):
        for name, cases in RESTARTS.items():
            for scene, value in cases:
                with self.subTest(name, scene=scene.__name__, value=value):
                    self.assert_restarts(scene, change_of(name, value))

    def test_other_changes_restart_it(self):
        for name, (scene, change) in OTHER_CHANGES.items():
            with self.subTest(name):
                self.assert_restarts(scene, change)

    def assert_goes_on(self, name, scene, value):
        surface, fresh = scene(), scene()
        update(surface, THEN)
        bare, whole = shape(surface), content(surface)
        put(surface, name, value)
        surface.ResetCounters()
        update(surface, THEN)
        self.assertEqual(surface.GetSubsteps(), 0)
        self.assertEqual(shape(surface), bare)
        makes_arrays = ROWS[name].group == "Output" and name != "OutputPotential"
        self.assertEqual(content(surface) != whole, makes_arrays, "what is made of the skin")

        put(fresh, name, value)
        update(fresh, THEN)
        fresh.ResetCounters()
        for either in (surface, fresh):
            update(either, LATER)
        self.assertGreater(surface.GetSubsteps(), 0)
        self.assertEqual(surface.GetSubsteps(), fresh.GetSubsteps(), "substeps from then on")
        self.assertEqual(content(surface), content(fresh))

    def test_what_does_not_shape_the_motion_does_not_restart_it(self):
        for name, (scene, value) in DOES_NOT_RESTART.items():
            with self.subTest(name):
                self.assert_goes_on(name, scene, value)

    def test_a_change_taken_back_does_not_restart_it(self):
        for name, cases in RESTARTS.items():
            scene, value = cases[0]
            with self.subTest(name):
                surface = scene()
                update(surface, THEN)
                old = getattr(surface, "Get" + name)()
                put(surface, name, value)
                put(surface, name, old)
                surface.ResetCounters()
                update(surface, THEN)
                self.assertEqual(surface.GetSubsteps(), 0)


if __name__ == "__main__":
    unittest.main()
