"""Everything that can be shown fits: every panel, dialog and menu, in windows of three sizes and in
both themes."""
import shutil

from screen import Screen
from task import Task

SIZES = ((2560, 1440), (1280, 720), (1024, 700))  # the largest first: it shows most
SIDES = ("left", "right", "bottom")
# The panels, by the names of their tabs, with the beginning of their widgets' names.
PANELS = {"objects": "objects.", "layers": "layers.", "by hand": "edits.", "history": "history.",
          "parameters": "parameters.", "selection": "selection.", "metrics": "metrics.",
          "timeline": "timeline.", "algorithm": "steps.", "export": "export.", "log": "log."}
MENUS = ("file", "edit", "camera", "view", "layers", "timeline", "window", "help")
# Commands and buttons whose name ends in dots; other texts get them where they are shortened.
DOTTED = ("Add a folder of models", "Open", "Save as", "Use a label file", "Write annotations", "Import a camera path",
          "Save the camera path", "Export the dataset", "Open B", "Choose", "Add projects", "Camera move: orbit",
          "Camera move: arc", "Camera move: dolly", "Camera move: crane", "Camera move: walk",
          "Compare with another project", "Read the scene in another unit")
# The tail of this letter reaches a little over the left edge of its line, where it may be cut.
OVERHANGING = "j"
# Fields and lists whose text scrolls or depends on files and names of the user.
SCROLLING = ("files.path", "files.name", "files.row.", "files.place.", "recent.", "export.folder",
             "log.message", "start.", "status.")
# Marks in drawn areas, which may lie over each other and the area.
MARKS = ("timeline.", "viewport", "legend", "gizmo.", "tracks.", "splitter.", "preview.", "note.",
         "clip.", "steps.", "bar.")
MOST_SCROLLS = 40


class Layout(Task):
    def test_everything_fits_at_every_size_and_in_both_themes(self):
        self.known = {}  # by panel: names and heights in the largest window
        self.faults = []
        for size in SIZES:
            self.screen = Screen(*size)  # a larger screen has a larger scale
            self.addCleanup(self.screen.close)
            self.start_screen(size)
            self.look_at_all(size)
            if size != SIZES[-1]:
                self.editor.kill()
                shutil.rmtree(self.editor.home)  # with the settings
        self.assertEqual(self.faults, [], "\n" + "\n".join(self.faults))

    def start_screen(self, size):
        self.start(size=size)
        self.measure_window()
        self.check(size, "start screen", self.editor.state())
        self.editor.kill()

    def measure_window(self):
        window = self.editor.window.get_geometry()
        self.window = (window.width, window.height)

    def click(self, name):
        """Clicks a widget, reading the state less often than Editor.click(): frames take long in a
        large window that the processor draws."""
        self.editor.point(name)
        self.editor.press()
        self.editor.release()
        return self.editor.state()

    def look_at_all(self, size):
        """One window, first in the dark theme, with all that scrolls, then in the light theme."""
        self.start_room(size=size)
        self.measure_window()
        self.assertEqual(self.window, size)
        self.editor.key("ctrl+a")
        scale = self.editor.state()["scale"]
        for theme in ("dark", "light"):
            if theme == "light":
                self.click("menu.window")
                self.click("command.window.light")
            self.assertEqual(self.editor.state()["theme"], theme)
            for tab in PANELS:
                self.look_at_panel(size, theme, tab, scale)
            self.click("tab.timeline")
            self.click("menu.file")
            for menu in MENUS:  # an open one follows the mouse
                self.editor.move(*self.editor.middle("menu." + menu))
                state = self.editor.state()
                self.assertTrue(any(name.startswith("command.") for name in state["items"]), menu)
                self.check(size, f"{theme} menu {menu}", state, "command.")
            self.editor.key("esc")
            self.look_at_dialogs(size, theme)

    def look_at_panel(self, size, theme, tab, scale):
        state = self.click("tab." + tab)
        what = f"{theme} panel {tab}"
        self.check(size, what, state)
        if theme == "light":
            return
        seen = {}
        for place in self.places_in(tab, state["items"]):
            self.scroll_through(size, what, place, scale, seen)
        known = self.known.setdefault(tab, seen)
        for name, height in known.items():
            if not name.startswith(PANELS[tab]) or name.startswith(MARKS):
                continue
            if name not in seen:
                self.faults.append(f"{size} {what}: {name} is out of reach")
            elif seen[name] < 0.9 * height and height < 60:
                self.faults.append(f"{size} {what}: {name} is {seen[name]:.0f} px high instead of "
                                   f"{height:.0f}")

    def scroll_through(self, size, what, place, scale, seen):
        """Scrolls down to the end; notes the largest visible height of each widget, unscaled."""
        self.editor.move(*place)
        state = self.editor.state()
        for _ in range(MOST_SCROLLS):
            for name, (_, top, _, bottom, *_) in state["items"].items():
                seen[name] = max(seen.get(name, 0), (bottom - top) / scale)
            before = self.places(state)
            for _ in range(2):
                self.editor.press(5)
                self.editor.release(5)
            state = self.editor.state()
            if self.are_same(self.places(state), before):
                break
            self.check(size, what + ", scrolled", state)
        else:
            self.faults.append(f"{size} {what}: it scrolls without end")

    def places(self, state):
        """The rectangles that scrolling moves; those of the status line change with its progress."""
        return {name: item for name, item in state["items"].items()
                if not name.startswith((*MARKS, "status."))}

    @staticmethod
    def are_same(places, before):
        """At the end of a panel, whose height has a fraction of a pixel, rounding moves all by one
        pixel to and fro."""
        return places.keys() == before.keys() and all(
            abs(a - b) < 1.5 for name in places for a, b in zip(places[name][:4], before[name][:4]))

    def places_in(self, tab, items):
        """Where the mouse scrolls the panel; the export form has three parts."""
        left, low = items["tab." + tab][0], items["tab." + tab][3]
        view = items["viewport"]
        if low > view[3]:
            middle = 0.5 * (low + self.window[1])
            across = (0.15, 0.5, 0.85) if tab == "export" else (0.3,)
            return [(share * self.window[0], middle) for share in across]
        middle = 0.5 * (low + view[3])
        right = self.window[0]
        return [(0.5 * view[0] if left < view[0] else 0.5 * (view[2] + right), middle)]

    def look_at_dialogs(self, size, theme):
        for name, keys, item in (("files", "ctrl+o", "files.accept"), ("help", "F1", "help.filter"),
                                 ("palette", "ctrl+p", "palette.text")):
            self.editor.key(keys)
            self.editor.item(item)
            self.check(size, f"{theme} dialog {name}", self.editor.state(), name + ".")
            self.editor.key("esc")
        self.editor.click("tab.parameters", button="right")
        self.check(size, f"{theme} menu of a tab", self.editor.state(), "place")
        self.editor.key("esc")
        self.set_parameter("fill", "0.6" if theme == "dark" else "0.7")
        self.editor.key("ctrl+q")
        self.editor.item("message.cancel")
        self.check(size, f"{theme} question", self.editor.state(), "message.")
        self.editor.key("esc")

    def check(self, size, what, state, only=""):
        """Adds to the faults what is wrong with the rectangles and texts of a state."""
        def fault(text):
            self.faults.append(f"{size} {what}: {text}")
        items = state["items"]
        width, height = self.window
        for name, (left, top, right, bottom, *_) in items.items():
            if left < -0.5 or top < -0.5 or right > width + 0.5 or bottom > height + 0.5:
                fault(f"{name} leaves the window: {left, top, right, bottom}")
        cut = state["cut_text"]
        if cut:  # a tooltip whose text has just changed gets its size in the next frame
            later = {line[0] for line in self.editor.state()["cut_text"]}
            cut = [line for line in cut if line[0] in later]
        for text, left, top, right, bottom in cut:
            rest = text.replace(" ", "")
            for label in DOTTED:
                rest = rest.replace(label.replace(" ", "") + "\u2026", "")
            if "\u2026" in text and "\u2026" not in rest or text.startswith(OVERHANGING):
                continue
            x, y = 0.5 * (left + right), 0.5 * (top + bottom)
            around = [name for name, item in items.items()
                      if item[0] - 2 <= x <= item[2] + 2 and item[1] - 2 <= y <= item[3] + 2]
            if not any(name.startswith(SCROLLING) for name in around):
                fault(f"'{text}' is cut at {left, top, right, bottom}, in {around}")
        controls = [(name, item) for name, item in items.items()
                    if not name.startswith(MARKS) and (not only or name.startswith(only))]
        if not only:
            controls = [one for one in controls if not one[0].startswith("status.")]
        for i, (a, one) in enumerate(controls):
            for b, other in controls[i + 1:]:
                if self.overlap(one, other):
                    fault(f"{a} and {b} overlap: {one[:4]}, {other[:4]}")

    @staticmethod
    def overlap(a, b):
        """Whether two rectangles have more than a border in common, and neither contains the
        other, as a row contains its buttons."""
        across = min(a[2], b[2]) - max(a[0], b[0])
        down = min(a[3], b[3]) - max(a[1], b[1])
        if across <= 1.5 or down <= 1.5:
            return False

        def contains(outer, inner):
            return (outer[0] <= inner[0] + 1.5 and outer[1] <= inner[1] + 1.5 and
                    outer[2] >= inner[2] - 1.5 and outer[3] >= inner[3] - 1.5)
        return not contains(a, b) and not contains(b, a)
