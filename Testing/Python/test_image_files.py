# ctest: LABELS contract
"""Images as .nii, .nii.gz, .nrrd, .nhdr, .mha and .mhd: in the right place, complete, or an
error.

Run: python3 test_image_files.py
"""

import gzip
import json
import random
import unittest
import warnings

import numpy
from active_implicit_surfaces.measures import measure
from active_implicit_surfaces.skin_files import read_shape
from command_line import CommandTest
from shapes import write
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
    """Distance to a ball of radius 2, in every format."""

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
            write(vtkNIFTIImageWriter(), self.image, self.folder / name)
        for name, is_small in (("a.mha", False), ("b.mha", True), ("c.mhd", False)):
            writer = vtkMetaImageWriter()
            writer.SetCompression(is_small)
            if name == "c.mhd":
                writer.SetRAWFileName("c.raw")
            write(writer, self.image, self.folder / name)
        raw, text = self.flat.tobytes(), HEAD.format("float", "little", "raw")
        self.put("a.nrrd", text.encode() + b"\n" + raw)
        packed = gzip.compress(self.flat.astype(">f8").tobytes())
        head = HEAD.format("double", "big", "gzip").replace("\n", "\r\n")
        self.put("b.nrrd", head.encode() + b"\r\n" + packed)
        self.put("d.raw", raw)
        self.put("c.nhdr", text.encode() + b"data file: d.raw\n")

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

    def test_axes_along_those_of_space_are_put_right(self):
        """Each value is at the position given by the file's directions."""
        spacing = numpy.array(SPACING)[:, None]
        cube = self.flat.reshape(SIZE, order="F")
        for rows in ([[-1, 0, 0], [0, -1, 0], [0, 0, 1]], [[0, 0, -1], [1, 0, 0], [0, 1, 0]]):
            turned = numpy.array(rows)
            text = "".join(f" ({','.join(map(str, own))})" for own in (spacing * turned).tolist())
            head = HEAD.format("float", "little", "raw")
            head = head.replace(" (0.5,0,0) (0,0.5,0) (0,0,2)", text)
            self.put("t.nrrd", head.encode() + b"\n" + self.flat.tobytes())
            content = (self.folder / "a.mha").read_bytes()
            axes = " ".join(str(x) for x in turned.ravel()).encode()
            line = b"TransformMatrix = 1 0 0 0 1 0 0 0 1"
            self.assertIn(line, content)
            self.put("t.mha", content.replace(line, b"TransformMatrix = " + axes))
            content = bytearray((self.folder / "a.nii").read_bytes())
            sform = numpy.hstack([(spacing * turned).T, numpy.array([ORIGIN]).T])
            content[252:256] = numpy.array([0, 1], "<i2").tobytes()
            content[280:328] = sform.astype("<f4").tobytes()
            self.put("t.nii", bytes(content))
            for name in ("t.nrrd", "t.mha", "t.nii"):
                with self.subTest(name=name, rows=rows):
                    image = read_shape(self.folder / name)
                    scalars = image.GetPointData().GetScalars()
                    for index in ((0, 0, 0), (3, 1, 2), (11, 10, 9)):
                        place = (index * spacing.ravel()) @ turned + ORIGIN
                        own = scalars.GetTuple1(image.FindPoint(place))
                        self.assertAlmostEqual(own, cube[index], 6)

    def test_axes_at_other_angles_are_a_note(self):
        content = (self.folder / "a.mha").read_bytes()
        turn = b"TransformMatrix = 0.8 -0.6 0 0.6 0.8 0 0 0 1"
        self.put("t.mha", content.replace(b"TransformMatrix = 1 0 0 0 1 0 0 0 1", turn))
        self.assertIn("no multiple of 90 degrees", self.succeed("info", "t.mha").err)

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

    def put_values(self, name, values):
        head = HEAD.format("double", "little", "raw")
        self.put(name, head.encode() + b"\n" + values.astype("<f8").tobytes())

    def test_inside_is_what_the_border_is_not(self):
        """Masks of 0 and 1 and of -1 and 1, a density and a shifted distance with a level."""
        inside = self.flat < 0
        volume = abs(measure(self.contour("a.nrrd"))["volume"])
        for values, level in (
            (inside * 1.0, ()),
            (inside * 2.0 - 1.0, ()),
            (1.0 - self.flat, ("--level", 1)),
            (self.flat + 3.0, ("--level", 3)),
        ):
            with self.subTest(level):
                self.put_values("v.nrrd", values)
                found = measure(self.contour("v.nrrd", *level))
                self.assertEqual((found["pieces"], found["voids"]), (1, 0))
                self.assertAlmostEqual(found["volume"], volume, delta=0.3 * volume)
        said = self.succeed("convert", "a.nrrd", "-o", "contour.vtp", "--level", 0.1).err
        self.assertNotIn("Inside", said)
        self.put_values("v.nrrd", 1.0 - self.flat)
        said = self.succeed("convert", "v.nrrd", "-o", "contour.vtp", "--level", 1).err
        self.assertIn(
            "Inside is above 1, because the image is a mask or volume fractions, or most values",
            said,
        )

    def contour(self, name, *options):
        self.succeed("convert", name, "-o", "contour.vtp", *options)
        return read_shape(self.folder / "contour.vtp")

    def test_masks_and_labels_morph(self):
        self.put_values("mask.nrrd", (self.flat < 0) * 1.0)
        self.put_values("labels.nrrd", numpy.where(self.flat < 0, 3, self.flat > 3))
        wanted = measure(self.contour("mask.nrrd"))["volume"]
        for first, label in (("mask", ()), ("labels", ("--label", 3))):
            names = (f"{first}.nrrd", f"{first}.nrrd")
            self.succeed("morph", *names, "-o", "m_#.vtp", "--frames", 2, "--quiet", *label)
            for step in range(2):
                found = measure(read_shape(self.folder / f"m_{step}.vtp"))
                self.assertAlmostEqual(found["volume"], wanted, delta=0.1 * wanted)
        self.put_values("density.nrrd", self.flat + 3.0)
        said = self.fail_with(1, "morph", "mask.nrrd", "density.nrrd")
        self.assertIn("no inside: its finite values are from", said)

    def test_masks_as_parts_of_a_frame(self):
        self.put_values("a0.nrrd", (self.flat < 0) * 1.0)
        head = HEAD.format("double", "little", "raw").replace("(1,2,3)", "(101,2,3)")
        content = (self.folder / "a0.nrrd").read_bytes()
        self.put("a1.nrrd", head.encode() + content[content.index(b"\n\n") + 1 :])
        rows = "".join(f'<DataSet timestep="0" part="{i}" file="a{i}.nrrd"/>' for i in (0, 1))
        self.put("a.pvd", f"<VTKFile>{rows}</VTKFile>".encode())
        found, one = (measure(self.contour(name)) for name in ("a.pvd", "a0.nrrd"))
        self.assertAlmostEqual(found["volume"], 2 * one["volume"], 3)
        self.assertEqual(found["pieces"], 2)

    def test_several_labels_are_named(self):
        values = numpy.where(self.flat < 0, 3, self.flat > 3)
        head = HEAD.format("short", "little", "raw")
        self.put("labels.nrrd", head.encode() + b"\n" + values.astype("<i2").tobytes())
        said = self.fail_with(1, "convert", "labels.nrrd", "-o", "a.stl")
        self.assertIn("or a --label of 1, 3.", said)
        same = numpy.full_like(values, 3).astype("<i2")
        self.put("same.nrrd", head.encode() + b"\n" + same.tobytes())
        for options in (), ("--label", 3):
            said = self.fail_with(1, "convert", "same.nrrd", "-o", "a.stl", *options)
            self.assertIn("same.nrrd has no surface: all its values are 3; choose another", said)
        said = self.fail_with(1, "morph", "labels.nrrd", "a.nrrd")
        self.assertIn("has the values 1, 3; if they are labels, choose one (active-surface", said)

    def test_what_is_not_read_is_said(self):
        head = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 1 1 1\nencoding: text\n\n7\n"
        self.put("a.nrrd", head.encode())
        self.assertIn("encoding is text", self.fail_with(1, "info", "a.nrrd"))
        head = b"NDims = 3\nDimSize = 2 2 2\nElementType = MET_UCHAR\nElementDataFile = no.raw\n"
        self.put("a.mhd", head)
        self.assertIn("no.raw", self.fail_with(1, "info", "a.mhd"))
        flat = b"NDims = 2\nDimSize = 2 2\nElementType = MET_UCHAR\nTransformMatrix = 1 0 0 1\n"
        self.put("a.mha", flat + b"ElementDataFile = LOCAL\n" + bytes(4))
        self.assertIn("TransformMatrix has 4 number(s), not 9", self.fail_with(1, "info", "a.mha"))
        self.put("a.nii", b"no image")
        self.assertIn("a.nii cannot be read", self.fail_with(1, "info", "a.nii"))


if __name__ == "__main__":
    unittest.main()
