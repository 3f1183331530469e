#!/usr/bin/python3
"""Seeded random mouse and key events: no crash, no OpenGL error, no growing memory."""
import pathlib
import random
import sys
import tempfile

from editor_driver import Editor, Gone
from screen import Screen
from task import Programs
from support import tiny_room
import window_arguments

SIZE = (1100, 700)
# All keys except those that end the editor or open other folders of the machine.
KEYS = ["0", "1", "3", "5", "7", "ctrl+1", "ctrl+3", "ctrl+7", "f", "home", "h", "alt+h", "x",
        "shift+x", "n", "p", "l", "del", "c", "space", "left", "right", "shift+left",
        "shift+right", "ctrl+z", "ctrl+z", "ctrl+shift+z", "ctrl+y", "ctrl+=", "ctrl+-", "F1",
        "F2", "F3", "F4", "F5", "F6", "F7", "F8", "ctrl+p", "ctrl+o", "ctrl+e", "ctrl+s",
        "ctrl+r", "esc", "esc", "esc", "enter", "tab", "up", "down", "a", "9", "backspace", "g", "g",
        "r", "y", "z", "-", ".", "b", "alt+b", "/"]
# Widgets to avoid: the exit, settings that take minutes to plan, and image sizes, which decide how
# much memory rendering takes.
AVOIDED = ("command.file.quit", "files.place.", "files.up", "files.new_folder", "files.make",
           "parameters.octree_resolution_m", "parameters.link_iterations", "parameters.width_px",
           "parameters.height_px", "export.width_px", "export.height_px", "export.add",
           "command.window.fullscreen")


class Monkey:
    def __init__(self, editor, seed):
        self.editor = editor
        self.dice = random.Random(seed)
        self.items = {}
        self.done = []  # the newest events, for the report

    def place(self):
        """A random position, mostly on something that can be clicked."""
        names = [name for name in sorted(self.items) if not name.startswith(AVOIDED)]
        if names and self.dice.random() < 0.75:
            left, top, right, bottom = self.items[self.dice.choice(names)][:4]
            return (self.dice.uniform(left, max(right - 1, left)),
                    self.dice.uniform(top, max(bottom - 1, top)))
        return self.dice.uniform(1, SIZE[0] - 2), self.dice.uniform(1, SIZE[1] - 2)

    def avoided(self, place):
        return any(name.startswith(AVOIDED) and item[0] <= place[0] <= item[2] and
                   item[1] <= place[1] <= item[3] for name, item in self.items.items())

    def event(self):
        """One random action of a user; returns its number of events."""
        kind = self.dice.choices(["click", "drag", "key", "wheel", "type"], [10, 5, 8, 4, 1])[0]
        self.done = self.done[-30:] + [kind]
        if kind == "key":
            chord = self.dice.choice(KEYS)
            self.done[-1] += " " + chord
            self.editor.tap(chord)
            return 2
        if kind == "type":
            self.editor.type(self.dice.choice(["0.5", "so", "-3", "1e9", "wall"]))
            return 2
        place = self.place()
        if self.avoided(place):
            return 0
        self.done[-1] += f" {place[0]:.0f},{place[1]:.0f}"
        self.editor.move(*place)
        button = self.dice.choices(["left", "middle", "right"], [8, 1, 1])[0]
        if kind == "wheel":
            notch = self.dice.choice([4, 5])
            self.editor.press(notch)
            self.editor.release(notch)
            return 2
        self.editor.press(button)
        if kind == "drag":
            for _ in range(self.dice.randint(2, 6)):
                self.editor.move(self.editor.mouse[0] + self.dice.uniform(-60, 60),
                                 self.editor.mouse[1] + self.dice.uniform(-60, 60))
        self.editor.release(button)
        return 3


def run(events, seed, folder):
    screen = Screen(*SIZE)
    room = folder / "room.obj"
    tiny_room.write(room)
    editor = Editor(Programs.editor, screen, room, home=folder / "home", size=SIZE)
    monkey = Monkey(editor, seed)
    warm = 0.0
    count = 0
    most = 0.0
    try:
        editor.idle()
        while count < events:
            for _ in range(5):
                count += monkey.event()
            state = editor.state()
            monkey.items = state["items"]
            if state["gl_errors"] != 0:
                return f"{state['gl_errors']} OpenGL errors"
            if not state["open"] and not state["busy"]["loading"]:
                editor.key("esc")
                editor.drop(room)
            most = max(most, editor.memory_mb())
            if warm == 0.0 and count > events / 3:
                warm = most
        editor.key("esc")
        editor.key("esc")
        editor.state()
        # Memory after a third of the events must suffice for the rest: undo steps take little.
        if editor.memory_mb() > 1.3 * warm + 60:
            return f"memory grew from {warm:.0f} to {editor.memory_mb():.0f} MB"
        print(f"{count} events, at most {most:.0f} MB, {editor.memory_mb():.0f} MB at the end")
        return ""
    except (Gone, AssertionError) as problem:
        # It may hit the exit in a menu that opened between two reads of the state: that is not a
        # crash.
        if isinstance(problem, Gone) and count > 0 and editor.wait_end() == 0:
            print(f"it quit after {count} events")
            return run(events - count, seed + 1, folder) if events > count else ""
        return f"after {count} events: {problem}; the last: {monkey.done}"
    finally:
        editor.kill()
        screen.close()


def main():
    arguments = window_arguments.read(__doc__)
    with tempfile.TemporaryDirectory(prefix="monkey") as folder:
        problem = run(20000 if arguments.long else 1000, arguments.seed, pathlib.Path(folder))
    if problem:
        sys.exit(f"seed {arguments.seed}: {problem}")


if __name__ == "__main__":
    main()
