# ctest: DISPLAY LABELS contract
"""Files of every kind on a full disk: one message, and no file rather than half of it."""

import contextlib
import importlib.util
import resource
import shutil
import sys
import unittest
from unittest import mock

import numpy
from active_implicit_surfaces.skin_files import PARTICLE_OUT_SUFFIXES, SKIN_SUFFIXES
from command_line import CommandTest, grid


@contextlib.contextmanager
def small_disk(size):
    """No file can become larger than `size` bytes."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


class FullDisk(CommandTest):
    def setUp(self):
        super().setUp()
        self.data = self.folder / "particles.xyz"
        numpy.savetxt(self.data, grid(), fmt="%.9g")

    def check(self, *command):
        """The last argument names the output."""
        name = self.folder / command[-1]
        self.succeed(*command)
        whole = name.stat().st_size
        name.unlink()
        for share in (0.02, 0.5, 0.95, 1.0):
            with self.subTest(name.name, share=share):
                with small_disk(int(share * (whole - 1))), self.no_other_words():
                    said = self.fail_with(1, *command)
                self.assertRegex(said, rf"{name.name}\W.*cannot be written")
                self.assertEqual([path.name for path in self.folder.iterdir()], [self.data.name])

    @contextlib.contextmanager
    def no_other_words(self):
        """Checks that no object raises an exception when deleted; Python would only print it."""
        with mock.patch.object(sys, "unraisablehook") as hook:
            yield
        hook.assert_not_called()

    def test_skins(self):
        for suffix in SKIN_SUFFIXES:
            self.check("skin", self.data, "--index", "none", "-o", f"s{suffix}")

    def test_particles(self):
        for suffix in PARTICLE_OUT_SUFFIXES:
            self.check("convert", self.data, "-o", f"p{suffix}")

    def test_pictures_and_films(self):
        kinds = ["png", "exr", "ogv", *(["mp4"] if shutil.which("ffmpeg") else [])]
        for kind in kinds:
            self.check("skin", self.data, "--size", "64x48", "--render", f"f.{kind}")

    @unittest.skipUnless(importlib.util.find_spec("pxr"), "usd-core is not installed")
    def test_usd(self):
        for kind in ("usdc", "usda"):
            self.check("skin", self.data, "-o", f"s.{kind}")


if __name__ == "__main__":
    unittest.main()
