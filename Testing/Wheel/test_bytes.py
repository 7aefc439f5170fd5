"""A wheel produces the hashes of Testing/Baselines/hashes.json, like the build with Debian's VTK,
except for meshes that its VTK splits into other triangles.

Run by Testing/Wheel/run, in an environment with the wheel.
"""

import json
import subprocess
import sys
import unittest
from pathlib import Path

import active_implicit_surfaces

TESTING = Path(__file__).resolve().parents[1]
OPENVDB = "libopenvdb-*.so.10.*"  # version of the baseline
# VTK 9.7 cuts a quadrangle into triangles whose corners have another order than in VTK 9.1.
CUT_BY_VTK = {"mesh", "mesh_moves"}


class SameBytes(unittest.TestCase):
    maxDiff = None

    def test_hashes_are_those_of_the_table(self):
        bundled = Path(active_implicit_surfaces.__file__).parents[1]
        if not list(bundled.glob(f"active_implicit_surfaces.libs/{OPENVDB}")):
            self.skipTest("the wheel has another OpenVDB than the table of hashes")
        groups = json.loads((TESTING / "Baselines" / "hashes.json").read_text())
        expected = {name: value for group in groups.values() for name, value in group.items()}
        said = subprocess.run(
            [sys.executable, str(TESTING / "Python" / "test_same_bytes.py"), "--print"],
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        found = dict(line.split(" ", 1) for line in said.splitlines())
        for name in CUT_BY_VTK:
            expected.pop(name)
            found.pop(name)
        self.assertEqual(found, expected)


if __name__ == "__main__":
    unittest.main()
