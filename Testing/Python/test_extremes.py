# ctest: LABELS contract long TIMEOUT 900
"""Absurd values of every property of the three classes, before the first update and after one.

Each value is refused with one error that names the property, or clamped as its comment documents,
or accepted. The result is a closed skin of finite points, or an empty one and a warning. Nothing
crashes, hangs or exhausts the memory. The name of each case is printed before it runs, so that the
last name identifies a crash.

Run: python3 test_extremes.py
"""

import faulthandler
import math
import re
import resource
import signal
import time
import unittest

import numpy
from active_implicit_surfaces import (
    vtkActiveImplicitSurface,
    vtkGridPotential,
    vtkSkeletonPotential,
)
from extreme_scenes import (
    SCENES,
    VOXEL,
    ball_to_ball,
    image,
    make_image,
    particles,
    tension_to_rest,
    to_rest,
)
from listener import Listener
from properties import comment_of, get, own_properties, put
from sanitized import SLOWNESS, limit_memory
from shapes import output_of, points_of
from skin_checks import is_closed
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersSources import vtkLineSource, vtkPlaneSource, vtkSphereSource

MEMORY = 4 << 30  # bytes of address space
LONGEST = 2.0 * SLOWNESS  # processor time limit of a case [s]
HANGS = 30 * SLOWNESS  # processor time after which the test ends itself [s]

INT_MAX = 2**31 - 1
NUMBERS = (0.0, -0.0, -1.0, 1e-300, -1e-300, 1e300, -1e300, math.nan, math.inf, -math.inf)
INTEGERS = (0, -1, 1, INT_MAX, -INT_MAX - 1)
NAMES = (None, "", "absent")

FIRST, LATER = 0.1, 0.2
# Words that errors use instead of a property's name.
NAMES_FOR = {"ScalarArrayName": "array", "RadiusArrayName": "array", "StrengthArrayName": "array"}


def extremes_of(default):
    """Absurd values for a property with this present value; none for functions and data."""
    if isinstance(default, float):
        yield from NUMBERS
    elif isinstance(default, int):
        yield from INTEGERS
    elif isinstance(default, str):
        yield from NAMES
    elif isinstance(default, tuple):
        for i in range(len(default)):
            for number in NUMBERS:
                yield (*default[:i], number, *default[i + 1 :])
    elif default is not None and not hasattr(default, "IsA"):
        raise AssertionError(f"no extremes are known for {default!r}")


def documented_bounds(kind, name):
    comment = " ".join(comment_of(kind, name).split())
    if ", or -1, automatic:" in comment:
        return -1.0, math.inf
    told = re.search(r"Range: (\d+) to (\d+)", comment)
    if told:
        return float(told[1]), float(told[2])
    told = re.search(r"Range: >= (\d+)", comment)
    if told:
        return float(told[1]), math.inf
    values = [float(value) for value in re.findall(r"\((\d)\)", comment)]
    return (min(values), max(values)) if values else (math.nan, math.nan)


def end_if_it_hangs():
    """Limits processor time, which is independent of other load."""
    end = int(time.process_time()) + HANGS
    resource.setrlimit(resource.RLIMIT_CPU, (end, resource.RLIM_INFINITY))


class Case(unittest.TestCase):
    def setUp(self):
        faulthandler.register(signal.SIGXCPU, chain=True)
        end_if_it_hangs()

    def begin(self, *words):
        print(*words, flush=True)
        end_if_it_hangs()
        return self.subTest(" ".join(str(word) for word in words))

    def assert_is_clamped(self, thing, name, value):
        """Checks that a changed value is the bound in the comment."""
        got = get(thing, name)
        if got == value or value is None or not isinstance(value, (int, float)):
            return
        if math.isnan(value):
            self.assertTrue(math.isnan(got))
            return
        least, largest = documented_bounds(type(thing), name)
        bound = least if value < least else largest
        if bound == math.inf:
            self.assertTrue(1e299 <= got < math.inf or got >= INT_MAX)
        else:
            self.assertEqual(got, bound)

    def assert_is_sane(self, surface):
        skin = surface.GetOutput()
        self.assertTrue(numpy.isfinite(points_of(skin)).all(), "a point is not finite")
        normals = skin.GetPointData().GetNormals()
        if normals:
            self.assertTrue(numpy.isfinite(vtk_to_numpy(normals)).all(), "normals are not finite")
        self.assertTrue(is_closed(skin), "not closed")
        if surface.GetOutputPotential():
            values = surface.GetPotential().GetPointData().GetScalars()
            self.assertTrue(numpy.isfinite(vtk_to_numpy(values)).all(), "potential is not finite")
        history = surface.GetHistory()
        for name in ("Time", "Area", "Volume", "MaxSpeed"):
            column = vtk_to_numpy(history.GetColumnByName(name))
            self.assertTrue(numpy.isfinite(column).all(), f"{name} of the history: {column}")

    def assert_is_refused(self, surface, listener, *names):
        self.assertEqual(len(listener.errors), 1)
        for name in names:
            self.assertIn(name, listener.errors[0])
        self.assertEqual(surface.GetOutput().GetNumberOfPoints(), 0)
        self.assertEqual(surface.GetPotential().GetNumberOfPoints(), 0)
        self.assertEqual(surface.GetHistory().GetNumberOfRows(), 0)

    def update(self, surface, listener, pipeline_time):
        listener.forget()
        began = time.process_time()
        surface.UpdateTimeStep(pipeline_time)
        self.assertLess(time.process_time() - began, LONGEST)

    def check(self, surface, listener, name, pipeline_time=LATER):
        """Updates, and returns true if the update is refused."""
        self.update(surface, listener, pipeline_time)
        if listener.errors:
            self.assert_is_refused(surface, listener, name)
            return True
        self.assert_is_sane(surface)
        if surface.GetOutput().GetNumberOfPoints() == 0:
            self.assertTrue(listener.warnings, "no skin, and no word")
        return False


class OfTheSurface(Case):
    """Each property of the filter in one scene, and some again in scenes where they matter."""

    def go_through(self, make, names):
        self.reference = make()
        Listener(self.reference)
        self.reference.UpdateTimeStep(LATER)
        self.assertGreater(self.reference.GetOutput().GetNumberOfPoints(), 0)
        for name in names:
            for value in extremes_of(get(self.reference, name)):
                for when in ("before", "after"):
                    with self.begin(make.__name__, name, value, when):
                        self.try_value(make, name, value, when)

    def try_value(self, make, name, value, when):
        surface = make()
        listener = Listener(surface)
        if when == "after":
            surface.UpdateTimeStep(FIRST)
        put(surface, name, value)
        self.assert_is_clamped(surface, name, value)
        if self.check(surface, listener, name):
            put(surface, name, get(self.reference, name))
            self.update(surface, listener, LATER)
            self.assertEqual(listener.errors, [])
            self.assertEqual(
                points_of(surface.GetOutput()).tobytes(),
                points_of(self.reference.GetOutput()).tobytes(),
            )

    def test_every_property(self):
        self.go_through(ball_to_ball, own_properties(vtkActiveImplicitSurface))

    def test_properties_where_they_matter(self):
        for make, names in SCENES.items():
            self.go_through(make, names.split())


class OfThePotentials(Case):
    """Each property of the implicit functions: finite values, or one error that names the
    property."""

    PLACES = ((0, 0, 0), (0.3, 0.1, 0.2), (0.5, 0, 0), (7, 0, 0))

    def evaluate(self, function):
        began = time.process_time()
        numbers = []
        for place in self.PLACES:
            gradient = [0.0, 0.0, 0.0]
            numbers.append(function.EvaluateFunction(place))
            function.EvaluateGradient(place, gradient)
            numbers.extend(gradient)
        self.assertLess(time.process_time() - began, LONGEST)
        return numbers

    def go_through(self, kind, data):
        def make():
            function = kind()
            function.SetInput(data)
            if kind is vtkGridPotential:
                function.SetVoxelSize(VOXEL)
            return function

        reference = make()
        expected = self.evaluate(reference)
        for name in own_properties(kind):
            for value in extremes_of(get(reference, name)):
                for when in ("before", "after"):
                    with self.begin(kind.__name__, data.__class__.__name__, name, value, when):
                        function = make()
                        listener = Listener(function)
                        if when == "after":
                            self.evaluate(function)
                        put(function, name, value)
                        self.assert_is_clamped(function, name, value)
                        numbers = self.evaluate(function)
                        if listener.errors:
                            self.assertEqual(len(listener.errors), 1)
                            self.assertRegex(listener.errors[0], NAMES_FOR.get(name, name))
                        else:
                            self.assertTrue(numpy.isfinite(numbers).all(), numbers)
                        listener.forget()
                        put(function, name, get(reference, name))
                        self.assertEqual(self.evaluate(function), expected)
                        self.assertEqual(listener.errors, [])

    def test_the_skeleton_of_a_line(self):
        self.go_through(vtkSkeletonPotential, output_of(vtkLineSource()))

    def test_the_distance_to_a_mesh(self):
        self.go_through(vtkGridPotential, output_of(vtkSphereSource()))

    def test_the_shell_of_an_open_mesh(self):
        self.go_through(vtkGridPotential, output_of(vtkPlaneSource()))

    def test_the_samples_of_an_image(self):
        self.go_through(vtkGridPotential, output_of(make_image()))


class Together(Case):
    """Absurd values in selected combinations and positions."""

    def assert_survives(self, make, words, change, *times):
        with self.begin(make.__name__, *words):
            surface = make()
            listener = Listener(surface)
            change(surface)
            for pipeline_time in times or (LATER,):
                self.check(surface, listener, words[0], pipeline_time)
            return surface, listener

    def test_times_that_are_no_numbers_or_far(self):
        for pipeline_time in (*NUMBERS, 1e-320):
            with self.begin("time", pipeline_time):
                surface = ball_to_ball()
                surface.SetNumberOfTimeSteps(3)
                listener = Listener(surface)
                for asked in (pipeline_time, FIRST, pipeline_time):
                    self.update(surface, listener, asked)
                    self.assertEqual(listener.errors, [])
                    self.assert_is_sane(surface)
                steps = 2 if pipeline_time > 0.2 else 0
                self.assertEqual(surface.GetHistory().GetNumberOfRows(), steps + 1)

    def test_arrays_that_are_not_there(self):
        for make, index in ((particles, 0), (particles, 1), (particles, 2), (image, 3)):
            for association in (0, 1, 2, 3):
                with self.begin("array", make.__name__, index, association):
                    surface = make()
                    listener = Listener(surface)
                    surface.SetInputArrayToProcess(index, 0, 0, association, "absent")
                    self.assertTrue(self.check(surface, listener, "SetInputArrayToProcess"))
                    surface.SetInputArrayToProcess(index, 0, 0, 0, "")
                    self.assertFalse(self.check(surface, listener, ""))

    def test_bounds(self):
        for size in (0, 1e-320, 1e-300, 1e-31, 1e31, 1e300):
            for voxel in (-1, VOXEL):
                self.assert_survives(
                    ball_to_ball,
                    ("ModelBounds", "of size", size, "voxels", voxel),
                    lambda surface, size=size, voxel=voxel: (
                        surface.SetModelBounds(-size, size, -size, size, -size, size),
                        surface.SetVoxelSize(voxel),
                    ),
                )

    def test_the_last_of_many_or_absurd_steps(self):
        for name, value in (("TimeStepSize", 1e300), ("TimeStepSize", 1e-300)):
            self.assert_survives(
                ball_to_ball,
                (name, value),
                lambda surface, name=name, value=value: put(surface, name, value),
                1e308,
            )
        surface = ball_to_ball()
        listener = Listener(surface)
        surface.SetNumberOfTimeSteps(INT_MAX)
        self.update(surface, listener, LATER)
        self.assertEqual(listener.errors, [])
        self.assert_is_sane(surface)

    def test_motion_times_beyond_numbers(self):
        for start, size, scale in ((0, 1e300, 1e300), (-1.7e308, 1e307, 1e10), (0, 1e-300, 1e-300)):
            _, listener = self.assert_survives(
                ball_to_ball,
                ("TimeScale", start, size, scale),
                lambda surface, start=start, size=size, scale=scale: (
                    surface.SetStartTime(start),
                    surface.SetTimeStepSize(size),
                    surface.SetTimeScale(scale),
                ),
                1e308,
            )
            self.assertEqual(len(listener.errors), 1 if scale > 1 else 0, listener.errors)

    def test_a_small_fraction_of_the_stable_step(self):
        for attraction in (0, 4):
            for value in (1e-300, 1e-7, 1e-6):
                for make in (ball_to_ball, to_rest):
                    self.assert_survives(
                        make,
                        ("CFL", value, "Attraction", attraction),
                        lambda surface, value=value, attraction=attraction: (
                            surface.SetCFL(value),
                            surface.SetAttraction(attraction),
                        ),
                        FIRST,
                    )

    def test_no_tolerance_ends_by_the_substeps(self):
        surface, listener = self.assert_survives(
            tension_to_rest, ("RestTolerance", 0), lambda surface: surface.SetRestTolerance(0)
        )
        self.assertIn("MaximumNumberOfSubsteps", "".join(listener.warnings))
        self.assertEqual(surface.GetSubsteps(), 20)


if __name__ == "__main__":
    limit_memory(MEMORY)
    unittest.main()
