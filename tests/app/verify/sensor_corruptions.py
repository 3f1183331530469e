"""Damages the files of a camera sensor and of a depth camera."""
import cv2
import numpy as np

from corruptions import found_by


@found_by("rgb_sensor")
def sensor_pictures_of_two_frames_exchanged(copy):
    names = sorted(name for name in copy.card["files"] if name.startswith("rgb_sensor/"))
    clean = [copy.read(name.replace("rgb_sensor", "rgb")).astype(float).ravel() for name in names]
    alike = [np.corrcoef(clean[0], other)[0, 1] for other in clean]
    copy.swap(names[0], names[int(np.argmin(alike))])


@found_by("rgb_sensor")
def sensor_picture_upside_down(copy):
    copy.edit("rgb_sensor/000001.png", lambda image: image[::-1])


@found_by("rgb_sensor")
def distortion_said_is_not_the_one_asked_for(copy):
    copy.card["conventions"]["rgb_sensor"]["distortion"]["k1"] += 0.01


@found_by("rgb_sensor")
def shutter_said_is_not_the_one_asked_for(copy):
    copy.card["conventions"]["rgb_sensor"]["exposure"]["shutter_s"] *= 2


@found_by("rgb_sensor")
def exposure_of_rows_said_is_not_the_shutters(copy):
    copy.card["conventions"]["rgb_sensor"]["exposure"]["row_exposure_s"] *= 1.01


@found_by("rgb_sensor")
def exposure_of_rows_not_said(copy):
    del copy.card["conventions"]["rgb_sensor"]["exposure"]["row_exposure_s"]


@found_by("rgb_sensor")
def distortion_not_said(copy):
    del copy.card["conventions"]["rgb_sensor"]["distortion"]


@found_by("images")
def sensor_picture_of_another_size(copy):
    copy.edit("rgb_sensor/000002.png", lambda image: image[:-1])


@found_by("files")
def sensor_picture_missing(copy):
    copy.remove("rgb_sensor/000002.png")


@found_by("depth_sensor")
def sensor_depth_further_off_than_noise(copy):
    copy.edit("depth_sensor/000001.png",
              lambda image: np.where(image > 0, image + image // 12, 0).astype(np.uint16))


@found_by("depth_sensor")
def sensor_depth_without_holes(copy):
    names = [name for name in copy.card["files"] if name.startswith("depth_sensor/")]
    for name in names:
        copy.edit(name, lambda _, name=name: copy.read(name.replace("_sensor", "")))


@found_by("depth_sensor")
def sensor_hole_in_a_bright_wall(copy):
    image = copy.read("depth_sensor/000001.png")
    # A hole whose surroundings have depth and are neither dark nor at an edge.
    seen = cv2.erode((image > 0).astype(np.uint8), np.ones((9, 9), np.uint8))
    light = copy.read("albedo/000001.png").min(axis=2)
    near = image < 2500
    y, x = np.argwhere((seen > 0) & (light > 150) & near & (image > 900))[0]
    image[y, x] = 0
    copy.write("depth_sensor/000001.png", image)


@found_by("depth_sensor")
def sensor_depth_of_another_model(copy):
    copy.card["conventions"]["depth_sensor"]["model"] = "lidar"


@found_by("depth_sensor")
def sensor_depth_of_another_seed(copy):
    copy.card["conventions"]["depth_sensor"]["sensor_seed"] += 1
