"""The start screen, which is shown while nothing is open."""
import shutil

import cv2

from task import Task


class Starting(Task):
    def started(self, recent):
        """Waits until the start screen shows this number of recent files, with all about them."""
        def ready(now):
            files = [one for one in now["items"] if one.startswith("start.recent.") and
                     one.count(".") == 2]
            return now["start"]["shown"] and now["start"]["ready"] and len(files) == recent
        return self.editor.wait(ready, f"{recent} recent files")

    def opened(self, name):
        state = self.editor.wait(lambda now: now["open"] and not now["start"]["shown"], name)
        self.assertIn(name, state["title"])
        return self.editor.idle()

    def start_with_two_projects(self):
        """Opens and closes two projects, so that the start screen lists them."""
        self.start_project("--set", "width_px=160", "--set", "height_px=120", "--max-frames", "12")
        self.other = self.folder / "other.dolly"
        shutil.copy(self.project, self.other)
        self.wait_picture()
        self.editor.menu("file", "file.close")
        self.started(1)
        self.editor.key("ctrl+o")
        self.editor.choose_file(self.other)
        self.opened("other")
        self.wait_picture()
        self.editor.key("ctrl+w")
        return self.started(2)

    def test_recent_projects_are_shown_with_their_pictures(self):
        state = self.start_with_two_projects()
        files = state["start"]["files"][:2]
        self.assertEqual([one["path"] for one in files], [str(self.other), str(self.project)])
        self.assertEqual([one["picture"] for one in files], [True, True])
        self.assertEqual([one["missing"] for one in files], [False, False])
        pictures = list((self.folder / "home/state/dollytrack/thumbnails").glob("*.png"))
        self.assertEqual(len(pictures), 2)
        for file in pictures:
            picture = cv2.imread(str(file))
            self.assertEqual(picture.shape, (120, 192, 3))
            self.assertGreater(picture.std(), 5, "not an empty picture")
        self.editor.click("start.recent.1")
        self.opened("room")

    def test_a_project_is_opened_with_the_keyboard(self):
        self.start_with_two_projects()
        self.editor.key("down")
        self.editor.key("up")
        state = self.editor.key("right")  # beside or below, by the width of the window
        if state["start"]["chosen"] != 1:
            state = self.editor.key("down")
        self.assertEqual(state["start"]["chosen"], 1)
        self.editor.tap("enter")
        self.opened("room")

    def test_a_missing_file_is_greyed_and_removed_from_the_list(self):
        self.start_with_two_projects()
        self.editor.kill()
        self.other.unlink()
        self.start()
        state = self.started(2)
        self.assertEqual([one["missing"] for one in state["start"]["files"][:2]], [True, False])
        self.assertFalse(state["items"]["start.recent.0"][4], "it cannot be opened")
        state = self.editor.key("enter")
        self.assertFalse(state["busy"]["loading"] or state["open"])
        self.editor.click("start.recent.0.remove")
        self.assertEqual(self.started(1)["recent"], [str(self.project)])
        self.assertTrue(self.project.exists())
        self.editor.tap("ctrl+q")
        self.assertEqual(self.editor.wait_end(), 0)
        self.start()
        self.assertEqual(self.started(1)["recent"], [str(self.project)], "also after a restart")
        self.assertEqual(self.editor.key("down")["start"]["chosen"], 1, "it has the keyboard")

    def test_a_damaged_picture_is_left_out(self):
        self.start_with_two_projects()
        self.editor.kill()
        for file in (self.folder / "home/state/dollytrack/thumbnails").glob("*.png"):
            file.write_bytes(file.read_bytes()[:200])
        self.start()
        files = self.started(2)["start"]["files"][:2]
        self.assertEqual([one["picture"] for one in files], [False, False])
        self.editor.click("start.recent.0")
        self.opened("other")

    def test_saving_stores_a_picture_and_a_first_start_has_none(self):
        state = self.start()
        self.assertTrue(state["start"]["shown"])
        self.started(0)
        self.editor.drop(self.room)
        self.opened("room")
        self.wait_picture()
        self.editor.key("ctrl+s")
        project = self.folder / "saved.dolly"
        self.editor.choose_file(project)
        self.editor.wait(lambda now: now["project"] == str(project) and
                         not now["busy"]["saving"], "the project to be saved")
        self.editor.wait(lambda now: list((self.folder / "home/state/dollytrack/thumbnails")
                                          .glob("*.png")), "its picture")

    def test_the_built_in_apartment_is_one_click_away(self):
        self.start()
        self.started(0)
        self.editor.click("start.example")
        self.opened("apartment")
        self.assertEqual(self.editor.state()["recent"], [], "it has a row of its own")

    def test_open_a_file_from_the_start_screen(self):
        self.start()
        self.started(0)
        self.editor.click("start.open")
        self.editor.choose_file(self.room)
        self.opened("room")
