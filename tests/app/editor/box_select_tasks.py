"""Selecting several objects with a box, and what acts on all of them."""
from task import BOOK, MUG, PICTURE, SOFA, TABLE, Task


class BoxSelect(Task):
    def from_above(self):
        self.start_room()
        self.without_layers()
        self.editor.point((self.editor.middle("viewport")[0], 60))
        self.editor.key("7")
        self.wait_picture()

    def corners(self, object_id, margin):
        """Opposite corners of a square around an object's middle, px."""
        x, y = next(one["px"] for one in self.editor.state()["objects"] if one["id"] == object_id)
        return (x - margin, y - margin), (x + margin, y + margin)

    def box(self, start, end, keys=()):
        self.assertTrue(self.editor.key("b")["box_select"])
        state = self.editor.drag(start, end, keys=keys)
        self.assertFalse(state["box_select"])
        return state

    def test_a_box_selects_what_is_in_it(self):
        self.from_above()
        camera = self.editor.state()["camera"]
        state = self.box(*self.corners(MUG, 4))
        self.assertTrue({MUG} <= set(state["selected"]) <= {MUG, TABLE}, state["selected"])
        state = self.box(*self.corners(SOFA, 5), keys=("shift",))
        self.assertTrue({MUG, SOFA} <= set(state["selected"]) <= {MUG, SOFA, TABLE})
        state = self.box(*self.corners(MUG, 4), keys=("ctrl",))
        self.assertEqual(state["selected"], [SOFA])
        state = self.box(*self.corners(SOFA, 5))
        self.assertEqual(state["selected"], [SOFA])
        left, top, right, bottom = self.editor.item("viewport")[:4]
        state = self.box((left + 5, top + 5), (right - 5, bottom - 5))
        self.assertTrue({TABLE, MUG, BOOK, SOFA} <= set(state["selected"]) <=
                        {TABLE, MUG, BOOK, SOFA, PICTURE}, "no walls and no floor")
        self.assertEqual(state["camera"], camera, "the view does not move")
        self.assertEqual(state["history"], ["Open"])

    def test_escape_and_the_right_button_cancel(self):
        self.from_above()
        self.select_row(SOFA)
        self.editor.point((self.editor.middle("viewport")[0], 60))
        self.editor.key("b")
        state = self.editor.key("esc")
        self.assertFalse(state["box_select"])
        self.assertEqual(state["selected"], [SOFA])
        self.editor.key("b")
        state = self.editor.click(self.corners(MUG, 4)[0], "right")
        self.assertFalse(state["box_select"])
        self.assertEqual(state["selected"], [SOFA])

    def test_all_and_nothing(self):
        self.from_above()
        self.select_row(SOFA)
        self.editor.point((self.editor.middle("viewport")[0], 60))
        self.editor.key("h")
        state = self.editor.key("a")
        self.assertEqual(sorted(state["selected"]), [TABLE, MUG, BOOK, PICTURE],
                         "no hidden object, no walls and no floor")
        state = self.editor.key("alt+a")
        self.assertEqual(state["selected"], [])

    def test_letters_fly_while_the_camera_looks_around(self):
        self.from_above()
        self.editor.press("right")
        self.editor.state()
        state = self.editor.key("a")
        self.editor.release("right")
        self.assertEqual(state["selected"], [])

    def test_what_is_done_with_the_selection_is_done_with_all(self):
        self.from_above()
        selected = self.box(self.corners(MUG, 4)[0], self.corners(BOOK, 4)[1])["selected"]
        self.assertTrue({MUG, BOOK} <= set(selected))
        self.editor.click("selection.class")
        self.editor.type("lamp")
        self.editor.key("enter")
        state = self.editor.idle()
        classes = {one["class"] for one in state["objects"] if one["id"] in selected}
        self.assertEqual(len(classes), 1, "one class for all")
        self.assertEqual(len(state["history"]), 2, "one step of undo")
        self.editor.point((self.editor.middle("viewport")[0], 60))
        state = self.editor.key("h")
        self.assertEqual(state["hidden_ids"], sorted(selected))

    def test_a_right_click_opens_the_menu_of_the_selection(self):
        self.from_above()
        middle = tuple((a + b) // 2 for a, b in zip(*self.corners(SOFA, 4)))
        state = self.editor.click(middle, button="right")
        self.assertEqual(state["selected"], [SOFA])
        self.assertIn("command.edit.exclude", state["items"])
        self.assertNotIn("command.edit.include", state["items"], "what cannot run is left out")
        self.editor.click("command.view.hide")
        self.assertEqual(self.editor.state()["hidden_ids"], [SOFA])
        # In the list, for all that is selected.
        self.select_row(MUG)
        self.editor.click(f"objects.row.{BOOK}", keys=("ctrl",))
        state = self.editor.click(f"objects.row.{BOOK}", button="right")
        self.assertEqual(sorted(state["selected"]), [MUG, BOOK])
        self.editor.click("command.edit.exclude")
        state = self.editor.idle()
        self.assertEqual(state["plan"]["excluded"], 2)
        self.assertEqual(len(state["history"]), 2, "one step of undo")
        # A right drag looks around instead.
        camera = state["camera"]
        state = self.editor.drag(middle, (middle[0] + 60, middle[1]), button="right")
        self.assertNotEqual(state["camera"], camera)
        self.assertNotIn("command.view.local", state["items"])
