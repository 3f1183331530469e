#!/usr/bin/python3
"""Camera motions given by the user: imported, repaired, exported, edited.

Usage: repair_test.py PROGRAM [unittest arguments]
"""
import json
import math
import unittest

from support import tiny_room
from support.program import FolderCase, run

SMALL = ["--set", "width_px=64", "--set", "height_px=48"]
EXPORT = ["--modalities", "rgb,depth", "--formats", "tum,frames,camera_json"]


def tum(frames):
    """Frames of a project's motion as a TUM file."""
    return "".join(" ".join(repr(value) for value in frame[:8]) + "\n" for frame in frames)


def read_tum(path):
    return [[float(word) for word in line.split()] for line in path.read_text().splitlines()
            if line and not line.startswith("#")]


def line(begin, end, count, direction, start_s=0.0):
    """A straight motion at 10 frames per second that looks along a horizontal direction, degrees;
    as [time, x, y, z, qx, qy, qz, qw]."""
    # The camera looks along +x for 0 degrees: x right, y down, z forward.
    half = math.radians(direction) / 2
    base = (-0.5, 0.5, -0.5, 0.5)  # x, y, z, w
    turn = (0, 0, math.sin(half), math.cos(half))
    x = turn[3] * base[0] + turn[0] * base[3] + turn[1] * base[2] - turn[2] * base[1]
    y = turn[3] * base[1] - turn[0] * base[2] + turn[1] * base[3] + turn[2] * base[0]
    z = turn[3] * base[2] + turn[0] * base[1] - turn[1] * base[0] + turn[2] * base[3]
    w = turn[3] * base[3] - turn[0] * base[0] - turn[1] * base[1] - turn[2] * base[2]
    return [[start_s + 0.1 * i,
             *(a + (b - a) * i / (count - 1) for a, b in zip(begin, end)), x, y, z, w]
            for i in range(count)]


class Repair(FolderCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.room = cls.folder / "room.obj"
        tiny_room.write(cls.room)
        # In front of the table and the sofa, at half the speed limit.
        cls.free = line((1.4, -2.4, 1.5), (2.4, -2.4, 1.5), 41, 90)

    def write(self, name, frames):
        path = self.folder / name
        path.write_text(tum(frames))
        return path

    def repair(self, trajectory, *arguments, scene=None):
        """Returns the finished run, its report and the project's motion."""
        project = self.folder / "motion.dolly"
        project.unlink(missing_ok=True)
        done = run("repair", scene or self.room, "--trajectory", trajectory, "-o", project,
                   "--json", *SMALL, *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        edits = json.loads(project.read_text())["edits"]
        return done, json.loads(done.stdout), edits["motion"], project

    def test_a_free_motion_is_kept_and_exported_as_it_is(self):
        path = self.write("free.txt", self.free)
        _, report, motion, project = self.repair(path)
        self.assertEqual(report["name"], "free.txt")
        self.assertEqual(report["frames"], 41)
        change = {name: value for name, value in report["change"].items() if value}
        self.assertEqual(change.pop("given_length_m"), change.pop("length_m"))
        self.assertEqual(change, {})
        for stored, given in zip(motion["frames"], self.free):
            for a, b in zip(stored[:4], given[:4]):
                self.assertAlmostEqual(a, b, delta=1e-12)
            # The reader makes a rotation matrix of the quaternion, and a quaternion of that.
            self.assertAlmostEqual(abs(sum(a * b for a, b in zip(stored[4:8], given[4:8]))), 1,
                                   delta=1e-12)
        out = self.folder / "free"
        done = run("export", project, "--out", out, *EXPORT)
        self.assertEqual(done.returncode, 0, done.stderr)
        written = read_tum(out / "groundtruth.txt")
        self.assertEqual(len(written), 41)
        for frame, stored in zip(written, motion["frames"]):
            for a, b in zip(frame[:4], stored[:4]):
                self.assertAlmostEqual(a, b, delta=1e-6)
        checked = run("verify", out)
        self.assertEqual(checked.returncode, 0, checked.stdout + checked.stderr)
        # The motion is in the dataset's card with the other edits.
        card = json.loads((out / "dataset.json").read_text())
        self.assertEqual(card["edits"], json.loads(project.read_text())["edits"])

    def test_a_planned_trajectory_comes_back(self):
        project = self.folder / "planned.dolly"
        self.assertEqual(run("plan", self.room, "-o", project, *SMALL).returncode, 0)
        planned = json.loads(project.read_text())["result"]["trajectory"]["frames"]
        out = self.folder / "planned"
        done = run("export", project, "--out", out, *EXPORT)
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("groundtruth.txt", "camera.json"):
            _, report, motion, _ = self.repair(out / name, "--no-repair")
            self.assertNotIn("change", report)
            self.assertEqual(len(motion["frames"]), len(planned))
            for frame, given in zip(motion["frames"], planned):
                for a, b in zip(frame[1:4], given["position"]):
                    self.assertAlmostEqual(a, b, delta=2e-6, msg=name)
                dot = abs(sum(a * b for a, b in zip(frame[4:8], given["quaternion_xyzw"])))
                self.assertGreater(dot, 1 - 1e-10, name)

    def test_times_begin_at_zero(self):
        path = self.write("late.txt", line((1.4, -2.4, 1.5), (2.4, -2.4, 1.5), 41, 90, 1.3e9))
        _, report, motion, _ = self.repair(path)
        self.assertEqual(motion["frames"][0][0], 0.0)
        self.assertAlmostEqual(report["duration_s"], 4.0, delta=1e-6)

    def keys_project(self, *arguments):
        """A project with three keys in front of the table; its keys, and the printed report."""
        keys = [self.free[0][:], self.free[20][:], self.free[40][:]]
        for key, time_s in zip(keys, (0.0, 4.0, 9.0)):
            key[0] = time_s
        path = self.write("keys.txt", keys)
        project = self.folder / "keys.dolly"
        project.unlink(missing_ok=True)
        done = run("repair", self.room, "--keys", path, "-o", project, "--json", *SMALL, *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return project, keys, json.loads(done.stdout)

    def test_keys_become_a_smooth_motion_that_is_exported(self):
        project, keys, report = self.keys_project()
        stored = json.loads(project.read_text())["edits"]["motion"]
        self.assertNotIn("frames", stored)
        self.assertEqual([key[0] for key in stored["keys"]], [0.0, 4.0, 9.0])
        self.assertEqual([key["note"] for key in report["keys"]], ["", "", ""])
        planned = run("plan", project).stdout
        missed = json.loads(run("plan", project, "--json").stdout)["uncaptured"]
        self.assertRegex(planned, r"motion +through 3 given camera keys, not planned\n")
        self.assertGreater(len(missed), 0)
        self.assertRegex(planned, rf"not captured +{len(missed)} objects? \(plan --explain lists")
        self.assertNotIn(missed[0]["reason"], planned)
        out = self.folder / "keys"
        done = run("export", project, "--out", out, *EXPORT)
        self.assertEqual(done.returncode, 0, done.stderr)
        written = read_tum(out / "groundtruth.txt")
        self.assertEqual(len(written), 91)
        for frame, key in zip((written[0], written[40], written[90]), keys):
            for a, b in zip(frame[:4], key[:4]):
                self.assertAlmostEqual(a, b, delta=1e-6)
        # It starts and ends at rest and does not jump.
        moves = [math.dist(a[1:4], b[1:4]) for a, b in zip(written, written[1:])]
        self.assertLess(max(moves), 0.05)
        self.assertLess(moves[0], 0.005)
        self.assertLess(moves[-1], 0.005)
        self.assertEqual(run("verify", out).returncode, 0)

    def test_keys_are_edited_and_fitted_to_the_limits(self):
        project, _, _ = self.keys_project()
        done = run("edit", project, "--op", '{"op":"change_camera_key","key":2,"time_s":0.2}',
                   "--op", '{"op":"add_camera_key","time_s":12,"position":[2.4,-2.2,1.5],'
                   '"target":[2.4,0,1]}')
        self.assertEqual(done.returncode, 0, done.stderr)
        planned = run("plan", project, "--json")
        self.assertEqual(planned.returncode, 0, planned.stderr)
        self.assertIn("Key 2 is reached at", planned.stderr)
        keys = json.loads(planned.stdout)["camera_keys"]
        self.assertEqual(len(keys), 4)
        self.assertGreater(keys[1]["time_s"], 1.0)
        fitted = run("repair", project, "--json")
        self.assertEqual(fitted.returncode, 0, fitted.stderr)
        report = json.loads(fitted.stdout)
        self.assertEqual([key["note"] for key in report["keys"]], [""] * 4)
        self.assertAlmostEqual(report["keys"][1]["time_s"], keys[1]["time_s"], places=6)
        self.assertNotIn("Key 2", run("plan", project).stderr)
        listed = run("edit", project)
        self.assertIn("4 key frames in 12.0 s", listed.stdout)

    def test_keys_that_cannot_be_used_are_refused(self):
        path = self.write("keys.txt", self.free)
        both = run("repair", self.room, "--keys", path, "--move", "walk", "-o", "a.dolly")
        self.assertEqual(both.returncode, 2)
        many = self.write("many.txt", line((1.4, -2.4, 1.5), (2.4, -2.4, 1.5), 1001, 90))
        done = run("repair", self.room, "--keys", many, "-o", self.folder / "many.dolly")
        self.assertEqual(done.returncode, 4)
        self.assertIn("1001 keys", done.stderr)
        project = self.folder / "hostile.dolly"
        good, _, _ = self.keys_project()
        for spoil in (lambda keys: keys.reverse(), lambda keys: keys[1].pop(),
                      lambda keys: keys[1].__setitem__(2, 1e300),
                      lambda keys: keys[1].__setitem__(0, "soon"), lambda keys: keys.clear()):
            content = json.loads(good.read_text())
            spoil(content["edits"]["motion"]["keys"])
            project.write_text(json.dumps(content))
            done = run("plan", project)
            self.assertEqual(done.returncode, 4, done.stderr)
            self.assertIn("edits.motion.keys", done.stderr)

    def test_a_collision_is_repaired_or_reported(self):
        # Through the table, 0.74 m high.
        path = self.write("table.txt", line((2.0, -1.5, 0.5), (3.8, -1.5, 0.5), 61, 180))
        _, report, motion, project = self.repair(path)
        self.assertGreater(report["change"]["frames_in_collision"], 10)
        plan = json.loads(run("plan", project, "--json").stdout)
        self.assertTrue(plan["given_motion"])
        self.assertIsNone(plan["corner_collision_rate"])
        self.assertEqual(plan["frame_collision_rate"], 0)
        self.assertEqual(plan["straight_lines_that_hit"], 0)
        self.assertEqual(plan["frames"], len(motion["frames"]))
        _, report, motion, project = self.repair(path, "--no-repair")
        self.assertEqual(len(motion["frames"]), 61)
        done = run("plan", project, "--json")
        self.assertIn("collides in", done.stderr)
        self.assertRegex(done.stderr, "begin at frames? [0-9]+.*, with 'table")
        self.assertGreater(json.loads(done.stdout)["frame_collision_rate"], 0.1)

    def test_a_move_is_made_named_and_free(self):
        project = self.folder / "orbit.dolly"
        done = run("repair", self.room, "--move", "orbit:target=sofa", "-o", project, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(done.stdout)["name"], "orbit:target=sofa")
        plan = json.loads(run("plan", project, "--json").stdout)
        self.assertEqual((plan["frame_collision_rate"], plan["straight_lines_that_hit"]), (0, 0))
        self.assertIn("sofa", [row["object"] for row in plan["ledger"] if row["captured"]])
        self.assertFails(run("repair", self.room, "--move", "orbit:target=soffa", "-o", project), 4,
                         "sofa")
        self.assertFails(run("repair", self.room, "--move", "orbitt", "-o", project), 2, "orbit")
        self.assertFails(run("repair", self.room, "--move", "walk", "--no-repair", "-o", project), 2,
                         "--no-repair")

    def test_a_move_follows_the_keys_of_a_project(self):
        project = self.folder / "keys.dolly"
        for i, x in enumerate((1.5, 2.5)):
            done = run("edit", project if i else self.room, "-o", project, "--op", json.dumps(
                {"op": "add_camera_key", "time_s": 6.0 * i, "position": [x, -1.5, 0.5],
                 "target": [x, 0.0, 0.5]}))
            self.assertEqual(done.returncode, 0, done.stderr)
        before = json.loads(project.read_text())["edits"]["motion"]["keys"]
        self.assertFails(run("repair", project, "--append"), 2, "--move")
        done = run("repair", project, "--move", "walk", "--append", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        keys = json.loads(project.read_text())["edits"]["motion"]["keys"]
        self.assertEqual(keys[:2], before)
        self.assertGreater(len(keys), 4)
        times = [key[0] for key in keys]
        self.assertEqual(times, sorted(set(times)))
        report = json.loads(done.stdout)
        for key in report["keys"]:
            self.assertLess(key["reached_s"] - key["time_s"], 0.1)
        # Without --append the move replaces them.
        done = run("repair", project, "--move", "walk:height=1")
        self.assertEqual(done.returncode, 0, done.stderr)
        motion = json.loads(project.read_text())["edits"]["motion"]
        self.assertEqual(motion["name"], "walk:height=1")
        self.assertNotIn("keys", motion)

    def test_a_project_is_repaired_again_after_an_object_has_moved(self):
        _, _, motion, project = self.repair(self.write("free.txt", self.free))
        moved = self.folder / "moved.dolly"
        # The table stands in the way now.
        done = run("edit", project, "-o", moved, "--op", json.dumps(
            {"op": "move_object", "object": "table", "offset": [-0.9, -0.6, 0.9]}))
        self.assertEqual(done.returncode, 0, done.stderr)
        report = json.loads(run("repair", moved, "--json").stdout)
        self.assertGreater(report["change"]["moves_in_collision"], 0)
        self.assertNotEqual(json.loads(moved.read_text())["edits"]["motion"], motion)
        again = json.loads(run("repair", moved, "--json").stdout)
        self.assertEqual(again["change"]["moves_in_collision"], 0)
        self.assertFails(run("repair", self.room, "-o", moved), 2, "--trajectory")

    def test_times_far_apart_are_refused(self):
        frames = line((0.5, -1.5, 0.4), (2.4, -1.5, 0.4), 20, 0)
        for frame in frames[3:]:
            frame[0] += 9e5
        done = run("repair", self.room, "--trajectory", self.write("gap.txt", frames),
                   "-o", self.folder / "gap.dolly")
        self.assertIn(done.returncode, (0, 4), done.stderr)
        if done.returncode == 4:
            self.assertIn("correct its times", done.stderr)

    def test_parameters_without_effect_are_named(self):
        _, _, _, project = self.repair(self.write("free.txt", self.free))
        done = run("plan", project, "--json", "--max-frames", 5, "--loop")
        self.assertEqual(json.loads(done.stdout)["frames"], 41)
        self.assertIn("not applied to the given camera motion: loop, max_frames",
                      " ".join(done.stderr.split()))
        usual = run("plan", project, "--json")
        self.assertNotIn("not applied", usual.stderr)
        curve = run("plan", project, "--coverage", self.folder / "curve.csv")
        self.assertFails(curve, 2, "clear_motion")

    def test_a_motion_is_listed_and_removed_by_edit(self):
        _, _, _, project = self.repair(self.write("free.txt", self.free))
        listed = run("edit", project)
        self.assertRegex(listed.stdout, r"motion +free.txt +the trajectory, 41 frames in 4.0 s")
        done = run("edit", project, "--op", '{"op":"clear_motion"}', "--plan", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        summary = json.loads(done.stdout)
        self.assertEqual(summary["operations"], ["Remove the camera motion"])
        self.assertGreater(summary["metrics"]["key_frames"], 1)
        self.assertNotIn("motion", json.loads(project.read_text())["edits"])

    def test_compare_plans_although_a_motion_is_given(self):
        _, _, _, project = self.repair(self.write("free.txt", self.free))
        rows = [json.loads(run("compare", scene, "--planners", "dollytrack", "--json", *SMALL,
                               "--max-frames", 8).stdout)["scenes"][0]["rows"][0]
                for scene in (project, self.room)]
        for row in rows:
            del row["plan_ms"]
        self.assertEqual(*rows)

    def test_a_project_keeps_its_other_edits(self):
        first = self.folder / "edited.dolly"
        done = run("edit", self.room, "-o", first, "--op", '{"op":"exclude","object":"sofa"}')
        self.assertEqual(done.returncode, 0, done.stderr)
        before = json.loads(first.read_text())["edits"]
        done = run("repair", first, "--trajectory", self.write("free.txt", self.free))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("frames in collision", done.stdout)
        after = json.loads(first.read_text())["edits"]
        self.assertEqual(after.pop("motion")["name"], "free.txt")
        self.assertEqual(after, before)

    def test_refusals_say_what_to_do(self):
        free = self.write("free.txt", self.free)
        project = self.folder / "refused.dolly"
        out = ["-o", project]
        in_mm = self.write("mm.txt", [[f[0], *(1000 * v for v in f[1:4]), *f[4:]]
                                      for f in self.free])
        empty = self.folder / "empty.txt"
        empty.write_text("# nothing\n")
        for arguments, code, words in (
                ((self.room, *out), 2, ("--trajectory", "--move")),
                ((self.room, *out, "--trajectory", free, "--move", "orbit"), 2, ("only one",)),
                ((self.room, "--trajectory", free), 2, ("-o",)),
                ((self.room, "--trajectory", free, "-o", self.folder / "a.json"), 2, (".dolly",)),
                ((self.room, *out, "--trajectory", in_mm), 4,
                 ("mm.txt", "metres", "--trajectory-world")),
                ((self.room, *out, "--trajectory", in_mm, "--no-repair"), 4, ("metres",)),
                ((self.room, *out, "--trajectory", empty), 4, ("empty.txt",)),
                ((self.room, *out, "--trajectory", self.folder / "none.txt"), 4, ("none.txt",)),
                ((self.room, *out, "--trajectory", free, "--trajectory-format", "x"), 2, ("tum",)),
        ):
            self.assertFails(run("repair", *arguments), code, *words)
            self.assertFalse(project.exists())

    def test_a_damaged_motion_is_refused_with_its_place(self):
        _, _, _, project = self.repair(self.write("free.txt", self.free))
        content = json.loads(project.read_text())
        for spoil, words in ((lambda m: m["frames"][7].__setitem__(0, 0.1), "motion.frames[7]"),
                             (lambda m: m["frames"][7].__setitem__(4, 9), "motion.frames[7]"),
                             (lambda m: m.__setitem__("frames", []), "motion.frames")):
            damaged = json.loads(json.dumps(content))
            spoil(damaged["edits"]["motion"])
            path = self.folder / "damaged.dolly"
            path.write_text(json.dumps(damaged))
            self.assertFails(run("plan", path), 4, "damaged.dolly", words)


if __name__ == "__main__":
    unittest.main()
