"""Saving, quitting, closing, and recovering work after a crash."""
import json
import subprocess
import time

import numpy

from task import SOFA, Programs, Task


class Files(Task):
    def changed_room(self):
        self.start_room()
        return self.set_parameter("fill", "0.45")

    def save_as(self, path):
        self.editor.key("ctrl+shift+s")
        self.editor.item("files.name")
        self.editor.choose_file(path)
        return self.editor.wait(lambda state: not state["unsaved"], "the project to be saved")

    def test_save_reopen_and_find_everything_equal(self):
        self.changed_room()
        self.select_row(SOFA)
        self.editor.point("viewport")
        self.editor.key("x")
        before = self.editor.idle()
        project = self.folder / "kept.dolly"
        self.assertEqual(self.save_as(project)["project"], str(project))
        self.editor.tap("ctrl+q")
        self.assertEqual(self.editor.wait_end(), 0)
        self.editor.tidy()
        after = self.start(project)
        for key in ("parameters", "plan"):
            self.assertEqual(after[key], before[key])
        self.assertEqual(after["edits"]["changes"], before["edits"]["changes"])
        self.assertFalse(after["unsaved"])

    def test_save_and_reopen_what_is_hidden_the_frame_and_the_view(self):
        self.start_project()
        self.editor.click(f"objects.eye.{SOFA}")
        self.editor.point("viewport")
        x, y = self.editor.middle("viewport")
        self.editor.drag((x, y - 60), (x + 120, y - 20))
        for _ in range(3):
            self.editor.key("right")
        before = self.editor.idle()
        self.assertEqual(before["hidden_ids"], [SOFA])
        self.assertGreater(before["frame"], 0)
        self.editor.key("ctrl+s")
        self.editor.idle()
        self.assertEqual(json.loads(self.project.read_text())["view"]["hidden"], [SOFA])
        self.editor.tap("ctrl+q")
        self.assertEqual(self.editor.wait_end(), 0)
        self.editor.tidy()
        after = self.start(self.project)
        for key in ("hidden_ids", "frame"):
            self.assertEqual(after[key], before[key])
        for key, value in before["camera"].items():
            numpy.testing.assert_allclose(after["camera"][key], value, atol=1e-9, err_msg=key)

    def test_a_damaged_view_is_not_used(self):
        self.start_project()
        self.editor.tap("ctrl+q")
        self.assertEqual(self.editor.wait_end(), 0)
        self.editor.tidy()
        content = json.loads(self.project.read_text())
        view = {"camera": {"pivot": [0, 0, 0], "azimuth": 1, "elevation": 0.5, "distance": 5,
                           "orthographic": 0}, "frame": 3, "hidden": [SOFA]}
        for damage in ({"frame": 1e300}, {"hidden": [-1]}, {"hidden": {}}, {"camera": [1]}):
            with self.subTest(damage):
                content["view"] = {**view, **damage}
                self.project.write_text(json.dumps(content))
                state = self.start(self.project)
                self.assertEqual(state["frame"], 0)
                self.assertEqual(state["hidden"], 0)
                self.editor.tap("ctrl+q")
                self.assertEqual(self.editor.wait_end(), 0)
                self.editor.tidy()
        chosen = {"folder": "out", "first": 1, "last": -1, "step": 4}
        content["view"] = {**view, "export": chosen}
        self.project.write_text(json.dumps(content))
        state = self.start(self.project)
        self.assertEqual((state["frame"], state["hidden_ids"]), (3, [SOFA]))
        self.editor.click(f"objects.eye.{SOFA}")
        self.editor.key("ctrl+s")
        self.editor.idle()
        saved = json.loads(self.project.read_text())["view"]
        self.assertEqual((saved["hidden"], saved["export"]), ([], chosen))

    def test_a_project_saved_on_the_way_out_is_among_the_recent_ones(self):
        self.changed_room()
        self.editor.key("ctrl+q")
        self.editor.click("message.save")
        project = self.folder / "last.dolly"
        self.editor.item("files.path")
        self.editor.click("files.path", times=2)
        self.editor.key("ctrl+a")
        self.editor.type(str(project))
        self.editor.tap("enter")
        self.assertEqual(self.editor.wait_end(), 0)
        self.editor.tidy()
        state = self.start()
        self.assertEqual(state["recent"][0], str(project))

    def test_save_again_with_the_keyboard(self):
        self.changed_room()
        project = self.folder / "kept.dolly"
        self.save_as(project)
        self.set_parameter("fill", "0.5")
        self.editor.key("ctrl+s")
        self.editor.wait(lambda state: not state["unsaved"], "the project to be saved")
        content = json.loads(project.read_text())
        self.assertEqual(content["parameters"]["viewpoints"]["fill"], 0.5)
        frames = len(content["result"]["trajectory"]["frames"])
        self.assertEqual(frames, self.editor.state()["plan"]["frames"])

    def test_saving_again_without_changes_leaves_the_file_alone(self):
        self.start_project()
        before = self.project.stat()
        self.editor.key("ctrl+s")
        self.editor.idle()
        self.set_parameter("fill", "0.45")
        self.editor.point("viewport")
        self.editor.key("ctrl+z")
        self.editor.idle()
        self.editor.key("ctrl+s")
        self.editor.idle()
        after = self.project.stat()
        self.assertEqual((before.st_ino, before.st_mtime_ns), (after.st_ino, after.st_mtime_ns))
        self.project.unlink()
        self.editor.key("ctrl+s")
        self.editor.idle()
        self.assertTrue(self.project.exists(), "a file that is gone is written again")

    def test_type_a_name_faster_than_the_window_draws(self):
        self.start_room()
        for name in ("first.dolly", "second.dolly"):
            project = self.folder / name
            self.editor.tap("ctrl+shift+s")
            with self.editor.stuck():
                self.editor.letters(str(project))
                self.editor.tap("enter")
            self.editor.wait(lambda state: state["project"] == str(project), "the whole name")

    def test_letters_that_were_queued_need_no_frame_each(self):
        self.start_room()
        self.editor.key("ctrl+s")
        self.editor.item("files.name")
        self.editor.key("ctrl+a")
        before = self.editor.state()["frames"]
        text = "Abcdefghijklmnopqrstuvwxyz_A quick brown fox 01234"
        with self.editor.stuck():
            self.editor.letters(text)
            for key in ("backspace", "left", "x"):  # these keep their order
                self.editor.tap(key)
        state = self.editor.state()
        self.assertLess(state["frames"] - before, 25)
        self.editor.key("enter")
        name = text[:-2] + "x3"
        self.editor.wait(lambda state: state["project"].endswith(f"/{name}.dolly"), "the project")

    def test_a_name_of_another_kind_gets_the_ending_of_projects(self):
        self.changed_room()
        self.editor.key("ctrl+s")
        self.editor.item("files.name")
        self.editor.type(str(self.folder / "kept.do"))
        self.editor.key("enter")
        state = self.editor.wait(lambda state: not state["unsaved"], "the project to be saved")
        self.assertEqual(state["project"], str(self.folder / "kept.do.dolly"))
        self.assertFalse((self.folder / "kept.do").exists())

    def exclude_by_another_program(self, name):
        subprocess.run([Programs.command_line, "-q", "edit", self.project, "--op",
                        json.dumps({"op": "exclude", "object": name})],
                       check=True, stdout=subprocess.DEVNULL)

    def test_what_another_program_saved_is_noticed_and_can_be_reloaded(self):
        self.start_project()
        self.exclude_by_another_program("sofa")
        self.editor.wait(lambda state: state["file_changed"], "the change to be noticed", 20)
        self.editor.click("file_changed.1")  # keep mine
        self.assertFalse(self.editor.wait(lambda state: "file_changed" not in state["items"],
                                          "the bar to go")["file_changed"])
        self.exclude_by_another_program("mug")
        self.editor.wait(lambda state: state["file_changed"], "the next change", 20)
        self.set_parameter("fill", "0.45")
        self.editor.click("file_changed.0")  # reload
        self.dismiss("reload")
        state = self.editor.wait(lambda state: not state["unsaved"], "the project as it is now")
        self.assertEqual({change["object"]["name"] for change in state["edits"]["changes"]},
                         {"sofa", "mug"})
        self.assertFalse(self.editor.idle()["file_changed"])

    def changed_by_both(self):
        """A project in which the editor tuned a parameter and another program excluded an object;
        returns what that program wrote."""
        self.start_project()
        self.set_parameter("fill", "0.45")
        subprocess.run([Programs.command_line, "-q", "edit", self.project, "--op",
                        '{"op": "exclude", "object": "sofa"}'],
                       check=True, stdout=subprocess.DEVNULL)
        self.editor.point("viewport")
        return self.project.read_bytes()

    def try_to_save(self):
        self.editor.key("ctrl+s")
        self.editor.wait(lambda state: state["dialogs"]["changed_file"], "the question")

    def test_what_another_program_saved_is_not_overwritten_unasked(self):
        theirs = self.changed_by_both()
        self.try_to_save()
        self.dismiss("cancel")
        self.assertTrue(self.editor.idle()["unsaved"])
        self.assertEqual(self.project.read_bytes(), theirs)
        self.try_to_save()
        self.editor.click("message.save_as")
        mine = self.folder / "mine.dolly"
        self.editor.choose_file(mine)
        state = self.editor.wait(lambda state: not state["unsaved"], "the project to be saved")
        self.assertEqual(state["project"], str(mine))
        self.assertEqual(self.project.read_bytes(), theirs)
        self.set_parameter("fill", "0.5")
        self.editor.key("ctrl+s")  # no other program has changed that one
        self.editor.wait(lambda state: not state["unsaved"], "the project to be saved")
        self.assertEqual(json.loads(mine.read_text())["parameters"]["viewpoints"]["fill"], 0.5)

    def test_reload_what_another_program_saved(self):
        theirs = self.changed_by_both()
        self.try_to_save()
        self.dismiss("reload")
        state = self.editor.wait(lambda state: state["edits"], "the other program's edits")
        state = self.editor.idle()
        self.assertEqual(state["parameters"]["viewpoints"]["fill"], 0.72)
        self.assertEqual(state["edits"]["changes"][0]["object"]["name"], "sofa")
        self.assertFalse(state["unsaved"])
        self.assertEqual(self.project.read_bytes(), theirs)
        self.set_parameter("fill", "0.5")
        self.editor.key("ctrl+s")  # the reloaded version is known
        self.editor.wait(lambda state: not state["unsaved"], "the project to be saved")

    def test_overwrite_what_another_program_saved(self):
        self.changed_by_both()
        self.try_to_save()
        self.dismiss("overwrite")
        self.editor.wait(lambda state: not state["unsaved"], "the project to be saved")
        content = json.loads(self.project.read_text())
        self.assertEqual(content["parameters"]["viewpoints"]["fill"], 0.45)
        self.assertNotIn("edits", content)
        self.set_parameter("fill", "0.5")
        self.editor.key("ctrl+s")
        self.editor.wait(lambda state: not state["unsaved"], "saving without another question")

    def test_quitting_does_not_overwrite_what_another_program_saved(self):
        theirs = self.changed_by_both()
        self.editor.close_window()
        self.editor.click("message.save")
        self.editor.wait(lambda state: state["dialogs"]["changed_file"], "the question")
        self.dismiss("cancel")
        state = self.editor.idle()
        self.assertTrue(state["unsaved"] and not state["question"], "one stays")
        self.assertEqual(self.project.read_bytes(), theirs)

    def test_a_folder_that_is_missing_is_said(self):
        self.changed_room()
        self.editor.key("ctrl+shift+s")
        self.editor.item("files.name")
        self.editor.click("files.path")
        self.editor.key("ctrl+a")
        self.editor.type(str(self.folder / "nowhere" / "kept.dolly"))
        self.editor.key("enter")
        time.sleep(0.3)
        state = self.editor.state()
        self.assertTrue(state["dialogs"]["file"], "one can correct what was typed")
        self.assertTrue(state["unsaved"])
        self.editor.click("files.cancel")

    def test_quitting_with_unsaved_work_asks_and_can_be_called_off(self):
        self.changed_room()
        self.editor.close_window()
        self.editor.wait(lambda state: state["dialogs"]["unsaved"], "the question")
        self.editor.click("message.cancel")
        state = self.editor.wait(lambda state: not state["dialogs"]["unsaved"], "no question")
        self.assertTrue(state["unsaved"])

    def throw_away(self):
        """Discards the work on purpose: it is not offered again."""
        self.ends = True
        self.editor.close_window()
        self.editor.point("message.dont_save")
        self.editor.press()
        time.sleep(0.1)
        self.editor.release()
        self.assertEqual(self.editor.wait_end(), 0)
        self.editor.tidy()
        self.ends = False
        self.assertFalse(self.start()["dialogs"]["recovered_work"])

    def test_quit_and_throw_the_work_away(self):
        self.changed_room()
        self.editor.wait(lambda state: state["autosaves"] > 0, "a copy")
        time.sleep(5.5)  # another would be due
        self.throw_away()

    def test_throw_restored_work_away(self):
        self.changed_room()
        self.editor.wait(lambda state: state["autosaves"] > 0, "a copy")
        self.wait_copy("fill")
        self.editor.kill()
        self.start()
        self.editor.click("message.restore")
        self.editor.wait(lambda state: state["open"], "the lost work")
        self.throw_away()

    def test_quit_and_save(self):
        self.changed_room()
        project = self.folder / "kept.dolly"
        self.save_as(project)
        self.set_parameter("fill", "0.35")
        self.ends = True
        self.editor.close_window()
        self.editor.point("message.save")
        self.editor.press()
        time.sleep(0.1)
        self.editor.release()
        self.assertEqual(self.editor.wait_end(), 0)
        content = json.loads(project.read_text())
        self.assertEqual(content["parameters"]["viewpoints"]["fill"], 0.35)

    def test_quit_at_once_when_nothing_changed(self):
        self.start_room()
        self.ends = True
        self.editor.close_window()
        self.assertEqual(self.editor.wait_end(), 0)

    def test_close_the_project(self):
        self.start_room()
        self.editor.key("ctrl+w")
        state = self.editor.wait(lambda state: not state["open"], "the room to close")
        self.assertNotIn("plan", state)
        self.assertNotIn("objects.row.10", state["items"])

    def test_opening_another_scene_asks_for_unsaved_work(self):
        self.changed_room()
        self.editor.drop(self.room)
        self.editor.click("message.cancel")
        state = self.editor.idle()
        self.assertEqual(state["parameters"]["viewpoints"]["fill"], 0.45)

    def wait_copy(self, text):
        """Waits until the copy of unsaved work contains the text."""
        copies = self.folder / "home" / "state" / "dollytrack" / "autosave"
        for _ in range(200):
            if any(text in path.read_text() for path in copies.glob("*.dolly")):
                return
            time.sleep(0.05)
            self.editor.state()
        self.fail("there is no copy with " + text)

    def test_get_the_work_back_after_a_crash(self):
        planned = self.start_room()["plan"]
        self.set_parameter("fill", "0.45")
        self.select_row(SOFA)
        self.editor.point("viewport")
        self.editor.key("x")
        before = self.editor.idle()
        self.wait_copy("excluded")
        self.editor.kill()
        self.start()
        self.editor.click("message.restore")
        self.editor.wait(lambda state: state["open"], "the lost work")
        state = self.editor.idle()
        self.assertEqual(state["edits"]["changes"], before["edits"]["changes"])
        self.assertEqual(state["plan"], before["plan"])
        self.assertTrue(state["unsaved"])
        self.assertEqual(state["history"], before["history"], "undo survives as well")
        self.assertEqual(len(state["history"]), 3)
        self.editor.point("viewport")
        self.editor.key("ctrl+z")
        self.editor.key("ctrl+z")
        state = self.editor.idle()
        self.assertEqual(state["plan"], planned)
        self.assertEqual(state["parameters"]["viewpoints"]["fill"], 0.72)
        self.editor.key("ctrl+shift+z")
        self.assertEqual(self.editor.idle()["parameters"]["viewpoints"]["fill"], 0.45)

    def test_an_error_is_told_before_what_an_earlier_editor_left(self):
        self.start_room()
        self.set_parameter("fill", "0.45")
        self.wait_copy('"fill": 0.45')
        self.editor.kill()
        broken = self.folder / "broken.glb"
        broken.write_text("no model")
        self.start()
        self.editor.item("message.later")
        self.editor.drop(broken)
        time.sleep(0.5)
        self.assertIn("message.later", self.editor.items())
        self.dismiss("later")
        self.assertIn("Cannot open broken.glb", self.notice())
        self.dismiss("ok")

    def test_a_copy_whose_history_is_damaged_says_so(self):
        self.start_room()
        self.set_parameter("fill", "0.45")
        self.wait_copy('"fill": 0.45')
        self.editor.kill()
        for copy in (self.folder / "home" / "state" / "dollytrack" / "autosave").glob("*.dolly"):
            content = json.loads(copy.read_text())
            content["autosave"]["history"]["steps"][1]["changes"] = 7
            copy.write_text(json.dumps(content))
        self.start()
        self.editor.click("message.restore")
        self.editor.wait(lambda state: state["open"], "the lost work")
        self.assertIn("without its undo history", self.notice())
        state = self.editor.idle()
        self.assertEqual(state["parameters"]["viewpoints"]["fill"], 0.45)
        self.assertEqual(len(state["history"]), 1)

    def test_a_copy_that_cannot_be_written_is_tried_again(self):
        copies = self.folder / "home" / "state" / "dollytrack" / "autosave"
        copies.parent.mkdir(parents=True)
        copies.write_text("in the way, as a full disk would be")
        self.start_project()
        before = self.editor.state()["log_version"]
        self.set_parameter("fill", "0.45")
        self.editor.wait(lambda state: state["autosaves"] > 0, "the first attempt")
        time.sleep(2)
        state = self.editor.state()
        self.assertEqual(state["autosaves"], 1, "not at once again")
        self.assertLessEqual(state["log_version"] - before, 4)
        copies.unlink()
        self.editor.wait(lambda state: state["autosaves"] > 1, "the second attempt", 20)
        self.wait_copy('"fill": 0.45')

    def test_restored_work_does_not_overwrite_what_was_saved_since(self):
        self.start_project()
        self.set_parameter("fill", "0.45")
        self.editor.wait(lambda state: state["autosaves"] > 0, "a copy")
        self.wait_copy('"fill": 0.45')
        self.editor.kill()
        subprocess.run([Programs.command_line, "-q", "edit", self.project, "--op",
                        '{"op": "exclude", "object": "sofa"}'],
                       check=True, stdout=subprocess.DEVNULL)
        theirs = self.project.read_bytes()
        self.start()
        self.editor.click("message.restore")
        self.editor.wait(lambda state: state["open"], "the lost work")
        self.editor.idle()
        self.editor.wait(lambda state: state["file_changed"], "the newer file to be noticed", 20)
        self.try_to_save()
        self.dismiss("cancel")
        self.assertEqual(self.project.read_bytes(), theirs)

    def test_save_over_another_file_after_being_asked(self):
        self.changed_room()
        project = self.folder / "kept.dolly"
        project.write_text("something else")
        self.editor.key("ctrl+shift+s")
        self.editor.choose_file(project)
        self.editor.click("message.replace")
        self.editor.wait(lambda state: not state["unsaved"], "the project to be saved")
        self.assertEqual(json.loads(project.read_text())["dollytrack_project"], 1)
