# ctest: LABELS contract
"""An option without effect in its context is an error that names it and the contexts with an
effect.

Options that the program regards as without effect leave the filter's skins the same.
"""

import unittest
import warnings

import numpy
from active_implicit_surfaces import ActiveSurfaceWarning, api, morphing, properties, skin_files
from active_implicit_surfaces.commands import effects
from command_line import CommandTest, grid, moving_grid
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkSphereSource

PIPELINE = "in a pipeline of VTK"


def meshes():
    for source in (vtkCubeSource(), vtkSphereSource()):
        source.Update()
        yield source.GetOutput()


def another(own):
    """A value of a property that is not its default."""
    if own.kind == "choice":
        return next(word for i, word in enumerate(own.choices) if i != own.default)
    if own.kind == "switch":
        return not own.default
    if own.kind == "integer":
        return own.default * 2 + 1
    if own.name == "PeriodicBounds":
        return (-0.2, 0.8, 1.0, -1.0, 1.0, -1.0)
    return 0.3 if own.name in ("Transport", "CFL") else max(own.default, 0) * 2 + 0.37


def bytes_of(frames):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ActiveSurfaceWarning)
        *_, (_, skin) = frames
    arrays = skin.GetPointData()
    numbers = [arrays.GetArray(i) for i in range(arrays.GetNumberOfArrays())]
    return [vtk_to_numpy(one).tobytes() for one in (skin.GetPoints().GetData(), *numbers)]


class Errors(CommandTest):
    def setUp(self):
        super().setUp()
        numpy.savez("p.npz", positions=moving_grid(2), v=moving_grid(2))
        numpy.save("one.npy", grid())
        for name, mesh in zip(("a.stl", "b.stl"), meshes()):
            mesh.GetPointData().Initialize()
            skin_files.write_mesh(self.folder / name, mesh)

    def test_options_without_effect_are_named(self):
        skin, morph = ("skin", "p.npz"), ("morph", "a.stl", "b.stl")
        film = (*skin, "--render", "a.png")
        cases = {
            (*skin, "--size", "64x64"): "on pictures (--render of skin and morph)",
            (*morph, "--size", "1280x720"): "on pictures (--render of skin and morph)",
            (*skin, "--no-ground"): "on pictures (--render of skin and morph)",
            (*skin, "--up", "z"): "on pictures (--render of skin and morph) or on a .glb",
            (
                *morph,
                "-o",
                "m.stl",
                "--up",
                "z",
            ): "on pictures (--render of skin and morph) or on a .glb",
            ("convert", "a.stl", "-o", "c.ply", "--up", "z"): "on a .glb or on a .usdc",
            ("convert", "a.stl", "-o", "c.ply", "--level", 0): "from an image to a mesh",
            (*skin, "--times", "0,1", "--fps", 24): "without --times or on pictures",
            (*film, "--index", "a.pvd"): "on skins that are written (-o)",
            (*film, "--compute-velocity"): "on skins that are written (-o) or on .exr pictures",
            (*film, "--compute-curvature"): "on skins that are written",
            (*film, "--pass-target-arrays"): "on skins that are written",
            (*skin, "--velocities", "v"): "on a .usdc or .usda or with --compute-velocity",
            (*skin, "--number-of-time-steps", 11): PIPELINE,
            ("skin", "one.npy", "--number-of-time-steps", 5): PIPELINE,
            ("skin", "one.npy", "--start-time", 5): PIPELINE,
            (*skin, "--time-step-size", 0.1): PIPELINE,
            (*morph, "--number-of-time-steps", 5): PIPELINE,
            (*morph, "--start-time", 1): PIPELINE,
            (*skin, "--output-potential"): PIPELINE,
            (*skin, "--arrival-time", 1): "as --duration of active-surface morph",
            (*morph, "--arrival-time", 1): "as --duration of active-surface morph",
            (*skin, "--mesh-thickness", 0.1): "on meshes, with active-surface morph",
            (*morph, "--particle-spacing", 0.1): "on particles, with active-surface skin",
            (*morph, "--anisotropy", 2): "on particles",
            (*morph, "--pass-target-arrays"): "on particles",
            (*morph, "--transport", 0.5): "on particles",
            (*morph, "--no-tension-weighting"): "on particles",
            (*skin, "--particle-model", "sum", "--anisotropy", 2): "--particle-model anisotropic",
            (*skin, "--preset", "paper", "--anisotropy", 2): "--particle-model anisotropic",
            (*skin, "--particle-threshold", 0.4): "--particle-model sum",
            (*skin, "--volume-stiffness", 2): "with --volume-control penalty",
            (*morph, "--target-volume", 2): "penalty or with --volume-control exact",
            (*morph, "--area-control", "exact", "--area-stiffness", 2): "--area-control penalty",
            (*skin, "--rest-tolerance", 0.1): "with --evolution-mode equilibrium",
            (*skin, "--maximum-velocity", 1): "with --compute-velocity",
            (*skin, "--no-normalize-target", "--target-noise", 1): "with --normalize-target",
            (*skin, "--paper-scheme", "--transport", 0.5): "without --paper-scheme",
            ("convert", "a.stl", "-o", "c.ply", "--voxel-size", 1): "from a mesh to a .vdb",
            ("convert", "p.npz", "-o", "c.csv", "--voxel-size", 1): "from a mesh to a .vdb",
            ("convert", "a.stl", "-o", "c.ply", "--level", 1): "from an image to a mesh",
        }
        before = sorted(self.folder.iterdir())
        for command, where in cases.items():
            with self.subTest(command):
                said = self.fail_with(2, *command)
                option = [word for word in command if str(word).startswith("--")][-1]
                if command[3:5] == ("0,1", "--fps") or "--fps" in command:
                    option = "--fps"
                self.assertIn(f"{option} has no effect here: it acts ", said)
                self.assertIn(where, said)
        self.assertEqual(sorted(self.folder.iterdir()), before, "nothing is written")

    def test_options_with_effect_are_not(self):
        for command in (
            ("skin", "p.npz", "-o", "s_#.glb", "--up", "y", "--fps", 24),
            ("skin", "p.npz", "-o", "s_#.ply", "--index", "none", "--compute-velocity"),
            ("skin", "p.npz", "-o", "s_#.ply", "--particle-model", "sum", "--anisotropy", 4)[:6],
            ("skin", "p.npz", "--volume-control", "exact", "--target-volume", 0.1),
            ("skin", "p.npz", "--no-output-potential", "--no-paper-scheme", "--quiet"),
            ("morph", "a.stl", "b.stl", "--frames", 2, "--no-pass-target-arrays"),
            ("morph", "a.stl", "b.stl", "--frames", 2, "--no-create-parts"),
            ("convert", "a.stl", "-o", "a.vdb", "--voxel-size", 0.1),
            ("convert", "a.vdb", "-o", "c.stl", "--level", 0.01),
        ):
            with self.subTest(command):
                self.assertNotIn("no effect", self.succeed(*command).err)

    def test_what_acts_between_frames_is_a_note_of_one_frame(self):
        for more in (
            ("--transport", 0.5),
            ("--fps", 24),
            ("--cfl", 0.5),
            ("--time-scale", 2),
        ):
            said = self.succeed("skin", "one.npy", "-o", "s.ply", *more).err
            self.assertIn(f"note: No effect on one frame: {more[0]};", said)
        for more in ("--voxel-size", 0.05), ("--volume-control", "exact", "--target-volume", 0.1):
            said = self.succeed("skin", "one.npy", "-o", "s.ply", *more).err
            self.assertNotIn("no effect", said)

    def test_an_index_of_one_frame_is_written_if_it_is_named(self):
        self.succeed("skin", "one.npy", "-o", "s.ply", "--index", "a.series")
        self.assertIn('"s.ply"', (self.folder / "a.series").read_text())

    def test_every_rule_names_options_and_places(self):
        for row, names in effects._ACTING:
            self.assertTrue(all(map(effects._phrase, row.split())))
            for name in names.split():
                if name.startswith(":"):
                    properties.find(name[1:])


class TheFilter(unittest.TestCase):
    def assert_same(self, make, own, **others):
        plain, changed = make(**others), make(**{**others, own.keyword: another(own)})
        self.assertEqual(bytes_of(plain), bytes_of(changed), own.keyword)

    def test_properties_that_need_another_one(self):
        def over_particles(**options):
            return api.frames(moving_grid(3), particle_spacing=0.1, **options)

        others = {"normalize_target": False, "paper_scheme": True, "particle_model": "sum"}
        for own in properties.every():
            for row in effects.rows_of(own):
                keyword, _, value = row.split()[0].partition("=")
                if value and "series" not in row:
                    unmet = {} if keyword not in others else {keyword: others[keyword]}
                    if row == "particle_model=sum":
                        unmet = {}
                    with self.subTest(own.keyword, row=row):
                        self.assert_same(over_particles, own, **unmet)

    def test_a_radius_beside_an_array_of_radii(self):
        def with_radii(**options):
            return [(0, api.skin(grid(), radii=numpy.full(125, 0.2), **options))]

        for model in ("sum", "anisotropic"):
            own = properties.find("kernel_radius")
            self.assert_same(with_radii, own, particle_model=model, particle_spacing=0.1)

    def test_properties_that_act_on_particles_only(self):
        shapes = list(meshes())
        rows = {"particles", "particles atoms"}
        named = [own for own in properties.every() if rows & set(effects.rows_of(own))]
        self.assertGreaterEqual(len(named), 11)
        for own in named:
            with self.subTest(own.keyword):
                self.assert_same(
                    lambda **options: morphing.morph(*shapes, frames=2, voxel_size=0.1, **options),
                    own,
                )

    def test_properties_that_act_between_frames(self):
        for own in properties.every():
            rows = effects.rows_of(own)
            if any("series" in row and "particles" not in row for row in rows):
                with self.subTest(own.keyword):
                    self.assert_same(
                        lambda **options: api.frames([grid()], particle_spacing=0.1, **options), own
                    )


if __name__ == "__main__":
    unittest.main()
