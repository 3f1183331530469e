"""Parameters, undo, the history and the command palette."""
import time

from task import BOOK, MUG, PICTURE, SOFA, TABLE, Task, plan
from support import tiny_room


class Tuning(Task):
    def test_drag_a_slider_and_watch_the_plan_follow(self):
        before = self.start_room()
        item = self.find_parameter("fill")
        left, top, right, bottom = self.editor.item(item)[:4]
        middle = (top + bottom) / 2
        self.editor.drag((left + 0.6 * (right - left), middle),
                         (left + 0.3 * (right - left), middle), steps=12)
        state = self.editor.idle()
        self.assertLess(state["parameters"]["viewpoints"]["fill"], 0.5)
        self.assertNotEqual(state["plan"], before["plan"])
        self.assertEqual(len(state["history"]), 2, "one drag, one step of undo")
        self.assertTrue(state["unsaved"])
        fill = state["parameters"]["viewpoints"]["fill"]
        same = plan(self.room, self.folder / "same.dolly", "--set", f"fill={fill}")
        self.assertEqual(state["plan"]["frames"], len(same["result"]["trajectory"]["frames"]))

    def test_type_a_value(self):
        self.start_room()
        state = self.set_parameter("corner_distance_m", "0.2")
        self.assertAlmostEqual(state["parameters"]["smoothing"]["corner_distance_m"], 0.2)
        self.assertEqual(len(state["history"]), 2)

    def test_parameters_that_do_not_go_together_leave_the_plan_before_in_sight(self):
        before = self.start_room()
        state = self.set_parameter("hfov_deg", "150")
        for name in ("near_m", "hfov_deg", "camera_radius_m"):
            self.assertIn(name, state["plan_error"])
        self.assertTrue(state["plan_outdated"])
        self.assertFalse(state["plan_is_current"])
        self.assertEqual(state["plan"], before["plan"])
        self.editor.item("viewport.remark")
        state = self.set_parameter("hfov_deg", "60")
        self.assertFalse(state["plan_outdated"])
        self.assertEqual(state["plan"], before["plan"])

    def test_a_typed_value_out_of_range_is_told(self):
        self.start_room()
        state = self.set_parameter("fill", "40")
        self.assertEqual(state["parameters"]["viewpoints"]["fill"], 1.0)
        self.assertEqual(state["plan_error"], "")
        self.assertIn("parameters.fill.note", state["items"])
        state = self.set_parameter("fill", "abc")
        self.assertEqual(state["parameters"]["viewpoints"]["fill"], 1.0)
        self.assertIn("parameters.fill.note", state["items"])
        self.assertEqual(len(state["history"]), 2)
        state = self.set_parameter("fill", "0.5")
        self.assertNotIn("parameters.fill.note", state["items"])

    def test_a_double_click_types_and_moves_nothing(self):
        before = self.start_room()
        self.editor.click(self.find_parameter("fill"), times=2)
        state = self.editor.state()
        self.assertEqual(state["parameters"], before["parameters"])
        self.editor.key("ctrl+a")
        self.editor.type("0.45")
        self.editor.key("enter")
        state = self.editor.idle()
        self.assertAlmostEqual(state["parameters"]["viewpoints"]["fill"], 0.45)
        self.assertEqual(len(state["history"]), 2)

    def test_a_double_click_counts_as_one_however_slow_the_frames(self):
        self.start_room()
        self.editor.point(self.find_parameter("fill"))
        self.editor.press()
        self.editor.release()
        time.sleep(0.05)  # until that was seen
        with self.editor.stuck():
            self.editor.press()
            self.editor.release()
            time.sleep(0.6)
        self.editor.key("ctrl+a")
        self.editor.type("0.45")
        self.editor.key("enter")
        state = self.editor.idle()
        self.assertAlmostEqual(state["parameters"]["viewpoints"]["fill"], 0.45)

    def test_two_clicks_are_no_double_click(self):
        before = self.start_room()
        item = self.find_parameter("fill")
        for _ in range(2):
            self.editor.click(item)
            time.sleep(0.6)
        self.editor.type("0.45")
        self.editor.key("enter")
        self.assertEqual(self.editor.idle()["parameters"], before["parameters"])

    def test_reset_one_parameter(self):
        before = self.start_room()
        self.set_parameter("max_speed_mps", "0.25")
        self.editor.click("parameters.max_speed_mps.reset")
        state = self.editor.idle()
        self.assertEqual(state["parameters"], before["parameters"])
        self.assertEqual(state["plan"], before["plan"])

    def test_reset_all_parameters(self):
        before = self.start_room()
        self.set_parameter("max_speed_mps", "0.25")
        self.set_parameter("fill", "0.5")
        self.editor.click("parameters.reset_all")
        state = self.editor.idle()
        self.assertEqual(state["parameters"], before["parameters"])
        self.assertEqual(len(state["history"]), 4)

    def test_undo_and_redo_with_the_keyboard(self):
        before = self.start_room()
        changed = self.set_parameter("fill", "0.4")
        self.editor.key("ctrl+z")
        undone = self.editor.idle()
        self.assertEqual((undone["parameters"], undone["plan"]),
                         (before["parameters"], before["plan"]))
        self.assertFalse(undone["unsaved"])
        self.editor.key("ctrl+shift+z")
        redone = self.editor.idle()
        self.assertEqual((redone["parameters"], redone["plan"]),
                         (changed["parameters"], changed["plan"]))

    def test_go_back_in_the_history(self):
        before = self.start_room()
        for value in ("0.3", "0.35", "0.4"):
            self.set_parameter("fill", value)
        self.editor.click("tab.history")
        self.editor.click("history.step.1")
        state = self.editor.idle()
        self.assertEqual(state["history_position"], 1)
        self.assertAlmostEqual(state["parameters"]["viewpoints"]["fill"], 0.3)
        self.editor.click("history.step.0")
        self.assertEqual(self.editor.idle()["plan"], before["plan"])

    def test_choose_the_path_mode_from_a_list(self):
        self.start_room()
        self.editor.click(self.find_parameter("path_mode"))
        choices = [name for name in self.editor.items() if name.startswith("choice.")]
        self.assertGreater(len(choices), 1)
        other = next(name for name in sorted(choices) if name != "choice.tour")
        self.editor.click(other)
        state = self.editor.idle()
        self.assertEqual("choice." + state["parameters"]["path"]["path_mode"], other)

    def test_find_a_parameter_with_the_palette(self):
        self.start_room()
        self.editor.run_command("corner dist")
        self.editor.wait(lambda state: "parameters.corner_distance_m" in state["items"] and
                         "parameters.fill" not in state["items"], "the parameter")

    def test_find_an_object_with_the_palette(self):
        self.start_room()
        self.editor.run_command("sofa")
        self.editor.wait(lambda state: state["selected"] == [SOFA], "the sofa")

    def test_run_a_command_with_the_palette(self):
        self.start_room()
        self.editor.run_command("layers roadmap")
        self.editor.wait(lambda state: state["layers"]["roadmap"], "the roadmap")

    def test_the_light_of_a_hall_is_stopped_and_computed(self):
        hall = self.folder / "hall.obj"
        tiny_room.write(hall)
        # Enough cells for a coarse light first.
        tiny_room.move_corners(hall, lambda x, y, z: (5 * x, 1.5 * y, 5 * z))
        self.start(hall)
        state = self.editor.wait(lambda state: "status.light.stop" in state["items"] or
                                 state["preview"]["final_light"], "the light to begin", 300)
        if state["preview"]["final_light"]:
            self.skipTest("the light was computed before it could be stopped")
        self.editor.click("status.light.stop")
        state = self.editor.wait(lambda state: not state["busy"]["lighting"] and
                                 "status.light" not in state["items"], "the light to stop")
        if state["preview"]["final_light"]:
            self.skipTest("the light was computed before it could be stopped")
        # An edit that moves nothing does not begin it again.
        self.set_parameter("fill", "0.5")
        self.assertFalse(self.editor.state()["busy"]["lighting"])
        self.editor.click("status.light.start")
        self.editor.wait(lambda state: state["preview"]["final_light"] and
                         "status.light.stop" not in state["items"], "the light", 300)

    def test_planning_is_stopped_and_begun_again(self):
        self.start_room()
        frames = self.editor.idle()["plan"]["frames"]
        self.editor.type_value(self.find_parameter("octree_resolution_m"), "0.015")
        state = self.editor.wait(lambda state: "status.plan.stop" in state["items"] or
                                 state["plan_is_current"], "planning to begin")
        if state["plan_is_current"]:
            self.skipTest("the plan was made before it could be stopped")
        self.editor.click("status.plan.stop")
        state = self.editor.wait(lambda state: "status.plan.start" in state["items"] or
                                 state["plan_is_current"], "planning to stop")
        if state["plan_is_current"]:
            self.skipTest("the plan was made before it could be stopped")
        self.assertEqual(state["plan"]["frames"], frames, "the plan before stays")
        self.editor.click("status.plan.start")
        self.editor.wait(lambda state: state["plan_is_current"] and
                         "status.plan.start" not in state["items"], "the plan", 300)

    def test_what_would_help_an_object_that_is_not_captured(self):
        self.start_room()
        self.assertLess(self.set_parameter("max_frames", "2")["plan"]["captured"], 5)
        for target in (TABLE, MUG, BOOK, SOFA, PICTURE):
            self.select_row(target)
            self.editor.click("tab.selection")
            if self.editor.has("selection.find_remedy"):
                break
        before = self.editor.state()
        self.editor.click("selection.find_remedy")
        self.editor.click("selection.apply_remedy")
        after = self.editor.idle()
        self.assertGreater(after["plan"]["captured"], before["plan"]["captured"])
        self.assertEqual(len(after["history"]), len(before["history"]) + 1, "one step of undo")
        self.assertFalse(self.editor.has("selection.find_remedy"), "it is captured well")
