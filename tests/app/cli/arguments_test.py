#!/usr/bin/python3
"""Which arguments the command line takes, and its messages for wrong ones: arguments_test.py
PROGRAM."""
import json
import unittest

from support import tiny_room
from support.program import FolderCase, run


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

    def test_any_of_six_axes_can_be_up(self):
        upside_down = self.folder / "upside_down.obj"
        tiny_room.write(upside_down)
        tiny_room.move_corners(upside_down, lambda x, y, z: (x, -y, -z))
        judged = run("-q", "info", upside_down, "--json")
        given = run("-q", "info", upside_down, "--json", "--up", "-y")
        for result in (judged, given):
            self.assertEqual(result.returncode, 0, result.stderr)
        judged, given = json.loads(judged.stdout), json.loads(given.stdout)
        self.assertEqual(judged["up_axis"], "-y")
        self.assertTrue(any("--up y" in warning for warning in judged["warnings"]))
        self.assertEqual(given["objects"], judged["objects"])
        self.assertEqual(given["up_source"], "given")
        self.assertEqual(len(judged["rooms"]), 1)
        for wrong in ["w", "--y", "up"]:
            refused = run("-q", "info", self.room, f"--up={wrong}")
            self.assertEqual(refused.returncode, 2)
            self.assertIn("-z", refused.stderr)

    def test_info_tells_how_much_of_a_room_is_there(self):
        self.assertGreater(self.info()["surface_coverage"], 0.999)
        text = self.room.read_text()
        lidless = self.folder / "lidless.obj"
        lidless.write_text(text.replace("o ceiling\n", "o lid\n"))
        # The ceiling's faces are removed, but its vertices stay, so that the indices of the others
        # hold.
        lines, inside = [], False
        for line in lidless.read_text().splitlines():
            inside = line == "o lid" if line.startswith("o ") else inside
            if not (inside and line[:2] in ("o ", "f ")):
                lines.append(line)
        lidless.write_text("\n".join(lines) + "\n")
        open_room = json.loads(run("-q", "info", lidless, "--json").stdout)
        self.assertLess(open_room["surface_coverage"], 0.95)
        self.assertGreater(open_room["surface_coverage"], 0.5)

    def test_a_proposed_unit_can_be_given(self):
        small = self.folder / "small.obj"
        tiny_room.write(small)
        tiny_room.move_corners(small, lambda x, y, z: (0.24 * x, 0.24 * y, 0.24 * z))
        warnings = json.loads(run("-q", "info", small, "--json").stdout)["warnings"]
        proposed = [w.split("--unit ")[1] for w in warnings if "--unit " in w]
        self.assertEqual(len(proposed), 1, warnings)
        read = json.loads(run("-q", "info", small, "--json", "--unit", proposed[0]).stdout)
        self.assertGreater(read["size_m"][2], 1.9)
        self.assertLess(read["size_m"][2], 3.9)
        self.assertFalse([w for w in read["warnings"] if "unit" in w])

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
        # Options that take several values at once still say so.
        self.assertIn(" ...", run("compare", "--help").stdout)


if __name__ == "__main__":
    unittest.main()
