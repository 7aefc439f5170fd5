# ctest: LABELS contract
"""vtkSkeletonPotential from Python: properties, errors, and a contour of its samples."""

import math
import re
import unittest

from active_implicit_surfaces import vtkSkeletonPotential
from listener import Listener
from shapes import make_points
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkCommonDataModel import vtkCellArray
from vtkmodules.vtkFiltersCore import vtkContourFilter
from vtkmodules.vtkImagingHybrid import vtkSampleFunction

NUMBERS = ["Radius", "Threshold"]
PROPERTIES = [*NUMBERS, "Input", "RadiusArrayName", "StrengthArrayName", "Kernel"]


def add_array(data, name, values):
    array = vtkDoubleArray()
    array.SetName(name)
    for value in values:
        array.InsertNextValue(value)
    data.GetPointData().AddArray(array)


def join(data, ids):
    lines = vtkCellArray()
    lines.InsertNextCell(len(ids))
    for point in ids:
        lines.InsertCellPoint(point)
    data.SetLines(lines)


class SkeletonPotential(unittest.TestCase):
    def test_defaults(self):
        potential = vtkSkeletonPotential()
        self.assertIsNone(potential.GetInput())
        self.assertEqual(potential.GetRadius(), 1.0)
        self.assertEqual(potential.GetThreshold(), 0.5)
        self.assertEqual(potential.GetKernel(), vtkSkeletonPotential.WYVILL)
        self.assertFalse(potential.GetRadiusArrayName())
        self.assertFalse(potential.GetStrengthArrayName())

    def test_comments_tell_the_defaults(self):
        for name in PROPERTIES:
            with self.subTest(name):
                self.assertIn("Default:", getattr(vtkSkeletonPotential, "Set" + name).__doc__)
        for name in NUMBERS:
            with self.subTest(name):
                text = getattr(vtkSkeletonPotential, "Set" + name).__doc__
                told = re.search(r"Default:\s*(\d[\d.]*)", text).group(1).rstrip(".")
                default = getattr(vtkSkeletonPotential(), "Get" + name)()
                self.assertEqual(default, float(told))
                self.assertIn("Range:", text)

    def test_kernels_are_chosen_by_name(self):
        potential = vtkSkeletonPotential()
        potential.SetKernelToCubicSpline()
        self.assertEqual(potential.GetKernel(), vtkSkeletonPotential.CUBIC_SPLINE)
        potential.SetKernelToMetaball()
        self.assertEqual(potential.GetKernel(), vtkSkeletonPotential.METABALL)
        potential.SetKernelToWyvill()
        self.assertEqual(potential.GetKernel(), vtkSkeletonPotential.WYVILL)

    def test_points_and_segments_with_arrays(self):
        data = make_points([(0, 0, 0), (4, 0, 0), (0, 9, 0)])
        join(data, [0, 1])
        add_array(data, "size", [1, 3, 2])
        add_array(data, "weight", [1, 1, -2])
        potential = vtkSkeletonPotential()
        potential.SetInput(data)
        potential.SetRadiusArrayName("size")
        potential.SetStrengthArrayName("weight")
        # Halfway along the line the radius is 2. At half of this radius Wyvill's kernel is (3/4)^3.
        self.assertAlmostEqual(potential.FunctionValue(2, 1, 0), 0.5 - 0.75**3, delta=1e-15)
        self.assertEqual(potential.FunctionValue(0, 9, 0), 0.5 + 2)
        # At half of the radius 2 above the vertex, the kernel's slope is -27/16 per radius.
        gradient = potential.FunctionGradient(0, 10, 0)
        self.assertAlmostEqual(gradient[1], -2 * 27 / 16 / 2, delta=1e-15)
        bounds = [0.0] * 6
        self.assertTrue(potential.GetSkeletonBounds(bounds))
        self.assertEqual(bounds, [-2, 7, -3, 11, -3, 3])

    def test_contour_of_samples_is_a_sphere(self):
        potential = vtkSkeletonPotential()
        potential.SetInput(make_points([(0, 0, 0)]))
        sample = vtkSampleFunction()
        sample.SetImplicitFunction(potential)
        sample.SetModelBounds(-1, 1, -1, 1, -1, 1)
        sample.SetSampleDimensions(41, 41, 41)
        contour = vtkContourFilter()
        contour.SetInputConnection(sample.GetOutputPort())
        contour.SetValue(0, 0.0)
        contour.Update()
        surface = contour.GetOutput()
        radius = math.sqrt(1 - 0.5 ** (1 / 3))
        slope = 6 * radius * (1 - radius**2) ** 2
        # Linear interpolation over a step h is off by h^2/8 |W''| / |W'|, and |W''| <= 6.
        tolerance = 0.05**2 / 8 * 6 / slope
        self.assertGreater(surface.GetNumberOfPoints(), 500)
        for index in range(surface.GetNumberOfPoints()):
            distance = math.dist(surface.GetPoint(index), (0, 0, 0))
            self.assertAlmostEqual(distance, radius, delta=tolerance)

    def test_errors_and_warnings_are_sentences(self):
        data = make_points([(0, 0, 0), (math.nan, 0, 0)])
        potential = vtkSkeletonPotential()
        potential.SetInput(data)
        heard = []

        def hear(_, event, text):
            heard.append((event, text))

        hear.CallDataType = "string0"
        potential.AddObserver("ErrorEvent", hear)
        potential.AddObserver("WarningEvent", hear)
        self.assertEqual(potential.GetNumberOfIgnoredElements(), 1)
        self.assertEqual(potential.FunctionValue(0, 0, 0), -0.5)
        self.assertEqual([event for event, _ in heard], ["WarningEvent"])
        self.assertIn("1 point or segment is ignored", heard[0][1])
        potential.SetRadiusArrayName("absent")
        self.assertEqual(potential.FunctionValue(0, 0, 0), 0.5)
        self.assertEqual(heard[1][0], "ErrorEvent")
        self.assertIn('The radius array "absent" is not among', heard[1][1])

    def test_thresholds_without_a_surface_are_errors(self):
        for threshold in (0.0, -0.5, math.inf, math.nan):
            potential = vtkSkeletonPotential()
            potential.SetInput(make_points([(0, 0, 0)]))
            potential.SetThreshold(threshold)
            messages = Listener(potential)
            self.assertEqual(potential.FunctionGradient(0.1, 0, 0), (0, 0, 0))
            self.assertEqual(len(messages.errors), 1)
            self.assertIn("Threshold has to be a finite number > 0", messages.errors[0])

    def test_prints_itself(self):
        self.assertIn("Kernel: Wyvill", str(vtkSkeletonPotential()))


if __name__ == "__main__":
    unittest.main()
