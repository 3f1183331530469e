#!/usr/bin/python3
"""OSMesa and EGL render the same dataset.

Usage: backends_test.py PROGRAM [unittest arguments]
"""
import os
import re
import subprocess
import unittest

import cv2
import numpy as np

from support import small_export
from support.program import PROGRAM, FolderCase, hashes, run
from support.small_export import EVERYTHING

NO_DRIVER = {**os.environ, "__EGL_VENDOR_LIBRARY_FILENAMES": "/nowhere.json"}
NO_OPENGL = 5


class Backends(FolderCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.project = small_export.plan(cls.folder, 8)
        for backend in ("osmesa", "egl"):
            made = run("export", cls.project, "--out", cls.folder / backend, "--gl", backend,
                       *EVERYTHING)
            assert made.returncode == 0, made.stderr

    def images(self, modality):
        """For each frame, the images of both backends."""
        ours = sorted((self.folder / "osmesa" / modality).glob("*.png"))
        self.assertGreater(len(ours), 3)
        for path in ours:
            other = self.folder / "egl" / modality / path.name
            yield [cv2.imread(str(p), cv2.IMREAD_UNCHANGED).astype(int) for p in (path, other)]

    def test_depth_and_ids_are_equal(self):
        one, other = hashes(self.folder / "osmesa"), hashes(self.folder / "egl")
        self.assertEqual(sorted(one), sorted(other))
        exact = [name for name in one if name.split("/")[0] in ("depth", "depth_exr", "instance",
                                                                "semantic", "amodal")]
        self.assertGreater(len(exact), 20)
        for name in exact:
            self.assertEqual(one[name], other[name], name)

    def test_colours_differ_by_one_at_most(self):
        for modality in ("rgb", "rgb_right", "albedo"):
            for ours, theirs in self.images(modality):
                self.assertLessEqual(np.abs(ours - theirs).max(), 1)

    def test_other_frames_differ(self):
        """The two tests above would notice another frame."""
        ours = [image for image, _ in self.images("rgb")]
        self.assertGreater(np.abs(ours[0] - ours[-1]).max(), 1)

    def test_each_is_what_it_is_called(self):
        """Without a driver for EGL, 'egl' fails with advice, and the other two settings render."""
        for backend, code in (("egl", NO_OPENGL), ("osmesa", 0), ("auto", 0)):
            made = run("export", self.project, "--out", self.folder / ("without_" + backend),
                       "--gl", backend, "--range", ":1", env=NO_DRIVER)
            self.assertEqual(made.returncode, code, made.stderr)
            for told in ("install libegl1", "tried: Mesa without a card (not offered"):
                self.assertEqual(told in made.stderr, code == NO_OPENGL, made.stderr)

    def test_no_function_is_bound_to_one_library(self):
        """A function bound by the linker would call OSMesa with every backend."""
        listed = subprocess.run(["nm", "-D", "--undefined-only", PROGRAM], capture_output=True,
                                text=True, check=True).stdout
        self.assertIn("__glewCreateTextures", listed)
        self.assertEqual(re.findall(r"\bgl[A-Z]\w+", listed), [])

    def test_unknown_names_are_refused(self):
        made = run("export", self.project, "--out", self.folder / "x", "--gl", "vulkan")
        self.assertEqual(made.returncode, 2)
        self.assertIn("--gl", made.stderr)

    def test_plans_are_drawn_by_both(self):
        for backend in ("osmesa", "egl"):
            picture = self.folder / (backend + ".png")
            made = run("plan", self.folder / "room.obj", "--max-frames", "5", "--picture", picture,
                       "--gl", backend)
            self.assertEqual(made.returncode, 0, made.stderr)
        one, other = (cv2.imread(str(self.folder / (b + ".png"))).astype(int)
                      for b in ("osmesa", "egl"))
        self.assertGreater(one.std(), 5)
        self.assertLessEqual(np.abs(one - other).max(), 1)


if __name__ == "__main__":
    unittest.main()
