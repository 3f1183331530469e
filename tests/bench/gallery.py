"""Makes the gallery of the README: rasterized and path traced images of rooms side by side.

Usage: gallery.py PROGRAM OUT.jpg NAME=SCENE...

PROGRAM is dollytrack; picture_agreement lies beside it. For each scene, makes a sheet of two
frames, one from each half of the path, that show most of its objects: rasterized above, path traced
below. Prints how similar these are."""
import csv
import pathlib
import subprocess
import sys
import tempfile

import cv2
import numpy as np

WIDTH, HEIGHT = 400, 300
SIZE = ["--set", f"width_px={WIDTH}", "--set", f"height_px={HEIGHT}"]
SAMPLES = 96
GAP, CAPTION = 6, 26


def run(*command):
    result = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{result.stderr}")
    return result.stdout


def best_frames(dataset):
    """For each half of the frames, the number of the frame whose objects fill most of the image."""
    shown = {}
    with open(dataset / "instances.csv", newline="") as rows:
        for row in csv.DictReader(rows):
            frame = int(row["frame"])
            # An object counts with at most a tenth of the image.
            part = min(float(row["visible_px"]) / (WIDTH * HEIGHT), 0.1)
            shown[frame] = shown.get(frame, 0.0) + part
    frames = sorted(shown)
    half = len(frames) // 2
    return [min(part, key=lambda frame: (-shown[frame], frame))
            for part in (frames[:half], frames[half:])]


def caption(width, text):
    strip = np.full((CAPTION, width, 3), 255, np.uint8)
    cv2.putText(strip, text, (2, CAPTION - 9), cv2.FONT_HERSHEY_SIMPLEX, 0.5, (40, 40, 40), 1,
                cv2.LINE_AA)
    return strip


def room(program, name, scene, folder):
    """The rasterized and the path traced images of the room."""
    project = folder / "room.dolly"
    run(program, "-q", "plan", scene, "-o", project, "--max-frames", 60, *SIZE)
    look = folder / "look"
    run(program, "-q", "export", project, "--out", look, "--modalities", "instance", "--formats",
        "instances")
    first, second = best_frames(look)
    sides = {}
    for mode in ("fast", "reference"):
        sides[mode] = folder / mode
        run(program, "-q", "export", project, "--out", sides[mode], "--range",
            f"{first}:{second + 1}:{second - first}", "--modalities", "rgb", "--formats",
            "camera_json", "--set", f"render_mode={mode}", "--set", f"reference_samples={SAMPLES}",
            "--set", "antialias=8x")
    alike = run(program.parent / "picture_agreement", sides["fast"], sides["reference"])
    print(f"{name}: {alike.splitlines()[-1]}", flush=True)
    rows = []
    for mode in ("fast", "reference"):
        pictures = [cv2.imread(str(path)) for path in sorted((sides[mode] / "rgb").glob("*.png"))]
        rows.append(np.hstack([pictures[0], np.full((HEIGHT, GAP, 3), 255, np.uint8),
                               pictures[1]]))
        rows.append(np.full((GAP, rows[0].shape[1], 3), 255, np.uint8))
    return np.vstack([caption(rows[0].shape[1], f"{name}: drawn above, path traced below"), *rows])


def main():
    program, out = pathlib.Path(sys.argv[1]).absolute(), sys.argv[2]
    blocks = []
    for one in sys.argv[3:]:
        name, scene = one.split("=", 1)
        with tempfile.TemporaryDirectory() as folder:
            blocks.append(room(program, name, scene, pathlib.Path(folder)))
    rows = []
    for left, right in zip(blocks[::2], blocks[1::2]):
        rows.append(np.hstack([left, np.full((left.shape[0], 3 * GAP, 3), 255, np.uint8), right]))
    sheet = np.vstack(rows)
    sheet = cv2.resize(sheet, None, fx=0.6, fy=0.6, interpolation=cv2.INTER_AREA)
    cv2.imwrite(out, sheet, [cv2.IMWRITE_JPEG_QUALITY, 85])


if __name__ == "__main__":
    main()
