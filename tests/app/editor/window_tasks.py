"""The window itself: its size, its theme, help and the log."""
import json
import time

from screen import Screen
from task import Task


class Window(Task):
    def assertInside(self, size):
        """Checks that no clickable widget is cut off by the window's edge."""
        state = self.editor.state()
        for name, (left, top, right, bottom, *_) in state["items"].items():
            self.assertTrue(left >= -0.5 and top >= -0.5 and right <= size[0] + 0.5 and
                            bottom <= size[1] + 0.5, f"{name} {left, top, right, bottom}")
        return state["items"]

    def test_resize_the_window(self):
        self.start_room()
        large = None
        for size in ((1920, 1080), (1280, 720), (800, 500)):
            self.editor.resize(*size)
            self.editor.wait(lambda state: not state["busy"]["drawing"], "the picture")
            items = self.assertInside(size)
            for name in ("menu.file", "menu.help", "tab.parameters", "tab.objects",
                         "tab.timeline", "tab.log", "timeline.play", "viewport",
                         "parameters.filter"):
                self.assertIn(name, items, size)
            left, top, right, bottom = items["viewport"][:4]
            self.assertGreater(right - left, 250, size)
            self.assertGreater(bottom - top, 100, size)
            large = large or items
        self.assertGreater(large["viewport"][2] - large["viewport"][0], 1000)

    def test_the_preview_covers_the_viewport_only_when_it_floats(self):
        self.start_room(size=(1280, 720))

        def covers(items):
            left, top, right, bottom = items["viewport"][:4]
            picture = items["preview.picture"][:4]
            return (picture[0] < right and picture[2] > left and
                    picture[1] < bottom and picture[3] > top)
        self.editor.item("preview.picture")
        self.assertFalse(covers(self.assertInside((1280, 720))))
        self.editor.click("preview.dock")
        self.assertTrue(covers(self.editor.items()))
        time.sleep(1.0)  # the settings are stored
        self.editor.kill()
        state = self.start_room(size=(1280, 720))
        self.editor.item("preview.picture")
        self.assertFalse(state["preview"]["docked"], "it still floats")
        self.editor.click("preview.dock")
        self.assertFalse(covers(self.editor.items()))
        # The export form needs the width.
        state = self.editor.click("tab.export")
        self.assertNotIn("preview.picture", state["items"])
        self.assertIn("export.modality.rgb", state["items"])

    def test_dialogs_fit_into_a_small_window(self):
        self.start_room(size=(800, 500))
        self.editor.key("ctrl+o")
        self.editor.item("files.accept")
        self.assertInside((800, 500))
        self.editor.click("files.cancel")
        self.editor.key("F1")
        self.editor.item("help.filter")
        self.assertInside((800, 500))

    def test_a_killed_editor_remembers_what_was_set(self):
        self.start_room()
        self.editor.menu("window", "window.light")
        strips = {name for name in self.editor.items() if name.startswith("timeline.strip.")}
        state = self.editor.drag("splitter.left", (400, 300))
        width = state["items"]["viewport"][0]
        self.show_preview(False)
        self.editor.key("F4")
        state = self.editor.key("F3")
        layers = {key: state["layers"][key] for key in ("points", "roadmap", "trajectory")}
        self.assertEqual(layers, {"points": False, "roadmap": True, "trajectory": True})
        for tab in ("tab.layers", "tab.metrics", "tab.log"):
            self.editor.click(tab)
        time.sleep(1.0)
        self.editor.kill()
        state = self.start_room()
        self.assertEqual(state["theme"], "light")
        self.assertAlmostEqual(state["items"]["viewport"][0], width, delta=1)
        self.assertEqual(state["recent"], [str(self.room)])
        self.assertEqual(strips, {name for name in state["items"]
                                  if name.startswith("timeline.strip.")})
        self.assertEqual(layers, {key: state["layers"][key] for key in layers})
        self.assertFalse(state["preview"]["open"])
        for name in ("layers.grid", "log.copy"):
            self.assertIn(name, state["items"], "the tab that was in front")
        self.assertNotIn("parameters.filter", state["items"], "the metrics are in front")
        self.assertIn("parameters.filter", self.editor.click("tab.parameters")["items"])

    def test_panels_move_to_other_sides_and_stay_there(self):
        def side(name, items):
            left, top = items[f"tab.{name}"][:2]
            if top > items["viewport"][3]:
                return "bottom"
            return "left" if left < items["viewport"][0] else "right"

        def tabs(*names):
            """Waits until rows of tabs that have changed are there again."""
            return self.editor.wait(lambda state: all(f"tab.{name}" in state["items"]
                                                      for name in names), names)["items"]
        self.start_room(size=(1280, 720))
        self.assertEqual(side("log", tabs("log")), "bottom")
        # Onto a side: the last tab there, and in front.
        self.editor.drag("tab.log", (120, 400))
        items = tabs("log", "timeline")
        self.assertEqual(side("log", items), "left")
        self.editor.item("log.copy")
        # Before another tab of a row.
        left, top = items["tab.algorithm"][:2]
        self.editor.drag("tab.metrics", (left + 3, top + 5))
        items = tabs("timeline", "metrics", "algorithm")
        self.assertLess(items["tab.timeline"][0], items["tab.metrics"][0])
        self.assertLess(items["tab.metrics"][0], items["tab.algorithm"][0])
        # A tab that is dropped in the viewport stays where it was.
        self.editor.drag("tab.layers", "viewport")
        items = tabs("layers")
        self.assertEqual(side("layers", items), "left")
        # By the menu of a tab; a side without panels gives its room to the viewport.
        wide = items["viewport"][2]
        self.editor.click("tab.parameters", button="right")
        self.editor.click("place.bottom")
        self.editor.click("tab.selection", button="right")
        self.editor.click("place.hidden")
        items = tabs("parameters")
        self.assertEqual(side("parameters", items), "bottom")
        self.assertNotIn("tab.selection", items)
        self.assertGreater(items["viewport"][2], wide + 100)
        # An empty side takes panels at the border of the window.
        self.editor.drag("tab.history", (1275, items["viewport"][1] + 100))
        self.assertEqual(side("history", tabs("history", "log")), "right")
        self.assertInside((1280, 720))
        settings = self.editor.home / "config/dollytrack/editor.json"

        def stored(_):
            if not settings.exists():
                return False
            panels = json.loads(settings.read_text())["layout"]["panels"]
            return panels["hidden"] == ["Selection"] and "History" in panels["right"]
        self.editor.wait(stored, "the settings to be stored")
        self.editor.kill()
        self.start_room(size=(1280, 720))
        items = tabs("log", "history", "parameters")
        self.assertEqual([side(name, items) for name in ("log", "history", "parameters")],
                         ["left", "right", "bottom"])
        self.assertNotIn("tab.selection", items)
        self.editor.menu("window", "window.standard_panels")
        items = tabs("log", "history", "selection")
        self.assertEqual([side(name, items) for name in ("log", "history", "selection")],
                         ["bottom", "left", "right"])

    def test_light_theme_and_larger_text_are_remembered(self):
        self.start_room()
        dark = self.editor.picture()
        height = self.height_of("parameters.filter")
        self.editor.menu("window", "window.light")
        self.editor.key("ctrl+=")
        self.editor.key("ctrl+=")
        state = self.editor.state()
        self.assertEqual(state["theme"], "light")
        self.assertGreater(state["zoom"], 1.15)
        self.assertGreater(self.height_of("parameters.filter"), height)
        light = self.editor.picture()
        self.assertGreater(sum(light[2]) / len(light[2]), sum(dark[2]) / len(dark[2]) + 40)
        self.editor.tap("ctrl+q")
        self.assertEqual(self.editor.wait_end(), 0)
        self.editor.tidy()
        state = self.start_room()
        self.assertEqual(state["theme"], "light")
        self.assertGreater(state["zoom"], 1.15)

    def test_zoom_with_the_keys_of_any_keyboard(self):
        self.start()
        for chord in ("ctrl+=", "ctrl+shift+=", "ctrl+numplus"):
            before = self.editor.state()["zoom"]
            self.assertGreater(self.editor.key(chord)["zoom"], 1.05 * before, chord)
        for chord in ("ctrl+-", "ctrl+numminus"):
            before = self.editor.state()["zoom"]
            self.assertLess(self.editor.key(chord)["zoom"], before / 1.05, chord)

    def test_fold_the_legend_and_find_it_folded_again(self):
        self.start_room(size=(1600, 900))  # a small window folds it by itself
        open_one = self.height_of("legend")
        self.editor.click("legend.title")
        folded = self.height_of("legend")
        self.assertLess(folded, open_one / 3)
        self.editor.tap("ctrl+q")
        self.assertEqual(self.editor.wait_end(), 0)
        self.editor.tidy()
        self.start_room(size=(1600, 900))
        self.assertEqual(self.height_of("legend"), folded)

    def height_of(self, name):
        item = self.editor.item(name)
        return item[3] - item[1]

    def test_a_screen_of_4k_is_drawn_large(self):
        with_4k = Screen(3840, 2160)
        self.addCleanup(with_4k.close)
        self.screen = with_4k
        state = self.start(size=(1280, 720))
        self.assertEqual(state["scale"], 2.0)
        self.assertEqual(state["window"], [1280, 720], "in units of 96 dots per inch")
        left, _, right, _ = self.editor.item("viewport")[:4]
        self.assertGreater(right - left, 1200, "px")

    def test_read_the_help(self):
        self.start()
        self.assertTrue(self.editor.key("F1")["dialogs"]["help"])
        self.editor.item("help.filter")
        self.assertFalse(self.editor.key("esc")["dialogs"]["help"])

    def test_copy_the_log(self):
        self.start()
        broken = self.folder / "broken.obj"
        broken.write_text("v nothing\n")
        self.editor.drop(broken)
        self.notice()
        self.dismiss("ok")
        self.editor.click("tab.log")
        self.editor.click("log.copy")
        self.assertIn("broken.obj", self.editor.clipboard())

    def test_hide_the_panels(self):
        self.start_room()
        before = self.editor.item("viewport")
        for side in ("left", "right", "bottom"):
            self.editor.menu("window", "window." + side)
        after = self.editor.item("viewport")
        self.assertGreater(after[2] - after[0], before[2] - before[0] + 300)
        self.assertGreater(after[3] - after[1], before[3] - before[1] + 100)

    def test_drag_the_border_of_a_panel(self):
        self.start_room()
        x, y = self.editor.middle("splitter.left")
        before = self.editor.item("viewport")[0]
        self.editor.drag((x, y), (x + 60, y))
        self.assertAlmostEqual(self.editor.item("viewport")[0], before + 60, delta=4)

    def test_the_export_form_has_its_own_height(self):
        self.start_room(size=(1280, 900))

        def height():
            return 900 - self.editor.middle("splitter.bottom")[1]

        def drag(by):
            x, y = self.editor.middle("splitter.bottom")
            before = height()
            self.editor.drag((x, y), (x, y - by))
            self.assertAlmostEqual(height(), before + by, delta=4)
        timeline = height()
        self.editor.click("tab.export")
        self.assertGreater(height(), timeline + 50)
        drag(-60)
        drag(90)
        export = height()
        self.editor.click("tab.timeline")
        self.assertEqual(height(), timeline)
        drag(40)
        self.editor.click("tab.export")
        self.assertEqual(height(), export)
        time.sleep(1.0)  # the settings are stored
        self.editor.kill()
        self.start_room(size=(1280, 900))
        self.editor.item("tab.export")
        self.assertAlmostEqual(height(), export, delta=1)
        self.editor.click("tab.timeline")
        self.assertAlmostEqual(height(), timeline + 40, delta=5)
