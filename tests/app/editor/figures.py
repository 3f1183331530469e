#!/usr/bin/python3
"""Prints how quickly the editor follows changes. Not a test: times depend on the machine.

Usage: figures.py EDITOR SCENE
"""
import pathlib
import sys
import tempfile

from editor_driver import Editor, Screen

REPEATS = 5


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
    """A value beside the one there is, another each time."""
    if isinstance(value, int):
        return str(value + 1 + turn) if value else str(20 + turn)
    return f"{(value or 0.2) * (0.9 - 0.02 * turn):.4f}"


def measure(editor, name, value, repeats):
    """ms from each change to its trajectory in the window."""
    times = []
    item = show(editor, name)
    for turn in range(repeats):
        if isinstance(value, str):
            editor.click(item)
            offered = sorted(one for one in editor.items() if one.startswith("choice."))
            editor.click(offered[turn % len(offered)])
        else:
            editor.type_value(item, other_value(value, turn))
        state = editor.idle(300)
        times.append(state["latency_ms"])
    editor.click(item + ".reset")
    editor.idle(300)
    return times


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
    program, scene = sys.argv[1:3]
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
                repeats = REPEATS if name == "corner_distance_m" else 2
                times = sorted(measure(editor, name, value, repeats))
                print(f"  {name:24} median {times[len(times) // 2]:8.1f} ms   "
                      f"most {times[-1]:8.1f} ms", flush=True)
            print(f"  longest frame while planning {longest_frame(editor):.1f} ms", flush=True)
        finally:
            editor.kill()
            screen.close()


if __name__ == "__main__":
    main()
