"""Changing the plan by hand: position points, objects, no-go boxes, heights."""
import json
import math

from task import BOOK, MUG, NO_GO_BOX, OBJECTS, POSITION_POINT, SOFA, Task
from support import tiny_room


class ByHand(Task):
    def first_point(self):
        """The first position point that the command line planned, selected in the window."""
        result = self.start_project()["result"]
        self.select_position_point(result["position_points"][0]["position"])
        return result["position_points"][0]

    def boxes(self):
        return self.editor.idle()["edits"].get("no_go", [])

    def start_room_with_box(self):
        """Starts the editor with a new no-go box, which is selected."""
        self.start_room()
        self.wait_picture()
        self.editor.point("viewport")
        self.editor.key("n")
        return self.editor.idle()

    def pinned(self):
        return self.editor.idle()["edits"].get("pinned", [])

    def test_pin_a_position_point(self):
        point = self.first_point()
        self.editor.key("l")
        pinned = self.pinned()
        self.assertEqual(len(pinned), 1)
        self.assertLess(math.dist(pinned[0]["position"], point["position"]), 1e-6)
        # Pinned points stay although the plan around them changes.
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
        # Room views are chosen again for the remaining points, so more than one may disappear.
        self.assertLess(len(state["points"]), len(before["points"]))
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

    def test_turn_a_position_point_with_the_rings(self):
        point = self.first_point()
        yaw, pitch = self.heading(point)
        origin = self.editor.middle("gizmo.free")
        grip = self.editor.middle("gizmo.yaw")
        angle = math.radians(40)  # against the clock, which from above is positive
        offset = (grip[0] - origin[0], grip[1] - origin[1])
        to = (origin[0] + offset[0] * math.cos(angle) + offset[1] * math.sin(angle),
              origin[1] - offset[0] * math.sin(angle) + offset[1] * math.cos(angle))
        state = self.editor.drag(grip, to)
        self.assertEqual(len(state["history"]), 2, "one drag, one step of undo")
        turned = self.pinned()[0]
        now = self.heading(turned)
        self.assertLess(math.dist(turned["position"], point["position"]), 1e-6)
        self.assertAlmostEqual(math.remainder(now[0] - yaw - angle, 2 * math.pi), 0.0, delta=0.06)
        self.assertAlmostEqual(now[1], pitch, 6)
        self.lower_the_view()
        grip, origin = self.editor.middle("gizmo.pitch"), self.editor.middle("gizmo.free")
        middle = ((grip[0] + origin[0]) / 2 + 20, (grip[1] + origin[1]) / 2)
        self.editor.drag(grip, middle)
        tilted = self.heading(self.pinned()[0])
        self.assertGreater(abs(tilted[1] - pitch), 0.05)
        self.assertAlmostEqual(tilted[0], now[0], 6)

    def lower_the_view(self):
        """Turns the view from above to the side, so that the arc of the pitch handle does not look
        like a line."""
        left, top, _, bottom = self.editor.item("viewport")[:4]
        x, y = left + 40, (top + bottom) / 2
        self.editor.drag((x, y), (x + 60, y - 140))
        self.wait_picture()

    def heading(self, point):
        """Yaw and pitch of its viewing direction, the z axis."""
        x, y, z, w = point["quaternion_xyzw"]
        forward = (2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y))
        return math.atan2(forward[1], forward[0]), math.asin(max(-1.0, min(1.0, forward[2])))

    def test_a_new_no_go_box_stands_on_the_floor_and_shows_its_handles(self):
        self.start_room()
        self.wait_picture()
        self.editor.point("viewport")
        state = self.editor.key("n")
        self.assertEqual(state["selection_kind"], NO_GO_BOX)
        box = self.boxes()[0]
        self.assertGreater(min(box["half_size_m"]), 0.12)
        bottom = box["center"][2] - box["half_size_m"][2]
        self.assertLess(min(abs(bottom - height) for height in (0.0, 0.74, 0.7)), 0.02,
                        "on the floor, the table or the sofa")
        self.editor.item("gizmo.z")

    def test_a_handle_pressed_between_two_frames_does_not_turn_the_view(self):
        self.start_room_with_box()
        self.editor.item("gizmo.free")
        for _ in range(3):
            self.wait_picture()
            before = self.editor.state()
            center = self.boxes()[0]["center"]
            x, y = self.editor.middle("gizmo.free")
            self.editor.point((x - 110, y - 70))  # away from the handles
            with self.editor.stuck():
                self.editor.move(x, y)
                self.editor.press()
                for step in range(1, 6):
                    self.editor.move(x - 12 * step, y)
            self.editor.state()
            self.editor.release()
            after = self.editor.idle()
            self.assertEqual(after["camera"], before["camera"])
            self.assertNotEqual(self.boxes()[0]["center"], center)

    def test_escape_and_the_right_button_end_a_drag_as_if_it_had_not_been(self):
        self.start_room_with_box()
        before = self.boxes()
        steps = self.editor.state()["history_position"]
        for how in ("esc", "right"):
            x, y = self.editor.middle("gizmo.free")
            self.editor.point((x, y))
            self.editor.press()
            for step in range(1, 5):
                self.editor.move(x - 12 * step, y)
                self.editor.state()
            self.assertNotEqual(self.editor.state()["edits"]["no_go"], before)
            if how == "esc":
                self.editor.key("esc")
            else:
                self.editor.press("right")
                self.editor.release("right")
            self.editor.move(x - 70, y)
            self.editor.release()
            state = self.editor.idle()
            self.assertEqual(state["edits"]["no_go"], before)
            self.assertEqual(state["history_position"], steps)
            self.assertEqual(state["selection_kind"], NO_GO_BOX)

    def test_rename_a_no_go_box(self):
        self.start_room()
        self.wait_picture()
        self.editor.click("tab.by hand")
        self.press_by_hand("edits.add_box")
        self.editor.wait(lambda state: state["selection_kind"] == NO_GO_BOX, "the box")
        self.editor.click("selection.box.name")
        self.editor.key("ctrl+a")
        self.editor.type("stairs")
        self.editor.key("enter")
        self.assertEqual(self.boxes()[0]["name"], "stairs")
        self.assertEqual(self.editor.state()["history"][-1], "Rename no-go box to stairs")
        self.editor.key("ctrl+z")
        self.assertEqual(self.boxes()[0]["name"], "no-go box")

    def press_by_hand(self, name):
        left, top, right, bottom = self.editor.reach(name, self.over_the_panel())[:4]
        self.editor.click(((left + right) / 2, (top + bottom) / 2))

    def over_the_panel(self):
        left, _, _, bottom = self.editor.item("tab.by hand")[:4]
        return left, bottom + 30

    def test_set_a_height_band_and_see_it_obeyed(self):
        self.start_room()
        self.editor.click("tab.by hand")
        self.editor.reach("edits.height.max", self.over_the_panel())
        self.editor.type_value("edits.height.min", "1")
        self.editor.type_value("edits.height.max", "1.4")
        self.editor.idle()
        project = self.folder / "band.dolly"
        self.editor.key("ctrl+s")
        self.editor.choose_file(project)
        self.editor.wait(lambda state: not state["unsaved"], "the project to be saved")
        frames = self.saved(project)["result"]["trajectory"]["frames"]
        heights = [frame["position"][2] for frame in frames]
        self.assertGreater(len(heights), 10)
        self.assertGreaterEqual(min(heights), 1.0 - 1e-6)
        self.assertLessEqual(max(heights), 1.4 + 1e-6)

    def saved(self, path):
        return json.loads(path.read_text())

    def test_split_an_object_into_its_pieces(self):
        scene = self.folder / "pair.obj"
        tiny_room.write(scene)
        lines = scene.read_text().splitlines()
        # A second box in the group of the mug: one object of two pieces.
        at = lines.index("o book")
        del lines[at]
        scene.write_text("\n".join(lines) + "\n")
        state = self.start(scene)
        self.assertEqual(state["plan"]["objects"], 4)
        self.select_row(MUG)
        self.editor.click("selection.split")
        state = self.editor.idle()
        self.assertEqual(state["plan"]["objects"], 5)
        self.assertEqual(len(state["history"]), 2)
        self.assertIn("surfaces", state["stages_computed"])
        # Undo and redo return to the maps that were there.
        for key, objects in (("ctrl+z", 4), ("ctrl+shift+z", 5)):
            self.editor.key(key)
            state = self.editor.idle()
            self.assertEqual(state["plan"]["objects"], objects)
            for stage in ("rays", "surfaces", "free_space", "viewpoints", "roadmap"):
                self.assertNotIn(stage, state["stages_computed"])

    def test_merge_two_objects(self):
        before = self.start_room()
        self.select_row(MUG)
        left, top, _, bottom = self.editor.item(f"objects.row.{BOOK}")[:4]
        state = self.editor.click((left + 30, (top + bottom) / 2), keys=["ctrl"])
        self.assertEqual((state["selection_kind"], state["selected"]), (OBJECTS, [MUG, BOOK]))
        self.editor.click("selection.merge_name")
        self.editor.type("still life")
        self.editor.click("selection.merge")
        state = self.editor.idle()
        self.assertEqual(state["plan"]["objects"], before["plan"]["objects"] - 1)
        self.assertIn("still life", [one["name"] for one in state["objects"]])
        self.editor.key("ctrl+z")
        self.assertEqual(self.editor.idle()["plan"], before["plan"])

    def test_a_second_click_on_a_target_box_takes_the_first_back(self):
        before = self.start_room()
        self.editor.click("objects.shown")
        self.editor.click("objects.shown.0")  # all: it stays in the list
        for _ in range(2):  # without waiting for the plan of the first
            self.editor.click(f"objects.target.{SOFA}")
        self.editor.wait(lambda state: len(state["history"]) == 3, "two steps of undo", 10)
        self.assertEqual(self.editor.idle()["plan"], before["plan"])
