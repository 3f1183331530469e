"""RGB-D odometry from frame to frame: drift, lost frames, relative errors (Open3D, OpenCV)."""
import dataset  # imported first: it sets the number of threads

import cv2
import numpy as np

FARTHEST_M = 10.0    # larger depths are not used
# Largest depth difference of matched pixels. The programs' defaults of 0.03 and 0.07 m are for cameras
# at 30 Hz: with several centimetres of motion per frame they reject most true matches.
DEPTH_DIFFERENCE_M = 0.3
# A pair is lost if the program fails, or if the error of its motion exceeds half the distance moved (at
# least 1 cm, at most 0.2 m) or this angle.
LOST_SHARE, LOST_LEAST_M, LOST_MOST_M = 0.5, 0.01, 0.2
LOST_DEG = 10.0
WINDOW = 10          # consecutive pairs over which drift is measured
EVERY = 5            # frames between the starts of windows

VALUES = {
    "lost_rate": {"unit": "%", "better": "lower"},
    "drift_rate": {"unit": "%", "better": "lower"},
    "rpe_cm": {"unit": "cm", "better": "lower"},
    "rpe_deg": {"unit": "deg", "better": "lower"},
}
METRICS = {f"{program}_{name}": info for program in ("open3d", "opencv")
           for name, info in VALUES.items()}


def open3d():
    try:
        return dataset.need("open3d", "python3-open3d")
    except dataset.Missing:
        return None


def check():
    found = []
    if open3d() is not None:
        found.append(f"Open3D {open3d().__version__}")
    if hasattr(cv2, "rgbd"):
        found.append(f"OpenCV {cv2.__version__} with rgbd")
    if not found:
        raise dataset.Missing("Neither Open3D nor OpenCV's rgbd is installed; install Debian's "
                              "python3-open3d.")
    return ", ".join(found)


class Open3d:
    """Open3D's compute_rgbd_odometry with the hybrid term of colour and geometry."""

    def __init__(self, data):
        self.o3d = open3d()
        self.data = data
        k = data.matrix(pixel_centres=True)
        self.camera = self.o3d.camera.PinholeCameraIntrinsic(
            data.width, data.height, k[0, 0], k[1, 1], k[0, 2], k[1, 2])
        self.option = self.o3d.pipelines.odometry.OdometryOption(
            depth_diff_max=DEPTH_DIFFERENCE_M, depth_max=FARTHEST_M)
        self.method = self.o3d.pipelines.odometry.RGBDOdometryJacobianFromHybridTerm()

    def load(self, index):
        image = self.o3d.geometry.Image
        return self.o3d.geometry.RGBDImage.create_from_color_and_depth(
            image(np.ascontiguousarray(self.data.rgb(index))), image(self.data.depth(index)),
            depth_scale=1.0, depth_trunc=FARTHEST_M, convert_rgb_to_intensity=True)

    def motion(self, before, after):
        """before_from_after, the relative camera pose; None if the program fails."""
        found, motion, _ = self.o3d.pipelines.odometry.compute_rgbd_odometry(
            after, before, self.camera, np.eye(4), self.method, self.option)
        return np.asarray(motion) if found else None


class OpenCv:
    """cv2.rgbd.RgbdOdometry: the method of Steinbruecker et al., ICCV Workshops 2011."""

    def __init__(self, data):
        self.data = data
        self.odometry = cv2.rgbd.RgbdOdometry_create(data.matrix(pixel_centres=True), 0.0,
                                                     FARTHEST_M, DEPTH_DIFFERENCE_M)
        # No limit on the motion: its results are measured in any case.
        self.odometry.setMaxTranslation(10.0)
        self.odometry.setMaxRotation(180.0)

    def load(self, index):
        depth = self.data.depth(index)
        depth[depth <= 0] = np.nan
        return self.data.gray(index), depth

    def motion(self, before, after):
        none = np.zeros((0, 0), np.uint8)
        found, motion = self.odometry.compute(after[0], after[1], none, before[0], before[1], none)
        return motion if found and np.isfinite(motion).all() else None


def turn_deg(motion):
    return float(np.degrees(np.arccos(np.clip((np.trace(motion[:3, :3]) - 1) / 2, -1, 1))))


def is_lost(off, motion):
    limit = np.clip(LOST_SHARE * np.linalg.norm(motion[:3, 3]), LOST_LEAST_M, LOST_MOST_M)
    return np.linalg.norm(off[:3, 3]) > limit or turn_deg(off) > LOST_DEG


def drift(estimated, true):
    """The median over windows of the position error at the window's end, divided by the path length."""
    shares = []
    window = min(WINDOW, len(true))
    for first in range(0, len(true) - window + 1, EVERY):
        ours, theirs, way = np.eye(4), np.eye(4), 0.0
        for i in range(first, first + window):
            ours, theirs = ours @ estimated[i], theirs @ true[i]
            way += np.linalg.norm(true[i][:3, 3])
        if way > 1e-6:
            shares.append(np.linalg.norm(ours[:3, 3] - theirs[:3, 3]) / way)
    return float(np.median(shares)) if shares else None


def measure_with(program, data):
    true = [np.linalg.inv(data.poses[i]) @ data.poses[i + 1] for i in range(len(data) - 1)]
    estimated, metres, degrees = [], [], []
    before = program.load(0) if true else None
    for i, motion in enumerate(true):
        after = program.load(i + 1)
        guess = program.motion(before, after)
        before = after
        estimated.append(np.eye(4) if guess is None else guess)
        if guess is None:
            continue
        off = np.linalg.inv(motion) @ guess
        if not is_lost(off, motion):
            metres.append(np.linalg.norm(off[:3, 3]))
            degrees.append(turn_deg(off))
    if not true:
        return dict.fromkeys(VALUES)
    return {"lost_rate": 1 - len(metres) / len(true),
            "drift_rate": drift(estimated, true) if metres else None,
            "rpe_cm": 100 * float(np.median(metres)) if metres else None,
            "rpe_deg": float(np.median(degrees)) if degrees else None}


def measure(data, _request, _entry):
    values = {}
    programs = {"open3d": Open3d if open3d() is not None else None,
                "opencv": OpenCv if hasattr(cv2, "rgbd") else None}
    for name, program in programs.items():
        if program is not None:
            values.update({f"{name}_{key}": value
                           for key, value in measure_with(program(data), data).items()})
    return values


if __name__ == "__main__":
    dataset.run(check, lambda request: dataset.judge_entries("odometry", request, measure, METRICS))
