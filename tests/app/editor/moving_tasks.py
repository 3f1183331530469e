"""Moving objects with the mouse and with keys."""
import math
import time

from task import MUG, SOFA, Task


class Moving(Task):
    def change(self):
        """The edits of the only changed object."""
        changes = self.editor.idle()["edits"].get("changes", [])
        self.assertLessEqual(len(changes), 1)
        return changes[0] if changes else {}

    def offset(self):
        return self.change().get("move", {}).get("offset_m", [0, 0, 0])

    def over_the_viewport(self):
        self.editor.point((self.editor.middle("viewport")[0], 60))

    def start_with(self, object_id):
        state = self.start_room()
        self.show_preview(False)
        self.select_row(object_id)
        return state

    def pull(self, handle, px, look=None):
        x, y = self.editor.middle(handle)
        origin = self.editor.middle("gizmo.free")
        length = math.dist((x, y), origin)
        return self.editor.drag((x, y), (x + px * (x - origin[0]) / length,
                                         y + px * (y - origin[1]) / length), look=look)

    def in_panel(self, name):
        """A widget of the selection's panel, scrolled to where it can be used."""
        _, _, right, bottom = self.editor.item("tab.selection")[:4]
        self.editor.reach(name, (right, bottom + 150))
        return name

    def test_move_an_object_with_the_gizmo(self):
        before = self.start_with(SOFA)
        state = self.pull("gizmo.x", 50)
        self.assertEqual(state["history"], ["Open", "Move sofa"], "one drag, one step of undo")
        moved = self.offset()
        self.assertGreater(moved[0], 0.1)
        self.assertLess(abs(moved[1]) + abs(moved[2]), 1e-9, "along x only")
        state = self.editor.idle()
        self.assertTrue(state["plan_is_current"])

        def place(of):
            return next(one["px"] for one in of["objects"] if one["id"] == SOFA)
        self.assertGreater(math.dist(place(state), place(before)), 15, "the scene follows")
        self.assertEqual(state["selected"], [SOFA], "it stays selected")
        self.assertEqual(state["hidden"], 0)
        self.editor.key("ctrl+z")
        self.assertEqual(self.change(), {})
        self.assertEqual(place(self.editor.idle()), place(before))

    def test_a_click_on_the_handles_selects_what_is_there(self):
        self.start_with(SOFA)
        self.without_layers()
        self.editor.key("F6")  # the sofa's observation point is in its middle, too
        self.wait_picture()
        self.editor.click("gizmo.free")
        state = self.editor.idle()
        self.assertEqual(state["history"], ["Open"], "a click moves nothing")
        self.assertEqual(state["selected"], [SOFA])
        self.select_row(SOFA)  # a click elsewhere, or the next one makes it a double click
        self.editor.click("gizmo.free", keys=("ctrl",))
        self.editor.wait(lambda state: state["selected"] == [], "the sofa to be taken out")

    def test_what_is_hidden_stays_hidden_while_things_move(self):
        self.start_with(MUG)
        self.over_the_viewport()
        self.editor.key("h")
        self.select_row(SOFA)
        self.pull("gizmo.y", 30)
        self.assertEqual(self.editor.idle()["hidden"], 1)

    def test_turn_an_object_and_put_it_back(self):
        self.start_with(SOFA)
        origin, grip = self.editor.middle("gizmo.free"), self.editor.middle("gizmo.yaw")
        angle = math.radians(35)  # against the clock, which from above is positive
        offset = (grip[0] - origin[0], grip[1] - origin[1])
        to = (origin[0] + offset[0] * math.cos(angle) + offset[1] * math.sin(angle),
              origin[1] - offset[0] * math.sin(angle) + offset[1] * math.cos(angle))
        state = self.editor.drag(grip, to)
        self.assertEqual(state["history"], ["Open", "Turn sofa"])
        self.assertNotIn("gizmo.pitch", state["items"], "objects do not tilt")
        self.assertGreater(self.change()["move"]["turn_rad"], 0.2)
        self.assertEqual(self.offset(), [0, 0, 0])
        self.editor.type_value(self.in_panel("selection.move.y"), "0.3")
        self.editor.idle()
        self.over_the_viewport()
        self.editor.key("alt+r")
        self.assertEqual(self.change()["move"]["turn_rad"], 0)
        self.assertEqual(self.offset(), [0, 0.3, 0])
        self.editor.click(self.in_panel("selection.move.reset"))
        self.assertEqual(self.change(), {})

    def give_two_keys(self, last="2"):
        """Moves the sofa from its position at 0 s to 0.4 m along x at the last key."""
        self.start_with(SOFA)
        self.assertNotIn("tracks.slider", self.editor.items())
        self.over_the_viewport()
        self.editor.key("i")
        self.editor.idle()
        self.editor.click("tab.timeline")
        self.editor.type_value("tracks.time", last)
        self.editor.type_value(self.in_panel("selection.move.x"), "0.4")
        state = self.editor.idle()
        self.assertIn("tracks.elsewhere", state["items"], "it is not where its key has it")
        self.editor.click(self.in_panel("selection.add_key"))
        self.assertEqual([key["time_s"] for key in self.change()["track"]], [0, float(last)])
        self.assertNotIn("tracks.elsewhere", self.editor.state()["items"])

    def test_give_an_object_keys_and_go_to_times(self):
        self.give_two_keys()
        self.editor.type_value("tracks.time", "0.5")
        self.assertAlmostEqual(self.offset()[0], 0.1, 9)
        self.editor.click(self.in_panel("selection.key.1"))
        self.assertAlmostEqual(self.offset()[0], 0.4, 9)
        self.assertEqual(self.editor.idle()["track_time"], 2)
        self.editor.key("ctrl+z")
        self.assertAlmostEqual(self.editor.idle()["track_time"], 0.5, 6)
        left, top, right, bottom = self.editor.item("tracks.slider")[:4]
        self.editor.drag((left + 60, (top + bottom) / 2), (right - 2, (top + bottom) / 2))
        state = self.editor.idle()
        self.assertGreater(state["track_time"], 4)
        self.assertAlmostEqual(self.offset()[0], 0.4, 9)
        self.editor.click(self.in_panel("selection.remove_track"))
        self.assertNotIn("track", self.change())
        self.assertNotIn("tracks.slider", self.editor.idle()["items"])

    def test_let_things_move(self):
        self.give_two_keys(last="6")
        self.editor.type_value("tracks.time", "0")
        steps = len(self.editor.idle()["history"])
        self.editor.click("tracks.play")
        times = set()

        def at_the_end(state):
            times.add(state["track_time"])
            return not state["tracks_play"]
        state = self.editor.wait(at_the_end, "the end", 30)
        self.assertEqual(state["track_time"], 6)
        self.assertGreater(len(times), 2, "it moves step by step")
        self.assertEqual(len(self.editor.idle()["history"]), steps + 1, "one step of undo")
        self.over_the_viewport()
        self.editor.key("alt+i")
        self.assertEqual([key["time_s"] for key in self.change()["track"]], [0])

    def grab_while_things_move(self, also):
        """Drags the sofa while its track plays, and does something else before the button is
        released."""
        self.editor.type_value("tracks.time", "0")
        self.editor.idle()
        self.editor.click("tracks.play")
        self.editor.wait(lambda state: state["track_time"] > 0.2, "things to move")
        x, y = self.editor.middle("gizmo.y")
        origin = self.editor.middle("gizmo.free")
        self.editor.point((x, y))
        self.editor.press()
        before = self.editor.state()
        for step in range(1, 9):
            self.editor.move(x + step * (x - origin[0]) / 10, y + step * (y - origin[1]) / 10)
            self.editor.state()
            time.sleep(0.1)
        also()
        self.editor.release()
        return before, self.editor.idle()

    def test_what_one_drags_while_things_move_is_one_step(self):
        self.give_two_keys(last="20")
        before, after = self.grab_while_things_move(also=lambda: None)
        self.assertFalse(after["tracks_play"])
        self.assertEqual(after["history"], [*before["history"], "Move sofa"])
        self.assertGreater(abs(self.offset()[1]), 0.05)

    def test_escape_takes_back_all_of_a_drag_while_things_move(self):
        self.give_two_keys(last="20")
        before, after = self.grab_while_things_move(also=lambda: self.editor.key("esc"))
        self.assertEqual(after["history_position"], before["history_position"])
        self.assertEqual(self.offset()[1], 0)
        self.assertEqual(after["selected"], [SOFA])
