"""All proxies of the plugin can be created, with the defaults, ranges, choices and texts of the
classes."""

import sys
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import active_implicit_surfaces
from paraview import servermanager
from paraview.modules.vtkRemotingServerManager import vtkSMOrderedPropertyIterator
from paraview.simple import ActiveImplicitSurface, Clip, ExtractCellsByRegion, Slice, Wavelet
from scenes import IN_USE, splash
from vtkmodules.vtkCommonDataModel import vtkSuperquadric

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "Testing" / "Python"))
from properties import comment_of, own_properties, rows_of  # noqa: E402

SURFACE, FUNCTIONS = (
    ("filters", "ActiveImplicitSurface"),
    ("sources", "ActiveImplicitSurfaceOfFunctions"),
)
SCREENSHOT = ("screenshot_writers", "ActiveEXR")
SURFACE_CLASS = active_implicit_surfaces.vtkActiveImplicitSurface
CLASSES = {
    SURFACE: SURFACE_CLASS,
    FUNCTIONS: SURFACE_CLASS,
    ("implicit_functions", "SkeletonPotential"): active_implicit_surfaces.vtkSkeletonPotential,
    ("implicit_functions", "GridPotential"): active_implicit_surfaces.vtkGridPotential,
    ("sources", "ActiveVDBReader"): active_implicit_surfaces.vtkActiveVDBReader,
    ("writers", "ActiveVDBWriter"): active_implicit_surfaces.vtkActiveVDBWriter,
    ("sources", "ActiveEXRReader"): active_implicit_surfaces.vtkActiveEXRReader,
    ("writers", "ActiveEXRWriter"): active_implicit_surfaces.vtkActiveEXRWriter,
    SCREENSHOT: active_implicit_surfaces.vtkActiveEXRWriter,
}
# Properties that a proxy offers differently or not at all. ParaView sets the global Controller.
ELSEWHERE = {
    SURFACE: {"Controller", "TargetFunction"},  # the target is the input
    FUNCTIONS: {"Controller", "MeshThickness", "PassTargetArrays", "TangentialVelocity"}
    | {row.name for row in rows_of(SURFACE_CLASS).values() if row.group == "Particles"},  # no input
    ("implicit_functions", "SkeletonPotential"): {"InputConnection"},  # set by Input
    ("implicit_functions", "GridPotential"): {"InputConnection"},
    # ParaView puts a filter after each source, which loses the metadata of an image without arrays.
    ("sources", "ActiveVDBReader"): {"OutputDense"},
    ("writers", "ActiveVDBWriter"): {"Controller", "InputData"},  # set by Input
    ("sources", "ActiveEXRReader"): set(),
    ("writers", "ActiveEXRWriter"): {"WorldToCamera", "WorldToNDC"},  # no matrices in the panel
    SCREENSHOT: {  # one picture at a time, of the visible scene
        "DisplaySize",
        "FrameNumber",
        "TimeCode",
        "WorldToCamera",
        "WorldToNDC",
        "WriteAllTimeSteps",
    },
}
LISTS = {"FileName", "GridName"}  # of the readers; initially empty
OTHER_DEFAULTS = {
    (FUNCTIONS, "ModelBounds"): [-1, 1, -1, 1, -1, 1],  # functions have no bounds
    (SCREENSHOT, "ColorEncoding"): [1],  # a view's colors are for a display
}
DECORATOR = "PropertyWidgetDecorator"  # shows a property in some cases only
# Shown in the filter's panel for every input.
ALWAYS_SHOWN = """
    Attraction Tension EvolutionMode VolumeControl InitialFunction ObstacleFunction TimeScale
    VoxelSize Input ComputeNormals ComputeVelocity ComputeCurvature Initial
""".split()


def new_proxy(key):
    return servermanager.ProxyManager().SMProxyManager.NewProxy(*key)


def every_property():
    """Yields (key, class, name, proxy's property) of the properties that the proxies and classes
    share."""
    for key, kind in CLASSES.items():
        proxy = new_proxy(key)
        for name in own_properties(kind):
            prop = proxy.GetProperty(name)
            if prop and hasattr(prop, "GetElement") and name not in ELSEWHERE[key]:
                yield key, kind, name, prop


def elements_of(prop):
    return [prop.GetElement(i) for i in range(prop.GetNumberOfElements())]


def domain_of(prop, kind):
    domain = prop.FindDomain(kind)
    return domain if domain and domain.IsA(kind) else None


def default_of(kind, name, prop):
    if name in LISTS and prop.GetRepeatCommand():
        return []
    value = getattr(kind(), "Get" + name)()
    return list(value) if isinstance(value, tuple) else ["" if value is None else value]


class Proxies(unittest.TestCase):
    def test_all_in_the_files_create(self):
        created = []
        for path in sorted((ROOT / "Filters" / "ParaView").glob("*.xml")):
            for group in ElementTree.parse(path).getroot():
                for proxy in group:
                    if "class" in proxy.attrib:
                        made = new_proxy((group.get("name"), proxy.get("name")))
                        self.assertIsNotNone(made, proxy.get("name"))
                        made.UpdateVTKObjects()
                        self.assertEqual(
                            made.GetClientSideObject().GetClassName(), proxy.get("class")
                        )
                        created.append((group.get("name"), proxy.get("name")))
        self.assertLessEqual(set(CLASSES), set(created))

    def test_every_property_of_a_class_is_in_its_proxies(self):
        for key, kind in CLASSES.items():
            proxy = new_proxy(key)
            for name in own_properties(kind):
                with self.subTest(f"{key[1]}.{name}"):
                    self.assertEqual(proxy.GetProperty(name) is None, name in ELSEWHERE[key])

    def test_defaults_are_those_of_the_classes(self):
        told = 0
        for key, kind, name, prop in every_property():
            with self.subTest(f"{key[1]}.{name}"):
                expected = default_of(kind, name, prop)
                expected = OTHER_DEFAULTS.get((key, name), expected)
                self.assertEqual(elements_of(prop), expected)
                told += 1
        self.assertGreater(told, 80)

    def test_the_superquadric_is_vtk_s(self):
        proxy = new_proxy(("implicit_functions", "Superquadric"))
        for name in "Center Scale Size ThetaRoundness PhiRoundness Toroidal Thickness".split():
            value = getattr(vtkSuperquadric(), "Get" + name)()
            expected = list(value) if isinstance(value, tuple) else [value]
            self.assertEqual(elements_of(proxy.GetProperty(name)), expected, name)

    def test_ranges_are_those_of_the_classes(self):
        told = 0
        for key, kind, name, prop in every_property():
            if not hasattr(kind, f"Get{name}MinValue") or prop.IsA("vtkSMIdTypeVectorProperty"):
                continue
            with self.subTest(f"{key[1]}.{name}"):
                low, high = (getattr(kind(), f"Get{name}M{end}Value")() for end in ("in", "ax"))
                if choices := domain_of(prop, "vtkSMEnumerationDomain"):
                    values = [choices.GetEntryValue(i) for i in range(choices.GetNumberOfEntries())]
                    self.assertEqual(values, list(range(low, high + 1)))
                else:
                    domain = domain_of(prop, "vtkSMDoubleRangeDomain") or domain_of(
                        prop, "vtkSMIntRangeDomain"
                    )
                    self.assertEqual(domain.GetMinimum(0), low)
                    unbounded = high == 2**31 - 1 or high > 1e298
                    self.assertEqual(domain.GetMaximumExists(0) == 0, unbounded)
                    if not unbounded:
                        self.assertEqual(domain.GetMaximum(0), high)
                told += 1
        self.assertGreater(told, 40)

    def test_choices_have_the_names_of_the_constants(self):
        for key, kind, name, prop in every_property():
            if choices := domain_of(prop, "vtkSMEnumerationDomain"):
                for i in range(choices.GetNumberOfEntries()):
                    constant = choices.GetEntryText(i).upper().replace(" ", "_")
                    with self.subTest(f"{key[1]}.{name}.{constant}"):
                        self.assertEqual(getattr(kind, constant), choices.GetEntryValue(i))

    def test_a_value_arrives_at_the_object(self):
        proxy = new_proxy(SURFACE)
        for name, value in (("Tension", 0.5), ("VolumeControl", 2), ("CheckpointMemory", 7)):
            proxy.GetProperty(name).SetElement(0, value)
            proxy.UpdateVTKObjects()
            self.assertEqual(getattr(proxy.GetClientSideObject(), "Get" + name)(), value)

    def test_the_text_of_a_property_is_its_comment(self):
        for key, kind, name, prop in every_property():
            if name not in LISTS:
                with self.subTest(f"{key[1]}.{name}"):
                    text = prop.GetDocumentation().GetDescription()
                    comment = comment_of(kind, name)
                    # In the text, names of properties have spaces, as in their labels.
                    self.assertEqual("".join(text.split()).find("".join(comment.split())), 0)

    def test_every_property_of_the_panel_is_in_one_group(self):
        for key in (SURFACE, FUNCTIONS):
            proxy, grouped = new_proxy(key), []
            for i in range(proxy.GetNumberOfPropertyGroups()):
                group = proxy.GetPropertyGroup(i)
                grouped += [group.GetPropertyName(j) for j in range(group.GetNumberOfProperties())]
            self.assertEqual(len(grouped), len(set(grouped)))
            own = set(own_properties(CLASSES[key])) - ELSEWHERE[key]
            self.assertEqual(own - set(grouped), set())

    def test_the_panel_begins_with_what_most_need(self):
        proxy = new_proxy(SURFACE)
        order, shown = vtkSMOrderedPropertyIterator(), []
        order.SetProxy(proxy)
        order.Begin()
        while not order.IsAtEnd():
            prop = order.GetProperty()
            hints = prop.GetHints()
            decorated = hints is not None and hints.FindNestedElementByName(DECORATOR) is not None
            if prop.GetPanelVisibility() == "default" and not decorated:
                shown.append(order.GetKey())
            order.Next()
        self.assertEqual(shown, ALWAYS_SHOWN)
        for name in ("TargetIsoValue", "InvertTarget", "TargetArray"):
            hint = proxy.GetProperty(name).GetHints().FindNestedElementByName(DECORATOR)
            self.assertEqual(hint.GetAttribute("name"), "vtkImageData", name)

    def test_the_target_is_the_input_of_any_filter(self):
        wavelet = Wavelet()
        for made in (ActiveImplicitSurface(Input=wavelet), ActiveImplicitSurface(wavelet)):
            self.assertEqual(made.Input, wavelet)

    def test_the_panel_shows_what_is_in_use(self):
        """The panel reads the values when a change is applied, before the next update."""
        surface, _ = splash(VoxelSize=-1, ParticleSpacing=-1, Attraction=-1)
        surface.UpdatePipeline(1)
        surface.UpdatePipelineInformation()
        voxel, spacing, attraction, tension = (
            getattr(surface, name + "InUse")
            for name in ("VoxelSize", "ParticleSpacing", "Attraction", "Tension")
        )
        self.assertAlmostEqual(spacing, 0.1, delta=1e-3)
        self.assertEqual(voxel, 0.5 * spacing)
        self.assertEqual(attraction, 6 / surface.TimeScale)
        self.assertAlmostEqual(tension, attraction * (0.5 * spacing) ** 2 / 2)
        surface.Tension = 0.3
        surface.UpdatePipelineInformation()
        self.assertEqual(surface.TensionInUse, 0.3)

    def test_what_is_in_use_is_only_read_and_named_in_tooltips(self):
        of_particles = {"ParticleSpacingInUse", "KernelRadiusInUse"}
        for key, names in ((SURFACE, IN_USE), (FUNCTIONS, set(IN_USE) - of_particles)):
            proxy = new_proxy(key)
            for name in names:
                with self.subTest(f"{key[1]}.{name}"):
                    prop = proxy.GetProperty(name)
                    self.assertTrue(prop.GetInformationOnly())
                    self.assertEqual(prop.GetPanelVisibility(), "advanced")
                    automatic = proxy.GetProperty(name.removesuffix("InUse")).GetDocumentation()
                    self.assertIn(prop.GetXMLLabel(), " ".join(automatic.GetDescription().split()))

    def test_filters_of_paraview_offer_the_functions(self):
        wavelet = Wavelet()
        for made, name in (
            (Clip, "ClipType"),
            (Slice, "SliceType"),
            (ExtractCellsByRegion, "IntersectWith"),
        ):
            # ParaView 5.13 lists them without spaces.
            available = made(Input=wavelet).GetProperty(name).GetAvailable()
            offered = [function.replace(" ", "") for function in available]
            self.assertIn("SkeletonPotential", offered)
            self.assertIn("ImageorMesh", offered)


if __name__ == "__main__":
    unittest.main()
