#!/usr/bin/python3
"""Constraints that users set for a trajectory on the command line, checked by the files that the
program writes.

Usage: constraints_test.py PROGRAM [unittest arguments]
"""
import json
import math
import shutil
import unittest

from support import tiny_room
from support.program import FolderCase, hashes, run


def write_two_rooms(path):
    """Two rooms of 3 x 3 m side by side in x, a door of 0.9 m between them, a box in each; y up."""
    tiny_room.write_boxes(path, [
        ("floor", (0, -0.1, 0), (6.1, 0, 3)),
        ("ceiling", (0, 2.5, 0), (6.1, 2.6, 3)),
        ("wall_1", (-0.1, 0, 0), (0, 2.5, 3)),
        ("wall_2", (6.1, 0, 0), (6.2, 2.5, 3)),
        ("wall_3", (0, 0, -0.1), (6.1, 2.5, 0)),
        ("wall_4", (0, 0, 3), (6.1, 2.5, 3.1)),
        ("wall_5", (3, 0, 0), (3.1, 2.5, 1.05)),
        ("wall_6", (3, 0, 1.95), (3.1, 2.5, 3)),
        ("wall_7", (3, 2, 1.05), (3.1, 2.5, 1.95)),
        ("chest", (0.2, 0, 0.2), (0.8, 0.6, 0.8)),
        ("stool", (5.2, 0, 2.2), (5.7, 0.5, 2.7)),
    ])


class Constraints(FolderCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.room = cls.folder / "room.obj"
        tiny_room.write(cls.room)

    def plan(self, *arguments, scene=None):
        """The metrics and the frames of a plan, and the project that stores it."""
        project = self.folder / f"{self.id()}.dolly"
        result = run("plan", scene or self.room, "--json", "-q", "-o", project, *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        frames = json.loads(project.read_text())["result"]["trajectory"]["frames"]
        return json.loads(result.stdout), frames, project

    def assertLooksFrom(self, frame, position, target):
        for have, wanted in zip(frame["position"], position):
            self.assertAlmostEqual(have, wanted, 9)
        x, y, z, w = frame["quaternion_xyzw"]
        forward = (2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y))
        way = [b - a for a, b in zip(position, target)]
        length = math.hypot(*way)
        for have, wanted in zip(forward, way):
            self.assertAlmostEqual(have, wanted / length, 6)

    def test_a_robot_keeps_its_height_and_looks_level(self):
        rooms = self.folder / "rooms.obj"
        write_two_rooms(rooms)
        _, frames, _ = self.plan("--set", "camera_preset=robot", "--set", "camera_height_m=0.5",
                                 scene=rooms)
        self.assertGreater(len(frames), 10)
        for frame in frames:
            self.assertAlmostEqual(frame["position"][2], 0.5, 4)
            x, y, z, w = frame["quaternion_xyzw"]
            self.assertAlmostEqual(1 - 2 * (x * x + y * y), 0.0, 6)

    def test_ignored_classes_and_names_are_no_targets(self):
        everything, _, _ = self.plan()
        metrics, _, project = self.plan("--ignore", "m?g", "--ignore", "sofa")
        names = {row["object"] for row in metrics["ledger"]}
        self.assertEqual({row["object"] for row in everything["ledger"]} - names, {"mug", "sofa"})
        # The project stores it.
        again, _, _ = self.plan(scene=project)
        self.assertEqual(again["objects"], metrics["objects"])
        only, _, _ = self.plan("--only", "table", "--only", "picture")
        self.assertEqual({row["object"] for row in only["ledger"]}, {"table", "picture"})

    def test_a_slip_in_a_pattern_is_a_usage_error(self):
        for option in ("--ignore", "--only"):
            result = run("plan", self.room, option, "sofaa")
            self.assertEqual(result.returncode, 2)
            self.assertIn(option, result.stderr)
            self.assertIn("did you mean 'sofa'", result.stderr)
        # A class to be ignored may be missing in a scene.
        self.assertEqual(run("plan", self.room, "--ignore", "bathtub").returncode, 0)

    def test_an_end_where_the_camera_cannot_be_is_refused(self):
        for option in ("--start", "--end"):
            result = run("plan", self.room, option, "50,50,1,0,0,1")
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertIn(f"{option}: The camera cannot be at (50.00, 50.00, 1.00)", result.stderr)

    def test_it_begins_and_ends_where_it_is_told_to(self):
        # The file is y up: its (x, y, z) is the world's (x, -z, y).
        start = ((2, -2.5, 1.5), (1, -1, 0.5))
        end = ((2.3, -0.5, 1.7), (0.5, -1.5, 0.4))
        as_text = lambda pose: ",".join(str(v) for point in pose for v in point)
        for budget in (0, 30):
            _, frames, _ = self.plan("--start", as_text(start), "--end", as_text(end),
                                     "--max-frames", budget)
            self.assertLooksFrom(frames[0], *start)
            self.assertLooksFrom(frames[-1], *end)
        _, frames, project = self.plan("--start", as_text(start), "--loop")
        self.assertLooksFrom(frames[0], *start)
        self.assertLooksFrom(frames[-1], *start)
        # Refers to the point by its new name.
        _, frames, _ = self.plan("--end", "start", "--set", "loop=false", scene=project)
        self.assertLooksFrom(frames[-1], *start)

    def test_wrong_ends_are_usage_errors(self):
        for arguments, words in ((("--start", "1,2,3"), "six numbers"),
                                 (("--start", "sofa"), "no pinned point"),
                                 (("--end", "1,1,1,1,1,1"), "--end")):
            result = run("plan", self.room, *arguments)
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertIn(words, result.stderr)
        result = run("plan", self.room, "--loop", "--end", "2,-2.5,1.5,1,-1,0.5")
        self.assertEqual(result.returncode, 2, result.stderr)

    def test_no_frame_leaves_the_pitch_band(self):
        _, frames, _ = self.plan("--set", "min_pitch_deg=-20", "--set", "max_pitch_deg=5")
        for frame in frames:
            x, y, z, w = frame["quaternion_xyzw"]
            pitch = math.degrees(math.asin(1 - 2 * (x * x + y * y)))
            self.assertGreaterEqual(pitch, -20 - 1e-6)
            self.assertLessEqual(pitch, 5 + 1e-6)

    def test_rooms_are_proposed_only_where_they_part_the_motions(self):
        apart = self.folder / "apart.obj"
        tiny_room.write_two(apart)
        result = run("plan", apart, "--max-frames", 12)
        self.assertIn("no collision-free path connects all views", result.stderr)
        self.assertIn("--set rooms=each", result.stderr)
        # A box across one of the rooms, from wall to wall and from floor to ceiling.
        cut = self.folder / "cut.dolly"
        wall = {"op": "add_no_go", "center": [2, -1.5, 1.3], "size": [0.6, 4, 4]}
        self.assertEqual(run("edit", self.room, "-o", cut, "--op", json.dumps(wall)).returncode, 0)
        result = run("plan", cut, "--max-frames", 12)
        self.assertIn("no collision-free path connects all views", result.stderr)
        self.assertNotIn("rooms=each", result.stderr)

    def test_rooms_become_datasets_of_their_own(self):
        scene = self.folder / "two_rooms.obj"
        write_two_rooms(scene)
        metrics, frames, project = self.plan("--set", "rooms=each", "--max-frames", 12, scene=scene)
        self.assertEqual(len(metrics["rooms"]), 2)
        self.assertEqual(sum(room["frames"] for room in metrics["rooms"]), len(frames))
        out = self.folder / "rooms"
        arguments = ("export", project, "--out", out, "--modalities", "rgb", "--json")
        result = run(*arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        summary = json.loads(result.stdout)
        self.assertEqual([room["room"] for room in summary["rooms"]], ["room_1", "room_2"])
        sides, steps = [], []
        for room, planned in zip(summary["rooms"], metrics["rooms"]):
            folder = out / room["room"]
            cameras = json.loads((folder / "camera.json").read_text())
            self.assertEqual(len(cameras), planned["frames"])
            self.assertEqual(len(list((folder / "rgb").glob("*.png"))), planned["frames"])
            self.assertEqual(cameras[0]["time"], 0)
            sides.append({camera["pos"][0] < 3.05 for camera in cameras})
            # A budget leaves out frames, so that the steps within a path have different lengths.
            inside = [frame for frame in frames
                      if (frame["position"][0] < 3.05) == (cameras[0]["pos"][0] < 3.05)]
            steps += [(after["time_s"] - before["time_s"], camera["time"] - last["time"])
                      for before, after, last, camera
                      in zip(inside, inside[1:], cameras, cameras[1:])
                      if before["path"] == after["path"]]
        self.assertEqual(sorted(sides, key=str), [{False}, {True}])
        self.assertGreater(len({round(step, 3) for step, _ in steps}), 1)
        for step, written in steps:
            self.assertAlmostEqual(step, written, places=6)
        listed = json.loads((out / "rooms.json").read_text())["rooms"]
        self.assertEqual([room["name"] for room in listed], ["room_1", "room_2"])
        self.assertEqual([room["frames"] for room in listed],
                         [room["frames"] for room in metrics["rooms"]])
        before = hashes(out)
        self.assertEqual(run(*arguments, "--resume").returncode, 0)
        self.assertEqual(hashes(out), before)
        # Progress counts the frames of all rooms, and missing files are made again.
        shutil.rmtree(out / "room_2")
        lines = run(*arguments, "--resume", "--progress", "json").stderr.splitlines()
        last = json.loads(lines[-1])
        self.assertEqual((last["frames_done"], last["frames"]), (len(frames), len(frames)))
        self.assertEqual(hashes(out), before)
        # The list contains the frames that are written, not all frames of the plan.
        part = self.folder / "part_of_rooms"
        result = run("export", project, "--out", part, "--modalities", "rgb", "--range", "::3")
        self.assertEqual(result.returncode, 0, result.stderr)
        for room in json.loads((part / "rooms.json").read_text())["rooms"]:
            written = list((part / room["name"] / "rgb").glob("*.png"))
            self.assertEqual(room["frames"], len(written))
        # With the rooms joined, everything is one dataset again.
        joined = self.folder / "joined"
        result = run("export", scene, "--out", joined, "--modalities", "rgb", "--max-frames", 8)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue((joined / "camera.json").exists())
        mixed = run("export", project, "--out", joined, "--modalities", "rgb", "--overwrite")
        self.assertEqual(mixed.returncode, 6, mixed.stderr)

    def test_a_must_see_region_is_measured_and_can_be_required(self):
        project = self.folder / "seen.dolly"
        # Around the sofa, in the world's axes.
        operation = json.dumps({"op": "add_region", "name": "sofa corner", "must_see": True,
                                "center": [0.5, -1.5, 0.4], "size": [1.2, 2.2, 0.9]})
        result = run("edit", self.room, "-o", project, "--op", operation)
        self.assertEqual(result.returncode, 0, result.stderr)
        metrics, _, _ = self.plan("--require", "must_see_rate>=0.95", scene=project)
        self.assertEqual(metrics["must_see"][0]["region"], "sofa corner")
        self.assertGreaterEqual(metrics["must_see_rate"], 0.95)
        listed = run("edit", project)
        self.assertIn("must be seen", listed.stdout)
        # One frame cannot show all of it.
        few = run("plan", project, "--max-frames", 1, "--require", "must_see_rate>=0.95", "-q")
        self.assertEqual(few.returncode, 3, few.stderr)

    def test_regions_without_surface_are_named_once(self):
        empty = self.folder / "empty.dolly"
        operations = [arg for name in "abc" for arg in ("--op", json.dumps(
            {"op": "add_region", "name": name, "must_see": True, "center": [1.9, -1.7, 1.8],
             "size": [0.2, 0.2, 0.2]}))]
        result = run("edit", self.room, "-o", empty, *operations)
        self.assertEqual(result.returncode, 0, result.stderr)
        said = " ".join(run("plan", empty, "--max-frames", 4).stderr.split())
        self.assertIn("3 must-see regions contain no surface of the scene: 'a', 'b', 'c'", said)
        self.assertEqual(said.count("no surface of the scene"), 1)

    def test_surface_is_an_objective_with_metrics_of_its_own(self):
        rates = ("surface_seen_rate", "surface_covered_rate", "surface_coverable_rate")
        budget = ("--max-frames", 80)
        objects, _, _ = self.plan(*budget)
        self.assertEqual([rate for rate in rates if rate in objects], [])
        surface, _, project = self.plan(*budget, "--set", "objective=surface", "--set",
                                        "surface_directions=2", "--require",
                                        "surface_seen_rate>=0.95")
        for rate in rates:
            self.assertTrue(0 < surface[rate] <= 1, rate)
        self.assertLessEqual(surface["surface_covered_rate"], surface["surface_coverable_rate"])
        self.assertGreater(surface["surface_patches"], 500)
        # The project keeps objective and metrics, and plans the same again.
        stored = json.loads(project.read_text())
        self.assertEqual(stored["parameters"]["coverage"],
                         {"objective": "surface", "surface_directions": 2, "surface_mm_px": 10.0})
        self.assertEqual(stored["result"]["metrics"]["surface_seen_rate"],
                         surface["surface_seen_rate"])
        again, _, _ = self.plan(scene=project)
        for rate in rates:
            self.assertEqual(again[rate], surface[rate])
        table = run("plan", project, "-q")
        self.assertIn("surface seen", table.stdout)
        self.assertIn("surface covered", table.stdout)

    def test_trackability_has_a_metric_of_its_own(self):
        budget = ("--max-frames", 40)
        without, _, _ = self.plan(*budget)
        self.assertNotIn("trackable_rate", without)
        unmet = run("plan", self.room, "-q", *budget, "--require", "trackable_rate>=0")
        self.assertEqual(unmet.returncode, 3)
        self.assertIn("trackability=on", unmet.stderr)
        plan, _, project = self.plan(*budget, "--set", "motion_preset=slam", "--require",
                                     "trackable_rate>=0")
        self.assertTrue(0 <= plan["trackable_rate"] <= 1)
        self.assertEqual(json.loads(project.read_text())["result"]["metrics"]["trackable_rate"],
                         plan["trackable_rate"])
        again, _, _ = self.plan(scene=project)
        self.assertEqual(again["trackable_rate"], plan["trackable_rate"])
        self.assertIn("trackable", run("plan", project, "-q").stdout)
        # Compared planners are measured without the parameter.
        compared = run("compare", self.room, *budget, "--planners", "dollytrack,uniform", "--json")
        self.assertEqual(compared.returncode, 0, compared.stderr)
        for row in json.loads(compared.stdout)["scenes"][0]["rows"]:
            self.assertTrue(0 <= row["trackable_rate"] <= 1, row)

    def test_the_coverage_curve_knows_surface_if_it_is_an_objective(self):
        for objective, known in (("objects", False), ("both", True)):
            curve = self.folder / f"{objective}.csv"
            self.plan("--max-frames", 6, "--set", f"objective={objective}", "--coverage", curve)
            head, *lines = curve.read_text().splitlines()
            self.assertEqual(head.endswith(",surface_seen_rate,surface_covered_rate"), known)
            for line in lines:
                self.assertEqual(line.count(","), head.count(","))
        seen = [float(line.split(",")[-2]) for line in lines if line.startswith("frames,")]
        self.assertLess(seen[0], seen[-1])

    def test_a_resolution_nearer_than_the_camera_can_come_is_refused(self):
        refused = run("plan", self.room, "-q", "--set", "objective=surface", "--set",
                      "surface_mm_px=0.1")
        self.assertEqual(refused.returncode, 2, refused.stderr)
        self.assertIn("surface_mm_px", refused.stderr)
        self.assertIn("camera_radius_m", refused.stderr)


if __name__ == "__main__":
    unittest.main()
