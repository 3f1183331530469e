"""Ways to damage a dataset, each with the check that must find it.

A corruption is a function of a dataset_copy.Copy, whose hashes are updated afterwards: a wrong hash
is the easy case and has its own corruption.
"""
import json

import numpy as np

ALL = []


def found_by(check):
    def keep(function):
        ALL.append((function.__name__, check, function))
        return function
    return keep


# --- files

@found_by("files")
def hash_of_one_byte(copy):
    copy.mended = False
    copy.edit_bytes("frames.csv", lambda data: data[:-3] + b"9" + data[-2:])


@found_by("files")
def missing_frame(copy):
    copy.remove("instance/000002.png")


@found_by("files")
def missing_flow(copy):
    copy.remove("flow_forward/000001_000002.flo")


@found_by("files")
def foreign_file(copy):
    (copy.folder / "rgb" / "999999.png").write_bytes(b"")


@found_by("images")
def one_byte_of_a_png(copy):
    def flip(data):
        data[len(data) // 2] ^= 0x10
        return data
    copy.edit_bytes("depth/000001.png", flip)


@found_by("images")
def truncated_png(copy):
    copy.edit_bytes("rgb/000001.png", lambda data: data[:len(data) * 2 // 3])


@found_by("images")
def other_size(copy):
    copy.edit("semantic/000000.png", lambda image: image[:, :-1])


@found_by("images")
def other_type(copy):
    copy.edit("depth/000000.png", lambda image: (image // 256).astype(np.uint8))


@found_by("images")
def truncated_exr(copy):
    copy.edit_bytes("depth_exr/000001.exr", lambda data: data[:200])


# --- dataset.json

@found_by("card")
def focal_length(copy):
    copy.card["conventions"]["intrinsics"]["fx"] *= 1.01


@found_by("card")
def principal_point_by_half_a_pixel(copy):
    copy.card["conventions"]["intrinsics"]["cx"] -= 0.5


@found_by("card")
def depth_scale_said(copy):
    copy.card["conventions"]["depth"]["scale_m"] = 0.0002


@found_by("card")
def class_table_shifted(copy):
    names = [row["name"] for row in copy.card["classes"]]
    for row, name in zip(copy.card["classes"], names[1:] + names[:1]):
        row["name"] = name


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


@found_by("captures")
def one_capture_more(copy):
    copy.card["metrics"]["counted"]["captured"] += 1


@found_by("captures")
def share_of_the_box(copy):
    best = max(copy.card["metrics"]["counted"]["per_object"], key=lambda row: row["mask_share"])
    best["box_share"] *= 0.5


@found_by("captures")
def best_frame_without_a_usable_picture(copy):
    best = max(copy.card["metrics"]["counted"]["per_object"], key=lambda row: row["best_frame"])
    copy.card["metrics"]["pictures"]["dark"].append(best["best_frame"])


@found_by("usable")
def black_picture(copy):
    copy.edit("rgb/000001.png", lambda image: image * 0)


@found_by("usable")
def dark_rate_of_another_dataset(copy):
    copy.card["metrics"]["pictures"]["dark_rate"] = 0.5


@found_by("scene")
def box_of_an_object(copy):
    copy.card["objects"][-1]["box"]["center"][0] += 0.3


# --- labels and depth

@found_by("classes")
def ids_off_by_one(copy):
    copy.edit("instance/000001.png", lambda ids: np.where(ids > 0, ids + 1, 0).astype(np.uint16))


@found_by("classes")
def one_pixel_of_another_class(copy):
    def other(classes):
        classes[20, 30] = (classes[20, 30] + 1) % 41
        return classes
    copy.edit("semantic/000001.png", other)


@found_by("classes")
def classes_of_objects_shifted(copy):
    classes = [row["nyu40"] for row in copy.card["objects"]]
    for row, nyu40 in zip(copy.card["objects"], classes[1:] + classes[:1]):
        row["nyu40"] = nyu40


@found_by("holes")
def hole_in_the_depth(copy):
    def hole(depth):
        depth[10, 10] = 0
        return depth
    copy.edit("depth/000002.png", hole)


@found_by("object_boxes")
def depth_scaled(copy):
    copy.edit("depth/000001.png", lambda depth: (depth * 1.05).astype(np.uint16))
    copy.edit("depth_exr/000001.exr", lambda depth: (depth * 1.05).astype(np.float32))


@found_by("surface")
def depth_along_the_ray(copy):
    lens = copy.card["conventions"]["intrinsics"]
    x, y = np.meshgrid(np.arange(lens["width"]) + 0.5, np.arange(lens["height"]) + 0.5)
    longer = np.sqrt(1 + ((x - lens["cx"]) / lens["fx"]) ** 2 + ((y - lens["cy"]) / lens["fy"]) ** 2)
    copy.edit("depth/000001.png", lambda depth: np.rint(depth * longer).astype(np.uint16))
    copy.edit("depth_exr/000001.exr", lambda depth: (depth * longer).astype(np.float32))


@found_by("surface")
def swapped_frames(copy):
    for folder, ending in [("rgb", "png"), ("depth", "png"), ("depth_exr", "exr"),
                           ("instance", "png"), ("semantic", "png")]:
        copy.swap(f"{folder}/000000.{ending}", f"{folder}/000003.{ending}")


@found_by("surface")
def mirrored_image(copy):
    for name in ["rgb/000001.png", "depth/000001.png", "depth_exr/000001.exr",
                 "instance/000001.png", "semantic/000001.png"]:
        copy.edit(name, lambda image: np.ascontiguousarray(image[:, ::-1]))


@found_by("depth_exr")
def one_pixel_of_depth(copy):
    def nearer(depth):
        depth[30, 40] -= 2
        return depth
    copy.edit("depth/000002.png", nearer)


# --- annotations

def annotations(change):
    return lambda copy: copy.edit_json("annotations.json", lambda root: change(root["annotations"]))


@found_by("coco")
def box_off_by_one(copy):
    def move(rows):
        rows[0]["bbox"][0] += 1
    annotations(move)(copy)


@found_by("coco")
def run_lengths_too_long(copy):
    def lengthen(rows):
        rows[0]["segmentation"]["counts"] += "1"
    annotations(lengthen)(copy)


@found_by("coco")
def category_of_another_class(copy):
    def other(rows):
        rows[0]["category_id"] = rows[0]["category_id"] % 40 + 1
    annotations(other)(copy)


@found_by("coco")
def annotation_ids_from_zero(copy):
    def lower(rows):
        for row in rows:
            row["id"] -= 1
    annotations(lower)(copy)


@found_by("coco")
def annotation_left_out(copy):
    annotations(lambda rows: rows.pop())(copy)


@found_by("coco")
def masks_row_by_row(copy):
    """The mask of a mirrored and turned image: rows and columns exchanged."""
    def exchange(root):
        for row in root["annotations"]:
            row["segmentation"]["size"].reverse()
    copy.edit_json("annotations.json", exchange)


@found_by("instances")
def occluder_of_a_row(copy):
    def other(rows):
        rows[1][rows[0].index("occluder_id")] = "1"
        rows[1][rows[0].index("occluder_fraction")] = "0.5"
    copy.edit_rows("instances.csv", other)


@found_by("instances")
def visible_pixels_of_a_row(copy):
    def more(rows):
        column = rows[0].index("visible_px")
        rows[-1][column] = str(int(rows[-1][column]) + 1)
    copy.edit_rows("instances.csv", more)


@found_by("instances")
def box_in_the_worlds_axes(copy):
    def world(rows):
        for axis in "xyz":
            rows[1][rows[0].index("quaternion_" + axis)] = "0"
        rows[1][rows[0].index("quaternion_w")] = "1"
    copy.edit_rows("instances.csv", world)


@found_by("amodal")
def whole_mask_of_nothing(copy):
    name = next(name for name in sorted(copy.card["files"])
                if name.startswith("amodal/")
                and json.loads((copy.folder / name).read_text())["objects"])
    def empty(root):
        one = root["objects"][0]
        one["counts"] = compressed(one["size"][0] * one["size"][1])
    copy.edit_json(name, empty)


def compressed(number):
    """COCO's text of a single run."""
    text = ""
    while True:
        group = number & 0x1f
        number >>= 5
        more = number != -1 if group & 0x10 else number != 0
        text += chr((group | 0x20 if more else group) + 48)
        if not more:
            return text


# --- motion

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


# --- surfaces, flow, stereo

@found_by("normals")
def channels_of_normals_swapped(copy):
    copy.edit("normal_world/000001.png", lambda image: image[:, :, ::-1])


@found_by("normals")
def normals_reversed(copy):
    for folder in ("normal_camera", "normal_world"):
        def reverse(image):
            return np.where(image.any(axis=2, keepdims=True), 65535 - image, 0).astype(np.uint16)
        copy.edit(f"{folder}/000001.png", reverse)


@found_by("object_coordinates")
def coordinates_shifted(copy):
    copy.edit("object_coordinates/000001.png",
              lambda image: np.where(image > 0, image // 2, 0).astype(np.uint16))


@found_by("flow")
def flow_reversed(copy):
    copy.edit_flow("flow_forward/000000_000001.flo", lambda uv: np.where(uv < 1e9, -uv, uv))


@found_by("flow")
def flow_channels_swapped(copy):
    copy.edit_flow("flow_backward/000001_000000.flo", lambda uv: uv[:, :, ::-1])


@found_by("flow")
def flow_by_a_twentieth_of_a_pixel(copy):
    copy.edit_flow("flow_forward/000001_000002.flo", lambda uv: np.where(uv < 1e9, uv + 0.05, uv))


@found_by("flow")
def flow_mask_of_all_seen(copy):
    copy.edit("flow_forward/000000_000001_mask.png", lambda mask: mask * 0)


@found_by("flow")
def flow_mask_of_all_occluded(copy):
    masks = [name for name in copy.card["files"]
             if name.startswith("flow_forward/") and name.endswith("_mask.png")]
    most = max(sorted(masks), key=lambda name: (copy.read(name) == 0).sum())
    copy.edit(most, lambda mask: np.where(mask == 0, 1, mask).astype(np.uint8))


@found_by("stereo")
def baseline(copy):
    for modality in ("disparity", "rgb_right", "depth_right"):
        copy.card["conventions"][modality]["baseline_m"] *= 1.02


@found_by("stereo")
def disparity_off_by_a_step(copy):
    copy.edit("disparity/000001.png", lambda image: np.where(image > 0, image + 2, 0)
              .astype(np.uint16))


@found_by("stereo")
def right_picture_is_the_left(copy):
    copy.edit("depth_right/000001.png", lambda _: copy.read("depth/000001.png"))
    copy.edit("rgb_right/000001.png", lambda _: copy.read("rgb/000001.png"))
