#!/usr/bin/python3
"""Exports that are killed at random moments must end with the same bytes as an uninterrupted run.

Usage: crash_test.py PROGRAM [--long] [unittest arguments]
"""
import json
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

from support import small_export
from support.program import FolderCase, hashes, run, start
from support.small_export import EVERYTHING

KILLS = 200 if "--long" in sys.argv else 10
sys.argv = [word for word in sys.argv if word != "--long"]


class Crash(FolderCase):
    keeps_cache = True

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.project = small_export.plan(cls.folder, 30)
        cls.seconds = []
        for name in ["unbroken", "again"]:
            begin = time.time()
            made = run("export", cls.project, "--out", cls.folder / name, *EVERYTHING)
            cls.seconds.append(time.time() - begin)
            assert made.returncode == 0, made.stderr
        cls.expected = hashes(cls.folder / "unbroken")

    def test_the_bytes_do_not_depend_on_the_run(self):
        self.assertEqual(hashes(self.folder / "again"), self.expected)

    def kill_after(self, seconds, out):
        """Returns whether the export was still running."""
        process = start("export", self.project, "--out", out, "--resume", *EVERYTHING)
        try:
            _, errors = process.communicate(timeout=seconds)
            self.assertEqual(process.returncode, 0, errors)
            return False
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            return True

    def assertHonest(self, out):
        """All files that dataset.json lists exist and are complete, if there is a dataset.json."""
        if not (out / "dataset.json").exists():
            return
        found = hashes(out)
        for name, value in json.loads((out / "dataset.json").read_text())["files"].items():
            self.assertEqual(found.get(name), value, name)

    def test_killed_at_random_instants_it_ends_with_the_same_bytes(self):
        seed = random.randrange(10**6)
        instants = random.Random(seed)
        kills = unlucky = 0
        while kills < KILLS:
            out = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
            # Some are killed again while they continue.
            for _ in range(instants.choice([1, 1, 1, 2, 3])):
                kills += self.kill_after(instants.uniform(0.0, min(self.seconds)), out)
                self.assertHonest(out)
            result = run("export", self.project, "--out", out, "--resume", *EVERYTHING)
            with self.subTest(seed=seed, kills=kills):
                self.assertEqual(result.returncode, 0, result.stderr)
                unlucky += hashes(out) != self.expected
                self.assertEqual(hashes(out), self.expected)
            shutil.rmtree(out)
        print(f"crash: {kills} kills, {unlucky} exports with other bytes (seed {seed})",
              file=sys.stderr)


if __name__ == "__main__":
    unittest.main()
