"""States of a session and data, saved and read again."""

import os
import unittest
from pathlib import Path

from paraview import servermanager
from paraview.simple import (
    ActiveImplicitSurfaceFunctions,
    FindSource,
    GetSources,
    LoadState,
    OpenDataFile,
    OutputPort,
    PolyLineSource,
    RenameSource,
    ResetSession,
    SaveData,
    SaveState,
)
from scenes import bytes_of, skin_bytes, splash

FOLDER = Path(os.environ.get("ACTIVE_TEST_OUTPUT", "."))


class States(unittest.TestCase):
    def setUp(self):
        ResetSession()

    def test_a_state_has_all_of_the_surface(self):
        surface, _ = splash(Tension=0.01, VolumeControl=2, IdArray=["POINTS", "id"])
        surface.InitialFunction = "Sphere"
        surface.InitialFunction.Radius = 0.4
        surface.InitialFunction.Center = [0.5, 0.5, 0.5]
        RenameSource("Water", surface)
        expected = skin_bytes(surface, 3)
        for suffix in (".pvsm", ".py"):
            SaveState(str(FOLDER / f"splash{suffix}"))
        for suffix in (".pvsm", ".py"):
            with self.subTest(suffix):
                ResetSession()
                self.assertEqual(len(GetSources()), 0)
                LoadState(str(FOLDER / f"splash{suffix}"))
                loaded = FindSource("Water")
                self.assertEqual(skin_bytes(loaded, 3), expected)
                self.assertEqual(loaded.InitialFunction.Radius, 0.4)

    def test_a_state_has_the_functions_and_their_inputs(self):
        surface = ActiveImplicitSurfaceFunctions(
            TargetFunction="Skeleton Potential", VoxelSize=0.1, ModelBounds=[-2, 2, -1, 1, -1, 1]
        )
        surface.TargetFunction.Input = PolyLineSource(Points=[-1, 0, 0, 0, 0.5, 0, 1, 0, 0])
        surface.TargetFunction.Radius = 0.9
        RenameSource("Tube", surface)
        expected = skin_bytes(surface, 0.5)
        SaveState(str(FOLDER / "tube.pvsm"))
        ResetSession()
        LoadState(str(FOLDER / "tube.pvsm"))
        self.assertEqual(skin_bytes(FindSource("Tube"), 0.5), expected)


class Data(unittest.TestCase):
    def test_each_output_is_read_again_as_it_was(self):
        ResetSession()
        surface, _ = splash()
        surface.UpdatePipeline(3)
        for port, suffix in enumerate((".vtp", ".vti", ".csv")):
            file = str(FOLDER / f"saved{suffix}")
            # With the newest libexpat of Debian 12, ParaView 5.11 cannot read appended data.
            mode = {} if suffix == ".csv" else {"DataMode": "Binary"}
            SaveData(file, proxy=OutputPort(surface, port), **mode)
            read = OpenDataFile(file)
            read.UpdatePipeline()
            saved, back = servermanager.Fetch(surface, idx=port), servermanager.Fetch(read)
            if port == 0:
                self.assertEqual(bytes_of(saved), bytes_of(back))
            elif port == 1:
                self.assertEqual(saved.GetExtent(), back.GetExtent())
                self.assertEqual(saved.GetScalarRange(), back.GetScalarRange())
            else:
                self.assertEqual(saved.GetNumberOfRows(), 4)
                self.assertEqual(saved.GetNumberOfColumns(), back.GetNumberOfColumns())
                for row in range(4):
                    volumes = [t.GetValueByName(row, "Volume").ToDouble() for t in (saved, back)]
                    self.assertAlmostEqual(volumes[0], volumes[1], delta=1e-4)  # five digits


if __name__ == "__main__":
    unittest.main()
