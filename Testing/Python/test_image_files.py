# ctest: LABELS contract
"""Images as .nii, .nii.gz, .nrrd, .nhdr, .mha and .mhd: in place, whole, or an error.

Run: python3 test_image_files.py
"""

import gzip
import json
import random
import unittest
import warnings

import numpy
from active_implicit_surfaces.skin_files import read_shape
from command_line import CommandTest
from test_damaged_files import damaged
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkMetaImageWriter, vtkNIFTIImageWriter

SIZE, SPACING, ORIGIN = (12, 11, 10), (0.5, 0.5, 2.0), (1.0, 2.0, 3.0)
NAMES = "a.nii a.nii.gz a.mha b.mha c.mhd a.nrrd b.nrrd c.nhdr".split()
HEAD = """NRRD0004
# of a test
type: {}
dimension: 3
space: left-posterior-superior
sizes: 12 11 10
space directions: (0.5,0,0) (0,0.5,0) (0,0,2)
kinds: domain domain domain
endian: {}
encoding: {}
space origin: (1,2,3)
"""


class Images(CommandTest):
    """The distance to a ball of radius 2, in every format."""

    def setUp(self):
        super().setUp()
        index = numpy.stack(numpy.meshgrid(*map(numpy.arange, SIZE), indexing="ij"), -1)
        places = (index - (numpy.array(SIZE) - 1) / 2) * SPACING
        self.flat = (numpy.linalg.norm(places, axis=-1) - 2).astype("f4").ravel(order="F")
        self.image = vtkImageData()
        self.image.SetDimensions(*SIZE)
        self.image.SetSpacing(*SPACING)
        self.image.SetOrigin(*ORIGIN)
        self.image.GetPointData().SetScalars(numpy_to_vtk(self.flat, deep=True))
        for name in ("a.nii", "a.nii.gz"):
            self.write(vtkNIFTIImageWriter(), name)
        for name, is_small in (("a.mha", False), ("b.mha", True), ("c.mhd", False)):
            writer = vtkMetaImageWriter()
            writer.SetCompression(is_small)
            if name == "c.mhd":
                writer.SetRAWFileName("c.raw")
            self.write(writer, name)
        raw, text = self.flat.tobytes(), HEAD.format("float", "little", "raw")
        self.put("a.nrrd", text.encode() + b"\n" + raw)
        packed = gzip.compress(self.flat.astype(">f8").tobytes())
        head = HEAD.format("double", "big", "gzip").replace("\n", "\r\n")
        self.put("b.nrrd", head.encode() + b"\r\n" + packed)
        self.put("d.raw", raw)
        self.put("c.nhdr", text.encode() + b"data file: d.raw\n")

    def write(self, writer, name):
        writer.SetInputData(self.image)
        writer.SetFileName(str(self.folder / name))
        writer.Write()

    def put(self, name, content):
        (self.folder / name).write_bytes(content)

    def test_place_and_values(self):
        for name in NAMES:
            with self.subTest(name):
                image = read_shape(self.folder / name)
                self.assertEqual(image.GetDimensions(), SIZE)
                numpy.testing.assert_allclose(image.GetSpacing(), SPACING)
                numpy.testing.assert_allclose(image.GetOrigin(), ORIGIN)
                scalars = vtk_to_numpy(image.GetPointData().GetScalars())
                numpy.testing.assert_array_equal(scalars, self.flat)

    def test_where_images_are_taken(self):
        for name in NAMES:
            with self.subTest(name):
                found = json.loads(self.succeed("info", name, "--json").out)
                self.assertEqual((found["holds"], found["points"]), ("an image", list(SIZE)))
                self.succeed("convert", name, "-o", "a.stl")
                self.assertGreater(read_shape(self.folder / "a.stl").GetNumberOfPolys(), 50)
        self.succeed("morph", "a.nii.gz", "a.nrrd", "-o", "m_#.vtp", "--frames", 2)
        self.assertGreater(read_shape(self.folder / "m_1.vtp").GetNumberOfPolys(), 50)

    def test_damage_is_an_error(self):
        for name in NAMES:
            path, chance, said = self.folder / name, random.Random(name), 0
            content = path.read_bytes()
            for _ in range(60):
                path.write_bytes(damaged(content, chance))
                try:
                    with warnings.catch_warnings():
                        warnings.simplefilter("ignore")
                        read_shape(path)
                except OSError as error:
                    self.assertIn(name, str(error))
                    self.assertTrue(str(error).endswith("."), error)
                    said += 1
            path.write_bytes(content[: 2 * len(content) // 3])
            with self.subTest(name), self.assertRaisesRegex(OSError, "cannot be read"):
                read_shape(path)
            self.assertGreater(said, 0)
            path.write_bytes(content)

    def test_scale_of_values(self):
        content = bytearray((self.folder / "a.nii").read_bytes())
        content[112:120] = numpy.array([2.0, 5.0], "<f4").tobytes()  # scl_slope, scl_inter
        self.put("a.nii", bytes(content))
        scalars = vtk_to_numpy(read_shape(self.folder / "a.nii").GetPointData().GetScalars())
        numpy.testing.assert_allclose(scalars, 2 * self.flat + 5, rtol=1e-6)

    def test_what_is_not_read_is_said(self):
        head = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 1 1 1\nencoding: text\n\n7\n"
        self.put("a.nrrd", head.encode())
        self.assertIn("encoding is text", self.fail_with(1, "info", "a.nrrd"))
        head = b"NDims = 3\nDimSize = 2 2 2\nElementType = MET_UCHAR\nElementDataFile = no.raw\n"
        self.put("a.mhd", head)
        self.assertIn("no.raw", self.fail_with(1, "info", "a.mhd"))
        self.put("a.nii", b"no image")
        self.assertIn("a.nii cannot be read", self.fail_with(1, "info", "a.nii"))


if __name__ == "__main__":
    unittest.main()
