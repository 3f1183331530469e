#!/usr/bin/python3
"""Clips of a given length and frame rate, and the note when a budget leaves out frames.

Usage: clip_test.py PROGRAM [unittest arguments]
"""
import json
import unittest

import cv2

from support import tiny_room
from support.program import FolderCase, run

SMALL = ["--set", "width_px=64", "--set", "height_px=48"]


class Clip(FolderCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.room = cls.folder / "room.obj"
        tiny_room.write(cls.room)

    def plan(self, *arguments):
        """Returns the finished run, and the trajectory stored in the project."""
        project = self.folder / "room.dolly"
        done = run("plan", self.room, "-o", project, *SMALL, *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done, json.loads(project.read_text())["result"]["trajectory"]

    def speeds(self, frames):
        return [sum((a - b) ** 2 for a, b in zip(one["position"], other["position"])) ** 0.5 /
                (other["time_s"] - one["time_s"]) for one, other in zip(frames, frames[1:])]

    def test_left_out_frames_are_said_with_what_prevents_it(self):
        done, trajectory = self.plan("--set", "frame_rate=30", "--max-frames", 60)
        frames = trajectory["frames"]
        self.assertEqual(len(frames), 60)
        for frame in frames:
            self.assertAlmostEqual(frame["time_s"] * 30, round(frame["time_s"] * 30), delta=1e-6)
        self.assertLess(max(self.speeds(frames)), 0.5 + 1e-6)
        message = " ".join(done.stderr.split())
        self.assertRegex(message, r"\d+ of \d+ frames at frame_rate=30 are left out for max_frames=60")
        self.assertIn("keep_frame_rate=true keeps all", message)

    def test_the_reason_for_left_out_frames_is_named(self):
        done, trajectory = self.plan("--max-frames", 600, "--set", "max_repeat_rate=0.3")
        frames = len(trajectory["frames"])
        self.assertLess(frames, 600)
        self.assertIn("are left out for max_repeat_rate=0.3, although max_frames=600 allows more",
                      " ".join(done.stderr.split()))

    def test_a_limit_of_repeats_that_cannot_be_met_leaves_out_nothing(self):
        done, limited = self.plan("--max-frames", 600, "--set", "max_repeat_rate=0")
        self.assertNotIn("left out", done.stderr)
        _, free = self.plan("--max-frames", 600, "--set", "max_repeat_rate=1")
        self.assertEqual(limited["frames"], free["frames"])

    def test_a_kept_rate_is_kept_and_nothing_is_said(self):
        done, trajectory = self.plan("--fps", 30, "--max-frames", 240)
        frames = trajectory["frames"]
        self.assertLessEqual(len(frames), 240)
        self.assertGreater(len(frames), 60)
        for i, frame in enumerate(frames):
            self.assertAlmostEqual(frame["time_s"], i / 30, delta=1e-9)
        self.assertLess(max(self.speeds(frames)), 0.5 + 1e-6)
        self.assertNotIn("left out", done.stderr)

    def test_a_kept_rate_that_leaves_frames_unused_is_said(self):
        done, trajectory = self.plan("--fps", 30, "--max-frames", 8)
        frames = len(trajectory["frames"])
        self.assertLess(2 * frames, 8)
        self.assertIn(f"only {frames} of max_frames=8 frames are used",
                      " ".join(done.stderr.split()))

    def test_unused_frames_are_not_reported_if_every_object_is_captured(self):
        done, trajectory = self.plan("--fps", 30, "--max-frames", 240, "--only", "table")
        self.assertEqual(len(trajectory["frames"]), 1)
        self.assertIn("one frame captures every object", " ".join(done.stderr.split()))
        self.assertNotIn("frames are used", " ".join(done.stderr.split()))

    def test_without_a_budget_nothing_is_said(self):
        done, _ = self.plan("--set", "frame_rate=5")
        self.assertNotIn("left out", done.stderr)

    def test_a_clip_has_its_length_and_rate(self):
        whole = self.plan()[1]["frames"][-1]["time_s"]
        for seconds in (8.0, 2.0 * whole):
            with self.subTest(seconds):
                _, trajectory = self.plan("--duration", seconds, "--fps", 15)
                frames = trajectory["frames"]
                self.assertEqual(len(frames), round(15 * seconds))
                for i, frame in enumerate(frames):
                    self.assertAlmostEqual(frame["time_s"], i / 15, delta=1e-9)
                # The motion limits hold in a short clip, and the camera keeps moving until the end
                # of a long one.
                self.assertLess(max(self.speeds(frames)), 0.5 + 1e-6)
                still = sum(speed < 1e-6 for speed in self.speeds(frames)[-8:])
                self.assertLess(still, 8)

    def test_a_clip_goes_with_a_budget_of_metres(self):
        _, trajectory = self.plan("--duration", 8, "--fps", 10, "--max-length", 1.5)
        self.assertEqual(len(trajectory["frames"]), 80)
        frames = trajectory["frames"]
        self.assertLess(sum(self.speeds(frames)) / 10, 1.5 + 1e-6)

    def test_contradictions_are_usage_errors(self):
        for arguments, words in (
                (["--duration", 20, "--fps", 30, "--max-frames", 300], "max_frames=300"),
                (["--duration", 0.01, "--fps", 10], "shorter than one frame"),
                (["--duration", 100000, "--fps", 10], "more than 100000 frames; lower either"),
                (["--duration", 5, "--set", "path_mode=longest_branch"], "path_mode")):
            result = run("plan", self.room, *SMALL, *arguments)
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertIn(words, result.stderr)

    def test_what_must_be_visited_is_not_dropped_for_a_clip(self):
        result = run("plan", self.room, *SMALL, "--duration", 0.5, "--start", "2,-1.5,1.5,1,-0.5,1",
                     "--end", "2.3,-2.2,1.2,0.5,-0.4,1.5")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("duration_s", result.stderr)

    def test_the_film_takes_as_long_as_the_trajectory(self):
        for arguments, rate in ((["--set", "frame_rate=2"], 2), (["--fps", 24, "--duration", 2], 24)):
            self.plan(*arguments)
            out = self.folder / f"film_{rate}"
            made = run("export", self.folder / "room.dolly", "--out", out, "--modalities", "rgb",
                       "--formats", "video", "--range", "0:12")
            self.assertEqual(made.returncode, 0, made.stderr)
            film = cv2.VideoCapture(str(out / "preview.mp4"))
            self.assertAlmostEqual(film.get(cv2.CAP_PROP_FPS), rate, delta=0.01)

    def test_the_film_of_one_frame_has_the_trajectory_s_rate(self):
        self.plan("--fps", 24, "--duration", 2)
        out = self.folder / "film_of_one"
        made = run("export", self.folder / "room.dolly", "--out", out, "--modalities", "rgb",
                   "--formats", "video", "--range", "3:4")
        self.assertEqual(made.returncode, 0, made.stderr)
        film = cv2.VideoCapture(str(out / "preview.mp4"))
        self.assertAlmostEqual(film.get(cv2.CAP_PROP_FPS), 24, delta=0.01)


if __name__ == "__main__":
    unittest.main()
