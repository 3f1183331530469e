"""Damages files for detectors: YOLO, KITTI's objects, BOP and BlenderProc's HDF5."""
import json

import h5py
import numpy as np

from corruptions import found_by


# --- YOLO and KITTI's objects

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


@found_by("kitti_objects")
def kitti_box_around_its_middle(copy):
    """The most common mistake: the box's middle in place of the middle of its bottom."""
    def raise_it(rows):
        rows[0][12] = f"{float(rows[0][12]) - float(rows[0][8]) / 2:.6f}"
    edit_label(copy, "label_2/000001.txt", raise_it)


@found_by("kitti_objects")
def kitti_length_and_width_exchanged(copy):
    def exchange(rows):
        row = next(row for row in rows if row[9] != row[10])
        row[9], row[10] = row[10], row[9]
    edit_label(copy, "label_2/000001.txt", exchange)


@found_by("kitti_objects")
def kitti_turned_the_other_way(copy):
    def turn(rows):
        row = max(rows, key=lambda row: abs(np.sin(float(row[14]))))
        row[14] = f"{-float(row[14]):.6f}"
    edit_label(copy, "label_2/000001.txt", turn)


@found_by("kitti_objects")
def kitti_thing_without_a_line(copy):
    edit_label(copy, "label_2/000001.txt", lambda rows: rows.pop())


# --- BOP

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


# --- BlenderProc's HDF5

def edit_hdf5(copy, name, function):
    with h5py.File(copy.folder / name, "r+") as file:
        function(file)


def replace_text(file, name, function):
    value = json.loads(file[name][()])
    function(value)
    del file[name]
    file.create_dataset(name, data=np.bytes_(json.dumps(value)))


@found_by("hdf5")
def hdf5_depth_along_the_ray(copy):
    def lengthen(file):
        depth = file["depth"][...]
        depth[10, 10] *= 1.02
        file["depth"][...] = depth
    edit_hdf5(copy, "hdf5/000001.hdf5", lengthen)


@found_by("hdf5")
def hdf5_colours_the_other_way_round(copy):
    def reverse(file):
        file["colors"][...] = file["colors"][...][..., ::-1]
    edit_hdf5(copy, "hdf5/000001.hdf5", reverse)


@found_by("hdf5")
def hdf5_instances_shifted_by_a_column(copy):
    def shift(file):
        file["instance_segmaps"][...] = np.roll(file["instance_segmaps"][...], 1, axis=1)
    edit_hdf5(copy, "hdf5/000001.hdf5", shift)


@found_by("hdf5")
def hdf5_pose_in_opencv_axes(copy):
    def flip(pose):
        for row in pose[:3]:
            row[1], row[2] = -row[1], -row[2]
    edit_hdf5(copy, "hdf5/000001.hdf5", lambda file: replace_text(file, "campose", flip))


@found_by("hdf5")
def hdf5_thing_without_attributes(copy):
    edit_hdf5(copy, "hdf5/000001.hdf5", lambda file: replace_text(
        file, "instance_attribute_maps", lambda things: things.pop()))


@found_by("hdf5")
def hdf5_without_classes(copy):
    def remove(file):
        del file["category_id_segmaps"]
    edit_hdf5(copy, "hdf5/000001.hdf5", remove)
