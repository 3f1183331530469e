"""Exports camera rigs and reads them with other libraries: cameras_test.py PROGRAM SCHEMA.

OpenCV's fisheye module gives the rays of pixels, which must end on the surfaces of the tiny room's
boxes.
"""
import json
import pathlib
import sys
import unittest

import cv2
import jsonschema
import numpy as np

from support import tiny_room
from support.program import FolderCase, hashes, run

SCHEMA = json.loads(pathlib.Path(sys.argv.pop(1)).read_text())

RIG = {"format": "dollytrack-rig", "version": 1, "cameras": [
    {"name": "bent", "lens": "fisheye", "width_px": 200, "height_px": 160, "fov_deg": 160,
     "k1": 0.03, "k2": -0.006, "k3": 0.001, "k4": -0.0001, "right_m": 0.06, "yaw_deg": 35,
     "pitch_deg": -10, "roll_deg": 5},
    {"name": "even", "lens": "fisheye", "width_px": 160, "height_px": 160, "fov_deg": 170,
     "forward_m": -0.05},
    {"name": "around", "lens": "equirectangular", "width_px": 160, "height_px": 80, "level": True},
    {"name": "plan", "lens": "orthographic", "width_px": 120, "height_px": 80, "px_per_m": 40},
]}


def read(path):
    image = cv2.imread(str(path), cv2.IMREAD_UNCHANGED)
    assert image is not None, path
    return image


def rotation(quaternion):
    x, y, z, w = quaternion
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def off_surface(box, points):
    """Distance of points from the surface of an upright box."""
    c, s = np.cos(box["yaw_rad"]), np.sin(box["yaw_rad"])
    local = (points - np.array(box["center"])) @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    beyond = np.abs(local) - np.array(box["size"]) / 2
    outside = np.linalg.norm(np.maximum(beyond, 0), axis=1)
    return np.where(outside > 0, outside, np.abs(beyond.max(axis=1)))


class CamerasTest(FolderCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        tiny_room.write(cls.folder / "room.obj")
        plan = run("plan", cls.folder / "room.obj", "-o", cls.folder / "room.dolly",
                   "--set", "width_px=96", "--set", "height_px=72", "--max-frames", 4)
        assert plan.returncode == 0, plan.stderr
        (cls.folder / "rig.json").write_text(json.dumps(RIG))
        cls.dataset = cls.folder / "dataset"
        export = cls.export(cls.dataset, "--rig", cls.folder / "rig.json")
        assert export.returncode == 0, export.stderr
        cls.card = json.loads((cls.dataset / "dataset.json").read_text())

    @classmethod
    def export(cls, out, *arguments):
        return run("export", cls.folder / "room.dolly", "--out", out, *arguments)

    def camera(self, name):
        return next(one for one in self.card["cameras"] if one["name"] == name)

    def surface_by_opencv(self, name, frame, half_a_pixel=0.5):
        """Distance between the points that pixels show and the boxes of their objects."""
        camera = self.camera(name)
        lens = camera["intrinsics"]
        folder = self.dataset / "cameras" / name
        depth = read(folder / "depth" / f"{frame:06}.png") * 0.001
        ids = read(folder / "instance" / f"{frame:06}.png")
        rows, columns = np.nonzero(ids)
        # OpenCV counts pixels from their centres.
        k = np.array([[lens["f"], 0, lens["cx"] - half_a_pixel],
                      [0, lens["f"], lens["cy"] - half_a_pixel], [0, 0, 1.0]])
        d = np.array([lens["k1"], lens["k2"], lens["k3"], lens["k4"]])
        pixels = np.stack([columns, rows], axis=1).astype(float)
        flat = cv2.fisheye.undistortPoints(pixels[:, None], k, d)[:, 0]
        rays = np.concatenate([flat, np.ones((len(flat), 1))], axis=1)
        rays /= np.linalg.norm(rays, axis=1)[:, None]
        in_camera = rays * depth[rows, columns][:, None]
        # Projecting the ray back must give the same pixel.
        again, _ = cv2.fisheye.projectPoints(in_camera[:, None], np.zeros(3), np.zeros(3), k, d)
        self.assertLess(np.abs(again[:, 0] - pixels).max(), 0.01)
        pose = camera["poses"][frame]
        points = in_camera @ rotation(pose["quaternion_xyzw"]).T + np.array(pose["position"])
        off = np.zeros(len(points))
        for thing in self.card["objects"]:
            of_it = ids[rows, columns] == thing["id"]
            if of_it.any():
                off[of_it] = off_surface(thing["box"], points[of_it])
        return off

    def test_opencv_finds_every_pixel_on_the_things_it_shows(self):
        for name in ("bent", "even"):
            for frame in range(len(self.card["frames"])):
                off = self.surface_by_opencv(name, frame)
                self.assertGreater(len(off), 15000)
                self.assertLess(off.max(), 0.002, (name, frame))
                # Half a pixel off it would not, so this checks the convention for pixel centres.
                self.assertGreater(self.surface_by_opencv(name, frame, 0.0).max(), 0.004)

    def test_the_dataset_is_sound(self):
        report = run("-q", "verify", self.dataset, "--json")
        self.assertEqual(report.returncode, 0, report.stdout)
        checks = {one["check"]: one["status"] for one in json.loads(report.stdout)["checks"]}
        self.assertEqual(checks["cameras"], "passed")

    def test_resume_ends_with_the_same_bytes_and_another_rig_is_refused(self):
        out = self.folder / "resumed"
        self.assertEqual(self.export(out, "--rig", self.folder / "rig.json").returncode, 0)
        self.assertEqual(hashes(out), hashes(self.dataset))
        (out / "cameras/around/rgb/000001.png").write_bytes(b"")
        self.assertFails(self.export(out, "--rig", self.folder / "rig.json", "--resume",
                                     "--camera", "more"), 2, "cameras")
        self.assertFails(self.export(out, "--rig", self.folder / "rig.json", "--resume"), 4,
                         "around/rgb/000001.png")
        for threads in (1, 2):
            again = self.folder / f"threads{threads}"
            result = run("export", self.folder / "room.dolly", "--out", again, "--threads",
                         threads, "--rig", self.folder / "rig.json")
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(hashes(again), hashes(self.dataset))

    def test_the_schema_says_what_the_program_reads(self):
        jsonschema.validate(RIG, SCHEMA)
        for camera in [{"name": "a", "fov": 90}, {"name": "a", "lens": "bottle"}, {"name": "a/b"},
                       {"name": "a", "lens": "orthographic", "fov_deg": 90}, {"lens": "fisheye"},
                       {"name": "a", "fov_deg": 170}]:
            rig = dict(RIG, cameras=[camera])
            with self.subTest(camera), self.assertRaises(jsonschema.ValidationError):
                jsonschema.validate(rig, SCHEMA)
            (self.folder / "wrong.json").write_text(json.dumps(rig))
            self.assertFails(self.export(self.folder / "no", "--rig", self.folder / "wrong.json"),
                             4, "wrong.json", "cameras[0]")
            self.assertFalse((self.folder / "no").exists())

    def test_what_cannot_be_is_said_in_a_sentence(self):
        out = self.folder / "no"
        self.assertFails(self.export(out, "--modalities", "cameras"), 2, "--rig")
        self.assertFails(self.export(out, "--camera", "a:fov=9"), 2, "fov_deg")
        self.assertFails(self.export(out, "--camera", "a", "--camera", "a"), 2, "same name")
        self.assertFails(self.export(out, "--rig", self.folder / "none.json"), 4, "none.json")
        many = [word for i in range(65) for word in ("--camera", f"a{i}")]
        self.assertFails(self.export(out, *many), 2, "up to 64 cameras")
        # The sides of the cube map would exceed every driver's limit: an error before anything is
        # deleted.
        self.assertEqual(self.export(out, "--range", "0:1").returncode, 0)
        large = "a:lens=fisheye,width_px=4096,height_px=4096,fov_deg=220,k1=10,k2=10,k3=10,k4=10"
        self.assertFails(self.export(out, "--range", "0:1", "--overwrite", "--camera", large), 2,
                         "have to be rendered")
        self.assertTrue((out / "dataset.json").exists(), "the dataset before is as it was")

    def test_a_camera_that_is_the_planned_one_again_is_warned_of(self):
        for camera, again in [("a:width_px=96,height_px=72", True), ("a", False),
                              ("a:width_px=96,height_px=72,yaw_deg=360", True),
                              ("a:width_px=96,height_px=72,yaw_deg=1", False),
                              ("a:width_px=96,height_px=72,right_m=0.1", False),
                              ("a:width_px=96,height_px=72,level=true", False),
                              ("a:width_px=96,height_px=72,fov_deg=61", False)]:
            out = self.folder / "again"
            result = self.export(out, "--range", "0:1", "--overwrite", "--camera", camera)
            self.assertEqual(result.returncode, 0, result.stderr)
            with self.subTest(camera):
                self.assertEqual("duplicates the planned camera" in result.stderr, again)
                same = ((out / "rgb/000000.png").read_bytes() ==
                        (out / "cameras/a/rgb/000000.png").read_bytes())
                self.assertEqual(same, again)

    def test_a_camera_in_a_wall_is_warned_of(self):
        result = self.export(self.folder / "walled", "--modalities", "instance",
                             "--camera", "far:width_px=16,height_px=16,forward_m=9")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("camera 'far' of the rig is inside or behind an object", result.stderr)
        result = self.export(self.folder / "free", "--modalities", "instance",
                             "--camera", "near:width_px=16,height_px=16")
        self.assertNotIn("of the rig", result.stderr)

    # Path tracing with a wide lens: the same objects in about the same light, and black around the
    # image circle.
    def test_path_traced_pictures_are_of_the_same_lens(self):
        out = self.folder / "traced"
        result = self.export(out, "--range", "0:1", "--set", "render_mode=reference",
                             "--set", "reference_samples=64", "--rig",
                             self.folder / "rig.json")
        self.assertEqual(result.returncode, 0, result.stderr)
        for name in ("bent", "even", "around", "plan"):
            traced = read(out / "cameras" / name / "rgb/000000.png").astype(float)
            drawn = read(self.dataset / "cameras" / name / "rgb/000000.png").astype(float)
            if name in ("bent", "even"):  # the image circle
                dark = (traced.max(axis=2) == 0) == (drawn.max(axis=2) == 0)
                self.assertGreater(dark.mean(), 0.999, name)
            inside = drawn.max(axis=2) > 0
            inside &= inside[::-1]

            def alike(image):
                one, other = (cv2.blur(picture, (5, 5))[inside].ravel()
                              for picture in (traced, image))
                return np.corrcoef(one, other)[0, 1]
            self.assertGreater(alike(drawn), 0.7, name)
            self.assertLess(alike(drawn[::-1]), alike(drawn) - 0.05, name)


if __name__ == "__main__":
    unittest.main()
