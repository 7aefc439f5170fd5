"""The example in ParaView and the plain Python example give bitwise identical results.

Run: pvbatch test_same_bytes.py <folder of the plain one> <folder of ParaView's>
"""

import sys
import unittest
from pathlib import Path

from scenes import bytes_of
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

FOLDERS = {Path(sys.argv.pop(1)): "skin_{:04}.vtp", Path(sys.argv.pop(1)): "pv_skin_{:04}.vtp"}
STEPS = 41


class SameBytes(unittest.TestCase):
    def test_points_triangles_and_normals(self):
        for step in range(STEPS):
            plain, in_paraview = (
                self.read(folder / name.format(step)) for folder, name in FOLDERS.items()
            )
            self.assertEqual(plain, in_paraview, f"step {step}")

    def read(self, file):
        self.assertTrue(file.is_file(), f"{file} is not there")
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(str(file))
        reader.Update()
        return bytes_of(reader.GetOutput())


if __name__ == "__main__":
    unittest.main()
