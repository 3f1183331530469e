#!/usr/bin/python3
"""Downstream evaluation of planners' frames: compare --outcomes on a tiny room.

Usage: outcomes_test.py PROGRAM [unittest arguments]
"""
import csv
import importlib
import json
import os
import pathlib
import signal
import sys
import unittest
import unittest.mock

import numpy

from support import tiny_room
from support.program import PROGRAM, FolderCase, hashes, run, start, wait_for

PLANNER = "random-keys"
AGAIN = PLANNER + "-again"
STARE = "wall-stare"
FRAMES = 8
# A user-defined judge that answers --check; its other actions follow.
JUDGE = '''"""A judge for tests."""
import json
import sys

if __name__ == "__main__":
    if sys.argv[1] == "--check":
        print("judge 1.0")
        sys.exit(0)
    request = json.load(open(sys.argv[1]))
    rows = [{"planner": entry["planner"], "scene": entry["scene"], "seed": entry["seed"],
             "values": {"one": 1.0, "none": None}} for entry in request["entries"]]

    def write(result):
        with open(sys.argv[2], "w") as file:
            file.write(json.dumps(result))

'''


def write_room(path):
    """The tiny room with black tiles on two of its walls, for programs that detect corners."""
    tiny_room.write(path)
    lines = ["mtllib room.mtl", "usemtl white", *path.read_text().splitlines(), "usemtl black"]
    count = sum(line.startswith("v ") for line in lines)
    tiles = [(x, y) for x in range(8) for y in range(5) if (3 * x + 5 * y) % 7 > 2]
    for i, (x, y) in enumerate(tiles):
        low, size = (0.2 + 0.45 * x, 0.2 + 0.45 * y), 0.12 + 0.03 * ((x + 2 * y) % 5)
        for name, box in (
                ("wall_tile_a", ((low[0], low[1], 2.99), (low[0] + size, low[1] + size, 3))),
                ("wall_tile_b", ((3.99, low[1], 0.75 * low[0]),
                                 (4, low[1] + size, 0.75 * low[0] + size)))):
            count = tiny_room.box(f"{name}{i}", *box, lines, count)
    path.write_text("\n".join(lines) + "\n")
    path.with_suffix(".mtl").write_text("newmtl white\nKd 0.8 0.8 0.8\nnewmtl black\nKd 0.02 0.02 0.02\n")


def add_judge(folder, name, *lines):
    folder.mkdir(exist_ok=True)
    (folder / f"{name}.py").write_text(JUDGE + "".join(f"    {line}\n" for line in lines))


class OutcomesCase(FolderCase):
    keeps_cache = True

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        write_room(cls.folder / "room.obj")
        cls.out = cls.folder / "out"
        cls.judges = cls.folder / "judges"

    def compare(self, outcomes, *arguments):
        return run(*self.command(outcomes, *arguments))

    def command(self, outcomes, *arguments):
        return ["compare", self.folder / "room.obj", "--planners", PLANNER, "--outcomes", outcomes,
                "--out", self.out, "--max-frames", FRAMES, "--resolution", "320x240", *arguments]

    def report(self):
        return json.loads((self.out / "outcomes.json").read_text())

    def table(self):
        with open(self.out / "outcomes.csv", newline="") as file:
            return list(csv.DictReader(file))

    def judged(self, name):
        return next(one for one in self.report()["judges"] if one["judge"] == name)

    def values(self, judge, planner):
        return next(row["values"] for row in self.judged(judge)["rows"]
                    if row["planner"] == planner)


class Outcomes(OutcomesCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        # A program that returns the true trajectory, and one that never starts to track.
        cls.all = cls.command(cls, "features,novel_views,odometry,sfm,slam,surface", "--controls",
                              "--test-frames", 2,
                              "--slam", "true=cp {rgbd_folder}/groundtruth.txt {out}",
                              "--slam", "lost=test -s {settings} && test -s {camera}",
                              "--judge-option", "sfm.every=4", "--judge-option", "slam.runs=2")
        cls.first = run(*cls.all)

    def found(self, judge):
        state = self.judged(judge)["state"]
        if state == "missing" and os.environ.get("DOLLYTRACK_REQUIRE_READERS") != "1":
            self.skipTest(f"{judge}: {self.judged(judge)['notes'][0]}")
        self.assertEqual(state, "done", self.judged(judge)["notes"])

    def test_every_judge_has_a_row_of_every_entry(self):
        self.assertIn(self.first.returncode, (0, 3), self.first.stderr)
        report = self.report()
        self.assertEqual([entry["planner"] for entry in report["entries"]],
                         [PLANNER, AGAIN, STARE])
        self.assertEqual({entry["frames"] for entry in report["entries"]}, {FRAMES})
        for judge in report["judges"]:
            self.assertEqual([row["planner"] for row in judge["rows"]], [PLANNER, AGAIN, STARE])
        missing = [judge for judge in report["judges"] if judge["state"] != "done"]
        self.assertEqual(self.first.returncode, 3 if missing else 0)

    def test_table_csv_and_page_have_the_same_numbers(self):
        rows = self.table()
        page = (self.out / "outcomes.html").read_text()
        self.assertNotIn("src=", page)
        self.assertNotIn("href=", page)
        for row in rows:
            value = self.values("features", row["planner"])["corners_per_frame"]
            self.assertAlmostEqual(float(row["features.corners_per_frame"]), value, places=5)
            self.assertIn(f"<td>{value:.4g}</td>", page)
            self.assertIn(f"{value:.4g}", self.first.stdout)

    def test_the_same_planner_twice_comes_out_equal(self):
        for judge in ("features", "odometry", "surface"):
            if self.judged(judge)["state"] == "done":
                self.assertEqual(self.values(judge, PLANNER), self.values(judge, AGAIN))
                self.assertIn(f"Control: {AGAIN} equals {PLANNER}.", self.judged(judge)["notes"])

    def test_a_camera_at_the_wall_comes_out_bad(self):
        good, bad = self.values("features", PLANNER), self.values("features", STARE)
        self.assertGreater(good["boxes_per_frame"], 0)
        self.assertEqual(bad["boxes_per_frame"], 0)
        self.assertEqual(bad["few_corners_rate"], 1)
        self.assertEqual(bad["matched_pair_rate"], 0)
        self.assertLess(bad["corners_per_frame"], good["corners_per_frame"])
        self.assertTrue(any(f"Control: {STARE} is worst or tied in" in note
                            for note in self.judged("features")["notes"]))

    def test_surface_is_measured_against_what_can_be_seen(self):
        self.found("surface")
        samples = numpy.load(self.out / "references" / "room.npy")
        # The room's box, z up, without the outer sides of its walls and the inside of the sofa.
        low, high = samples[:, :3].min(0), samples[:, :3].max(0)
        numpy.testing.assert_allclose(high - low, [4, 3, 2.6], atol=1e-3)
        numpy.testing.assert_allclose(numpy.linalg.norm(samples[:, 3:], axis=1), 1, atol=1e-5)
        area = 2 * (4 * 3 + 4 * 2.6 + 3 * 2.6)
        self.assertGreater(len(samples) * 0.04 ** 2, 0.7 * area)
        good, bad = self.values("surface", PLANNER), self.values("surface", STARE)
        self.assertLess(good["accuracy_cm"], 1)
        self.assertGreater(good["completion_rate"], 2 * bad["completion_rate"])
        self.assertGreater(bad["completion_cm"], good["completion_cm"])
        self.assertEqual(good["reference_samples"], len(samples))

    def test_novel_views_are_drawn_at_the_uniform_test_views(self):
        self.found("novel_views")
        values = self.values("novel_views", PLANNER)
        self.assertEqual(values["views"], 2)
        self.assertIsNotNone(values["psnr_filled"])
        self.assertLess(values["missing"], self.values("novel_views", STARE)["missing"])

    def test_odometry_tells_lost_pairs(self):
        self.found("odometry")
        lost = [self.values("odometry", one)["open3d_lost_rate"] for one in (PLANNER, STARE)]
        self.assertLess(lost[0], lost[1])
        for planner in (PLANNER, STARE):
            for program in ("open3d", "opencv"):
                values = self.values("odometry", planner)
                if values[f"{program}_lost_rate"] == 1:
                    self.assertIsNone(values[f"{program}_drift_rate"])
                    self.assertIsNone(values[f"{program}_rpe_cm"])

    def test_structure_from_motion_says_how_much_it_registered(self):
        self.found("sfm")
        for planner in (PLANNER, STARE):
            values = self.values("sfm", planner)
            self.assertEqual(values["images"], FRAMES / 4)
            if values["registered_rate"] == 0:
                self.assertIsNone(values["ate_cm"])

    def test_a_model_of_colmap_is_read_as_it_was_written(self):
        """Uses our own export in COLMAP's format, which has the true poses."""
        made = run("export", self.folder / "room.obj", "--out", self.folder / "colmap",
                   "--planner", PLANNER, "--max-frames", 3, "--set", "width_px=64", "--set",
                   "height_px=48", "--formats", "colmap", "--modalities", "rgb,depth")
        self.assertEqual(made.returncode, 0, made.stderr)
        judges = pathlib.Path(PROGRAM).resolve().parent.parent / "share" / "dollytrack" / "judges"
        with unittest.mock.patch.object(sys, "path", [str(judges), *sys.path]):
            dataset, evaluation, sfm = map(importlib.import_module, ("dataset", "evaluation", "sfm"))
        data = dataset.Dataset(self.folder / "colmap")
        poses, _ = sfm.read_model(data.folder / "sparse" / "0")
        numpy.testing.assert_allclose([poses[i] for i in range(3)], data.poses, atol=1e-6)
        estimate = self.folder / "estimate.txt"
        evaluation.write_tum(estimate, data.times, data.poses)
        found = evaluation.evaluate(PROGRAM, data.folder, [estimate], "none")[0]
        self.assertLess(evaluation.figure(found, "ate_m"), 1e-6)

    def test_slam_programs_are_measured_by_evaluate(self):
        values = self.values("slam", PLANNER)
        self.assertEqual(values["true_success_rate"], 1)
        self.assertEqual(values["true_tracked_rate"], 1)
        self.assertLess(values["true_ate_cm"], 1e-4)
        self.assertEqual(values["lost_success_rate"], 0)
        self.assertEqual(values["lost_tracked_rate"], 0)
        self.assertIsNone(values["lost_ate_cm"])

    def test_a_second_run_uses_what_is_there(self):
        before = hashes(self.out)
        times = {path: path.stat().st_mtime_ns for path in self.out.rglob("*")
                 if path.name in ("dataset.json", "result.json", "room.npy")}
        again = run(*self.all)
        self.assertEqual(again.returncode, self.first.returncode, again.stderr)
        self.assertEqual(again.stdout, self.first.stdout)
        self.assertEqual({path: path.stat().st_mtime_ns for path in times}, times)
        self.assertEqual(before, hashes(self.out))

    def test_a_lost_result_is_put_together_from_the_kept_rows(self):
        result = self.out / "judges" / "features" / "result.json"
        before = result.read_bytes()
        result.unlink()
        self.assertEqual(run(*self.all).returncode, self.first.returncode)
        self.assertEqual(result.read_bytes(), before)


class OwnJudges(OutcomesCase):
    def own(self, names, *arguments):
        return self.compare(names, "--judges", self.judges, *arguments)

    def assertNoValues(self, judge, state, *words):
        found = self.judged(judge)
        self.assertEqual(found["state"], state)
        self.assertEqual([row["values"] for row in found["rows"]], [{}])
        for word in words:
            self.assertIn(word, " ".join(found["notes"]))

    def test_a_judge_that_keeps_to_the_rules(self):
        add_judge(self.judges, "good", "write({'judge': 'good', 'rows': rows, 'notes': ['So.']})")
        done = self.own("good")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.values("good", PLANNER), {"one": 1.0, "none": None})
        self.assertEqual(self.judged("good")["notes"], ["So."])

    def test_a_row_of_all_scenes_and_the_test_views(self):
        other = self.folder / "other.obj"
        tiny_room.write(other)
        add_judge(self.judges, "joint", "rows[0]['scene'] = 'all'",
                  "rows[0]['values']['tests'] = len(request[\"tests\"])", "write({'rows': rows})")
        done = self.own("joint", "--test-scene", other, "--test-frames", 2)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.values("joint", PLANNER)["tests"], 6)
        asked = json.loads((self.out / "judges" / "joint" / "request.json").read_text())
        self.assertEqual([(one["distribution"], one["scene"]) for one in asked["tests"]],
                         [(kind, scene) for scene in ("room", "other")
                          for kind in ("uniform", "object_facing", "close")])
        for one in asked["tests"]:
            with open(pathlib.Path(one["dataset"]) / "dataset.json") as file:
                self.assertEqual(len(json.load(file)["frames"]), 2)

    def test_a_missing_judge_says_how_to_get_it(self):
        (self.judges).mkdir(exist_ok=True)
        (self.judges / "absent.py").write_text(
            '"""Measures nothing yet."""\nimport sys\nif __name__ == "__main__":\n'
            '    print("The program x is missing; install Debian\'s x.")\n    sys.exit(3)\n')
        done = self.own("absent")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertEqual([one["frames"] for one in self.report()["entries"]], [0])
        self.assertIn("No judge can run, so no frames were exported.", self.report()["notes"])
        self.assertNoValues("absent", "missing", "install Debian's x")
        listed = run("compare", "--list", "--outcomes", "absent", "--judges", self.judges)
        self.assertEqual(listed.returncode, 0, listed.stderr)
        self.assertIn("Measures nothing yet.", listed.stdout)
        self.assertIn("missing: The program x is missing; install Debian's x.", listed.stdout)

    def test_a_judge_whose_check_fails_is_listed_as_failed(self):
        self.judges.mkdir(exist_ok=True)
        (self.judges / "broken.py").write_text('"""Breaks."""\nimport sys\nif __name__ == "__main__":\n'
                                               '    sys.exit("cannot begin")\n')
        listed = run("compare", "--list", "--outcomes", "broken", "--judges", self.judges)
        self.assertEqual(listed.returncode, 0, listed.stderr)
        self.assertIn("failed: cannot begin", listed.stdout)

    def test_an_entry_without_any_value_is_told(self):
        add_judge(self.judges, "valueless_entry", "rows[0]['values'] = {'one': None}",
                  "write({'rows': rows, 'notes': ['room: out of luck']})")
        done = self.own("valueless_entry")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertEqual(self.judged("valueless_entry")["state"], "done")
        self.assertIn("valueless_entry: room: out of luck", self.table()[0]["notes"])

    def test_an_earlier_result_without_a_row_is_not_used(self):
        stop = self.folder / "stop"
        add_judge(self.judges, "stopping", "import os", f"assert not os.path.exists({str(stop)!r}), 'no'",
                  "write({'rows': rows})")
        self.assertEqual(self.own("stopping").returncode, 0)
        result = self.out / "judges" / "stopping" / "result.json"
        result.write_text(result.read_text().replace(f'"{PLANNER}"', '"x"'))
        stop.touch()
        self.assertEqual(self.own("stopping").returncode, 3)
        self.assertNoValues("stopping", "failed", "no")
        self.assertEqual(self.table()[0]["stopping"], "")

    def test_a_result_of_other_code_is_not_used(self):
        add_judge(self.judges, "importing", "import values_of_it", "rows[0]['values']['one'] = values_of_it.ONE",
                  "write({'rows': rows})")
        for one in (1.0, 2.0):
            (self.judges / "values_of_it.py").write_text(f"ONE = {one}\n")
            self.assertEqual(self.own("importing").returncode, 0)
            self.assertEqual(self.values("importing", PLANNER)["one"], one)

    def test_a_misspelt_option_is_told_before_the_export(self):
        done = self.compare("features", "--judge-option", "features.corners=3")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertNoValues("features", "failed", "has no option 'corners'")
        self.assertEqual([one["frames"] for one in self.report()["entries"]], [0])

    def test_a_missing_slam_program_is_no_failure_to_track(self):
        done = self.compare("slam", "--slam", "x=/no/such/program {rgbd_folder} {out}")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertNoValues("slam", "missing", "'/no/such/program' of --slam x is missing")
        done = self.compare("slam")
        self.assertNoValues("slam", "missing", "give --slam")

    def test_what_a_judge_must_not_write(self):
        for name, line, words in [
            ("rowless", "write({'rows': 5})", "'rows'"),
            ("valueless", "write({'rows': [{'planner': 'x'}]})", "Row 1"),
            ("wordy", "rows[0]['values']['one'] = 'many'; write({'rows': rows})", "'one' in row 1"),
            ("infinite", "rows[0]['values']['one'] = 1e999; write({'rows': rows})", ""),
            ("other", "rows[0]['planner'] = 'x'; write({'rows': rows})", f"no row of {PLANNER}"),
            ("nothing", "pass", ""),
            ("cut", "open(sys.argv[2], 'w').write('{')", ""),
            ("raising", "raise RuntimeError('out of luck')", "out of luck"),
        ]:
            with self.subTest(name):
                add_judge(self.judges, name, line)
                done = self.own(name)
                self.assertEqual(done.returncode, 3, done.stderr)
                self.assertNoValues(name, "failed", words)
                rows = self.table()
                self.assertEqual([row[name] for row in rows], [""])
                self.assertIn(name, rows[0]["notes"])

    def test_a_judge_that_takes_too_long(self):
        add_judge(self.judges, "endless", "while True: pass")
        done = self.own("endless", "--judge-timeout", "1")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertNoValues("endless", "timed out", "longer than 1 s")

    def test_an_interrupted_run_keeps_its_frames(self):
        add_judge(self.judges, "waiting", "print('begun', file=sys.stderr, flush=True)",
                  "while True: pass")
        program = start(*self.command("waiting", "--judges", self.judges))
        log = self.out / "judges" / "waiting" / "log.txt"
        self.assertTrue(wait_for(lambda: log.exists() and log.read_text() == "begun\n"))
        program.send_signal(signal.SIGINT)
        _, said = program.communicate(timeout=120)
        self.assertEqual(program.returncode, 130, said)
        frames = pathlib.Path(self.out, "frames", f"room.{PLANNER}.seed1", "dataset")
        self.assertTrue((frames / "dataset.json").exists())

    def test_usage(self):
        good = ["compare", self.folder / "room.obj", "--outcomes"]
        for arguments, *words in [
            ([*good, "features"], "--out"),
            ([*good, "feature", "--out", self.out], "did you mean features?"),
            ([*good, "features", "--out", self.out, "--csv", "x.csv"], "--csv"),
            ([*good, "features", "--out", self.out, "--resolution", "big"], "320x240"),
            ([*good, "features", "--out", self.out, "--judge-option", "every=3"], "JUDGE.NAME=VALUE"),
            ([*good, "features", "--out", self.out, "--judge-option", "sfm.every=3"], "sfm"),
            ([*good, "slam", "--out", self.out, "--slam", "orb"], "NAME=COMMAND"),
            ([*good, "slam", "--out", self.out, "--judge-option", "slam.programs=x"], "--slam"),
            ([*good, "features", "--out", self.out, "--set", "max_frames=5"], "--max-frames"),
            ([*good, "features", "--out", self.out, "--set", "seed=5"], "--seed"),
            ([*good, "features", "--out", self.out, "--set", "rooms=each"], "one dataset"),
            (["compare", self.folder / "room.obj", "--out", self.out], "--outcomes"),
            (["compare", self.folder / "room.obj", "--controls"], "--outcomes", "--controls"),
            (["compare", "--list", "--test-scene", "x.glb"], "--outcomes", "--test-scene"),
        ]:
            with self.subTest(arguments[3:]):
                self.assertFails(run(*arguments), 2, *words)


if __name__ == "__main__":
    unittest.main()
