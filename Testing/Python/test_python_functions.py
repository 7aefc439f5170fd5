# ctest: LABELS contract
"""skin, frames, morph, LiveSurface ...: accepted inputs, results, errors."""

import gc
import math
import sys
import types
import unittest
import warnings
from pathlib import Path

import active_implicit_surfaces as active
import numpy
from active_implicit_surfaces import data_objects, properties
from command_line import DROP, grid, moving_grid
from shapes import Library, as_array, bytes_of, make_points, volume_of
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData, vtkSphere, vtkTable, vtkUnstructuredGrid

SPACING = {"particle_spacing": 0.1}


def noisy_pool(seed):
    """24 x 24 x 6 particles with random displacements of standard deviation 0.7 r."""
    axes = [0.1 * numpy.arange(count) for count in (24, 24, 6)]
    places = numpy.stack(numpy.meshgrid(*axes), -1).reshape(-1, 3)
    return places + numpy.random.default_rng(seed).normal(0, 0.035, places.shape)


class Particles(unittest.TestCase):
    def test_every_kind_gives_the_same_skin(self):
        wanted = bytes_of(active.skin(grid(), **SPACING))
        kinds = {
            "list": grid().tolist(),
            "vtkPolyData": make_points(grid()),
            "vtkUnstructuredGrid": make_points(grid(), vtkUnstructuredGrid),
            "meshio": Library(points=grid(), cells=[], point_data={"a": numpy.ones(125)}),
            "trimesh": Library(vertices=grid(), faces=numpy.zeros((0, 3), int)),
            "strided": numpy.hstack([grid(), grid()])[:, 3:],
        }
        for name, particles in kinds.items():
            with self.subTest(name):
                self.assertEqual(bytes_of(active.skin(particles, **SPACING)), wanted)

    def test_the_skin_has_the_volume_of_the_particles(self):
        # A cube of side 1, whose 12 edges are rounded with at most the kernel radius, 2.25
        # spacings. Rounding removes (1 - pi/4) of the radius squared from an edge.
        skin = active.skin(grid(10), **SPACING)
        lost = 12 * (1 - math.pi / 4) * 0.225**2
        self.assertAlmostEqual(volume_of(skin), 1.0, delta=lost)

    def test_memory_is_shared(self):
        for numbers in (grid(), grid().astype("f4")):
            cloud = data_objects.as_particles(numbers, weight=numbers[:, 0].copy())
            self.assertTrue(numpy.shares_memory(vtk_to_numpy(cloud.GetPoints().GetData()), numbers))

    def test_shared_memory_outlives_the_array(self):
        cloud = data_objects.as_particles(grid())
        gc.collect()
        filler = [numpy.full((125, 3), numpy.nan) for _ in range(100)]
        self.assertEqual(vtk_to_numpy(cloud.GetPoints().GetData()).tobytes(), grid().tobytes())
        del filler

    def test_radii_may_be_an_array_or_its_name(self):
        radii = numpy.full(125, 0.14)
        cloud = make_points(grid())
        array = as_array(radii)
        array.SetName("size")
        cloud.GetPointData().AddArray(array)
        by_name = active.skin(cloud, radii="size", particle_model="sum", voxel_size=0.05)
        by_array = active.skin(grid(), radii=radii, particle_model="sum", voxel_size=0.05)
        other = active.skin(grid(), radii=radii / 2, particle_model="sum", voxel_size=0.05)
        self.assertEqual(bytes_of(by_name), bytes_of(by_array))
        self.assertNotEqual(bytes_of(by_name), bytes_of(other))

    def test_arrays_come_out_again(self):
        heights = {"height": grid()[:, 1].astype("f4")}
        skin = active.skin(grid(), arrays=heights, pass_target_arrays=True, **SPACING)
        self.assertTrue(skin.GetPointData().HasArray("height"))

    def test_masked_particles_are_left_out(self):
        positions = numpy.ma.masked_array(grid(), mask=numpy.repeat(grid()[:, :1] > 0.25, 3, 1))
        with self.assertWarnsRegex(active.ActiveSurfaceWarning, "left out"):
            half = active.skin(positions, **SPACING)
        wanted = active.skin(positions.compressed().reshape(-1, 3), **SPACING)
        self.assertEqual(bytes_of(half), bytes_of(wanted))
        with self.assertWarnsRegex(active.ActiveSurfaceWarning, "left out"):
            half = active.skin(grid(), radii=positions[:, 0] * 0 + 0.06)
        wanted = active.skin(grid()[grid()[:, 0] < 0.25], radii=numpy.full(75, 0.06))
        self.assertEqual(bytes_of(half), bytes_of(wanted))

    def test_pyvista_comes_out_where_pyvista_went_in(self):
        pyvista = types.ModuleType("pyvista")
        pyvista.wrap = lambda skin: ("wrapped", skin)
        kind = type("PolyData", (vtkPolyData,), {"__module__": "pyvista.core.pointset"})
        cloud = kind()
        cloud.ShallowCopy(make_points(grid()))
        sys.modules["pyvista"] = pyvista
        self.addCleanup(sys.modules.pop, "pyvista")
        self.assertEqual(active.skin(cloud, **SPACING)[0], "wrapped")
        self.assertEqual(next(iter(active.frames([cloud, cloud], **SPACING))).skin[0], "wrapped")

    def test_what_is_no_set_of_particles(self):
        cases = {
            "no set of particles": [vtkTable(), {"a": 1}, vtkSphere()],
            "n rows and 3 columns": [numpy.zeros((4, 2)), numpy.zeros(3), numpy.zeros((2, 4, 3))],
        }
        for words, things in cases.items():
            for thing in things:
                refused = self.assertRaisesRegex((TypeError, ValueError), words)
                with self.subTest(type(thing).__name__), refused:
                    active.skin(thing)
        names = {"IsA": lambda self, name: True, "GetClassName": lambda self: "vtkPolyData"}
        with self.assertRaisesRegex(TypeError, "This vtkPolyData is of another VTK than that of"):
            active.skin(type("OfAnotherVTK", (), names)())
        with self.assertRaisesRegex(ValueError, "has the shape .*, where n is the number of"):
            active.skin(grid(), radii=numpy.ones(3))
        with self.assertRaisesRegex(TypeError, r"'splash.csv' is a name, .* frames\(\)"):
            active.skin("splash.csv")


class Properties(unittest.TestCase):
    def test_every_property_is_a_keyword(self):
        surface = active.vtkActiveImplicitSurface()
        for own in properties.every():
            with self.subTest(own.name):
                properties.put(surface, {own.keyword: own.default})
                if own.kind == "switch":
                    properties.put(surface, {own.keyword: not own.default})
                    self.assertEqual(getattr(surface, "Get" + own.name)(), not own.default)
                for number, word in enumerate(own.choices):
                    properties.put(surface, {own.keyword: word})
                    self.assertEqual(getattr(surface, "Get" + own.name)(), number)

    def test_choices_are_the_classes_own(self):
        surface = active.vtkActiveImplicitSurface()
        for own in properties.every():
            if own.kind == "choice":
                self.assertEqual(len(own.choices), getattr(surface, f"Get{own.name}MaxValue")() + 1)

    def test_unknown_ones_name_the_nearest(self):
        for call in (active.skin, active.frames, active.morph, active.LiveSurface):
            arguments = {active.morph: [vtkSphere(), vtkSphere()], active.LiveSurface: []}.get(
                call, [moving_grid(2) if call is active.frames else grid()]
            )
            for wrong, words in (("voxelsize", "'voxel_size'"), ("interval", "no property")):
                with self.subTest(call.__name__), self.assertRaisesRegex(TypeError, words):
                    call(*arguments, **{wrong: 1})

    def test_automatic_is_as_not_given(self):
        plain = bytes_of(active.skin(grid()))
        for keyword in ("particle_spacing", "voxel_size", "tension", "attraction"):
            for value in (-1, "automatic"):
                with self.subTest(keyword, value=value):
                    self.assertEqual(bytes_of(active.skin(grid(), **{keyword: value})), plain)
        self.assertNotEqual(bytes_of(active.skin(grid(), tension=0)), plain)
        viscous = bytes_of(active.skin(grid(), preset="viscous"))
        same = active.skin(grid(), preset="viscous", attraction=-1, particle_spacing="automatic")
        self.assertEqual(bytes_of(same), viscous)

    def test_the_preset_viscous_smooths_noise(self):
        rms = []
        for options in ({}, {"preset": "viscous"}):
            *_, (_, skin) = active.frames(
                [noisy_pool(step) for step in range(4)], **SPACING, **options
            )
            places = vtk_to_numpy(skin.GetPoints().GetData())
            is_top = (numpy.abs(places[:, :2] - 1.15) < 0.4).all(axis=1) & (places[:, 2] > 0.3)
            rms.append(places[is_top, 2].std())
        self.assertGreater(rms[0], 0.005, "a tenth of r")
        self.assertLess(rms[1], 0.7 * rms[0])

    def test_values_out_of_range(self):
        for keyword, value, words in (
            ("anisotropy", 300, "1 to 100"),
            ("tension", -3, ">= 0, or -1"),
            ("particle_model", "round", "sum, anisotropic"),
            ("particle_model", 7, r"'anisotropic' \(1\), not 7"),
        ):
            with self.subTest(keyword), self.assertRaisesRegex(ValueError, words):
                active.skin(grid(), **{keyword: value})
        for keyword, value in ("tension", "much"), ("model_bounds", 3), ("number_of_threads", 1.5):
            with self.subTest(keyword), self.assertRaisesRegex(TypeError, keyword):
                active.skin(grid(), **{keyword: value})
        with self.assertRaisesRegex(ValueError, "no preset 'oil'"):
            active.skin(grid(), preset="oil")


class Errors(unittest.TestCase):
    def test_the_filters_error_is_a_ValueError_with_its_sentence(self):
        with self.assertRaises(ValueError) as caught:
            active.skin(grid(), voxel_size=0.001, maximum_number_of_active_voxels=10)
        self.assertRegex(str(caught.exception), r"^[A-Z].*MaximumNumberOfActiveVoxels.*\.$")
        self.assertNotIn("0x", str(caught.exception))

    def test_the_filters_warning_is_a_warning(self):
        with self.assertWarnsRegex(
            active.ActiveSurfaceWarning, "a ParticleSpacing of 0.1, the estimated"
        ):
            active.skin(grid())

    def test_files_are_an_OSError(self):
        with self.assertRaisesRegex(OSError, "no file"):
            active.frames("none.vtp")

    def test_an_exception_of_a_function_of_time_comes_through(self):
        def fail(time):
            if time:
                raise KeyError("mine")
            return grid()

        skins = iter(active.frames(fail, times=[0, 1], **SPACING))
        next(skins)
        with self.assertRaisesRegex(KeyError, "mine"):
            next(skins)


class Series(unittest.TestCase):
    def centres(self, *arguments, **options):
        return [f.skin.GetCenter()[0] for f in active.frames(*arguments, **SPACING, **options)]

    def test_every_kind_of_series_gives_the_same_skins(self):
        moving = moving_grid()
        wanted = self.centres(moving, fps=10)
        # The lattice's middle is 0.2 and moves by 0.05 per frame. A quarter of a voxel is 0.0125.
        for step, centre in enumerate(wanted):
            self.assertAlmostEqual(centre, 0.2 + 0.05 * step, delta=0.0125)
        times = [0, 0.1, 0.2, 3 / 10]
        kinds = {
            "list": [list(moving)],
            "generator": [frame for frame in moving],
            "series": active.ParticleSeries(moving, fps=10),
            "source": active.ParticleSeries(lambda time: moving[round(10 * time)], times=times),
        }
        self.assertEqual(self.centres(list(moving), times=times), wanted)
        self.assertEqual(self.centres((frame for frame in moving), fps=10), wanted)
        self.assertEqual(self.centres(kinds["series"]), wanted)
        self.assertEqual(self.centres(kinds["source"]), wanted)
        self.assertEqual(self.centres(lambda t: moving[round(10 * t)], times=times), wanted)

    def test_files(self):
        skins = active.frames(DROP)
        self.assertEqual(len(skins), 41)
        self.assertEqual(active.ParticleSeries(Path(DROP), fps=10).times[-1], 4.0)
        self.assertEqual(len(active.ParticleSeries(Path(DROP).parent.glob("sph_drop.vtp"))), 41)

    def test_progress(self):
        told = []
        list(active.frames(moving_grid(), progress=lambda *n: told.append(n), **SPACING))
        self.assertEqual(told, [(1, 4), (2, 4), (3, 4), (4, 4)])

    def test_skins_stay_as_they_were(self):
        skins = [frame.skin for frame in active.frames(moving_grid(), **SPACING)]
        self.assertEqual(len({bytes_of(skin) for skin in skins}), 4)

    def test_ids_are_found(self):
        sorted_frames, shuffled = (
            [
                data_objects.as_particles(frame[::order], ids=numpy.arange(125)[::order])
                for frame, order in zip(moving_grid(2), orders)
            ]
            for orders in ((1, 1), (1, -1))
        )
        self.assertEqual(self.centres(shuffled), self.centres(sorted_frames))
        lost = self.centres(shuffled, arrays={"ids": ""})
        self.assertNotEqual(lost, self.centres(moving_grid(2)))

    def test_what_is_no_series(self):
        with self.assertRaisesRegex(ValueError, "no frames"):
            active.ParticleSeries([])
        with self.assertRaisesRegex(ValueError, "times is 2, but that of frames is 4"):
            active.ParticleSeries(moving_grid(), times=[0, 1])
        with self.assertRaisesRegex(ValueError, "increase"):
            active.ParticleSeries(moving_grid(2), times=[1, 1])
        with self.assertRaisesRegex(ValueError, "more than 0"):
            active.ParticleSeries(moving_grid(2), fps=0)
        with self.assertRaisesRegex(TypeError, "needs `times`"):
            active.frames(lambda time: grid())
        for series in (lambda time: grid(), moving_grid(2)):
            with self.assertRaisesRegex(TypeError, "sequence of numbers"):
                active.frames(series, times=["0", "one"])
        with self.assertRaisesRegex(TypeError, "not 'colors'"):
            active.frames(moving_grid(2), arrays={"colors": "c"})
        with self.assertRaisesRegex(ValueError, "either times or fps"):
            active.frames(moving_grid(2), times=[0, 1], fps=10)
        series = active.ParticleSeries(moving_grid(2))
        for option in ({"times": [0, 1]}, {"fps": 10}, {"where": "x>0"}):
            with self.assertRaisesRegex(ValueError, "to ParticleSeries, not to"):
                active.frames(series, **option)
        with self.assertRaisesRegex(ValueError, "the whole array is one frame"):
            active.frames(grid())

    def test_arrays_that_are_not_there(self):
        for role in ("ids", "radii", "strengths", "velocities"):
            with self.subTest(role), self.assertRaisesRegex(ValueError, f"chosen for {role};"):
                active.frames(moving_grid(2), arrays={role: "nope"})
        frame = data_objects.as_particles(grid(), ids=numpy.arange(125))
        with self.assertRaisesRegex(ValueError, "'nope', chosen for radii; there are 'id'"):
            active.frames([frame, frame], arrays={"radii": "nope"})
        nothing = numpy.zeros((0, 3))
        begins = active.frames([nothing, frame], arrays={"ids": "id"}, **SPACING)
        self.assertGreater([one.skin.GetNumberOfPoints() for one in begins][1], 0)


class Live(unittest.TestCase):
    def test_pushed_frames_give_the_same_bytes_as_the_finished_series(self):
        moving = moving_grid(6)
        times = list(numpy.cumsum([0.0, 0.1, 0.1, 0.2, 0.1, 0.1]))
        for options in ({}, SPACING, {"preset": "viscous"}, {"transport": 0.0}):
            with self.subTest(options):
                if "preset" in options:
                    # A preset uses the median interval of a series, but the first dt of a
                    # LiveSurface. Both are 0.1 here.
                    self.assertEqual(numpy.median(numpy.diff(times)).round(9), 0.1)
                wanted = [bytes_of(f.skin) for f in active.frames(moving, times=times, **options)]
                live = active.LiveSurface(**options)
                steps = [0.1, *numpy.diff(times)]
                made = [bytes_of(live.advance(f, dt)) for f, dt in zip(moving, steps)]
                self.assertEqual(made, wanted)

    def test_a_push_costs_the_substeps_of_one_frame(self):
        live, counts = active.LiveSurface(**SPACING), []
        for step in range(20):
            live.surface.ResetCounters()
            live.advance(grid() + [0.05 * step, 0, 0], 0.1)
            counts.append(live.surface.GetSubsteps())
        self.assertLessEqual(max(counts[1:]), 2 * min(counts[1:]))
        self.assertEqual(live.surface.GetHistory().GetNumberOfRows(), 20)

    def test_time_and_errors(self):
        live = active.LiveSurface(start=3.0, **SPACING)
        live.advance(grid(), 0.5)
        self.assertEqual(live.time, 3.0)
        live.advance(grid(), 0.5)
        self.assertEqual(live.time, 3.5)
        for dt in (0, -1, math.nan, math.inf):
            with self.assertRaisesRegex(ValueError, "dt has to be"):
                live.advance(grid(), dt)
        with self.assertRaisesRegex(ValueError, "3 columns"):
            live.advance(numpy.zeros((3, 2)), 0.5)
        self.assertGreater(live.advance(grid(), 0.5).GetNumberOfPoints(), 0)
        self.assertEqual(live.time, 4.0)

    def test_a_push_that_is_refused_leaves_the_skin_as_it_was(self):
        moving = moving_grid(3)
        ids = numpy.arange(len(moving[0]))
        numbered = [data_objects.as_particles(points, ids=ids) for points in moving]
        wanted = [bytes_of(frame.skin) for frame in active.frames(numbered, fps=10, **SPACING)]
        live = active.LiveSurface(arrays={"ids": "id"}, **SPACING)
        with self.assertRaisesRegex(ValueError, "no point array 'id', chosen for ids; there"):
            live.advance(moving[0], 0.1)
        self.assertIsNone(live.time)
        self.assertEqual(bytes_of(live.advance(moving[0], 0.1, ids=ids)), wanted[0])
        with self.assertRaisesRegex(ValueError, "no point array as chosen"):
            live.advance(moving[1], 0.1)
        self.assertEqual(live.time, 0.0)
        self.assertEqual(bytes_of(live.advance(moving[1], 0.1, ids=ids)), wanted[1])
        self.assertEqual(bytes_of(live.advance(moving[2], 0.1, ids=ids)), wanted[2])

    def test_memory_may_be_written_over_from_push_to_push(self):
        moving = moving_grid(4)
        wanted = [bytes_of(frame.skin) for frame in active.frames(moving, fps=10, **SPACING)]
        live, own = active.LiveSurface(**SPACING), numpy.array(moving[0])
        for places, expected in zip(moving, wanted):
            own[:] = places
            self.assertEqual(bytes_of(live.advance(own, 0.1)), expected)

    def test_the_filter_itself_is_pushed_to_alike(self):
        moving = moving_grid(4)
        wanted = [bytes_of(frame.skin) for frame in active.frames(moving, fps=10, **SPACING)]
        surface = active.vtkActiveImplicitSurface()
        surface.SetParticleSpacing(SPACING["particle_spacing"])
        for places, expected in zip(moving, wanted):
            self.assertTrue(surface.Advance(data_objects.as_particles(places), 0.1))
            self.assertEqual(bytes_of(surface.GetOutput()), expected)


class Annotations(unittest.TestCase):
    def test_the_stub_names_what_the_package_has(self):
        folder = Path(active.__file__).parent
        self.assertTrue((folder / "py.typed").exists())
        text = (folder / "__init__.pyi").read_text()
        for name in active._FUNCTIONS:
            self.assertIn(f" as {name}\n", text)
            self.assertTrue(callable(getattr(active, name)))
            self.assertIn(name, dir(active))
        for name in (n for n in vars(active) if n.startswith("vtkActive") and n[9:10].isupper()):
            if isinstance(getattr(active, name), type):
                self.assertIn(f"{name}: Any", text)

    def test_no_other_attribute(self):
        with self.assertRaisesRegex(AttributeError, "'skins'"):
            _ = active.skins


if __name__ == "__main__":
    warnings.simplefilter("ignore", active.ActiveSurfaceWarning)
    unittest.main(warnings=None)
