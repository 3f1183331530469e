#!/usr/bin/python3
"""Prints how quickly the editor follows changes. Not a test: times depend on the machine.

Usage: figures.py EDITOR SCENE [PARAMETER...]
"""
import pathlib
import sys
import tempfile
import time

from editor_driver import Editor
from screen import Screen

REPEATS = 5
UNWATCHED_S = 2.0  # reading the state draws frames, which would slow down the measured work


def sections(state):
    return [(section, name, value) for section, fields in state["parameters"].items()
            for name, value in fields.items()]


def show(editor, name):
    editor.click("tab.parameters")
    editor.click("parameters.filter")
    editor.key("ctrl+a")
    editor.type(name)
    editor.item("parameters." + name)
    return "parameters." + name


def other_value(value, turn):
    """A value near the current one, a different one each time."""
    if isinstance(value, int):
        return str(value + 1 + turn) if value else str(20 + turn)
    return f"{(value or 0.2) * (0.9 - 0.02 * turn):.4f}"


def measure(editor, name, value, repeats):
    """ms from each typed change to its trajectory in the window."""
    times = []
    item = show(editor, name)
    for turn in range(repeats):
        if isinstance(value, str):
            editor.click(item)
            offered = sorted(one for one in editor.items() if one.startswith("choice."))
            editor.click(offered[turn % len(offered)])
        else:
            editor.type_value(item, other_value(value, turn))
        time.sleep(UNWATCHED_S)
        state = editor.idle(300)
        times.append(state["latency_ms"])
    if editor.has(item + ".reset"):  # a choice may be back at its standard value
        editor.click(item + ".reset")
    editor.idle(300)
    return times


def from_rest(editor, name):
    """ms from one jump of a slider, made while nothing runs, to its trajectory."""
    times = []
    left, top, right, bottom = editor.item(show(editor, name))[:4]
    middle = (top + bottom) / 2
    for turn in range(REPEATS):
        editor.point((left + 0.3 * (right - left), middle))
        editor.press()
        editor.state()
        editor.move(left + (0.35 + 0.05 * turn) * (right - left), middle)  # in one go
        time.sleep(UNWATCHED_S)
        times.append(editor.idle(300)["latency_ms"])
        editor.release()
    editor.click("parameters." + name + ".reset")
    editor.idle(300)
    return sorted(times)


def longest_frame(editor):
    """The longest frame while a slider is dragged and planning runs without a pause, ms."""
    left, top, right, bottom = editor.item(show(editor, "fill"))[:4]
    middle = (top + bottom) / 2
    longest = []
    editor.state()
    editor.drag((left + 0.7 * (right - left), middle), (left + 0.4 * (right - left), middle),
                steps=40, look=lambda state: longest.append(state["longest_frame_ms"]))
    editor.idle(300)
    return max(longest)


def main():
    program, scene, *wanted = sys.argv[1:]
    screen = Screen(1280, 720)
    with tempfile.TemporaryDirectory(prefix="figures") as home:
        editor = Editor(program, screen, pathlib.Path(scene).absolute(), home=home)
        try:
            state = editor.wait(lambda now: now["open"] or now["notice"], "the scene", 300)
            if not state["open"]:
                sys.exit(state["notice"])
            editor.idle(300)
            state = editor.wait(lambda now: not now["busy"]["lighting"], "the light", 300)
            print(f"{scene}: {len(state['objects'])} objects, {state['plan']['frames']} frames")
            for _, name, value in sections(state):
                if wanted and name not in wanted:
                    continue
                repeats = REPEATS if name == "corner_distance_m" else 2
                times = sorted(measure(editor, name, value, repeats))
                print(f"  {name:24} median {times[len(times) // 2]:8.1f} ms   "
                      f"most {times[-1]:8.1f} ms", flush=True)
            times = from_rest(editor, "corner_distance_m")
            print(f"  corner_distance_m from rest: median {times[len(times) // 2]:.1f} ms"
                  f"   most {times[-1]:.1f} ms", flush=True)
            print(f"  longest frame while planning {longest_frame(editor):.1f} ms", flush=True)
        finally:
            editor.kill()
            screen.close()


if __name__ == "__main__":
    main()
