#!/usr/bin/python3
"""Scene flow and point tracks in gathered WebDatasets, read with tarfile, OpenCV and NumPy.

Usage: gather_motion_test.py PROGRAM [unittest arguments]
"""
import json
import os
import pathlib
import shutil
import tarfile
import unittest

os.environ["OPENCV_IO_ENABLE_OPENEXR"] = "1"  # read when OpenCV is loaded

import cv2
import numpy as np

from gather_case import GatherCase, rotation
from support.program import hashes, run


WEBDATASET = ["--format", "webdataset", "--shard-frames", 4]


def decoded(data):
    return cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED)


class Motion(GatherCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.moving = cls.folder / "moving"
        for number in range(2):
            cls.export(cls.folder / f"{number}.dolly", cls.moving / f"clip_{number}",
                       "--modalities", "rgb,depth,scene_flow,tracks", "--flow-distances", "1,3")

    @staticmethod
    def samples(out):
        """The files of each frame by extension."""
        samples = {}
        for shard in sorted(out.glob("*.tar")):
            with tarfile.open(shard) as tar:
                for member in tar.getmembers():
                    key, _, extension = member.name.partition(".")
                    assert extension not in samples.setdefault(key, {})
                    samples[key][extension] = tar.extractfile(member).read()
        return samples

    def test_scene_flow_leads_from_depth_to_the_other_frames(self):
        samples = self.samples(self.gather(*WEBDATASET, datasets=[self.moving]))
        self.assertEqual(len(samples), 12)
        about = {key: json.loads(sample["json"]) for key, sample in samples.items()}
        for key, sample in samples.items():
            name, _, frame = key.rpartition("_")
            for distance in [1, 3]:
                extension = f"scene_flow_{distance}.exr"
                other = f"{name}_{int(frame) + distance:06}"
                self.assertEqual(extension in sample, other in samples)
                if other not in samples:
                    continue
                flow = decoded(sample[extension])[:, :, ::-1]
                depth = decoded(sample["depth.png"]) * 0.001
                lens = about[key]["intrinsics"]
                height, width = depth.shape
                x, y = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
                here = np.dstack([(x - lens["cx"]) / lens["fx"] * depth,
                                  (y - lens["cy"]) / lens["fy"] * depth, depth])
                world = (here @ rotation(about[key]["quaternion_xyzw"]).T
                         + about[key]["position"])
                there = ((world - about[other]["position"])
                         @ rotation(about[other]["quaternion_xyzw"]))
                seen = depth > 0
                self.assertGreater(seen.mean(), 0.9)
                # Depth is rounded to mm; no object moves.
                np.testing.assert_allclose(flow[seen], (there - here)[seen], atol=0.005)
                self.assertGreater(np.abs(flow[seen]).max(), 0.05)

    def test_tracks_are_where_the_frames_show_their_points(self):
        out = self.gather(*WEBDATASET, "--split", "by-room", "50/50", datasets=[self.moving])
        samples = self.samples(out)
        self.assertFalse(any("npy" in extension for sample in samples.values()
                             for extension in sample))
        parts = {one["name"]: one["part"] for one in self.card(out)["sources"]}
        self.assertEqual(len(set(parts.values())), 2)
        for name, part in parts.items():
            arrays = {path.stem.removeprefix(f"{name}_000000_"): np.load(path)
                      for path in (out / "tracks" / part).glob(f"{name}_*.npy")}
            self.assertEqual(set(arrays), {"points", "points_3d", "occluded", "query_points",
                                           "object_ids"})
            self.assertGreater(len(arrays["points"]), 100)
            for frame in range(6):
                about = json.loads(samples[f"{name}_{frame:06}"]["json"])
                lens = about["intrinsics"]
                x, y, z = ((arrays["points_3d"][:, frame] - about["position"])
                           @ rotation(about["quaternion_xyzw"])).T
                visible = ~arrays["occluded"][:, frame]
                self.assertGreater(visible.sum(), 50)
                shown = np.stack([x / z * lens["fx"] + lens["cx"],
                                  y / z * lens["fy"] + lens["cy"]], axis=1)
                np.testing.assert_allclose(arrays["points"][visible, frame], shown[visible],
                                           atol=0.01)

    def test_motion_that_a_dataset_lacks_or_a_layout_cannot_hold_is_left_out(self):
        for arguments, datasets, words in [
                (WEBDATASET, [self.moving, self.datasets / "room_0"],
                 ["scene_flow is left out", "tracks is left out", "room_0 has none"]),
                (["--format", "parquet"], [self.moving], ["no place for them: scene_flow, tracks"]),
                (["--format", "coco"], [self.moving], ["no place for them: scene_flow, tracks"])]:
            out = self.new_folder()
            done = run("gather", *datasets, "--out", out, *arguments)
            self.assertEqual(done.returncode, 0, done.stderr)
            for word in words:
                self.assertIn(word, done.stderr)
            self.assertFalse((out / "tracks").exists())
            for sample in self.samples(out).values():
                self.assertFalse(any("flow" in extension for extension in sample))

    def test_damaged_motion_is_found_and_a_resumed_run_has_the_same_bytes(self):
        whole = self.gather(*WEBDATASET, datasets=[self.moving])
        for name in ["scene_flow/000004_000005.exr", "tracks/000000_occluded.npy"]:
            copy = self.folder / pathlib.Path(name).stem
            shutil.copytree(self.moving, copy)
            path = copy / "clip_1" / name
            right = path.read_bytes()
            out = self.new_folder()
            command = ["-q", "gather", copy, "--out", out, *WEBDATASET]
            path.write_bytes(right[:-1] + bytes([right[-1] ^ 1]))
            self.assertFails(run(*command), 4, str(path), "damaged")
            path.unlink()
            self.assertFails(run(*command), 4, name, "missing")
            path.write_bytes(right)
            done = run(*command, "--resume")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(hashes(out), hashes(whole))
            self.assertTrue(any(name.startswith("tracks/train/") for name in hashes(out)))


if __name__ == "__main__":
    unittest.main()
