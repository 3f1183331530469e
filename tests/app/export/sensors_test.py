"""Exports images and data of simulated real sensors: sensors_test.py PROGRAM."""
import json
import re
import unittest

import cv2
import numpy as np
import yaml

from support import small_export
from support.program import FolderCase, hashes, run, start, wait_for

SENSORS = ["--modalities", "rgb,depth,rgb_sensor,depth_sensor", "--formats",
           "calibration,colmap,nerfstudio"]


class SensorsTest(FolderCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.project = small_export.plan(cls.folder, 6)
        cls.count = 0

    def export(self, *settings, modalities=SENSORS, more=()):
        SensorsTest.count += 1
        out = self.folder / f"out_{self.count}"
        result = run("-q", "export", self.project, "--out", out, *modalities,
                     *[word for one in settings for word in ("--set", one)], *more)
        self.assertEqual(result.returncode, 0, result.stderr)
        return out

    def files(self, out, *folders):
        return {name: value for name, value in hashes(out).items()
                if name.split("/")[0] in folders}

    def test_clean_files_stay_as_they_are(self):
        clean = self.export(modalities=["--modalities", "rgb,depth", "--formats", "colmap"])
        with_sensor = self.export("sensor_preset=webcam")
        for folder in ("rgb", "depth"):
            self.assertEqual(self.files(clean, folder), self.files(with_sensor, folder))
        self.assertNotIn("sensor", json.loads((clean / "dataset.json").read_text())["parameters"])

    def test_a_presets_lens_is_scaled_to_a_wide_picture_and_recorded_so(self):
        def lens(*settings):
            out = self.export("sensor_preset=action_camera", "looks=1", *settings,
                              more=["--range", "0:1"])
            card = json.loads((out / "dataset.json").read_text())
            said = card["conventions"]["rgb_sensor"]["distortion"]
            text = (out / "calibration.yaml").read_text().split("---", 1)[-1]
            data = re.search(r"distortion_coefficients.*?data: *\[(.*?)\]", text, re.S).group(1)
            numbers = [float(number) for number in data.split(",")]
            verified = run("-q", "verify", out)
            self.assertEqual(verified.returncode, 0, verified.stdout)
            for i, name in enumerate(["k1", "k2", "p1", "p2", "k3"]):
                self.assertAlmostEqual(numbers[i], said[name], places=9)
                self.assertEqual(card["parameters"]["sensor"][name], said[name])
            return said["k1"], said["k2"]

        camera = ["width_px=160", "height_px=120", "near_m=0.01"]
        self.assertEqual(lens(*camera, "hfov_deg=60"), (-0.26, 0.09))
        squeeze = (np.tan(np.radians(30)) / np.tan(np.radians(60))) ** 2
        k1, k2 = lens(*camera, "hfov_deg=120")
        self.assertAlmostEqual(k1, -0.26 * squeeze, places=9)
        self.assertAlmostEqual(k2, 0.09 * squeeze ** 2, places=9)
        self.assertEqual(lens(*camera, "hfov_deg=120", "k1=-0.2"), (-0.2, 0.09))

    def test_the_same_bytes_with_one_thread_with_two_and_continued(self):
        rolling = ["readout_s=0.02", "looks=64"]
        whole = self.export(*rolling, more=["--threads", "1"])
        self.assertEqual(hashes(whole), hashes(self.export(*rolling, more=["--threads", "2"])))
        begun = self.folder / "begun"
        command = ["-q", "export", self.project, "--out", begun, *SENSORS, "--set", "looks=64"]
        process = start(*command, "--set", "readout_s=0.02")
        self.assertTrue(wait_for(lambda: process.poll() is not None or
                                 len(list(begun.glob("depth_sensor/*.png"))) > 1))
        process.kill()
        process.communicate()
        self.assertFalse((begun / "dataset.json").exists())
        self.assertFails(run(*command, "--set", "readout_s=0.03", "--resume"), 2, "the sensors")
        result = run(*command, "--set", "readout_s=0.02", "--resume")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(hashes(begun), hashes(whole))

    def test_a_part_of_the_frames_has_the_bytes_that_all_have(self):
        settings = ["shutter_s=0.05", "readout_s=0.02", "aperture_mm=20", "white_e=500"]
        formats = [*SENSORS[:3], "calibration,imu"]
        whole = self.export(*settings, modalities=formats)
        for part, of in ((slice(2, 5), "2:5"), (slice(1, 6, 2), "1::2")):
            out = self.export(*settings, modalities=formats, more=["--range", of])
            for i, source in enumerate(range(6)[part]):
                for name in ("rgb_sensor", "depth_sensor", "rgb"):
                    self.assertEqual((out / f"{name}/{i:06d}.png").read_bytes(),
                                     (whole / f"{name}/{source:06d}.png").read_bytes(), name)
            rows, all_rows = ((one / "imu.csv").read_text().splitlines()[1:]
                              for one in (out, whole))
            self.assertGreater(len(rows), 30)
            self.assertIn("\n".join(rows), "\n".join(all_rows), "no row is another")
            frames = json.loads((out / "dataset.json").read_text())["frames"]
            first, last = (round(1e9 * frames[i]["time_s"]) for i in (0, -1))
            self.assertLessEqual(int(rows[0].split(",")[0]), first)
            # The motion ends with the path, so there are no rows beyond it.
            self.assertGreaterEqual(int(rows[-1].split(",")[0]),
                                    last - 5e6 if of == "1::2" else last)
            verified = run("-q", "verify", out)
            self.assertEqual(verified.returncode, 0, verified.stdout)

    def test_another_seed_is_other_noise_of_the_same_amount(self):
        out = [self.export(f"sensor_seed={seed}", "shutter_s=0", "readout_s=0", "white_e=500")
               for seed in (1, 1, 2)]
        one, again, other = (self.files(folder, "rgb_sensor", "depth_sensor") for folder in out)
        self.assertEqual(one, again)
        self.assertFalse(set(one.values()) & set(other.values()))
        a, b, clean = (cv2.imread(str(folder / name / "000002.png")).astype(float) for folder, name
                       in ((out[0], "rgb_sensor"), (out[2], "rgb_sensor"), (out[0], "rgb")))
        self.assertAlmostEqual(np.std(a - clean) / np.std(b - clean), 1.0, delta=0.05)

    def test_every_setting_changes_the_pictures_it_should(self):
        # An ideal camera except for the given settings.
        base = ["sensor_preset=ideal", "depth_noise=none"]
        ideal = self.export(*base)
        rgb, depth = self.files(ideal, "rgb_sensor"), self.files(ideal, "depth_sensor")
        self.assertEqual(sorted(depth.values()), sorted(self.files(ideal, "depth").values()),
                         "a depth camera without noise delivers the depth")
        for setting in ["shutter_s=0.05", "readout_s=0.05", "looks=8", "aperture_mm=30", "k1=0.1",
                        "k2=0.1", "p1=0.01", "p2=0.01", "k3=0.1", "vignetting=1", "white_e=1000",
                        "jpeg_quality=80"]:
            with self.subTest(setting):
                out = self.export(*base, setting)
                found = self.files(out, "rgb_sensor")
                self.assertGreater(len(set(found.values()) - set(rgb.values())), 3)
                self.assertEqual(self.files(out, "depth_sensor"), depth)
        noisy = {}
        for setting in ["depth_noise=kinect_azure", "depth_noise=redwood"]:
            out = self.export("sensor_preset=ideal", setting)
            self.assertEqual(self.files(out, "rgb_sensor"), rgb)
            noisy[setting] = self.files(out, "depth_sensor")
        self.assertFalse(set(noisy["depth_noise=kinect_azure"].values())
                         & set(noisy["depth_noise=redwood"].values()))
        out = self.export("sensor_preset=ideal", "depth_noise=redwood", "depth_noise_strength=2")
        self.assertNotEqual(self.files(out, "depth_sensor"), noisy["depth_noise=redwood"])

    def test_opencv_and_yaml_read_the_calibration_which_undistorts(self):
        out = self.export("sensor_preset=ideal", "k1=-0.3", "k2=0.1", "p1=0.004")
        storage = cv2.FileStorage(str(out / "calibration.yaml"), cv2.FILE_STORAGE_READ)
        self.assertEqual(storage.getNode("image_width").real(), 64)
        self.assertEqual(storage.getNode("distortion_model").string(), "plumb_bob")
        matrix = storage.getNode("camera_matrix").mat()
        distortion = storage.getNode("distortion_coefficients").mat()
        self.assertEqual([round(one, 9) for one in distortion.ravel()], [-0.3, 0.1, 0.004, 0, 0])
        lens = json.loads((out / "dataset.json").read_text())["conventions"]["intrinsics"]
        self.assertAlmostEqual(matrix[0, 0], lens["fx"])
        self.assertAlmostEqual(matrix[0, 2], lens["cx"] - 0.5)
        with open(out / "calibration.yaml", encoding="utf-8") as file:
            plain = yaml.safe_load(file)
        for key, found in (("camera_matrix", matrix), ("distortion_coefficients", distortion),
                           ("projection_matrix", storage.getNode("projection_matrix").mat())):
            self.assertEqual((plain[key]["rows"], plain[key]["cols"]), found.shape)
            self.assertEqual(plain[key]["data"], found.ravel().tolist(), key)
        self.assertEqual(plain["camera_name"], storage.getNode("camera_name").string())
        maps = cv2.initUndistortRectifyMap(matrix, distortion, None, matrix, (64, 48), cv2.CV_32FC1)
        apart, apart_untouched = 0.0, 0.0
        for frame in range(6):
            bent = cv2.imread(str(out / f"rgb_sensor/{frame:06d}.png")).astype(np.float32)
            clean = cv2.imread(str(out / f"rgb/{frame:06d}.png")).astype(np.float32)
            straight = cv2.remap(bent, *maps, cv2.INTER_LINEAR)
            inside = np.s_[6:-6, 6:-6]
            apart += np.abs(straight - clean)[inside].mean()
            apart_untouched += np.abs(bent - clean)[inside].mean()
        self.assertLess(apart, 0.6 * apart_untouched,
                        "undistorted it is the clean picture but for its smaller details")

    def test_formats_have_the_lens_of_the_pictures_they_name(self):
        def lens(out):
            camera = (out / "sparse/0/cameras.txt").read_text().splitlines()[-1].split()
            transforms = json.loads((out / "transforms.json").read_text())
            return camera, transforms
        camera, transforms = lens(self.export("sensor_preset=action_camera"))
        self.assertEqual((camera[1], transforms["k1"]), ("PINHOLE", 0.0))
        out = self.export("sensor_preset=action_camera", "k3=-0.015", modalities=[
            "--modalities", "rgb_sensor,depth", *SENSORS[2:]])
        camera, transforms = lens(out)
        self.assertEqual(camera[1], "FULL_OPENCV")
        self.assertEqual([float(one) for one in camera[8:]], [-0.26, 0.09, 0, 0, -0.015, 0, 0, 0])
        self.assertEqual((transforms["k1"], transforms["k3"]), (-0.26, -0.015))
        self.assertEqual(transforms["frames"][0]["file_path"], "rgb_sensor/000000.jpg")
        self.assertNotIn("depth_file_path", transforms["frames"][0])
        verified = run("-q", "verify", out)
        self.assertEqual(verified.returncode, 0, verified.stdout)

    def test_what_presets_write_is_sound(self):
        for preset in ("ideal", "phone", "webcam", "action_camera", "machine_vision"):
            for model in ("kinect_azure", "redwood"):
                with self.subTest(preset=preset, model=model):
                    out = self.export(f"sensor_preset={preset}", f"depth_noise={model}")
                    verified = run("-q", "verify", out)
                    self.assertEqual(verified.returncode, 0, verified.stdout)

    def test_path_traced_pictures_go_through_the_same_lens(self):
        traced = ["--set", "render_mode=reference", "--set", "reference_samples=16",
                  "--range", "0:2"]
        told = run("export", self.project, "--out", self.folder / "told", *SENSORS, *traced,
                   "--set", "looks=1")
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertIn("moving objects", told.stderr)
        out = self.export("sensor_preset=ideal", "k1=-0.25", "shutter_s=0.05", "looks=4",
                          more=[*traced, "--still"])
        drawn = self.export("sensor_preset=ideal", "k1=-0.25", "shutter_s=0.05", more=["--still"])
        a, b, clean = (cv2.imread(str(folder / name / "000001.png")).astype(float).ravel()
                       for folder, name in ((out, "rgb_sensor"), (drawn, "rgb_sensor"),
                                            (drawn, "rgb")))
        self.assertGreater(np.corrcoef(a, b)[0, 1], 0.9)
        self.assertGreater(np.corrcoef(a, b)[0, 1], np.corrcoef(a, clean)[0, 1])

    def test_a_lens_that_folds_over_in_its_picture_is_refused_with_what_to_change(self):
        def export(name, k1, fov):
            return run("-q", "export", self.project, "--out", self.folder / name, *SENSORS,
                       "--range", "0:1", "--set", "sensor_preset=ideal", "--set", f"k1={k1}",
                       "--set", f"hfov_deg={fov}")
        refused = export("folded", -0.3, 90)
        self.assertFails(refused, 2, "k1 -0.3", "hfov_deg from 90 to ")
        self.assertFalse((self.folder / "folded").exists())
        narrower = int(re.search(r"from 90 to (\d+)", refused.stderr)[1])
        self.assertGreater(narrower, 45)
        self.assertFails(export("folded", -0.3, narrower + 1), 2, "maps two directions to one pixel")
        for name, k1, fov in (("narrower", -0.3, narrower), ("straighter", -0.05, 90)):
            made = export(name, k1, fov)
            self.assertEqual(made.returncode, 0, made.stderr)

    def test_how_long_a_row_is_exposed_is_said(self):
        # With a rolling shutter a row takes at least one sample's share of the readout.
        for shutter, readout, expected in ((0.02, 0.0, 0.02), (0.02, 0.032, 0.02),
                                           (0.001, 0.032, 0.032 / 16), (0.0, 0.0, 0.0)):
            out = self.export(f"shutter_s={shutter}", f"readout_s={readout}",
                              more=["--range", "0:1"])
            said = json.loads((out / "dataset.json").read_text())["conventions"]["rgb_sensor"]
            self.assertAlmostEqual(said["exposure"]["row_exposure_s"], expected, places=12)
            verified = run("-q", "verify", out)
            self.assertEqual(verified.returncode, 0, verified.stdout)

    def test_boxes_are_told_to_belong_to_the_clean_pictures(self):
        def told(name, formats, *settings):
            made = run("export", self.project, "--out", self.folder / name, "--modalities",
                       "rgb,rgb_sensor", "--formats", formats, "--range", "0:1",
                       *[word for one in settings for word in ("--set", one)])
            self.assertEqual(made.returncode, 0, made.stderr)
            return re.search(r"boxes and masks of (.+) fit the clean images.* by up to "
                             r"(\S+) px", made.stderr)
        bent = told("bent", "coco,yolo,camera_json", "sensor_preset=action_camera")
        self.assertEqual(bent[1], "coco, yolo")
        # The corner's pixel of 64 x 48 at 60 degrees, bent by OpenCV, comes from so far outside.
        focal = 32 / np.tan(np.pi / 6)
        matrix = np.array([[focal, 0, 32], [0, focal, 24], [0, 0, 1]])
        straight = cv2.undistortPoints(np.array([[[0.5, 0.5]]]), matrix,
                                       np.array([-0.26, 0.09, 0, 0, 0]), P=matrix)[0, 0]
        self.assertAlmostEqual(float(bent[2]), np.linalg.norm(straight - 0.5), delta=0.1)
        self.assertIsNone(told("poses", "camera_json", "sensor_preset=action_camera"))
        self.assertIsNone(told("straight", "coco,yolo", "sensor_preset=ideal"))

    def test_presets_go_with_the_widest_field_of_view(self):
        for preset in ("phone", "webcam", "action_camera", "machine_vision"):
            out = self.folder / f"wide_{preset}"
            made = run("-q", "export", self.project, "--out", out, *SENSORS, "--range", "0:1",
                       "--set", f"sensor_preset={preset}", "--set", "jpeg_quality=100",
                       "--set", "white_e=0", "--set", "vignetting=0", "--set", "hfov_deg=150",
                       "--set", "near_m=0.01")
            self.assertEqual(made.returncode, 0, made.stderr)
            picture = cv2.imread(str(out / "rgb_sensor/000000.png"))
            for corner in (picture[0, 0], picture[0, -1], picture[-1, 0], picture[-1, -1]):
                self.assertGreater(corner.max(), 0, "nothing is black")

    def test_what_is_set_beside_a_preset_counts_whichever_comes_first(self):
        said = []
        for settings in (("k1=-0.1", "sensor_preset=webcam"), ("sensor_preset=webcam", "k1=-0.1")):
            out = self.export(*settings, more=["--range", "0:1"])
            said.append(json.loads((out / "dataset.json").read_text())["parameters"]["sensor"])
        self.assertEqual(said[0], said[1])
        self.assertEqual((said[0]["k1"], said[0]["jpeg_quality"]), (-0.1, 75))

    def test_wrong_settings_are_refused_in_a_sentence(self):
        for words, setting in [(("shutter_s",), "shutter=0.1"), (("looks", "1024"), "looks=0"),
                               (("phone",), "sensor_preset=iphone"), (("k1", "number"), "k1=big")]:
            self.assertFails(run("-q", "export", self.project, "--out", self.folder / "no",
                                 *SENSORS, "--set", setting), 2, *words)
        self.assertFails(run("-q", "export", self.project, "--out", self.folder / "no",
                             "--modalities", "rgb", "--set", "looks=4"), 2, "rgb_sensor",
                         "--modalities")


if __name__ == "__main__":
    unittest.main()
