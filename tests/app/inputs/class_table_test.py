#!/usr/bin/python3
"""Datasets with user-defined classes, read by the rules of each format.

Usage: class_table_test.py PROGRAM SCHEMA [unittest arguments]
"""
import csv
import json
import pathlib
import sys
import unittest

import cv2
import h5py
import jsonschema
import numpy as np
import yaml

from support import tiny_room
from support.program import FolderCase, hashes, run

SCHEMA = json.loads(pathlib.Path(sys.argv.pop(1)).read_text())
SIZE = ["--set", "width_px=64", "--set", "height_px=48", "--max-frames", 4]
FORMATS = "coco,coco_polygons,yolo,kitti_objects,instances,hdf5,tartanair,gltf"
# The classes of the tiny room's objects by this table; void for objects not in it.
TABLE = {
    "$schema": "labels.schema.json",
    "classes": [
        {"id": 40, "name": "no", "color": "#ff0000", "matches": ["sofa", "chair"]},
        {"id": 0, "name": "crockery: cups", "supercategory": "small", "matches": ["m?g"]},
        {"id": 9, "name": "Table"},
        {"id": 200, "name": "shell", "color": [1, 2, 3], "matches": ["wall", "floor", "ceiling"]},
        {"id": 12, "name": "never seen", "matches": []},
    ],
}
CLASSES = {"mug": 0, "table": 9, "sofa": 40, "wall_1": 200, "wall_2": 200, "wall_3": 200,
           "wall_4": 200, "floor": 200, "ceiling": 200}


class ClassTable(FolderCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        tiny_room.write(cls.folder / "room.obj")
        cls.labels = cls.folder / "classes.json"
        cls.labels.write_text(json.dumps(TABLE))
        cls.project = cls.folder / "room.dolly"
        plan = run("plan", cls.folder / "room.obj", "-o", cls.project, "--labels", cls.labels, *SIZE)
        assert plan.returncode == 0, plan.stderr
        cls.out = cls.export("dataset", cls.project)
        cls.card = json.loads((cls.out / "dataset.json").read_text())
        cls.by_id = {one["id"]: one for one in cls.card["objects"]}

    @classmethod
    def export(cls, name, scene, *arguments):
        out = cls.folder / name
        done = run("export", scene, "--out", out, "--formats", FORMATS, "--modalities",
                   "rgb,depth,instance,semantic", "--camera",
                   "wide:lens=fisheye,width_px=32,height_px=32", *arguments)
        assert done.returncode == 0, done.stderr
        return out

    def frames(self, folder):
        """Pairs of the instance image and the class image of each frame."""
        for path in sorted((folder / "instance").iterdir()):
            yield (cv2.imread(str(path), cv2.IMREAD_UNCHANGED),
                   cv2.imread(str(folder / "semantic" / path.name), cv2.IMREAD_UNCHANGED))

    def class_of(self, object_id):
        return 255 if object_id == 0 else CLASSES.get(self.by_id[object_id]["name"], 255)

    def seen_targets(self, instance):
        """Ids of the targets in the image that have a class, in ascending order."""
        return [i for i in np.unique(instance).tolist()
                if i and self.by_id[i]["role"] == "target" and self.class_of(i) != 255]

    # --- the table

    def test_the_card_has_the_table(self):
        self.assertEqual([(one["id"], one["name"]) for one in self.card["classes"]],
                         [(255, "void")] + [(one["id"], one["name"]) for one in TABLE["classes"]])
        colors = [tuple(one["color"]) for one in self.card["classes"]]
        self.assertEqual((colors[1], colors[4]), ((255, 0, 0), (1, 2, 3)))
        self.assertEqual(len(set(colors)), len(colors))
        for one in self.card["objects"]:
            self.assertEqual(one["class_id"], self.class_of(one["id"]), one["name"])
        jsonschema.validate(TABLE, SCHEMA)
        jsonschema.validate(self.card["labels"], SCHEMA)

    def test_the_card_alone_makes_the_same_dataset(self):
        labels = self.folder / "from_card.json"
        labels.write_text(json.dumps(self.card["labels"]))
        other = self.export("from_card", self.project, "--labels", labels)
        before, after = hashes(self.out), hashes(other)
        for changed in ("dataset.json",):  # has the label file's path among its parameters
            before.pop(changed), after.pop(changed)
        self.assertEqual(before, after)

    def test_the_project_keeps_the_table(self):
        opened = json.loads(run("info", self.project, "--json").stdout)
        named = {one["name"]: one["dataset_class"] for one in opened["objects"]}
        self.assertEqual(named["sofa"], {"id": 40, "name": "no"})
        self.assertEqual(named["book"]["name"], "void")
        self.assertEqual({one["name"]: one["objects"] for one in opened["dataset_classes"]},
                         {"void": 2, "no": 1, "crockery: cups": 1, "Table": 1, "shell": 6,
                          "never seen": 0})
        self.assertIn("crockery: cups", run("info", self.project).stdout)

    # --- the formats

    def test_masks_hold_the_ids_of_the_table(self):
        ids = {one["id"] for one in self.card["classes"]}
        for folder in (self.out, self.out / "cameras" / "wide"):
            found = set()
            for instance, semantic in self.frames(folder):
                self.assertEqual(semantic.dtype, np.uint8)
                expected = np.vectorize(self.class_of)(instance)
                np.testing.assert_array_equal(semantic, expected)
                found |= set(np.unique(semantic).tolist())
            self.assertLessEqual(found, ids)
            self.assertGreater(len(found & {0, 9, 40, 200}), 2, "not void alone")

    def test_coco_has_the_categories_and_no_boxes_of_void(self):
        for file in ("annotations.json", "annotations_polygons.json"):
            coco = json.loads((self.out / file).read_text())
            self.assertEqual(
                [(one["id"], one["name"], one["supercategory"]) for one in coco["categories"]],
                [(one["id"], one["name"], one.get("supercategory", one["name"]))
                 for one in TABLE["classes"]])
            found = sorted((one["image_id"] - 1, one["object_id"], one["category_id"])
                           for one in coco["annotations"])
            expected = [(frame, i, self.class_of(i))
                        for frame, (instance, _) in enumerate(self.frames(self.out))
                        for i in self.seen_targets(instance)]
            self.assertEqual(found, expected)
            self.assertGreater(len(found), 2)

    def test_yolo_numbers_the_classes_from_zero(self):
        data = yaml.safe_load((self.out / "data.yaml").read_text())
        names = [one["name"] for one in TABLE["classes"]]
        self.assertEqual(data["names"], dict(enumerate(names)))
        self.assertEqual((self.out / "classes.txt").read_text().splitlines(), names)
        number = {one["id"]: i for i, one in enumerate(TABLE["classes"])}
        for frame, (instance, _) in enumerate(self.frames(self.out)):
            for folder in ("labels", "labels_seg"):
                lines = (self.out / folder / f"{frame:06}.txt").read_text().splitlines()
                self.assertEqual([int(line.split()[0]) for line in lines],
                                 [number[self.class_of(i)] for i in self.seen_targets(instance)])

    def test_other_formats_name_the_same_classes(self):
        name = {one["id"]: one["name"] for one in self.card["classes"]}
        for frame, (instance, semantic) in enumerate(self.frames(self.out)):
            kitti = (self.out / "label_2" / f"{frame:06}.txt").read_text().splitlines()
            types = [line.split()[:-14] for line in kitti]
            self.assertEqual(types, [[name[self.class_of(i)].replace(" ", "_")]
                                     for i in self.seen_targets(instance)])
            np.testing.assert_array_equal(
                np.load(self.out / "seg_left" / f"{frame:06}_left_seg.npy"), semantic)
            with h5py.File(self.out / "hdf5" / f"{frame:06}.hdf5") as file:
                np.testing.assert_array_equal(file["category_id_segmaps"][()], semantic)
                listed = json.loads(file["instance_attribute_maps"][()])
                self.assertTrue(all(one["category_id"] == self.class_of(one["idx"])
                                    for one in listed))
        with open(self.out / "instances.csv", newline="") as table:
            for row in csv.DictReader(table):
                self.assertEqual(int(row["class_id"]), self.class_of(int(row["object_id"])))

    def test_masks_of_large_ids_have_16_bits(self):
        labels = self.folder / "wide.json"
        labels.write_text(json.dumps({"classes": [{"id": 60000, "name": "sofa"},
                                                  {"id": 1, "name": "rest", "matches": []}],
                                      "other": "rest"}))
        out = self.export("wide", self.project, "--labels", labels)
        found = set()
        for frame, (_, semantic) in enumerate(self.frames(out)):
            self.assertEqual(semantic.dtype, np.uint16)
            seg = np.load(out / "seg_left" / f"{frame:06}_left_seg.npy")
            self.assertEqual(seg.dtype, np.uint16)
            np.testing.assert_array_equal(seg, semantic)
            found |= set(np.unique(semantic).tolist())
        self.assertLessEqual({1, 60000}, found)
        self.assertLessEqual(found, {0, 1, 60000})
        self.assertEqual(run("-q", "verify", out).returncode, 0)

    # --- verify

    def checks(self, *arguments):
        done = run("-q", "verify", self.out, "--json", *arguments)
        return done, {one["check"]: one["status"] for one in json.loads(done.stdout)["checks"]}

    def test_verify_finds_it_sound(self):
        done, checks = self.checks()
        self.assertEqual(done.returncode, 0, done.stdout)
        for one in ("card", "classes", "coco", "yolo", "kitti_objects", "hdf5", "tartanair",
                    "instances", "scene"):
            self.assertEqual(checks[one], "passed", one)

    def test_verify_finds_another_class(self):
        for file, change, check in (
                ("annotations.json", lambda c: c["annotations"][0].update(category_id=12), "coco"),
                ("annotations.json", lambda c: c["categories"][1].update(name="cups"), "coco"),
                ("dataset.json", lambda c: c["classes"][1].update(id=41), "card"),
                ("dataset.json", lambda c: c["objects"][0].update(class_id=12), "card"),
                ("dataset.json", lambda c: c["objects"][0].update(class_id=12), "classes")):
            path = self.out / file
            before = path.read_bytes()
            content = json.loads(before)
            change(content)
            path.write_text(json.dumps(content))
            try:
                done, checks = self.checks()
            finally:
                path.write_bytes(before)
            self.assertEqual((done.returncode, checks[check]), (4, "failed"), (file, check))

    # --- on the command line

    def test_another_table_is_another_dataset(self):
        labels = self.folder / "renamed.json"
        labels.write_text(json.dumps({**TABLE, "other": "shell"}))
        self.assertFails(run("-q", "export", self.project, "--out", self.out, "--formats", FORMATS,
                             "--modalities", "rgb,depth,instance,semantic", "--camera",
                             "wide:lens=fisheye,width_px=32,height_px=32", "--labels", labels,
                             "--resume"), 2)

    def test_classes_are_patterns_of_targets(self):
        project = self.folder / "only.dolly"
        done = run("plan", self.folder / "room.obj", "-o", project, "--labels", self.labels, "--only",
                   "no", *SIZE)
        self.assertEqual(done.returncode, 0, done.stderr)
        done = run("info", project, "--json")
        self.assertEqual([one["name"] for one in json.loads(done.stdout)["objects"]
                          if one["role"] == "target"], ["sofa"])

    def test_words_beside_classes_change_what_planning_knows(self):
        labels = self.folder / "words.json"
        labels.write_text(json.dumps({"words": ["mug,box"]}))
        done = json.loads(run("info", self.folder / "room.obj", "--labels", labels, "--json").stdout)
        self.assertEqual([one["class"] for one in done["objects"] if one["name"] == "mug"], ["box"])
        self.assertNotIn("dataset_classes", done)
        labels.write_text(json.dumps({"words": ["mug,box", "zork,zork"]}))
        self.assertFails(run("-q", "info", self.folder / "room.obj", "--labels", labels), 4,
                         "words.json", "words:2", "zork")

    def test_a_bad_table_is_one_sentence_with_file_and_field(self):
        labels = self.folder / "bad.json"
        for table, words in (({"classes": [{"id": 70000, "name": "a"}]}, ["classes[0].id", "65535"]),
                             ({"classes": []}, ["classes"]),
                             ({"classes": [{"id": 1, "name": "a", "color": "blue"}]},
                              ["classes[0].color"]),
                             ("{", ["bad.json"])):
            labels.write_text(table if isinstance(table, str) else json.dumps(table))
            self.assertFails(run("-q", "info", self.folder / "room.obj", "--labels", labels), 4,
                             "bad.json", *words)


if __name__ == "__main__":
    unittest.main()
