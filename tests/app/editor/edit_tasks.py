"""Changing the plan by hand: position points and no-go boxes."""
import math

from task import NO_GO_BOX, POSITION_POINT, SOFA, Task


class ByHand(Task):
    def first_point(self):
        """The first position point that the command line planned, selected in the window."""
        result = self.start_project()["result"]
        self.select_position_point(result["position_points"][0]["position"])
        return result["position_points"][0]

    def boxes(self):
        return self.editor.idle()["edits"].get("no_go", [])

    def pinned(self):
        return self.editor.idle()["edits"].get("pinned", [])

    def test_lock_a_position_point(self):
        point = self.first_point()
        self.editor.key("l")
        pinned = self.pinned()
        self.assertEqual(len(pinned), 1)
        self.assertLess(math.dist(pinned[0]["position"], point["position"]), 1e-6)
        # What is locked stays although the plan around it changes.
        self.set_parameter("fill", "0.4")
        self.assertEqual(self.pinned(), pinned)
        self.assertTrue(any(one["pin"] == 0 for one in self.editor.state()["points"]))

    def test_move_a_position_point_with_the_gizmo(self):
        point = self.first_point()
        self.show_preview(True)
        x, y = self.editor.middle("gizmo.x")
        origin = self.editor.middle("gizmo.free")
        length = math.dist((x, y), origin)
        way = ((x - origin[0]) / length, (y - origin[1]) / length)
        previews = set()
        state = self.editor.drag((x, y), (x + 30 * way[0], y + 30 * way[1]),
                                 look=lambda now: previews.add(now["preview"]["serial"]))
        self.assertEqual(len(state["history"]), 2, "one drag, one step of undo")
        pinned = self.pinned()
        self.assertEqual(len(pinned), 1)
        moved = [b - a for a, b in zip(point["position"], pinned[0]["position"])]
        self.assertGreater(moved[0], 0.05)
        self.assertLess(abs(moved[1]) + abs(moved[2]), 1e-6, "along x only")
        self.assertGreater(len(previews), 1, "the preview follows the drag")
        self.editor.key("ctrl+z")
        self.assertEqual(self.pinned(), [])

    def test_add_a_position_point_from_the_view(self):
        before = self.start_room()
        self.editor.key("0")  # where the trajectory begins, a camera certainly fits
        self.editor.key("esc")
        self.editor.key("p")
        pinned = self.pinned()
        self.assertEqual(len(pinned), 1)
        state = self.editor.state()
        self.assertEqual(len(state["points"]), len(before["points"]) + 1)
        self.editor.click("tab.by hand")
        self.editor.click("edits.pin.0.unpin")
        self.assertEqual(self.pinned(), [])

    def test_delete_a_position_point_and_undo(self):
        self.first_point()
        before = self.editor.state()
        self.editor.key("del")
        state = self.editor.idle()
        self.assertEqual(len(state["edits"]["removed"]), 1)
        self.assertEqual(len(state["points"]), len(before["points"]) - 1)
        self.editor.key("ctrl+z")
        self.assertEqual(len(self.editor.idle()["points"]), len(before["points"]))

    def test_put_a_no_go_box_around_an_object_and_move_it(self):
        self.start_room()
        self.select_row(SOFA)
        self.editor.point((self.editor.middle("viewport")[0], 60))
        state = self.editor.key("n")
        self.assertEqual(state["selection_kind"], NO_GO_BOX)
        box = self.boxes()[0]
        self.assertLess(math.dist(box["center"], (0.5, -1.5, 0.35)), 0.02)
        self.show_preview(False)
        x, y = self.editor.middle("gizmo.z")
        origin = self.editor.middle("gizmo.free")
        state = self.editor.drag((x, y), (x, y - 40))
        self.assertLess(y, origin[1], "upwards is upwards")
        self.assertEqual(len(state["history"]), 3)
        moved = self.boxes()[0]
        self.assertGreater(moved["center"][2], box["center"][2] + 0.1)
        self.assertLess(math.dist(moved["center"][:2], box["center"][:2]), 1e-6)
        self.editor.key("del")
        self.assertEqual(self.boxes(), [])

    def test_type_the_coordinates_of_a_point(self):
        self.first_point()
        self.editor.type_value("selection.position.z", "1.25")
        pinned = self.pinned()
        self.assertEqual(len(pinned), 1)
        self.assertAlmostEqual(pinned[0]["position"][2], 1.25, 3)

    def test_select_a_point_and_preview_its_view(self):
        self.first_point()
        self.assertEqual(self.editor.state()["selection_kind"], POSITION_POINT)
        serial = self.editor.state()["preview"]["serial"]
        self.show_preview(True)
        self.editor.click("preview.pin")
        self.editor.wait(lambda state: state["preview"]["serial"] > serial, "the preview")
