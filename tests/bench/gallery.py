"""Makes the gallery of the guide on light: rooms rasterized, path traced and denoised, and path traced
with many samples.

Usage: gallery.py PROGRAM OUT.jpg NAME=SCENE... [--samples N]

PROGRAM is dollytrack; picture_agreement lies beside it. For each scene, shows the frame whose objects
fill most of the image in the three ways, side by side, and prints how similar the first two are to
the third, which has N paths per pixel (1,024)."""
import argparse
import csv
import pathlib
import subprocess
import sys
import tempfile

import cv2
import numpy as np

WIDTH, HEIGHT = 400, 300
SIZE = ["--set", f"width_px={WIDTH}", "--set", f"height_px={HEIGHT}"]
GAP, CAPTION = 6, 26
MODES = {"fast": "rasterized", "traced": "path traced, denoised", "reference": "reference"}


def run(*command):
    result = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{result.stderr}")
    return result.stdout


def best_frame(dataset):
    """The number of the frame whose objects fill most of the image."""
    shown = {}
    with open(dataset / "instances.csv", newline="") as rows:
        for row in csv.DictReader(rows):
            frame = int(row["frame"])
            # An object counts with at most a tenth of the image.
            part = min(float(row["visible_px"]) / (WIDTH * HEIGHT), 0.1)
            shown[frame] = shown.get(frame, 0.0) + part
    return min(shown, key=lambda frame: (-shown[frame], frame))


def captioned(image, text):
    strip = np.full((CAPTION, image.shape[1], 3), 255, np.uint8)
    cv2.putText(strip, text, (2, CAPTION - 9), cv2.FONT_HERSHEY_SIMPLEX, 0.5, (40, 40, 40), 1,
                cv2.LINE_AA)
    return np.vstack([strip, image])


def room(program, name, scene, samples, folder):
    """The images of the room, side by side."""
    project = folder / "room.dolly"
    run(program, "-q", "plan", scene, "-o", project, "--max-frames", 60, *SIZE)
    labels = folder / "labels"
    run(program, "-q", "export", project, "--out", labels, "--modalities", "instance", "--formats",
        "instances")
    frame = best_frame(labels)
    images = []
    for mode, caption in MODES.items():
        run(program, "-q", "export", project, "--out", folder / mode, "--range",
            f"{frame}:{frame + 1}", "--modalities", "rgb", "--formats", "camera_json", "--set",
            f"render_mode={mode}", "--set", f"reference_samples={samples}", "--set",
            "antialias=8x")
        image = cv2.imread(str(folder / mode / "rgb" / "000000.png"))
        images += [captioned(image, f"{name}: {caption}"),
                   np.full((HEIGHT + CAPTION, GAP, 3), 255, np.uint8)]
    for mode in ("fast", "traced"):
        alike = run(program.parent / "picture_agreement", folder / mode, folder / "reference")
        print(f"{name}, {MODES[mode]}: {alike.splitlines()[-1]}", flush=True)
    return np.hstack(images[:-1])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=lambda path: pathlib.Path(path).absolute())
    parser.add_argument("out")
    parser.add_argument("scenes", nargs="+", metavar="NAME=SCENE")
    parser.add_argument("--samples", type=int, default=1024)
    arguments = parser.parse_args()
    rows = []
    for one in arguments.scenes:
        name, scene = one.split("=", 1)
        with tempfile.TemporaryDirectory() as folder:
            rows.append(room(arguments.program, name, scene, arguments.samples,
                             pathlib.Path(folder)))
    sheet = np.vstack(rows)
    sheet = cv2.resize(sheet, None, fx=0.7, fy=0.7, interpolation=cv2.INTER_AREA)
    cv2.imwrite(arguments.out, sheet, [cv2.IMWRITE_JPEG_QUALITY, 85])


if __name__ == "__main__":
    main()
