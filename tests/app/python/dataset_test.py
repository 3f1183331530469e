"""Compares dollytrack.Dataset with OpenCV, the COCO file and PyTorch, on an export of the command
line; it must never load the engine."""
import importlib.util
import json
import shutil
import struct
import sys
import unittest
import zlib
from unittest import mock

import cv2
import numpy as np

from module import FolderCase, SET, dt, run, tiny_room
from dollytrack import png

HAS_TORCH = importlib.util.find_spec("torch") is not None
READ = ["rgb", "depth", "instance", "semantic", "normal_camera", "normal_world", "albedo",
        "object_coordinates", "rgb_right", "depth_right", "disparity", "rgb_sensor", "depth_sensor",
        "roughness", "metallic"]


def encoded(pixels, filters):
    """A PNG file of the pixels with these filters, one per line, written by the rules of the
    format."""
    height, width = pixels.shape[:2]
    lines = pixels.astype(">u2").view(np.uint8) if pixels.dtype == np.uint16 else pixels
    lines = lines.reshape(height, -1).astype(int)
    step = lines.shape[1] // width
    packed = b""
    for y, kind in enumerate(filters):
        row = []
        for x in range(lines.shape[1]):
            left = lines[y, x - step] if x >= step else 0
            above = lines[y - 1, x] if y else 0
            corner = lines[y - 1, x - step] if y and x >= step else 0
            near = left + above - corner
            paeth = min((left, above, corner), key=lambda one: abs(near - one))
            row.append((lines[y, x] - (0, left, above, (left + above) // 2, paeth)[kind]) % 256)
        packed += bytes([kind, *row])

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    colour = 0 if pixels.ndim == 2 else {3: 2, 4: 6}[pixels.shape[2]]
    head = struct.pack(">IIBBBBB", width, height, 8 * pixels.itemsize, colour, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(packed))
            + chunk(b"IEND", b""))


class DatasetTest(FolderCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        tiny_room.write(cls.folder / "room.obj")
        cls.out = cls.folder / "dataset"
        made = run("export", cls.folder / "room.obj", "--out", cls.out, "--max-frames", 10, *SET,
                   "--folds", 3, "--modalities", "all")
        assert made.returncode == 0, made.stderr
        cls.data = dt.Dataset(cls.out)
        cls.card = json.loads((cls.out / "dataset.json").read_text())
        cls.coco = json.loads((cls.out / "annotations.json").read_text())

    def test_the_engine_is_not_loaded(self):
        self.assertNotIn("dollytrack._core", sys.modules)

    def test_images_are_those_that_opencv_reads(self):
        self.assertEqual(sorted(self.data.modalities), sorted(READ))
        scale = {"depth": 1e-3, "depth_right": 1e-3, "depth_sensor": 1e-3, "disparity": 1 / 256,
                 "object_coordinates": 1 / 65535, "roughness": 1 / 255, "metallic": 1 / 255}
        for i, sample in enumerate(self.data):
            for name in sample:
                read = cv2.imread(str(self.out / name / f"{i:06d}.png"), cv2.IMREAD_UNCHANGED)
                read = read[:, :, ::-1] if read.ndim == 3 else read
                if name.startswith("normal"):
                    expected = read / 65535 * 2 - 1
                    expected[(read == 0).all(axis=2)] = 0
                else:
                    expected = read * scale.get(name, 1)
                np.testing.assert_allclose(sample[name], expected, rtol=1e-6, atol=1e-6)
                if name in ("rgb", "instance", "semantic"):
                    self.assertEqual(sample[name].dtype, read.dtype)

    def test_boxes_and_labels_are_those_of_the_coco_file(self):
        found = 0
        for i, sample in enumerate(self.data):
            rows = [a for a in self.coco["annotations"] if a["image_id"] == i + 1]
            np.testing.assert_array_equal(sample.boxes, np.array([a["bbox"] for a in rows],
                                                                 np.float32).reshape(-1, 4))
            self.assertEqual(sample.labels.tolist(), [a["category_id"] for a in rows])
            for box, one, area in zip(sample.boxes, sample.object_ids, sample.areas):
                ys, xs = np.nonzero(sample["instance"] == one)
                self.assertEqual(area, len(xs))
                self.assertEqual(box.tolist(), [xs.min(), ys.min(), xs.max() + 1 - xs.min(),
                                                ys.max() + 1 - ys.min()])
                found += 1
        self.assertGreater(found, 10)
        names = {c["id"]: c["name"] for c in self.coco["categories"]}
        self.assertEqual(self.data.classes, names)

    def test_poses_are_those_of_the_trajectory(self):
        for sample, row in zip(self.data, self.card["frames"]):
            turn, _ = cv2.Rodrigues(rotation_vector(row["quaternion_xyzw"]))
            np.testing.assert_allclose(sample.pose[:3, :3], turn, atol=1e-9)
            np.testing.assert_array_equal(sample.pose[:3, 3], row["position"])
            self.assertEqual(sample.time_s, row["time_s"])
        self.assertEqual(self.data.poses.shape, (10, 4, 4))

    def test_indexing_is_a_sequences(self):
        self.assertEqual(len(self.data), 10)
        self.assertEqual(self.data[-1].index, 9)
        self.assertEqual([s.index for s in self.data[2:8:3]], [2, 5])
        self.assertEqual([s.index for s in self.data[2:8][np.array([5, 0])]], [7, 2])
        self.assertEqual([s.index for s in self.data[np.arange(10) % 5 == 1]], [1, 6])
        self.assertEqual(len(self.data[[]]), 0)
        self.assertEqual(self.data[3:][0].labels.tolist(), self.data[3].labels.tolist())
        for index in (10, -11):
            with self.assertRaises(IndexError):
                self.data[index]
        for index in (1.5, "rgb", None, True, np.True_, (), [0.5], [[1]], np.array(1.5)):
            with self.assertRaises(dt.Usage):
                self.data[index]
        with self.assertRaises(KeyError):
            self.data[0]["flow_forward"]

    def test_tracks_are_those_of_the_files(self):
        tracks = self.data.tracks()
        count = len(tracks.points)
        self.assertGreater(count, 50)
        self.assertEqual(tracks.first_frame, 0)
        for name in ("points", "points_3d", "occluded", "query_points", "object_ids"):
            expected = np.load(self.out / "tracks" / f"000000_{name}.npy")
            self.assertEqual(len(expected), count)
            np.testing.assert_array_equal(getattr(tracks, name), expected)
        self.assertEqual(self.data[3:].tracks(9).points.shape, (count, 10, 2))
        for frame in (10, -1, 1.5, "0"):
            with self.assertRaises(dt.Usage):
                self.data.tracks(frame)
        copy = self.folder / "damaged_tracks"
        shutil.copytree(self.out, copy)
        for damage in (lambda file: np.save(file, np.zeros((count, 9, 2), np.float32)),
                       lambda file: np.save(file, np.zeros((count, 10, 2))),
                       lambda file: file.write_bytes(b"\x93NUMPY"),
                       lambda file: np.save(file, np.array([{}]), allow_pickle=True),
                       lambda file: file.unlink()):
            damage(copy / "tracks" / "000000_points.npy")
            with self.assertRaises(dt.BadInput) as caught:
                dt.Dataset(copy).tracks()
            self.assertIn("000000_points.npy", str(caught.exception))

    def test_datasets_without_tracks_and_boxes_say_how_to_export_them(self):
        bare = self.folder / "bare"
        made = run("export", self.folder / "room.obj", "--out", bare, "--max-frames", 2, *SET,
                   "--modalities", "rgb", "--formats", "yolo")
        self.assertEqual(made.returncode, 0, made.stderr)
        with self.assertRaisesRegex(dt.Usage, r"add 'tracks' to the modalities of export\(\)"):
            dt.Dataset(bare).tracks()
        with self.assertRaisesRegex(dt.BadInput, r"add 'coco' to the formats of export\(\)"):
            dt.Dataset(bare)[0].boxes

    def test_loaders_say_that_they_need_pytorch_after_their_arguments(self):
        absent = {name: value for name, value in sys.modules.items()
                  if name != "dollytrack.torch_dataset"}
        with mock.patch.dict(sys.modules, {**absent, "torch": None}, clear=True):
            with self.assertRaisesRegex(ModuleNotFoundError, "python3-torch.*pip") as caught:
                self.data.torch()
            self.assertEqual(caught.exception.name, "torch")
            for wrong in ({"boxes": "xywh"}, {"images": ["flow"]}, {"pad": 0}, {"transform": 3}):
                with self.assertRaises(dt.Usage):
                    self.data.torch(**wrong)

    def test_folders_around_datasets_are_told(self):
        folder = self.folder / "around"
        (folder / "kitchen" / "dataset").mkdir(parents=True)
        (folder / "kitchen" / "dataset" / "dataset.json").write_text("{}")
        with self.assertRaisesRegex(dt.BadInput, "such as .*kitchen/dataset"):
            dt.Dataset(folder)
        self.assertIn("kitchen/dataset", run("verify", folder).stderr)
        (folder / "gather.json").write_text("{}")
        with self.assertRaisesRegex(dt.BadInput, "gathered dataset"):
            dt.Dataset(folder)
        self.assertIn("gathered dataset", run("verify", folder).stderr)

    def test_splits_are_the_folds(self):
        splits = self.data.splits
        self.assertEqual({"train", "val", "fold_0_train", "fold_2_val"} - set(splits), set())
        with self.assertRaisesRegex(KeyError, "no split 'test': it has fold_0_train, "):
            splits["test"]
        held_back = sorted(s.index for i in range(3) for s in splits[f"fold_{i}_val"])
        self.assertEqual(held_back, list(range(10)))
        listed = (self.out / "folds" / "fold_0_val.txt").read_text().split()
        self.assertEqual([f"rgb/{s.index:06d}.png" for s in splits["val"]], listed)

    def test_every_filter_of_png_is_undone(self):
        random = np.random.default_rng(1)
        for shape in ((9, 7), (9, 7, 3), (5, 1, 4), (1, 6)):
            for dtype in (np.uint8, np.uint16):
                pixels = random.integers(0, np.iinfo(dtype).max, shape, dtype, endpoint=True)
                filters = random.integers(0, 5, shape[0])
                data = encoded(pixels, filters)
                np.testing.assert_array_equal(png.decode(data), pixels)
                if dtype == np.uint8 or len(shape) < 3 or shape[2] == 3:
                    read = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED)
                    swapped = read if read.ndim == 2 else read[:, :, [2, 1, 0, 3][:read.shape[2]]]
                    np.testing.assert_array_equal(swapped.reshape(shape), pixels)

    def test_damaged_pictures_are_refused_and_never_crash(self):
        whole = (self.out / "rgb" / "000000.png").read_bytes()
        random = np.random.default_rng(2)
        for _ in range(300):
            data = bytearray(whole)
            for at in random.integers(0, len(data), random.integers(1, 4)):
                data[at] = random.integers(256)
            data = bytes(data[:random.integers(1, len(data) + 1)] if random.random() < 0.3 else data)
            try:
                pixels = png.decode(data)
            except png.Damaged:
                continue
            np.testing.assert_array_equal(pixels, png.decode(whole))

    def test_a_dataset_that_is_none_is_told_as_the_command_line_tells_it(self):
        unfinished = self.folder / "unfinished"
        shutil.copytree(self.out, unfinished)
        (unfinished / "dataset.json").unlink()
        for place in (self.folder / "nowhere", self.folder / "room.obj", unfinished):
            with self.assertRaises(dt.BadInput) as caught:
                dt.Dataset(place)
            said = run("verify", place)
            self.assertEqual(said.returncode, caught.exception.exit_code)
            if place != unfinished:
                self.assertIn(str(caught.exception), said.stderr)
        self.assertIn("it is not a dataset", str(caught.exception))
        (unfinished / ".dollytrack-export").touch()
        with self.assertRaisesRegex(dt.BadInput, "did not finish.*resume=True"):
            dt.Dataset(unfinished)
        (unfinished / "dataset.json").write_text("{\"format\": \"other\"}")
        with self.assertRaises(dt.BadInput):
            dt.Dataset(unfinished)
        for text in ("[", "[]", "{}", "{\"format\": \"dollytrack dataset\"}", "[" * 100_000):
            (unfinished / "dataset.json").write_text(text)
            with self.assertRaises(dt.BadInput):
                dt.Dataset(unfinished)

    def test_missing_and_damaged_files_are_named(self):
        damaged = self.folder / "damaged"
        shutil.copytree(self.out, damaged)
        (damaged / "rgb" / "000001.png").unlink()
        (damaged / "depth" / "000002.png").write_bytes(b"nothing")
        shutil.copy(damaged / "instance" / "000003.png", damaged / "semantic" / "000003.png")
        data = dt.Dataset(damaged)
        for index, name in ((1, "rgb"), (2, "depth")):
            with self.assertRaisesRegex(dt.BadInput, f"{name}/00000{index}.png"):
                data[index][name]
        (damaged / "annotations.json").write_text("{\"annotations\": [{\"image_id\": 99}]}")
        with self.assertRaisesRegex(dt.BadInput, "annotations.json"):
            data[0].boxes
        (damaged / "annotations.json").unlink()
        with self.assertRaisesRegex(dt.BadInput, "coco"):
            data[0].labels
        (damaged / "folds" / "fold_0_val.txt").write_text("rgb/000099.png\n")
        with self.assertRaisesRegex(dt.BadInput, "fold_0_val"):
            data.splits

    @unittest.skipUnless(HAS_TORCH, "PyTorch is not installed")
    def test_a_loader_gets_batches(self):
        import torch
        for workers in (0, 2):
            loader = torch.utils.data.DataLoader(
                self.data.torch(boxes="xyxy", images=["depth", "semantic", "instance"]),
                batch_size=4, num_workers=workers)
            batches = list(loader)
            self.assertEqual([len(pictures) for pictures, _ in batches], [4, 4, 2])
            pictures, targets = batches[1]
            self.assertEqual((pictures.dtype, tuple(pictures.shape)), (torch.float32, (4, 3, 48, 64)))
            for k in range(4):
                sample = self.data[4 + k]
                np.testing.assert_allclose(pictures[k].permute(1, 2, 0) * 255, sample["rgb"], atol=1e-3)
                count = int(targets["count"][k])
                self.assertEqual(int(targets["image_id"][k]), 4 + k)
                self.assertEqual(count, len(sample.labels))
                box = targets["boxes"][k][:count].numpy()
                np.testing.assert_array_equal(box[:, :2], sample.boxes[:, :2])
                np.testing.assert_array_equal(box[:, 2:] - box[:, :2], sample.boxes[:, 2:])
                np.testing.assert_array_equal(targets["labels"][k][:count], sample.labels)
                self.assertTrue((targets["labels"][k][count:] == -1).all())
                np.testing.assert_array_equal(targets["depth"][k], sample["depth"])
                np.testing.assert_array_equal(targets["semantic"][k], sample["semantic"])

    def test_pixels_without_a_class_have_the_id_that_the_file_of_classes_leaves(self):
        self.assertEqual(self.data.void_id, 0)
        classes = {"classes": [{"id": 0, "name": "table", "matches": ["table"]}], "other": "ignore"}
        for void, wanted in ((None, 255), (9, 9)):
            labels, out = self.folder / f"labels_{wanted}.json", self.folder / f"own_{wanted}"
            labels.write_text(json.dumps({**classes, **({} if void is None else {"void": void})}))
            made = run("export", self.folder / "room.obj", "--out", out, "--max-frames", 4, *SET,
                       "--labels", labels, "--modalities", "rgb,semantic,instance")
            self.assertEqual(made.returncode, 0, made.stderr)
            data = dt.Dataset(out)
            self.assertEqual((data.void_id, data.classes), (wanted, {0: "table"}))
            tables = [one["id"] for one in data.objects if one["name"] == "table"]
            for sample in data:
                of_table = np.isin(sample["instance"], tables)
                np.testing.assert_array_equal(sample["semantic"], np.where(of_table, 0, wanted))

    @unittest.skipUnless(HAS_TORCH, "PyTorch is not installed")
    def test_tensors_are_indices(self):
        import torch
        order = torch.tensor([7, 2, 5])
        self.assertEqual([sample.index for sample in self.data[order]], [7, 2, 5])
        self.assertEqual([sample.index for sample in self.data[torch.arange(10) > 7]], [8, 9])
        self.assertEqual(self.data[order[0]].index, 7)
        with self.assertRaises(dt.Usage):
            self.data[torch.tensor(True)]
        with self.assertRaisesRegex(dt.Usage, r"data\[0:3\].torch\(\)"):
            self.data.torch()[0:3]

    @unittest.skipUnless(HAS_TORCH, "PyTorch is not installed")
    def test_datasets_padded_to_a_number_make_one_loader(self):
        import torch
        most = max(len(sample.labels) for sample in self.data)
        rooms = [self.data[:4].torch(pad=most + 3), self.data[4:].torch(pad=most + 3)]
        loader = torch.utils.data.DataLoader(torch.utils.data.ConcatDataset(rooms), batch_size=10)
        [(pictures, targets)] = list(loader)
        self.assertEqual((len(pictures), tuple(targets["boxes"].shape)), (10, (10, most + 3, 4)))
        self.assertEqual(targets["count"].tolist(), [len(sample.labels) for sample in self.data])
        self.assertEqual(self.data.torch(pad=np.int64(most))[0][1]["labels"].shape[0], most)
        with self.assertRaisesRegex(dt.Usage, f"{most} boxes"):
            self.data.torch(pad=most - 1)
        for wrong in ({"pad": "all"}, {"pad": 1.5}, {"pad": None}, {"transform": 3}):
            with self.assertRaises(dt.Usage):
                self.data.torch(**wrong)

    @unittest.skipUnless(HAS_TORCH, "PyTorch is not installed")
    def test_unpadded_targets_are_collated_as_lists(self):
        import torch
        data = self.data.torch(boxes="yolo", pad=False)
        loader = torch.utils.data.DataLoader(data, batch_size=5, collate_fn=data.collate)
        pictures, targets = next(iter(loader))
        self.assertEqual((pictures.shape[0], len(targets)), (5, 5))
        for k, target in enumerate(targets):
            sample = self.data[k]
            expected = np.hstack([sample.boxes[:, :2] + sample.boxes[:, 2:] / 2, sample.boxes[:, 2:]])
            np.testing.assert_allclose(target["boxes"], expected / [64, 48, 64, 48], atol=1e-6)
        plain = self.data.torch(boxes=None, transform=lambda picture, target: (picture.mean(), target))
        self.assertEqual(sorted(plain[0][1]), ["image_id"])
        for wrong in ({"boxes": "voc"}, {"images": ["flow"]}):
            with self.assertRaises(dt.Usage):
                self.data.torch(**wrong)


def rotation_vector(xyzw):
    vector, w = np.array(xyzw[:3]), xyzw[3]
    length = np.linalg.norm(vector)
    angle = 2 * np.arctan2(length, w)
    return vector * (angle / length if length > 0 else 2)


if __name__ == "__main__":
    unittest.main()
