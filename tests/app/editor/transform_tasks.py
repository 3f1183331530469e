"""Moving and rotating the selection with keys, as in Blender: G, R, axes and typed numbers."""
import math

from task import MUG, POSITION_POINT, SOFA, TABLE, Task


class Transforms(Task):
    def over_the_viewport(self):
        self.editor.point((self.editor.middle("viewport")[0], 60))

    def with_the_sofa(self):
        self.start_room()
        self.show_preview(False)
        self.select_row(SOFA)
        self.over_the_viewport()

    def press(self, *keys):
        for key in keys:
            state = self.editor.key(key)
        return state

    def move(self):
        """The offset and rotation of the only changed object."""
        changes = self.editor.idle()["edits"].get("changes", [])
        self.assertLessEqual(len(changes), 1)
        return changes[0]["move"] if changes else {"offset_m": [0, 0, 0], "turn_rad": 0}

    def assertOffset(self, expected):
        self.assertLess(math.dist(self.move()["offset_m"], expected), 1e-9)

    def test_type_a_move(self):
        self.with_the_sofa()
        state = self.press("g", "x")
        self.assertTrue(state["drag_text"].startswith("Move along x: "), state["drag_text"])
        state = self.editor.type("0.5")
        self.assertEqual(state["drag_text"], "Move along x: 0.5 m")
        self.assertIn("status.drag", state["items"])
        state = self.press("enter")
        self.assertEqual(state["drag_text"], "")
        self.assertOffset([0.5, 0, 0])
        state = self.editor.idle()
        self.assertEqual(state["history"], ["Open", "Move sofa"], "one step of undo")
        self.assertEqual(state["selected"], [SOFA], "Enter pressed no other widget")
        self.press("ctrl+z")
        self.assertOffset([0, 0, 0])

    def test_lock_an_axis_and_type_a_move_in_the_plane(self):
        self.with_the_sofa()
        state = self.press("g", "shift+z")
        self.assertTrue(state["drag_text"].startswith("Move in the xy plane: "), state["drag_text"])
        self.editor.type("0.5")
        self.press("tab")
        state = self.editor.type("0.2")
        self.assertEqual(state["drag_text"], "Move in the xy plane: 0.5, 0.2 m")
        self.press("enter")
        self.assertOffset([0.5, 0.2, 0])
        self.assertEqual(self.editor.state()["selected"], [SOFA], "Tab and Enter reach no widget")
        self.over_the_viewport()
        self.press("g", "shift+z")
        x, y = self.editor.mouse
        self.editor.move(x + 60, y + 30)
        self.editor.state()
        self.press("enter")
        moved = self.move()["offset_m"]
        self.assertGreater(math.dist(moved[:2], (0.5, 0.2)), 0.1)
        self.assertEqual(moved[2], 0)

    def test_the_object_itself_moves_while_it_is_moved(self):
        self.with_the_sofa()
        self.press("7")
        self.wait_picture()
        before = self.patch_of_the_sofa()
        self.press("g", "x")
        self.editor.type("5")
        self.editor.wait(lambda now: not now["busy"]["drawing"], "the picture")
        differ = sum(a != b for a, b in zip(self.patch_of_the_sofa(), before))
        self.assertGreater(differ, 0.8 * len(before), "the floor is seen instead of the sofa")
        self.press("esc")
        self.editor.wait(lambda now: self.patch_of_the_sofa() == before, "the sofa again", 20)

    def patch_of_the_sofa(self):
        """The pixels of a part of the sofa in the view from above, beside its handles."""
        width, _, rgb = self.editor.picture()
        x, y = self.place_of((0.25, -2.3, 0.7))
        return [rgb[3 * (width * v + u):3 * (width * v + u) + 3]
                for v in range(y - 5, y + 5) for u in range(x - 5, x + 5)]

    def test_correct_the_number_and_the_axis(self):
        self.with_the_sofa()
        self.press("g", "z")
        self.editor.type("12")
        self.press("backspace")
        self.editor.type(".25")
        state = self.press("-", "y")
        self.assertEqual(state["drag_text"], "Move along y: -1.25 m")
        self.press("-", "enter")
        self.assertOffset([0, 1.25, 0])
        self.assertFalse(self.editor.state()["edits"].get("excluded"), "X is not a shortcut here")

    def test_own_axes_follow_the_rotation(self):
        self.with_the_sofa()
        self.press("r")
        self.editor.type("30")
        state = self.editor.state()
        self.assertEqual(state["drag_text"], "Rotate about z: 30\u00b0")
        self.press("enter")
        self.assertAlmostEqual(self.move()["turn_rad"], math.radians(30), 9)
        self.press("g", "x")
        state = self.press("x")
        self.assertTrue(state["drag_text"].startswith("Move along its own x: "))
        self.editor.type("2")
        self.press("enter")
        along = self.move()["offset_m"]
        # The sofa's box in the file is along the axes; which side its own x is, is the box's choice.
        self.assertAlmostEqual(math.hypot(*along), 2, 9)
        self.assertAlmostEqual(math.remainder(math.atan2(along[1], along[0]) - math.radians(30),
                                              math.pi / 2), 0, 6)
        self.assertEqual(self.editor.idle()["history"], ["Open", "Turn sofa", "Move sofa"])

    def test_escape_and_the_right_button_cancel(self):
        self.with_the_sofa()
        for cancel in (lambda: self.press("esc"), lambda: self.editor.click("viewport", "right")):
            self.over_the_viewport()
            self.press("g", "x")
            self.editor.type("0.5")
            self.editor.wait(lambda state: state["history_position"] == 1, "the move")
            cancel()
            self.assertOffset([0, 0, 0])
            state = self.editor.idle()
            self.assertEqual(state["history_position"], 0)
            self.assertEqual(state["selected"], [SOFA])

    def test_a_cancelled_move_leaves_what_was_undone(self):
        self.with_the_sofa()
        self.press("g", "x")
        self.editor.type("0.5")
        self.press("enter")
        self.press("ctrl+z", "g", "y")
        self.editor.type("2")
        self.editor.wait(lambda state: state["history_position"] == 1, "the move")
        self.press("esc")
        self.assertOffset([0, 0, 0])
        self.press("ctrl+shift+z")
        self.assertOffset([0.5, 0, 0])
        self.assertEqual(self.editor.idle()["history"], ["Open", "Move sofa"])

    def test_a_key_that_cannot_act_says_why(self):
        self.with_the_sofa()
        self.press("esc")
        state = self.press("g")
        self.assertIn("status.refused_key", state["items"])
        self.select_row(SOFA)
        self.over_the_viewport()
        state = self.press("g")
        self.assertNotIn("status.refused_key", state["items"])
        self.press("esc")

    def test_the_mouse_moves_along_the_axis_and_a_click_confirms(self):
        self.with_the_sofa()
        x, y = self.editor.middle("gizmo.x")
        origin = self.editor.middle("gizmo.free")
        self.editor.point(origin)
        self.press("g", "x")
        self.editor.move(x, y)
        self.editor.state()
        self.editor.press()
        self.editor.release()
        moved = self.move()["offset_m"]
        self.assertGreater(moved[0], 0.1)
        self.assertLess(abs(moved[1]) + abs(moved[2]), 1e-9)
        state = self.editor.idle()
        self.assertEqual(state["history"], ["Open", "Move sofa"])
        self.assertEqual(state["selected"], [SOFA], "the click selects nothing else")

    def test_the_mouse_turns_around_the_object(self):
        self.with_the_sofa()
        self.press("7")
        self.wait_picture()
        cx, cy = self.editor.middle("gizmo.free")
        self.editor.point((cx + 80, cy))
        self.press("r")
        self.editor.move(cx, cy - 80)  # from above: a quarter turn against the clock
        self.editor.state()
        self.press("enter")
        self.assertAlmostEqual(self.move()["turn_rad"], math.pi / 2, delta=0.05)

    def test_move_and_rotate_several_objects_together(self):
        self.with_the_sofa()
        for other in (TABLE, MUG):
            left, top, _, bottom = self.editor.item(f"objects.row.{other}")[:4]
            self.editor.click((left + 30, (top + bottom) / 2), keys=["ctrl"])
        state = self.editor.wait(lambda state: len(state["selected"]) == 3, "three objects")
        self.over_the_viewport()
        self.press("g", "y")
        self.assertEqual(self.editor.type("-0.3")["drag_text"], "Move along y: -0.3 m")
        self.press("enter")

        def moves():
            changes = self.editor.idle()["edits"].get("changes", [])
            return {change["object"]["id"]: change["move"] for change in changes}
        self.assertEqual(set(moves()), {SOFA, TABLE, MUG})
        for move in moves().values():
            self.assertLess(math.dist(move["offset_m"], (0, -0.3, 0)), 1e-9)
        self.assertEqual(self.editor.state()["history"], ["Open", "Move sofa and 2 more"])
        self.assertEqual(len(self.editor.state()["selected"]), 3)
        # A half turn moves each centre to the opposite side of the middle of the three.
        self.press("r")
        self.editor.type("180")
        self.press("enter")
        turned = moves()
        for move in turned.values():
            self.assertAlmostEqual(abs(move["turn_rad"]), math.pi)
        shift = [sum(move["offset_m"][axis] for move in turned.values()) / 3 for axis in range(3)]
        self.assertLess(math.dist(shift, (0, -0.3, 0)), 1e-9, "the middle stays")
        self.assertGreater(math.dist(turned[SOFA]["offset_m"], (0, -0.3, 0)), 0.5)
        self.press("alt+r", "alt+g")
        self.assertEqual(moves(), {})
        for _ in range(4):
            self.press("ctrl+z")
        state = self.editor.idle()
        self.assertEqual(state["history_position"], 0)

    def test_move_and_tilt_a_position_point(self):
        point = self.start_project()["result"]["position_points"][0]
        self.select_position_point(point["position"])
        self.over_the_viewport()
        self.press("g", "y")
        self.editor.type("-0.2")
        self.assertEqual(self.editor.state()["edits"].get("pinned", []), [], "not before Enter")
        self.press("enter")
        pinned = self.editor.idle()["edits"]["pinned"]
        self.assertEqual(len(pinned), 1)
        expected = [a + b for a, b in zip(point["position"], (0, -0.2, 0))]
        self.assertLess(math.dist(pinned[0]["position"], expected), 1e-9)
        state = self.editor.wait(lambda now: now["selection_kind"] == POSITION_POINT and
                                 now["plan_is_current"], "the pinned point")
        self.over_the_viewport()
        self.press("r", "x")
        state = self.editor.type("10")
        self.assertEqual(state["drag_text"], "Tilt: 10\u00b0")
        before = state["history_position"]
        self.press("enter")
        self.assertEqual(self.editor.idle()["history_position"], before + 1)

    def test_ctrl_snaps_the_handles_and_the_keys(self):
        self.with_the_sofa()
        x, y = self.editor.middle("gizmo.x")
        origin = self.editor.middle("gizmo.free")
        length = math.dist((x, y), origin)
        end = (x + 63 * (x - origin[0]) / length, y + 63 * (y - origin[1]) / length)
        texts = []
        self.editor.drag((x, y), end, keys=("ctrl",),
                         look=lambda state: texts.append(state["drag_text"]))
        moved = self.move()["offset_m"]
        steps = moved[0] / 0.1
        self.assertGreaterEqual(round(steps), 1)
        self.assertAlmostEqual(steps, round(steps), 6)
        self.assertTrue(texts[-1].endswith("(steps of 0.1 m)"), texts[-1])
        self.assertEqual(self.editor.idle()["selected"], [SOFA], "Ctrl takes nothing out")
        self.press("7")
        self.wait_picture()
        cx, cy = self.editor.middle("gizmo.free")
        self.editor.point((cx + 80, cy))
        self.press("r")
        with self.editor.held("ctrl"):
            self.editor.move(cx + 60, cy - 60)
            state = self.editor.state()
            self.editor.press()
            self.editor.release()
        self.assertEqual(state["drag_text"], "Rotate about z: 45\u00b0 (steps of 15\u00b0)")
        self.assertAlmostEqual(self.move()["turn_rad"], math.pi / 4, 9)
