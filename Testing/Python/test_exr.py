# ctest: LABELS contract
"""EXR files written and read by other programs, and the two classes from Python.

The programs are those of Debian's package openexr; the module OpenEXR of PyPI is used if it is
installed.

Run: python3 test_exr.py
"""

import importlib.util
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy
from active_implicit_surfaces import vtkActiveEXRReader, vtkActiveEXRWriter
from listener import Listener
from shapes import write
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkImageReader2Factory

WIDTH, HEIGHT = 70, 50
HALF, FLOAT, UINT = "16-bit floating-point", "32-bit floating-point", "32-bit unsigned integer"
CHANNELS = {
    **dict.fromkeys("RGBA", HALF),
    **dict.fromkeys(("Z", "P.X", "P.Y", "P.Z"), FLOAT),
    **dict.fromkeys(("N.X", "N.Y", "N.Z", "forward.u", "forward.v"), HALF),
    "id.object": UINT,
}


def image_of_layers():
    random = numpy.random.default_rng(5)
    count = WIDTH * HEIGHT
    # Values are halves, so that nothing is rounded.
    layers = {
        name: random.random((count, components)).astype(numpy.float16).astype(numpy.float32)
        for name, components in (("RGBA", 4), ("Z", 1), ("P", 3), ("N", 3), ("forward", 2))
    }
    layers["id.object"] = numpy.arange(count, dtype=numpy.uint32)
    image = vtkImageData()
    image.SetDimensions(WIDTH, HEIGHT, 1)
    for name, numbers in layers.items():
        array = numpy_to_vtk(numbers, deep=True)
        array.SetName(name)
        image.GetPointData().AddArray(array)
    return image


def arrays_of(image):
    data = image.GetPointData()
    names = [data.GetArrayName(i) for i in range(data.GetNumberOfArrays())]
    return {name: vtk_to_numpy(data.GetArray(name)) for name in names}


def read(path, part=0):
    reader = vtkActiveEXRReader()
    reader.SetFileName(str(path))
    reader.SetPart(part)
    reader.Update()
    return reader


class OtherPrograms(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.image = image_of_layers()
        self.path = self.folder / "layers.exr"
        writer = vtkActiveEXRWriter()
        writer.SetInputData(self.image)
        writer.SetFileName(str(self.path))
        for name in ("RGBA", "N", "forward"):
            writer.AssignPixelType(name, writer.HALF)
        writer.SetTimeCode("01:02:03:04")
        writer.SetFramesPerSecond(25)
        writer.AddAttribute("owner", "the tests")
        writer.Write()
        self.assertEqual(writer.GetErrorCode(), 0)

    def run_program(self, name, *arguments):
        self.assertIsNotNone(shutil.which(name), f"{name} of the package openexr is missing")
        done = subprocess.run(
            [name, *map(str, arguments)], check=True, capture_output=True, text=True
        )
        return done.stdout

    def assert_same_layers(self, image):
        expected, found = arrays_of(self.image), arrays_of(image)
        self.assertEqual(set(found), set(expected))
        for name, numbers in expected.items():
            self.assertTrue(numpy.array_equal(found[name].ravel(), numbers.ravel()), name)

    def test_exrheader_lists_the_layers(self):
        told = self.run_program("exrheader", self.path)
        for channel, kind in CHANNELS.items():
            self.assertIn(f"    {channel}, {kind}, sampling 1 1\n", told)
        self.assertIn("compression (type compression): zip", told)  # later versions print more
        self.assertIn(f"dataWindow (type box2i): (0 0) - ({WIDTH - 1} {HEIGHT - 1})", told)
        self.assertIn("time 01:02:03:04", told)
        self.assertIn("framesPerSecond (type rational): 25/1", told)
        self.assertIn('owner (type string): "the tests"', told)

    def look_by_exrinfo(self):
        """Output and errors of exrinfo, whose exit status is random in OpenEXR 3.1."""
        done = subprocess.run(
            ["exrinfo", "-s", "-v", str(self.path)], check=False, capture_output=True, text=True
        )
        return done.stdout, done.stderr

    def test_exrinfo_finds_nothing_wrong(self):
        told, wrong = self.look_by_exrinfo()
        self.assertEqual(wrong, "")
        self.assertIn("id.object", told)
        self.path.write_bytes(self.path.read_bytes()[:200])
        self.assertIn("ERROR", self.look_by_exrinfo()[1])

    def test_tiles_of_exrmaketiled_are_read(self):
        for name, options in {
            "tiles": (),
            "mipmaps": ("-m",),
            "ripmaps": ("-r", "-t", "16", "8"),
            "piz": ("-z", "piz"),
        }.items():
            with self.subTest(name):
                path = self.folder / f"{name}.exr"
                self.run_program("exrmaketiled", *options, self.path, path)
                reader = read(path)
                self.assertEqual(reader.GetPartType(0), "tiledimage")
                self.assert_same_layers(reader.GetOutput())

    def test_parts_of_exrmultipart_are_read(self):
        tiled, parts = self.folder / "tiled.exr", self.folder / "parts.exr"
        self.run_program("exrmaketiled", self.path, tiled)
        self.run_program(
            "exrmultipart", "-combine", "-i", f"{self.path}:0::first", tiled, "-o", parts
        )
        for part, kind in enumerate(("scanlineimage", "tiledimage")):
            reader = read(parts, part)
            self.assertEqual(reader.GetNumberOfParts(), 2)
            self.assertEqual(reader.GetPartType(part), kind)
            self.assert_same_layers(reader.GetOutput())

    def test_previews_and_attributes_of_others_do_no_harm(self):
        preview, both = self.folder / "preview.exr", self.folder / "both.exr"
        self.run_program("exrmakepreview", self.path, preview)
        self.run_program("exrstdattr", "-isoSpeed", "200", "-altitude", "17.5", preview, both)
        reader = read(both)
        self.assert_same_layers(reader.GetOutput())
        data = reader.GetOutput().GetFieldData()
        self.assertEqual(data.GetArray("isoSpeed").GetValue(0), 200.0)
        self.assertEqual(data.GetArray("altitude").GetValue(0), 17.5)

    @unittest.skipUnless(importlib.util.find_spec("OpenEXR"), "the module OpenEXR is not there")
    def test_the_module_openexr_reads_it(self):
        import OpenEXR

        header = OpenEXR.InputFile(str(self.path)).header()
        self.assertEqual(set(header["channels"]), set(CHANNELS))


class AsPythonSeesThem(unittest.TestCase):
    def test_the_factory_has_the_reader_since_the_import(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "a.exr"
            write(vtkActiveEXRWriter(), image_of_layers(), path)
            found = vtkImageReader2Factory.CreateImageReader2(str(path))
            self.assertIsInstance(found, vtkActiveEXRReader)

    def test_bytes_in_memory_are_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "a.exr"
            write(vtkActiveEXRWriter(), image_of_layers(), path)
            content = path.read_bytes()
        reader = vtkActiveEXRReader()
        reader.SetMemoryBuffer(content)
        reader.SetMemoryBufferLength(len(content))
        reader.Update()
        self.assertEqual(reader.GetOutput().GetDimensions(), (WIDTH, HEIGHT, 1))

    def test_equal_images_make_equal_bytes(self):
        with tempfile.TemporaryDirectory() as folder:
            contents = []
            for name in ("a.exr", "b.exr"):
                path = write(vtkActiveEXRWriter(), image_of_layers(), Path(folder) / name)
                contents.append(path.read_bytes())
        self.assertEqual(*contents)

    def assert_refused(self, writer, name, said):
        listener = Listener(writer)
        writer.SetInputDataObject(image_of_layers())
        writer.SetFileName(name)
        writer.Write()
        self.assertEqual(len(listener.errors), 1)
        self.assertIn(said, listener.errors[0])

    def test_errors_name_the_file_of_the_frame(self):
        writer = vtkActiveEXRWriter()
        writer.SetFrameNumber(7)
        self.assert_refused(writer, "/absent/a.##.exr", 'Cannot write "/absent/a.07.exr": ')
        self.assert_refused(writer, "", "): FileName is not set; set it to")

    def test_errors_tell_of_the_decoding_of_colors(self):
        writer = vtkActiveEXRWriter()
        writer.SetColorEncodingToSRGB()
        writer.AssignPixelType("RGBA", vtkActiveEXRWriter.HALF)
        image = vtkImageData()
        image.SetDimensions(1, 1, 1)
        colors = numpy_to_vtk(numpy.array([[200.0, 0.0, 0.0, 1.0]]), deep=True)
        colors.SetName("RGBA")
        image.GetPointData().AddArray(colors)
        listener = Listener(writer)
        writer.SetInputDataObject(image)
        with tempfile.TemporaryDirectory() as folder:
            writer.SetFileName(str(Path(folder) / "a.exr"))
            writer.Write()
        self.assertIn('Value 200 of array "RGBA", decoded from sRGB, does not', listener.errors[0])


if __name__ == "__main__":
    unittest.main()
