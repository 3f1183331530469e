#!/usr/bin/python3
"""Gathers several datasets into one and reads the result with third-party readers.

Usage: gather_test.py PROGRAM [unittest arguments]
"""
import collections
import hashlib
import json
import pathlib
import shutil
import tarfile
import unittest

import cv2
import numpy as np
import yaml

from gather_case import PARTS, GatherCase, mask_of
from support.program import hashes, run


class Gather(GatherCase):
    # --- layouts

    def test_yolo_as_ultralytics_reads_it(self):
        out = self.gather("--format", "yolo", "--split", "by-room", "60/20/20")
        data = yaml.safe_load((out / "data.yaml").read_text())
        self.assertNotIn("path", data)
        self.assertEqual(data["nc"], 40)
        self.assertEqual(sorted(data["names"]), list(range(40)))
        pictures = {}
        for part in PARTS:
            found = sorted((out / data[part]).iterdir())
            self.assertGreater(len(found), 0)
            pictures.update({path.stem: path for path in found})
        boxes = 0
        for name, folder, index in self.frames():
            picture = pictures.pop(name)
            self.assertEqual(picture.read_bytes(),
                             (folder / "rgb" / f"{index:06}.png").read_bytes())
            label = pathlib.Path(str(picture).replace("/images/", "/labels/")).with_suffix(".txt")
            lines = [line.split() for line in label.read_text().splitlines()]
            expected = self.boxes_of(folder, index)
            self.assertEqual(len(lines), len(expected))
            for (number, *shares), (category, (x, y, w, h), _) in zip(lines, expected):
                self.assertEqual(int(number), category - 1)
                np.testing.assert_allclose(
                    np.array(shares, float),
                    [(x + w / 2) / 160, (y + h / 2) / 120, w / 160, h / 120], atol=1e-6)
                boxes += 1
        self.assertEqual(pictures, {})
        self.assertGreater(boxes, 50)

    def test_yolo_names_a_val_where_there_is_none(self):
        out = self.gather("--format", "yolo", "--split", "none",
                          datasets=[self.datasets / "room_0"])
        data = yaml.safe_load((out / "data.yaml").read_text())
        self.assertEqual((data["train"], data["val"]), ("images/train", "images/train"))
        self.assertIn("# the training images", (out / "data.yaml").read_text())

    def test_coco_boxes_and_masks_are_those_of_the_instance_images(self):
        out = self.gather("--format", "coco", "--split", "by-room", "60/20/20")
        instance = {name: folder / "instance" / f"{index:06}.png"
                    for name, folder, index in self.frames()}
        ids, image_ids, names = set(), set(), set()
        for part in PARTS:
            file = json.loads((out / "annotations" / f"instances_{part}.json").read_text())
            categories = {one["id"]: one["name"] for one in file["categories"]}
            self.assertEqual(len(categories), 40)
            images = {one["id"]: one for one in file["images"]}
            self.assertEqual({one["file_name"] for one in images.values()},
                             {path.name for path in (out / part).iterdir()})
            self.assertFalse(image_ids & set(images))
            image_ids |= set(images)
            names |= {one["file_name"] for one in images.values()}
            for one in file["annotations"]:
                self.assertNotIn(one["id"], ids)
                ids.add(one["id"])
                self.assertIn(one["category_id"], categories)
                stem = pathlib.Path(images[one["image_id"]]["file_name"]).stem
                pixels = cv2.imread(str(instance[stem]), cv2.IMREAD_UNCHANGED)
                shown = (pixels == one["object_id"]).astype(np.uint8)
                np.testing.assert_array_equal(mask_of(one["segmentation"]), shown)
                self.assertEqual(list(cv2.boundingRect(shown)), one["bbox"])
                self.assertEqual(one["area"], int(shown.sum()))
        self.assertEqual(len(names), len(list(self.frames())))
        self.assertGreater(len(ids), 50)
        self.assertFalse((out / "annotations" / ".waiting").exists())

    def test_imagefolder_rows_belong_to_pictures(self):
        out = self.gather("--format", "imagefolder", "--split", "by-room", "80/20")
        seen = 0
        frames = {name: (folder, index) for name, folder, index in self.frames()}
        for part in PARTS[:2]:
            rows = [json.loads(line)
                    for line in (out / part / "metadata.jsonl").read_text().splitlines()]
            self.assertEqual({row["file_name"] for row in rows},
                             {path.name for path in (out / part).glob("*.png")})
            for row in rows:
                picture = cv2.imread(str(out / part / row["file_name"]))
                self.assertEqual(picture.shape[:2], (row["height"], row["width"]))
                expected = self.boxes_of(*frames[pathlib.Path(row["file_name"]).stem])
                self.assertEqual(row["objects"]["bbox"], [box for _, box, _ in expected])
                self.assertEqual(row["objects"]["categories"],
                                 [category - 1 for category, _, _ in expected])
                seen += 1
        self.assertEqual(seen, len(frames))
        self.assertFalse((out / "test").exists())
        header = yaml.safe_load((out / "README.md").read_text().split("---\n")[1])
        self.assertEqual([(one["split"], one["path"]) for one in header["configs"][0]["data_files"]],
                         [("train", "train/**"), ("validation", "val/**")])

    def test_webdataset_has_every_frame_once_in_few_files(self):
        out = self.gather("--format", "webdataset", "--split", "by-room", "60/20/20",
                          "--shard-frames", 4)
        frames = {name: (folder, index) for name, folder, index in self.frames()}
        samples = collections.defaultdict(dict)
        for shard in sorted(out.glob("*.tar")):
            with tarfile.open(shard) as tar:
                members = tar.getmembers()
                self.assertLessEqual(len(members), 4 * 5)
                for member in members:
                    self.assertTrue(member.isreg())
                    key, _, ending = member.name.partition(".")
                    self.assertNotIn(ending, samples[key])
                    samples[key][ending] = tar.extractfile(member).read()
        self.assertEqual(set(samples), set(frames))
        self.assertIn("Pixels of `semantic` images have the *id*", (out / "README.md").read_text())
        for key, sample in samples.items():
            folder, index = frames[key]
            self.assertEqual(set(sample), {"png", "depth.png", "instance.png", "semantic.png", "json"})
            for ending, kind in [("png", "rgb"), ("depth.png", "depth"),
                                 ("semantic.png", "semantic")]:
                self.assertEqual(sample[ending], (folder / kind / f"{index:06}.png").read_bytes())
            about = json.loads(sample["json"])
            self.assertEqual((about["width"], about["height"]), (160, 120))
            ids = cv2.imdecode(np.frombuffer(sample["instance.png"], np.uint8), cv2.IMREAD_UNCHANGED)
            self.assertEqual([(one["category_id"], one["bbox"], one["object_id"])
                              for one in about["objects"]], self.boxes_of(folder, index))
            for one in about["objects"]:
                np.testing.assert_array_equal(mask_of(one["segmentation"]),
                                              ids == one["object_id"])
            stored = json.loads((folder / "dataset.json").read_text())["frames"][index]
            np.testing.assert_allclose(about["position"], stored["position"], atol=1e-12)

    def test_tar_files_stay_below_their_size(self):
        out = self.gather("--format", "webdataset", "--shard-size", "0.1MB")
        sizes = [path.stat().st_size for path in sorted(out.glob("train-*.tar"))]
        self.assertGreater(len(sizes), 3)
        self.assertLessEqual(max(sizes), 100_000)
        self.assertGreater(min(sizes[:-1]), 50_000)

    def test_each_dataset_has_a_recording_in_its_part(self):
        """tests/readers/mcap_reader.py and rosbag_reader.py decode what is in them."""
        magic = b"\x89MCAP0\r\n"
        for layout, ending, start, end in [("mcap", ".mcap", magic, magic),
                                           ("rosbag", ".bag", b"#ROSBAG V2.0\n", b"")]:
            with self.subTest(layout):
                arguments = ["--format", layout, "--split", "by-room", "60/20/20"]
                out = self.gather(*arguments)
                part_of = {one["name"]: one["part"] for one in self.card(out)["sources"]}
                self.assertEqual({path.relative_to(out) for path in out.rglob("*" + ending)},
                                 {pathlib.Path(part, name + ending)
                                  for name, part in part_of.items()})
                for name, folder, index in self.frames():
                    source = name.rpartition("_")[0]
                    data = (out / part_of[source] / (source + ending)).read_bytes()
                    self.assertTrue(data.startswith(start) and data.endswith(end))
                    for kind in ["rgb", "depth", "instance", "semantic"]:
                        self.assertIn((folder / kind / f"{index:06}.png").read_bytes(), data)
                    self.assertNotIn(str(self.folder).encode(), data)
                header = yaml.safe_load((out / "README.md").read_text().split("---\n")[1])
                self.assertNotIn("configs", header)
                again = self.new_folder()
                done = run("-q", "--threads", 1, "gather", self.datasets, "--out", again, *arguments)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(hashes(again), hashes(out))

    def test_a_jpeg_file_does_not_replace_a_colour_image(self):
        for layout in ["imagefolder", "mcap"]:
            dataset = self.folder / layout
            shutil.copytree(self.datasets / "room_0", dataset)
            self.replace_listed(dataset, "rgb/000002.jpg", b"another file")
            out = self.gather("--format", layout, datasets=[dataset])
            png = (dataset / "rgb" / "000002.png").read_bytes()
            written = [path.read_bytes() for path in out.rglob("*") if path.is_file()]
            self.assertTrue(any(png in data for data in written))
            self.assertFalse(any(b"another file" in data for data in written))

    # --- the card

    def test_the_card_names_only_images_that_the_dataset_has(self):
        colour = self.folder / "colour"
        self.export(self.folder / "0.dolly", colour, "--modalities", "rgb")
        for layout, ending in [("webdataset", ".png"), ("parquet", "")]:
            for datasets, is_named in [([colour], self.assertNotIn),
                                       ([self.datasets / "room_0"], self.assertIn)]:
                with self.subTest(layout, datasets=datasets):
                    out = self.gather("--format", layout, "--split", "none", datasets=datasets)
                    text = (out / "README.md").read_text()
                    reading = text.split("## Reading")[1].split("## Parts")[0]
                    for modality in ["depth", "instance", "semantic"]:
                        is_named(f"`{modality}{ending}`", reading)

    def test_the_card_says_what_it_is(self):
        out = self.gather("--format", "coco", "--split", "by-room", "60/20/20", "--license",
                          "cc-by-4.0", "--title", "Rooms: a test", "--seed", 3)
        text = (out / "README.md").read_text()
        header = yaml.safe_load(text.split("---\n")[1])
        self.assertEqual(header["license"], "cc-by-4.0")
        self.assertEqual(header["pretty_name"], "Rooms: a test")
        self.assertEqual(header["size_categories"], ["n<1K"])
        self.assertEqual(header["task_categories"], ["object-detection", "image-segmentation"])
        for word in ["camera_axes", "## Parts", "gather --format coco"]:
            self.assertIn(word, text)
        card = self.card(out)
        written = [json.loads((out / "annotations" / f"instances_{part}.json").read_text())["annotations"]
                   for part in ("train", "val", "test")]
        expected = []
        for one in card["classes"]:
            boxes = [sum(box["category_id"] == one["id"] for box in part) for part in written]
            if any(boxes):
                expected.append([str(one["number"]), str(one["id"]), one["name"], *map(str, boxes)])
        rows = [row.strip("| ").split(" | ") for row in text.split("## Classes")[1].split("\n\n")[1].splitlines()]
        self.assertEqual(rows[2:], expected)
        self.assertGreater(len(expected), 1)
        self.assertIn(f"{len(card['classes']) - len(expected)} classes without boxes", text)
        self.assertEqual(card["format"], "dollytrack gather")
        self.assertEqual(card["split"]["seed"], 3)
        self.assertEqual(sum(one["frames"] for one in card["parts"]), len(list(self.frames())))
        by_name = {one["name"]: one for one in card["sources"]}
        self.assertEqual(by_name["room_3"]["dataset_json_sha256"], hashlib.sha256(
            (self.datasets / "room_3" / "dataset.json").read_bytes()).hexdigest())
        self.assertEqual(card["files"]["sha256"], hashlib.sha256(
            (out / "SHA256SUMS").read_bytes()).hexdigest())
        named = self.gather("--format", "coco", "--license", "Our own licence")
        header = yaml.safe_load((named / "README.md").read_text().split("---\n")[1])
        self.assertEqual((header["license"], header["license_name"]), ("other", "Our own licence"))

    def test_boxes_of_one_class_and_an_unknown_licence_are_warned_of(self):
        boxes = collections.Counter()
        for path in self.datasets.glob("room_*/annotations.json"):
            boxes.update(one["category_id"] for one in json.loads(path.read_text())["annotations"])
        self.assertLess(max(boxes.values()), 0.9 * sum(boxes.values()))
        done = run("gather", self.datasets, "--out", self.new_folder(), "--format", "yolo",
                   "--license", "cc-by-4.0")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("boxes have the class", done.stderr)
        self.assertNotIn("license", done.stderr)
        table = json.loads((self.datasets / "room_0" / "annotations.json").read_text())["categories"]
        one_class = self.new_folder()
        (self.folder / "all.csv").write_text("".join(
            f"{name},thing\n" for name in {one["name"] for one in table} - {"wall"}))
        done = run("gather", self.datasets / "room_0", "--out", one_class, "--format", "YOLO",
                   "--class-map", self.folder / "all.csv")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("boxes have the class 'thing'", done.stderr)
        self.assertIn("license: unknown", done.stderr)

    def test_a_title_that_is_no_utf_8_is_cleaned(self):
        out = self.gather("--format", "coco", "--title", "Rooms \udcff\nof mine",
                          datasets=[self.datasets / "room_0"])
        header = yaml.safe_load((out / "README.md").read_text().split("---\n")[1])
        self.assertEqual(header["pretty_name"], "Rooms \ufffdof mine")
        self.assertEqual(self.card(out)["title"], "Rooms \ufffdof mine")


if __name__ == "__main__":
    unittest.main()
