# ctest: LABELS contract
"""vtkActiveImplicitSurface from Python: time, garbage collection, and released objects.

Run: python3 test_filter.py
"""

import gc
import math
import unittest
import weakref

from active_implicit_surfaces import vtkActiveImplicitSurface
from listener import Listener
from same_bytes_shapes import ball
from shapes import bytes_of, make_points, surface_in_box
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonCore import vtkIntArray
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData, vtkTable
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
from vtkmodules.vtkFiltersSources import vtkSphereSource


def make_shrinking_ball():
    return surface_in_box(InitialFunction=ball(0.6), TargetFunction=ball(0.4), VoxelSize=0.0625)


class Travellers(VTKPythonAlgorithmBase):
    """Two particles that move apart, in steps; records the times of its executions."""

    def __init__(self, steps):
        super().__init__(nInputPorts=0, outputType="vtkPolyData")
        self.steps = steps
        self.speed = 0.1
        self.executions = []

    def RequestInformation(self, request, inputs, outputs):
        information = outputs.GetInformationObject(0)
        information.Set(Pipeline.TIME_STEPS(), self.steps, len(self.steps))
        information.Set(Pipeline.TIME_RANGE(), [self.steps[0], self.steps[-1]], 2)
        return 1

    def RequestData(self, request, inputs, outputs):
        time = outputs.GetInformationObject(0).Get(Pipeline.UPDATE_TIME_STEP())
        self.executions.append(time)
        way = 0.1 + self.speed * time
        data = make_points([(-way, 0, 0), (way, 0, 0)])
        ids = vtkIntArray()
        ids.SetName("id")
        ids.InsertNextValue(5)
        ids.InsertNextValue(3)
        data.GetPointData().AddArray(ids)
        output = vtkPolyData.GetData(outputs, 0)
        output.ShallowCopy(data)
        output.GetInformation().Set(output.DATA_TIME_STEP(), time)
        return 1


def make_skin_over(source):
    surface = vtkActiveImplicitSurface()
    surface.SetInputConnection(source.GetOutputPort())
    surface.SetInputArrayToProcess(1, 0, 0, 0, "id")
    surface.SetKernelRadius(0.3)
    surface.SetParticleSpacing(0.2)
    surface.SetVoxelSize(0.05)
    surface.SetAttraction(10)
    return surface


class Time(unittest.TestCase):
    def test_a_loop_over_the_steps_asks_for_each_once(self):
        source = Travellers([0.0, 1.0, 2.0, 3.0])
        surface = make_skin_over(source)
        surface.UpdateInformation()
        steps = surface.GetOutputInformation(0).Get(Pipeline.TIME_STEPS())
        self.assertEqual(list(steps), [0.0, 1.0, 2.0, 3.0])
        lengths = []
        for step in steps:
            surface.UpdateTimeStep(step)
            lengths.append(surface.GetOutput().GetLength())
        self.assertEqual(source.executions, [0.0, 1.0, 2.0, 3.0])
        self.assertEqual(lengths, sorted(set(lengths)))

    def test_an_earlier_time_gives_the_same_again(self):
        surface = make_skin_over(Travellers([0.0, 1.0, 2.0]))
        surface.UpdateTimeStep(0.5)
        length = surface.GetOutput().GetLength()
        surface.UpdateTimeStep(2.0)
        self.assertNotEqual(surface.GetOutput().GetLength(), length)
        surface.UpdateTimeStep(0.5)
        self.assertEqual(surface.GetOutput().GetLength(), length)

    def test_a_change_of_the_source_starts_anew(self):
        source = Travellers([0.0, 1.0, 2.0])
        surface = make_skin_over(source)
        surface.UpdateTimeStep(2.0)
        source.speed = 0.05
        source.Modified()
        surface.UpdateTimeStep(2.0)
        self.assertEqual(source.executions, [0.0, 1.0, 2.0] * 2)

    def test_counters_tell_what_a_step_costs(self):
        surface = make_shrinking_ball()
        surface.UpdateTimeStep(0.1)
        self.assertGreater(surface.GetTargetEvaluations(), 0)
        self.assertGreater(surface.GetSubsteps(), 0)
        surface.ResetCounters()
        self.assertEqual(surface.GetTargetEvaluations(), 0)
        surface.ComputeNormalsOff()
        surface.UpdateTimeStep(0.1)
        self.assertEqual(surface.GetSubsteps(), 0)


AUTOMATIC = (
    "VoxelSize ParticleSpacing KernelRadius TargetReach Attraction Tension TargetNoise".split()
)


class ValuesInUse(unittest.TestCase):
    def values_of(self, surface):
        return [getattr(surface, f"Get{name}InUse")() for name in AUTOMATIC]

    def test_what_is_set_is_in_use(self):
        surface = make_shrinking_ball()
        self.assertEqual(self.values_of(surface), [0.0] * len(AUTOMATIC), "before an update")
        surface.SetTargetReach(0.7)
        surface.SetAttraction(3.0)
        surface.SetTargetNoise(0.01)
        surface.UpdateTimeStep(0.1)
        set_values = [max(getattr(surface, "Get" + name)(), 0.0) for name in AUTOMATIC]
        self.assertEqual(self.values_of(surface), set_values)
        surface.SetVoxelSize(2.0 * surface.GetVoxelSize())
        self.assertEqual(self.values_of(surface), set_values, "of the skin that is there")

    def test_what_is_left_to_the_filter(self):
        steps = [0.0, 0.5, 2.5]
        source = Travellers(steps)
        surface = vtkActiveImplicitSurface()
        surface.SetInputConnection(source.GetOutputPort())
        surface.SetParticleSpacing(0.25)
        for time, length in ((0.5, 0.5), (1.0, 2.0), (2.5, 2.0)):
            surface.UpdateTimeStep(time)
            voxel, spacing, radius, reach, attraction, tension, noise = self.values_of(surface)
            self.assertEqual((voxel, spacing, noise), (0.125, 0.25, 0.0625), time)
            self.assertEqual((radius, reach), (2.25 * 0.25, 0.75), time)
            self.assertAlmostEqual(attraction, 6.0 / length, msg=f"by the step's length, {time}")
            self.assertAlmostEqual(tension, attraction * 0.125**2 / 2.0, msg=f"r^2 / 2, {time}")


class Observers(unittest.TestCase):
    """Observers' calls that would remove objects in use by the update are refused with an error
    message."""

    def check(self, make, event, expected):
        calls = {
            "ResetTrajectory": lambda surface: surface.ResetTrajectory(),
            "LoadState": lambda surface: surface.LoadState("none.vdb"),
            "Advance": lambda surface: surface.Advance(make_points([(0, 0, 0)]), 0.1),
        }
        for name, call in calls.items():
            with self.subTest(name, event=event):
                surface = make()
                listener = Listener(surface)

                def observe(caller, _, call=call):
                    if event != "ProgressEvent" or 0 < caller.GetProgress() < 1:
                        call(caller)

                surface.AddObserver(event, observe)
                surface.UpdateTimeStep(0.5)
                self.assertIn(f"{name} was called by an observer", listener.errors[0])
                self.assertEqual(bytes_of(surface), expected)

    def test_of_progress(self):
        reference = make_shrinking_ball()
        reference.UpdateTimeStep(0.5)
        self.check(make_shrinking_ball, "ProgressEvent", bytes_of(reference))

    def test_of_a_warning(self):
        source = Travellers([0.0, 1.0])

        def make():
            surface = vtkActiveImplicitSurface()
            surface.SetInputConnection(source.GetOutputPort())
            return surface

        reference = make()
        reference.AddObserver("WarningEvent", lambda *_: None)
        reference.UpdateTimeStep(0.5)
        self.check(make, "WarningEvent", bytes_of(reference))


class Failures(unittest.TestCase):
    def test_the_skin_function_is_that_of_the_skin_that_is_left(self):
        class Failing(Travellers):
            def RequestData(self, request, inputs, outputs):
                information = outputs.GetInformationObject(0)
                fails = information.Get(Pipeline.UPDATE_TIME_STEP()) > 0
                return 0 if fails else super().RequestData(request, inputs, outputs)

        source = Failing([0.0, 1.0])
        surface = make_skin_over(source)
        listeners = [Listener(source), Listener(surface)]
        surface.UpdateTimeStep(0.0)
        surface.UpdateTimeStep(1.0)
        self.assertGreater(surface.GetOutput().GetNumberOfPoints(), 0)
        self.assertLess(surface.GetSkinFunction().FunctionValue(0.1, 0, 0), 0)
        self.assertEqual([listener.errors for listener in listeners], [[], []])


class Outputs(unittest.TestCase):
    def test_skin_and_potential(self):
        surface = make_shrinking_ball()
        surface.OutputPotentialOn()
        surface.Update()
        skin = surface.GetOutput()
        self.assertIsInstance(skin, vtkPolyData)
        self.assertEqual(skin.GetPointData().GetNormals().GetName(), "Normals")
        self.assertEqual(skin.GetNumberOfCells(), skin.GetNumberOfPolys())
        potential = surface.GetPotential()
        self.assertIsInstance(potential, vtkImageData)
        self.assertEqual(potential.GetPointData().GetScalars().GetName(), "Potential")

    def test_without_normals(self):
        surface = make_shrinking_ball()
        surface.ComputeNormalsOff()
        surface.Update()
        self.assertIsNone(surface.GetOutput().GetPointData().GetNormals())


class Garbage(unittest.TestCase):
    def assert_says(self, surface, words):
        listener = Listener(surface)
        surface.Update()
        self.assertEqual(len(listener.errors), 1)
        self.assertIn(words, listener.errors[0])
        self.assertEqual(surface.GetOutput().GetNumberOfPoints(), 0)

    def test_nothing_at_all(self):
        self.assert_says(vtkActiveImplicitSurface(), "There is no target")

    def test_two_targets(self):
        surface = make_shrinking_ball()
        surface.SetInputData(make_points([(0, 0, 0)]))
        self.assert_says(surface, "There are two targets")

    def test_a_table(self):
        surface = vtkActiveImplicitSurface()
        surface.SetInputDataObject(vtkTable())
        surface.GetExecutive().AddObserver("ErrorEvent", lambda caller, event: None)
        surface.Update()
        self.assertEqual(surface.GetOutput().GetNumberOfPoints(), 0)

    def test_an_image_without_values(self):
        image = vtkImageData()
        image.SetDimensions(3, 3, 3)
        surface = vtkActiveImplicitSurface()
        surface.SetInputData(image)
        self.assert_says(surface, "no active point scalars")

    def test_two_initial_shapes(self):
        mesh = vtkSphereSource()
        surface = make_shrinking_ball()
        surface.SetInputConnection(1, mesh.GetOutputPort())
        self.assert_says(surface, "There are two initial shapes")

    def test_a_function_without_bounds(self):
        surface = vtkActiveImplicitSurface()
        surface.SetTargetFunction(ball(0.5))
        self.assert_says(surface, "set ModelBounds")

    def test_an_array_that_is_not_there(self):
        surface = vtkActiveImplicitSurface()
        surface.SetInputData(make_points([(0, 0, 0), (0.1, 0, 0)]))
        surface.SetInputArrayToProcess(0, 0, 0, 0, "radii")
        self.assert_says(surface, 'array "radii"')

    def test_no_points(self):
        for data in (vtkPolyData(), make_points([])):
            surface = vtkActiveImplicitSurface()
            surface.SetInputData(data)
            listener = Listener(surface)
            surface.UpdateTimeStep(0.5)
            self.assertEqual(listener.errors, [])
            self.assertEqual(len(listener.warnings), 1)
            self.assertIn("The target is empty", listener.warnings[0])

    def test_points_that_are_no_numbers(self):
        surface = vtkActiveImplicitSurface()
        surface.SetInputData(make_points([(math.nan, 0, 0)] * 3))
        listener = Listener(surface)
        surface.Update()
        self.assertEqual(listener.errors, [])
        self.assertIn("3 particles are left out", listener.warnings[0])
        self.assertEqual(surface.GetOutput().GetNumberOfPoints(), 0)

    def test_points_at_the_end_of_the_world(self):
        surface = vtkActiveImplicitSurface()
        surface.SetInputData(make_points([(1e30, 0, 0), (0, 0, 0)]))
        surface.SetKernelRadius(1)
        surface.SetVoxelSize(0.1)
        self.assert_says(surface, "VoxelSize")


class Lifetime(unittest.TestCase):
    def test_everything_is_let_go(self):
        shape = ball(0.5)
        count = shape.GetReferenceCount()
        surface = make_shrinking_ball()
        surface.SetTargetFunction(shape)
        surface.Update()
        self.assertGreater(shape.GetReferenceCount(), count)
        reference = weakref.ref(surface)
        del surface
        gc.collect()
        self.assertIsNone(reference())
        self.assertEqual(shape.GetReferenceCount(), count)

    def test_the_skin_outlives_the_filter(self):
        surface = make_shrinking_ball()
        surface.Update()
        skin = surface.GetOutput()
        count = skin.GetNumberOfPolys()
        del surface
        gc.collect()
        self.assertGreater(count, 0)
        self.assertEqual(skin.GetNumberOfPolys(), count)

    def test_the_same_data_may_change(self):
        data = make_points([(0, 0, 0), (0.2, 0, 0)])
        surface = vtkActiveImplicitSurface()
        surface.SetInputData(data)
        surface.SetKernelRadius(0.3)
        surface.Update()
        length = surface.GetOutput().GetLength()
        data.GetPoints().SetPoint(1, 0.3, 0, 0)
        data.GetPoints().Modified()
        surface.Update()
        self.assertGreater(surface.GetOutput().GetLength(), length)


if __name__ == "__main__":
    unittest.main()
