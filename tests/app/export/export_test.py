#!/usr/bin/python3
"""Exports with chosen frames and modalities, watched, stopped, killed and continued; checks the
files they leave.

Usage: export_test.py PROGRAM APARTMENT [unittest arguments]
"""
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import cv2

from support import tiny_room
from support.program import FolderCase, hashes, hold, lines_in, run, start, wait_for

APARTMENT = sys.argv.pop(1)
# Rendering takes long enough to be stopped even on a busy machine.
FRAMES = 96
MARK = ".dollytrack-export"
CHOICES = ["rgb", "depth", "instance", "semantic", "coco", "camera_json", "frames", "imu"]


def lines_of(text):
    """The JSON objects that --progress json wrote; every line must be one."""
    return [json.loads(line) for line in text.splitlines()]


class Export(FolderCase):
    keeps_cache = True

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.project = cls.folder / "apartment.dolly"
        planned = run("plan", APARTMENT, "-o", cls.project, "--max-frames", FRAMES,
                      "--set", "width_px=96", "--set", "height_px=72")
        assert planned.returncode == 0, planned.stderr
        cls.unbroken = cls.folder / "unbroken"
        for arguments in [[], ["--overwrite"]]:  # The second run uses the cache.
            begin = time.time()
            exported = run("export", cls.project, "--out", cls.unbroken, *arguments)
            cls.seconds = time.time() - begin
            assert exported.returncode == 0, exported.stderr
        cls.expected = hashes(cls.unbroken)

    def new_folder(self):
        return pathlib.Path(tempfile.mkdtemp(dir=self.folder))

    def assertFails(self, result, code, *words):
        self.assertEqual(result.returncode, code, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)

    def assertContinues(self, out, *arguments):
        result = run("export", self.project, "--out", out, "--resume", *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(hashes(out), self.expected)
        return result

    def part_of_export(self, frames=3):
        """A folder with an export that was killed after some frames."""
        out = self.new_folder()
        process = start("export", self.project, "--out", out)
        self.assertTrue(wait_for(lambda: process.poll() is not None or
                                 lines_in(out / MARK) > frames))
        process.kill()
        process.communicate()
        self.assertFalse((out / "dataset.json").exists())
        return out

    # --- continuing

    def test_killed_at_random_moments_it_ends_with_the_same_bytes(self):
        seed = random.randrange(10**6)
        moments = random.Random(seed)
        kills = 0
        for _ in range(3):
            out = self.new_folder()
            for _ in range(3):  # each continues where the one before was killed
                process = start("export", self.project, "--out", out, "--resume")
                try:
                    process.communicate(timeout=moments.uniform(0.05, 0.7) * self.seconds)
                except subprocess.TimeoutExpired:
                    kills += 1
                process.kill()
                process.communicate()
            with self.subTest(seed=seed):
                self.assertContinues(out)
        self.assertGreater(kills, 0)

    def test_a_killed_export_is_continued_and_not_repeated(self):
        out = self.part_of_export(frames=8)
        listed = lines_in(out / MARK) - 1
        times = {path: path.stat().st_mtime_ns for path in out.glob("rgb/*.png")}
        result = self.assertContinues(out)
        self.assertIn("resuming", result.stderr)
        kept = sum(path.stat().st_mtime_ns == written for path, written in times.items())
        self.assertGreaterEqual(kept, listed)

    def test_damaged_frames_are_rendered_again(self):
        out = self.part_of_export(frames=8)
        pictures = sorted(out.glob("rgb/*.png"))
        pictures[1].write_bytes(pictures[1].read_bytes()[:-20])
        pictures[2].unlink()
        self.assertContinues(out)

    def test_changes_are_refused_and_named(self):
        out = self.part_of_export()
        before = hashes(out)
        for arguments, word in [
            (["--set", "fill=0.5"], "the parameters"),
            (["--set", "width_px=80"], "the camera"),
            (["--range", "::2"], "the frame range"),
            (["--modalities", "rgb"], "the modalities"),
            (["--formats", "coco"], "the formats"),
        ]:
            result = run("export", self.project, "--out", out, "--resume", *arguments)
            self.assertFails(result, 2, word, "leave out --resume")
            self.assertEqual(hashes(out), before)
        self.assertContinues(out)

    def test_nothing_to_continue_begins_anew(self):
        self.assertContinues(self.folder / "not_there_yet")
        # A complete dataset is only checked; one with damage that cannot be repaired is never a
        # success.
        out = self.new_folder()
        shutil.copytree(self.unbroken, out, dirs_exist_ok=True)
        self.assertContinues(out)
        (out / "depth" / "000001.png").unlink()
        self.assertFails(run("export", self.project, "--out", out, "--resume"), 4, "000001.png")

    def test_without_resume_it_begins_anew(self):
        out = self.part_of_export()
        result = run("export", self.project, "--out", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(hashes(out), self.expected)

    # --- stopping

    def test_signals_keep_the_finished_frames_and_say_how_to_go_on(self):
        for number, code in [(signal.SIGINT, 130), (signal.SIGTERM, 143)]:
            out = self.new_folder()
            process = start("export", self.project, "--out", out)
            self.assertTrue(wait_for(lambda: process.poll() is not None or
                                     list(out.glob("rgb/*.png"))))
            process.send_signal(number)
            _, errors = process.communicate(timeout=60)
            self.assertEqual(process.returncode, code, errors)
            self.assertIn("--resume", errors)
            self.assertFalse((out / "dataset.json").exists())
            self.assertEqual([path for path in out.rglob("*") if ".tmp." in path.name], [])
            # Rendered frames are kept: the journal has a header line and one line for each frame.
            self.assertEqual(lines_in(out / MARK), 1 + len(list(out.glob("semantic/*.png"))))
            self.assertContinues(out)

    def test_two_exports_do_not_share_a_folder(self):
        out = self.new_folder()
        process = start("export", self.project, "--out", out)
        # Waits for the first line: an empty journal may be from the check of the folder, which
        # removes it again.
        self.assertTrue(wait_for(lambda: process.poll() is not None or lines_in(out / MARK) > 0))
        hold(process)
        try:
            for more in [[], ["--resume"], ["--overwrite"]]:
                second = run("export", self.project, "--out", out, *more)
                self.assertFails(second, 6, "another export")
        finally:
            os.kill(process.pid, signal.SIGCONT)
        _, errors = process.communicate()
        self.assertEqual(process.returncode, 0, errors)
        self.assertEqual(hashes(out), self.expected)

    def test_a_full_disk_is_said_and_continued_from(self):
        disk = self.new_folder()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=128m", "tmpfs", disk],
                                 capture_output=True)
        if mounted.returncode != 0:
            self.skipTest("no small disk can be mounted here")
        try:
            out = disk / "dataset"
            process = start("export", self.project, "--out", out)
            self.assertTrue(wait_for(lambda: process.poll() is not None or
                                     list(out.glob("semantic/*.png"))))
            hold(process)
            filler = disk / "filler"
            with open(filler, "wb", buffering=0) as file:
                try:
                    while True:
                        file.write(bytes(4096))
                except OSError:
                    pass
            os.kill(process.pid, signal.SIGCONT)
            _, errors = process.communicate()
            self.assertEqual(process.returncode, 6, errors)
            self.assertIn("full", errors)
            self.assertFalse((out / "dataset.json").exists())
            # The disk is still full: refused before rendering, and nothing is lost.
            self.assertFails(run("export", self.project, "--out", out, "--resume"), 6)
            filler.unlink()
            self.assertContinues(out)
            # Too full for another dataset: the existing one stays.
            with open(filler, "wb") as file:
                file.truncate(0)
            bigger = run("export", self.project, "--out", out, "--set", "width_px=4000",
                         "--set", "height_px=3000", "--overwrite")
            self.assertFails(bigger, 6, "MB are needed")
            self.assertEqual(hashes(out), self.expected)
        finally:
            subprocess.run(["umount", disk], check=True)

    def test_a_hall_is_neither_white_nor_dark(self):
        hall = self.folder / "hall.obj"
        tiny_room.write_boxes(hall, [
            ("floor", (0, -0.1, 0), (20, 0, 15)), ("ceiling", (0, 6, 0), (20, 6.1, 15)),
            ("wall_1", (-0.1, 0, 0), (0, 6, 15)), ("wall_2", (20, 0, 0), (20.1, 6, 15)),
            ("wall_3", (0, 0, -0.1), (20, 6, 0)), ("wall_4", (0, 0, 15), (20, 6, 15.1)),
            ("table", (2, 0, 2), (3.4, 0.75, 2.8)), ("cabinet", (10, 0, 12), (11, 2, 12.5)),
            ("chair", (16, 0, 5), (16.5, 0.9, 5.5))])
        out = self.folder / "hall"
        made = run("export", hall, "--out", out, "--max-frames", 24, "--unit", 1,
                   "--set", "octree_resolution_m=0.2", "--set", "camera_radius_m=0.2",
                   "--set", "width_px=64", "--set", "height_px=48", "--modalities", "rgb")
        self.assertEqual(made.returncode, 0, made.stderr)
        pictures = json.loads((out / "dataset.json").read_text())["metrics"]["pictures"]
        self.assertGreater(pictures["measured"], 8)
        self.assertEqual((pictures["white"], pictures["dark"]), ([], []))

    def test_a_folder_that_cannot_be_written_is_told_at_once(self):
        self.assertFails(run("export", self.project, "--out", "/proc/nothing"), 6, "/proc/nothing")
        result = run("export", self.project, "--out", "/proc/nothing", "--progress", "json")
        self.assertEqual([list(line) for line in lines_of(result.stderr)], [["error"]])

    # --- watching

    def test_progress_for_programs_rises_to_the_end(self):
        out = self.new_folder()
        begin = time.time()
        result = run("export", self.project, "--out", out, "--progress", "json", "--json")
        elapsed = time.time() - begin
        lines = lines_of(result.stderr)
        json.loads(result.stdout)
        steps = [line for line in lines if "fraction" in line]
        self.assertGreater(len(steps), 2)
        fractions = [step["fraction"] for step in steps]
        self.assertEqual(fractions, sorted(fractions))
        self.assertTrue(all(0 <= fraction <= 1 for fraction in fractions))
        self.assertLessEqual(len(steps), 10 * elapsed + 1)
        counted = [step for step in steps if "frames" in step]
        self.assertTrue(counted)
        self.assertEqual({step["frames"] for step in counted}, {len(list(out.glob("rgb/*.png")))})
        done = [step["frames_done"] for step in counted]
        self.assertEqual(done, sorted(done))
        for step in counted:
            if "frames_per_s" in step:
                self.assertAlmostEqual(step["seconds_left"] * step["frames_per_s"],
                                       step["frames"] - step["frames_done"], delta=0.5)
        self.assertTrue(lines[-1]["done"])
        self.assertEqual(lines[-1]["exit_code"], 0)
        self.assertEqual(lines[-1]["frames_done"], lines[-1]["frames"])

    def test_errors_and_notes_for_programs(self):
        def last(*arguments):
            result = run(*arguments, "--progress", "json")
            error = lines_of(result.stderr)[-1]["error"]
            self.assertEqual(error["exit_code"], result.returncode)
            return error

        error = last("export", self.folder / "none.dolly", "--out", self.folder / "x")
        self.assertEqual((error["code"], error["exit_code"]), ("bad_input", 4))
        self.assertIn("none.dolly", error["where"])
        self.assertEqual(last("export", self.project, "--out", "/proc/x")["code"], "cannot_write")
        self.assertEqual(last("plan", APARTMENT, "--set", "fil=1")["code"], "usage")
        self.assertIn("--ranges", last("export", self.project, "--ranges", "1:2")["message"])
        self.assertEqual(last("exprot")["code"], "usage")
        unmet = run("plan", self.project, "--require", "objects>=100000", "--progress=json")
        lines = lines_of(unmet.stderr)
        self.assertTrue(any("not met" in line.get("log", {}).get("message", "") for line in lines))
        self.assertEqual(lines[-1]["exit_code"], 3)

        process = start("export", self.project, "--out", self.new_folder(), "--progress", "json")
        for line in process.stderr:
            if json.loads(line).get("frames_done", 0) > 0:
                break
        process.send_signal(signal.SIGTERM)
        rest = lines_of(process.communicate()[1])
        self.assertEqual(process.returncode, 143)
        self.assertEqual(rest[-1]["error"]["code"], "cancelled")

    # --- choosing

    def test_modalities_and_formats_are_those_asked_for(self):
        out = self.new_folder()
        result = run("export", self.project, "--out", out, "--modalities", "depth,rgb",
                     "--formats", "coco", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        files = hashes(out)
        self.assertEqual({name.split("/")[0] for name in files},
                         {"rgb", "depth", "annotations.json", "contact_sheet.jpg", "dataset.json"})
        self.assertFalse((out / "instance").exists())
        for name in files.keys() - {"dataset.json"}:
            self.assertEqual(files[name], self.expected[name])
        card = json.loads((out / "dataset.json").read_text())
        whole = json.loads((self.unbroken / "dataset.json").read_text())
        self.assertEqual(card["modalities"], ["rgb", "depth"])
        self.assertEqual(card["formats"], ["coco"])
        self.assertEqual(card["files"].keys(), files.keys() - {"dataset.json"})
        self.assertNotIn("instance", card["conventions"])
        self.assertEqual(card["metrics"], whole["metrics"])
        # A dataset with fewer modalities replaces one with more.
        shutil.copytree(self.unbroken, out, dirs_exist_ok=True)
        run("export", self.project, "--out", out, "--modalities", "depth,rgb", "--formats", "coco",
            "--overwrite")
        self.assertEqual(hashes(out), files)

    # --- path traced images

    REFERENCE = ["--set", "render_mode=reference", "--set", "reference_samples=4",
                 "--range", "0:3"]

    def test_path_traced_pictures_change_nothing_but_colours(self):
        out = {}
        for mode in ["fast", "reference"]:
            out[mode] = self.new_folder()
            result = run("export", self.project, "--out", out[mode], *self.REFERENCE, "--set",
                         f"render_mode={mode}", "--modalities", "all", "--threads",
                         "1" if mode == "fast" else "2")
            self.assertEqual(result.returncode, 0, result.stderr)
        files = {mode: hashes(folder) for mode, folder in out.items()}
        differ = {name for name in files["fast"] if files["fast"][name] != files["reference"][name]}
        self.assertEqual({name.split("/")[0] for name in differ},
                         {"rgb", "rgb_right", "rgb_sensor", "contact_sheet.jpg", "dataset.json"})
        self.assertTrue(all(name in differ for name in files["fast"] if name.startswith("rgb")))
        card = json.loads((out["reference"] / "dataset.json").read_text())
        self.assertEqual(card["parameters"]["picture"],
                         {"render_mode": "reference", "antialias": "4x", "reflections": "mirrors",
                          "anisotropy": 0, "traced_samples": 16, "reference_samples": 4})

    def test_smoother_pictures_change_nothing_but_colours(self):
        files = {}
        for way in ["edges", "4x", "8x"]:
            out = self.new_folder()
            result = run("export", self.project, "--out", out, "--range", "0:3", "--modalities",
                         "all", "--set", f"antialias={way}")
            self.assertEqual(result.returncode, 0, result.stderr)
            files[way] = hashes(out)
        for one, other in [("edges", "4x"), ("4x", "8x")]:
            differ = {name for name in files[one] if files[one][name] != files[other][name]}
            self.assertEqual({name.split("/")[0] for name in differ},
                             {"rgb", "rgb_right", "contact_sheet.jpg", "dataset.json"})
            self.assertTrue(all(name in differ for name in files[one]
                                if name.startswith(("rgb/", "rgb_right/"))))

    def test_path_traced_pictures_are_the_same_on_one_thread_and_continued(self):
        whole, parts = self.new_folder(), self.new_folder()
        result = run("export", self.project, "--out", whole, *self.REFERENCE, "--threads", "2")
        self.assertEqual(result.returncode, 0, result.stderr)
        process = start("export", self.project, "--out", parts, *self.REFERENCE, "--threads", "1")
        wait_for(lambda: list(parts.glob("rgb/*.png")))
        process.send_signal(signal.SIGINT)
        process.communicate()
        # Images of another quality do not continue the dataset.
        other = [word.replace("samples=4", "samples=5") for word in self.REFERENCE]
        if process.returncode != 0:
            self.assertFails(run("export", self.project, "--out", parts, *other, "--resume"), 2,
                             "the way pictures are made")
        result = run("export", self.project, "--out", parts, *self.REFERENCE, "--threads", "1",
                     "--resume")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(hashes(parts), hashes(whole))
        verified = run("verify", whole, "--scene", APARTMENT)
        self.assertEqual(verified.returncode, 0, verified.stdout + verified.stderr)

    def test_dark_pictures_capture_nothing_and_are_counted(self):
        out = self.new_folder()
        arguments = ["export", self.project, "--out", out, "--range", "::32", "--json",
                     "--modalities", "rgb,instance", "--formats", "frames",
                     "--set", "exposure_ev=-10"]
        result = run(*arguments, "--require", "dark_rate<=0.02")
        self.assertFails(result, 3, "not met: dark_rate is 1", "3 dark (frames 0-2)")
        summary = json.loads(result.stdout)
        self.assertEqual(summary["pictures"]["dark"], [0, 1, 2])
        self.assertEqual(summary["counted"]["captured"], 0)
        card = json.loads((out / "dataset.json").read_text())
        self.assertEqual(card["metrics"]["pictures"], summary["pictures"])
        rows = (out / "frames.csv").read_text().splitlines()
        self.assertTrue(rows[0].endswith(",score,picture"))
        self.assertTrue(all(row.endswith(",dark") for row in rows[1:]))
        again = run(*arguments, "--resume", "--require", "dark_rate<=1")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(json.loads(again.stdout)["pictures"], summary["pictures"])
        verified = run("verify", out)
        self.assertEqual(verified.returncode, 0, verified.stdout)
        self.assertIn("note: 3 of 3 images are unusable: 3 dark (frames 0-2)",
                      verified.stdout)
        self.assertNotIn("DAMAGED", verified.stdout)
        self.assertFails(run(*arguments, "--require", "darkrate<=1"), 2, "'dark_rate'")

    def test_images_of_one_colour_are_not_damage(self):
        out = self.new_folder()
        result = run("export", self.project, "--out", out, "--range", "::32",
                     "--set", "lamp_strength=0", "--set", "sky_strength=0", "--set", "sun_strength=0")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertFalse(cv2.imread(str(out / "rgb" / "000000.png")).any())
        verified = run("verify", out)
        self.assertEqual(verified.returncode, 0, verified.stdout)

    def test_presets_choose_modalities_and_formats(self):
        lists = {"nerf": ("rgb,depth", "camera_json,nerfstudio,instant_ngp,colmap"),
                 "slam": ("rgb,depth", "camera_json,tum,euroc,imu,frames,calibration"),
                 "detection": ("rgb", "camera_json,coco,yolo,kitti_objects,instances"),
                 "segmentation": ("rgb,instance,semantic", "camera_json,coco,coco_polygons,yolo"),
                 "everything": ("all", "all")}
        for preset, (modalities, formats) in lists.items():
            with self.subTest(preset):
                ours, same = self.new_folder(), self.new_folder()
                arguments = ("export", self.project, "--range", "0:4", "--out")
                exported = run(*arguments, ours, "--preset", preset)
                self.assertEqual(exported.returncode, 0, exported.stderr)
                run(*arguments, same, "--modalities", modalities, "--formats", formats)
                self.assertEqual(hashes(ours), hashes(same))
                verified = run("verify", ours)
                self.assertEqual(verified.returncode, 0, verified.stdout)

    def test_a_list_replaces_that_of_the_preset(self):
        out = self.new_folder()
        exported = run("export", self.project, "--out", out, "--range", "::32", "--preset", "nerf",
                       "--modalities", "rgb")
        self.assertEqual(exported.returncode, 0, exported.stderr)
        written = json.loads((out / "dataset.json").read_text())
        self.assertEqual(list(written["modalities"]), ["rgb"])
        self.assertTrue((out / "transforms.json").exists(), "the formats are the preset's")
        self.assertFalse((out / "annotations.json").exists())

    def test_presets_are_listed_and_misspelt_ones_refused(self):
        out = self.new_folder()
        self.assertFails(run("export", self.project, "--out", out, "--preset", "nerv"), 2, "nerf")
        shown = run("export", "--help").stdout
        listed = run("export", "--list").stdout
        for name in ("default", "nerf", "slam", "detection", "segmentation", "everything"):
            self.assertIn(name, shown)
            self.assertIn(name, listed)

    def test_unknown_choices_are_usage_errors(self):
        out = self.new_folder()
        self.assertFails(run("export", self.project, "--out", out, "--modalities", "rgb,dept"), 2,
                         "did you mean 'depth'")
        self.assertFails(run("export", self.project, "--out", out, "--formats", "cocoa"), 2,
                         "did you mean 'coco'")
        self.assertFails(run("export", self.project, "--out", out, "--modalities", "rgb,normals"),
                         2, "did you mean 'normal_camera' or 'normal_world'?")
        self.assertFails(run("export", self.project, "--out", out, "--modalities", "depths"), 2,
                         "did you mean 'depth'?")
        self.assertFails(run("export", self.project, "--out", out, "--formats", "kitti_object"), 2,
                         "did you mean 'kitti_objects'?")
        self.assertFails(run("export", self.project, "--out", out, "--formats", "zzz"), 2,
                         "'zzz'; there are coco")
        listed = run("export", "--list")
        self.assertEqual(listed.returncode, 0)
        for word in CHOICES:
            self.assertIn(word, listed.stdout)
            self.assertIn(word, run("export", "--help").stdout)


if __name__ == "__main__":
    unittest.main()
