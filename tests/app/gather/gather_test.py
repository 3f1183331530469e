#!/usr/bin/python3
"""Gathers several datasets into one and reads the result with third-party readers: gather_test.py
PROGRAM."""
import collections
import hashlib
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tarfile
import tempfile
import unittest

import cv2
import numpy as np
import yaml

from support import tiny_room
from support.program import PROGRAM, FolderCase, hashes, run, start, wait_for

SIZE = ["--set", "width_px=160", "--set", "height_px=120"]
LABELS = {"classes": [{"id": 1, "name": "seat", "matches": ["chair", "*sofa*"]},
                      {"id": 2, "name": "cup", "matches": ["*mug*"]}], "other": "ignore"}
PARTS = ["train", "val", "test"]


def sums_of(folder):
    """SHA256SUMS as a dict of hashes by name."""
    return {line[66:]: line[:64] for line in (folder / "SHA256SUMS").read_text().splitlines()}


def mask_of(segmentation):
    """The pixels of COCO's compressed run lengths, decoded by their specification."""
    counts, value, shift = [], 0, 0
    for char in segmentation["counts"].encode():
        bits = char - 48
        value |= (bits & 31) << shift
        shift += 5
        if bits & 32:
            continue
        if bits & 16:
            value -= 1 << shift
        counts.append(value + counts[-2] if len(counts) > 2 else value)
        value, shift = 0, 0
    height, width = segmentation["size"]
    pixels = np.repeat(np.arange(len(counts)) % 2, counts)
    return pixels.reshape(width, height).T


class Gather(FolderCase):
    """Datasets of six scenes; a seventh dataset is of the first scene, too."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.datasets = cls.folder / "datasets"
        for number in range(2):
            scene = cls.folder / f"room_{number}.obj"
            tiny_room.write(scene)
            if number:
                tiny_room.move_corners(scene, lambda x, y, z: (1.1 * x, y, z))
            made = run("-q", "plan", scene, "-o", cls.folder / f"{number}.dolly", "--max-frames", 6,
                       *SIZE)
            assert made.returncode == 0, made.stderr
            cls.export(cls.folder / f"{number}.dolly", cls.datasets / f"room_{number}")
        cls.export(cls.folder / "0.dolly", cls.datasets / "again" / "dataset", "--range", "0:3")
        # Other hashes make them datasets of other scenes.
        for number in range(2, 6):
            cls.copy_as(cls.datasets / "room_1", cls.datasets / f"room_{number}", number)

    @classmethod
    def export(cls, project, out, *arguments):
        made = run("-q", "export", project, "--out", out, *arguments)
        assert made.returncode == 0, made.stderr

    @staticmethod
    def copy_as(dataset, copy, number, copy_file=shutil.copy2):
        """A copy of the dataset with the hashes of another scene."""
        shutil.copytree(dataset, copy, copy_function=copy_file)
        card = json.loads((copy / "dataset.json").read_text())
        (copy / "dataset.json").unlink()
        for name in ("sha256", "geometry_sha256"):
            card["scene"][name] = hashlib.sha256(b"%d" % number).hexdigest()
        (copy / "dataset.json").write_text(json.dumps(card))

    def new_folder(self):
        return pathlib.Path(tempfile.mkdtemp(dir=self.folder)) / "published"

    def gather(self, *arguments, out=None, datasets=None):
        """Runs gather; returns the output folder."""
        out = out or self.new_folder()
        done = run("-q", "gather", *(datasets or [self.datasets]), "--out", out, *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([path for path in out.rglob("*") if path.is_symlink()], [])
        self.assertEqual(list(out.glob(".*")), [])
        checked = subprocess.run(["sha256sum", "-c", "--quiet", "SHA256SUMS"], cwd=out)
        self.assertEqual(checked.returncode, 0)
        listed = set(sums_of(out)) | {"SHA256SUMS", "gather.json"}
        self.assertEqual(set(hashes(out)), listed)
        return out

    def card(self, out):
        return json.loads((out / "gather.json").read_text())

    def frames(self):
        """(name, dataset, index) of each frame; the name is the one in the gathered dataset."""
        for name in ["again", *(f"room_{i}" for i in range(6))]:
            folder = self.datasets / name
            folder = folder / "dataset" if name == "again" else folder
            for picture in sorted((folder / "rgb").iterdir()):
                yield f"{name}_{picture.stem}", folder, int(picture.stem)

    @staticmethod
    def boxes_of(folder, index):
        """Category, box and object of annotations.json."""
        rows = json.loads((folder / "annotations.json").read_text())["annotations"]
        return [(row["category_id"], row["bbox"], row["object_id"]) for row in rows
                if row["image_id"] == index + 1]

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

    # --- the card

    def test_the_card_says_what_it_is(self):
        out = self.gather("--format", "coco", "--split", "by-room", "60/20/20", "--license",
                          "cc-by-4.0", "--title", "Rooms: a test", "--seed", 3)
        text = (out / "README.md").read_text()
        header = yaml.safe_load(text.split("---\n")[1])
        self.assertEqual(header["license"], "cc-by-4.0")
        self.assertEqual(header["pretty_name"], "Rooms: a test")
        self.assertEqual(header["size_categories"], ["n<1K"])
        self.assertEqual(header["task_categories"], ["object-detection", "image-segmentation"])
        for word in ["| 4 | 5 | chair |", "camera_axes", "## Parts", "gather --format coco"]:
            self.assertIn(word, text)
        rows = [row.strip("| ").split(" | ") for row in text.splitlines() if row.startswith("| 4 | 5 | chair")]
        written = [json.loads((out / "annotations" / f"instances_{part}.json").read_text())["annotations"]
                   for part in ("train", "val", "test")]
        self.assertEqual(rows[0][3:], [str(sum(one["category_id"] == 5 for one in part)) for part in written])
        card = self.card(out)
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

    # --- splits

    def test_no_room_is_on_both_sides_whatever_the_seed(self):
        splits = set()
        for seed in range(12):
            out = self.gather("--format", "webdataset", "--split", "by-room", "60/20/20",
                              "--seed", seed)
            card = self.card(out)
            part_of = collections.defaultdict(set)
            for one in card["sources"]:
                part_of[one["scene_sha256"]].add(one["part"])
            self.assertTrue(all(len(parts) == 1 for parts in part_of.values()))
            self.assertEqual(len(part_of), 6)
            frames = {one["name"]: one["frames"] for one in card["parts"]}
            self.assertEqual(set(frames), set(PARTS))
            # A scene has 6 or 9 of 39 frames: the sizes of the splits are as close as whole scenes
            # allow.
            self.assertLessEqual(abs(frames["train"] - 0.6 * sum(frames.values())), 5)
            splits.add(tuple(one["part"] for one in card["sources"]))
            if seed == 0:
                again = self.gather("--format", "webdataset", "--split", "by-room", "60/20/20",
                                    "--seed", 0)
                self.assertEqual(hashes(again), hashes(out))
        self.assertGreater(len(splits), 3)

    def test_fewer_scenes_than_parts_are_refused(self):
        result = run("-q", "gather", self.datasets / "room_0", self.datasets / "again", "--out",
                     self.new_folder(), "--format", "yolo", "--split", "by-room", "80/20")
        self.assertFails(result, 2, "1 scene cannot be split into 2 parts")

    def test_a_dataset_behind_split_none_is_one(self):
        out = self.new_folder()
        done = run("-q", "gather", "--out", out, "--format", "yolo", "--split", "none",
                   self.datasets / "room_0", self.datasets / "room_1")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(self.card(out)["sources"]), 2)

    # --- names

    def test_equal_names_are_told_apart(self):
        around = self.folder / "alike"
        for part in ["a/kitchen", "b/kitchen", "b/Kitchen"]:
            shutil.copytree(self.datasets / "room_0", around / part)
        out = self.gather("--format", "coco", datasets=[f"{around}/*"])
        names = [one["name"] for one in self.card(out)["sources"]]
        self.assertEqual(len({name.lower() for name in names}), 3, names)
        self.assertEqual(len(list((out / "train").iterdir())), 18)

    # --- datasets that do not match

    def test_contradicting_class_tables_are_refused_or_mapped(self):
        (self.folder / "labels.json").write_text(json.dumps(LABELS))
        other = json.loads(json.dumps(LABELS))
        other["classes"][1]["name"] = "mug"
        (self.folder / "other.json").write_text(json.dumps(other))
        own, own_2 = self.folder / "own", self.folder / "own_2"
        self.export(self.folder / "0.dolly", own, "--labels", self.folder / "labels.json")
        self.export(self.folder / "1.dolly", own_2, "--labels", self.folder / "other.json")
        nyu40 = self.datasets / "room_0"
        for pair, words in [((own, nyu40), ["NYU40"]), ((own, own_2), ["'cup'", "'mug'", "class 2"])]:
            out = self.new_folder()
            refused = run("-q", "gather", *pair, "--out", out, "--format", "coco")
            self.assertFails(refused, 4, str(pair[0]), str(pair[1]), "--class-map", *words)
            self.assertFalse(out.exists())
        for name, text in [("map.json", '{"cup": "mug"}'), ("map.csv", "# names\ncup, mug\n")]:
            (self.folder / name).write_text(text)
            out = self.gather("--format", "webdataset", "--class-map", self.folder / name,
                              datasets=[own, own_2])
            card = self.card(out)
            self.assertEqual([one["name"] for one in card["classes"]], ["seat", "mug"])
            self.assertNotIn("semantic", card["modalities"])
            self.assertEqual(card["class_map"], {"cup": "mug"})
        (self.folder / "map.json").write_text('{"cups": "mug"}')
        refused = run("-q", "gather", own, own_2, "--out", self.new_folder(), "--format", "coco",
                      "--class-map", self.folder / "map.json")
        self.assertFails(refused, 4, "'cups'", "did you mean 'cup'?")

    def test_other_sizes_and_lenses_are_refused_naming_both(self):
        small, wide = self.folder / "small", self.folder / "wide"
        self.export(self.folder / "0.dolly", small, "--range", "0:2", "--set", "width_px=80", "--set",
                    "height_px=60")
        self.export(self.folder / "0.dolly", wide, "--range", "0:2", "--set", "hfov_deg=100")
        first = self.datasets / "room_0"
        for second, word in [(small, "80 x 60"), (wide, "--mixed-lenses")]:
            refused = run("-q", "gather", first, second, "--out", self.new_folder(), "--format",
                          "yolo")
            self.assertFails(refused, 4, str(first), str(second), word)
        self.gather("--format", "yolo", "--mixed-lenses", datasets=[first, wide])

    # --- damage

    def damaged(self, damage):
        """Two datasets, the second of them damaged."""
        around = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
        for name in ["good", "bad"]:
            shutil.copytree(self.datasets / ("room_0" if name == "good" else "room_1"),
                            around / name)
        damage(around / "bad")
        return around

    def test_unfinished_and_damaged_datasets_are_named_or_left_out(self):
        def flip(folder):
            picture = folder / "rgb" / "000002.png"
            data = bytearray(picture.read_bytes())
            data[-20] ^= 1
            picture.write_bytes(data)

        def cut_annotations(folder):
            text = (folder / "annotations.json").read_text()
            (folder / "annotations.json").write_text(text[:-10])

        def unfinish(folder):
            (folder / "dataset.json").unlink()
            (folder / ".dollytrack-export").write_text("{}\n")

        def copy_without_card(folder):
            (folder / "dataset.json").unlink()

        for damage, word in [(flip, "000002.png"), (cut_annotations, "annotations.json"),
                             (lambda folder: (folder / "rgb" / "000001.png").unlink(), "000001.png"),
                             (unfinish, "dataset.json"), (copy_without_card, "dataset.json"),
                             (lambda folder: (folder / "dataset.json").write_text("{"), "dataset.json")]:
            with self.subTest(word):
                around = self.damaged(damage)
                out = self.new_folder()
                self.assertFails(run("-q", "gather", around, "--out", out, "--format", "imagefolder"),
                                 4, str(around / "bad"), word)
                self.assertFalse((out / "gather.json").exists())
                done = run("-q", "gather", around, "--out", out, "--format", "imagefolder",
                           "--skip-damaged")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn("left out", done.stderr)
                card = self.card(out)
                self.assertEqual([one["name"] for one in card["sources"]], ["good"])
                self.assertEqual(card["skipped"], ["bad"])
        self.assertFails(run("-q", "gather", around / "bad", "--out", self.new_folder(), "--format",
                             "yolo", "--skip-damaged"), 4, "All datasets")

    def test_what_is_no_dataset_is_said(self):
        nothing = self.folder / "nothing"
        nothing.mkdir()
        for argument, word in [(nothing, "no dataset"), (nothing / "none", "does not exist"),
                               (self.folder / "0.dolly", "file"),
                               (f"{nothing}/*", "does not exist")]:
            self.assertFails(run("-q", "gather", argument, "--out", self.new_folder(), "--format",
                                 "yolo"), 4, str(argument), word)
        for arguments, word in [(["--format", "yolo", "--split", "by-room", "0/1"], "80/10/10"),
                                (["--format", "yolo", "--split", "by-room", "50/50/50"], "add up to 150"),
                                (["--format", "yolo", "--split", "by-scene"], "by-room"),
                                (["--format", "webdataset", "--shard-size", "1"], "1GB")]:
            self.assertFails(run("-q", "gather", self.datasets, "--out", self.new_folder(),
                                 *arguments), 2, word)

    def test_a_batch_and_rooms_are_found(self):
        jobs = self.folder / "jobs.toml"
        jobs.write_text('out = "batch_out"\nscenes = ["room_0.obj", "room_1.obj"]\n'
                        "[[set]]\nname = \"s\"\nset = { width_px = 160, height_px = 120 }\n"
                        "[export]\nmax_frames = 2\n")
        done = run("-q", "batch", jobs, "-j", 2)
        self.assertEqual(done.returncode, 0, done.stderr)
        out = self.gather("--format", "coco", datasets=[self.folder / "batch_out"])
        self.assertEqual([one["name"] for one in self.card(out)["sources"]],
                         ["room_0_s", "room_1_s"])
        job = next((self.folder / "batch_out").glob("room_1*")) / "dataset"
        shutil.rmtree(job)
        self.assertFails(run("-q", "gather", self.folder / "batch_out", "--out", self.new_folder(),
                             "--format", "coco"), 4, str(job))

    # --- the folder

    def test_complete_results_are_replaced_only_when_asked_and_other_files_stay(self):
        out = self.gather("--format", "yolo", datasets=[self.datasets / "room_0"])
        before = hashes(out)
        again = ["-q", "gather", self.datasets / "room_1", "--out", out, "--format", "coco"]
        self.assertFails(run(*again), 2, "complete", "--overwrite", "--resume")
        self.assertFails(run(*again, "--resume"), 2, "other contents")
        self.assertEqual(hashes(out), before)
        (out / "images" / "train" / "mine.png").write_bytes(b"mine")
        done = run(*again, "--overwrite")
        self.assertEqual(done.returncode, 0, done.stderr)
        left = set(hashes(out))
        self.assertEqual(left - set(sums_of(out)) - {"SHA256SUMS", "gather.json"},
                         {"images/train/mine.png"})
        done = run(*again, "--resume")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("complete", done.stdout)
        (out / "README.md").write_text("damaged")
        self.assertFails(run(*again, "--resume"), 4, "README.md", "--overwrite")

    def test_folders_of_other_files_are_refused(self):
        out = self.new_folder()
        out.mkdir()
        (out / "notes.txt").write_text("mine")
        command = ["-q", "gather", self.datasets / "room_0", "--out"]
        self.assertFails(run(*command, out, "--format", "yolo"), 6, "--overwrite")
        dataset = self.folder / "a_dataset"
        shutil.copytree(self.datasets / "room_1", dataset)
        before = hashes(dataset)
        self.assertFails(run(*command, dataset, "--format", "yolo", "--overwrite"), 6,
                         "exported dataset")
        self.assertFails(run(*command, self.datasets / "room_0" / "out", "--format", "yolo"), 2,
                         "inside the source dataset")
        self.assertEqual(hashes(dataset), before)
        done = run(*command, out, "--format", "yolo", "--overwrite")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((out / "notes.txt").read_text(), "mine")

    def test_no_link_in_the_folder_is_followed(self):
        elsewhere = self.folder / "elsewhere"
        (elsewhere / "train").mkdir(parents=True)
        (elsewhere / "file").write_text("mine")
        before = hashes(elsewhere)
        for place, target in [("images", elsewhere), ("images/train", elsewhere / "train"),
                              ("README.md", elsewhere / "file"), (".dollytrack-new", elsewhere),
                              (".dollytrack-gather", elsewhere / "file")]:
            for mode in [[], ["--resume"], ["--overwrite"]]:
                with self.subTest(place=place, mode=mode):
                    out = self.new_folder()
                    (out / place).parent.mkdir(parents=True)
                    if place != ".dollytrack-gather":
                        (out / ".dollytrack-gather").write_text("{}\n")
                    (out / place).symlink_to(target)
                    refused = run("-q", "gather", self.datasets / "room_0", "--out", out,
                                  "--format", "yolo", *mode)
                    self.assertFails(refused, 6, str(out))
                    self.assertTrue((out / place).is_symlink())
                    self.assertEqual(hashes(elsewhere), before)

    def test_linked_pictures_of_a_dataset_are_copied(self):
        linked = self.folder / "linked"
        shutil.copytree(self.datasets / "room_0", linked)
        shutil.move(linked / "rgb", self.folder / "other_disk")
        (linked / "rgb").symlink_to(self.folder / "other_disk")
        for more in [[], ["--hard-links"]]:
            out = self.gather("--format", "yolo", *more, datasets=[linked])
            self.assertEqual(len(list((out / "images" / "train").iterdir())), 6)

    def test_hard_links_only_when_asked(self):
        for more, count in [([], 1), (["--hard-links"], 2)]:
            copy = pathlib.Path(tempfile.mkdtemp(dir=self.folder)) / "room"
            shutil.copytree(self.datasets / "room_0", copy)
            out = self.gather("--format", "coco", *more, datasets=[copy])
            links = {path.stat().st_nlink for path in (out / "train").iterdir()}
            self.assertEqual(links, {count})

    # --- interruptions

    def many(self):
        """Many frames, as hard links to a dataset's files, so that gathering can be interrupted."""
        around = self.folder / "many"
        for number in range(0 if around.exists() else 100):
            self.copy_as(self.datasets / "room_1", around / f"copy_{number}", 100 + number, os.link)
        return around

    def test_a_run_that_met_damage_goes_on_to_the_same_bytes(self):
        around = self.folder / "mended"
        for number in range(6):
            self.copy_as(self.datasets / "room_1", around / f"copy_{number}", 100 + number)
        picture = around / "copy_4" / "rgb" / "000003.png"
        right = picture.read_bytes()
        for layout in ["yolo", "coco", "imagefolder", "webdataset"]:
            with self.subTest(layout):
                arguments = ["--format", layout, "--shard-frames", 5]
                whole = self.gather(*arguments, datasets=[around])
                out = self.new_folder()
                command = ["-q", "gather", around, "--out", out, *arguments]
                picture.write_bytes(right[:-1])
                self.assertFails(run(*command), 4, str(picture))
                picture.write_bytes(right)
                staged = out / ".dollytrack-new"
                pictures = sorted(staged.glob("*.tar") if layout == "webdataset"
                                  else staged.rglob("*.png"))
                self.assertGreater(len(pictures), 3)
                self.assertFails(run(*command, "--resume", "--title", "Others"), 2,
                                 "other contents",
                                 "the title")
                # An image lost in a power cut is written again; complete files stay.
                lost, kept = pictures[:2]
                before = kept.stat()
                if layout != "webdataset":
                    lost.write_bytes(b"\0" * lost.stat().st_size)
                done = run(*command, "--resume")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(hashes(out), hashes(whole))
                after = (out / kept.relative_to(staged)).stat()
                self.assertEqual((after.st_ino, after.st_mtime_ns), (before.st_ino, before.st_mtime_ns))

    def test_a_damaged_tar_file_is_written_again(self):
        around = self.damaged(lambda folder: (folder / "rgb" / "000004.png").write_bytes(b"x"))
        out = self.new_folder()
        command = ["-q", "gather", around / "good", around / "bad", "--out", out, "--format",
                   "webdataset", "--shard-frames", 2]
        self.assertEqual(run(*command).returncode, 4)
        first = out / ".dollytrack-new" / "train-000000.tar"
        first.write_bytes(b"\0" * first.stat().st_size)
        shutil.copy(self.datasets / "room_1" / "rgb" / "000004.png", around / "bad" / "rgb")
        done = run(*command, "--resume")
        self.assertEqual(done.returncode, 0, done.stderr)
        whole = self.gather(*command[-4:], datasets=[around / "good", around / "bad"])
        self.assertEqual(hashes(out), hashes(whole))

    def test_an_interrupted_run_goes_on_to_the_same_bytes(self):
        for layout, more in [("coco", []), ("webdataset", ["--shard-frames", 5])]:
            with self.subTest(layout):
                arguments = ["--format", layout, "--split", "by-room", "80/10/10", *more]
                whole = self.gather(*arguments, datasets=[self.many()])
                out = self.new_folder()
                staged = out / ".dollytrack-new"
                command = ["-q", "--threads", 1, "gather", self.many(), "--out", out, *arguments]
                stops = 0
                for sent in [signal.SIGINT, signal.SIGKILL, signal.SIGTERM]:
                    process = start(*command, *(["--resume"] if stops else []))
                    files = sum(len(names) for _, _, names in os.walk(staged))
                    self.assertTrue(wait_for(lambda: process.poll() is not None or sum(
                        len(names) for _, _, names in os.walk(staged)) > files + 3))
                    process.send_signal(sent)
                    _, errors = process.communicate()
                    if process.returncode == 0:
                        break
                    stops += 1
                    self.assertFalse((out / "gather.json").exists())
                    self.assertEqual(process.returncode, -9 if sent == signal.SIGKILL else 128 + sent,
                                     errors)
                self.assertGreater(stops, 0)
                done = run(*command, "--resume")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(hashes(out), hashes(whole))

    def test_a_replacement_that_was_cut_off_is_ended(self):
        """As if the program was killed after it decided to replace, before any file was moved."""
        out = self.gather("--format", "yolo", datasets=[self.datasets / "room_0"])
        new = self.gather("--format", "coco", datasets=[self.datasets / "room_1"])
        staged = out / ".dollytrack-new"
        shutil.copytree(new, staged)
        shutil.copy(out / "SHA256SUMS", staged / "replaced.sums")
        (out / "gather.json").rename(staged / "replaced.json")
        (out / ".dollytrack-gather").write_text('{"identity": {}, "version": 1}\n')
        refused = run("-q", "gather", self.datasets / "room_1", "--out", out, "--format", "coco")
        self.assertFails(refused, 2, "complete")
        self.assertEqual(hashes(out), hashes(new))

    def test_memory_does_not_grow_with_frames(self):
        out = self.new_folder()
        done = subprocess.run(["/usr/bin/env", "python3", "-c", (
            "import resource, subprocess, sys\n"
            "code = subprocess.call(sys.argv[1:])\n"
            "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)\n"
            "sys.exit(code)"), PROGRAM, "-q", "gather", self.many(), "--out", out, "--format",
            "webdataset"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertLess(int(done.stdout.split()[-1]), 200_000)  # KiB


if __name__ == "__main__":
    unittest.main()
