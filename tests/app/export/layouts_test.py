#!/usr/bin/python3
"""Dataset layouts of training and SLAM programs, read by the rules of these programs.

Usage: layouts_test.py PROGRAM [unittest arguments]
"""
import csv
import json
import os
import pathlib
import shutil
import unittest

import cv2
import numpy as np

from support import tiny_room
from support.program import FolderCase, run


def yolo_images(yaml, part):
    """The images of one split in data.yaml, as Ultralytics' reader finds them."""
    entries = dict(line.split(": ", 1) for line in yaml.read_text().splitlines()
                   if ": " in line and not line.startswith(" "))
    root = pathlib.Path(entries.get("path", yaml.parent))
    listed = (root / entries[part]).resolve()
    lines = listed.read_text().splitlines()
    return [str(listed.parent) + "/" + line[2:] if line.startswith("./") else line
            for line in lines if line]


def yolo_label(image):
    before, after = image.rsplit("/images/", 1)
    return f"{before}/labels/{after.rsplit('.', 1)[0]}.txt"


def euroc_trajectory(path):
    """Times (s), positions and quaternions w, x, y, z, as evo reads ground truth."""
    rows = [line.split(",") for line in path.read_text().splitlines() if not line.startswith("#")]
    assert len(rows[0]) >= 8
    table = np.array([[float(field) for field in row] for row in rows])
    return table[:, 0] / 1e9, table[:, 1:4], table[:, 4:8]


def sensor(path):
    """Keys of a sensor.yaml whose values are numbers or lists of them."""
    values = {}
    for line in path.read_text().splitlines():
        key, _, value = line.strip().partition(": ")
        if value.startswith("[") or value.replace(".", "").isdigit():
            values[key] = json.loads(value)
    return values


class Layouts(FolderCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        tiny_room.write(cls.folder / "room.obj")
        cls.project = cls.folder / "room.dolly"
        plan = run("plan", cls.folder / "room.obj", "-o", cls.project, "--set", "width_px=64",
                   "--set", "height_px=48", "--duration", 12, "--fps", 2.5)
        assert plan.returncode == 0, plan.stderr
        made = cls.folder / "made"
        export = run("export", cls.project, "--out", made, "--modalities",
                     "rgb,instance,rgb_right", "--formats", "yolo,euroc,imu")
        assert export.returncode == 0, export.stderr
        # It must work after the folder is moved.
        cls.out = cls.folder / "moved" / "away"
        cls.out.parent.mkdir()
        shutil.move(made, cls.out)
        cls.card = json.loads((cls.out / "dataset.json").read_text())

    def test_verify_finds_both_sound(self):
        done = run("-q", "verify", self.out, "--scene", self.folder / "room.obj", "--json")
        checks = {one["check"]: one["status"] for one in json.loads(done.stdout)["checks"]}
        self.assertEqual((checks["yolo"], checks["euroc"], checks["files"]), ("passed",) * 3, done.stdout)
        self.assertEqual(done.returncode, 0)

    def test_yolo_readers_find_pictures_and_labels(self):
        yaml = self.out / "data.yaml"
        train, val = yolo_images(yaml, "train"), yolo_images(yaml, "val")
        self.assertGreater(len(train), len(val))
        self.assertGreater(len(val), 0)
        self.assertFalse(set(train) & set(val))
        boxes = 0
        for image in train + val:
            rgb = self.out / "rgb" / os.path.basename(image)
            self.assertTrue(os.path.samefile(image, rgb), "another copy on the disk")
            self.assertIsNotNone(cv2.imread(image), image)
            for line in pathlib.Path(yolo_label(image)).read_text().splitlines():
                number, *box = map(float, line.split())
                self.assertIn(number, range(40))
                self.assertTrue(all(0 <= value <= 1 for value in box), line)
                boxes += 1
        self.assertGreater(boxes, 10)

    def test_yolo_holds_back_the_first_fold(self):
        out = self.folder / "folds"
        export = run("export", self.project, "--out", out, "--modalities", "rgb", "--formats",
                     "yolo", "--folds", 3)
        self.assertEqual(export.returncode, 0, export.stderr)
        for part in ("train", "val"):
            fold = (out / "folds" / f"fold_0_{part}.txt").read_text().split()
            self.assertEqual([os.path.basename(one) for one in yolo_images(out / "data.yaml", part)],
                             [os.path.basename(one) for one in fold])

    def test_yolo_without_pictures_is_refused(self):
        self.assertFails(run("export", self.project, "--out", self.folder / "none", "--modalities",
                             "depth", "--formats", "yolo"), 2, "yolo", "rgb")

    def test_euroc_poses_are_those_of_the_frames(self):
        times, positions, rotations = euroc_trajectory(
            self.out / "mav0" / "state_groundtruth_estimate0" / "data.csv")
        self.assertEqual(len(times), len(self.card["frames"]))
        for i, frame in enumerate(self.card["frames"]):
            self.assertAlmostEqual(times[i], frame["time_s"], delta=1e-9)
            np.testing.assert_allclose(positions[i], frame["position"], atol=1e-8)
            x, y, z, w = frame["quaternion_xyzw"]
            np.testing.assert_allclose(rotations[i], (w, x, y, z), atol=1e-8)

    def test_euroc_cameras_have_a_picture_at_each_time(self):
        for camera, modality in (("cam0", "rgb"), ("cam1", "rgb_right")):
            folder = self.out / "mav0" / camera
            with open(folder / "data.csv", newline="") as table:
                rows = [row for row in csv.reader(table) if not row[0].startswith("#")]
            self.assertEqual(len(rows), len(self.card["frames"]))
            for i, (stamp, name) in enumerate(rows):
                self.assertEqual(int(stamp), round(self.card["frames"][i]["time_s"] * 1e9))
                self.assertEqual(name, f"{stamp}.png")
                self.assertTrue(os.path.samefile(folder / "data" / name,
                                                 self.out / modality / f"{i:06d}.png"))
            self.assertEqual(len(list((folder / "data").iterdir())), len(rows))

    def test_euroc_sensors_are_the_cards(self):
        lens = self.card["conventions"]["intrinsics"]
        for camera, right in (("cam0", 0.0), ("cam1", 0.1)):
            said = sensor(self.out / "mav0" / camera / "sensor.yaml")
            np.testing.assert_allclose(said["intrinsics"], [lens["fx"], lens["fy"], lens["cx"] - 0.5,
                                                            lens["cy"] - 0.5], atol=1e-8)
            self.assertEqual(said["resolution"], [64, 48])
            expected = np.eye(4)
            expected[0, 3] = right
            np.testing.assert_allclose(np.reshape(said["data"], (4, 4)), expected)
            self.assertAlmostEqual(said["rate_hz"], 2.5, delta=1e-4)
        self.assertEqual((self.out / "mav0" / "imu0" / "data.csv").read_bytes(),
                         (self.out / "imu.csv").read_bytes())
        self.assertEqual(sensor(self.out / "mav0" / "imu0" / "sensor.yaml")["rate_hz"], 200)

    def test_one_camera_has_one_folder(self):
        out = self.folder / "mono"
        export = run("export", self.project, "--out", out, "--modalities", "rgb", "--formats",
                     "euroc")
        self.assertEqual(export.returncode, 0, export.stderr)
        self.assertEqual(sorted(path.name for path in (out / "mav0").iterdir()),
                         ["cam0", "imu0", "state_groundtruth_estimate0"])


if __name__ == "__main__":
    unittest.main()
