# ctest: DISPLAY LABELS exact
"""Layers of a render window compared with the values for a camera and a ball, in both
projections.

The test computes the camera from its own vectors, without VTK's matrices. The ball has flat
triangles, whose vertices are on the sphere and have its normals. The sagitta of its chords, CHORD,
is the tolerance along a normal.

Run: python3 test_render.py
"""

import math
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from active_implicit_surfaces import render, vtkActiveEXRReader, vtkActiveEXRWriter
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkGlyph3DMapper,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
)

WIDTH, HEIGHT = 160, 120
AROUND, DOWN = 400, 200  # triangles of the ball
RADIUS = 0.8
CENTER = numpy.array([0.3, -0.2, 0.5])
SPEED = numpy.array([0.4, 0.1, -0.5])
DURATION = 0.25
CHORD = RADIUS * (2 - math.cos(math.pi / AROUND) - math.cos(math.pi / 2 / (DOWN - 1)))
POSITION = numpy.array([1.0, 2.0, 5.0])
ANGLE, SCALE = 30.0, 1.3
# Least cosine between ray and normal: tolerances at grazing rays grow without bound.
STEEPEST = 0.2


def ball_actor(radius=RADIUS, speed=SPEED):
    source = vtkSphereSource()
    source.SetRadius(radius)
    source.SetThetaResolution(AROUND)
    source.SetPhiResolution(DOWN)
    source.Update()
    ball = source.GetOutput()
    speeds = numpy_to_vtk(numpy.tile(speed, (ball.GetNumberOfPoints(), 1)), deep=True)
    speeds.SetName("Velocity")
    ball.GetPointData().AddArray(speeds)
    return actor_of(ball)


def actor_of(data):
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(data)
    actor = vtkActor()
    actor.SetMapper(mapper)
    return actor


def floor_actor():
    """A plane without normals, behind the ball."""
    plane = vtkPlaneSource()
    plane.SetOrigin(-9, -9, -2)
    plane.SetPoint1(9, -9, -2)
    plane.SetPoint2(-9, 9, -2)
    plane.Update()
    data = plane.GetOutput()
    data.GetPointData().SetNormals(None)
    return actor_of(data)


def glyph_actor():
    """The ball as a glyph: it has depth, and no values."""
    points, place = vtkPoints(), vtkPolyData()
    points.InsertNextPoint(CENTER)
    place.SetPoints(points)
    ball = vtkSphereSource()
    ball.SetRadius(RADIUS)
    mapper = vtkGlyph3DMapper()
    mapper.SetInputData(place)
    mapper.SetSourceConnection(ball.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    return actor


def window_with(*actors, parallel=False):
    renderer = vtkRenderer()
    for actor in actors:
        renderer.AddActor(actor)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(POSITION)
    camera.SetFocalPoint(CENTER)
    camera.SetViewUp(0.1, 1, 0)
    camera.SetViewAngle(ANGLE)
    camera.SetParallelScale(SCALE)
    camera.SetParallelProjection(parallel)
    renderer.ResetCameraClippingRange()
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetSize(WIDTH, HEIGHT)
    window.AddRenderer(renderer)
    return window


def axes():
    """Unit vectors right, up and ahead."""
    ahead = (CENTER - POSITION) / numpy.linalg.norm(CENTER - POSITION)
    right = numpy.cross(ahead, (0.1, 1, 0))
    right /= numpy.linalg.norm(right)
    return right, numpy.cross(right, ahead), ahead


def rays(parallel):
    """Origins and directions through the pixels' centers; directions have length 1 along the
    axis."""
    right, up, ahead = axes()
    x, y = numpy.meshgrid(numpy.arange(WIDTH) + 0.5, numpy.arange(HEIGHT) + 0.5)
    x, y = (x.ravel() - WIDTH / 2) / (HEIGHT / 2), (y.ravel() - HEIGHT / 2) / (HEIGHT / 2)
    half = SCALE if parallel else math.tan(math.radians(ANGLE / 2))
    aside = half * (numpy.outer(x, right) + numpy.outer(y, up))
    if parallel:
        return POSITION + aside, numpy.tile(ahead, (len(x), 1))
    return numpy.tile(POSITION, (len(x), 1)), ahead + aside


def project(places, parallel):
    """Pixel coordinates from the lower left."""
    right, up, ahead = axes()
    away = places - POSITION
    half = SCALE if parallel else math.tan(math.radians(ANGLE / 2)) * (away @ ahead)
    pixel = HEIGHT / 2 / half
    return numpy.stack([(away @ right) * pixel + WIDTH / 2, (away @ up) * pixel + HEIGHT / 2], 1)


def hits(parallel):
    """Depth, position and normal of the ball in each pixel (NaN for a miss), and steepness."""
    origins, directions = rays(parallel)
    a = (directions**2).sum(1)
    b = ((origins - CENTER) * directions).sum(1)
    c = ((origins - CENTER) ** 2).sum(1) - RADIUS**2
    with numpy.errstate(invalid="ignore"):
        depth = (-b - numpy.sqrt(b * b - a * c)) / a
    places = origins + depth[:, None] * directions
    normals = (places - CENTER) / RADIUS
    steep = -(normals * directions).sum(1) / numpy.sqrt(a)
    return depth, places, normals, steep


def layers_of(image):
    data = image.GetPointData()
    names = [data.GetArrayName(i) for i in range(data.GetNumberOfArrays())]
    return {name: vtk_to_numpy(data.GetArray(name)) for name in names}


class Layers(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def moved_ball(self):
        actor = ball_actor()
        actor.SetPosition(CENTER)
        return actor

    def check_ball(self, layers, parallel, camera_range):
        depth, places, normals, steep = hits(parallel)
        looked_at = steep > STEEPEST
        self.assertGreater(looked_at.sum(), 2000)
        near, distant = camera_range
        # Step of a depth buffer of 24 bits, in world units.
        step = (distant - near if parallel else depth**2 * (1 / near - 1 / distant)) / 2**24
        # Three steps allow for rounding by half a step, and for inputs in single precision.
        along = CHORD / steep + 3 * step + 1e-6
        off = numpy.abs(layers["Z"] - depth)
        self.assertLess((off / along)[looked_at].max(), 1.0, "Z")
        off = numpy.linalg.norm(layers["P"] - places, axis=1)
        ray = numpy.linalg.norm(rays(parallel)[1], axis=1)
        self.assertLess((off / along / ray)[looked_at].max(), 1.0, "P")
        off = numpy.linalg.norm(layers["N"] - normals, axis=1)
        self.assertLess((off * RADIUS / along / ray / 2)[looked_at].max(), 1.0, "N")
        motion = project(places + DURATION * SPEED, parallel) - project(places, parallel)
        # The motion in pixels of a point nearer by `along` is larger by the fraction along / depth.
        # The factor 2 allows for the point's motion in depth.
        share = 1e-5 if parallel else 2 * along / depth + 1e-5
        most = numpy.linalg.norm(motion, axis=1) * share
        off = numpy.linalg.norm(layers["forward"] - motion, axis=1)
        self.assertGreater(numpy.linalg.norm(motion[looked_at], axis=1).min(), 1.0)
        self.assertLess((off / most)[looked_at].max(), 1.0, "forward")
        self.assertTrue((layers["id"][looked_at] == 1).all())

    def test_a_moving_ball_is_where_it_must_be(self):
        for parallel in (False, True):
            with self.subTest(parallel=parallel):
                window = window_with(self.moved_ball(), parallel=parallel)
                layers = layers_of(render.capture(window, frame_duration=DURATION))
                camera = window.GetRenderers().GetFirstRenderer().GetActiveCamera()
                self.check_ball(layers, parallel, camera.GetClippingRange())
                nothing = layers["id"] == 0
                missed = numpy.isnan(hits(parallel)[0])
                self.assertTrue((layers["Z"][nothing] == numpy.float32(render.FAR)).all())
                for name in ("N", "P", "forward"):
                    self.assertFalse(layers[name][nothing].any(), name)
                # The silhouette of flat triangles is within that of the ball.
                self.assertFalse((~nothing & missed).any())
                self.assertLess((nothing & ~missed).sum(), 40)

    def test_velocities_turn_and_grow_with_their_actor(self):
        actor = ball_actor(RADIUS / 2, numpy.array([SPEED[1], -SPEED[0], SPEED[2]]) / 2)
        actor.SetScale(2.0)
        actor.RotateZ(90)
        actor.SetPosition(CENTER)
        window = window_with(actor)
        layers = layers_of(render.capture(window, frame_duration=DURATION))
        camera = window.GetRenderers().GetFirstRenderer().GetActiveCamera()
        self.check_ball(layers, False, camera.GetClippingRange())

    def test_ids_are_the_actors_in_their_order_and_what_is_hidden_does_not_show(self):
        window = window_with(floor_actor(), self.moved_ball())
        layers = layers_of(render.capture(window, frame_duration=DURATION))
        on_ball = hits(False)[3] > STEEPEST
        self.assertTrue((layers["id"][on_ball] == 2).all())
        floor = layers["id"] == 1
        self.assertEqual(set(layers["id"]), {1, 2})
        normals = numpy.abs(layers["N"][floor])
        self.assertLess(numpy.abs(normals - [0, 0, 1]).max(), 1e-6)
        self.assertLess(numpy.abs(layers["P"][floor][:, 2] + 2).max(), 1e-4)
        self.assertLess(numpy.abs(layers["forward"][floor]).max(), 1e-6)

    def test_what_has_no_values_hides_those_behind_it(self):
        layers = layers_of(render.capture(window_with(floor_actor(), glyph_actor())))
        steep = hits(False)[3] > 0.6  # well within its coarse outline
        self.assertGreater(steep.sum(), 1000)
        self.assertFalse(layers["id"][steep].any())
        self.assertFalse(layers["N"][steep].any())
        self.assertTrue((layers["P"][steep][:, 2] > CENTER[2]).all(), "the glyph's depth")
        self.assertTrue((layers["id"][numpy.isnan(hits(False)[0])] == 1).all(), "the floor beside")

    def test_a_camera_that_moves_moves_the_picture(self):
        window = window_with(floor_actor(), parallel=True)
        camera = window.GetRenderers().GetFirstRenderer().GetActiveCamera()
        after = camera.NewInstance()
        after.DeepCopy(camera)
        right, up, _ = axes()
        aside = SCALE / (HEIGHT / 2) * (3 * right - 2 * up)  # three pixels right, two down
        after.SetPosition(POSITION + aside)
        after.SetFocalPoint(CENTER + aside)
        layers = layers_of(render.capture(window, camera_after=after))
        self.assertLess(numpy.abs(layers["forward"] - [-3, 2]).max(), 1e-3)

    def test_depth_sees_what_8_bits_do_not(self):
        pictures, depths = [], []
        for ahead in (0.0, 0.01):
            actor = self.moved_ball()
            actor.AddPosition(ahead * axes()[2])
            window = window_with(actor, parallel=True)
            layers = layers_of(render.capture(window))
            pictures.append(layers["RGBA"])
            depths.append(layers["Z"][layers["id"] == 1])
        self.assertTrue((pictures[0] == pictures[1]).all(), "the colors do not differ")
        # Vertices are rounded by 1e-7; the slope at the rim, about 70, multiplies this error.
        self.assertLess(numpy.abs(depths[1] - depths[0] - 0.01).max(), 1e-4)

    def test_the_file_holds_the_layers(self):
        window = window_with(self.moved_ball())
        path = self.folder / "ball.exr"
        writer = vtkActiveEXRWriter()
        writer.AddAttribute("comments", "a ball")
        image = render.write_exr(window, path, frame_duration=DURATION, writer=writer)
        reader = vtkActiveEXRReader()
        reader.SetFileName(str(path))
        reader.Update()
        read, made = layers_of(reader.GetOutput()), layers_of(image)
        self.assertEqual(set(read), set(made))
        for name in ("Z", "P", "id"):
            self.assertTrue((read[name] == made[name]).all(), name)
        for name in ("N", "forward"):
            rounded = made[name].astype(numpy.float16).astype(numpy.float32)
            self.assertTrue((read[name] == rounded).all(), name)
        light = made["RGBA"][:, 0] / 255.0
        light = numpy.where(light <= 0.04045, light / 12.92, ((light + 0.055) / 1.055) ** 2.4)
        self.assertLess(numpy.abs(read["RGBA"][:, 0] - light).max(), 2**-11, "decoded from sRGB")
        data = reader.GetOutput().GetFieldData()
        self.assertEqual(data.GetAbstractArray("comments").GetValue(0), "a ball")
        # worldToNDC maps P to its pixel.
        to_picture = vtk_to_numpy(data.GetArray("worldToNDC")).reshape(4, 4)
        to_camera = vtk_to_numpy(data.GetArray("worldToCamera")).reshape(4, 4)
        pixel = numpy.flatnonzero(made["id"])[7]
        place = numpy.append(made["P"][pixel], 1.0)
        x, y, _, w = to_picture @ place
        self.assertAlmostEqual(x / w * WIDTH, pixel % WIDTH + 0.5, delta=1e-3)
        self.assertAlmostEqual((1 - y / w) * HEIGHT, pixel // WIDTH + 0.5, delta=1e-3)
        self.assertAlmostEqual((to_camera @ place)[2], made["Z"][pixel], delta=1e-5)

    def test_an_origin_is_any_sequence(self):
        window, origin = window_with(self.moved_ball()), (1.0, 2.0, 3.0)
        wanted = layers_of(render.write_exr(window, self.folder / "a.exr", origin=origin))["P"]
        given = render.write_exr(window, self.folder / "b.exr", origin=numpy.array(origin))
        numpy.testing.assert_array_equal(layers_of(given)["P"], wanted)
        one, other = ((self.folder / name).read_bytes() for name in ("a.exr", "b.exr"))
        self.assertEqual(one, other)
        writer = vtkActiveEXRWriter()
        for name, place, said in (("c.exr", origin, b"1 2 3"), ("d.exr", None, b"0 0 0")):
            render.write_exr(window, self.folder / name, origin=place, writer=writer)
            content = (self.folder / name).read_bytes()
            start = content.index(b"worldOrigin")
            self.assertIn(said, content[start : start + 40])

    def test_the_window_is_left_as_it_was(self):
        window = window_with(self.moved_ball())
        window.SetMultiSamples(4)
        window.Render()
        renderer = window.GetRenderers().GetFirstRenderer()
        samples = window.GetMultiSamples()
        first = layers_of(render.capture(window))
        again = layers_of(render.capture(window))
        self.assertEqual(window.GetMultiSamples(), samples)
        self.assertEqual(window.GetRenderers().GetNumberOfItems(), 1)
        self.assertIs(window.GetRenderers().GetFirstRenderer(), renderer)
        for name, numbers in first.items():
            self.assertTrue((numbers == again[name]).all(), name)

    def test_renderers_drawn_later_leave_the_layers_alone(self):
        alone = layers_of(render.capture(window_with(self.moved_ball())))
        for layer in (0, 1):
            with self.subTest(layer=layer):
                window = window_with(self.moved_ball())
                window.SetNumberOfLayers(2)
                over = vtkRenderer()
                over.SetLayer(layer)
                over.SetViewport(0.5, 0.0, 1.0, 1.0)
                over.AddActor(floor_actor())
                undrawn = vtkRenderer()
                undrawn.SetLayer(layer)
                undrawn.DrawOff()
                window.AddRenderer(over)
                window.AddRenderer(undrawn)
                layers = layers_of(render.capture(window))
                self.assertFalse((layers["RGBA"] == alone["RGBA"]).all(), "it is in the picture")
                for name in set(layers) - {"RGBA"}:
                    self.assertTrue((layers[name] == alone[name]).all(), name)
                draws = [renderer.GetDraw() for renderer in window.GetRenderers()]
                self.assertEqual(draws, [1, 1, 0])

    def test_an_empty_window_is_far_away(self):
        layers = layers_of(render.capture(window_with()))
        self.assertTrue((layers["Z"] == numpy.float32(render.FAR)).all())
        self.assertFalse(layers["id"].any())

    def test_a_window_of_before_opengl_is_refused(self):
        program = (
            "from vtkmodules.vtkRenderingCore import vtkRenderWindow, vtkRenderer\n"
            "window = vtkRenderWindow()\n"
            "window.AddRenderer(vtkRenderer())\n"
            "from active_implicit_surfaces import render\n"
            "try:\n"
            "    render.capture(window)\n"
            "except ValueError as error:\n"
            "    print(error)\n"
        )
        done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("before the window is made", done.stdout)

    def test_what_cannot_be_is_told(self):
        with self.assertRaisesRegex(ValueError, "no renderer"):
            render.capture(vtkRenderWindow())
        window = window_with(self.moved_ball())
        with self.assertRaisesRegex(ValueError, "encoding"):
            render.capture(window, encoding="gamma")
        with self.assertRaisesRegex(OSError, "absent"):
            render.write_exr(window, self.folder / "absent" / "a.exr")
        window.GetRenderers().GetFirstRenderer().SetViewport(0, 0, 0.5, 1)
        with self.assertRaisesRegex(ValueError, "fill"):
            render.capture(window)


if __name__ == "__main__":
    unittest.main()
