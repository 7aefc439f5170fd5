# ctest: LABELS contract memory TIMEOUT 900
"""Extreme input: clusters of particles, numbers at the ends of their range, frames that change
or vanish, a source that fails repeatedly, no memory, names that are no files.

Absurd properties are in test_extremes.py.

Run: python3 test_limits.py
"""

import os
import subprocess
import sys
import tempfile
import unittest
from ast import literal_eval
from pathlib import Path

import numpy
from active_implicit_surfaces import (
    vtkActiveEXRReader,
    vtkActiveEXRWriter,
    vtkActiveImplicitSurface,
    vtkActiveVDBWriter,
)
from contents import Contents
from listener import Listener, sentence_of
from random_shapes import Source
from same_bytes import POINTS
from same_bytes_shapes import (
    ball,
    brick,
    cloud,
    globe,
    image,
    lines,
    quadric,
    scattered,
)
from sanitized import IS_SANITIZED
from shapes import make_points, with_properties
from skin_checks import check_skin
from vtkmodules.vtkCommonDataModel import vtkImageData

SPACING = 0.25
NAN = float("nan")


def surface_over(data, arrays=(), **properties):
    surface = vtkActiveImplicitSurface()
    surface.SetMaximumNumberOfActiveVoxels(100000)
    with_properties(surface, properties)
    if isinstance(data, Source):
        surface.SetInputConnection(data.GetOutputPort())
    else:
        surface.SetInputDataObject(0, data)
    for number, name in arrays:
        surface.SetInputArrayToProcess(number, 0, 0, POINTS, name)
    return surface


def said_at(surface, time=0.1):
    """Returns the error messages of an update; checks the skin if there are none."""
    listener = Listener(surface)
    surface.UpdateTimeStep(time)
    if not listener.errors:
        check_skin(surface)
    return [sentence_of(error) for error in listener.errors]


def hash_of(surface):
    contents = Contents()
    contents.outputs(surface, may_be_empty=True)
    return contents.hash()


class Crowds(unittest.TestCase):
    def test_many_particles_in_one_place_are_refused(self):
        """Each particle would visit each other: 10^10 visits."""
        here = make_points(numpy.zeros((100000, 3)))
        surface = surface_over(here, ParticleModel=1, ParticleSpacing=SPACING)
        (said,) = said_at(surface)
        self.assertIn("neighbours within 1.6 kernel radii on average", said)
        self.assertIn("ParticleSpacing", said)

    def test_a_sum_takes_them(self):
        here = make_points(numpy.zeros((100000, 3)))
        surface = surface_over(here, ParticleModel=0, ParticleSpacing=SPACING)
        self.assertEqual(said_at(surface), [])
        self.assertGreater(surface.GetOutput().GetNumberOfPoints(), 0)

    def test_doubled_particles_are_usual(self):
        """Each particle occurs twice. Above 30,000 particles the filter searches a sample for
        clusters."""
        ticks = numpy.arange(26) * SPACING
        grid = numpy.stack(numpy.meshgrid(ticks, ticks, ticks), axis=-1).reshape(-1, 3)
        surface = surface_over(
            make_points(numpy.repeat(grid, 2, axis=0)), ParticleModel=1, ParticleSpacing=SPACING
        )
        self.assertEqual(said_at(surface, 0.0), [])


class FarAway(unittest.TestCase):
    def test_a_mesh_with_a_point_far_away_is_refused(self):
        """Distances to such a mesh would need far more memory than its skin."""
        for far in (300.0, 1e4, 1e8):
            with self.subTest(far=far):
                mesh = globe(1.0)
                mesh.GetPoints().SetPoint(0, 0.0, 0.0, far)
                surface = surface_over(mesh, VoxelSize=0.25, MaximumNumberOfActiveVoxels=20000)
                (said,) = said_at(surface)
                self.assertIn("points that are far away", said)
                self.assertIn("VoxelSize (now 0.25)", said)
                self.assertIn("ten times MaximumNumberOfActiveVoxels", said)


class Numbers(unittest.TestCase):
    def test_radii_and_strengths(self):
        places = scattered(30)
        for values in (
            [0.0] * 30,
            [0.0, 0.3] * 15,
            [-1.0, NAN, 0.3] * 10,
            [1e300, 0.3, 1e-300] * 10,
        ):
            for number in (0, 2):
                for model in (0, 1):
                    with self.subTest(values=values[:3], number=number, model=model):
                        data = cloud(places, values=values)
                        surface = surface_over(
                            data, [(number, "values")], ParticleModel=model, ParticleSpacing=SPACING
                        )
                        for said in said_at(surface):
                            self.assertRegex(said, "ParticleSpacing|VoxelSize|ModelBounds")

    def test_scales_and_places(self):
        """The result is a skin if voxels can have the scale, else an error that names the property
        to set."""
        at_origin = numpy.array(scattered(30))
        for scale in (1e-300, 1e-40, 1e-30, 1e-20, 1e20, 1e30, 1e300):
            for data in (make_points(at_origin * scale), globe(scale)):
                with self.subTest("scale", scale=scale):
                    surface = surface_over(data)
                    errors = said_at(surface)
                    self.assertLessEqual(len(errors), 1)
                    for said in errors:
                        self.assertRegex(said, "ParticleSpacing|VoxelSize|ModelBounds")
                    if 1e-29 < scale < 1e29:
                        self.assertGreater(surface.GetOutput().GetNumberOfPoints(), 0)
        surface = surface_over(make_points(at_origin + 1e9), ParticleSpacing=SPACING)
        self.assertEqual(said_at(surface), [])
        self.assertGreater(surface.GetOutput().GetNumberOfPoints(), 0)
        surface = surface_over(make_points(at_origin + 1e30), ParticleSpacing=SPACING)
        self.assertIn("move the input", said_at(surface)[0])

    def test_images(self):
        for spacing in (0.0, 1e-300, 1e-30, 1e30, 1e300):
            with self.subTest(spacing=spacing):
                data = image(quadric(1, 1, 1))
                data.SetSpacing(spacing, spacing, spacing)
                for said in said_at(surface_over(data)):
                    self.assertRegex(said, "VoxelSize|too small a Spacing")

    def test_more_cells_than_there_are_values(self):
        """The images have more than 2^31 points, for which no memory is requested."""
        for count in (1291, 50000, 2**21):
            with self.subTest(count=count):
                data = vtkImageData()
                data.SetDimensions(count, count, count)
                data.GetPointData().SetScalars(image(quadric(1, 1, 1)).GetPointData().GetScalars())
                self.assertIn("one number for each point", said_at(surface_over(data))[0])

    def test_more_voxels_than_may_be(self):
        surface = vtkActiveImplicitSurface()
        surface.SetTargetFunction(ball(0.5))
        surface.SetModelBounds(-1, 1, -1, 1, -1, 1)
        surface.SetVoxelSize(2 / 1291)
        surface.SetMaximumNumberOfActiveVoxels(10**7)
        self.assertIn("1293 x 1293 x 1293 voxels", said_at(surface)[0])


FRAMES = {
    "particles": lambda: cloud(scattered(30), name=list(range(30)), size=[0.1] * 30),
    "others": lambda: cloud(scattered(20, seed=2), name=list(range(20)), size=[0.1] * 20),
    "without arrays": lambda: cloud(scattered(30)),
    "other types": lambda: cloud(scattered(30), name=[0.5] * 30, size=[0.1] * 30),
    "nothing": lambda: cloud([]),
    "mesh": brick,
    "lines": lambda: lines(scattered(30), (0, 1, 2), name=list(range(30)), size=[0.1] * 30),
}
ARRAYS = [(0, "size"), (1, "name")]


class Arrays(unittest.TestCase):
    def test_without_a_value_for_each_particle(self):
        data = cloud(scattered(30), short=[0.5] * 7, long=[0.5] * 31, whole=[0.5] * 30)
        surface = surface_over(data, ParticleSpacing=SPACING, PassTargetArrays=1)
        self.assertEqual(said_at(surface), [])
        arrays = surface.GetOutput().GetPointData()
        self.assertTrue(arrays.HasArray("whole"))
        self.assertFalse(arrays.HasArray("short") or arrays.HasArray("long"))
        for number in (0, 2):
            for name in ("short", "long"):
                self.assertIn(name, said_at(surface_over(data, [(number, name)]))[0])


class Files(unittest.TestCase):
    def test_an_attribute_that_is_longer_than_it_says(self):
        """OpenEXR read beyond the end of the attribute, and allocated 1.7 GB for a file of 622
        bytes."""
        folder = Path(__file__).resolve().parents[1] / "Fuzz/Corpus/FuzzEXR"
        for name in ("attribute_longer_than_it_says.exr", "channels_without_end.exr"):
            with self.subTest(name):
                reader = vtkActiveEXRReader()
                reader.SetFileName(str(folder / name))
                listener = Listener(reader)
                reader.Update()
                self.assertEqual(len(listener.errors), 1)
                said = sentence_of(listener.errors[0])
                self.assertIn("of its header does not have the length that it declares", said)


class Frames(unittest.TestCase):
    def over(self, *names, kind=Source, **properties):
        steps = {0.25 * i: FRAMES[name]() for i, name in enumerate(names)}
        return surface_over(kind(steps), ARRAYS, ParticleSpacing=SPACING, **properties)

    def test_they_change_their_kind_or_arrays(self):
        for other, words in (
            ("mesh", "all time steps of the input have to be of one kind"),
            ("lines", "all time steps of the input have to be of one kind"),
            ("without arrays", "SetInputArrayToProcess(0"),
            ("other types", "have to be integers"),
        ):
            with self.subTest(other):
                surface = self.over("particles", "others", other, "particles")
                self.assertEqual(said_at(surface, 0.25), [])
                before = hash_of(surface)
                for _ in range(2):
                    self.assertIn(words, said_at(surface, 0.75)[0])
                self.assertEqual(said_at(surface, 0.25), [])
                self.assertEqual(hash_of(surface), before)

    def test_they_vanish_and_come_back(self):
        names = ("nothing", "particles", "nothing", "nothing", "others")
        for integration in (0, 1):
            surface = self.over(*names, TimeIntegration=integration)
            counts = []
            for i in range(len(names)):
                self.assertEqual(said_at(surface, 0.25 * i), [])
                counts.append(surface.GetOutput().GetNumberOfPoints() > 0)
            self.assertEqual(counts, [False, True, False, False, True])

    def test_a_source_fails_every_third_time(self):
        class Unreliable(Source):
            asked = 0

            def RequestData(self, request, inputs, outputs):
                self.asked += 1
                return 0 if self.asked % 3 == 0 else super().RequestData(request, inputs, outputs)

        names = ("particles", "others", "nothing", "others", "particles")
        surface = self.over(*names, kind=Unreliable)
        failures = 0
        # Between two failures the source provides two steps, at least one of them new.
        while said_at(surface, 1.0):
            failures += 1
            self.assertLessEqual(failures, len(names))
        self.assertGreater(failures, 1)
        whole = self.over(*names)
        self.assertEqual(said_at(whole, 1.0), [])
        self.assertEqual(hash_of(surface), hash_of(whole))


@unittest.skipIf(IS_SANITIZED, "the sanitizer uses terabytes of addresses")
class Memory(unittest.TestCase):
    def refused(self, task, limits):
        """Runs the task with each limit [MiB]: at most one error, and the skin of a normal run once
        memory suffices. Returns the errors."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        program = str(Path(__file__).with_name("memory_program.py"))
        file = str(Path(folder.name) / "state.vdb")
        told, hashes = [], set()
        for more in limits:
            ran = subprocess.run(
                [sys.executable, program, task, str(more), file],
                capture_output=True,
                text=True,
                check=False,
            )
            self.assertEqual(ran.returncode, 0, f"{more} MiB: {ran.stderr[-500:]}")
            said, afterwards, found = literal_eval(ran.stdout)
            self.assertEqual(afterwards, [], f"{more} MiB")
            self.assertLessEqual(len(said), 1)
            told += said
            hashes.add(found)
        self.assertEqual(len(hashes), 1, "the same skin in the end")
        return told

    def test_update(self):
        told = self.refused("update", (0.5, 2, 4, 7, 11, 16, 24, 48, 1000))
        self.assertGreater(len(told), 2, "some were refused")
        for sentence in told:
            self.assertRegex(sentence, "not enough memory|pthread_create has failed")

    def test_mesh(self):
        told = self.refused("mesh", (0.1, 0.3))
        self.assertEqual(len(told), 2)
        for sentence in told:
            self.assertRegex(sentence, "There is not enough memory")

    def test_state(self):
        for task in ("save", "load"):
            # With more memory, Blosc crashes: it does not check its own allocations.
            told = self.refused(task, (0.1, 0.3))
            self.assertEqual(len(told), 2, task)
            for sentence in told:
                self.assertRegex(sentence, "not enough memory to save or load the state")


class Names(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.surface = vtkActiveImplicitSurface()
        self.surface.SetTargetFunction(ball(0.5))
        self.surface.SetModelBounds(-1, 1, -1, 1, -1, 1)
        self.surface.SetVoxelSize(0.1)
        self.surface.Update()

    def writers(self):
        """(object that reports errors, function of a name)."""
        grids = vtkActiveVDBWriter()
        grids.SetInputConnection(self.surface.GetOutputPort())
        picture = vtkActiveEXRWriter()
        data = vtkImageData()
        data.SetDimensions(4, 4, 1)
        data.AllocateScalars(10, 1)  # float
        picture.SetInputDataObject(data)

        def write(writer):
            return lambda name: (writer.SetFileName(name), writer.Write())

        return {
            "state": (self.surface, self.surface.SaveState),
            "grids": (grids, write(grids)),
            "picture": (picture, write(picture)),
        }

    def test_what_cannot_be_written_to(self):
        os.mkfifo(self.folder / "pipe")
        (self.folder / "folder").mkdir()
        (self.folder / "file").write_text("here before")
        os.symlink(self.folder / "folder", self.folder / "link")
        names = [
            self.folder / name for name in ("pipe", "folder", "link", "gone/x", "file/x", "n" * 300)
        ]
        before = sorted(os.listdir(self.folder))
        for name in (*names, "/proc/read_only", "/dev/full", "/dev/null/x", ""):
            for kind, (teller, write) in self.writers().items():
                with self.subTest(kind, name=str(name)):
                    listener = Listener(teller)
                    write(str(name))
                    self.assertEqual(len(listener.errors), 1)
                    self.assertRegex(sentence_of(listener.errors[0]), r"cannot|Cannot|not set")
        self.assertEqual(sorted(os.listdir(self.folder)), before, "nothing is left")
        self.assertEqual((self.folder / "file").read_text(), "here before")

    def test_links_are_replaced_not_followed(self):
        real = self.folder / "real"
        real.write_text("here before")
        for kind, (teller, write) in self.writers().items():
            for target in ("real", "gone", "link"):  # "link" is the link itself
                with self.subTest(kind, target=target):
                    link = self.folder / "link"
                    link.unlink(missing_ok=True)
                    os.symlink(self.folder / target, link)
                    listener = Listener(teller)
                    write(str(link))
                    self.assertEqual(listener.errors, [])
                    self.assertFalse(link.is_symlink())
                    self.assertEqual(real.read_text(), "here before")


if __name__ == "__main__":
    unittest.main()
