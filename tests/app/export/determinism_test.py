#!/usr/bin/python3
"""The same scene, parameters and seed give the same bytes in any folder, locale, time zone and
number of threads.

Usage: determinism_test.py PROGRAM USER_LOCALE.so [unittest arguments]
"""
import os
import subprocess
import sys
import unittest

from support import tiny_room
from support.program import PROGRAM, FolderCase, hashes
from support.small_export import EVERYTHING, SIZE

LOCALE = os.path.abspath(sys.argv.pop(1))
PLAIN = {"PATH": os.environ["PATH"], "LC_ALL": "C", "TZ": "UTC"}


class Determinism(FolderCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.room = cls.folder / "room.obj"
        tiny_room.write(cls.room)
        cls.expected = cls.make("plain", ["--threads", "1"], PLAIN)

    @classmethod
    def make(cls, name, arguments=(), environment=None, wrapper=(), seed=3):
        """Plans and exports with all modalities and formats; returns the bytes of project and
        dataset."""
        def program(*words):
            result = subprocess.run(
                [*wrapper, os.path.abspath(PROGRAM), *words, *arguments], capture_output=True,
                text=True, env=environment or PLAIN, cwd=cls.folder)
            assert result.returncode == 0, result.stderr
        out = cls.folder / name
        out.mkdir()
        settings = [*SIZE, "--max-frames", "12", "--seed", str(seed), "--set", "fill=0.55",
                    "--start", "1.5,-1,1.25,3.2,-0.74,1.6"]
        program("plan", cls.room, *settings, "-o", out / "room.dolly")
        program("export", out / "room.dolly", "--out", out / "from_project", *EVERYTHING)
        # It does not matter either whether the plan was stored in between.
        program("export", cls.room, *settings, "--out", out / "from_scene", *EVERYTHING)
        made = hashes(out)
        from_scene = {name.split("/", 1)[1]: value for name, value in made.items()
                      if name.startswith("from_scene/")}
        from_project = {name.split("/", 1)[1]: value for name, value in made.items()
                        if name.startswith("from_project/")}
        assert from_scene == from_project, set(from_scene.items()) ^ set(from_project.items())
        return made

    def test_on_two_threads(self):
        self.assertEqual(self.make("two", ["--threads", "2"]), self.expected)
        self.assertEqual(self.make("again", ["--threads", "2"]), self.expected)

    def test_on_one_core(self):
        self.assertEqual(self.make("core", wrapper=["taskset", "-c", "0"]), self.expected)

    def test_in_other_time_zones_and_homes(self):
        home = {**PLAIN, "TZ": "Pacific/Kiritimati", "HOME": "/nonexistent", "USER": "nobody",
                "TMPDIR": "/var/tmp", "COLUMNS": "20"}
        self.assertEqual(self.make("far_away", environment=home), self.expected)

    def test_where_numbers_have_a_comma(self):
        locale = self.folder / "locale"
        locale.mkdir()
        made = subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", locale / "de_DE.UTF-8"],
                              capture_output=True)
        if not (locale / "de_DE.UTF-8" / "LC_NUMERIC").exists():
            self.skipTest(f"the locale cannot be made: {made.stderr}")
        shows = self.folder / "shows"
        german = {**PLAIN, "LC_ALL": "de_DE.UTF-8", "LANG": "de_DE.UTF-8", "LOCPATH": str(locale),
                  "LD_PRELOAD": LOCALE, "LOCALE_SHOWS": str(shows)}
        self.assertEqual(self.make("german", environment=german), self.expected)
        self.assertEqual(shows.read_text(), "1,5")

    def test_another_seed_is_another_dataset(self):
        made = self.make("seed", seed=4)
        self.assertNotEqual(made["from_project/dataset.json"],
                            self.expected["from_project/dataset.json"])


if __name__ == "__main__":
    unittest.main()
