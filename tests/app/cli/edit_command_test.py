#!/usr/bin/python3
"""Editing projects from the command line: what an operation changes and what it leaves unchanged.

Usage: edit_command_test.py PROGRAM [unittest arguments]
"""
import json
import os
import unittest

from support import tiny_room
from support.program import FolderCase, run


class EditCommand(FolderCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.room = cls.folder / "room.obj"
        tiny_room.write(cls.room)
        cls.project = cls.folder / "room.dolly"
        run("plan", cls.room, "-o", cls.project, "--max-frames", 20)

    def edited(self, name, *operations, **more):
        """Edits a project of the room with some operations; returns the run and the project's
        JSON."""
        path = self.folder / name
        script = self.folder / (name + ".json")
        script.write_text(json.dumps(operations))
        result = run("edit", self.project, "--script", script, "-o", path, *more.get("also", ()))
        return result, path

    def test_an_excluded_object_is_no_target(self):
        result, path = self.edited("excluded.dolly", {"op": "exclude", "object": "sofa"},
                                   also=["--plan", "--json"])
        self.assertEqual(result.returncode, 0, result.stderr)
        summary = json.loads(result.stdout)
        self.assertEqual(summary["operations"], ["Exclude sofa"])
        self.assertEqual(summary["metrics"]["objects"], 4)
        # All other subcommands use the edited project.
        info = json.loads(run("info", path, "--json").stdout)
        roles = {o["name"]: o["role"] for o in info["objects"]}
        self.assertEqual((roles["sofa"], roles["table"]), ("excluded", "target"))
        self.assertEqual(json.loads(run("plan", path, "--json").stdout)["objects"], 4)
        out = self.folder / "excluded"
        exported = run("export", path, "--out", out, "--json", "--range", "0:2")
        self.assertEqual(exported.returncode, 0, exported.stderr)
        self.assertEqual(json.loads(exported.stdout)["counted"]["objects"], 4)
        card = json.loads((out / "dataset.json").read_text())
        self.assertEqual(card["edits"], json.loads(path.read_text())["edits"])

    def test_edits_take_the_stored_plan_away_and_stay_when_planned(self):
        _, path = self.edited("kept_edits.dolly", {"op": "set", "name": "fill", "value": 0.5},
                              {"op": "merge", "objects": ["mug", "book"], "name": "still life"})
        project = json.loads(path.read_text())
        self.assertNotIn("result", project)
        self.assertEqual(project["dollytrack_project"], 2)
        self.assertEqual(project["parameters"]["viewpoints"]["fill"], 0.5)
        self.assertEqual(project["parameters"]["timing"]["max_frames"], 20)
        again = self.folder / "kept_edits_2.dolly"
        self.assertEqual(run("plan", path, "-o", again).returncode, 0)
        planned = json.loads(again.read_text())
        self.assertEqual(planned["edits"], project["edits"])
        self.assertIn("still life", json.dumps(planned["result"]["observation_points"]))

    def test_a_pinned_pose_is_in_the_plan_to_the_last_digit(self):
        pose = {"position": [1.9, -1.7, 1.3], "target": [0.5, -1.5, 0.35]}
        result, path = self.edited("pinned.dolly", {"op": "pin", "objects": "sofa", **pose},
                                   also=["--plan"])
        self.assertEqual(result.returncode, 0, result.stderr)
        project = json.loads(path.read_text())
        pin = project["edits"]["pinned"][0]
        frames = project["result"]["trajectory"]["frames"]
        kept = [f for f in frames if f["position"] == pin["position"]
                and f["quaternion_xyzw"] == pin["quaternion_xyzw"]]
        self.assertTrue(kept)

    def test_a_bad_operation_leaves_the_file_as_it_was(self):
        path = self.folder / "untouched.dolly"
        path.write_bytes(self.project.read_bytes())
        script = self.folder / "bad.json"
        script.write_text(json.dumps([{"op": "exclude", "object": "sofa"},
                                      {"op": "exclude", "object": "soda"}]))
        self.assertFails(run("edit", path, "--script", script), 2, "operation 2", "'sofa'")
        self.assertFails(run("edit", path, "--op", '{"op":"exclud","object":"sofa"}'), 2, "exclude")
        self.assertFails(run("edit", path, "--op", '{"op":"set","name":"fil","value":1}'), 2, "fill")
        self.assertFails(run("edit", path, "--op", '{"op":"set","name":"fill","value":7}'), 2,
                         "0.1 .. 1")
        self.assertFails(run("edit", path, "--op", "{"), 2, "JSON")
        self.assertFails(run("edit", path, "--script", self.folder / "none.json"), 4, "none.json")
        pipe = self.folder / "pipe"
        os.mkfifo(pipe)
        self.assertFails(run("edit", path, "--script", pipe), 4, str(pipe), "ordinary file")
        self.assertFails(run("edit", path, "--script", self.room), 4, str(self.room), "JSON")
        single = self.folder / "single.json"
        single.write_text('{"op": "exclude", "object": "sofa"}')
        self.assertFails(run("edit", path, "--script", single), 4, str(single), "list")
        self.assertFails(run("edit", path, "--plan"), 2, "--op")
        self.assertFails(run("edit", path, "--unit", 0.01), 2, "--unit")
        broken = json.loads(path.read_text())
        broken["edits"] = {"pinned": 7}
        bad = self.folder / "bad_edits.dolly"
        bad.write_text(json.dumps(broken))
        self.assertFails(run("edit", bad), 4, "bad_edits.dolly")
        self.assertFails(run("edit", self.room, "--op", '{"op":"exclude","object":"sofa"}'), 2, "-o")
        self.assertEqual(path.read_bytes(), self.project.read_bytes())

    def test_without_an_operation_it_lists_the_edits(self):
        result = run("edit", self.project)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("--list", result.stdout)
        operations = [{"op": "exclude", "object": "sofa"},
                      {"op": "set_class", "object": "mug", "class": "box"},
                      {"op": "pin", "objects": "picture", "position": [1.8, -1.5, 1.5],
                       "target": [1.8, 0, 1.5]},
                      {"op": "remove_point", "objects": "book"},
                      {"op": "add_no_go", "center": [1, -1, 1], "size": [1, 0.5, 2]},
                      {"op": "rename_no_go", "name": "no-go box", "to": "stairs"}]
        edited, path = self.edited("listed.dolly", *operations)
        self.assertEqual(edited.returncode, 0, edited.stderr)
        before = path.read_bytes()
        lines = run("edit", path).stdout.splitlines()
        words = [["object", "sofa", "excluded"], ["object", "mug", "box"],
                 ["pinned", "picture", "1.80, -1.50, 1.50"], ["removed", "book"],
                 ["no-go", "stairs", "1.00, 0.50, 2.00"]]
        for expected in words:
            self.assertTrue(any(all(word in line for word in expected) for line in lines),
                            (expected, lines))
        self.assertEqual(len(lines), len(words), lines)
        shown = json.loads(run("edit", path, "--json").stdout)
        self.assertEqual(shown, json.loads(path.read_text())["edits"])
        self.assertEqual(path.read_bytes(), before)

    def test_a_scene_file_becomes_a_project(self):
        path = self.folder / "fresh.dolly"
        result = run("edit", self.room, "-o", path, "--op", '{"op":"exclude","object":"sofa"}',
                     "--op", '{"op":"height_band","min_m":1,"max_m":1.5}', "--plan", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        frames = json.loads(path.read_text())["result"]["trajectory"]["frames"]
        heights = [frame["position"][2] for frame in frames]
        self.assertGreaterEqual(min(heights), 1 - 1e-6)
        self.assertLessEqual(max(heights), 1.5 + 1e-6)

    def test_a_pin_that_cannot_be_kept_is_said(self):
        result, _ = self.edited("refused.dolly",
                                {"op": "pin", "objects": "picture", "position": [0.5, -1.5, 0.35],
                                 "target": [1.8, 0, 1.5]}, also=["--plan", "--json"])
        self.assertEqual(result.returncode, 0, result.stderr)
        refused = json.loads(result.stdout)["metrics"]["refused_pins"]
        self.assertEqual([one["point"] for one in refused], ["picture"])
        self.assertIn("picture", result.stderr)

    def test_edits_that_lost_their_object_are_warned_of(self):
        _, path = self.edited("lost.dolly", {"op": "exclude", "object": "sofa"},
                              {"op": "exclude", "object": "mug"})
        scene = self.folder / "without_mug.obj"
        scene.write_text(self.room.read_text().replace("o mug", "o cup"))
        project = json.loads(path.read_text())
        project["scene"]["path"] = scene.name
        path.write_text(json.dumps(project))
        info = run("info", path, "--json")
        self.assertEqual(info.returncode, 0, info.stderr)
        self.assertIn("mug", info.stderr)
        roles = {o["name"]: o["role"] for o in json.loads(info.stdout)["objects"]}
        self.assertEqual((roles["sofa"], roles["cup"]), ("excluded", "target"))

    def test_broken_edits_are_bad_input(self):
        _, path = self.edited("broken_edits.dolly", {"op": "exclude", "object": "sofa"})
        project = json.loads(path.read_text())
        project["edits"]["changes"][0]["role"] = "gone"
        path.write_text(json.dumps(project))
        self.assertFails(run("plan", path), 4, "edits.changes[0].role")

    def test_edit_lists_its_operations(self):
        table = json.loads(run("edit", "--list", "--json").stdout)
        self.assertEqual(len({one["op"] for one in table}), len(table))
        text = run("edit", "--list").stdout
        for one in table:
            self.assertIn(one["op"], text)
            self.assertTrue(one["text"].endswith("."))


if __name__ == "__main__":
    unittest.main()
