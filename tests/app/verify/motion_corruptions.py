"""Damages poses and times: dataset.json's frames, frames.csv, camera.json and imu.csv."""
import numpy as np

from corruptions import found_by


# --- poses and times

@found_by("motion")
def equal_timestamps(copy):
    copy.card["frames"][3]["time_s"] = copy.card["frames"][2]["time_s"]


@found_by("motion")
def long_quaternion(copy):
    frame = copy.card["frames"][1]
    frame["quaternion_xyzw"] = [1.001 * value for value in frame["quaternion_xyzw"]]


@found_by("poses")
def quaternion_with_w_first(copy):
    for frame in copy.card["frames"]:
        x, y, z, w = frame["quaternion_xyzw"]
        frame["quaternion_xyzw"] = [w, x, y, z]


@found_by("surface")
def poses_turned_by_half_a_pixel(copy):
    angle = 0.5 / copy.card["conventions"]["intrinsics"]["fx"]
    for frame in copy.card["frames"]:
        x, y, z, w = frame["quaternion_xyzw"]
        s, c = np.sin(angle / 2), np.cos(angle / 2)  # about the camera's y axis, on the right
        turned = np.array([x * c - z * s, y * c + w * s, z * c + x * s, w * c - y * s])
        frame["quaternion_xyzw"] = list(turned / np.linalg.norm(turned))


@found_by("poses")
def camera_json_mirrored(copy):
    def mirror(views):
        for view in views:
            for key in ("pos", "target", "up"):
                view[key][0] = -view[key][0]
    copy.edit_json("camera.json", mirror)


@found_by("poses")
def camera_json_without_a_view(copy):
    copy.edit_json("camera.json", lambda views: views.pop())


# --- frames.csv

@found_by("frames")
def speed_of_a_frame(copy):
    def faster(rows):
        column = rows[0].index("speed_mps")
        rows[2][column] = str(1.01 * float(rows[2][column]))
    copy.edit_rows("frames.csv", faster)


@found_by("frames")
def targets_of_a_frame(copy):
    def more(rows):
        column = rows[0].index("targets")
        rows[1][column] = str(int(rows[1][column]) + 1)
    copy.edit_rows("frames.csv", more)


@found_by("frames")
def truncated_table(copy):
    copy.edit_bytes("frames.csv", lambda data: data[:len(data) // 2])


@found_by("frames")
def columns_of_one_name(copy):
    def rename(rows):
        rows[0][-2:] = ["frame", "frame"]
    copy.edit_rows("frames.csv", rename)


# --- imu.csv

def imu(change):
    def apply(copy):
        def rows(table):
            for row in table[1:]:
                values = np.array([float(value) for value in row[1:]])
                row[1:] = [repr(float(value)) for value in change(values)]
        copy.edit_rows("imu.csv", rows)
    return apply


@found_by("imu")
def angular_rate_reversed(copy):
    imu(lambda v: np.concatenate([-v[:3], v[3:]]))(copy)


@found_by("imu")
def gravity_downwards(copy):
    imu(lambda v: np.concatenate([v[:3], -v[3:]]))(copy)


@found_by("imu")
def half_of_the_measurements(copy):
    def halve(rows):
        del rows[len(rows) // 2:]
    copy.edit_rows("imu.csv", halve)


@found_by("imu")
def times_exchanged(copy):
    frames = copy.card["frames"]
    frames[1]["time_s"], frames[2]["time_s"] = frames[2]["time_s"], frames[1]["time_s"]
