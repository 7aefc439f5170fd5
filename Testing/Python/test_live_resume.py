# ctest: LABELS contract
"""Frames of a running simulation continue from a saved state."""

import math
import tempfile
import unittest
from pathlib import Path

import active_implicit_surfaces as active
import numpy
from active_implicit_surfaces import vtkActiveImplicitSurface
from active_implicit_surfaces.data_objects import as_particles
from shapes import points_of
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkFloatArray
from vtkmodules.vtkCommonDataModel import vtkImageData

FRAMES, SAVED, DT = 6, 3, 0.25
GRID = numpy.stack(numpy.meshgrid(*3 * [numpy.arange(6.0)]), -1).reshape(-1, 3)
IDS = numpy.arange(len(GRID))


def particles(step):
    """A block that falls, stretches and loses particles."""
    here = GRID * [1, 1 + 0.02 * step, 1] + [40.0, -0.3 * step * step, 0]
    return here[step:], IDS[step:]


def bytes_of(skin):
    arrays = skin.GetPointData()
    own = [vtk_to_numpy(arrays.GetArray(i)) for i in range(arrays.GetNumberOfArrays())]
    return b"".join(array.tobytes() for array in [points_of(skin), *own])


def run(live, steps):
    skins = []
    for step in steps:
        points, ids = particles(step)
        skins.append(live.advance(points, DT, ids=ids))
    return skins


def history_of(live):
    return {name: list(map(str, column)) for name, column in active.history(live).items()}


class Resume(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = Path(folder.name, "state.vdb")

    def compare(self, **options):
        first = active.LiveSurface(start=2.0, **options)
        skins = run(first, range(SAVED + 1))
        first.save(self.file)
        skins += run(first, range(SAVED + 1, FRAMES))
        second = active.LiveSurface(resume=self.file, **options)
        again = run(second, range(SAVED, FRAMES))
        self.assertEqual(second.time, 2.0 + DT * (FRAMES - 1))
        for step, skin in enumerate(again, SAVED):
            self.assertEqual(bytes_of(skin), bytes_of(skins[step]), f"{options}, frame {step}")
        self.assertEqual(history_of(second), history_of(first), options)

    def test_goes_on_to_the_same_bytes(self):
        with self.assertWarns(active.ActiveSurfaceWarning):  # of the spacing
            self.compare()
        self.compare(particle_spacing=1.0)
        self.compare(voxel_size=0.6, tension=0.05, attraction=20.0)
        self.compare(model_bounds=(35, 50, -15, 12, -5, 12), bounded_domain=True)
        self.compare(time_integration="explicit", attraction=40.0)
        self.compare(particle_model="sum", kernel_radius=2.0)
        self.compare(volume_control="exact")

    def test_arrays_of_later_frames_are_the_same(self):
        options = {
            "compute_velocity": True,
            "tangential_velocity": True,
            "pass_target_arrays": True,
        }
        first = active.LiveSurface(**options)
        run(first, range(SAVED + 1))
        first.save(self.file)
        expected = run(first, range(SAVED + 1, FRAMES))
        found = run(active.LiveSurface(resume=self.file, **options), range(SAVED, FRAMES))[1:]
        for one, other in zip(expected, found):
            self.assertEqual(bytes_of(one), bytes_of(other))

    def test_other_properties_are_refused_until_they_are_right(self):
        first = active.LiveSurface(voxel_size=0.6)
        skins = run(first, range(SAVED + 1))
        first.save(self.file)
        skins += run(first, [SAVED + 1])
        second = active.LiveSurface(voxel_size=0.5, resume=self.file)
        for _ in range(2):
            with self.assertRaisesRegex(ValueError, "does not fit this surface"):
                run(second, [SAVED])
        surface = second.surface
        surface.SetVoxelSize(0.6)
        for step in (SAVED, SAVED + 1):
            points, ids = particles(step)
            self.assertTrue(surface.Advance(as_particles(points, ids=ids), DT))
            self.assertEqual(bytes_of(surface.GetOutput()), bytes_of(skins[step]))

    def test_a_reset_discards_the_state(self):
        first = active.LiveSurface(voxel_size=0.6)
        run(first, range(SAVED + 1))
        first.save(self.file)
        surface = vtkActiveImplicitSurface()
        surface.SetVoxelSize(0.6)
        self.assertTrue(surface.LoadState(str(self.file)))
        surface.ResetTrajectory()
        cloud = as_particles(particles(0)[0])
        self.assertTrue(surface.Advance(cloud, DT))
        self.assertEqual(surface.GetHistory().GetNumberOfRows(), 1)

    def test_files_without_a_state(self):
        live = active.LiveSurface(resume=self.file)
        with self.assertRaisesRegex(ValueError, "No state of a surface can be loaded"):
            run(live, [0])
        with self.assertRaisesRegex(ValueError, "no state of a time step"):
            active.LiveSurface().save(self.file)

    def test_images(self):
        def image(step):
            data = vtkImageData()
            data.SetDimensions(24, 24, 24)
            data.SetOrigin(5, 5, 5)
            x, y, z = (axis + 5 for axis in numpy.mgrid[0:24, 0:24, 0:24])
            far = numpy.sqrt((x - 15 - step) ** 2 + (y - 16) ** 2 + (z - 16) ** 2) - 6
            values = vtkFloatArray()
            values.SetName("distance")
            for value in far.ravel(order="F"):
                values.InsertNextValue(value)
            data.GetPointData().SetScalars(values)
            return data

        def push(surface, steps):
            skins = []
            for step in steps:
                self.assertTrue(surface.Advance(image(step), DT), step)
                skins.append(bytes_of(surface.GetOutput()))
            return skins

        first, second = vtkActiveImplicitSurface(), vtkActiveImplicitSurface()
        push(first, range(3))
        self.assertTrue(first.SaveState(str(self.file)))
        expected = push(first, range(3, 5))
        self.assertTrue(second.LoadState(str(self.file)))
        self.assertEqual(push(second, range(2, 5))[1:], expected)
        self.assertTrue(math.isclose(first.GetVoxelSizeInUse(), second.GetVoxelSizeInUse()))


if __name__ == "__main__":
    unittest.main()
