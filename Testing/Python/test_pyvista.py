# ctest: DISPLAY LABELS contract
"""Skins and morphs as methods of PyVista's data sets.

Skipped without PyVista 0.48 or later; Testing/Wheel/run has it.
"""

import doctest
import os
import unittest

import active_implicit_surfaces as active
import numpy

try:
    import pyvista
except ImportError:
    pyvista = None
NEEDED = "PyVista 0.48 or later is not there (pip install pyvista[cvista], with a wheel of this)"
SPACING = {"particle_spacing": 1.0}


def grid(count=5):
    return numpy.stack(numpy.meshgrid(*3 * [numpy.arange(float(count))]), -1).reshape(-1, 3)


def arrays_of(skin):
    return skin.points.tobytes() + skin.faces.tobytes() + skin.point_data["Normals"].tobytes()


def as_a_page_shows_it(points):
    import pyvista

    cloud = pyvista.PolyData(points)
    cloud.active_surface.skin(particle_spacing=0.1).plot()
    for time, skin in pyvista.Cube().active_surface.morph_to(pyvista.Sphere(), 2.0):
        print(time, skin.volume)
    return time, skin


@unittest.skipUnless(hasattr(pyvista, "register_dataset_accessor"), NEEDED)
class Accessor(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        from active_implicit_surfaces import pyvista_accessor

        cls.module = pyvista_accessor

    def test_a_skin_is_that_of_the_function(self):
        skin = pyvista.PolyData(grid()).active_surface.skin(**SPACING)
        self.assertIsInstance(skin, pyvista.PolyData)
        self.assertTrue(skin.is_manifold)
        self.assertEqual(arrays_of(skin), arrays_of(pyvista.wrap(active.skin(grid(), **SPACING))))

    def test_cells_do_not_count(self):
        of_points = pyvista.PolyData(grid()).active_surface.skin(**SPACING)
        lattice = pyvista.ImageData(dimensions=(5, 5, 5)).cast_to_unstructured_grid()
        lattice.points = grid()
        self.assertEqual(arrays_of(lattice.active_surface.skin(**SPACING)), arrays_of(of_points))

    def test_arrays_are_found_by_their_names(self):
        cloud = pyvista.PolyData(grid())
        cloud["size"] = numpy.full(len(grid()), 0.4)
        options = {"particle_model": "sum", "voxel_size": 0.25}
        by_name = cloud.active_surface.skin(radii="size", **options)
        by_array = cloud.active_surface.skin(radii=cloud["size"], **options)
        smaller = cloud.active_surface.skin(radii=0.8 * cloud["size"], **options)
        self.assertEqual(arrays_of(by_name), arrays_of(by_array))
        self.assertLess(smaller.volume, by_name.volume)

    def test_a_mesh_arrives_at_another(self):
        cube, ball, voxel = pyvista.Cube(), pyvista.Sphere(radius=1.0), 0.1
        way = cube.active_surface.morph_to(ball, 2.0, frames=5, voxel_size=voxel)
        times, skins = zip(*way, strict=True)
        self.assertEqual(times, (0.0, 0.5, 1.0, 1.5, 2.0))
        for skin in skins:
            self.assertIsInstance(skin, pyvista.PolyData)
        # morph documents a tolerance of half a voxel.
        for skin, mesh in ((skins[0], cube), (skins[-1], ball)):
            distance = numpy.abs(numpy.array(skin.bounds) - numpy.array(mesh.bounds)).max()
            self.assertLess(distance, 0.5 * voxel)
        volumes = [skin.volume for skin in skins]
        self.assertEqual(volumes, sorted(volumes))

    def test_errors_are_those_of_the_functions(self):
        cloud = pyvista.PolyData(grid())
        with self.assertRaisesRegex(TypeError, "did you mean 'particle_spacing'"):
            cloud.active_surface.skin(particle_spcing=1)
        with self.assertRaisesRegex(ValueError, "VoxelSize|voxel_size"):
            cloud.active_surface.skin(voxel_size=-2)
        with self.assertRaisesRegex(TypeError, "no set of particles"):
            pyvista.ImageData(dimensions=(3, 3, 3)).active_surface.skin()
        with self.assertRaisesRegex(ValueError, "duration"):
            pyvista.Cube().active_surface.morph_to(pyvista.Sphere(), -1)

    def test_the_examples_of_its_docstrings(self):
        result = doctest.testmod(self.module)
        self.assertEqual(result.failed, 0)
        self.assertGreater(result.attempted, 0)

    def test_what_a_page_shows(self):
        self.addCleanup(setattr, pyvista, "OFF_SCREEN", pyvista.OFF_SCREEN)
        pyvista.OFF_SCREEN = True
        time, skin = as_a_page_shows_it(0.1 * grid())
        self.assertEqual(time, 2.0)
        self.assertTrue(skin.is_manifold)

    def test_a_skin_is_plotted(self):
        skin = pyvista.PolyData(grid()).active_surface.skin(**SPACING)
        size, across = 300, 10.0  # pixels, and their length
        plotter = pyvista.Plotter(off_screen=True, window_size=(size, size))
        plotter.background_color = "white"
        plotter.add_mesh(skin, color="steelblue", smooth_shading=True)
        plotter.view_xy()
        plotter.enable_parallel_projection()
        plotter.parallel_scale = across / 2
        picture = plotter.screenshot(os.environ.get("ACTIVE_PICTURE"), return_img=True)
        plotter.close()
        covered = (picture.astype(int).sum(axis=2) < 3 * 255).sum() * (across / size) ** 2
        # The covered area is less than that of the skin's bounds, and more than that of the square
        # of the particles' centres.
        x0, x1, y0, y1, _, _ = skin.bounds
        pixel = across / size
        self.assertLess(covered, (x1 - x0 + 2 * pixel) * (y1 - y0 + 2 * pixel))
        self.assertGreater(covered, (4.0 - 2 * pixel) ** 2)


@unittest.skipIf(pyvista, "PyVista is there")
class WithoutPyVista(unittest.TestCase):
    def test_the_accessor_is_an_import_error(self):
        with self.assertRaisesRegex(ImportError, "pyvista"):
            from active_implicit_surfaces import pyvista_accessor  # noqa: F401


if __name__ == "__main__":
    unittest.main()
