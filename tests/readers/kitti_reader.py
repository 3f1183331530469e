"""OpenCV's reader of KITTI's odometry finds our images, times, intrinsics and poses."""
import json
import pathlib
import tempfile
import unittest

import numpy as np

import exports


class KittiOdometry(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not exports.OPENCV_KITTI.exists():
            exports.missing("OpenCV's datasets module", "libopencv-contrib-dev")
        cls.data = exports.walk()
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            sequence = root / "sequences" / "00"
            for path in [sequence / "velodyne", root / "poses"]:
                path.mkdir(parents=True)
            for name in ["image_0", "image_2"]:
                (sequence / name).symlink_to(cls.data.folder / "rgb")
            for name in ["image_1", "image_3"]:
                (sequence / name).symlink_to(cls.data.folder / "rgb_right")
            for name in ["calib.txt", "times.txt"]:
                (sequence / name).symlink_to(cls.data.folder / name)
            (root / "poses" / "00.txt").symlink_to(cls.data.folder / "poses.txt")
            (cls.sequence,) = json.loads(exports.call(exports.OPENCV_KITTI, f"{root}/"))

    def test_pictures_and_times(self):
        names = [f"{i:06d}.png" for i in range(len(self.data.frames))]
        for images in self.sequence["images"]:
            self.assertEqual(sorted(images), names)
        expected = [frame["time_s"] for frame in self.data.frames]
        np.testing.assert_allclose(self.sequence["times"], expected, atol=1e-6)

    def test_poses_lead_into_the_first_camera(self):
        first = np.linalg.inv(self.data.pose(0))
        self.assertEqual(len(self.sequence["poses"]), len(self.data.frames))
        moved = 0.0
        for i, row in enumerate(self.sequence["poses"]):
            expected = first @ self.data.pose(i)
            np.testing.assert_allclose(np.reshape(row, (3, 4)), expected[:3], atol=1e-6)
            moved = max(moved, np.linalg.norm(expected[:3, 3]))
        self.assertGreater(moved, 1.0)  # otherwise an empty walk would pass

    def test_projections_find_a_pixel_in_both_pictures(self):
        """The point given by a pixel's depth projects by P2 onto the pixel, and by P3 into the
        right image, as far to the left as the disparity says."""
        import cv2
        data, checked = self.data, 0
        left, right = (np.reshape(self.sequence["projections"][i], (3, 4)) for i in (2, 3))
        for i in range(0, len(data.frames), 7):
            depth = cv2.imread(data.file("depth", i), cv2.IMREAD_UNCHANGED) / 1000.0
            disparity = cv2.imread(data.file("disparity", i), cv2.IMREAD_UNCHANGED) / 256.0
            for v, u in [(120, 200), (240, 320), (300, 500)]:
                if depth[v, u] == 0 or disparity[v, u] == 0:
                    continue
                place = depth[v, u] * np.array([(u + 0.5 - data.cx) / data.fx,
                                                (v + 0.5 - data.cy) / data.fy, 1])
                # Depth is in integer millimetres.
                off = 0.01 + 0.0006 * disparity[v, u] / depth[v, u]
                for matrix, column in [(left, u), (right, u - disparity[v, u])]:
                    seen = matrix @ np.append(place, 1)
                    np.testing.assert_allclose(seen[:2] / seen[2], [column, v],
                                               rtol=0, atol=off)
                checked += 1
        self.assertGreater(checked, 10)
