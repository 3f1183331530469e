#!/usr/bin/python3
"""Parquet files of `gather`, read with npm's hyparquet and compared with the source datasets.

Usage: gather_parquet_test.py PROGRAM [unittest arguments]
"""
import base64
import json
import os
import pathlib
import shutil
import subprocess
import unittest

import cv2
import numpy as np
import yaml

from gather_case import PARTS, GatherCase, mask_of, rotation
from support.program import hashes, run

HERE = pathlib.Path(__file__).parent
READERS = HERE.parents[1] / "readers"
HAS_READER = shutil.which("node") and (READERS / "node_modules" / "hyparquet").exists()


def read(path):
    """Runs hyparquet on a file."""
    return subprocess.run(["node", HERE / "parquet_rows.mjs", path], capture_output=True, text=True)


class Parquet(GatherCase):
    @classmethod
    def setUpClass(cls):
        if not HAS_READER:
            message = f"hyparquet is missing: install nodejs, and it by: npm ci --prefix {READERS}"
            if os.environ.get("DOLLYTRACK_REQUIRE_READERS") == "1":
                raise AssertionError(message)
            raise unittest.SkipTest(message)
        super().setUpClass()

    def files_of(self, out, part):
        """The files of a part, whose names count them."""
        files = sorted((out / "data").glob(f"{part}-*.parquet"))
        self.assertEqual([path.name for path in files],
                         [f"{part}-{i:05}-of-{len(files):05}.parquet" for i in range(len(files))])
        return files

    def tables_of(self, out, part):
        tables = []
        for path in self.files_of(out, part):
            done = read(path)
            self.assertEqual(done.returncode, 0, done.stderr)
            tables.append(json.loads(done.stdout))
        return tables

    def assert_image(self, image, name, folder, modality, index):
        ending = ".png" if modality == "rgb" else f".{modality}.png"
        self.assertEqual(image["path"], name + ending)
        self.assertEqual(base64.b64decode(image["bytes"]),
                         (folder / modality / f"{index:06}.png").read_bytes())

    def assert_row(self, row, name, folder, index):
        """Compares a row with the frame of a dataset."""
        for column, modality in [("image", "rgb"), ("depth", "depth"), ("instance", "instance"),
                                 ("semantic", "semantic")]:
            self.assert_image(row[column], name, folder, modality, index)
        card = json.loads((folder / "dataset.json").read_text())
        stored = card["frames"][index]
        self.assertEqual((row["width"], row["height"], row["frame"]), (160, 120, index))
        self.assertEqual(row["scene"], card["scene"]["name"])
        self.assertEqual(f"{row['source']}_{index:06}", name)
        self.assertEqual(row["timestamp"], stored["time_s"])
        lens = card["conventions"]["intrinsics"]
        self.assertEqual(row["intrinsics"], [lens[key] for key in ("fx", "fy", "cx", "cy")])
        pose = np.eye(4)
        pose[:3, :3] = rotation(stored["quaternion_xyzw"])
        pose[:3, 3] = stored["position"]
        np.testing.assert_allclose(np.reshape(row["pose"], (4, 4)), pose, atol=1e-12)
        rows = [one for one in json.loads((folder / "annotations.json").read_text())["annotations"]
                if one["image_id"] == index + 1]
        objects = row["objects"]
        self.assertEqual(objects["bbox"], [one["bbox"] for one in rows])
        self.assertEqual(objects["category"], [one["category_id"] - 1 for one in rows])
        self.assertEqual(objects["area"], [one["area"] for one in rows])
        ids = cv2.imread(str(folder / "instance" / f"{index:06}.png"), cv2.IMREAD_UNCHANGED)
        for value, mask in zip(objects["object_id"], objects["segmentation"], strict=True):
            np.testing.assert_array_equal(mask_of(json.loads(mask)), ids == value)
        return len(rows)

    def test_rows_are_the_frames_of_the_datasets(self):
        out = self.gather("--format", "parquet", "--split", "by-room", "60/20/20")
        frames = {name: (folder, index) for name, folder, index in self.frames()}
        image_ids, object_ids, objects = set(), set(), 0
        for part in PARTS:
            for table in self.tables_of(out, part):
                features = json.loads(table["metadata"]["huggingface"])["info"]["features"]
                for row in table["rows"]:
                    self.assertEqual(list(features), list(row))
                    self.assertEqual(list(features["objects"]), list(row["objects"]))
                    name = row["image"]["path"].removesuffix(".png")
                    objects += self.assert_row(row, name, *frames.pop(name))
                    image_ids.add(row["image_id"])
                    object_ids.update(row["objects"]["id"])
        self.assertEqual(frames, {})
        self.assertEqual(image_ids, set(range(1, len(list(self.frames())) + 1)))
        self.assertEqual(object_ids, set(range(1, objects + 1)))
        self.assertGreater(objects, 50)
        names = features["objects"]["category"]["feature"]["names"]
        classes = json.loads((self.datasets / "room_0" / "annotations.json").read_text())
        self.assertEqual(names, [one["name"] for one in classes["categories"]])
        self.assertEqual({name: features[name]["_type"] for name in ("image", "depth")},
                         {"image": "Image", "depth": "Image"})
        header = yaml.safe_load((out / "README.md").read_text().split("---\n")[1])
        for one, part in zip(header["configs"][0]["data_files"], PARTS, strict=True):
            self.assertEqual(sorted(out.glob(one["path"])), self.files_of(out, part))

    def test_a_frame_without_objects_has_empty_lists(self):
        empty = self.folder / "empty"
        shutil.copytree(self.datasets / "room_0", empty)
        path = empty / "annotations.json"
        file = json.loads(path.read_text())
        file["annotations"] = [one for one in file["annotations"] if one["image_id"] not in (1, 3)]
        self.replace_listed(empty, "annotations.json", json.dumps(file).encode())
        (table,) = self.tables_of(self.gather("--format", "parquet", datasets=[empty]), "train")
        for index, row in enumerate(table["rows"]):
            boxes = [box for _, box, _ in self.boxes_of(empty, index)]
            self.assertEqual(len(boxes) == 0, index in (0, 2))
            self.assertEqual(row["objects"]["bbox"], boxes)

    def test_files_and_row_groups_are_limited(self):
        out = self.gather("--format", "parquet", "--shard-size", "0.1MB")
        sizes = [path.stat().st_size for path in self.files_of(out, "train")]
        self.assertGreater(len(sizes), 3)
        self.assertLessEqual(max(sizes), 100_000)
        self.assertGreater(min(sizes[:-1]), 50_000)
        out = self.gather("--format", "parquet", "--shard-frames", 4)
        self.assertEqual({len(table["rows"]) for table in self.tables_of(out, "train")[:-1]}, {4})
        (table,) = self.tables_of(self.gather("--format", "parquet", datasets=[self.many()]), "train")
        self.assertEqual(table["row_groups"], [100] * 6)

    def test_the_reader_notices_damage(self):
        """Otherwise the comparisons of this test would prove nothing."""
        out = self.gather("--format", "parquet", datasets=[self.datasets / "room_0"])
        (path,) = self.files_of(out, "train")
        right = path.read_bytes()
        whole = read(path).stdout
        footer = len(right) - 8 - int.from_bytes(right[-8:-4], "little")
        image = right.index((self.datasets / "room_0" / "rgb" / "000003.png").read_bytes())
        damaged = self.folder / "damaged.parquet"
        for place, is_refused in [(len(right) - 1, True), (footer, True), (image + 100, False)]:
            data = bytearray(right)
            data[place] ^= 0x5A
            damaged.write_bytes(data)
            done = read(damaged)
            self.assertEqual(done.returncode != 0, is_refused, done.stderr)
            self.assertNotEqual(done.stdout, whole)

    def test_an_interrupted_run_keeps_its_files(self):
        """The run stops in the second part, when the files of the first have their last names."""
        around = self.folder / "mended"
        for number in range(6):
            self.copy_as(self.datasets / "room_1", around / f"copy_{number}", 200 + number)
        arguments = ["--format", "parquet", "--split", "by-room", "50/50", "--shard-frames", 5]
        whole = self.gather(*arguments, datasets=[around])
        card = json.loads((whole / "gather.json").read_text())
        last = [one["name"] for one in card["sources"] if one["part"] == "val"][-1]
        picture = around / last / "rgb" / "000003.png"
        right = picture.read_bytes()
        out = self.new_folder()
        command = ["-q", "gather", around, "--out", out, *arguments]
        picture.write_bytes(right[:-1])
        self.assertFails(run(*command), 4, str(picture))
        picture.write_bytes(right)
        finished = sorted((out / ".dollytrack-new" / "data").glob("train-*-of-*"))
        self.assertGreater(len(finished), 2)
        # One of them is lost in a power cut; it and those after it are written again.
        finished[1].write_bytes(b"\0" * finished[1].stat().st_size)
        before = finished[0].stat()
        done = run(*command, "--resume")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(hashes(out), hashes(whole))
        after = (out / "data" / finished[0].name).stat()
        self.assertEqual((after.st_ino, after.st_mtime_ns), (before.st_ino, before.st_mtime_ns))

    def test_every_thread_count_gives_the_same_bytes(self):
        results = []
        for threads in (1, 4):
            out = self.new_folder()
            done = run("-q", "--threads", threads, "gather", self.datasets, "--out", out, "--format",
                       "parquet", "--shard-frames", 4)
            self.assertEqual(done.returncode, 0, done.stderr)
            results.append(hashes(out))
        self.assertEqual(results[0], results[1])


if __name__ == "__main__":
    unittest.main()
