"""The start of every task: a screen, a small room and a fresh editor; and the checks after it."""
import json
import math
import pathlib
import subprocess
import tempfile
import unittest

from editor_driver import Editor
from screen import Screen, need_window
from support import tiny_room

# The enumerators of ui/selection.h, which tell the kind of the selection in the state.
NONE, OBJECT, OBJECTS, POSITION_POINT, NO_GO_BOX = 0, 1, 2, 4, 9
# The ids of tiny_room's objects, in the order of its file.
TABLE, MUG, BOOK, SOFA, PICTURE = 7, 8, 9, 10, 11


class Programs:
    """Paths of the programs under test, and how they are shown; set from the command line."""
    editor = ""
    command_line = ""
    size = (1280, 720)  # of windows for which a task does not say one
    screen = (1920, 1080)
    theme = "dark"


def plan(scene, project, *arguments):
    """Plans with the command line; the editor must give the same plan."""
    subprocess.run([Programs.command_line, "-q", "plan", scene, "-o", project, *arguments],
                   check=True, stdout=subprocess.DEVNULL)
    return json.loads(pathlib.Path(project).read_text())


class Task(unittest.TestCase):
    """One task of a user. Each has its own home folder, so nothing is left from the one before."""

    screen = None

    @classmethod
    def setUpClass(cls):
        need_window()
        cls.screen = Screen(*Programs.screen)
        cls.shared = tempfile.TemporaryDirectory(prefix="tasks")
        cls.room = pathlib.Path(cls.shared.name) / "room.obj"
        tiny_room.write(cls.room)

    @classmethod
    def tearDownClass(cls):
        if cls.screen is not None:
            cls.screen.close()
            cls.shared.cleanup()

    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="task")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.editor = None
        self.ends = False  # whether the task ends the editor itself

    def tearDown(self):
        if self.editor is None:
            return
        try:
            if self.ends:
                self.assertEqual(self.editor.wait_end(), 0, self.editor.last_words())
            else:
                self.assertTrue(self.editor.alive(), self.editor.last_words())
                self.assertEqual(self.editor.state()["gl_errors"], 0)
        finally:
            self.editor.kill()

    def start(self, *arguments, size=None):
        """Starts an editor with the given arguments and waits until it is ready."""
        settings = self.folder / "home/config/dollytrack/editor.json"
        if Programs.theme != "dark" and not settings.exists():
            settings.parent.mkdir(parents=True)
            settings.write_text(json.dumps({"theme": Programs.theme}))
        self.editor = Editor(Programs.editor, self.screen, *arguments,
                             home=self.folder / "home", size=size or Programs.size)
        self.addCleanup(self.editor.kill)
        if arguments:
            self.editor.wait(lambda state: state["open"] or state["notice"], "something to open")
        return self.editor.idle()

    def start_room(self, **options):
        state = self.start(self.room, **options)
        self.assertEqual(state["plan"]["objects"], 5)
        return state

    def start_project(self, *arguments):
        """Starts with a room planned by the command line; returns the project that it wrote."""
        self.project = self.folder / "room.dolly"
        saved = plan(self.room, self.project, *arguments)
        self.start(self.project)
        return saved

    def find_parameter(self, name):
        """Shows one parameter by searching for it."""
        self.editor.click("tab.parameters")
        self.editor.click("parameters.filter")
        self.editor.key("ctrl+a")
        self.editor.type(name)
        self.editor.item("parameters." + name)
        return "parameters." + name

    def set_parameter(self, name, text):
        self.editor.type_value(self.find_parameter(name), text)
        return self.editor.idle()

    def dismiss(self, button):
        """Answers the visible message box."""
        self.editor.click("message." + button)
        return self.editor.wait(lambda state: "message." + button not in state["items"],
                                "the message to go")

    def notice(self):
        return self.editor.wait(lambda state: state["notice"], "a message")["notice"]

    def place_of(self, point):
        """The position of a scene point in the window."""
        state = self.editor.state()
        camera = state["camera"]
        left, top, right, bottom = state["items"]["viewport"][:4]
        azimuth, elevation = camera["azimuth"], camera["elevation"]
        back = (math.cos(elevation) * math.cos(azimuth), math.cos(elevation) * math.sin(azimuth),
                math.sin(elevation))
        right_way = (-math.sin(azimuth), math.cos(azimuth), 0.0)
        forward = tuple(-x for x in back)
        down = (forward[1] * right_way[2] - forward[2] * right_way[1],
                forward[2] * right_way[0] - forward[0] * right_way[2],
                forward[0] * right_way[1] - forward[1] * right_way[0])
        eye = [p + camera["distance"] * b for p, b in zip(camera["pivot"], back)]
        offset = [a - b for a, b in zip(point, eye)]

        def along(way):
            return sum(a * b for a, b in zip(offset, way))
        width = right - left
        focal = 0.5 * width / math.tan(math.radians(25.0))
        depth = along(forward) if not camera["orthographic"] else camera["distance"]
        self.assertGreater(depth, 0.0, "the point is behind the camera")
        return (round(left + 0.5 * width + focal * along(right_way) / depth),
                round(top + 0.5 * (bottom - top) + focal * along(down) / depth))

    def without_layers(self):
        """Shows only the scene, so that a click hits objects; the preview would cover some of
        them."""
        self.show_preview(False)
        for key, layer in (("F3", "points"), ("F5", "trajectory")):
            if self.editor.state()["layers"][layer]:
                self.editor.key(key)
        state = self.editor.state()
        self.assertFalse(state["layers"]["points"] or state["layers"]["trajectory"])

    def show_preview(self, wanted):
        if self.editor.state()["preview"]["open"] != wanted:
            self.editor.click("preview.fold")
        self.assertEqual(self.editor.state()["preview"]["open"], wanted)

    def wait_picture(self):
        """Waits until the viewport's image is up to date."""
        serial = self.editor.state()["picture_serial"]
        self.editor.wait(lambda state: state["picture_serial"] > serial or
                         not state["busy"]["drawing"], "a picture", 20)
        return self.editor.state()

    def select_row(self, object_id):
        self.editor.click("tab.objects")
        left, top, _, bottom = self.editor.item(f"objects.row.{object_id}")[:4]
        self.editor.click((left + 30, (top + bottom) / 2))
        state = self.editor.wait(lambda state: state["selected"] == [object_id], "the selection")
        return state

    def select_position_point(self, place):
        """Clicks a position point in the viewport, with all other layers hidden."""
        state = self.editor.state()
        if state["layers"]["trajectory"]:
            self.editor.key("F5")
        self.show_preview(False)
        self.editor.key("7")  # from above, where points rarely hide one another
        self.wait_picture()
        self.editor.click(self.place_of(place))
        return self.editor.wait(lambda state: state["selection_kind"] == POSITION_POINT,
                                "the position point to be selected", 10)
