"""More of corruptions.py: files for other programs that contradict dataset.json."""
import json
import struct

import cv2
import numpy as np

from corruptions import found_by


def edit_label(copy, name, function):
    path = copy.folder / name
    rows = [row.split() for row in path.read_text().splitlines()]
    function(rows)
    path.write_text("".join(" ".join(row) + "\n" for row in rows))


@found_by("yolo")
def box_from_its_corner(copy):
    """The most common mistake: the corner in place of the centre."""
    def shift(rows):
        for row in rows:
            row[1] = f"{float(row[1]) - float(row[3]) / 2:.6f}"
            row[2] = f"{float(row[2]) - float(row[4]) / 2:.6f}"
    edit_label(copy, "labels/000001.txt", shift)


@found_by("yolo")
def class_counted_from_one(copy):
    edit_label(copy, "labels/000001.txt",
               lambda rows: rows[0].__setitem__(0, str(int(rows[0][0]) + 1)))


@found_by("yolo")
def label_of_nothing(copy):
    edit_label(copy, "labels/000000.txt", lambda rows: rows.append(["3", "0.5", "0.5", "0.1", "0.1"]))


@found_by("yolo")
def outline_half_a_pixel_off(copy):
    def shift(rows):
        rows[0][1] = f"{float(rows[0][1]) + 0.5 / 160:.6f}"
    edit_label(copy, "labels_seg/000001.txt", shift)


@found_by("bop")
def bop_translation_in_metres(copy):
    def scale(root):
        for camera in root.values():
            camera["cam_t_w2c"] = [value / 1000 for value in camera["cam_t_w2c"]]
    copy.edit_json("scene_camera.json", scale)


@found_by("bop")
def bop_lens_half_a_pixel_off(copy):
    def shift(root):
        root["1"]["cam_K"][2] += 0.5
    copy.edit_json("scene_camera.json", shift)


@found_by("bop")
def bop_model_turned(copy):
    def turn(root):
        thing = root["1"][0]
        matrix = np.array(thing["cam_R_m2c"]).reshape(3, 3) @ np.diag([-1, -1, 1])
        thing["cam_R_m2c"] = matrix.ravel().tolist()
    copy.edit_json("scene_gt.json", turn)


@found_by("bop")
def bop_visible_count(copy):
    def count(root):
        root["1"][0]["px_count_visib"] += 1
    copy.edit_json("scene_gt_info.json", count)


@found_by("bop")
def bop_mask_of_another_thing(copy):
    copy.swap("mask_visib/000001_000000.png", "mask_visib/000001_000001.png")


@found_by("bop")
def bop_whole_mask_without_a_row(copy):
    name = "mask/000001_000000.png"
    rows = np.flatnonzero(copy.read(name).any(axis=1))

    def clear(image):
        image[rows[len(rows) // 2]] = 0
        return image
    copy.edit(name, clear)


def edit_glb(copy, function):
    """Edits the JSON and the binary part of trajectory.glb."""
    path = copy.folder / "trajectory.glb"
    data = path.read_bytes()
    length, = struct.unpack_from("<I", data, 12)
    root, binary = json.loads(data[20:20 + length]), bytearray(data[28 + length:])
    function(root, binary)
    text = json.dumps(root).encode()
    text += b" " * (-len(text) % 4)
    whole = struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary))
    whole += struct.pack("<I4s", len(text), b"JSON") + text
    path.write_bytes(whole + struct.pack("<I4s", len(binary), b"BIN\0") + bytes(binary))


def keys_of_camera(root, path):
    """Start of the floats of the camera's channel in the binary part, and their number."""
    camera = next(i for i, node in enumerate(root["nodes"]) if "camera" in node)
    animation = root["animations"][0]
    channel = next(one for one in animation["channels"]
                   if one["target"] == {"node": camera, "path": path})
    accessor = root["accessors"][animation["samplers"][channel["sampler"]]["output"]]
    return root["bufferViews"][accessor["bufferView"]].get("byteOffset", 0), accessor["count"]


@found_by("gltf")
def gltf_camera_in_our_axes(copy):
    def swap(root, binary):
        begin, count = keys_of_camera(root, "translation")
        for i in range(count):
            x, y, z = struct.unpack_from("<fff", binary, begin + 12 * i)
            struct.pack_into("<fff", binary, begin + 12 * i, x, -z, y)
    edit_glb(copy, swap)


@found_by("gltf")
def gltf_camera_looks_back(copy):
    def turn(root, binary):
        begin, _ = keys_of_camera(root, "rotation")
        x, y, z, w = struct.unpack_from("<ffff", binary, begin)
        struct.pack_into("<ffff", binary, begin, -z, w, x, -y)
    edit_glb(copy, turn)


@found_by("gltf")
def gltf_field_of_view_of_the_width(copy):
    def widen(root, binary):
        root["cameras"][0]["perspective"]["yfov"] *= 4 / 3
    edit_glb(copy, widen)


@found_by("card")
def relation_to_nothing(copy):
    related = next(one for one in copy.card["objects"] if one["relations"])
    related["relations"][0]["id"] = len(copy.card["objects"]) + 1


@found_by("classes")
def object_that_does_not_exist(copy):
    def foreign(ids):
        ids[20, 30] = 9999
        return ids
    copy.edit("instance/000001.png", foreign)


@found_by("yolo")
def yolo_names_exchanged(copy):
    def exchange(data):
        names = data.split(b"\n")
        names[0], names[1] = names[1], names[0]
        return b"\n".join(names)
    copy.edit_bytes("classes.txt", exchange)


@found_by("yolo")
def yolo_names_counted_from_one(copy):
    copy.edit_bytes("data.yaml", lambda data: data.replace(b"  0: wall\n", b"", 1))


@found_by("pictures")
def pictures_one_too_late(copy):
    earlier = copy.read("rgb/000000.png")
    for name in sorted(path.name for path in (copy.folder / "rgb").iterdir())[1:]:
        picture = copy.read(f"rgb/{name}")
        copy.write(f"rgb/{name}", earlier)
        earlier = picture


@found_by("pictures")
def pictures_of_two_frames_exchanged(copy):
    copy.swap("rgb/000001.png", "rgb/000005.png")


@found_by("pictures")
def picture_mirrored(copy):
    copy.edit("rgb/000001.png", lambda image: image[:, ::-1])


@found_by("pictures")
def picture_upside_down(copy):
    copy.edit("rgb/000004.png", lambda image: image[::-1])


@found_by("pictures")
def picture_moved_by_eight_pixels(copy):
    copy.edit("rgb/000001.png", lambda image: np.roll(image, (8, 8), (0, 1)))


@found_by("pictures")
def picture_of_another_room(copy):
    def draw(image):
        other = np.full_like(image, 90)
        for i, x in enumerate(range(5, image.shape[1] - 20, 24)):
            cv2.rectangle(other, (x, 7 * i % 50), (x + 9, 60 + 11 * i % 50), (20 * i, 200, 60), -1)
        return other
    copy.edit("rgb/000001.png", draw)


@found_by("pictures")
def picture_black(copy):
    copy.edit("rgb/000001.png", np.zeros_like)


@found_by("yolo")
def yolo_picture_trained_on_and_held_back(copy):
    held_back = (copy.folder / "val.txt").read_text().splitlines()[0]
    copy.edit_bytes("train.txt", lambda data: data + held_back.encode() + b"\n")


@found_by("yolo")
def yolo_pictures_in_a_folder_that_is_not_there(copy):
    copy.edit_bytes("val.txt", lambda data: data.replace(b"./images/", b"./pictures/"))


@found_by("yolo")
def yolo_data_without_its_lists(copy):
    copy.edit_bytes("data.yaml", lambda data: data.replace(b"val: val.txt", b"val: images"))


POSES = "mav0/state_groundtruth_estimate0/data.csv"


@found_by("euroc")
def euroc_quaternion_with_w_last(copy):
    def turn(rows):
        for row in rows[1:]:
            row[4:8] = row[5:8] + row[4:5]
    copy.edit_rows(POSES, turn)


@found_by("euroc")
def euroc_times_in_microseconds(copy):
    def shorten(rows):
        for row in rows[1:]:
            row[0] = str(int(row[0]) // 1000)
    copy.edit_rows(POSES, shorten)


@found_by("euroc")
def euroc_picture_of_another_frame(copy):
    names = sorted(name for name in copy.card["files"] if name.startswith("mav0/cam0/data/"))
    copy.swap(names[0], names[-1])


@found_by("euroc")
def euroc_lens_half_a_pixel_off(copy):
    cx = copy.card["conventions"]["intrinsics"]["cx"]
    copy.edit_bytes("mav0/cam0/sensor.yaml", lambda data: data.replace(
        f"{cx - 0.5:.9f}".encode(), f"{cx:.9f}".encode(), 1))


@found_by("euroc")
def euroc_right_camera_at_the_left(copy):
    baseline = copy.card["conventions"]["rgb_right"]["baseline_m"]
    copy.edit_bytes("mav0/cam1/sensor.yaml", lambda data: data.replace(
        f"{baseline:.9f}".encode(), b"0.000000000", 1))
