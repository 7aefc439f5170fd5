"""Presets on the filter, by the function and by the macros; and the example states."""

import os
import re
import runpy
import unittest
from pathlib import Path

import active_implicit_surfaces as active
from active_implicit_surfaces import paraview_presets
from active_implicit_surfaces.presets import PRESETS
from active_implicit_surfaces.series import TemporalSource
from paraview.simple import (
    Calculator,
    FindSource,
    GetLayout,
    GetRenderViews,
    GetRepresentation,
    LoadState,
    ResetSession,
    SetActiveSource,
    Sphere,
)
from scenes import DATA, skin_bytes, splash

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "Examples" / "ParaView"
NAMES = [one.name for one in active.properties.every() if one.kind not in ("object", "numbers")]


def values_of(proxy):
    return {name: proxy.SMProxy.GetProperty(name).GetElement(0) for name in NAMES}


class Presets(unittest.TestCase):
    def setUp(self):
        ResetSession()

    def test_they_are_those_of_the_functions(self):
        for name in PRESETS:
            with self.subTest(name):
                surface, particles = splash(VoxelSize=-1, Attraction=-1)
                cloud = fetch(particles)
                source = TemporalSource(lambda step, cloud=cloud: cloud, surface.TimestepValues)
                options = {"particle_spacing": surface.ParticleSpacing, "time_scale": 1 / 25}
                wanted = active.frames(source, preset=name, **options).surface
                chosen = paraview_presets.apply(name, surface)
                self.assertTrue(chosen)
                for key, value in values_of(surface).items():
                    self.assertEqual(value, getattr(wanted, "Get" + key)(), key)

    def test_the_last_one_holds(self):
        once, _ = splash(VoxelSize=0.12, Attraction=-1)
        paraview_presets.apply("viscous", once)
        twice, _ = splash(VoxelSize=0.12, Attraction=-1)
        for name in ("viscous", "paper", "viscous"):
            paraview_presets.apply(name, twice)
        self.assertEqual(values_of(twice), values_of(once))
        self.assertEqual(twice.VoxelSize, 0.12)
        self.assertEqual(skin_bytes(twice, 2), skin_bytes(once, 2))

    def test_lengths_of_another_preset_go(self):
        once, _ = splash(VoxelSize=-1, Attraction=-1)
        paraview_presets.apply("viscous", once)
        twice, _ = splash(VoxelSize=-1, Attraction=-1)
        paraview_presets.apply("molecule", twice)
        self.assertGreater(twice.VoxelSize, 0)
        paraview_presets.apply("viscous", twice)
        self.assertEqual(values_of(twice), values_of(once))
        self.assertEqual(list(twice.RadiusArray), list(once.RadiusArray))

    def test_one_after_another_is_the_last_one_alone(self):
        for radius in (None, "0.04"):
            for last in PRESETS:
                once = self.with_presets(radius, last)
                for first in set(PRESETS) - {last}:
                    with self.subTest(f"{first}, then {last}", radius=radius):
                        twice = self.with_presets(radius, first, last)
                        self.assertEqual(values_of(twice), values_of(once))
                        self.assertEqual(list(twice.RadiusArray), list(once.RadiusArray))

    @staticmethod
    def with_presets(radius, *names):
        surface, particles = splash(VoxelSize=-1, ParticleSpacing=-1, Attraction=-1)
        if radius:
            surface.Input = Calculator(Input=particles, ResultArrayName="radius", Function=radius)
        for name in names:
            paraview_presets.apply(name, surface)
        return surface

    def test_macros_are_of_the_active_source(self):
        macros = sorted((FOLDER / "Macros").glob("*.py"))
        self.assertEqual([macro.stem.lower() for macro in macros], sorted(PRESETS))
        for macro in macros:
            with self.subTest(macro.stem):
                surface, _ = splash()
                before = values_of(surface)
                SetActiveSource(surface)
                runpy.run_path(str(macro))
                self.assertNotEqual(values_of(surface), before)

    def test_what_cannot_be(self):
        surface, _ = splash()
        with self.assertRaisesRegex(ValueError, "no preset 'oil'"):
            paraview_presets.apply("oil", surface)
        with self.assertRaisesRegex(ValueError, "The source is no Active Implicit Surface"):
            paraview_presets.apply("viscous", Sphere())


class States(unittest.TestCase):
    """States open in any working directory."""

    def setUp(self):
        ResetSession()
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir("/")

    def test_the_splash(self):
        LoadState(str(FOLDER / "splash.pvsm"), data_directory=str(DATA.parent))
        skin = FindSource("Skin")
        self.assertEqual(list(skin.TimestepValues), [float(step) for step in range(41)])
        self.assertTrue(skin_bytes(skin, 2))

    def test_the_morph(self):
        LoadState(str(FOLDER / "morph.pvsm"))
        skin = FindSource("Skin")
        self.assertNotEqual(skin_bytes(skin, 0.0), skin_bytes(skin, 1.0))

    def test_they_show_the_skin(self):
        for name, folder in (("splash", str(DATA.parent)), ("morph", None)):
            with self.subTest(name):
                ResetSession()
                options = {"data_directory": folder} if folder else {}
                LoadState(str(FOLDER / f"{name}.pvsm"), **options)
                (view,) = GetRenderViews()
                self.assertIsNotNone(GetLayout(view))
                shown = GetRepresentation(FindSource("Skin"), view)
                self.assertEqual(shown.Visibility, 1)

    def test_they_name_no_folder(self):
        for state in FOLDER.glob("*.pvsm"):
            found = re.findall(r'value="(/[^"]+|[A-Z]:[^"]*)"', state.read_text())
            self.assertEqual(found, [], state.name)


def fetch(source):
    from paraview import servermanager

    source.UpdatePipeline(0)
    return servermanager.Fetch(source)


if __name__ == "__main__":
    unittest.main()
