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
        # The red count leads to the collision, and so do the keys.
        self.editor.key("ctrl+end")
        self.editor.reach("edits.motion.collisions", "edits.boxes")
        first = self.editor.click("edits.motion.collisions")["frame"]
        self.assertLessEqual(given[first][1], 1.0)
        self.editor.key("ctrl+end")
        self.assertEqual(self.editor.key("ctrl+left")["frame"], first)
        self.editor.key("ctrl+end")
        self.assertEqual(self.editor.key("ctrl+right")["frame"], first, "the first follows")
        # The timeline shows it in red, and the export form warns of it.
        self.assertIn("timeline.collision.0", self.editor.click("tab.timeline")["items"])
        self.assertIn("export.doubt", self.editor.click("tab.export")["items"])
        self.editor.click("tab.timeline")
        self.editor.reach("edits.motion.repair", "edits.boxes")
        self.editor.click("edits.motion.repair")
        self.editor.wait(lambda now: now["edits"]["motion"]["frames"] != given, "the repair")
        state = self.editor.idle()
        self.assertEqual(state["plan"]["moves_in_collision"], 0)
        repaired = state["edits"]["motion"]["frames"]
        self.assertEqual(repaired[-1][1:8], given[-1][1:8])
        saved = self.folder / "repaired.txt"
        self.editor.run_command("save the camera path")
        self.editor.choose_file(saved)
        self.editor.wait(lambda now: saved.exists(), "the saved path")
        lines = [line.split() for line in saved.read_text().splitlines()[1:]]
        self.assertEqual(len(lines), len(repaired))
        for line, frame in zip(lines, repaired):
            for text, number in zip(line, frame):
                self.assertAlmostEqual(float(text), number, delta=1e-6)
        for frame in repaired:
            self.assertGreater(distance_from_the_sofa(frame[1:4]), 0.1)
        self.editor.reach("edits.motion.compare", "edits.boxes")
        state = self.editor.click("edits.motion.compare")
        self.assertEqual(state["comparison"]["kept"],
                         {"name": "Before the repair", "frames": FRAMES})
        self.editor.item("comparison.capture_rate")
        self.editor.click("comparison.drop")
        self.editor.click("tab.by hand")
        self.editor.key("ctrl+z")
        state = self.editor.idle()
        self.assertEqual(state["edits"]["motion"]["frames"], given)
        # The path can still be read in other axes.
        self.assertIn("edits.motion.world", state["items"])
        self.editor.click("edits.motion.clear")
        state = self.editor.idle()
        self.assertNotIn("motion", state["edits"])
        self.assertEqual(state["plan"]["frames"], before["plan"]["frames"])

    def test_parts_of_a_path_are_removed(self):
        _, state = self.import_path()
        given = state["edits"]["motion"]["frames"]
        self.editor.key("ctrl+home")
        for _ in range(5):
            self.editor.key("right")
        self.editor.run_command("remove the camera path before this frame")
        state = self.editor.idle()
        self.assertEqual(state["frame"], 0)
        kept = state["edits"]["motion"]["frames"]
        self.assertEqual([frame[1:8] for frame in kept], [frame[1:8] for frame in given[5:]])
        self.assertEqual(kept[0][0], 0.0)
        self.editor.run_command("remove the camera path after this frame")
        state = self.editor.idle()
        self.assertEqual([frame[1:8] for frame in state["edits"]["motion"]["frames"]],
                         [given[5][1:8]])
        self.editor.key("ctrl+z")
        self.editor.key("ctrl+z")
        self.assertEqual(self.editor.idle()["edits"]["motion"]["frames"], given)

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
        self.make_move("orbit")
        self.dismiss("cancel")
        self.assertEqual(self.editor.idle()["edits"]["motion"]["frames"], turned)
        self.make_move("orbit")
        self.dismiss("replace")
        self.editor.wait(lambda now: now["edits"]["motion"]["frames"] != turned, "the orbit")
        self.assertNotIn("edits.motion.world", self.editor.idle()["items"])

    def make_move(self, kind):
        self.editor.click("tab.by hand")
        self.editor.reach("edits.motion." + kind, "edits.boxes")
        self.editor.click("edits.motion." + kind)
        self.editor.reach("edits.move.make", "edits.boxes")
        self.editor.click("edits.move.make")

    def eyes(self):
        return [frame[1:4] for frame in self.editor.state()["edits"]["motion"]["frames"]]

    def test_an_orbit_of_the_selected_object(self):
        self.start_room()
        self.select_row(SOFA)
        self.make_move("orbit")
        self.editor.wait(lambda now: now["edits"].get("motion"), "the orbit")
        state = self.editor.idle()
        self.assertGreater(state["plan"]["frames"], 10)
        self.assertEqual(state["plan"]["moves_in_collision"], 0)

    def test_a_move_is_shown_before_it_is_made_and_dragged(self):
        self.start_room()
        self.show_preview(False)
        self.select_row(SOFA)
        self.editor.run_command("camera move: arc")
        state = self.editor.wait(lambda now: "move.radius" in now["items"], "the handles")
        self.assertEqual(state["edits"].get("motion"), None, "nothing is made yet")
        self.assertEqual(state["move"], "arc")
        before = state["move_path"]
        self.assertGreater(len(before), 10)
        x, y = self.editor.middle("move.radius")
        cx, cy = next(one["px"] for one in state["objects"] if one["id"] == SOFA)
        toward = (round(x + 0.3 * (cx - x)), round(y + 0.3 * (cy - y)))
        self.editor.drag((x, y), toward)
        state = self.editor.wait(lambda now: now["move_path"] not in ([], before), "a new path")
        self.assertRegex(state["move"], r"^arc:radius=\d")
        # Escape takes back a drag.
        given = state["move"]
        x, y = self.editor.middle("move.radius")
        seen = []

        def escape(state):
            seen.append(state["move"])
            if len(seen) == 4:
                self.editor.key("esc")
        self.editor.drag((x, y), (x + 60, y), look=escape)
        self.assertNotEqual(seen[3], given)
        self.assertEqual(self.editor.state()["move"], given)
        self.assertEqual(self.editor.state()["selected"], [SOFA])
        self.editor.reach("edits.move.make", "edits.boxes")
        self.editor.click("edits.move.make")
        state = self.editor.wait(lambda now: now["edits"].get("motion"), "the arc")
        self.assertEqual(state["edits"]["motion"]["name"], given)

    def test_moves_without_an_object(self):
        self.start_room()
        for kind in ("orbit", "walk", "crane"):
            before = self.editor.state()["edits"].get("motion")
            self.make_move(kind)
            self.editor.wait(lambda now: now["edits"].get("motion") != before, kind)
            state = self.editor.idle()
            self.assertGreater(state["plan"]["frames"], 10, kind)
            self.assertEqual(state["plan"]["moves_in_collision"], 0, kind)

    def test_the_settings_of_a_move(self):
        self.start_room()
        self.select_row(SOFA)
        self.make_move("orbit")
        self.editor.wait(lambda now: now["edits"].get("motion"), "the orbit")
        self.editor.idle()
        first = self.eyes()
        self.editor.reach("edits.move.height.set", "edits.boxes")
        self.editor.click("edits.move.height.set")
        self.editor.type_value("edits.move.height", "1.4")
        self.editor.reach("edits.move.make", "edits.boxes")
        self.editor.click("edits.move.make")
        self.editor.wait(lambda now: now["edits"]["motion"]["name"] == "orbit:height=1.4",
                         "the higher orbit")
        self.editor.idle()
        self.assertNotEqual(self.eyes(), first)
        for x, y, z in self.eyes():
            self.assertAlmostEqual(z, 1.4, delta=0.11)
        # Errors name the widget.
        self.editor.click("edits.motion.walk")
        self.editor.reach("edits.move.from.set", "edits.boxes")
        self.editor.click("edits.move.from.set")
        self.editor.reach("edits.move.make", "edits.boxes")
        self.editor.click("edits.move.make")
        self.assertIn("From, To: A move between two points needs both.", self.notice())
        self.dismiss("ok")

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
        """Looks through the plan's camera and records keys; between them it looks around."""
        self.start_room()
        self.show_preview(False)
        self.editor.key("0")
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
        self.editor.key("shift+k")
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

    def test_a_key_is_added_after_the_selected_one(self):
        self.record(2)
        before = self.keys()
        self.editor.click("tab.by hand")
        self.editor.click("edits.motion.key.0.select")
        self.look(-90)
        self.editor.click("edits.motion.add_key")
        state = self.editor.wait(lambda now: len(now["edits"]["motion"]["keys"]) == 3, "the key")
        # The next one follows it, also before the plan is ready.
        self.look(-90)
        self.editor.key("k")
        self.editor.wait(lambda now: len(now["edits"]["motion"]["keys"]) == 4, "the key")
        state = self.editor.idle()
        now = self.keys()
        self.assertEqual([now[0], now[3]], before)
        self.assertLess(now[0][0], now[1][0])
        self.assertLess(now[1][0], now[2][0])
        self.assertEqual(sorted(key[0] for key in now), [key[0] for key in now])
        self.assertNotEqual(now[1][4:], now[2][4:])
        self.editor.key("ctrl+z")
        self.editor.key("ctrl+z")
        self.editor.idle()
        self.assertEqual(self.keys(), before)

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

    def test_a_move_follows_the_keys_or_replaces_them(self):
        self.record(2)
        before = self.keys()
        self.editor.click("tab.by hand")

        def make():
            self.editor.reach("edits.motion.walk", "edits.boxes")
            self.editor.click("edits.motion.walk")
            self.editor.reach("edits.move.make", "edits.boxes")
            self.editor.click("edits.move.make")
            self.editor.item("message.append")
        make()
        self.dismiss("cancel")
        self.assertEqual(self.keys(), before)
        make()
        self.dismiss("append")
        self.editor.wait(lambda now: len(now["edits"]["motion"]["keys"]) > 4, "further keys")
        state = self.editor.idle()
        longer = self.keys()
        self.assertEqual(longer[:2], before)
        self.assertEqual([key[0] for key in longer], sorted(key[0] for key in longer))
        for key in state["camera_keys"]:
            self.assertNotIn("reached at", key["note"])
        self.editor.key("ctrl+z")
        self.editor.idle()
        self.assertEqual(self.keys(), before)
        make()
        self.dismiss("replace")
        self.editor.wait(lambda now: now["edits"]["motion"].get("frames"), "the walk")
        self.editor.idle()
        self.editor.key("ctrl+z")
        self.editor.idle()
        self.assertEqual(self.keys(), before)

    def test_a_key_where_no_camera_can_be_is_named_and_moved(self):
        self.start_room()
        self.show_preview(False)
        self.editor.key("home")  # from outside, through cut-away walls
        self.editor.key("k")
        state = self.editor.wait(lambda now: "key_blocked" in now["items"], "the warning", 10)
        self.assertIn("outside the rooms", state["camera_keys"][0]["note"])
        self.editor.idle()
        self.editor.click("tab.by hand")
        self.editor.item("edits.motion.key.0.free")
        outside = self.keys()[0]
        self.editor.click("key_blocked.2")
        self.editor.wait(lambda now: now["edits"]["motion"]["keys"][0] != outside, "another place")
        state = self.editor.idle()
        self.assertEqual(state["camera_keys"][0]["note"], "")
        self.assertEqual(self.keys()[0][4:], outside[4:], "the direction stays")
        self.assertNotIn("key_blocked", state["items"])
        self.editor.key("ctrl+z")
        self.editor.idle()
        self.assertEqual(self.keys()[0], outside)

    def test_keys_over_the_viewport_press_no_button_of_a_panel(self):
        self.record(2)
        before = self.keys()
        self.editor.click("tab.by hand")
        self.editor.click("edits.motion.key.0.go_to")
        away = self.editor.state()["camera"]
        self.editor.point("viewport")
        # To the right of the clicked button is the one that removes the key.
        for key in ("right", "home", "alt+a"):
            state = self.editor.key(key)
            if key == "home":
                self.assertNotEqual(state["camera"], away, "it shows everything")
            self.assertTrue(self.editor.key("space")["playing"], key)
            self.assertFalse(self.editor.key("space")["playing"], key)
            self.editor.idle()
            self.assertEqual(self.keys(), before, key)
        self.assertFalse(self.editor.state()["playing"])

    def test_tab_moves_between_the_widgets_until_the_mouse_is_used(self):
        self.record(2)
        before = self.keys()
        self.editor.click("tab.by hand")
        self.editor.click("edits.motion.key.0.select")
        self.editor.key("tab")
        self.editor.key("esc")
        # Escape gives the keyboard back: the keys are shortcuts again.
        self.assertTrue(self.editor.key("space")["playing"])
        self.assertFalse(self.editor.key("space")["playing"])
        frame = self.editor.state()["frame"]
        with self.editor.held("ctrl"):
            self.editor.key("tab")
        self.editor.key("down")
        self.editor.key("space")
        state = self.editor.key("right")
        self.assertEqual((state["frame"], state["playing"]), (frame, False))
        left, top = self.editor.item("viewport")[:2]
        self.editor.point((left + 40, top + 40))
        self.editor.point((left + 60, top + 60))
        self.assertTrue(self.editor.key("space")["playing"])
        self.editor.key("space")
        self.editor.idle()
        self.assertEqual(self.keys(), before)
