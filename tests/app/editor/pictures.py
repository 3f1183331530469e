#!/usr/bin/python3
"""Takes the README's pictures of the editor again, in its real window. Not a test.

Usage: pictures.py EDITOR COMMAND_LINE FOLDER
"""
import pathlib
import subprocess
import sys
import tempfile
import time

import cv2
import numpy

from editor_driver import Editor
from screen import Screen

SIZE = (1440, 810)
SCENE = pathlib.Path(__file__).parents[3] / "assets/scenes/apartment.glb"
FRAME = 88  # of 300, that is shown in the preview and compared with its export
TUNED = ['{"op":"add_no_go","name":"wet floor","center":[2.2,2.2,0.6],"size":[1.6,1.0,1.2]}',
         '{"op":"height_band","min_m":0.3,"max_m":2.0}',
         '{"op":"exclude","object":"sheet_music"}']


def settled(editor):
    """Waits until everything is computed, lit and drawn."""
    editor.idle(300)
    return editor.wait(lambda now: not now["busy"]["lighting"] and not now["busy"]["drawing"] and
                       now["preview"]["final_light"], "the picture", 300)


def shot(editor):
    settled(editor)
    time.sleep(0.5)
    settled(editor)
    width, height, rgb = editor.picture()
    return numpy.frombuffer(rgb, numpy.uint8).reshape(height, width, 3)[:, :, ::-1]


def at(editor, across, down):
    """A position in the viewport, in fractions of its size."""
    left, top, right, bottom = editor.item("viewport")[:4]
    return left + across * (right - left), top + down * (bottom - top)


def show_frame(editor, frame):
    editor.click("tab.timeline")
    editor.type_value("timeline.frame", str(frame))
    editor.wait(lambda now: now["preview"]["frame"] == frame, "the frame")


def tuned_room(editor):
    """A project with edits: a no-go box, a height band, a position point with its handles."""
    show_frame(editor, FRAME)
    editor.wheel(at(editor, 0.4, 0.8), 4)
    settled(editor)
    x, y = at(editor, 0.55, 0.45)
    points = [one["px"] for one in editor.state()["points"] if "px" in one and one["px"]]
    point = min(points, key=lambda px: (px[0] - x) ** 2 + (px[1] - y) ** 2)
    for _ in range(4):  # clicks at one place select in turn what lies there
        editor.click(point)
        if "selection.pin" in editor.items():
            break
    editor.click("tab.by hand")
    editor.click("tab.selection")
    return shot(editor)


def failure_explained(editor):
    """An object without a capture, all positions that were tried, and the objects that hide it."""
    editor.key("esc")
    editor.click("tab.objects")
    editor.click("objects.filter")
    editor.type("oven")
    editor.click(next(name for name in editor.items() if name.startswith("objects.row.")))
    editor.click("preview.fold")
    editor.key("F3")  # points and the trajectory would cover the subject
    editor.key("F5")
    x, y = editor.middle("splitter.bottom")
    editor.drag((x, y), (x, y + 150))
    editor.point(at(editor, 0.6, 0.6))
    editor.key("f")
    editor.wheel(at(editor, 0.5, 0.5), -4)
    editor.click("tab.selection")
    return shot(editor)


def titled(image, text, height):
    """A picture below a strip with its title."""
    fine = 4
    strip = numpy.full((fine * height, fine * image.shape[1], 3), (39, 35, 32), numpy.uint8)
    cv2.putText(strip, text, (12 * fine, int(0.66 * height * fine)), cv2.FONT_HERSHEY_SIMPLEX,
                0.46 * fine, (220, 218, 214), fine, cv2.LINE_AA)
    strip = cv2.resize(strip, (image.shape[1], height), interpolation=cv2.INTER_AREA)
    return numpy.vstack([strip, image])


def preview_and_export(editor, command_line, project, folder):
    """The preview, enlarged to the size of its frame, beside the exported frame."""
    subprocess.run([command_line, "-q", "export", project, "--out", folder, "--range",
                    f"{FRAME}:{FRAME + 1}", "--modalities", "rgb"],
                   check=True, stdout=subprocess.DEVNULL)
    exported = cv2.imread(str(next((folder / "rgb").glob("*.png"))))
    height, width = exported.shape[:2]
    editor.point(at(editor, 0.5, 0.5))
    editor.key("esc")
    editor.click("preview.fold")
    show_frame(editor, FRAME)
    editor.menu("window", "window.bottom")
    x, y = editor.middle("preview.grip")
    left, _, right, _ = editor.item("preview.picture")[:4]
    editor.drag((x, y), (x - (width - (right - left)), y))
    editor.point("menu.help")  # over the image, the mouse would show a tooltip
    window = shot(editor)
    left, top, right, bottom = map(round, editor.item("preview.picture")[:4])
    if (right - left, bottom - top) != (width, height):
        sys.exit(f"the preview is {right - left} x {bottom - top} px, its frame {width} x {height}")
    apart = numpy.abs(window[top:bottom, left:right].astype(int) - exported.astype(int))
    print(f"preview and frame are at most {apart[8:-8, 8:-8].max()} apart")  # round corners, grip
    bar = top - round(editor.item("preview.title")[1]) + 5
    gap = numpy.full((height + bar, 6, 3), 255, numpy.uint8)
    return numpy.hstack([window[top - bar:bottom, left:right], gap,
                         titled(exported, f"dataset/rgb/{FRAME:06d}.png", bar)])


def main():
    program, command_line, target = sys.argv[1:]
    target = pathlib.Path(target)
    screen = Screen(*SIZE)
    with tempfile.TemporaryDirectory(prefix="pictures") as home:
        project = pathlib.Path(home) / "apartment.dolly"
        subprocess.run([command_line, "-q", "plan", SCENE.absolute(), "-o", project,
                        "--max-frames", "300"], check=True)
        subprocess.run([command_line, "-q", "edit", project, "--plan",
                        *[part for one in TUNED for part in ("--op", one)]], check=True)
        editor = Editor(program, screen, project, home=home, size=SIZE)
        try:
            editor.wait(lambda now: now["open"] or now["notice"], "the project", 300)
            settled(editor)
            pictures = {"tuned": tuned_room(editor), "why_not": failure_explained(editor)}
            pictures["preview_and_export"] = preview_and_export(
                editor, command_line, project, pathlib.Path(home) / "dataset")
            for name, picture in pictures.items():
                cv2.imwrite(str(target / f"editor_{name}.png"), picture,
                            [cv2.IMWRITE_PNG_COMPRESSION, 9])
        finally:
            editor.kill()
            screen.close()


if __name__ == "__main__":
    main()
