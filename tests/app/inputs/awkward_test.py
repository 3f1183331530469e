#!/usr/bin/python3
"""Scenes with the flaws of real files, planned from end to end: awkward_test.py PROGRAM."""
import json
import math
import unittest

from support.program import FolderCase, run

ROOM = (5.0, 4.0, 2.6)
THINGS = [("sofa", (0.2, 3.0, 0.0), (2.2, 3.8, 0.8)), ("chair", (1.2, 1.6, 0.0), (1.65, 2.05, 0.9)),
          ("lamp", (4.4, 0.3, 0.0), (4.7, 0.6, 1.5)),
          ("coffee_table", (2.0, 1.5, 0.0), (3.2, 2.3, 0.45))]


class Obj:
    """Metres, z up."""

    def __init__(self):
        self.lines = []
        self.count = 0

    def object(self, name):
        self.lines.append(f"o {name}")
        return self

    def face(self, *corners):
        self.lines += ["v {:.9g} {:.9g} {:.9g}".format(*p) for p in corners]
        numbers = range(self.count + 1, self.count + 1 + len(corners))
        self.lines.append("f " + " ".join(map(str, numbers)))
        self.count += len(corners)
        return self

    def box(self, low, high):
        c = [(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1])
             for z in (low[2], high[2])]
        for face in [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4),
                     (1, 5, 7, 3)]:
            self.face(*(c[i] for i in face))
        return self

    def furnished(self, named=True):
        length, width, height = ROOM
        c = [(x, y, z) for x in (0, length) for y in (0, width) for z in (0, height)]
        for name, face in [("floor", (0, 4, 6, 2)), ("ceiling", (1, 3, 7, 5)),
                           ("wall_1", (0, 1, 5, 4)), ("wall_2", (4, 5, 7, 6)),
                           ("wall_3", (6, 7, 3, 2)), ("wall_4", (2, 3, 1, 0))]:
            if named:
                self.object(name)
            self.face(*(c[i] for i in face))
        for name, low, high in THINGS:
            if named:
                self.object(name)
            self.box(low, high)
        return self

    def text(self):
        return "\n".join(self.lines) + "\n"


def turned(text):
    """The scene with every face turned over."""
    lines = [line if not line.startswith("f ") else
             "f " + " ".join(reversed(line.split()[1:])) for line in text.splitlines()]
    return "\n".join(lines) + "\n"


def scaled(text, scale):
    lines = [line if not line.startswith("v ") else
             "v " + " ".join(f"{float(x) * scale:.9g}" for x in line.split()[1:])
             for line in text.splitlines()]
    return "\n".join(lines) + "\n"


def dome(obj, radius):
    """A hemisphere around and above the room."""
    def at(ring, step):
        polar = math.pi * ring / 16
        around = 2 * math.pi * step / 24
        return (radius * math.sin(polar) * math.cos(around) + 2.5,
                radius * math.sin(polar) * math.sin(around) + 2, radius * math.cos(polar) - 1)
    for ring in range(8):
        for step in range(24):
            corners = [at(ring, step), at(ring + 1, step), at(ring + 1, step + 1)]
            if ring > 0:
                corners.append(at(ring, step + 1))
            obj.face(*corners)


# Room views are chosen by samples of the triangles, so rounding and vertex order change them.
CLOSE_VIEWS = ("--set", "view_mix=0")


class Awkward(FolderCase):
    def plan(self, text, *arguments, planning=()):
        """Returns the output of 'info' and 'plan', and the project."""
        name = self.id().split(".")[-1]
        scene = self.folder / f"{name}.obj"
        project = self.folder / f"{name}.dolly"
        scene.write_text(text)
        info = run("info", scene, "--json", *arguments)
        self.assertEqual(info.returncode, 0, info.stderr)
        planned = run("plan", scene, "-o", project, "--json", "--max-frames", "100", *arguments,
                      *planning)
        self.assertEqual(planned.returncode, 0, planned.stderr)
        return json.loads(info.stdout), json.loads(planned.stdout), json.loads(project.read_text())

    def assertAllSeen(self, plan, objects):
        self.assertEqual(plan["objects"], objects)
        self.assertEqual(plan["well_captured"], objects, plan["not_well_captured"])
        self.assertEqual(plan["frame_collision_rate"], 0)

    def positions(self, project):
        return [frame["position"] for frame in project["result"]["trajectory"]["frames"]]

    def test_units_give_one_plan(self):
        expected = self.positions(
            self.plan(Obj().furnished().text(), planning=CLOSE_VIEWS)[2])
        for units_per_metre in (100, 1000, 1 / 0.0254):
            text = scaled(Obj().furnished().text(), units_per_metre)
            self.assertAllSeen(self.plan(text)[1], len(THINGS))
            info, plan, project = self.plan(text, planning=CLOSE_VIEWS)
            self.assertAlmostEqual(info["unit_m"] * units_per_metre, 1, places=9)
            self.assertAllSeen(plan, len(THINGS))
            for frame, other in zip(self.positions(project), expected, strict=True):
                self.assertLess(math.dist(frame, other), 0.02)

    def test_a_scene_made_to_be_of_size_one_is_doubted_and_planned_as_told(self):
        text = scaled(Obj().furnished().text(), 0.2)
        self.assertTrue(any("unit is doubtful" in one for one in self.plan(text)[0]["warnings"]))
        info, plan, _ = self.plan(text, "--unit", "5")
        self.assertFalse(any("unit is doubtful" in one for one in info["warnings"]))
        self.assertAllSeen(plan, len(THINGS))

    def test_everything_inside_out_is_planned_the_same(self):
        text = Obj().furnished().text()
        _, _, project = self.plan(text, planning=CLOSE_VIEWS)
        info, plan, other = self.plan(turned(text), planning=CLOSE_VIEWS)
        self.assertAllSeen(plan, len(THINGS))
        self.assertEqual(self.positions(other), self.positions(project))
        self.assertTrue(any("point inwards" in note for note in info["notes"]))
        self.assertAllSeen(self.plan(turned(text))[1], len(THINGS))

    def test_one_mesh_is_taken_apart(self):
        info, plan, _ = self.plan(Obj().object("everything").furnished(named=False).text())
        self.assertAllSeen(plan, len(THINGS))
        self.assertTrue(any("separate its objects" in warning for warning in info["warnings"]))

    def test_a_dome_of_200_m_is_around_the_room(self):
        obj = Obj().furnished().object("dome")
        dome(obj, 100.0)
        info, plan, project = self.plan(obj.text())
        self.assertAllSeen(plan, len(THINGS))
        self.assertTrue(any('"dome" is outside or around' in note for note in info["notes"]))
        for position in self.positions(project):
            for x, size in zip(position, ROOM):
                self.assertTrue(0 < x < size, position)

    def test_a_hall_of_30_m_is_planned_in_metres(self):
        obj = Obj()
        for name, low, high in [("floor", (0, 0, -0.1), (30, 20, 0)),
                                ("ceiling", (0, 0, 8), (30, 20, 8.1)),
                                ("wall_1", (-0.1, 0, 0), (0, 20, 8)),
                                ("wall_2", (30, 0, 0), (30.1, 20, 8)),
                                ("wall_3", (0, -0.1, 0), (30, 0, 8)),
                                ("wall_4", (0, 20, 0), (30, 20.1, 8))]:
            obj.object(name).box(low, high)
        for i in range(6):
            x, y = 5 + 9 * (i % 3), 5 + 8 * (i // 3)
            obj.object(f"crate_{i}").box((x, y, 0), (x + 1, y + 1, 1))
        info, plan, _ = self.plan(obj.text())
        self.assertEqual(info["unit_m"], 1)
        self.assertTrue(any("hall in metres" in warning for warning in info["warnings"]))
        self.assertAllSeen(plan, 6)

    def test_storeys_joined_by_stairs_are_one_flight(self):
        obj = Obj()
        for name, low, high in [("floor_ground", (0, 0, -0.1), (8, 6, 0)),
                                ("ceiling", (0, 0, 5.45), (8, 6, 5.55)),
                                ("wall_1", (0, -0.1, 0), (8, 0, 5.45)),
                                ("wall_2", (0, 6, 0), (8, 6.1, 5.45)),
                                ("wall_3", (-0.1, 0, 0), (0, 6, 5.45)),
                                ("wall_4", (8, 0, 0), (8.1, 6, 5.45))]:
            obj.object(name).box(low, high)
        obj.object("floor_upper").box((0, 1.2, 2.6), (8, 6, 2.85))  # open above the stairs
        obj.box((0, 0, 2.6), (1, 1.2, 2.85)).box((5.4, 0, 2.6), (8, 1.2, 2.85))
        obj.object("stairs")
        for i in range(15):
            obj.box((1.2 + 4 / 15 * i, 0.05, 0), (1.2 + 4 / 15 * (i + 1), 1.15, 0.19 * (i + 1)))
        for where, z in (("down", 0), ("up", 2.85)):
            obj.object(f"sofa_{where}").box((5.5, 4.8, z), (7.5, 5.6, z + 0.8))
            obj.object(f"table_{where}").box((2, 3.2, z), (3.2, 4, z + 0.75))
            obj.object(f"lamp_{where}").box((0.3, 5.3, z), (0.6, 5.6, z + 1.5))
            obj.object(f"chair_{where}").box((6.8, 2.2, z), (7.25, 2.65, z + 0.9))
        info, plan, project = self.plan(obj.text())
        self.assertTrue(any("2 storeys, with floors at 0.00, 2.85 m" in n for n in info["notes"]))
        self.assertAllSeen(plan, 8)
        self.assertEqual(len(project["result"]["paths"]), 1)
        inside = [p for p in self.positions(project) if 2.6 <= p[2] <= 2.85]
        self.assertTrue(all(1 < p[0] < 5.4 and p[1] < 1.2 for p in inside))
        # Each object is viewed from its own storey.
        frames = self.positions(project)
        for entry in plan["ledger"]:
            self.assertEqual(frames[entry["frame"]][2] > 2.85, entry["object"].endswith("_up"),
                             entry)


if __name__ == "__main__":
    unittest.main()
