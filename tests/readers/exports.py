"""The datasets for all readers, and functions to check the results."""
import collections
import csv
import functools
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np

PROGRAM = APARTMENT = OPENCV_KITTI = None  # set by readers_test.py
FOLDER = tempfile.TemporaryDirectory()


def dollytrack(*arguments):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


@functools.cache
def project():
    path = pathlib.Path(FOLDER.name) / "apartment.dolly"
    # A slow walk, as for mapping a room.
    dollytrack("plan", APARTMENT, "-o", path, "--set", "motion_preset=easy",
               "--set", "frame_rate=15")
    return path


class Dataset:
    """An exported folder: its dataset.json, its poses, the intrinsics of its images."""

    def __init__(self, name, *arguments):
        self.folder = pathlib.Path(FOLDER.name) / name
        dollytrack("export", project(), "--out", self.folder, "--modalities", "all",
                   "--formats", "all", *arguments)
        self.card = json.loads((self.folder / "dataset.json").read_text())
        self.frames = self.card["frames"]
        lens = self.card["conventions"]["intrinsics"]
        self.width, self.height = lens["width"], lens["height"]
        self.fx, self.fy, self.cx, self.cy = (lens[key] for key in ("fx", "fy", "cx", "cy"))

    def __str__(self):
        return str(self.folder)

    def pose(self, index):
        """world_from_camera, 4 x 4."""
        frame = self.frames[index]
        pose = np.eye(4)
        pose[:3, :3] = rotation(frame["quaternion_xyzw"])
        pose[:3, 3] = frame["position"]
        return pose

    def file(self, folder, index, ending=".png"):
        return str(self.folder / folder / f"{index:06d}{ending}")


@functools.cache
def walk():
    """Fifty frames about 12 cm apart, for programs that reconstruct."""
    return Dataset("walk", "--range", "0:400:8")


@functools.cache
def film():
    """Frames about 2 cm apart, as in a video, around the frame of the walk in which objects take
    most pixels."""
    shown = collections.Counter()
    with open(walk().folder / "instances.csv", newline="") as table:
        for row in csv.DictReader(table):
            shown[row["frame"]] += int(row["visible_px"])
    fullest = walk().frames[int(max(shown, key=shown.get))]["trajectory_frame"]
    return Dataset("film", "--range", f"{max(0, fullest - 10)}:{fullest + 10}")


def rotation(xyzw):
    x, y, z, w = xyzw
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def angle_deg(matrix):
    return np.degrees(np.arccos(np.clip((np.trace(matrix[:3, :3]) - 1) / 2, -1, 1)))


def missing(what, package):
    """Skips the test if the reader is missing, or fails it where every reader is required."""
    message = f"{what} is missing: install {package}"
    if os.environ.get("DOLLYTRACK_REQUIRE_READERS") == "1":
        raise AssertionError(message)
    raise unittest.SkipTest(message)


def need_program(name, package):
    if not shutil.which(name):
        missing(name, package)


def call(*command, **options):
    """Runs a reader; returns its output, or fails with it."""
    done = subprocess.run([*map(str, command)], capture_output=True, text=True,
                          env={**os.environ, "QT_QPA_PLATFORM": "offscreen"}, **options)
    assert done.returncode == 0, f"{command}\n{done.stdout[-3000:]}{done.stderr[-3000:]}"
    return done.stdout
