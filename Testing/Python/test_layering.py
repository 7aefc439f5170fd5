"""Who may include whom: Surfaces -> NarrowBand <- IO, and the examples see only what is installed.

Each rule is first shown to find a file that breaks it, in a tree made up for that.
"""

import re
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*["<]([^">]+)[">]', re.MULTILINE)
IMPORT_FROM_SOURCE = re.compile(r"sys\.path")
PIPELINE_HEADER = re.compile(r"(.*/)?vtk\w*\.h$")
# Export macros, the ABI namespace that newer VTKs wrap everything in, and the keys by which data
# objects carry what is the band's.
NOT_PIPELINE = re.compile(
    r"vtkActiveNarrowBandModule\.h$|vtkABI\w*\.h$|vtkInformation\w*\.h$|vtkObjectBase\.h$"
)
NOT_FOR_WRAPPED_HEADERS = re.compile(
    r"(openvdb|nanovdb|tbb|oneapi|OpenEXR|Imath)/|Imf\w*\.h$|tbb\.h$"
)

SOURCES = (".h", ".cxx", ".txx", ".cpp", ".hpp")
# The folders of Filters that each folder of Filters may include.
MAY_INCLUDE = {
    "NarrowBand": {"NarrowBand"},
    "Surfaces": {"Surfaces", "NarrowBand"},
    "IO": {"IO", "NarrowBand"},
}


def sources_in(folder):
    return sorted(path for path in folder.rglob("*") if path.suffix in SOURCES)


def includes_of(path):
    return INCLUDE.findall(path.read_text(encoding="utf-8"))


def find_in_filters(root, include):
    """The file of Filters that an include names, whichever way it spells the path, or None."""
    for folder in MAY_INCLUDE:
        path = root / "Filters" / folder / Path(include).name
        if path.is_file():
            return path
    return None


def reached_includes(root, header):
    """What a header includes, and what the headers of Filters that it includes do."""
    reached, waiting = set(), [header]
    while waiting:
        for include in set(includes_of(waiting.pop())) - reached:
            reached.add(include)
            own = find_in_filters(root, include)
            if own:
                waiting.append(own)
    return sorted(reached)


def reached_by_test(root, test):
    """What a C++ test includes, and what the tests' own headers that it includes do."""
    tests = root / "Testing" / "Cxx"
    reached, waiting = set(), [test]
    while waiting:
        for include in set(includes_of(waiting.pop())) - reached:
            reached.add(include)
            if (tests / include).is_file():
                waiting.append(tests / include)
    return sorted(reached)


def find_broken_arrows(root):
    """One sentence for each include that breaks a rule."""
    broken = []

    def complain(path, include, why):
        broken.append(f"{path.relative_to(root)} includes {include}: {why}")

    for folder, allowed in MAY_INCLUDE.items():
        for path in sources_in(root / "Filters" / folder):
            for include in includes_of(path):
                own = find_in_filters(root, include)
                if own and own.parent.name not in allowed:
                    complain(path, include, f"{folder} does not know {own.parent.name}")
                is_pipeline = PIPELINE_HEADER.match(include) and not NOT_PIPELINE.search(include)
                if folder == "NarrowBand" and is_pipeline:
                    complain(path, include, "the numerics know no VTK")
            if path.name.startswith("vtk") and path.suffix == ".h":
                for include in reached_includes(root, path):
                    if NOT_FOR_WRAPPED_HEADERS.match(include):
                        complain(path, include, "a wrapped header shows no OpenVDB, TBB or OpenEXR")

    for path in sources_in(root / "Testing" / "Cxx" / "NarrowBand"):
        for include in reached_by_test(root, path):
            if PIPELINE_HEADER.match(include):
                complain(path, include, "the numerics are tested without VTK")

    for path in sources_in(root / "Examples"):
        for include in includes_of(path):
            if "Filters/" in include or ".." in include:
                complain(path, include, "examples see only the installed package")
    for path in sorted((root / "Examples").rglob("*.py")):
        for found in IMPORT_FROM_SOURCE.findall(path.read_text(encoding="utf-8")):
            complain(path, found, "examples see only the installed package")
    return broken


class RulesFindWhatBreaksThem(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.write("Filters/NarrowBand/NarrowBand.h", "#include <openvdb/openvdb.h>")
        self.write("Filters/NarrowBand/Motion.h", '#include "vtkActiveNarrowBandModule.h"')
        self.write("Filters/Surfaces/vtkSkin.h", '#include "vtkObject.h"\n#include "Motion.h"')
        self.write("Filters/Surfaces/vtkSkin.cxx", '#include "vtkSkin.h"\n#include "NarrowBand.h"')
        self.write("Filters/IO/vtkReader.h", '#include "vtkObject.h"')
        self.write("Filters/IO/vtkReader.cxx", '#include "NarrowBand.h"\n#include <ImfPart.h>')
        self.write("Examples/Cxx/coat.cxx", "#include <vtkSkin.h>\n#include <iostream>")

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text + "\n", encoding="utf-8")

    def assert_found(self, name, text, include):
        """With this file in it, exactly this include breaks a rule."""
        self.write(name, text)
        broken = find_broken_arrows(self.root)
        self.assertEqual(len(broken), 1, broken)
        self.assertTrue(broken[0].startswith(f"{name} includes {include}: "), broken)

    def test_a_tree_in_order_has_nothing_to_find(self):
        self.assertEqual(find_broken_arrows(self.root), [])

    def test_pipeline_header_in_narrow_band(self):
        for header in ("vtkImageAlgorithm.h", "vtkObject.h", "vtk-9.1/vtkPolyData.h"):
            self.assert_found("Filters/NarrowBand/Bad.cxx", f"# include <{header}>", header)

    def test_surfaces_in_narrow_band(self):
        self.write("Filters/Surfaces/Frames.h", "")
        self.assert_found("Filters/NarrowBand/Bad.h", '#include "Frames.h"', "Frames.h")
        self.assert_found(
            "Filters/NarrowBand/Bad.h", '#include "../Surfaces/Frames.h"', "../Surfaces/Frames.h"
        )

    def test_openvdb_tbb_and_openexr_in_a_wrapped_header(self):
        for header in ("openvdb/openvdb.h", "tbb/tbb.h", "OpenEXR/ImfHeader.h", "ImfHeader.h"):
            self.assert_found("Filters/Surfaces/vtkBad.h", f"#include <{header}>", header)
        (self.root / "Filters/Surfaces/vtkBad.h").unlink()
        self.assert_found(
            "Filters/IO/vtkBad.h", "#include <openvdb/io/File.h>", "openvdb/io/File.h"
        )

    def test_openvdb_in_a_wrapped_header_by_way_of_another(self):
        self.assert_found(
            "Filters/Surfaces/vtkBad.h", '#include "NarrowBand.h"', "openvdb/openvdb.h"
        )

    def test_surfaces_and_io_in_each_other(self):
        self.assert_found("Filters/Surfaces/Bad.cxx", '#include "vtkReader.h"', "vtkReader.h")
        (self.root / "Filters/Surfaces/Bad.cxx").unlink()
        self.assert_found("Filters/IO/Bad.cxx", '#include "vtkSkin.h"', "vtkSkin.h")

    def test_vtk_in_a_test_of_the_numerics(self):
        bad = "Testing/Cxx/NarrowBand/TestBad.cxx"
        self.assert_found(bad, '#include "vtkPoints.h"', "vtkPoints.h")
        self.write("Testing/Cxx/Support/Scene.h", "#include <vtkSphere.h>")
        self.assert_found(bad, '#include "Support/Scene.h"', "vtkSphere.h")

    def test_source_tree_in_an_example(self):
        bad = "../../Filters/Surfaces/vtkSkin.h"
        self.assert_found("Examples/Cxx/bad.cxx", f'#include "{bad}"', bad)
        (self.root / "Examples/Cxx/bad.cxx").unlink()
        self.assert_found("Examples/Python/bad.py", "import sys\nsys.path.append('.')", "sys.path")


class ThisTree(unittest.TestCase):
    def test_no_arrow_is_broken(self):
        for folder in ("Filters/NarrowBand", "Filters/Surfaces", "Testing/Cxx/NarrowBand"):
            self.assertTrue(sources_in(ROOT / folder), f"no sources in {folder}")
        broken = find_broken_arrows(ROOT)
        self.assertEqual(broken, [], "\n".join(broken))


if __name__ == "__main__":
    unittest.main()
