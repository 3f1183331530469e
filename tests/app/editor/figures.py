#!/usr/bin/python3
"""Prints how quickly the editor follows changes. Not a test: times depend on the machine.

Usage: figures.py EDITOR SCENE [PARAMETER...]
"""
import os
import pathlib
import sys
import tempfile
import time

from editor_driver import Editor
from screen import Screen

REPEATS = 5
DRAG_S = 20.0
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


def told(states):
    """The longest window frame of some states, and where its time went."""
    longest = max(states, key=lambda state: state["longest_frame_ms"])
    parts = longest["longest_frame"]
    middle = sorted(state["longest_frame_ms"] for state in states)[len(states) // 2]
    return (f"{longest['longest_frame_ms']:.0f} ms (widgets {parts['widgets_ms']:.0f}, OpenGL "
            f"commands {parts['draw_ms']:.0f}, until drawn {parts['swap_ms']:.0f}; processor time "
            f"of the window's thread {parts['processor_ms']:.0f}); median of {len(states)} "
            f"intervals {middle:.0f} ms")


def drag_while_playing(editor, name):
    """Drags a slider to and fro while the trajectory plays; the longest frame by intervals."""
    left, top, right, bottom = editor.item(show(editor, name))[:4]
    editor.click("tab.timeline")
    editor.click("timeline.play")
    editor.point((left + 0.5 * (right - left), (top + bottom) / 2))
    editor.press()
    states = []
    editor.state()
    begin = last = time.monotonic()
    while time.monotonic() - begin < DRAG_S:
        share = abs((time.monotonic() - begin) % 4.0 / 2.0 - 1.0)
        editor.move(left + (0.2 + 0.6 * share) * (right - left), (top + bottom) / 2)
        time.sleep(0.03)
        if time.monotonic() - last > UNWATCHED_S:
            states.append(editor.state())
            last = time.monotonic()
    editor.release()
    editor.click("timeline.play")
    editor.click("parameters." + name + ".reset")
    editor.idle(300)
    return states


def resize_often(editor):
    """The longest frame of each of 15 changes of the window's size."""
    states = []
    editor.state()
    for width, height in 3 * [(1024, 700), (1600, 900), (900, 600), (1400, 800), (1280, 720)]:
        editor.window.configure(x=0, y=0, width=width, height=height)
        editor.display.sync()
        time.sleep(0.4)
        states.append(editor.state())
    return states


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
            for name in ("fill", "corner_distance_m"):
                print(f"  longest frame while {name} is dragged and the trajectory plays: "
                      + told(drag_while_playing(editor, name)), flush=True)
            print("  longest frame of 15 changes of size: " + told(resize_often(editor)),
                  f"\n  load of the machine: {os.getloadavg()[0]:.1f}", flush=True)
        finally:
            editor.kill()
            screen.close()


if __name__ == "__main__":
    main()
