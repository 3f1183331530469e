#!/usr/bin/python3
"""plan --quality and --frames: the table of the frames against the metrics, the exported dataset and
rays that NumPy casts.

Usage: frame_table_test.py PROGRAM [unittest arguments]
"""
import csv
import json
import statistics
import unittest

import numpy

from support import tiny_room
from support.program import FolderCase, run

WIDTH, HEIGHT, HFOV_DEG = 64, 48, 60.0
CAMERA = ["--set", f"width_px={WIDTH}", "--set", f"height_px={HEIGHT}", "--set",
          f"hfov_deg={HFOV_DEG:g}"]


def rotation(q):
    x, y, z, w = q
    return numpy.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def distance_to_boxes(origin, directions, boxes):
    """Distance along each direction to the first of axis-aligned boxes, or infinity."""
    nearest = numpy.full(len(directions), numpy.inf)
    with numpy.errstate(divide="ignore", invalid="ignore"):
        for low, high in boxes:
            a = (numpy.array(low) - origin) / directions
            b = (numpy.array(high) - origin) / directions
            enter = numpy.nanmax(numpy.minimum(a, b), axis=1)
            leave = numpy.nanmin(numpy.maximum(a, b), axis=1)
            hit = (enter <= leave) & (enter > 0)
            nearest = numpy.where(hit, numpy.minimum(nearest, enter), nearest)
    return nearest


class FrameTable(FolderCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.room = cls.folder / "room.obj"
        tiny_room.write(cls.room)
        cls.project, cls.table = cls.folder / "room.dolly", cls.folder / "frames.csv"
        cls.planned = run("plan", cls.room, "--max-frames", 40, *CAMERA, "-o", cls.project,
                          "--frames", cls.table, "--poses", cls.folder / "path.txt", "--json")
        with open(cls.table) as file:
            cls.rows = list(csv.DictReader(file))

    def test_overlap_is_what_numpy_finds(self):
        self.assertEqual(self.planned.returncode, 0, self.planned.stderr)
        # The file's boxes have y up; the scene has z up: (x, y, z) is (x, -z, y).
        boxes = []
        for line in self.room.read_text().split("\no "):
            points = numpy.array([[float(value) for value in row.split()[1:]]
                                  for row in line.splitlines() if row.startswith("v ")])
            points = points[:, [0, 2, 1]] * [1, -1, 1]
            boxes.append((points.min(axis=0), points.max(axis=0)))
        focal = 0.5 * WIDTH / numpy.tan(numpy.radians(HFOV_DEG / 2))
        x, y = numpy.meshgrid((numpy.arange(16) + 0.5) * WIDTH / 16,
                              (numpy.arange(12) + 0.5) * HEIGHT / 12)
        rays = numpy.stack([(x.ravel() - WIDTH / 2) / focal, (y.ravel() - HEIGHT / 2) / focal,
                            numpy.ones(x.size)], axis=1)
        frames = json.loads(self.project.read_text())["result"]["trajectory"]["frames"]
        self.assertEqual(len(frames), len(self.rows))
        for before, frame, row in zip(frames, frames[1:], self.rows[1:]):
            if before["path"] != frame["path"]:
                self.assertEqual(row["overlap"], "")
                continue
            here, there = numpy.array(frame["position"]), numpy.array(before["position"])
            directions = rays @ rotation(frame["quaternion_xyzw"]).T
            points = here + directions * distance_to_boxes(here, directions, boxes)[:, None]
            seen = (points - there) @ rotation(before["quaternion_xyzw"])
            inside = ((seen[:, 2] > 0) &
                      (abs(seen[:, 0]) < seen[:, 2] * WIDTH / 2 / focal) &
                      (abs(seen[:, 1]) < seen[:, 2] * HEIGHT / 2 / focal))
            free = distance_to_boxes(there, points - there, boxes) > 1 - 0.011 / numpy.linalg.norm(
                points - there, axis=1)
            # Rays at edges of objects may go to either side.
            self.assertAlmostEqual(float(row["overlap"]), numpy.mean(inside & free), delta=3 / 192)

    def test_metrics_are_those_of_the_table(self):
        metrics = json.loads(self.planned.stdout)
        corners = [float(row["image_corners"]) for row in self.rows]
        overlaps = [float(row["overlap"]) for row in self.rows if row["overlap"]]
        self.assertAlmostEqual(metrics["trackable_rate"],
                               sum(one >= 150 for one in corners) / len(corners), 9)
        self.assertEqual(metrics["untrackable_frames"], sum(one < 150 for one in corners))
        self.assertEqual(metrics["wide_gaps"], sum(one < 0.6 for one in overlaps))
        self.assertAlmostEqual(metrics["overlap_min_rate"], min(overlaps), 5)
        self.assertAlmostEqual(metrics["overlap_median_rate"], statistics.median(overlaps), 5)
        self.assertEqual(sum(int(row["newly_captured"]) for row in self.rows),
                         metrics["captured"])
        self.assertEqual(sum(row["key_frame"] == "1" for row in self.rows),
                         metrics["key_frames"])
        self.assertTrue(0.2 < metrics["surface_seen_rate"] < 0.9, metrics["surface_seen_rate"])
        # They are stored with the plan, and printed.
        stored = json.loads(self.project.read_text())["result"]["metrics"]
        self.assertEqual(stored["wide_gaps"], metrics["wide_gaps"])
        text = run("plan", self.room, "--max-frames", 40, *CAMERA, "--quality").stdout
        self.assertIn(f"{metrics['wide_gaps']} gaps below 60 %", text)
        self.assertIn("surface seen", text)

    def test_surface_is_that_of_the_objective(self):
        both = ["--max-frames", 40, *CAMERA, "--set", "objective=both", "--json"]
        by_objective = json.loads(run("plan", self.room, *both).stdout)
        with_quality = json.loads(run("plan", self.room, *both, "--quality").stdout)
        plain = json.loads(self.planned.stdout)
        for name in ("surface_seen_rate", "surface_patches"):
            self.assertEqual(by_objective[name], with_quality[name])
        self.assertEqual(plain["surface_patches"], by_objective["surface_patches"])
        self.assertLessEqual(plain["surface_seen_rate"], by_objective["surface_seen_rate"])

    def test_poses_are_those_of_the_project(self):
        frames = json.loads(self.project.read_text())["result"]["trajectory"]["frames"]
        rows = numpy.loadtxt(self.folder / "path.txt")
        self.assertEqual(len(rows), len(frames))
        for row, frame in zip(rows, frames):
            expected = [frame["time_s"], *frame["position"], *frame["quaternion_xyzw"]]
            numpy.testing.assert_allclose(row, expected, atol=1e-6)
        baseline = self.folder / "baseline.txt"
        planned = run("plan", self.room, "--max-frames", 20, "--planner", "uniform", "--poses",
                      baseline)
        self.assertEqual(planned.returncode, 0, planned.stderr)
        self.assertEqual(numpy.loadtxt(baseline).shape, (20, 8))

    def test_requirements_need_the_option(self):
        self.assertEqual(run("plan", self.room, "--require", "wide_gaps<=1000").returncode, 2)
        met = run("plan", self.room, "--max-frames", 40, *CAMERA, "--quality", "--require",
                  "wide_gaps<=1000", "--require", "surface_seen_rate>=0.1")
        self.assertEqual(met.returncode, 0, met.stderr)
        unmet = run("plan", self.room, "--max-frames", 40, *CAMERA, "--quality", "--require",
                    "overlap_min_rate>0.99")
        self.assertEqual(unmet.returncode, 3, unmet.stderr)
        nowhere = run("plan", self.folder / "missing.obj", "--frames",
                      self.folder / "nowhere" / "frames.csv")
        self.assertEqual(nowhere.returncode, 6, nowhere.stderr)
        number = run("plan", self.room, "--frames", 40)
        self.assertEqual(number.returncode, 2, number.stderr)
        self.assertIn("--max-frames", number.stderr)
        other = run("plan", self.room, "--planner", "uniform", "--frames", self.table)
        self.assertEqual(other.returncode, 2, other.stderr)
        self.assertIn("--frames", other.stderr)


if __name__ == "__main__":
    unittest.main()
