"""Exports path-traced images and their layers of light: traced_test.py PROGRAM."""
import json
import os
import shutil
import unittest

os.environ["OPENCV_IO_ENABLE_OPENEXR"] = "1"  # read when OpenCV is loaded

import cv2  # noqa: E402
import numpy as np  # noqa: E402

from support import small_export  # noqa: E402
from support.program import FolderCase, hashes, run  # noqa: E402

LAYERS = ["hdr", "diffuse_reflectance", "diffuse_illumination", "direct_illumination",
          "indirect_illumination", "residual"]


def ssim(one, other):
    """Structural similarity of the luma (Wang et al. 2004)."""
    a, b = (cv2.cvtColor(image, cv2.COLOR_BGR2GRAY).astype(float) for image in (one, other))

    def mean(image):
        return cv2.GaussianBlur(image, (11, 11), 1.5)
    c1, c2 = (0.01 * 255) ** 2, (0.03 * 255) ** 2
    mean_a, mean_b = mean(a), mean(b)
    variance_a, variance_b = mean(a * a) - mean_a ** 2, mean(b * b) - mean_b ** 2
    covariance = mean(a * b) - mean_a * mean_b
    return float(np.mean((2 * mean_a * mean_b + c1) * (2 * covariance + c2) /
                         ((mean_a ** 2 + mean_b ** 2 + c1) * (variance_a + variance_b + c2))))


def light(dataset, layer, frame=0):
    """A layer as linear RGB."""
    image = cv2.imread(str(dataset / layer / f"{frame:06}.exr"),
                       cv2.IMREAD_ANYCOLOR | cv2.IMREAD_ANYDEPTH)
    return image[:, :, ::-1].astype(np.float64)


def picture(dataset, frame=0):
    return cv2.imread(str(dataset / "rgb" / f"{frame:06}.png"))


class TracedTest(FolderCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.project = small_export.plan(cls.folder, 3)
        cls.traced = cls.folder / "traced"
        cls.export(cls.traced, "traced", ["rgb", "instance", "roughness", "metallic", *LAYERS])

    @classmethod
    def export(cls, out, mode, modalities, *more):
        result = run("-q", "export", cls.project, "--out", out, "--modalities",
                     ",".join(modalities), "--formats", "camera_json", "--set",
                     f"render_mode={mode}", *more)
        assert result.returncode == 0, result.stderr
        return out

    def checks(self, dataset):
        result = run("-q", "verify", dataset, "--json")
        return {one["check"]: one["status"] for one in json.loads(result.stdout)["checks"]}

    def test_the_layers_add_up_to_the_light_and_the_light_gives_the_image(self):
        for frame in range(3):
            hdr, reflectance, illumination, direct, indirect, residual = (
                light(self.traced, layer, frame) for layer in LAYERS)
            self.assertLess(np.abs(reflectance * illumination + residual - hdr).max(), 1 / 1024)
            self.assertLess((np.abs(direct + indirect - illumination) /
                             (1 + illumination)).max(), 1 / 1024)
            self.assertGreater(illumination.mean(), 0.1)
            self.assertLessEqual(reflectance.max(), 1.0)
            above = np.maximum(hdr - 0.55, 0)
            shown = np.minimum(hdr, 0.55) + 0.45 * above / (above + 0.45)
            encoded = np.where(shown <= 0.0031308, 12.92 * shown,
                               1.055 * np.clip(shown, 0.0031308, 1) ** (1 / 2.4) - 0.055)
            rgb = picture(self.traced, frame)[:, :, ::-1]
            self.assertLessEqual(np.abs(255 * encoded - rgb).max(), 1.01)

    def test_denoising_comes_nearer_to_many_samples(self):
        size = ["--range", "0:1"]
        many = self.export(self.folder / "many", "reference", ["rgb"], *size, "--set",
                           "reference_samples=1024")
        few = self.export(self.folder / "few", "reference", ["rgb"], *size, "--set",
                          "reference_samples=16")
        drawn = self.export(self.folder / "drawn", "fast", ["rgb"], *size)
        right = picture(many)
        traced = ssim(picture(self.traced), right)
        self.assertGreater(traced, 0.95)
        self.assertLess(ssim(picture(few), right), traced)
        self.assertLess(ssim(picture(drawn), right), traced)

    def test_verify_finds_damaged_layers_and_materials(self):
        found = self.checks(self.traced)
        self.assertEqual((found["light"], found["materials"]), ("passed", "passed"))
        self.assertNotIn("failed", found.values())

        def scaled(name, factor, check):
            copy = self.folder / "damaged"
            shutil.rmtree(copy, ignore_errors=True)
            shutil.copytree(self.traced, copy)
            file = copy / name
            if file.suffix == ".png":
                image = cv2.imread(str(file), cv2.IMREAD_UNCHANGED)
                cv2.imwrite(str(file), np.clip(image * factor, 0, 255).astype(np.uint8))
            else:
                image = cv2.imread(str(file), cv2.IMREAD_ANYCOLOR | cv2.IMREAD_ANYDEPTH)
                cv2.imwrite(str(file), (image * factor).astype(np.float32),
                            [cv2.IMWRITE_EXR_TYPE, cv2.IMWRITE_EXR_TYPE_HALF])
            self.assertEqual(self.checks(copy)[check], "failed", name)
        for layer in LAYERS:
            scaled(f"{layer}/000001.exr", 1.5, "light")
        scaled("rgb/000001.png", 0.95, "light")
        scaled("roughness/000001.png", 0.8, "materials")

    def test_the_same_bytes_on_one_thread(self):
        again = self.export(self.folder / "again", "traced",
                            ["rgb", "instance", "roughness", "metallic", *LAYERS], "--threads", 1)
        self.assertEqual(hashes(again), hashes(self.traced))

    def test_layers_need_path_traced_images(self):
        for mode, modalities, code in [("fast", "hdr", 2), ("reference", "hdr,residual", 0)]:
            out = self.folder / f"layers_{mode}"
            result = run("-q", "export", self.project, "--out", out, "--modalities", modalities,
                         "--range", "0:1", "--set", f"render_mode={mode}", "--set",
                         "reference_samples=2")
            self.assertEqual(result.returncode, code, result.stderr)
            self.assertEqual(out.exists(), code == 0)
        self.assertFails(run("export", self.project, "--out", self.folder / "no", "--modalities",
                             "hdr", "--set", "render_mode=fast"), 2, "render_mode=traced")

    def test_all_cameras_and_sensors_can_be_traced(self):
        out = self.export(self.folder / "all", "traced", ["all"], "--range", "0:1", "--set",
                          "traced_samples=2", "--set", "looks=2", "--camera",
                          "back:yaw_deg=180,lens=fisheye,fov_deg=160,width_px=48,height_px=48")
        self.assertNotIn("failed", self.checks(out).values())


if __name__ == "__main__":
    unittest.main(argv=["traced_test.py"])
