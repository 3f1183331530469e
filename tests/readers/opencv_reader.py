"""OpenCV's RGB-D odometry recovers our poses from our images."""
import unittest

import numpy as np

import exports

MAX_ERROR_M, MAX_ERROR_DEG = 0.005, 0.2  # of the median step, about 17 mm long


class OpenCv(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        try:
            global cv2
            import cv2
        except ImportError:
            exports.missing("OpenCV", "python3-opencv")
        if not hasattr(cv2, "rgbd"):
            exports.missing("OpenCV's rgbd module", "python3-opencv")
        cls.data = exports.film()

    def frame(self, index):
        grey = cv2.imread(self.data.file("rgb", index), cv2.IMREAD_GRAYSCALE)
        depth = cv2.imread(self.data.file("depth", index), cv2.IMREAD_UNCHANGED) / np.float32(1000)
        depth[depth == 0] = np.nan
        return grey, depth.astype(np.float32), np.full(grey.shape, 255, np.uint8)

    def test_odometry_follows_our_poses(self):
        data = self.data
        lens = np.float32([[data.fx, 0, data.cx - 0.5], [0, data.fy, data.cy - 0.5], [0, 0, 1]])
        odometry = cv2.rgbd.RgbdOdometry_create(lens)
        moved, turned = [], []
        for i in range(len(data.frames) - 1):
            found, next_from_this = odometry.compute(*self.frame(i), *self.frame(i + 1))
            expected = np.linalg.inv(data.pose(i + 1)) @ data.pose(i)
            error = next_from_this @ np.linalg.inv(expected) if found else np.full((4, 4), np.inf)
            moved.append(np.linalg.norm(error[:3, 3]))
            turned.append(exports.angle_deg(error) if found else np.inf)
        print(f"\nOpenCV: a step is {1000 * np.median(moved):.1f} mm and "
              f"{np.median(turned):.2f} degrees off")
        # Where only a plain wall is visible, odometry cannot determine the motion along it.
        self.assertLess(np.median(moved), MAX_ERROR_M)
        self.assertLess(np.median(turned), MAX_ERROR_DEG)
