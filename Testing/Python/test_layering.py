# ctest: WITHOUT_PACKAGE LABELS contract
"""Rules of inclusion: the rooms of Filters are one stack (rooms.py), and includes run downwards.

An include names its room: `#include "Leaves/LeafTable.h"`. Some rooms are private to their module.
Prints the floors of the present tree. Most rules are also tested on a small tree that breaks the
rule.
"""

import re
import tempfile
import unittest
from collections import defaultdict
from pathlib import Path

from rooms import ALONE, APART, MODULES, PRIVATE, STACK

ROOT = Path(__file__).resolve().parents[2]

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*["<]([^">]+)[">]', re.MULTILINE)
IMPORT_FROM_SOURCE = re.compile(r"sys\.path")
VTK_HEADER = re.compile(r"(.*/)?vtk\w*\.h$")
NOT_FOR_WRAPPED_HEADERS = re.compile(
    r"(openvdb|nanovdb|tbb|oneapi|OpenEXR|Imath)/|Imf\w*\.h$|tbb\.h$"
)
# Libraries that are built once, for VTK and for ParaView's VTK.
NUMERICS = ("LevelSet", "Files")
# Headers that many sources include, so that each would need seconds to compile OpenVDB.
WITHOUT_OPENVDB = (
    "LevelSet/NarrowBand.h",
    "LevelSet/Base/Obstacle.h",
    "Shapes/Input/AttachedData.h",
    "Files/SavedState.h",
)
SOURCES = (".h", ".cxx", ".txx", ".cpp", ".hpp")


def module_of(name):
    return name.split("/")[0]


def room_of(unit):
    return unit.rsplit("/", 1)[0]


def sources_in(folder):
    return sorted(path for path in folder.rglob("*") if path.suffix in SOURCES)


def includes_of(path):
    return INCLUDE.findall(path.read_text(encoding="utf-8"))


def unit_of(root, path):
    """Unit of a header and its source: LevelSet/Leaves/LeafTable."""
    return path.relative_to(root / "Filters").with_suffix("").as_posix()


def find_in_filters(root, include):
    """File of Filters that an include names, or refers to without its room."""
    named = [root / "Filters" / module / include for module in MODULES]
    meant = sorted((root / "Filters").rglob(Path(include).name))
    return next((path for path in [*named, *meant] if path.is_file()), None)


def names_its_room(root, path, include):
    return include == path.relative_to(root / "Filters").as_posix().split("/", 1)[1]


def is_allowed(unit, other):
    room, below = room_of(unit), room_of(other)
    if room == below:
        return True
    modules = (module_of(room), module_of(below))
    if modules in APART or (below in PRIVATE and modules[0] != modules[1]):
        return False
    if room in ALONE and other not in ALONE[room]:
        return False
    return below in STACK and room in STACK and STACK.index(below) < STACK.index(room)


def reached_includes(root, header):
    reached, waiting = set(), [header]
    while waiting:
        for include in set(includes_of(waiting.pop())) - reached:
            reached.add(include)
            own = find_in_filters(root, include)
            if own:
                waiting.append(own)
    return sorted(reached)


def reached_by_test(root, test):
    """Direct and indirect includes of a C++ test, through the tests' own headers."""
    tests = root / "Testing" / "Cxx"
    reached, waiting = set(), [test]
    while waiting:
        for include in set(includes_of(waiting.pop())) - reached:
            reached.add(include)
            if (tests / include).is_file():
                waiting.append(tests / include)
    return sorted(reached)


def find_arrows(root):
    arrows = defaultdict(set)
    for path in sources_in(root / "Filters"):
        unit = unit_of(root, path)
        arrows[unit] |= set()
        for include in includes_of(path):
            own = find_in_filters(root, include)
            if own and unit_of(root, own) != unit:
                arrows[unit].add(unit_of(root, own))
    return arrows


def find_floors(arrows):
    """Returns for each unit its floor, above all units that it includes.

    Raises ValueError for a cycle.
    """
    floors, open_units = {}, []

    def floor(unit):
        if unit in open_units:
            raise ValueError(" -> ".join([*open_units[open_units.index(unit) :], unit]))
        if unit not in floors:
            open_units.append(unit)
            floors[unit] = 1 + max((floor(other) for other in arrows[unit]), default=-1)
            open_units.pop()
        return floors[unit]

    for unit in sorted(arrows):
        floor(unit)
    return floors


def describe_floors(arrows):
    """Stack of each module, from the top down."""
    lines = []
    for module in MODULES:
        own = {
            unit: {other for other in others if module_of(other) == module}
            for unit, others in arrows.items()
            if module_of(unit) == module
        }
        floors = find_floors(own)
        lines.append(f"{module}, {len(own)} units:")
        for level in range(max(floors.values(), default=-1), -1, -1):
            units = sorted(unit[len(module) + 1 :] for unit in own if floors[unit] == level)
            lines.append(f"  {level:2} {' '.join(units)}")
    return "\n".join(lines)


def find_broken_includes(root, path):
    """(include, reason) of each violation in a file of Filters."""
    unit = unit_of(root, path)
    for include in includes_of(path):
        own = find_in_filters(root, include)
        if own and not is_allowed(unit, unit_of(root, own)):
            yield include, f"{room_of(unit)} may not include {unit_of(root, own)}"
        elif own and not names_its_room(root, own, include):
            yield include, f"the room is not named: {own.relative_to(root / 'Filters')}"
        is_wrapped = path.name.startswith("vtk") and path.suffix == ".h"
        is_openvdb = include.startswith("openvdb/") and unit != "LevelSet/Base/OpenVDB"
        is_first = include == "openvdb/openvdb.h" or "Base/OpenVDB.h" not in includes_of(path)
        if is_openvdb and is_first and not is_wrapped:
            yield include, "OpenVDB is included by OpenVDB.h, which makes its templates visible"
        if module_of(unit) in NUMERICS and VTK_HEADER.match(include) and not own:
            yield include, "the numerics know no VTK"
    if path.relative_to(root / "Filters").as_posix() in WITHOUT_OPENVDB:
        for include in reached_includes(root, path):
            if include.startswith("openvdb/"):
                yield include, "sources that need no OpenVDB would read it"
    if path.name.startswith("vtk") and path.suffix == ".h":
        for include in reached_includes(root, path):
            if NOT_FOR_WRAPPED_HEADERS.match(include):
                yield include, "a wrapped header shows no OpenVDB, TBB or OpenEXR"


def find_broken_arrows(root):
    """Returns a message for each include that breaks a rule, and one for a cycle."""
    broken = [
        f"{path.relative_to(root)} includes {include}: {why}"
        for path in sources_in(root / "Filters")
        for include, why in find_broken_includes(root, path)
    ]
    for path in sources_in(root / "Testing" / "Cxx" / "LevelSet"):
        for include in reached_by_test(root, path):
            if VTK_HEADER.match(include):
                broken.append(
                    f"{path.relative_to(root)} includes {include}: "
                    "the numerics are tested without VTK"
                )
    for path in sources_in(root / "Examples"):
        for include in includes_of(path):
            if "Filters/" in include or ".." in include:
                broken.append(
                    f"{path.relative_to(root)} includes {include}: "
                    "examples see only the installed package"
                )
    for path in sorted((root / "Examples").rglob("*.py")):
        for found in IMPORT_FROM_SOURCE.findall(path.read_text(encoding="utf-8")):
            broken.append(
                f"{path.relative_to(root)} includes {found}: "
                "examples see only the installed package"
            )
    try:
        find_floors(find_arrows(root))
    except ValueError as error:
        broken.append(f"includes run in a circle: {error}")
    return broken


class RulesFindWhatBreaksThem(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.write("Filters/LevelSet/Base/OpenVDB.h", "#include <openvdb/openvdb.h>")
        self.write("Filters/LevelSet/NarrowBand.h", '#include "Base/Motion.h"')
        self.write("Filters/LevelSet/NarrowBandGrid.h", '#include "Base/OpenVDB.h"')
        self.write("Filters/LevelSet/NarrowBand.cxx", '#include "Leaves/LeafTable.h"')
        self.write("Filters/LevelSet/Base/Motion.h", '#include "ActiveLevelSetExport.h"')
        self.write("Filters/LevelSet/Leaves/LeafTable.h", '#include "Base/OpenVDB.h"')
        self.write("Filters/Shapes/vtkBall.h", '#include "vtkObject.h"')
        self.write("Filters/Surfaces/vtkSkin.h", '#include "vtkObject.h"')
        self.write("Filters/Surfaces/vtkSkin.cxx", '#include "vtkSkin.h"\n#include "vtkBall.h"')
        self.write(
            "Filters/Surfaces/Targets/Ball.h", '#include "Base/Motion.h"\n#include "vtkBall.h"'
        )
        self.write("Filters/Surfaces/Simulation/Run.h", '#include "Targets/Ball.h"')
        self.write("Filters/IO/vtkReader.h", '#include "vtkObject.h"')
        self.write("Filters/IO/vtkReader.cxx", '#include "NarrowBand.h"\n#include <ImfPart.h>')
        self.write("Examples/Cxx/coat.cxx", "#include <vtkSkin.h>\n#include <iostream>")

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text + "\n", encoding="utf-8")

    def assert_found(self, name, text, include):
        """Checks that with this file, exactly this include breaks a rule."""
        self.write(name, text)
        broken = find_broken_arrows(self.root)
        self.assertEqual(len(broken), 1, broken)
        self.assertTrue(broken[0].startswith(f"{name} includes {include}: "), broken)
        (self.root / name).unlink()

    def test_a_tree_in_order_has_nothing_to_find(self):
        self.assertEqual(find_broken_arrows(self.root), [])

    def test_vtk_header_in_narrow_band(self):
        for header in ("vtkImageAlgorithm.h", "vtkObject.h", "vtk-9.1/vtkPolyData.h"):
            self.assert_found("Filters/LevelSet/Bad.cxx", f"# include <{header}>", header)
            self.assert_found("Filters/Files/Bad.cxx", f"# include <{header}>", header)

    def test_openvdb_in_a_header_of_many(self):
        for header in ("Files/SavedState.h", "Shapes/Input/AttachedData.h"):
            text = '#include "NarrowBandGrid.h"'
            self.assert_found(f"Filters/{header}", text, "openvdb/openvdb.h")

    def test_module_above(self):
        self.assert_found("Filters/LevelSet/Bad.h", '#include "vtkBall.h"', "vtkBall.h")
        self.assert_found("Filters/Shapes/Bad.h", '#include "vtkSkin.h"', "vtkSkin.h")
        self.assert_found("Filters/Surfaces/Bad.cxx", '#include "vtkReader.h"', "vtkReader.h")
        self.assert_found("Filters/IO/Bad.cxx", '#include "vtkSkin.h"', "vtkSkin.h")

    def test_room_above(self):
        self.assert_found(
            "Filters/Surfaces/Targets/Bad.h", '#include "Simulation/Run.h"', "Simulation/Run.h"
        )
        self.assert_found(
            "Filters/LevelSet/Leaves/Bad.h", '#include "NarrowBand.h"', "NarrowBand.h"
        )

    def test_private_room_of_another_module(self):
        self.assert_found(
            "Filters/IO/Bad.cxx", '#include "Leaves/LeafTable.h"', "Leaves/LeafTable.h"
        )

    def test_include_that_does_not_name_its_room(self):
        for include in ("LeafTable.h", "../LevelSet/Leaves/LeafTable.h"):
            self.assert_found("Filters/LevelSet/Bad.h", f'#include "{include}"', include)

    def test_circle_between_the_files_of_a_room(self):
        self.write("Filters/LevelSet/Leaves/LeafTable.h", '#include "Leaves/Layers.h"')
        self.write("Filters/LevelSet/Leaves/Layers.cxx", '#include "Leaves/LeafTable.h"')
        self.write("Filters/LevelSet/Leaves/Layers.h", "")
        broken = find_broken_arrows(self.root)
        self.assertEqual(len(broken), 1, broken)
        self.assertIn("circle: LevelSet/Leaves/LeafTable -> ", broken[0])

    def test_openvdb_tbb_and_openexr_in_a_wrapped_header(self):
        for header in ("openvdb/openvdb.h", "tbb/tbb.h", "OpenEXR/ImfHeader.h", "ImfHeader.h"):
            self.assert_found("Filters/Surfaces/vtkBad.h", f"#include <{header}>", header)
        self.assert_found(
            "Filters/IO/vtkBad.h", "#include <openvdb/io/File.h>", "openvdb/io/File.h"
        )

    def test_openvdb_in_a_wrapped_header_by_way_of_another(self):
        self.assert_found("Filters/IO/vtkBad.h", '#include "NarrowBandGrid.h"', "openvdb/openvdb.h")

    def test_openvdb_past_the_header_that_makes_it_visible(self):
        for header in ("openvdb/openvdb.h", "openvdb/tools/Dense.h"):
            self.assert_found("Filters/LevelSet/Bad.cxx", f"#include <{header}>", header)

    def test_source_tree_in_an_example(self):
        bad = "../../Filters/Surfaces/vtkSkin.h"
        self.assert_found("Examples/Cxx/bad.cxx", f'#include "{bad}"', bad)
        self.assert_found("Examples/Python/bad.py", "import sys\nsys.path.append('.')", "sys.path")


class ThisTree(unittest.TestCase):
    def test_every_room_is_known(self):
        rooms = {room_of(unit) for unit in find_arrows(ROOT)}
        self.assertEqual(rooms, set(STACK))

    def test_no_arrow_is_broken(self):
        print(describe_floors(find_arrows(ROOT)))
        broken = find_broken_arrows(ROOT)
        self.assertEqual(broken, [], "\n".join(broken))


if __name__ == "__main__":
    unittest.main()
