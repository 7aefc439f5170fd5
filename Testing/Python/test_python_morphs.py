# ctest: LABELS contract
"""morph and plot_history: shapes, arrival on time, contents of a plot, errors."""

import sys
import types
import unittest
import warnings

import active_implicit_surfaces as active
import numpy
from active_implicit_surfaces import histories
from command_line import grid, moving_grid
from shapes import Library, ball_mesh, image_of, make_points, output_of, volume_of
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkSphere
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkSphereSource

SPACING = {"particle_spacing": 0.1}


def ball(radius=0.6):
    return output_of(ball_mesh(radius))


def cube():
    return output_of(vtkCubeSource())


class Morphs(unittest.TestCase):
    def test_it_arrives_at_the_end(self):
        for duration in (1.0, 20.0):
            way = list(active.morph(cube(), ball(), duration, frames=11, voxel_size=0.05))
            self.assertEqual([frame.time for frame in way], [duration * i / 10 for i in range(11)])
            # At the end the skin is within a tenth of a voxel of the mesh, whose flat triangles are
            # slightly within the ball.
            last = numpy.linalg.norm(vtk_to_numpy(way[-1].skin.GetPoints().GetData()), axis=1)
            self.assertLess(numpy.abs(last - 0.6).max(), 0.15 * 0.05)
            self.assertAlmostEqual(volume_of(way[0].skin), 1.0, delta=0.025 * 6)
            # Halfway in time, half of the distance is left at the corners; a voxel is tolerated.
            radii = numpy.linalg.norm(vtk_to_numpy(way[5].skin.GetPoints().GetData()), axis=1)
            self.assertAlmostEqual(radii.max(), 0.733, delta=0.05)

    def test_limbs_grow_to_their_ends_at_an_even_speed(self):
        bar = vtkCubeSource()
        bar.SetXLength(2)
        bar.SetYLength(0.2)
        bar.SetZLength(0.2)
        way = active.morph(ball(0.3), output_of(bar), 3.0, frames=7, voxel_size=0.02)
        reached = numpy.array([frame.skin.GetBounds()[1] for frame in way])
        # The front moves evenly from 0.3 to 1. The tolerance is a voxel and half of the bar's
        # thickness, because the front may be flat or a cap.
        expected = 0.3 + 0.7 * numpy.arange(7) / 6
        self.assertLess(numpy.abs(reached - expected).max(), 0.02 + 0.1)
        self.assertLess(abs(reached[-1] - 1.0), 0.1 * 0.02)

    def test_parts_grow_where_the_first_shape_is_not(self):
        apart = vtkSphereSource()
        apart.SetCenter(3, 0, 0)
        way = list(active.morph(cube(), output_of(apart), 2.0, frames=3, voxel_size=0.05))
        # Vertices keep 2^-13 voxel off the nodes.
        self.assertAlmostEqual(way[0].skin.GetBounds()[1], 0.5, delta=0.05 / 2**13 * 1.01)
        self.assertLess(way[1].skin.GetBounds()[0], 0.5, "what goes is still there")
        self.assertGreater(way[1].skin.GetBounds()[1], 3.0, "what comes is there already")
        self.assertGreater(way[2].skin.GetBounds()[0], 2.45)

    def test_each_warning_comes_once(self):
        apart = vtkSphereSource()
        apart.SetCenter(3, 0, 0)
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            way = active.morph(
                cube(), output_of(apart), frames=3, voxel_size=0.1, create_parts=False
            )
            with self.assertRaisesRegex(ValueError, "There is no skin at the time 1. If"):
                list(way)
        self.assertEqual(sum("vanished" in str(one.message) for one in told), 1)

    def test_every_kind_of_shape(self):
        faces = numpy.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4]])
        faces = numpy.vstack([faces, [[1, 5, 7, 3]]])
        corners = numpy.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) / 2
        split = numpy.vstack([faces[:, [0, 1, 2]], faces[:, [0, 2, 3]]])
        blocks = [types.SimpleNamespace(type="quad", data=faces)]
        function = vtkSphere()
        function.SetRadius(0.6)
        kinds = {
            "trimesh": Library(vertices=corners, faces=split),
            "meshio": Library(points=corners, cells=blocks),
        }
        wanted = [volume_of(f.skin) for f in active.morph(cube(), ball(), frames=3, voxel_size=0.1)]
        for name, shape in kinds.items():
            with self.subTest(name):
                way = active.morph(shape, ball(), frames=3, voxel_size=0.1)
                for frame, volume in zip(way, wanted):
                    self.assertAlmostEqual(volume_of(frame.skin), volume, delta=0.02)
        way = active.morph(cube(), function, frames=3, voxel_size=0.1)
        self.assertAlmostEqual(volume_of(list(way)[-1].skin), wanted[-1], delta=0.02)

    def test_the_second_shape_is_fitted_to_the_first(self):
        places = numpy.mgrid[0:25, 0:25, 0:25] - 12.0
        image = image_of(numpy.sqrt((places**2).sum(0)) - 9, 3 * [0.5])  # 12 long, the ball 9
        for shape, fit, radius in (
            (output_of(ball_mesh(3, 64, (10, 0, 0))), "box", 0.5),
            (output_of(ball_mesh(3, 64, (10, 0, 0))), "centre", 3.0),
            (image, "box", 0.5 * 9 / 12),
        ):
            with self.subTest(fit=fit, radius=radius), warnings.catch_warnings():
                warnings.simplefilter("ignore")
                *_, (_, skin) = active.morph(cube(), shape, frames=2, fit=fit, voxel_size=0.1)
                for value, wanted in zip(skin.GetBounds(), 3 * [-radius, radius]):
                    self.assertAlmostEqual(value, wanted, delta=0.02)
        with self.assertWarnsRegex(active.ActiveSurfaceWarning, "bounds are 10 apart"):
            active.morph(cube(), output_of(ball_mesh(0.5, 32, (10, 0, 0))))
        with self.assertRaisesRegex(ValueError, "has to be one of none, centre, box, not 'size'"):
            active.morph(cube(), ball(), fit="size")
        with self.assertRaisesRegex(TypeError, "a function has no box"):
            active.morph(cube(), vtkSphere(), fit="box")

    def test_a_steady_state_has_no_frames(self):
        mode = {"evolution_mode": "equilibrium"}
        for make, data in ((active.morph, (cube(), ball())), (active.frames, [moving_grid(2)])):
            with self.assertRaisesRegex(ValueError, "equilibrium makes one skin"):
                make(*data, **mode)
        self.assertEqual(len(list(active.frames(moving_grid(1), **SPACING, **mode))), 1)

    def test_what_is_no_morph(self):
        for arguments, words in (
            (dict(duration=0), "duration"),
            (dict(duration=1, frames=1), "frames"),
        ):
            with self.assertRaisesRegex(ValueError, words):
                active.morph(cube(), ball(), **arguments)
        with self.assertRaisesRegex(TypeError, "no mesh"):
            active.morph("cube", ball())
        for name in "arrival_time", "start_time", "time_step_size", "number_of_time_steps":
            with self.assertRaisesRegex(TypeError, f"in place of {name}; leave {name} out"):
                active.morph(cube(), ball(), duration=2, **{name: 1})
        with self.assertRaisesRegex(ValueError, "no polygons"):
            active.morph(make_points(grid()), ball())


class Axes:
    """Methods of matplotlib's axes that plot_history calls."""

    def __init__(self):
        self.calls = []

    def get_ylim(self):
        return 0.0, 1.0

    def __getattr__(self, name):
        return lambda *arguments, **options: self.calls.append((name, arguments))


class Plots(unittest.TestCase):
    def setUp(self):
        self.skins = active.frames(moving_grid(), **SPACING)
        self.times = [frame.time for frame in self.skins]

    def test_columns_over_time(self):
        axes = [Axes(), Axes()]
        active.plot_history(self.skins, ("Volume", "Components"), axes=axes)
        (name, (times, values)) = axes[1].calls[0]
        self.assertEqual((name, [*times], [*values]), ("plot", self.times, [1, 1, 1, 1]))
        self.assertIn(("set_xlabel", ("Time",)), axes[1].calls)

    def test_what_cannot_be_plotted(self):
        with self.assertRaisesRegex(ValueError, "no column 'Weight'; it has Time"):
            active.plot_history(self.skins, ["Weight"], axes=[Axes()])
        with self.assertRaisesRegex(ValueError, "1 axes for 2 columns"):
            active.plot_history(self.skins, ["Volume", "Area"], axes=[Axes()])
        with self.assertRaisesRegex(ValueError, "There is no history;"):
            active.plot_history(active.vtkActiveImplicitSurface(), axes=[Axes()])

    def test_without_matplotlib(self):
        hidden = {name: sys.modules.get(name) for name in ("matplotlib", "matplotlib.pyplot")}
        sys.modules.update(dict.fromkeys(hidden))
        try:
            with self.assertRaisesRegex(ImportError, "matplotlib, which is not installed"):
                histories.plot_history(self.skins)
        finally:
            for name, module in hidden.items():
                sys.modules.pop(name)
                if module is not None:
                    sys.modules[name] = module


if __name__ == "__main__":
    unittest.main()
