# ctest: LABELS contract
"""Points, area, volume and Euler number of three skins at several times equal
Baselines/numbers.json.

Run: python3 test_numbers.py. After an intended change: python3 test_numbers.py --update, with the
reason in the commit.
"""

import json
import sys
import unittest
from pathlib import Path

from scenes import splash, star_to_balls, tube_to_box
from vtkmodules.vtkFiltersCore import vtkMassProperties

BASELINE = Path(__file__).resolve().parents[1] / "Baselines" / "numbers.json"
SCENES = {
    "splash": (lambda: splash()[1], range(0, 41, 5)),
    "tube_to_box": (tube_to_box, (0.0, 0.1, 0.3, 1.0, 3.0)),
    "star_to_balls": (star_to_balls, (0.0, 0.5, 1.5, 2.0, 3.0)),
}
# The potential has single precision, 6e-8, and each substep rounds. A few hundred roundings by
# another compiler may differ by some 1e-5. A change of the scheme has an effect of 1e-3.
TOLERANCE = 1e-4


def numbers_of(skin):
    """The Euler number is V - E + F, and a closed surface of triangles has E = 3 F / 2."""
    properties = vtkMassProperties()
    properties.SetInputData(skin)
    return {
        "points": skin.GetNumberOfPoints(),
        "area": properties.GetSurfaceArea(),
        "volume": properties.GetVolume(),
        "euler": skin.GetNumberOfPoints() - skin.GetNumberOfPolys() / 2,
    }


def measure(name):
    make, times = SCENES[name]
    surface, measured = make(), {}
    for time in times:
        surface.UpdateTimeStep(time)
        measured[str(time)] = numbers_of(surface.GetOutput())
    return measured


class Numbers(unittest.TestCase):
    def check(self, name):
        expected = json.loads(BASELINE.read_text())[name]
        measured = measure(name)
        self.assertEqual(list(measured), list(expected))
        for time, numbers in expected.items():
            with self.subTest(time=time):
                self.assertEqual(measured[time]["euler"], numbers["euler"])
                for key in ("points", "area", "volume"):
                    change = measured[time][key] / numbers[key] - 1
                    self.assertLess(abs(change), TOLERANCE, key)

    def test_splash(self):
        self.check("splash")

    def test_tube_to_box(self):
        self.check("tube_to_box")

    def test_star_to_balls(self):
        self.check("star_to_balls")


if __name__ == "__main__":
    if sys.argv[1:] == ["--update"]:
        BASELINE.write_text(json.dumps({name: measure(name) for name in SCENES}, indent=1) + "\n")
    else:
        unittest.main()
