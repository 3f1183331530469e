#!/usr/bin/python3
"""Layouts of one folder per scene, BOP and TartanAir, read by the rules of their readers.

Usage: gather_scenes_test.py PROGRAM [unittest arguments]
"""
import collections
import json
import shutil
import unittest

import cv2
import numpy as np

from gather_case import PARTS, GatherCase, rotation
from support.program import hashes, run

SPLIT = ["--split", "by-room", "60/20/20"]


class Scenes(GatherCase):
    @classmethod
    def export(cls, project, out, *arguments):
        super().export(project, out, "--formats", "coco,bop,tartanair", *arguments)

    def folder_of(self, name):
        return self.datasets / ("again/dataset" if name == "again" else name)

    def part_of(self, out, name):
        return next(one["part"] for one in self.card(out)["sources"] if one["name"] == name)

    def assert_copied(self, folder, source, inner):
        """The files of a folder are those of the source dataset."""
        files = sorted(path.name for path in (folder / inner).iterdir())
        self.assertEqual(files, sorted(path.name for path in (source / inner).iterdir()))
        for name in files:
            self.assertEqual((folder / inner / name).read_bytes(),
                             (source / inner / name).read_bytes())

    # --- BOP

    def bop_scenes(self, out):
        """(index entry, folder) of each scene."""
        index = json.loads((out / "index.json").read_text())
        self.assertEqual([one["scene_id"] for one in index["scenes"]], list(range(7)))
        found = {path for part in PARTS for path in (out / part).iterdir()}
        scenes = [(one, out / one["part"] / f"{one['scene_id']:06}") for one in index["scenes"]]
        self.assertEqual({folder for _, folder in scenes}, found)
        return scenes

    def test_bop_scenes_agree_with_their_masks(self):
        """Read as bop_toolkit does, without the source datasets."""
        out = self.gather("--format", "bop", *SPLIT)
        camera = json.loads((out / "camera.json").read_text())
        seen = 0
        for _, scene in self.bop_scenes(out):
            cameras, truths, infos = (json.loads((scene / f"scene_{name}.json").read_text())
                                      for name in ("camera", "gt", "gt_info"))
            self.assertEqual(len(list((scene / "rgb").iterdir())), len(truths))
            for key, truth in truths.items():
                image = int(key)
                k = np.reshape(cameras[key]["cam_K"], (3, 3))
                np.testing.assert_allclose([k[0, 0], k[1, 1], k[0, 2], k[1, 2]],
                                           [camera[name] for name in ("fx", "fy", "cx", "cy")])
                depth = cv2.imread(str(scene / "depth" / f"{image:06}.png"), cv2.IMREAD_UNCHANGED)
                self.assertEqual(depth.shape, (camera["height"], camera["width"]))
                self.assertEqual(len(truth), len(infos[key]))
                for number, info in enumerate(infos[key]):
                    mask = cv2.imread(str(scene / "mask_visib" / f"{image:06}_{number:06}.png"),
                                      cv2.IMREAD_UNCHANGED) > 0
                    self.assertEqual(int(mask.sum()), info["px_count_visib"])
                    self.assertEqual(list(cv2.boundingRect(mask.astype(np.uint8))),
                                     info["bbox_visib"])
                    seen += 1
        self.assertGreater(seen, 50)

    def test_bop_objects_have_one_id_in_all_datasets_of_their_scene(self):
        out = self.gather("--format", "bop", *SPLIT)
        objects = {one["obj_id"]: one
                   for one in json.loads((out / "index.json").read_text())["objects"]}
        ids = collections.defaultdict(dict)  # gathered id by the dataset's, of each dataset
        for one, scene in self.bop_scenes(out):
            source = self.folder_of(one["source"])
            for inner in ("rgb", "depth", "mask", "mask_visib"):
                self.assert_copied(scene, source, inner)
            for name in ("scene_camera.json", "scene_gt_info.json"):
                self.assertEqual((scene / name).read_bytes(), (source / name).read_bytes())
            truths = json.loads((scene / "scene_gt.json").read_text())
            listed = json.loads((source / "dataset.json").read_text())["objects"]
            by_id = {stored["id"]: stored for stored in listed}
            for key, truth in json.loads((source / "scene_gt.json").read_text()).items():
                self.assertEqual(len(truths[key]), len(truth))
                for new, old in zip(truths[key], truth):
                    self.assertEqual({**new, "obj_id": None}, {**old, "obj_id": None})
                    mapped = ids[one["source"]].setdefault(old["obj_id"], new["obj_id"])
                    self.assertEqual(mapped, new["obj_id"])
                    about = objects[new["obj_id"]]
                    self.assertEqual(about["name"], by_id[old["obj_id"]]["name"])
        shared = set(ids["again"]) & set(ids["room_0"])
        self.assertGreater(len(shared), 1)
        for old in shared:
            self.assertEqual(ids["again"][old], ids["room_0"][old])
        of_scene = [set(ids["again"].values()) | set(ids["room_0"].values()),
                    *(set(ids[f"room_{i}"].values()) for i in range(1, 6))]
        self.assertEqual(sum(map(len, of_scene)), len(set().union(*of_scene)))
        self.assertEqual(set(objects), set(range(1, len(objects) + 1)))
        self.assertEqual(set().union(*of_scene), set(objects))

    def test_bop_without_one_lens_has_no_common_camera(self):
        wide = self.folder / "wide"
        self.export(self.folder / "0.dolly", wide, "--range", "0:2", "--set", "hfov_deg=100")
        out = self.gather("--format", "bop", "--mixed-lenses",
                          datasets=[self.datasets / "room_0", wide])
        self.assertFalse((out / "camera.json").exists())

    # --- TartanAir

    def test_tartanair_trajectories(self):
        out = self.gather("--format", "tartanair", *SPLIT)
        folders = {f"room_{i}": f"room_{i}/Easy/P000" for i in range(1, 6)}
        # The first two datasets are of one scene.
        folders.update({"again": "again/Easy/P000", "room_0": "again/Easy/P001"})
        found = {str(path.relative_to(out / part))
                 for part in PARTS for path in (out / part).glob("*/*/*")}
        self.assertEqual(found, set(folders.values()))
        for name, inner in folders.items():
            folder, source = out / self.part_of(out, name) / inner, self.folder_of(name)
            frames = json.loads((source / "dataset.json").read_text())["frames"]
            poses = np.loadtxt(folder / "pose_left.txt")
            self.assertEqual(poses.shape, (len(frames), 7))
            self.assertEqual(len(list((folder / "flow").iterdir())), 2 * (len(frames) - 1))
            for index, (frame, pose) in enumerate(zip(frames, poses)):
                # North, east, down to x, -y, -z; forward, right, down to the camera's axes.
                np.testing.assert_allclose(pose[:3] * [1, -1, -1], frame["position"], atol=1e-6)
                camera = np.diag([1, -1, -1]) @ rotation(pose[3:]) @ np.array(
                    [[0, 0, 1], [1, 0, 0], [0, 1, 0]])
                np.testing.assert_allclose(camera, rotation(frame["quaternion_xyzw"]), atol=1e-6)
                png = cv2.imread(str(source / "depth" / f"{index:06}.png"), cv2.IMREAD_UNCHANGED)
                depth = np.load(folder / "depth_left" / f"{index:06}_left_depth.npy")
                self.assertEqual(depth.dtype, np.float32)
                self.assertLess(np.abs(depth * 1000 - png)[png > 0].max(), 0.51)
                classes = np.load(folder / "seg_left" / f"{index:06}_left_seg.npy")
                semantic = cv2.imread(str(source / "semantic" / f"{index:06}.png"),
                                      cv2.IMREAD_UNCHANGED)
                np.testing.assert_array_equal(classes, semantic)
                np.testing.assert_array_equal(
                    cv2.imread(str(folder / "image_left" / f"{index:06}_left.png")),
                    cv2.imread(str(source / "rgb" / f"{index:06}.png")))
            self.assert_copied(folder, source, "flow")

    def test_tartanair_classes_are_left_out_if_they_are_mapped(self):
        (self.folder / "map.csv").write_text("chair,seat\n")
        out = self.new_folder()
        done = run("gather", self.datasets / "room_0", "--out", out, "--format", "tartanair",
                   "--class-map", self.folder / "map.csv")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("seg_left is left out", done.stderr)
        self.assertEqual(list(out.rglob("seg_left")), [])
        self.assertIn("Images of each frame: image_left, depth_left, ",
                      (out / "README.md").read_text())

    # --- both

    def test_datasets_without_the_format_are_refused(self):
        plain, flat = self.folder / "plain", self.folder / "flat"
        for out, arguments in [(plain, ["--formats", "coco"]),
                               (flat, ["--modalities", "rgb", "--formats", "coco,bop"])]:
            made = run("-q", "export", self.folder / "0.dolly", "--out", out, "--range", "0:2",
                       *arguments)
            self.assertEqual(made.returncode, 0, made.stderr)
        for folder, layout, option in [(plain, "bop", "--formats coco,bop"),
                                       (plain, "tartanair", "--formats coco,tartanair"),
                                       (flat, "bop", "--modalities rgb,depth")]:
            out = self.new_folder()
            refused = run("-q", "gather", self.datasets / "room_0", folder, "--out", out, "--format",
                          layout)
            self.assertFails(refused, 4, str(folder), option)
            self.assertFalse(out.exists())

    def test_interrupted_runs_go_on_to_the_same_bytes(self):
        for layout, damaged in [("bop", "mask_visib/000003_000000.png"),
                                ("tartanair", "depth_left/000003_left_depth.npy")]:
            with self.subTest(layout):
                around = self.folder / f"mended_{layout}"
                for number in range(3):
                    self.copy_as(self.datasets / "room_1", around / f"copy_{number}", 300 + number)
                whole = self.gather("--format", layout, datasets=[around])
                path = around / "copy_1" / damaged
                right = path.read_bytes()
                out = self.new_folder()
                command = ["-q", "gather", around, "--out", out, "--format", layout]
                path.write_bytes(right[:-1])
                self.assertFails(run(*command), 4, str(path))
                path.write_bytes(right)
                kept = next((out / ".dollytrack-new").rglob("000001*.png"))
                before = kept.stat()
                done = run(*command, "--resume")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(hashes(out), hashes(whole))
                after = (out / kept.relative_to(out / ".dollytrack-new")).stat()
                self.assertEqual((after.st_ino, after.st_mtime_ns),
                                 (before.st_ino, before.st_mtime_ns))
                path.unlink()
                done = run(*command, "--overwrite", "--skip-damaged")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(self.card(out)["skipped"], ["copy_1"])

    def test_truths_that_contradict_the_dataset_are_refused(self):
        for change in [lambda truths: truths["2"].pop(), lambda truths: truths.pop("2"),
                       lambda truths: truths["2"][0].update(obj_id=999),
                       lambda truths: truths.update({"99": []}), lambda truths: truths.clear()]:
            bad = self.folder / "bad_truths"
            shutil.rmtree(bad, ignore_errors=True)
            shutil.copytree(self.datasets / "room_1", bad)
            truths = json.loads((bad / "scene_gt.json").read_text())
            change(truths)
            self.replace_listed(bad, "scene_gt.json", json.dumps(truths).encode())
            refused = run("-q", "gather", bad, "--out", self.new_folder(), "--format", "bop")
            self.assertFails(refused, 4, str(bad), "export the dataset again")

    def test_files_that_the_dataset_does_not_list_are_missed(self):
        for layout, name, words in [("bop", "mask_visib/000002_000001.png", "frame 2 in mask_visib"),
                                    ("tartanair", "flow/000001_000002_mask.npy", "frame 1 in flow")]:
            bad = self.folder / f"bad_{layout}"
            shutil.copytree(self.datasets / "room_1", bad)
            card = json.loads((bad / "dataset.json").read_text())
            del card["files"][name]
            (bad / "dataset.json").write_text(json.dumps(card))
            refused = run("-q", "gather", bad, "--out", self.new_folder(), "--format", layout)
            self.assertFails(refused, 4, str(bad), words)


if __name__ == "__main__":
    unittest.main()
