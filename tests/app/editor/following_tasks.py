"""Objects get other ids when they are merged and split; the selection follows them."""
from task import BOOK, MUG, PICTURE, SOFA, TABLE, OBJECTS, POSITION_POINT, Task


class Following(Task):
    def names(self, state):
        return [one["name"] for one in state["objects"] if one["id"] in state["selected"]]

    def add_row(self, object_id):
        left, top, _, bottom = self.editor.item(f"objects.row.{object_id}")[:4]
        return self.editor.click((left + 30, (top + bottom) / 2), keys=["ctrl"])

    def merge(self, *ids):
        self.select_row(ids[0])
        for one in ids[1:]:
            self.add_row(one)
        self.editor.click("selection.merge_name")
        self.editor.type("heap")
        self.editor.click("selection.merge")
        return self.editor.idle()

    def test_what_is_selected_stays_selected_while_numbers_change(self):
        self.start_room()
        self.assertEqual(self.names(self.merge(TABLE, MUG)), ["heap"])
        self.select_row(SOFA - 1)
        self.assertEqual(self.names(self.editor.state()), ["sofa"])
        self.editor.point("viewport")
        for key in ("ctrl+z", "ctrl+shift+z"):
            self.editor.key(key)
            self.assertEqual(self.names(self.editor.idle()), ["sofa"], key)
        self.editor.key("x")
        state = self.editor.idle()
        self.assertEqual(state["history"][-1], "Exclude sofa")
        self.assertEqual([change["object"]["name"] for change in state["edits"]["changes"]],
                         ["sofa"])

    def test_undoing_a_merge_selects_its_parts(self):
        self.start_room()
        self.merge(MUG, SOFA)
        self.editor.point("viewport")
        self.editor.key("ctrl+z")
        state = self.editor.idle()
        self.assertEqual((state["selection_kind"], state["selected"]), (OBJECTS, [MUG, SOFA]))

    def test_a_hidden_object_stays_hidden_while_numbers_change(self):
        self.start_room()
        self.editor.click(f"objects.eye.{PICTURE}")
        self.assertEqual(self.editor.state()["hidden_ids"], [PICTURE])
        self.merge(TABLE, MUG)
        self.assertEqual(self.editor.state()["hidden_ids"], [PICTURE - 1])
        self.editor.point("viewport")
        self.editor.key("ctrl+z")
        self.editor.idle()
        self.assertEqual(self.editor.state()["hidden_ids"], [PICTURE])

    def test_one_step_excludes_all_that_is_selected_and_says_so(self):
        self.start_room()
        self.select_row(MUG)
        self.add_row(BOOK)
        self.editor.point("viewport")
        self.editor.key("x")
        state = self.editor.idle()
        self.assertEqual(state["history"], ["Open", "Exclude mug and book"])

    def test_an_object_of_one_piece_cannot_be_split(self):
        self.start_room()
        self.select_row(SOFA)
        self.editor.wait(lambda state: not state["items"]["selection.split"][4],
                         "the button to be switched off", 10)
        self.editor.click("selection.split")
        state = self.editor.idle()
        self.assertEqual((state["notice"], len(state["history"])), ("", 1))

    def test_a_click_on_a_row_in_sight_does_not_scroll_the_list(self):
        self.start_room(size=(1000, 560))
        self.editor.click("objects.shown")
        self.editor.click("objects.shown.0")  # all of them, more than fit on the screen
        rows = self.rows()
        last = max(rows, key=lambda name: rows[name][1])
        left, top, _, bottom = rows[last][:4]
        self.editor.click((left + 30, (top + bottom) / 2))
        self.editor.state()
        after = self.rows()[last]
        self.assertLess(abs(after[1] - top), bottom - top, "at most the part that was cut off")

    def rows(self):
        """The rows that can be clicked now."""
        return {name: place for name, place in self.editor.items().items()
                if name.startswith("objects.row.")}

    def test_a_view_pinned_from_a_candidate_is_selected_with_its_handles(self):
        self.start_room()
        self.select_row(SOFA)
        self.editor.idle()
        self.editor.reach("selection.best_candidate", self.over_the_panel())
        self.editor.click("selection.best_candidate")
        self.editor.reach("selection.pin", self.over_the_panel())
        self.editor.click("selection.pin")
        state = self.editor.wait(lambda state: state["selection_kind"] == POSITION_POINT,
                                 "the new point to be selected", 20)
        self.assertEqual(state["points"][state["selection_index"]]["pin"], 0)
        self.editor.item("gizmo.free")

    def over_the_panel(self):
        left, _, _, bottom = self.editor.item("tab.selection")[:4]
        return left, bottom + 120
