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
        state = self.editor.idle()
        self.assertEqual(state["edits"]["motion"]["frames"], given)
        # The path can still be read in other axes.
        self.assertIn("edits.motion.world", state["items"])
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


class CameraKeys(Task):
    """Key frames of the camera path, recorded from the view."""

    def keys(self):
        motion = self.editor.state()["edits"].get("motion") or {}
        return motion.get("keys", [])

    def look(self, dx, dy=0):
        """Turns the view about the eye."""
        left, top, right, bottom = self.editor.item("viewport")[:4]
        middle = ((left + right) / 2, (top + bottom) / 2)
        self.editor.drag(middle, (middle[0] + dx, middle[1] + dy), button="right")

    def record(self, count):
        """Stands at the plan's camera and records keys; between them it looks around."""
        self.start_room()
        self.show_preview(False)
        self.editor.key("0")
        self.editor.key("0")  # the free camera stands where the plan's was
        for i in range(count):
            if i > 0:
                self.look(120)
            self.editor.key("k")
            self.editor.wait(lambda now: len(now.get("camera_keys", [])) == i + 1, "the key")
            state = self.editor.idle()
            # The playhead stands at the new key, so that the next one follows it.
            self.assertEqual(state["frame"], state["plan"]["frames"] - 1)
        return self.editor.idle()

    def test_keys_are_recorded_dragged_and_removed(self):
        state = self.record(3)
        before = self.keys()
        self.assertEqual(len(before), 3)
        self.assertEqual(before[0][0], 0.0)
        self.assertEqual(state["plan"]["moves_in_collision"], 0)
        for key in state["camera_keys"]:
            self.assertEqual(key["note"], "")
            self.assertAlmostEqual(key["time_s"], key["reached_s"], places=6)
        steps = len(state["history"])
        # Halfway towards the last key.
        self.editor.click("tab.timeline")
        marker = [self.editor.item(f"timeline.camera_key.{i}") for i in (1, 2)]
        x = [(left + right) / 2 for left, _, right, *_ in marker]
        y = (marker[0][1] + marker[0][3]) / 2
        self.editor.drag((x[0], y), (x[0] + 0.5 * (x[1] - x[0]), y))
        self.editor.wait(lambda now: now["edits"]["motion"]["keys"] != before, "the new time")
        state = self.editor.idle()
        dragged = self.keys()
        self.assertAlmostEqual(dragged[1][0], 0.5 * (before[1][0] + before[2][0]), delta=0.11)
        self.assertEqual(dragged[1][1:], before[1][1:])
        self.assertEqual(len(state["history"]), steps + 1)
        self.editor.key("ctrl+z")
        self.editor.idle()
        self.assertEqual(self.keys(), before)
        self.editor.click("timeline.camera_key.1")
        self.editor.key("del")
        self.editor.idle()
        self.assertEqual([key[0] for key in self.keys()], [before[0][0], before[2][0]])
        for _ in range(2):
            self.editor.click("timeline.camera_key.0")
            self.editor.key("del")
            state = self.editor.idle()
        self.assertNotIn("motion", state["edits"])
        self.assertGreater(state["plan"]["key_frames"], 0)

    def test_a_selected_key_is_replaced_and_gone_to(self):
        self.record(2)
        before = self.keys()
        self.editor.click("timeline.camera_key.0")
        self.look(-90)
        self.editor.key("k")
        self.editor.wait(lambda now: now["edits"]["motion"]["keys"] != before, "the other view")
        self.editor.idle()
        now = self.keys()
        self.assertEqual(now[1], before[1])
        self.assertEqual(now[0][0], before[0][0])
        self.assertNotEqual(now[0][4:], before[0][4:])
        self.look(200)
        away = self.editor.state()["camera"]
        self.editor.key("enter")
        back = self.editor.state()["camera"]
        self.assertNotAlmostEqual(away["azimuth"], back["azimuth"], places=2)
        # The view looks from the key's position.
        eye = [p + back["distance"] * b for p, b in zip(back["pivot"], (
            math.cos(back["elevation"]) * math.cos(back["azimuth"]),
            math.cos(back["elevation"]) * math.sin(back["azimuth"]), math.sin(back["elevation"])))]
        for a, b in zip(eye, now[0][1:4]):
            self.assertAlmostEqual(a, b, places=3)

    def test_keys_too_close_in_time_get_reachable_times(self):
        self.record(2)
        self.editor.click("tab.by hand")
        self.editor.type_value("edits.motion.key.1.time", "0.3")
        state = self.editor.idle()
        late = state["camera_keys"][1]
        self.assertGreater(late["reached_s"], 0.4)
        self.assertIn("Key 2 is reached at", late["note"])
        self.editor.reach("edits.motion.fit_keys", "edits.boxes")
        self.editor.click("edits.motion.fit_keys")
        self.editor.wait(lambda now: now["camera_keys"][1]["note"] == "", "the reachable time")
        self.assertAlmostEqual(self.keys()[1][0], late["reached_s"], places=6)
