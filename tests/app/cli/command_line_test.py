#!/usr/bin/python3
"""The program as users and CI jobs call it; checks exit codes and the files that it writes.

Usage: command_line_test.py PROGRAM [unittest arguments]
"""
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time
import unittest

import cv2
import numpy

from partial_scan import write_partial_scan
from support import tiny_room
from support.program import PROGRAM, FolderCase, hashes, run


def decode_rle(counts, height, width):
    """Decodes COCO's compressed run lengths by their published description."""
    runs, i = [], 0
    while i < len(counts):
        value, shift, more = 0, 0, True
        while more:
            c = ord(counts[i]) - 48
            value |= (c & 0x1F) << shift
            more = bool(c & 0x20)
            i += 1
            shift += 5
            if not more and c & 0x10:
                value |= -1 << shift
        runs.append(value + (runs[-2] if len(runs) > 2 else 0))
    flat = numpy.zeros(height * width, bool)
    at, on = 0, False
    for length in runs:
        flat[at : at + length] = on
        at, on = at + length, not on
    assert at == height * width, "the runs must add up to the image"
    return flat.reshape(width, height).T


class CommandLine(FolderCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.room = cls.folder / "room.obj"
        tiny_room.write(cls.room)
        cls.project = cls.folder / "room.dolly"
        cls.planned = run("plan", cls.room, "--json", "-o", cls.project, "--max-frames", 20)
        cls.dataset = cls.folder / "dataset"
        cls.exported = run("export", cls.project, "--out", cls.dataset, "--json")

    # --- planning

    def test_progress_rises_through_all_parts_of_the_work(self):
        watched = run("plan", self.room, "--max-frames", 8, "--bound", "--quality", "--explain",
                      "--coverage", self.folder / "curve.csv", "--progress", "json")
        self.assertEqual(watched.returncode, 0, watched.stderr)
        lines = [json.loads(line) for line in watched.stderr.splitlines()]
        fractions = [line["fraction"] for line in lines if "fraction" in line]
        self.assertTrue(fractions)
        self.assertEqual(fractions, sorted(fractions))
        self.assertLess(fractions[0], 0.2)
        self.assertTrue(all(line["seconds_left"] >= 0 for line in lines if "seconds_left" in line))

    def test_a_scan_says_everywhere_how_much_of_it_was_scanned(self):
        scan = self.folder / "scan.obj"
        write_partial_scan(scan)
        frame = ("--up", "z", "--unit", 1)
        info = run("info", scan, *frame)
        self.assertEqual(info.returncode, 0, info.stderr)
        text = re.search(r"scan: (\d+ % of the rooms was scanned.*)", info.stdout).group(1)
        share = json.loads(run("info", scan, *frame, "--json").stdout)["scanned_share"]
        self.assertTrue(0.3 < share < 0.9, share)
        small = (*frame, "--max-frames", 8, "--set", "width_px=96", "--set", "height_px=72")
        for planner in ("dollytrack", "uniform"):
            asked = (*small, "--planner", planner)
            self.assertIn(text, run("plan", scan, *asked).stdout)
            planned = run("plan", scan, *asked, "--json", "--require", "scanned_share>0.99")
            self.assertEqual(planned.returncode, 3, planned.stderr)
            self.assertEqual(json.loads(planned.stdout)["scanned_share"], share)
        # A project stores it with its plan.
        project = self.folder / "scan.dolly"
        self.assertEqual(run("plan", scan, *small, "-o", project).returncode, 0)
        self.assertIn(text, run("export", project, "--out", self.folder / "scanned").stdout)
        again = run("export", project, "--out", self.folder / "scanned", "--resume", "--json")
        self.assertEqual(json.loads(again.stdout)["planned"]["scanned_share"], share)
        self.assertNotIn("scanned_share", json.loads(self.planned.stdout))

    def test_plan_prints_the_published_metrics(self):
        self.assertEqual(self.planned.returncode, 0, self.planned.stderr)
        metrics = json.loads(self.planned.stdout)
        for name in """objects capture_rate well_captured_rate small_capture_rate area_share_box
                       area_share_mask repeat_rate object_pixels corner_collision_rate
                       frame_collision_rate path_length_m frames map_ms plan_ms stages
                       uncaptured""".split():
            self.assertIn(name, metrics)
        self.assertEqual(metrics["objects"], 5)
        self.assertEqual(metrics["capture_rate"], 1.0)
        self.assertLessEqual(metrics["frames"], 20)
        self.assertEqual(metrics["frame_collision_rate"], 0.0)

    def test_the_table_says_what_is_small(self):
        small = [line.split() for line in run("plan", self.room, "--max-frames", 20).stdout.splitlines()
                 if "small objects" in line]
        rate = json.loads(self.planned.stdout)["small_capture_rate"]
        self.assertEqual(small, [f"small objects {100 * rate:.1f} % captured (below 0.1 m3)".split()])

    def test_bound_is_no_less_than_what_was_reached(self):
        metrics = json.loads(run("plan", self.room, "--json", "--bound").stdout)
        self.assertGreaterEqual(metrics["capturable_rate"], metrics["capture_rate"])
        self.assertGreaterEqual(metrics["well_capturable_rate"], metrics["well_captured_rate"])
        missed = [row["object"] for row in metrics["ledger"] if not row["well_captured"]]
        self.assertLessEqual(set(metrics["missed_well_capturable"]), set(missed))
        self.assertAlmostEqual(
            metrics["well_capturable_rate"] - metrics["well_captured_rate"],
            len(metrics["missed_well_capturable"]) / metrics["objects"], delta=1e-9)

    def test_requirements_decide_the_exit_code(self):
        self.assertEqual(run("plan", self.room, "--require", "capture_rate>=0.9").returncode, 0)
        spaced = run("plan", self.room, "--require", " capture_rate >= 90 % ")
        self.assertEqual(spaced.returncode, 0, spaced.stderr)
        self.assertEqual(run("plan", self.room, "--require", "capture_rate<=10%").returncode, 3)
        unmet = run("plan", self.room, "--require", "objects>=6")
        self.assertEqual(unmet.returncode, 3)
        self.assertIn("objects is 5", unmet.stderr)

    def test_another_planner_can_be_named(self):
        asked = ("--planner", "uniform", "--max-frames", 12, "--set", "width_px=96",
                 "--set", "height_px=72")
        planned = json.loads(run("plan", self.room, *asked, "--json").stdout)
        judged = json.loads(run("compare", self.room, "--planners", "uniform", "--json",
                                *asked[2:]).stdout)["scenes"][0]["rows"][0]
        for name in ["capture_rate", "well_captured_rate", "area_share_box", "path_length_m"]:
            self.assertEqual(planned[name], judged[name], name)
        out = self.folder / "uniform"
        exported = run("export", self.room, *asked, "--out", out)
        self.assertEqual(exported.returncode, 0, exported.stderr)
        card = json.loads((out / "dataset.json").read_text())
        self.assertEqual(card["metrics"]["planned"]["planner"], "uniform")
        self.assertEqual(len(list(out.glob("rgb/*.png"))), 12)
        # A dataset of our own plan is a different dataset.
        self.assertFails(run("export", self.room, *asked[2:], "--out", out, "--resume"), 2)
        self.assertFails(run("plan", self.room, "--planner", "unifrm"), 2, "uniform")
        self.assertFails(run("plan", self.room, *asked, "-o", self.folder / "u.dolly"), 2, "--out")
        unmet = run("plan", self.room, *asked, "--require", "path_length_m<=3")
        self.assertEqual(unmet.returncode, 3)
        self.assertIn("has no value", unmet.stderr)

    def test_longest_branch_is_another_way(self):
        branch = run("plan", self.room, "--json", "--set", "path_mode=longest_branch")
        self.assertEqual(branch.returncode, 0)
        tour = json.loads(run("plan", self.room, "--json").stdout)
        self.assertLessEqual(json.loads(branch.stdout)["captured"], tour["captured"])

    def test_info_knows_the_room(self):
        info = json.loads(run("info", self.room, "--json").stdout)
        self.assertEqual(len(info["rooms"]), 1)
        targets = [o["name"] for o in info["objects"] if o["role"] == "target"]
        self.assertEqual(sorted(targets), ["book", "mug", "picture", "sofa", "table"])
        self.assertIn("room", run("info", self.room).stdout)

    def test_a_missing_class_has_the_same_word_everywhere(self):
        scene = self.folder / "unknown.obj"
        scene.write_text(self.room.read_text().replace("o mug\n", "o xyzzy\n"))
        for arguments in (["info"], ["plan", "--explain", "--max-frames", 20]):
            printed = run(*arguments, scene).stdout
            rows = [line.split() for line in printed.splitlines() if "xyzzy" in line]
            self.assertTrue(rows, printed)
            self.assertTrue(all("void" not in row for row in rows), rows)
            self.assertTrue(any("unknown" in row for row in rows), rows)

    # --- usage and bad input

    def test_wrong_parameters_are_usage_errors(self):
        self.assertFails(run("plan", self.room, "--set", "fil=0.5"), 2, "did you mean 'fill'")
        self.assertFails(run("plan", self.room, "--set", "fill=7"), 2, "fill", "0.1 .. 1")
        self.assertFails(run("plan", self.room, "--set", "fill=wide"), 2, "not a number")
        self.assertFails(run("plan", self.room, "--set", "path_mode=round"), 2, "longest_branch")
        self.assertFails(run("plan", self.room, "--require", "objects"), 2, "--require")
        for never in ("capture_rate>=90", "capture_rate>=-5", "area_share_box>=800%"):
            self.assertFails(run("plan", self.room, "--require", never), 2, "between 0 and 1")
        self.assertFails(run("plan", self.room, "--require", "objects>=80%"), 2, "without %")
        self.assertFails(run("plan", self.room, "--require", "objets>=1"), 2, "'objects'")
        self.assertEqual(run("plan").returncode, 2)
        self.assertFails(run("paln", self.room), 2)
        for arguments, words in [
            (["paln", self.room], ["subcommand 'paln'", "'plan'"]),
            (["plan", self.room, "--max-frame=3"], ["option '--max-frame'", "'--max-frames'"]),
            (["--thread", 2, "plan", self.room], ["option '--thread'", "'--threads'"]),
            (["--threads", 2, "export", self.room, "--oot", "x"], ["'--oot'", "'--out'"]),
            (["zzzzzzzz"], ["no subcommand 'zzzzzzzz'."]),
            (["paln", "--help"], ["subcommand 'paln'", "'plan'"]),
            (["plan", self.room, "--set", "foo=1"], ["no parameter 'foo'; there are"]),
            (["plan", self.room, "--max-frames", "x"],
             ["'x' is not a whole number, but --max-frames needs one."]),
            (["plan", self.room, "--max-length", "x"], ["'x' is not a number", "--max-length"]),
            (["plan", self.room, "--set", "fill=0.5", "seed=2"], ["'seed=2'", "repeat --set"]),
            (["sweep", self.room, "--param", "fill=0.4,0.5", "--metric", "foo"],
             ["metric is unknown", "well_captured_rate"]),
            (["edit", self.room, "-o", "x.dolly", "--op", "{op:1}"],
             ["--op:1:2", "double quotes"]),
        ]:
            result = run(*arguments)
            self.assertEqual(result.returncode, 2)
            for word in words:
                self.assertIn(word, result.stderr)
        self.assertEqual(run("--help").returncode, 0)

    def test_missing_files_are_said_to_be_missing(self):
        nowhere = self.folder / "nowhere.txt"
        for arguments in (["compare", self.room, "--planners", "uniform", "--trajectory", nowhere],
                          ["edit", self.project, "--script", nowhere]):
            self.assertFails(run(*arguments), 4, "no such file", "nowhere.txt")

    def test_lists_that_leave_no_target_are_warned_of(self):
        result = run("plan", self.room, "-q", "--only", "floor")
        self.assertEqual(result.returncode, 0)
        self.assertEqual(result.stderr.count("warning: edits: "), 1, result.stderr)
        # Lists that contradict each other are a usage error.
        both = ("--only", "sofa", "--ignore", "sofa")
        self.assertFails(run("plan", self.room, "-q", *both), 2, "--ignore: No target is left")
        result = run("plan", self.room, "-q", *both, "--only", "table", "--max-frames", 4)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_nothing_has_no_rates(self):
        result = run("plan", self.room, "-q", "--ignore", "*", "--json")
        metrics = json.loads(result.stdout)
        for name in ("capture_rate", "small_capture_rate", "frame_collision_rate",
                     "min_clearance_m"):
            self.assertIsNone(metrics[name], name)
        self.assertIn("minimum clearance      -", run("plan", self.room, "--ignore", "*").stdout)
        result = run("plan", self.room, "--ignore", "*", "--require", "capture_rate>=0")
        self.assertEqual(result.returncode, 3)
        self.assertIn("nothing to measure", result.stderr)

    def test_a_band_without_a_free_place_is_named(self):
        band = ("--set", "min_height_m=90", "--set", "max_height_m=95")
        result = run("plan", self.room, *band)
        self.assertEqual(result.returncode, 0)
        self.assertIn("min_height_m=90 and max_height_m=95 leave", result.stderr)
        self.assertFails(run("export", self.room, *band, "--out", self.folder / "nowhere"), 1,
                         "is empty: min_height_m=90")

    def test_lists_are_required_by_their_length(self):
        self.assertEqual(run("plan", self.room, "--require", "refused_pins<=0").returncode, 0)
        self.assertFails(run("plan", self.room, "--require", "zzz>=1"), 2, "there are '")

    def test_anchors_are_counted_and_missing_ones_told(self):
        result = run("plan", self.room, "--set", "anchors=corridors", "--max-frames", 10)
        self.assertIn("has no corridors", result.stderr)
        self.assertIn("none in this scene", result.stdout)
        result = run("plan", self.room, "--set", "anchors=all", "--max-frames", 10, "--json")
        self.assertEqual([row["kind"] for row in json.loads(result.stdout)["anchors"]],
                         ["doorways", "openings", "corridors"])
        self.assertNotIn("anchors", json.loads(self.planned.stdout))

    def test_bad_scenes_are_one_sentence_and_exit_code_4(self):
        def scene(name, content):
            path = self.folder / name
            path.write_bytes(content)
            return path

        self.assertFails(run("plan", self.folder / "none.obj"), 4, "none.obj")
        self.assertFails(run("plan", scene("empty.obj", b"")), 4, "empty.obj")
        self.assertFails(run("plan", scene("points.obj", b"v 0 0 0\nv 1 0 0\n")), 4)
        self.assertFails(run("plan", scene("room.xyz", b"hello")), 4, "xyz")
        self.assertFails(run("plan", scene("room.c4d", b"QC4DC4D6")), 4, "glTF")
        pointer = b"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n"
        self.assertFails(run("plan", scene("lfs.glb", pointer)), 4, "LFS")
        # A solid crate: the camera fits nowhere.
        lines = []
        tiny_room.box("crate", (0, 0, 0), (0.1, 0.1, 0.1), lines, 0)
        crate = scene("crate.obj", "\n".join(lines).encode())
        self.assertFails(run("plan", crate, "--unit", 1), 4, "camera")

    def test_names_that_could_not_be_opened_again_are_refused(self):
        self.assertFails(run("plan", self.room, "-o", "room.txt"), 2, ".dolly")
        self.assertFails(run("plan", self.room, "--picture", "room.jpg"), 2, ".png")
        alone = run("plan", self.room, "--storey", "1")
        self.assertEqual(alone.returncode, 2)
        self.assertIn("--storey requires --picture", alone.stderr)
        self.assertFails(run("plan", self.room, "--picture", self.folder / "room.png", "--storey",
                             "2"), 2, "There is no storey 2")

    def test_a_project_without_its_scene_says_so(self):
        project = json.loads(self.project.read_text())
        project["scene"]["path"] = "moved.obj"
        path = self.folder / "moved.dolly"
        path.write_text(json.dumps(project))
        self.assertFails(run("export", path, "--out", self.folder / "x"), 4, "moved.obj", "project")

    def test_a_project_in_another_folder_finds_its_scene(self):
        there = self.folder / "there"
        beside = self.folder / "beside"
        for folder in (there, beside):
            folder.mkdir()
        shutil.copy(self.room, there / "room.obj")
        (self.folder / "far").mkdir()
        (self.folder / "far/link").symlink_to(beside, target_is_directory=True)
        (there / "data").symlink_to(there, target_is_directory=True)
        for output in ("../beside/one.dolly", "../far/link/two.dolly", "three.dolly"):
            planned = run("plan", "room.obj", "-o", output, "--max-frames", "20", cwd=there)
            self.assertEqual(planned.returncode, 0, planned.stderr)
            project = there / output
            stored = json.loads(project.read_text())["scene"]["path"]
            self.assertFalse(pathlib.Path(stored).is_absolute(), stored)
            self.assertEqual(run("info", project).returncode, 0, stored)
        run("plan", "data/room.obj", "-o", "four.dolly", "--max-frames", "20", cwd=there)
        self.assertEqual(json.loads((there / "four.dolly").read_text())["scene"]["path"],
                         "data/room.obj", "a folder with links can be moved")

    def test_broken_projects_are_bad_input(self):
        def project(text):
            path = self.folder / "broken.dolly"
            path.write_text(text)
            return run("plan", path)

        self.assertFails(project("{"), 4, "JSON", "broken.dolly:1")
        self.assertFails(project("[]"), 4, "project")
        self.assertFails(project('{"dollytrack_project": 99}'), 4, "version 99")
        self.assertFails(project("[" * 100000), 4, "nested")
        good = json.loads(self.project.read_text())
        good["parameters"]["viewpoints"]["fill"] = 9
        self.assertFails(project(json.dumps(good)), 4, "viewpoints.fill")

    # --- projects and datasets

    def test_a_project_keeps_its_plan_and_what_it_does_not_know(self):
        project = json.loads(self.project.read_text())
        self.assertEqual(project["scene"]["path"], "room.obj")
        self.assertEqual(project["parameters"]["timing"]["max_frames"], 20)
        project["notes"] = "mine"
        path = self.folder / "kept.dolly"
        path.write_text(json.dumps(project))
        again = self.folder / "again.dolly"
        self.assertEqual(run("plan", path, "-o", again).returncode, 0)
        saved = json.loads(again.read_text())
        self.assertEqual(saved["notes"], "mine")
        self.assertEqual(saved["result"], project["result"])

    def test_a_project_remembers_how_to_read_its_scene(self):
        path = self.folder / "centimetres.dolly"
        lines = [line if not line.startswith("v ") else
                 "v " + " ".join(str(100 * float(x)) for x in line.split()[1:])
                 for line in self.room.read_text().splitlines()]
        scene = self.folder / "room_cm.obj"
        scene.write_text("\n".join(lines))
        planned = run("plan", scene, "--unit", 0.01, "-o", path, "--json", "--max-frames", 5)
        self.assertEqual(planned.returncode, 0, planned.stderr)
        again = run("plan", path, "--json")
        self.assertEqual(json.loads(again.stdout)["path_length_m"],
                         json.loads(planned.stdout)["path_length_m"])
        self.assertEqual(json.loads(path.read_text())["scene"]["import"], {"unit_m": 0.01})

    def test_the_same_bytes_from_scene_and_project_and_any_threads(self):
        self.assertEqual(self.exported.returncode, 0, self.exported.stderr)
        for threads in (1, 2):
            out = self.folder / f"threads{threads}"
            result = run("export", self.room, "--max-frames", 20, "--out", out, "--threads", threads,
                         env=dict(os.environ, LC_ALL="C", TZ="Asia/Tokyo"))
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(hashes(out), hashes(self.dataset))

    def test_planned_and_counted_agree_within_one_object(self):
        summary = json.loads(self.exported.stdout)
        for name in ("captured", "well_captured"):
            self.assertLessEqual(abs(summary["planned"][name] - summary["counted"][name]), 1)

    def test_images_are_what_the_card_says(self):
        card = json.loads((self.dataset / "dataset.json").read_text())
        cameras = json.loads((self.dataset / "camera.json").read_text())
        frames = sorted((self.dataset / "rgb").iterdir())
        self.assertEqual(len(frames), len(cameras))
        names = {f"{i:06}.png" for i in range(len(cameras))}
        for kind, depth, shape in [("rgb", numpy.uint8, (480, 640, 3)),
                                   ("depth", numpy.uint16, (480, 640)),
                                   ("instance", numpy.uint16, (480, 640)),
                                   ("semantic", numpy.uint8, (480, 640))]:
            self.assertEqual({path.name for path in (self.dataset / kind).iterdir()}, names)
            image = cv2.imread(str(self.dataset / kind / "000000.png"), cv2.IMREAD_UNCHANGED)
            self.assertEqual((image.dtype, image.shape), (depth, shape))
        self.assertTrue(all(5 < cv2.imread(str(path)).mean() < 250 for path in frames))
        self.assertNotIn("plan_ms", json.dumps(card))  # nothing that differs from run to run

    def test_coco_masks_boxes_and_ids_agree_with_the_images(self):
        coco = json.loads((self.dataset / "annotations.json").read_text())
        self.assertTrue(coco["annotations"])
        files = {image["id"]: image["file_name"] for image in coco["images"]}
        self.assertGreaterEqual(min(a["id"] for a in coco["annotations"]), 1)
        for annotation in coco["annotations"]:
            height, width = annotation["segmentation"]["size"]
            mask = decode_rle(annotation["segmentation"]["counts"], height, width)
            self.assertEqual(mask.sum(), annotation["area"])
            rows, columns = numpy.where(mask)
            self.assertEqual(annotation["bbox"],
                             [columns.min(), rows.min(), numpy.ptp(columns) + 1, numpy.ptp(rows) + 1])
            name = pathlib.Path(files[annotation["image_id"]]).name
            instance = cv2.imread(str(self.dataset / "instance" / name), cv2.IMREAD_UNCHANGED)
            self.assertEqual(len(set(instance[mask])), 1)

    def test_depth_lies_on_the_room(self):
        # Unprojected with camera.json alone (pos, target, fov), the depth must stay in the room.
        cameras = json.loads((self.dataset / "camera.json").read_text())
        for index in (0, len(cameras) - 1):
            camera = cameras[index]
            depth = cv2.imread(str(self.dataset / "depth" / f"{index:06}.png"),
                               cv2.IMREAD_UNCHANGED) / 1000.0
            position = numpy.array(camera["pos"])
            forward = numpy.array(camera["target"]) - position
            forward /= numpy.linalg.norm(forward)
            right = numpy.cross(forward, [0, 1, 0])
            right /= numpy.linalg.norm(right)
            down = numpy.cross(forward, right)
            focal = 320 / numpy.tan(numpy.radians(camera["fov"] / 2))
            v, u = numpy.mgrid[0:480, 0:640] + 0.5
            points = (position + depth[..., None] * (forward + ((u - 320) / focal)[..., None] * right
                                                     + ((v - 240) / focal)[..., None] * down))
            inside = points[depth > 0]
            self.assertTrue((inside > [-0.02, -0.02, -0.02]).all())
            self.assertTrue((inside < [4.02, 2.62, 3.02]).all())

    def test_depth_lies_on_a_moving_thing_where_it_is_at_that_time(self):
        """All pixels of the sofa lie on its box, which its track has turned and moved halfway."""
        keys = [{"time_s": 0}, {"time_s": 4, "offset": [0.8, 0, 0], "turn_deg": 80}]
        still, project, out = (self.folder / name for name in ("keys.dolly", "at_2_s.dolly", "at_2"))
        still.write_bytes(self.project.read_bytes())
        self.assertEqual(run("edit", still, "--op", json.dumps(
            {"op": "object_track", "object": "sofa", "keys": keys})).returncode, 0)
        self.assertEqual(run("plan", still, "--time", 2, "-o", project,
                             "--max-frames", 12).returncode, 0)
        for options, time_at in ((["--still"], lambda frame: 2.0),
                                 ([], lambda frame: min(frame["time_s"], 4.0))):
            with self.subTest(options):
                self.check_sofa(project, out, options, time_at)

    def check_sofa(self, project, out, options, time_at):
        exported = run("export", project, "--out", out, "--modalities", "depth,instance",
                       "--overwrite", *options)
        self.assertEqual(exported.returncode, 0, exported.stderr)
        info = json.loads((out / "dataset.json").read_text())
        sofa = next(entry for entry in info["objects"] if entry["name"] == "sofa")
        lens = info["conventions"]["intrinsics"]
        seen = 0
        for i, frame in enumerate(info["frames"]):
            # In the file it fills x 0.1..0.9, y -2.4..-0.6, z 0..0.7.
            gone = time_at(frame) / 4.0
            middle, half = numpy.array([0.5 + 0.8 * gone, -1.5, 0.35]), [0.4, 0.9, 0.35]
            turn = numpy.radians(80 * gone)
            depth = cv2.imread(str(out / f"depth/{i:06}.png"), cv2.IMREAD_UNCHANGED) / 1000.0
            ids = cv2.imread(str(out / f"instance/{i:06}.png"), cv2.IMREAD_UNCHANGED)
            v, u = numpy.nonzero((ids == sofa["id"]) & (depth > 0))
            z = depth[v, u]
            point = numpy.stack([(u + 0.5 - lens["cx"]) / lens["fx"] * z,
                                 (v + 0.5 - lens["cy"]) / lens["fy"] * z, z], axis=1)
            x, y, z, w = frame["quaternion_xyzw"]
            rotation = numpy.array(
                [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                 [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                 [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
            apart = point @ rotation.T + frame["position"] - middle
            c, s = numpy.cos(turn), numpy.sin(turn)
            level = numpy.stack([c * apart[:, 0] + s * apart[:, 1],
                                 c * apart[:, 1] - s * apart[:, 0], apart[:, 2]], axis=1)
            beyond = numpy.abs(level) - half
            # On one of its sides and outside none, within a millimetre, the resolution of the
            # depth.
            if len(point):
                self.assertLess(numpy.abs(beyond.max(axis=1)).max(), 0.003, frame)
            seen += len(point)
        self.assertGreater(seen, 10_000)

    def test_range_picks_frames(self):
        out = self.folder / "range"
        self.assertEqual(run("export", self.project, "--out", out, "--range", "2:9:3").returncode, 0)
        self.assertEqual(len(list((out / "rgb").iterdir())), 3)
        self.assertFails(run("export", self.project, "--out", out, "--range", "a"), 2)

    def test_a_folder_that_cannot_be_written_is_exit_code_6(self):
        in_the_way = self.folder / "file"
        in_the_way.write_text("x")
        self.assertFails(run("export", self.project, "--out", in_the_way), 6, "file")
        self.assertFails(run("export", self.project, "--out", "/proc/nothing"), 6, "/proc/nothing")
        self.assertFails(run("plan", self.room, "-o", "/proc/none/room.dolly"), 6)
        with open("/dev/full", "w") as full:
            result = subprocess.run([PROGRAM, "params"], stdout=full, stderr=subprocess.PIPE)
        self.assertEqual(result.returncode, 6)

    def test_ctrl_c_stops_cleanly(self):
        out = self.folder / "stopped"
        process = subprocess.Popen([PROGRAM, "export", self.room, "--out", out],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        deadline = time.time() + 60
        while not list(out.glob("rgb/*.png")) and time.time() < deadline:
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=30)
        self.assertEqual(process.returncode, 130, errors)
        self.assertFalse((out / "dataset.json").exists())
        self.assertEqual([p for p in out.rglob("*") if ".tmp." in p.name], [])
        for image in out.glob("rgb/*.png"):
            self.assertIsNotNone(cv2.imread(str(image)))


if __name__ == "__main__":
    unittest.main()
