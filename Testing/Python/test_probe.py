# ctest: LABELS exact
"""The solvent-excluded surface, compared with quadrature and with grids.

Run: python3 test_probe.py
"""

import unittest
from unittest import mock

import active_implicit_surfaces as active
import numpy
from active_implicit_surfaces import solvent
from active_implicit_surfaces.data_objects import as_particles
from active_implicit_surfaces.measures import measure
from command_line import CommandTest
from shapes import write
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

SHARE = 0.02
WATER = 1.4
TURN = numpy.array([0.6, 0.64, 0.48])  # along no axis of the lattice


def cyclohexane():
    """A chair: six carbons, and two hydrogens at each; van der Waals radii [angstrom]."""
    angles, sign = numpy.arange(6) * numpy.pi / 3, (-1.0) ** numpy.arange(6)
    ring = numpy.stack([numpy.cos(angles), numpy.sin(angles), 0 * angles], axis=1)
    carbons = 1.46 * ring + numpy.outer(sign, [0, 0, 0.25])
    axial = carbons + numpy.outer(sign, [0, 0, 1.09])
    equatorial = carbons + 1.03 * ring - numpy.outer(sign, [0, 0, 0.36])
    centers = numpy.concatenate([carbons, axial, equatorial])
    return centers + [0.13, 0.07, 0.21], numpy.repeat([1.7, 1.1], [6, 12])


def cluster(count=25, side=7.0, seed=3):
    random = numpy.random.default_rng(seed)
    return random.uniform(0, side, (count, 3)), random.choice([1.1, 1.5, 1.7, 1.8], count)


def lowest(points, centers, radii):
    """Distance to the nearest ball, negative within it."""
    found = numpy.full(points.shape[:-1], numpy.inf)
    for center, radius in zip(centers, radii):
        numpy.minimum(found, numpy.linalg.norm(points - center, axis=-1) - radius, out=found)
    return found


def on_sphere(count):
    turns = numpy.arange(count) + 0.5
    height, angle = 1 - 2 * turns / count, numpy.pi * (1 + 5**0.5) * turns
    flat = numpy.sqrt(1 - height**2)
    return numpy.stack([flat * numpy.cos(angle), flat * numpy.sin(angle), height], axis=1)


def dots_on(centers, reaches, count):
    """Points on the balls' surfaces outside all other balls, and the exposed area by Shrake and
    Rupley."""
    dots = centers[:, None] + reaches[:, None, None] * on_sphere(count)
    are_free = lowest(dots, centers, reaches) > -1e-9
    return dots[are_free], (are_free.sum(axis=1) / count * 4 * numpy.pi * reaches**2).sum()


def volume_and_area(centers, radii, probe, step=0.25, slab=0.2):
    """Volume and area from a grid: points within the accessible balls, farther than the probe
    from their outside.

    The distance to the outside is that to the nearest dot on these balls. The area is the volume of
    a slab around the surface over its thickness; without a probe it is that of the dots.
    """
    low, high = (centers.min(0) - 4, centers.max(0) + 4)
    axes = [numpy.arange(a, b, step) for a, b in zip(low, high)]
    points = numpy.stack(numpy.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)
    exits = -lowest(points, centers, radii + probe)
    dots, area = dots_on(centers, radii + probe, 4000)
    if probe == 0.0:
        return (exits > 0).sum() * step**3, area
    inside, dots = numpy.flatnonzero((exits > 0) & (exits < probe + slab)), dots.astype("f4")
    for own in numpy.array_split(inside, len(inside) // 500 + 1):
        one = points[own].astype("f4")
        squares = (one**2).sum(1)[:, None] + (dots**2).sum(1) - 2 * one @ dots.T
        exits[own] = numpy.sqrt(numpy.maximum(squares.min(axis=1), 0))
    volume, wide, narrow = ((exits > probe + shift).sum() for shift in (0, -slab, slab))
    return volume * step**3, (wide - narrow) * step**3 / (2 * slab)


def two_balls(distance, radius, probe):
    """Volume and area of two equal balls and of the gap that the probe cannot enter, by
    quadrature."""
    x = numpy.linspace(-distance / 2 - radius, distance / 2 + radius, 200001)
    ball = numpy.sqrt(numpy.maximum(0.0, radius**2 - (numpy.abs(x) - distance / 2) ** 2))
    reach = radius + probe
    ring = numpy.sqrt(max(0.0, reach**2 - distance**2 / 4))  # of centres that touch both balls
    contact = distance / 2 * (1 - radius / reach)
    neck = ring - numpy.sqrt(numpy.maximum(0.0, probe**2 - x**2))
    has_neck = distance < 2 * reach
    height = numpy.where(has_neck & (numpy.abs(x) < contact), numpy.maximum(neck, 0.0), ball)
    slope = numpy.hypot(numpy.diff(x), numpy.diff(height))
    area = numpy.pi * ((height[1:] + height[:-1]) * slope).sum()
    return numpy.trapz(numpy.pi * height**2, x), area


class Measures(unittest.TestCase):
    def check(self, centers, radii, probe, expected, **options):
        found = measure(active.skin(centers, radii=radii, probe=probe, **options))
        shares = found["volume"] / expected[0], found["area"] / expected[1]
        self.assertLess(numpy.abs(numpy.array(shares) - 1).max(), SHARE, shares)
        self.assertEqual(found["open edges"], 0)

    def test_two_balls(self):
        for distance in (1.5, 3.0, 4.2, 5.5, 7.0):
            for probe in (0.0, WATER):
                with self.subTest(distance=distance, probe=probe):
                    centers = numpy.outer([0, distance], TURN / numpy.linalg.norm(TURN))
                    expected = two_balls(distance, 1.7, probe)
                    self.check(centers, numpy.full(2, 1.7), probe, expected)
                    self.check(centers, numpy.full(2, 1.7), probe, expected, voxel_size=0.3)

    def test_molecule_and_cluster(self):
        for atoms in (cyclohexane(), cluster()):
            for probe in (0.0, 0.8, WATER):
                with self.subTest(atoms=len(atoms[0]), probe=probe):
                    self.check(*atoms, probe, volume_and_area(*atoms, probe))

    def test_the_grid_of_this_test(self):
        for distance in (3.0, 7.0):
            centers = numpy.outer([0, distance], TURN / numpy.linalg.norm(TURN)) + 0.12
            for probe in (0.0, WATER):
                found = numpy.array(volume_and_area(centers, numpy.full(2, 1.7), probe, 0.125))
                expected = two_balls(distance, 1.7, probe)
                self.assertLess(numpy.abs(found / expected - 1).max(), SHARE)


class Distances(unittest.TestCase):
    def test_exact_at_the_points_of_the_image(self):
        """The reference is the distance to the nearest free one of 30,000 dots on each accessible
        ball."""
        centers, radii = cluster()
        for probe, most in ((0.0, 0.02), (WATER, 0.05)):
            reach = radii + probe
            dots, _ = dots_on(centers, reach, 30000)
            image = solvent.excluded_distance(centers, radii, probe, 0.4)
            shape = numpy.array(image.GetDimensions()[::-1])
            values = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(shape)
            place = numpy.random.default_rng(1).integers(0, shape, (400, 3))
            points = image.GetOrigin() + 0.4 * place[:, ::-1]
            away = lowest(points, centers, reach)
            exit = numpy.array([numpy.linalg.norm(dots - one, axis=1).min() for one in points])
            expected = numpy.clip(probe + numpy.where(away > 0, away, -exit), -0.8, 0.8)
            error = values[tuple(place.T)] - expected
            self.assertGreater(error.min(), -1e-6)  # dots are at least as far as the surface
            self.assertLess(error.max(), most)
            self.assertGreater((numpy.abs(expected) < 0.8).sum(), 50)

    def test_whatever_the_order_of_the_atoms(self):
        centers, radii = cluster()
        order = numpy.random.default_rng(0).permutation(len(radii))
        images = [
            solvent.excluded_distance(centers[own], radii[own], WATER, 0.4)
            for own in (slice(None), order, numpy.append(order, order))
        ]
        found = [vtk_to_numpy(one.GetPointData().GetScalars()).tobytes() for one in images]
        self.assertEqual(len(set(found)), 1)


class Skins(unittest.TestCase):
    def test_a_cavity_is_a_void(self):
        shell = 6 * on_sphere(150)
        found = measure(active.skin(shell, radii=numpy.full(150, 1.7), probe=WATER))
        self.assertEqual((found["pieces"], found["voids"]), (1, 1))
        inner = shell[::3] * 0.35
        full = numpy.concatenate([shell, inner])
        found = measure(active.skin(full, radii=numpy.full(200, 1.7), probe=WATER))
        self.assertEqual((found["pieces"], found["voids"]), (1, 0))

    def test_arrays_of_the_nearest_atom(self):
        centers = numpy.array([[0.0, 0, 0], [3.5, 0, 0], [7, 0, 0]])
        atoms = as_particles(centers, radii=numpy.full(3, 1.7), residue=[7, 7, 12])
        skin = active.skin(atoms, radii="radius", probe=WATER, pass_target_arrays=True)
        arrays = skin.GetPointData()
        points = vtk_to_numpy(skin.GetPoints().GetData())
        nearest = numpy.abs(points[:, :1] - centers[:, 0]).argmin(axis=1)
        self.assertEqual(
            vtk_to_numpy(arrays.GetArray("residue")).tolist(),
            numpy.array([7, 7, 12])[nearest].tolist(),
        )
        self.assertEqual(vtk_to_numpy(arrays.GetArray("residue")).dtype.kind, "i")
        self.assertIsNotNone(arrays.GetNormals())
        names = [arrays.GetArrayName(i) for i in range(arrays.GetNumberOfArrays())]
        self.assertEqual(names, ["Normals", "radius", "residue"])
        plain = active.skin(atoms, radii="radius", probe=WATER)
        self.assertIsNone(plain.GetPointData().GetArray("residue"))

    def test_a_trajectory(self):
        """Atoms move by 0.9 in a step."""
        centers, radii = cluster()
        walk = numpy.random.default_rng(2).normal(0.5, 0.2, (6, *centers.shape)).cumsum(axis=0)
        series = [as_particles(centers + way, radii=radii) for way in walk]
        for frame, (_, skin) in zip(series, active.frames(series, fps=25, probe=WATER)):
            alone = measure(active.skin(frame, radii="radius", probe=WATER))
            self.assertLess(abs(measure(skin)["volume"] / alone["volume"] - 1), 0.01)

    def test_a_frame_without_atoms(self):
        """A molecule that appears has its full volume a frame later."""
        centers, radii = cyclohexane()
        there = as_particles(centers, radii=radii)
        nothing = as_particles(numpy.zeros((0, 3)), radii=numpy.zeros(0))
        alone = measure(active.skin(there, radii="radius", probe=WATER))["volume"]
        for series in ([there, nothing, there, there], [nothing, there, there, nothing]):
            skins = [skin for _, skin in active.frames(series, fps=25, probe=WATER)]
            found = [measure(skin)["volume"] if skin.GetNumberOfPolys() else 0.0 for skin in skins]
            for i, frame in enumerate(series):
                grows = frame is there and i > 0 and series[i - 1] is nothing
                share = found[i] / alone - (frame is there)
                self.assertLess(abs(share), 0.15 if grows else 0.02, found)

    def test_errors(self):
        centers, radii = cyclohexane()
        cases = (
            ("no array of numbers 'radius'", {"probe": 1.4}),
            ("0 or more, not -1", {"probe": -1.0, "radii": radii}),
            ("0 or more, not nan", {"probe": float("nan"), "radii": radii}),
            ("preset molecule has no effect", {"probe": 1.4, "radii": radii, "preset": "molecule"}),
            ("array of strengths", {"probe": 1.4, "radii": radii, "strengths": radii}),
            ("No atom has a radius above 0", {"probe": 1.4, "radii": 0 * radii}),
            ("set the voxel size", {"probe": 1.4, "radii": radii, "voxel_size": 0.001}),
        )
        for said, options in cases:
            with self.subTest(said), self.assertRaisesRegex(ValueError, said):
                active.skin(centers, **options)
        with self.assertRaisesRegex(TypeError, "no property 'fps'"):
            active.skin(centers, radii=radii, probe=1.4, fps=10)
        few = mock.patch.object(solvent, "MOST_PAIRS", 1000)
        with few, self.assertRaisesRegex(ValueError, "touches too many pairs of atoms"):
            active.skin(centers, radii=radii, probe=50.0)

    def test_the_advised_voxel_size_is_large_enough(self):
        options = {"radii": [1.0, 1.0], "probe": 1.4}
        for far in ([1e4, 0, 0], [200, 200, 100]):
            with mock.patch.object(solvent, "MOST_POINTS", 100_000):
                with self.assertRaisesRegex(ValueError, "set the voxel size to") as caught:
                    active.skin([[0, 0, 0], far], voxel_size=0.1, **options)
                least = float(str(caught.exception).split()[-3])
                active.skin([[0, 0, 0], far], voxel_size=least, **options)


PDB = (
    "ATOM  {0:5d}  {1:<3s} {2} A{3:4d}    {4:8.3f}{5:8.3f}{6:8.3f}  1.00  0.00           {1:.1s}\n"
)


class Command(CommandTest):
    def write(self, name="atoms.pdb", x=0.0):
        rows = [("N", "GLY", 1, x, 0, 0), ("CA", "GLY", 1, 1.45, 0, 0), ("C", "ALA", 2, 2, 1.4, x)]
        path = self.folder / name
        path.write_text("".join(PDB.format(i, *row) for i, row in enumerate(rows)))
        return path

    def test_a_file(self):
        path, skin = self.write(), self.folder / "skin.vtp"
        self.succeed("skin", path, "--probe", 1.4, "--pass-target-arrays", "-o", skin)
        told = self.succeed("info", skin).out
        for line in ("pieces: 1", "voids: 0", "closed: yes", "residue: ", "atomic_number: "):
            self.assertIn(line, told)
        self.succeed("skin", path, "--probe", 0, "--radii", "radius", "-o", skin)
        self.assertNotIn("residue", self.succeed("info", skin).out)

    def test_a_run_that_is_resumed(self):
        files = [self.write(f"run_{i}.pdb", 0.1 * i) for i in range(3)]
        options = ("--probe", 1.4, "--pass-target-arrays", "-o")
        self.succeed("skin", *files, *options, "once_#.vtp")
        self.succeed("skin", *files[:2], *options, "then_#.vtp", "--resume")
        self.succeed("skin", *files, *options, "then_#.vtp", "--resume")
        for i in range(3):
            names = (self.folder / f"{start}_{i}.vtp" for start in ("once", "then"))
            self.assertEqual(len({name.read_bytes() for name in names}), 1)
        said = self.fail_with(
            1, "skin", *files, "--probe", 2, *options[2:], "then_#.vtp", "--resume"
        )
        self.assertIn("probe", said)

    def test_options_without_effect(self):
        path = self.write()
        for option in ("--preset=molecule", "--particle-spacing=1", "--ids=residue"):
            self.fail_with(2, "skin", path, "--probe", 1.4, option)

    def test_images(self):
        ball = solvent.excluded_distance([[0, 0, 0]], [1.7], 0.0, 0.4)
        image = write(vtkXMLImageDataWriter(), ball, self.folder / "image.vti")
        self.assertIn("the input is an image", self.fail_with(1, "skin", image, "--probe", 1.4))


if __name__ == "__main__":
    unittest.main()
