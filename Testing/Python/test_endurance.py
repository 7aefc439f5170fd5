# ctest: LABELS contract long TIMEOUT 3600
"""Long runs of one filter: aborted, failed and refused operations, random ones, a film in a
loop.

Run: python3 test_endurance.py
ACTIVE_RANDOM_CASES in the environment is another number of operations and frames;
the seed is printed.
"""

import os
import unittest
from collections import Counter
from random import Random

from contents import Contents, no_errors
from random_cases import draw_operation, draw_time, draw_trouble
from random_checks import Case
from scenes import STEPS, splash
from vtkmodules.vtkCommonDataModel import vtkPolyData

COUNT = int(os.environ.get("ACTIVE_RANDOM_CASES", "300"))
SEED = 20261122
SCENES = (
    {"target": ("births_and_deaths", 4), "properties": {"ParticleSpacing": 0.2}},
    {
        "target": ("emitter", 7),
        "obstacle": ("a_ball", 2),
        "properties": {"ParticleSpacing": 0.2, "Tension": 0.01, "TimeIntegration": 0},
    },
    {"target": ("moving_mesh", 3), "initial": ("a_ball", 5), "properties": {}},
    {"target": ("moving_image", 2), "properties": {"VolumeControl": 2, "ComputeVelocity": 1}},
)


def make_case(scene):
    return Case({"initial": None, "obstacle": None, **scene})


def resident_pages():
    with open("/proc/self/statm", encoding="ascii") as numbers:
        return int(numbers.read().split()[1])


def coarse_splash():
    particles, surface = splash()
    surface.SetVoxelSize(0.07)
    return particles, surface


class Endurance(unittest.TestCase):
    def test_troubles_leave_no_trace(self):
        for number, scene in enumerate(SCENES):
            with self.subTest(scene["target"], seed=SEED + number):
                random = Random(SEED + number)
                case = make_case(scene)
                kinds = Counter()
                for _ in range(50):
                    trouble = draw_trouble(random)
                    kinds[trouble[0]] += 1
                    case.do(*trouble)
                self.assertEqual(len(kinds), 7, "every kind of trouble")
                self.assertGreater(case.counts["stopped"], 0)
                self.assertGreater(case.counts["failed"], 0)
                self.assertGreater(case.counts["refused"], 5)
                for time in (draw_time(random), 1.0, 0.0):
                    case.request(time)
                    case.check_fresh()

    def test_many_operations_leave_no_trace(self):
        for number, scene in enumerate(SCENES):
            print(f"{COUNT // len(SCENES)} operations of seed {SEED + number}", flush=True)
            random = Random(SEED + number)
            case = make_case(scene)
            for done in range(COUNT // len(SCENES)):
                case.do(*draw_operation(random))
                if done % 15 == 14:
                    case.set_back(scene)
                    case.request(draw_time(random))
                    case.check_fresh()
            self.assertGreater(case.counts["skins"], case.counts["requests"] // 3)

    def test_a_film_in_a_loop(self):
        surface = coarse_splash()[1]
        self.go_round(surface, surface.UpdateTimeStep)

    def test_a_film_that_is_pushed_in_a_loop(self):
        """Each loop is a separate trajectory."""
        particles, surface = coarse_splash()
        frames = []
        for step in range(STEPS):
            particles.UpdateTimeStep(step)
            frames.append(vtkPolyData())
            frames[-1].DeepCopy(particles.GetOutput())
        surface.RemoveAllInputConnections(0)

        def push(step):
            if step == 0:
                surface.ResetTrajectory()
            self.assertTrue(surface.Advance(frames[step], 1.0))

        self.go_round(surface, push)

    def go_round(self, surface, show):
        """The first and the last loop give the same bytes, and memory stays constant. Allocators
        return pages at times that depend on the threads: therefore the least of the last three
        loops is compared with the most of the third to the fifth, with a tolerance of 1 %."""
        first, pages = [], []
        loops = max(9, COUNT // STEPS)
        for loop in range(loops):
            for step in range(STEPS):
                with no_errors(surface):
                    show(step)
                if loop in (0, loops - 1):
                    contents = Contents()
                    contents.outputs(surface)
                    if loop == 0:
                        first.append(contents.hash())
                    else:
                        self.assertEqual(contents.hash(), first[step], f"step {step}")
            pages.append(resident_pages())
        self.assertEqual(len(set(first)), STEPS, "the film moves")
        grown = min(pages[-3:]) / max(pages[2:5]) - 1
        print(f"{loops * STEPS} frames, memory grown by {100 * grown:.2f} %", flush=True)
        self.assertLess(grown, 0.01)


if __name__ == "__main__":
    print(f"seed {SEED}", flush=True)
    unittest.main()
