#!/usr/bin/python3
"""Annotations in a file beside the scene: every command reads them, 'edit' writes them, and the
file matches its schema.

Usage: annotations_test.py PROGRAM SCHEMA [unittest arguments]
"""
import json
import pathlib
import shutil
import sys
import unittest

import jsonschema

SCHEMA = json.loads(pathlib.Path(sys.argv.pop(2)).read_text())

from support import tiny_room
from support.program import FolderCase, run


class Annotations(FolderCase):
    def scene(self, said=None, name="room"):
        path = self.folder / self.id().split(".")[-1] / f"{name}.obj"
        path.parent.mkdir(exist_ok=True)
        tiny_room.write(path)
        if said is not None:
            beside = path.with_name(path.name + ".objects.json")
            beside.write_text(said if isinstance(said, str) else json.dumps(said))
        return path

    def said(self, **more):
        said = {"format": "dollytrack-objects", "version": 1, **more}
        jsonschema.validate(said, SCHEMA)
        return said

    def info(self, path, *arguments):
        result = run("info", path, "--json", *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def objects(self, path, *arguments):
        return {o["name"]: o for o in self.info(path, *arguments)["objects"]}

    def test_objects_are_what_people_say(self):
        path = self.scene(self.said(objects=[
            {"name": "breakfast", "nodes": ["mug", "book"], "class": "box"},
            {"name": "plinth", "meshes": ["sofa"], "structure": True},
        ]))
        objects = self.objects(path)
        self.assertNotIn("mug", objects)
        self.assertNotIn("book", objects)
        self.assertEqual(objects["breakfast"]["triangles"], 24)
        self.assertEqual(objects["breakfast"]["class"], "box")
        self.assertEqual(objects["plinth"]["role"], "structure")
        self.assertEqual(objects["table"]["role"], "target")

    def test_triangles_are_cut_out_of_their_mesh(self):
        path = self.scene(self.said(objects=[
            {"name": "lid", "triangles": [{"mesh": "table", "first": 6, "count": 2}]}]))
        objects = self.objects(path)
        self.assertEqual(objects["lid"]["triangles"], 2)
        self.assertEqual(objects["table"]["triangles"], 10)

    def test_unit_and_up_are_taken_and_the_command_line_comes_first(self):
        path = self.scene(self.said(unit_m=0.5, up_axis="z"))
        self.assertEqual(self.info(path)["unit_m"], 0.5)
        self.assertEqual(self.info(path)["up_axis"], "z")
        self.assertEqual(self.info(path, "--unit", "2")["unit_m"], 2)

    def test_a_new_project_begins_with_the_edits(self):
        path = self.scene(self.said(edits={"version": 1, "changes": [
            {"object": {"name": "sofa"}, "role": "excluded"}], "ignore": ["mug"]}))
        objects = self.objects(path)
        self.assertEqual(objects["sofa"]["role"], "excluded")
        self.assertEqual(objects["mug"]["role"], "excluded")
        project = path.with_suffix(".dolly")
        done = run("edit", path, "--op", '{"op":"exclude","object":"book"}', "-o", project)
        self.assertEqual(done.returncode, 0, done.stderr)
        changes = json.loads(project.read_text())["edits"]["changes"]
        self.assertEqual(sorted(c["object"]["name"] for c in changes), ["book", "sofa"])
        self.assertTrue(all(c["object"]["id"] > 0 for c in changes))

    def test_what_is_written_is_read_again_and_fits_the_schema(self):
        path = self.scene()
        beside = path.with_name(path.name + ".objects.json")
        operations = [{"op": "exclude", "object": "sofa"},
                      {"op": "merge", "objects": ["mug", "book"], "name": "pair"},
                      {"op": "set_class", "object": "picture", "class": "window"},
                      {"op": "add_region", "name": "altar", "center": [2, -1.5, 1],
                       "size": [1, 1, 1], "weight": 5, "must_see": True}]
        arguments = [a for op in operations for a in ("--op", json.dumps(op))]
        done = run("edit", path, *arguments, "--write-annotations", beside, "--unit", "m")
        self.assertEqual(done.returncode, 0, done.stderr)
        written = json.loads(beside.read_text())
        jsonschema.validate(written, SCHEMA)
        self.assertEqual(written["unit_m"], 1)
        objects = self.objects(path)
        self.assertEqual(objects["sofa"]["role"], "excluded")
        self.assertEqual(objects["picture"]["class"], "window")
        self.assertEqual(objects["pair"]["triangles"], 24)
        # Without operations a project's edits are written unchanged.
        project = path.with_suffix(".dolly")
        self.assertEqual(run("edit", path, "--op", '{"op":"exclude","object":"table"}', "-o",
                             project).returncode, 0)
        elsewhere = path.with_name("said.json")
        done = run("edit", project, "--write-annotations", elsewhere)
        self.assertEqual(done.returncode, 0, done.stderr)
        copy = path.with_name("copy.obj")
        shutil.copy(path, copy)
        self.assertEqual(self.objects(copy)["table"]["role"], "target")
        self.assertEqual(self.objects(copy, "--annotations", elsewhere)["table"]["role"],
                         "excluded")

    def test_unknown_keys_stay(self):
        path = self.scene(self.said(author="Ann", objects=[
            {"name": "seat", "nodes": ["sofa"], "bought": 1999}]))
        beside = path.with_name(path.name + ".objects.json")
        done = run("edit", path, "--op", '{"op":"exclude","object":"seat"}',
                   "--write-annotations", beside)
        self.assertEqual(done.returncode, 0, done.stderr)
        written = json.loads(beside.read_text())
        self.assertEqual(written["author"], "Ann")
        self.assertEqual(written["objects"][0]["bought"], 1999)
        self.assertEqual(written["edits"]["changes"][0]["object"]["name"], "seat")

    def test_unknown_keys_of_edits_stay_with_what_they_are_about(self):
        path = self.scene(self.said(edits={
            "version": 1, "why": "survey",
            "changes": [{"object": {"name": "sofa", "tag": "S1"}, "role": "excluded", "by": "Ann"},
                        {"object": {"name": "mug"}, "large": True, "by": "Bob"}],
            "no_go": [{"name": "stove", "center": [1, -1, 1], "half_size_m": [0.1, 0.1, 0.1],
                       "yaw_rad": 0, "hot": True}]}))
        beside = path.with_name(path.name + ".objects.json")
        project = path.with_suffix(".dolly")
        for arguments in (["--write-annotations", beside], ["-o", project]):
            done = run("edit", path, "--op", '{"op":"include","object":"sofa"}',
                       "--op", '{"op":"exclude","object":"book"}', *arguments)
            self.assertEqual(done.returncode, 0, done.stderr)
        for edits in (json.loads(beside.read_text())["edits"],
                      json.loads(project.read_text())["edits"]):
            self.assertEqual(edits["why"], "survey")
            self.assertTrue(edits["no_go"][0]["hot"])
            changes = {c["object"]["name"]: c for c in edits["changes"]}
            self.assertEqual(changes["mug"]["by"], "Bob")
            self.assertNotIn("by", changes["book"])
            # An entry keeps its other keys while it exists; an undone operation does not return.
            self.assertNotEqual(changes.get("sofa", {}).get("role"), "excluded")

    def test_relations_come_before_what_is_found(self):
        path = self.scene(self.said(relations=[
            {"object": "book", "relation": "in", "holder": "sofa"},
            {"object": "ghost", "relation": "on", "holder": "sofa"}]))
        out = path.parent / "dataset"
        done = run("export", path, "--out", out, "--max-frames", "3", "--set", "width_px=64",
                   "--set", "height_px=48", "--modalities", "instance", "--formats", "coco")
        if done.returncode == 5:
            self.skipTest("no OpenGL")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("ghost", done.stderr)
        objects = {o["name"]: o for o in
                   json.loads((out / "dataset.json").read_text())["objects"]}
        self.assertEqual(objects["book"]["relations"],
                         [{"kind": "in", "id": objects["sofa"]["id"]}])
        self.assertEqual(objects["mug"]["relations"],
                         [{"kind": "on", "id": objects["table"]["id"]}])

    def test_what_is_not_understood_is_said(self):
        path = self.scene({"format": "dollytrack-objects", "version": 1, "objects": [
            {"name": "a", "nodes": ["table"], "clas": "desk"},
            {"name": "b", "nodes": ["table"]},
            {"name": "c", "nodes": ["mug"], "class": "flurbl"},
            {"name": "d", "nodes": ["sofa"], "front": [0, 1, 0], "my_note": 3},
        ]})
        said = self.info(path)
        warnings = "\n".join(said["warnings"])
        self.assertIn('unknown key "clas" of "a"; did you mean "class"?', warnings)
        self.assertIn('no triangles are left for "b"', warnings)
        self.assertIn('"flurbl", the class of "c", is unknown', warnings)
        self.assertIn('the front given for "d" points up or down', warnings)
        self.assertNotIn("my_note", warnings)
        # Without a class the names of its parts decide the class, as before.
        self.assertEqual({o["name"]: o["class"] for o in said["objects"]}["a"], "table")
        plain = self.info(self.scene(self.said(objects=[
            {"name": "d", "nodes": ["sofa"], "front": [0, 0, 1], "class": "sofa"}]), "plain"))
        self.assertFalse([line for line in plain["warnings"] if "annotations" in line
                          or "front" in line])

    def test_slips_are_said_with_file_and_place(self):
        name = "room.obj.objects.json"
        for said, words in [
            ("[1, 2", [name, "not valid JSON"]),
            ("[]", [name, "an object"]),
            ({"version": 1}, [name, "format", "dollytrack-objects"]),
            (dict(self.said(), up_axis="up"), [name, "up_axis", "x, y, z, -x, -y or -z"]),
            (dict(self.said(), objects=[{"name": "a"}]), [name, "objects[0]", "parts of the object"]),
            (dict(self.said(), objects=[{"name": "a", "nodes": ["mug"], "front": [0, 0]}]),
             [name, "objects[0].front", "three numbers"]),
            (dict(self.said(), relations=[{"object": "a", "relation": "at", "holder": "b"}]),
             [name, "relations[0].relation"]),
            (dict(self.said(), edits={"version": 1, "changes": [{"object": {}}]}),
             [name, "edits.changes[0].object.name"]),
            ("[" * 100_000, [name, "nested"]),
        ]:
            with self.subTest(said=str(said)[:60]):
                self.assertFails(run("info", self.scene(said)), 4, *words)
        done = run("info", self.scene(self.said(objects=[{"name": "a", "nodes": ["mugg"]}])))
        self.assertEqual(done.returncode, 0)
        self.assertIn("mugg", done.stderr + done.stdout)

    def test_the_schema_refuses_what_the_program_refuses(self):
        for said in [{"version": 1}, dict(self.said(), up_axis="up"),
                     dict(self.said(), objects=[{"name": "a"}]),
                     dict(self.said(), relations=[{"object": "a", "relation": "at",
                                                   "holder": "b"}])]:
            with self.assertRaises(jsonschema.ValidationError):
                jsonschema.validate(said, SCHEMA)


if __name__ == "__main__":
    unittest.main()
