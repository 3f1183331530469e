#!/usr/bin/python3
"""Kills the editor at random moments: little work is lost, and the project always opens."""
import pathlib
import random
import sys
import tempfile
import time

from editor_driver import Editor
from screen import Screen
from task import Programs, plan
from support import tiny_room
import window_arguments

MOST_LOST_S = 30.0


class Crash:
    """One editor that is killed while it is used, and the one that is started after it."""

    def __init__(self, screen, folder, dice):
        self.screen = screen
        self.folder = folder
        self.dice = dice
        self.project = folder / "room.dolly"
        self.changes = [(0.0, 0.72)]  # when, and the fill that was chosen then

    def start(self, *arguments):
        return Editor(Programs.editor, self.screen, *arguments, home=self.folder / "home")

    def work_until_killed(self):
        editor = self.start(self.project)
        try:
            editor.wait(lambda state: state["open"], "the project to open")
            editor.click("parameters.filter")
            editor.type("fill")
            left, top, right, bottom = editor.item("parameters.fill")[:4]
            end = time.monotonic() + self.dice.uniform(0.5, 9.0)
            while time.monotonic() < end:
                editor.move(self.dice.uniform(left + 5, right - 5), (top + bottom) / 2)
                editor.press()
                editor.state()
                editor.release()
                fill = editor.state()["parameters"]["viewpoints"]["fill"]
                self.changes.append((time.monotonic(), fill))
                if self.dice.random() < 0.2:
                    editor.tap("ctrl+s")
                time.sleep(self.dice.uniform(0.0, 0.4))
        finally:
            self.killed_at = time.monotonic()
            editor.kill()

    def look_afterwards(self):
        """Returns the error, or nothing."""
        editor = self.start(self.project)
        try:
            editor.wait(lambda state: state["open"] or state["notice"], "the project to open")
            state = editor.idle()
            if not state["open"]:
                return "the project does not open: " + state["notice"]
            if "message.restore" in state["items"]:
                editor.click("message.restore")
                editor.wait(lambda now: not now["dialogs"]["recovered_work"], "the copy")
                time.sleep(0.2)
                state = editor.idle()
            fill = state["parameters"]["viewpoints"]["fill"]
            return self.judge(fill)
        finally:
            editor.kill()
            for copy in (self.folder / "home" / "state").rglob("*.dolly"):
                copy.unlink()

    def judge(self, fill):
        when = [at for at, value in self.changes if abs(value - fill) < 1e-9]
        if not when:
            return f"a fill of {fill} was never chosen: {self.changes}"
        newer = [at for at, _ in self.changes if at > when[-1]]
        lost = self.killed_at - newer[0] if newer else 0.0
        return f"{lost:.1f} s of work are lost" if lost > MOST_LOST_S else ""


def main():
    arguments = window_arguments.read(__doc__)
    dice = random.Random(arguments.seed)
    screen = Screen(1280, 720)
    try:
        with tempfile.TemporaryDirectory(prefix="kill") as temporary:
            for number in range(40 if arguments.long else 4):
                folder = pathlib.Path(temporary) / str(number)
                folder.mkdir()
                tiny_room.write(folder / "room.obj")
                plan(folder / "room.obj", folder / "room.dolly")
                crash = Crash(screen, folder, dice)
                crash.work_until_killed()
                problem = crash.look_afterwards()
                if problem:
                    sys.exit(f"kill {number} of seed {arguments.seed}: {problem}")
    finally:
        screen.close()


if __name__ == "__main__":
    main()
