"""Files in ParaView: .vdb and .exr by Save Data, Open and Save Screenshot."""

import os
import unittest
from pathlib import Path

import numpy
from active_implicit_surfaces import (
    render,
    vtkActiveEXRReader,
    vtkActiveVDBReader,
    vtkActiveVDBWriter,
)
from paraview import servermanager
from paraview.simple import (
    ActiveImplicitSurface,
    Delete,
    ExtractSubset,
    FindSource,
    GetActiveViewOrCreate,
    GetRenderViews,
    GetTimeKeeper,
    LoadState,
    OpenDataFile,
    OutputPort,
    Plane,
    RenameSource,
    ResetCamera,
    ResetSession,
    SaveData,
    SaveScreenshot,
    SaveState,
    Show,
    Sphere,
    Wavelet,
)
from scenes import COARSE, splash
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkProbeFilter
from vtkmodules.vtkIOImage import vtkPNGReader

FOLDER = Path(os.environ.get("ACTIVE_TEST_OUTPUT", ".")) / "paraview_files"


def values_of(source, name, time=0.0):
    source.UpdatePipeline(time)
    return vtk_to_numpy(servermanager.Fetch(source).GetPointData().GetArray(name))


def grids_of(path):
    """Reads a .vdb without ParaView; returns names of the grids, metadata and the reader."""
    reader = vtkActiveVDBReader()
    reader.SetFileName(str(path))
    reader.Update()
    names = [reader.GetGridName(i) for i in range(reader.GetNumberOfGrids())]
    return sorted(names), reader.GetAllMetadata(), reader


class Files(unittest.TestCase):
    def setUp(self):
        ResetSession()
        FOLDER.mkdir(parents=True, exist_ok=True)

    def tearDown(self):
        for view in GetRenderViews():  # ParaView 5.11 crashes at exit if a view exists
            Delete(view)
        ResetSession()

    def path(self, name):
        path = FOLDER / name
        path.unlink(missing_ok=True)
        return path


class VDB(Files):
    def test_a_skin_is_written_from_its_own_grid(self):
        surface, _ = splash(ComputeVelocity=1)
        surface.UpdatePipeline(3)
        path, plain = self.path("skin.vdb"), self.path("plain.vdb")
        SaveData(
            str(path),
            proxy=OutputPort(surface, 0),
            WriteState=1,
            WriteDensity=1,
            WriteVelocity=1,
            Units="m",
        )
        names, told, reader = grids_of(path)
        self.assertEqual(names, ["density", "potential", "surface", "v"])
        for entry in ("motion_Attraction: 100", "time: 3", "frame: 3", "units: m"):
            self.assertIn(entry, told)
        writer = vtkActiveVDBWriter()
        writer.SetInputConnection(surface.GetClientSideObject().GetOutputPort(0))
        writer.SetFileName(str(plain))
        self.assertEqual(writer.Write(), 1)
        _, _, expected = grids_of(plain)
        first, second = (
            vtk_to_numpy(r.GetImageOutput().GetPointData().GetArray("surface"))
            for r in (reader, expected)
        )
        self.assertEqual(first.tobytes(), second.tobytes())
        self.assertEqual(reader.GetImageOutput().GetSpacing(), (COARSE["VoxelSize"],) * 3)

    def test_what_is_read_is_the_distance_to_the_skin(self):
        surface, _ = splash()
        surface.UpdatePipeline(3)
        path = self.path("round.vdb")
        SaveData(str(path), proxy=OutputPort(surface, 0))
        level_set = OpenDataFile(str(path))
        level_set.UpdatePipeline()
        probe = vtkProbeFilter()
        probe.SetInputData(servermanager.Fetch(surface, idx=0))
        probe.SetSourceData(servermanager.Fetch(level_set))
        probe.Update()
        found = probe.GetOutput().GetPointData()
        self.assertTrue(vtk_to_numpy(found.GetArray("vtkValidPointMask")).all())
        # Points of the skin are on the lattice's edges. The slope of a distance is at most 1. In
        # the middle of an edge, the mean of the distances at its ends is therefore off by at most
        # half a voxel.
        self.assertLess(
            abs(vtk_to_numpy(found.GetArray("surface"))).max(), 0.5 * COARSE["VoxelSize"]
        )

    def test_a_level_set_is_a_target(self):
        surface, _ = splash()
        surface.UpdatePipeline(0)
        path = self.path("target.vdb")
        SaveData(str(path), proxy=OutputPort(surface, 0))
        level_set = OpenDataFile(str(path))
        again = ActiveImplicitSurface(Input=level_set, VoxelSize=COARSE["VoxelSize"])
        again.UpdatePipeline(0)
        bounds = again.GetDataInformation(0).GetBounds()
        for found, expected in zip(bounds, surface.GetDataInformation(0).GetBounds()):
            self.assertLess(abs(found - expected), COARSE["VoxelSize"])

    def test_a_series_has_the_time_steps_of_the_skin(self):
        surface = ActiveImplicitSurface(Input=Sphere(), NumberOfTimeSteps=3, TimeStepSize=0.5)
        surface.Initial = Sphere(Radius=0.3)
        paths = [self.path(f"growing.{step:04d}.vdb") for step in range(3)]
        SaveData(str(FOLDER / "growing.vdb"), proxy=OutputPort(surface, 0), WriteAllTimeSteps=1)
        ResetSession()
        series = OpenDataFile([str(path) for path in paths])
        RenameSource("Series", series)
        self.assertEqual(list(series.TimestepValues), [0, 0.5, 1])
        self.assertEqual(list(GetTimeKeeper().TimestepValues), [0, 0.5, 1])
        volumes = [(values_of(series, "surface", time) < 0).sum() for time in (0, 0.5, 1)]
        self.assertEqual(sorted(set(volumes)), volumes, "it grows")
        self.assertEqual((values_of(series, "surface", 0) < 0).sum(), volumes[0], "and back")
        SaveState(str(FOLDER / "series.pvsm"))
        ResetSession()
        LoadState(str(FOLDER / "series.pvsm"))
        loaded = FindSource("Series")
        self.assertEqual((values_of(loaded, "surface", 1) < 0).sum(), volumes[2])

    def test_grids_and_their_part_are_chosen(self):
        surface, _ = splash()
        surface.UpdatePipeline(0)
        path = self.path("grids.vdb")
        SaveData(str(path), proxy=OutputPort(surface, 0), WriteDensity=1)
        reader = OpenDataFile(str(path))
        self.assertEqual(sorted(reader.GetProperty("GridName").Available), ["density", "surface"])
        reader.GridName = ["density"]
        self.assertAlmostEqual(values_of(reader, "density").max(), 1, places=6)
        reader.GridName = ["density", "surface"]
        reader.UpdatePipeline()
        self.assertEqual(servermanager.Fetch(reader).GetPointData().GetNumberOfArrays(), 2)
        reader.GridName = []
        self.assertLess(values_of(reader, "surface").min(), 0)
        reader.Region = "Index"
        reader.IndexRegion = [0, 3, 0, 3, 0, 5]
        self.assertEqual(len(values_of(reader, "surface")), 4 * 4 * 6)
        reader.DownsamplingFactor = 2
        # Samples are at 0, 2 and 4, and along z at 6 too, so that the region is covered.
        self.assertEqual(len(values_of(reader, "surface")), 3 * 3 * 4)

    def test_an_image_comes_back(self):
        wavelet = Wavelet(WholeExtent=[-3, 4, -2, 5, 0, 6])
        path = self.path("image.vdb")
        SaveData(str(path), proxy=wavelet)
        self.assertEqual(
            values_of(OpenDataFile(str(path)), "RTData").tobytes(),
            values_of(wavelet, "RTData").tobytes(),
        )

    def test_an_open_mesh_makes_no_file(self):
        path = self.path("open.vdb")
        print("An error follows, and is expected:", flush=True)
        SaveData(str(path), proxy=Plane())
        self.assertFalse(path.exists())


class EXR(Files):
    def test_a_slice_of_the_potential_comes_back(self):
        surface, _ = splash()
        surface.UpdatePipeline(2)
        extent = list(surface.GetDataInformation(1).GetExtent())
        extent[4] = extent[5] = (extent[4] + extent[5]) // 2
        middle = ExtractSubset(Input=OutputPort(surface, 1), VOI=extent)
        middle.UpdatePipeline(2)
        path = self.path("slice.exr")
        SaveData(str(path), proxy=middle)
        found = OpenDataFile(str(path))
        self.assertEqual(
            values_of(found, "Potential").tobytes(), values_of(middle, "Potential", 2).tobytes()
        )

    def test_a_series_has_time_steps(self):
        surface = ActiveImplicitSurface(Input=Sphere(), NumberOfTimeSteps=3, TimeStepSize=0.5)
        surface.Initial = Sphere(Radius=0.3)
        surface.ModelBounds = [-1, 1, -1, 1, -1, 1]
        surface.UpdatePipeline(0)
        extent = list(surface.GetDataInformation(1).GetExtent())
        extent[4:] = [0, 0]
        middle = ExtractSubset(Input=OutputPort(surface, 1), VOI=extent)
        paths = [self.path(f"growing.{step:04d}.exr") for step in range(3)]
        SaveData(str(FOLDER / "growing.exr"), proxy=middle, WriteAllTimeSteps=1)
        series = OpenDataFile([str(path) for path in paths])
        self.assertEqual(list(series.TimestepValues), [0, 0.5, 1])
        for time in (1, 0, 0.5):
            expected = values_of(middle, "Potential", time).tobytes()
            self.assertEqual(values_of(series, "Potential", time).tobytes(), expected)

    def test_a_screenshot_is_light(self):
        view = GetActiveViewOrCreate("RenderView")
        view.ViewSize = [64, 48]
        view.OrientationAxesVisibility = 0
        Show(Sphere(), view)
        png, exr = self.path("view.png"), self.path("view.exr")
        SaveScreenshot(str(png), view)
        SaveScreenshot(str(exr), view)
        pictures = {}
        # ParaView's own reader of .png converts pixels to cells.
        for reader, path in ((vtkPNGReader(), png), (vtkActiveEXRReader(), exr)):
            reader.SetFileName(str(path))
            reader.Update()
            self.assertEqual(reader.GetOutput().GetDimensions(), (64, 48, 1))
            colors = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
            pictures[path] = colors[:, :3].astype(float)
        display = pictures[png] / 255
        light = numpy.where(display <= 0.04045, display / 12.92, ((display + 0.055) / 1.055) ** 2.4)
        # A half float has 11 bits.
        self.assertLess(abs(pictures[exr] - light).max(), 2.0**-11)
        self.assertGreater(light.max() - light.min(), 0.2, "there is something to see")

    def test_layers_of_a_view_are_those_of_the_ball_in_it(self):
        view = GetActiveViewOrCreate("RenderView")
        view.ViewSize = [160, 120]
        view.OrientationAxesVisibility = 0
        Show(Sphere(Radius=0.5, ThetaResolution=64, PhiResolution=64), view)
        ResetCamera(view)
        path = self.path("layers.exr")
        render.write_exr(view.GetRenderWindow(), path, renderer=view.GetRenderer())
        layers = OpenDataFile(str(path))
        seen = values_of(layers, "id") > 0
        self.assertEqual(seen.sum(), (values_of(layers, "Z") < render.FAR / 2).sum())
        self.assertGreater(seen.sum(), 1000)
        places, normals = (values_of(layers, name)[seen].astype(float) for name in ("P", "N"))
        # The middle of a facet, at most 1/64 of a turn in both directions, is nearer to the center
        # by the sagitta. The depth buffer's 24 bits add less than 1e-4 here.
        sagitta = 0.5 * (1 - numpy.cos(numpy.pi / 64) ** 2)
        distances = numpy.linalg.norm(places, axis=1)
        self.assertLess(abs(distances - 0.5).max(), sagitta + 1e-4)
        turned = numpy.einsum("ij,ij->i", places, normals) / distances
        self.assertGreater(turned.min(), numpy.cos(numpy.pi / 64))


if __name__ == "__main__":
    # ParaView cleans up in the right order only if the script reaches its end.
    if not unittest.main(exit=False).result.wasSuccessful():
        raise SystemExit(1)
