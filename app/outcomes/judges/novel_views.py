#!/usr/bin/python3
"""Novel views: fuses a planner's frames into a coloured surface and renders it from the test views.

Protocol, the same for every planner:
- Open3D's VoxelBlockGrid (a TSDF with colour), voxels of 2 cm (option `voxel_mm`), truncation at 4 voxels,
  depth up to 6 m (option `depth_limit_mm`), all frames in order with their true poses.
- Rendered by ray casting in the TSDF, one ray per pixel, at the `uniform` test views of the same scene, which are
  the same for all planners. (Open3D's RaycastingScene does not work in Debian 12.)
- PSNR and SSIM (Gaussian window, sigma 1.5, of grey values) count pixels where both the true frame and the
  rendering show a surface, and are means over the test frames with such pixels. `psnr_filled` and
  `ssim_filled` count all surface pixels of the true frame, missing ones as black, so that showing less
  is no advantage. An exact image has 100 dB.
- `missing` is the share of the true frames' surface pixels where nothing was fused, `depth_right` the share
  whose fused depth is within 5 cm of the true one.
"""
import math

from dataset import Dataset, judge_entries, mean, need, run

import cv2
import numpy as np

NAME = "novel_views"
DISTRIBUTION = "uniform"   # of the test views to render
OPTIONS = {"voxel_mm": 20, "depth_limit_mm": 6000}
BEST_PSNR = 100.0
TRUNCATION_VOXELS = 4.0
DEPTH_TOLERANCE_M = 0.05
METRICS = {
    "psnr": {"unit": "dB", "better": "higher"},
    "ssim": {"unit": "", "better": "higher"},
    "psnr_filled": {"unit": "dB", "better": "higher"},
    "ssim_filled": {"unit": "", "better": "higher"},
    "missing": {"unit": "%", "better": "lower"},
    "depth_right": {"unit": "%", "better": "higher"},
    "views": {"unit": "", "better": ""},
}


def psnr(first, second, mask):
    """PSNR of 8-bit images over the pixels of a mask, dB; None without pixels, 100 without an error."""
    if not mask.any():
        return None
    error = float(np.mean((first[mask].astype(float) - second[mask].astype(float)) ** 2))
    return BEST_PSNR if error == 0 else min(BEST_PSNR, 10 * np.log10(255.0 ** 2 / error))


def ssim(first, second, mask):
    """SSIM of 8-bit grey images over a mask; windows do not include pixels outside the mask."""
    if not mask.any():
        return None
    inside = mask.astype(float)

    def blur(image):
        return cv2.GaussianBlur(image, (11, 11), 1.5, borderType=cv2.BORDER_CONSTANT)

    share = np.maximum(blur(inside), 1e-9)
    x, y = first.astype(float) * inside, second.astype(float) * inside
    mean_x, mean_y = blur(x) / share, blur(y) / share
    variance_x, variance_y = blur(x * x) / share - mean_x ** 2, blur(y * y) / share - mean_y ** 2
    covariance = blur(x * y) / share - mean_x * mean_y
    c1, c2 = (0.01 * 255) ** 2, (0.03 * 255) ** 2
    similar = ((2 * mean_x * mean_y + c1) * (2 * covariance + c2)
               / ((mean_x ** 2 + mean_y ** 2 + c1) * (variance_x + variance_y + c2)))
    return float(similar[mask].mean())


class Surface:
    """A planner's frames fused into a coloured TSDF that can be rendered from any pose."""

    def __init__(self, data, options):
        self.o3d = o3d = need("open3d", "python3-open3d")
        self.core = core = o3d.core
        o3d.utility.set_verbosity_level(o3d.utility.VerbosityLevel.Error)
        self.limit_m = options["depth_limit_mm"] / 1000
        self.volume = o3d.t.geometry.VoxelBlockGrid(
            ("tsdf", "weight", "color"), (core.float32, core.uint16, core.uint16), ((1), (1), (3)),
            options["voxel_mm"] / 1000, 8, 1000)
        for index in range(len(data)):
            camera = self.camera(data, index)
            color, depth = (o3d.t.geometry.Image(core.Tensor(np.ascontiguousarray(image)))
                            for image in (data.rgb(index), self.millimetres(data.depth(index))))
            if not (depth.as_tensor().numpy() > 0).any():
                continue
            blocks = self.volume.compute_unique_block_coordinates(
                depth, *camera, 1000.0, self.limit_m, TRUNCATION_VOXELS)
            self.volume.integrate(blocks, depth, color, *camera, 1000.0, self.limit_m, TRUNCATION_VOXELS)
        table = self.volume.hashmap()
        self.blocks = table.key_tensor()[table.active_buf_indices().to(core.int64)]

    def millimetres(self, depth):
        """Depths in mm; 0 (unknown) beyond the limit, so that the space up to the limit is not fused as free."""
        return np.where(depth <= self.limit_m, np.rint(depth * 1000), 0).astype(np.uint16)

    def camera(self, data, index):
        return (self.core.Tensor(data.matrix(pixel_centres=True)),
                self.core.Tensor(np.linalg.inv(data.poses[index])))

    def draw(self, data, index):
        """Colours, and depths along the viewing axis, at a test frame's pixels; depth 0 where no surface is hit."""
        if len(self.blocks) == 0:
            return np.zeros((data.height, data.width, 3), np.uint8), np.zeros((data.height, data.width))
        coarse = math.gcd(8, math.gcd(data.width, data.height))
        for _ in range(2):   # a call whose buffer is too small enlarges it, but renders nothing
            drawn = self.volume.ray_cast(self.blocks, *self.camera(data, index), data.width, data.height,
                                         ["depth", "color"], 1.0, 0.05, 20.0, 1.0, TRUNCATION_VOXELS, coarse)
        color, depth = drawn["color"].numpy(), drawn["depth"].numpy()[..., 0]
        return np.clip(np.rint(color * 255), 0, 255).astype(np.uint8) * (depth > 0)[..., None], depth


def compare_view(true_image, true_depth, image, depth):
    """Values of one view; `image` is black and `depth` 0 where no surface was fused."""
    valid = true_depth > 0
    if not valid.any():
        return None
    both = valid & (depth > 0)
    gray = [cv2.cvtColor(one, cv2.COLOR_RGB2GRAY) for one in (true_image, image)]
    return {"psnr": psnr(true_image, image, both), "ssim": ssim(*gray, both),
            "psnr_filled": psnr(true_image, image, valid), "ssim_filled": ssim(*gray, valid),
            "missing": 1.0 - both.sum() / valid.sum(),
            "depth_right": (np.abs(depth - true_depth) <= DEPTH_TOLERANCE_M)[valid].mean()}


def measure(data, request, entry):
    tests = [one for one in request.get("tests", [])
             if one["distribution"] == DISTRIBUTION and one["scene"] == entry["scene"]]
    if not tests:
        raise ValueError("the scene has no uniform test views")
    surface = Surface(data, request["options"])
    views = []
    for test in tests:
        true = Dataset(test["dataset"])
        for index in range(len(true)):
            views.append(compare_view(true.rgb(index), true.depth(index), *surface.draw(true, index)))
    views = [view for view in views if view is not None]
    return {**{name: mean([view[name] for view in views]) for name in METRICS if name != "views"},
            "views": len(views)}


def check():
    found = need("open3d", "python3-open3d")
    return f"Open3D {found.__version__}, OpenCV {cv2.__version__}, NumPy {np.__version__}"


if __name__ == "__main__":
    run(check, lambda request: judge_entries(NAME, request, measure, METRICS), OPTIONS)
