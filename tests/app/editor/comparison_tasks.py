"""Comparing two plans, and weak frames."""
import json
import subprocess

from task import Programs, Task, plan


class Comparing(Task):
    def test_keep_a_plan_change_it_and_swap(self):
        before = self.start_room()
        self.editor.click("tab.metrics")
        state = self.editor.click("comparison.keep")
        self.assertEqual(state["comparison"]["kept"],
                         {"name": "room.obj", "frames": before["plan"]["frames"]})
        self.set_parameter("max_frames", "30")
        state = self.editor.idle()
        self.assertNotEqual(state["plan"]["frames"], before["plan"]["frames"])
        self.editor.click("tab.metrics")
        for name in ("comparison.capture_rate", "comparison.frames"):
            self.editor.item(name)
        self.editor.click("tab.timeline")
        kept = self.editor.item("timeline.kept")
        axis = self.editor.item("timeline.axis")
        self.assertAlmostEqual(kept[0], axis[0], delta=2)
        changed = state["plan"]

        state = self.editor.click("comparison.swap")
        self.assertEqual(state["comparison"]["kept"]["frames"], changed["frames"])
        state = self.editor.idle()
        self.assertEqual(state["plan"], before["plan"])
        self.assertEqual(state["history"][-1], "Swap with room.obj")
        self.editor.point(self.editor.middle("viewport"))
        self.editor.key("ctrl+z")
        state = self.editor.idle()
        self.assertEqual(state["plan"], changed)
        self.assertEqual(state["comparison"]["kept"]["frames"], before["plan"]["frames"])
        self.editor.key("ctrl+y")
        state = self.editor.idle()
        self.assertEqual(state["plan"], before["plan"])
        self.assertEqual(state["comparison"]["kept"]["frames"], changed["frames"])
        state = self.editor.click("comparison.drop")
        self.assertIsNone(state["comparison"]["kept"])
        self.assertNotIn("timeline.kept", self.editor.state()["items"])

    def test_compare_with_another_project(self):
        other = self.folder / "other.dolly"
        saved = plan(self.room, other, "--max-frames", "25")
        self.start_room()
        self.editor.run_command("compare with another project")
        self.editor.choose_file(other)
        state = self.editor.wait(lambda now: now["comparison"]["kept"], "the other plan")
        frames = len(saved["result"]["trajectory"]["frames"])
        self.assertEqual(state["comparison"]["kept"], {"name": "other.dolly", "frames": frames})
        self.editor.item("comparison.capture_rate")
        self.editor.click("comparison.swap")
        state = self.editor.idle()
        self.assertEqual(state["plan"]["frames"], frames)
        self.assertEqual(state["parameters"]["timing"]["max_frames"], 25)

    def test_a_project_of_another_scene_is_refused(self):
        room = self.folder / "smaller.obj"
        room.write_text(self.room.read_text().replace("2.6", "2.5"))
        other = self.folder / "smaller.dolly"
        plan(room, other, "--max-frames", "10")
        self.start_room()
        self.editor.run_command("compare with another project")
        self.editor.choose_file(other)
        self.assertIn("another scene", self.notice())
        self.assertIsNone(self.editor.state()["comparison"]["kept"])

    def test_weak_frames_are_those_of_the_command_line(self):
        self.start_project("--max-frames", "30")
        table = self.folder / "frames.csv"
        metrics = json.loads(subprocess.run(
            [Programs.command_line, "-q", "plan", self.project, "--frames", table, "--json"],
            check=True, stdout=subprocess.PIPE).stdout)
        self.editor.click("tab.layers")
        state = self.editor.click("layers.quality")
        state = self.editor.wait(lambda now: now["comparison"]["quality"], "the measurement")
        quality = state["comparison"]["quality"]
        for name in ("wide_gaps", "untrackable_frames", "overlap_min_rate", "surface_seen_rate"):
            self.assertEqual(quality[name], metrics[name], name)
        self.assertGreater(quality["untrackable_frames"], 0)
        self.editor.item("layers.quality.wide_gaps")
        # The mouse over a weak frame shows its numbers.
        self.show_preview(False)
        if self.editor.state()["layers"]["points"]:
            self.editor.key("F3")
        frames = json.loads(self.project.read_text())["result"]["trajectory"]["frames"]
        weak = next(i for i, corners in enumerate(quality["image_corners"]) if corners < 150)
        self.editor.point(self.editor.middle("viewport"))
        self.editor.key("7")
        self.wait_picture()
        self.editor.point(self.place_of(frames[weak]["position"]))
        self.editor.item("viewport.frame_tip")
        state = self.editor.click("layers.quality")
        self.assertNotIn("layers.quality.wide_gaps", self.editor.state()["items"])
