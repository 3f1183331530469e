"""Camera paths that are given: imported, repaired, made from a template, and planned again."""
import math

from task import SOFA, Task

FRAMES = 30


def write_path_through_the_sofa(path):
    """TUM's format, z up: straight through the sofa into the room, looking ahead (along x)."""
    with open(path, "w") as file:
        for i in range(FRAMES):
            x = 0.3 + 2.2 * i / (FRAMES - 1)
            file.write(f"{0.1 * i:.1f} {x:.6f} -1.5 0.5 -0.5 0.5 -0.5 0.5\n")


def distance_from_the_sofa(point):
    """0 inside its box."""
    low, high = (0.1, -2.4, 0.0), (0.9, -0.6, 0.7)
    return math.dist(point, [min(max(x, a), b) for x, a, b in zip(point, low, high)])


class Motions(Task):
    def import_path(self):
        before = self.start_room()
        path = self.folder / "sofa.txt"
        write_path_through_the_sofa(path)
        self.editor.run_command("import a camera path")
        self.editor.choose_file(path)
        self.editor.wait(lambda now: now["edits"].get("motion"), "the path")
        return before, self.editor.idle()

    def test_import_repair_and_plan_again(self):
        before, state = self.import_path()
        self.assertEqual(state["plan"]["frames"], FRAMES)
        self.assertEqual(state["edits"]["motion"]["name"], "sofa.txt")
        given = state["edits"]["motion"]["frames"]
        # The sofa ends at x = 0.9 m; the camera is a sphere of 0.1 m.
        inside = [frame for frame in given if frame[1] < 1.0]
        self.assertGreaterEqual(state["plan"]["moves_in_collision"], len(inside))
        self.editor.reach("edits.motion.repair", "edits.boxes")
        self.editor.click("edits.motion.repair")
        self.editor.wait(lambda now: now["edits"]["motion"]["frames"] != given, "the repair")
        state = self.editor.idle()
        self.assertEqual(state["plan"]["moves_in_collision"], 0)
        repaired = state["edits"]["motion"]["frames"]
        self.assertEqual(repaired[-1][1:8], given[-1][1:8])
        for frame in repaired:
            self.assertGreater(distance_from_the_sofa(frame[1:4]), 0.1)
        self.editor.key("ctrl+z")
        self.assertEqual(self.editor.idle()["edits"]["motion"]["frames"], given)
        self.editor.click("edits.motion.clear")
        state = self.editor.idle()
        self.assertNotIn("motion", state["edits"])
        self.assertEqual(state["plan"]["frames"], before["plan"]["frames"])

    def test_other_axes_are_read_again(self):
        _, state = self.import_path()
        given = state["edits"]["motion"]["frames"]
        self.editor.reach("edits.motion.world", "edits.boxes")
        self.editor.click("edits.motion.world")
        self.editor.click("edits.motion.world.2")
        self.editor.wait(lambda now: now["edits"]["motion"]["frames"] != given, "the other axes")
        turned = self.editor.idle()["edits"]["motion"]["frames"]
        # y up: the second coordinate of the file is the height.
        self.assertAlmostEqual(turned[0][3], -1.5, places=6)
        self.select_row(SOFA)
        self.editor.click("tab.by hand")
        self.editor.click("edits.motion.orbit")
        self.editor.wait(lambda now: now["edits"]["motion"]["frames"] != turned, "the orbit")
        self.assertNotIn("edits.motion.world", self.editor.idle()["items"])

    def test_an_orbit_of_the_selected_object(self):
        self.start_room()
        self.editor.click("tab.by hand")
        self.assertFalse(self.editor.item("edits.motion.orbit")[4])
        self.select_row(SOFA)
        self.editor.click("tab.by hand")
        self.editor.click("edits.motion.orbit")
        self.editor.wait(lambda now: now["edits"].get("motion"), "the orbit")
        state = self.editor.idle()
        self.assertGreater(state["plan"]["frames"], 10)
        self.assertEqual(state["plan"]["moves_in_collision"], 0)

    def test_a_file_that_is_no_path_is_refused(self):
        before = self.start_room()
        path = self.folder / "note.txt"
        path.write_text("no numbers here\n")
        self.editor.run_command("import a camera path")
        self.editor.choose_file(path)
        self.assertIn("note.txt", self.notice())
        self.dismiss("ok")
        self.assertEqual(self.editor.idle()["plan"]["frames"], before["plan"]["frames"])

    def test_repair_does_not_wait_for_the_plan(self):
        self.start_room()
        path = self.folder / "sofa.txt"
        write_path_through_the_sofa(path)
        self.editor.run_command("import a camera path")
        self.editor.choose_file(path)
        self.editor.wait(lambda now: now["edits"].get("motion"), "the path")
        self.editor.run_command("repair the camera path")
        self.editor.wait(lambda now: len(now["edits"]["motion"]["frames"]) != FRAMES, "the repair")
        self.assertEqual(self.editor.idle()["plan"]["moves_in_collision"], 0)
