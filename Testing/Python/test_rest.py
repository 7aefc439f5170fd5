# ctest: LABELS contract
"""EQUILIBRIUM also ends over masks, and over distances to shapes with edges, with a warning if more
than 5 % of the skin oscillates. A slow motion does not end EQUILIBRIUM."""

import unittest

import numpy
from active_implicit_surfaces import vtkActiveImplicitSurface
from listener import Listener
from shapes import image_of, volume_of, with_properties
from vtkmodules.vtkCommonDataModel import vtkSphere

SIZE = 40
X, Y, Z = numpy.mgrid[0:SIZE, 0:SIZE, 0:SIZE] - 19.6
BALL = numpy.sqrt(X**2 + Y**2 + Z**2) - 12
BOX = numpy.maximum(numpy.maximum(abs(X) - 11, abs(Y) - 7), abs(Z) - 13)
ROD = numpy.maximum(numpy.hypot(X, Y) - 3, abs(Z) - 16)
MOST_SUBSTEPS = 2500  # of 10,000, the maximum
LOUD = 0.05  # moving fraction of the skin that causes a message


def settle(values, **properties):
    """Returns the steady surface, its messages, and the last row of its history."""
    surface = vtkActiveImplicitSurface()
    surface.SetInputData(0, image_of(values))
    surface.SetEvolutionModeToEquilibrium()
    with_properties(surface, properties)
    heard = Listener(surface)
    surface.Update()
    table = surface.GetOutputDataObject(2)
    last = table.GetNumberOfRows() - 1
    return (
        surface,
        heard,
        {
            table.GetColumnName(i): table.GetColumn(i).GetVariantValue(last)
            for i in range(table.GetNumberOfColumns())
        },
    )


class Rest(unittest.TestCase):
    def test_any_tension(self):
        for name, distance in (("ball", BALL), ("box", BOX), ("rod", ROD)):
            for values in (distance, (distance < 0).astype("u1")):
                for tension in (0.0, 0.1, 1.0):
                    with self.subTest(name, kind=values.dtype, tension=tension):
                        self.check(values, tension)

    def check(self, values, tension):
        _, heard, row = settle(values, Tension=tension)
        event = row["Event"].ToString()
        self.assertTrue(event.startswith("at rest"), event)
        self.assertLess(row["Substeps"].ToInt(), MOST_SUBSTEPS)
        share = float(event.split()[-2]) / 100 if "but for" in event else 0.0
        said = [text for text in heard.warnings if "does not settle" in " ".join(text.split())]
        self.assertEqual(len(said), 1 if share > LOUD else 0, (event, heard.warnings))

    def test_a_slow_motion_goes_on(self):
        start = vtkSphere()
        start.SetCenter(19.6, 19.6, 19.6)
        start.SetRadius(6)
        for tension in (0.0, 0.05):
            slow = {"Attraction": 0.02, "Tension": 0.02 * tension}
            surface, _, _ = settle(BALL, InitialFunction=start, **slow)
            radius = numpy.cbrt(volume_of(surface.GetOutput()) / (4 / 3 * numpy.pi))
            self.assertLess(abs(radius - 12), 0.05)


if __name__ == "__main__":
    unittest.main()
