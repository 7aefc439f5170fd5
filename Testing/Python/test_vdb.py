# ctest: LABELS acceptance
"""Our .vdb files in OpenVDB's own tools, and theirs in vtkActiveVDBReader."""

import subprocess
import tempfile
import unittest
from pathlib import Path

from active_implicit_surfaces import (
    vtkActiveImplicitSurface,
    vtkActiveVDBReader,
    vtkActiveVDBWriter,
)
from listener import Listener
from scenes import splash
from shapes import ball_mesh, output_of
from vtkmodules.vtkCommonCore import vtkFloatArray
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkSphere

try:
    import openvdb
except ImportError:  # name before OpenVDB 11
    import pyopenvdb as openvdb


def ball():
    sphere = vtkSphere()
    sphere.SetRadius(0.5)
    surface = vtkActiveImplicitSurface()
    surface.SetTargetFunction(sphere)
    surface.SetModelBounds(-1, 1, -1, 1, -1, 1)
    surface.SetVoxelSize(0.0625)
    surface.SetTension(0.125)
    return surface


def write(surface, path):
    writer = vtkActiveVDBWriter()
    writer.SetInputConnection(surface.GetOutputPort())
    writer.SetFileName(str(path))
    writer.SetUnits("m")
    return writer.Write()


class WithAFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = Path(folder.name) / "a.vdb"


class OthersReadOurFiles(WithAFolder):
    def test_vdb_print_lists_class_voxel_size_and_metadata(self):
        surface = ball()
        surface.UpdateTimeStep(0)
        self.assertEqual(write(surface, self.file), 1)
        said = subprocess.run(
            ["vdb_print", "-l", str(self.file)], capture_output=True, text=True, check=True
        ).stdout
        for words in ("level set", "0.0625", "motion_Tension", "0.125", "units: m", "frame: 0"):
            self.assertIn(words, said)

    def test_pyopenvdb_reads_the_distance(self):
        surface = ball()
        surface.UpdateTimeStep(0)
        write(surface, self.file)
        grid = openvdb.read(str(self.file), "surface")
        self.assertEqual(grid.gridClass, "level set")
        self.assertAlmostEqual(grid.background, 3 * 0.0625)
        self.assertEqual(grid.transform.voxelSize()[0], 0.0625)
        values = grid.getConstAccessor()
        # On the axis the skin's vertices are exact; the triangles are within h^2 / 2r of the ball.
        for node in (6, 7, 9, 10):
            self.assertAlmostEqual(
                values.getValue((node, 0, 0)), 0.0625 * node - 0.5, delta=0.0625**2
            )

    def test_the_splash_is_less_than_three_times_its_active_values(self):
        _, surface = splash()
        surface.UpdateTimeStep(20)
        write(surface, self.file)
        grid = openvdb.read(str(self.file), "surface")
        self.assertGreater(grid.activeVoxelCount(), 10000)
        self.assertLess(self.file.stat().st_size, 3 * 4 * grid.activeVoxelCount())


class WeReadTheFilesOfOthers(WithAFolder):
    def test_grids_of_pyopenvdb(self):
        sphere = openvdb.createLevelSetSphere(radius=1.0, voxelSize=0.125)
        sphere.name = "sphere"
        sphere["about"] = "round"
        flags = openvdb.BoolGrid()
        flags.name = "flags"
        flags.fill((0, 0, 0), (9, 9, 9), True)
        arrows = openvdb.Vec3SGrid()
        arrows.name = "arrows"
        arrows.fill((-2, -2, -2), (2, 2, 2), (1, 2, 3))
        openvdb.write(str(self.file), grids=[flags, arrows, sphere], metadata={"by": "hand"})
        reader = vtkActiveVDBReader()
        reader.SetFileName(str(self.file))
        reader.Update()
        names = [reader.GetGridName(i) for i in range(reader.GetNumberOfGrids())]
        self.assertEqual(sorted(names), ["arrows", "flags", "sphere"])
        listed = reader.GetGridNames()
        self.assertEqual([listed.GetValue(i) for i in range(listed.GetNumberOfValues())], names)
        self.assertEqual(reader.GetGridMetadata(names.index("sphere"), "about"), "round")
        self.assertEqual(reader.GetMetadata("by"), "hand")
        image = reader.GetImageOutput()
        self.assertEqual(image.GetSpacing(), (0.125, 0.125, 0.125))
        values = sphere.getConstAccessor()
        for x in range(image.GetExtent()[0], image.GetExtent()[1] + 1):
            there = image.GetScalarComponentAsDouble(x, 1, 2, 0)
            self.assertEqual(there, values.getValue((x, 1, 2)))
        for name, count, value in (("flags", 10, 1), ("arrows", 5, 1)):
            reader.SetGridName(name)
            reader.Update()
            array = reader.GetImageOutput().GetPointData().GetArray(name)
            self.assertEqual(array.GetNumberOfTuples(), count**3)
            self.assertEqual(array.GetRange(0), (value, value))


class Refusals(WithAFolder):
    """Errors for data that no .vdb file can hold name the data as the cause, not the disk."""

    def refuse(self, image, voxel=-1.0):
        values = vtkFloatArray()
        values.SetName("a")
        values.SetNumberOfTuples(image.GetNumberOfPoints())
        values.Fill(1)
        image.GetPointData().AddArray(values)
        writer = vtkActiveVDBWriter()
        writer.SetInputDataObject(image)
        writer.SetFileName(str(self.file))
        writer.SetVoxelSize(voxel)
        listener = Listener(writer)
        self.assertEqual(writer.Write(), 0)
        self.assertFalse(self.file.exists())
        return "".join(listener.errors)

    def test_an_origin_or_a_spacing_that_is_not_finite(self):
        for number in (float("nan"), float("inf")):
            for set_number in (vtkImageData.SetOrigin, vtkImageData.SetSpacing):
                image = vtkImageData()
                image.SetDimensions(3, 3, 3)
                set_number(image, number, 1, 1)
                self.assertIn("is not finite; correct it.", self.refuse(image))

    def test_a_direction_matrix_without_inverse(self):
        image = vtkImageData()
        image.SetDimensions(3, 3, 3)
        image.SetDirectionMatrix(1, 0, 0, 1, 0, 0, 0, 0, 1)
        self.assertIn("the direction matrix has no inverse", self.refuse(image))

    def test_voxels_of_a_mesh_that_no_file_can_have(self):
        for voxel, said in (
            (1e-5, "has to be between 2e-05 and 1e+37"),
            (float("inf"), "has to be between 2e-05 and 1e+37"),
            (float("nan"), "VoxelSize has to be > 0"),
            (3e-5, "active voxels, more than 2^31; enlarge VoxelSize"),
        ):
            with self.subTest(voxel=voxel):
                self.assertIn(said, self.refuse(output_of(ball_mesh()), voxel))


if __name__ == "__main__":
    unittest.main()
