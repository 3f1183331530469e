"""Blender imports trajectory.glb: its camera has the poses of the frames."""
import json
import pathlib
import tempfile
import unittest

import numpy as np

import exports

SCRIPT = pathlib.Path(__file__).with_name("blender_camera.py")


class Blender(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        exports.need_program("blender", "blender")
        cls.data = exports.walk()
        cls.indices = [0, 3, 8, 21, 33, len(cls.data.frames) - 1]
        times = [cls.data.frames[i]["time_s"] for i in cls.indices]
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "seen.json"
            log = exports.call("blender", "-b", "--factory-startup", "--python", SCRIPT, "--",
                               cls.data.folder / "trajectory.glb", out, cls.data.width,
                               cls.data.height, *times)
            assert out.exists(), log
            cls.seen = json.loads(out.read_text())

    def test_the_camera_is_at_the_frames_poses(self):
        for i, found in zip(self.indices, self.seen["poses"]):
            expected = self.data.pose(i) @ np.diag([1, -1, -1, 1])  # its cameras look along -z
            self.assertLess(np.abs(expected - np.array(found)).max(), 1e-4, i)

    def test_it_has_our_lens(self):
        projection = np.array(self.seen["projection"])
        self.assertAlmostEqual(projection[0][0], 2 * self.data.fx / self.data.width, places=5)
        self.assertAlmostEqual(projection[1][1], 2 * self.data.fy / self.data.height, places=5)

    def test_every_object_is_where_it_is(self):
        objects = {entry["id"]: entry for entry in self.data.card["objects"]}
        self.assertEqual(set(map(int, self.seen["boxes"])), set(objects))
        for number, (low, high) in self.seen["boxes"].items():
            box = objects[int(number)]["box"]
            centre = (np.array(low) + high) / 2
            self.assertLess(abs(centre[2] - box["center"][2]), 2e-4, objects[int(number)])
            if box["yaw_rad"] == 0:
                self.assertLess(np.abs(centre - box["center"]).max(), 2e-4)
                self.assertLess(np.abs(np.subtract(high, low) - box["size"]).max(), 4e-4)
