"""NumPy, h5py and OpenCV open the array files, whose values equal those of the images."""
import json
import unittest

import numpy as np

import exports


class Arrays(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        try:
            global cv2, h5py
            import cv2
            import h5py
        except ImportError as error:
            exports.missing(error.name, f"python3-{error.name}")
        cls.data = exports.walk()
        cls.index = 7

    def image(self, folder, ending=".png", index=None):
        path = self.data.file(folder, self.index if index is None else index, ending)
        image = cv2.imread(path, cv2.IMREAD_UNCHANGED)
        self.assertIsNotNone(image, path)
        return image

    def flow(self):
        return cv2.readOpticalFlow(str(self.data.folder / "flow_forward" /
                                       f"{self.index:06d}_{self.index + 1:06d}.flo"))

    def test_tum_depth_is_at_5000_a_metre(self):
        scale = self.data.card["conventions"]["tum"]["depth_per_m"]
        self.assertEqual(scale, 5000)
        error = self.image("depth_tum") / scale - self.image("depth") / 1000
        self.assertLess(np.abs(error).max(), 0.0007)

    def test_kitti_flow_and_disparity_hold_the_values(self):
        valid, v, u = cv2.split(self.image("kitti_flow"))
        flow = self.flow()
        known = valid == 1
        self.assertGreater(known.mean(), 0.5)
        for channel, values in ((0, u), (1, v)):
            error = (values[known].astype(float) - 32768) / 64 - flow[..., channel][known]
            self.assertLess(np.abs(error).max(), 0.5 / 64 + 1e-4)
        disparity = self.image("disparity") / 256
        depth = self.image("depth") / 1000
        baseline = self.data.card["conventions"]["disparity"].get("baseline_m", 0.1)
        seen = (disparity > 0) & (depth > 0)
        expected = self.data.fx * baseline / depth[seen]
        # Depth is rounded to half a millimetre, disparity to a 512th of a pixel.
        allowed = 0.6 / 256 + expected * 0.0006 / depth[seen]
        self.assertTrue((np.abs(disparity[seen] - expected) <= allowed).all())

    def test_scene_flow_leads_to_the_point_that_optical_flow_shows(self):
        exr = cv2.imread(str(self.data.folder / "scene_flow" /
                             f"{self.index:06d}_{self.index + 1:06d}.exr"), cv2.IMREAD_UNCHANGED)
        self.assertEqual(exr.dtype, np.float32)
        motion = exr[..., ::-1].astype(float)  # OpenCV gives blue, green, red
        flow = self.flow().astype(float)
        depth = self.image("depth") / 1000
        known = (depth > 0) & (np.abs(flow) < 1e9).all(axis=2)
        self.assertGreater(known.mean(), 0.5)
        k = self.data.card["conventions"]["intrinsics"]
        y, x = np.mgrid[:depth.shape[0], :depth.shape[1]] + 0.5
        ray = np.dstack(((x - k["cx"]) / k["fx"], (y - k["cy"]) / k["fy"], np.ones_like(depth)))
        there = ray * depth[..., None] + motion
        distance = there[..., 2]
        u = there[..., 0] / distance * k["fx"] + k["cx"] - x
        v = there[..., 1] / distance * k["fy"] + k["cy"] - y
        error = np.hypot(u - flow[..., 0], v - flow[..., 1])
        # Depth is rounded to whole millimetres, an error of up to 0.5 mm; the derivative of (u, v)
        # by depth converts it to pixels. Near surfaces have the largest errors.
        pixels_a_metre = np.hypot(k["fx"] * (ray[..., 0] * distance - there[..., 0]),
                                  k["fy"] * (ray[..., 1] * distance - there[..., 1])) / distance ** 2
        allowed = 0.0006 * pixels_a_metre + 0.02
        self.assertTrue((error <= allowed)[known].all(), (error - allowed)[known].max())
        self.assertLess(np.median((error / allowed)[known]), 0.5)

    def test_tracks_are_where_tap_vid_expects_them(self):
        def load(name):
            return np.load(self.data.folder / "tracks" / f"000000_{name}.npy")
        points, occluded, query = load("points"), load("occluded"), load("query_points")
        tracks, frames = occluded.shape
        self.assertEqual((points.shape, query.shape), ((tracks, frames, 2), (tracks, 3)))
        self.assertEqual(occluded.dtype, bool)
        self.assertEqual(frames, min(300, len(self.data.card["frames"])))
        chosen = query[:, 0].astype(int)
        self.assertLess(np.abs(points[np.arange(tracks), chosen] - query[:, :0:-1]).max(), 0.01)
        self.assertFalse(occluded[np.arange(tracks), chosen].any())
        height, width = self.image("depth").shape
        inside = ((points >= 0) & (points < (width, height))).all(axis=2)
        self.assertTrue(inside[~occluded].all())
        # The depth image shows the visible points.
        ids = load("object_ids")
        seen = ~occluded[:, self.index]
        at = points[seen, self.index].astype(int)
        pose = np.linalg.inv(self.data.pose(self.index))
        places = load("points_3d")[seen, self.index]
        z = (places @ pose[:3, :3].T + pose[:3, 3])[:, 2]
        depth = self.image("depth")[at[:, 1], at[:, 0]] / 1000
        same = self.image("instance")[at[:, 1], at[:, 0]] == ids[seen]
        self.assertGreater(same.mean(), 0.9)
        self.assertLess(np.median(np.abs(z - depth)[same]), 0.01)

    def test_tartanair_arrays(self):
        depth = np.load(self.data.file("depth_left", self.index, "_left_depth.npy"))
        self.assertEqual(depth.dtype, np.float32)
        millimetres = self.image("depth")
        self.assertLess(np.abs(depth * 1000 - millimetres)[millimetres > 0].max(), 0.51)
        classes = np.load(self.data.file("seg_left", self.index, "_left_seg.npy"))
        self.assertTrue((classes == self.image("semantic")).all())
        pair = f"{self.index:06d}_{self.index + 1:06d}"
        self.assertTrue((np.load(self.data.folder / "flow" / f"{pair}_flow.npy") ==
                         self.flow()).all())
        mask = np.load(self.data.folder / "flow" / f"{pair}_mask.npy")
        self.assertTrue(set(np.unique(mask)) <= {0, 10, 100})
        self.assertTrue((self.image("image_left", "_left.png") == self.image("rgb")).all())

    def test_hdf5_holds_the_images_and_the_pose(self):
        with h5py.File(self.data.file("hdf5", self.index, ".hdf5")) as file:
            self.assertTrue((file["colors"][()] == self.image("rgb")[..., ::-1]).all())
            self.assertTrue((file["instance_segmaps"][()] == self.image("instance")).all())
            self.assertTrue((file["category_id_segmaps"][()] == self.image("semantic")).all())
            self.assertLess(np.abs(file["depth"][()] * 1000 - self.image("depth")).max(), 0.51)
            pose = np.array(json.loads(file["campose"][()]))
            names = json.loads(file["instance_attribute_maps"][()])
        self.assertLess(np.abs(pose - self.data.pose(self.index) @ np.diag([1, -1, -1, 1])).max(),
                        1e-9)
        self.assertEqual({entry["idx"] for entry in names},
                         set(map(int, np.unique(self.image("instance")))) - {0})

    def test_h5dump_reads_it(self):
        exports.need_program("h5dump", "hdf5-tools")
        text = exports.call("h5dump", "-H", self.data.file("hdf5", self.index, ".hdf5"))
        self.assertIn('DATASET "colors"', text)
