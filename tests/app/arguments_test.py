#!/usr/bin/python3
"""What can be given on the command line, and what is said of slips: arguments_test.py PROGRAM."""
import json
import unittest

import tiny_room
from program import FolderCase, run


class Arguments(FolderCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.room = cls.folder / "room.obj"
        tiny_room.write(cls.room)

    def info(self, *arguments):
        result = run("-q", "info", self.room, "--json", *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def test_a_unit_is_a_name_or_metres(self):
        for name, metres in [("mm", 0.001), ("cm", 0.01), ("m", 1), ("inch", 0.0254),
                             ("ft", 0.3048)]:
            self.assertEqual(self.info("--unit", name), self.info("--unit", metres), name)
        self.assertNotEqual(self.info("--unit", "ft"), self.info("--unit", "m"))
        for wrong in ["furlong", "0", "-1", "1e9", "nan", "0.01x"]:
            self.assertFails(run("-q", "info", self.room, f"--unit={wrong}"), 2)
            self.assertIn("metres per unit", run("info", self.room, f"--unit={wrong}").stderr)

    def test_a_range_that_ends_before_it_begins_is_called_so(self):
        self.assertFails(run("export", self.room, "--out", self.folder / "x", "--range", "10:5"), 2,
                         "10:5", "ends before")
        self.assertFalse((self.folder / "x").exists())

    def test_help_tells_defaults_and_what_is_given_once_each(self):
        text = run("evaluate", "--help").stdout
        for name, default in [("--max-dt", "0.02"), ("--delta", "1"), ("--align", "se3"),
                              ("--min-tracked", "0.8"), ("--max-ate", "0.5")]:
            line = next(line for line in text.splitlines() if line.strip().startswith(name))
            self.assertIn("=" + default, line)
        self.assertIn("--estimated FILE", text)
        self.assertNotIn(" ...", text)
        self.assertNotIn(" ...", run("export", "--help").stdout)
        # What takes several at once still says so.
        self.assertIn(" ...", run("compare", "--help").stdout)


if __name__ == "__main__":
    unittest.main()
