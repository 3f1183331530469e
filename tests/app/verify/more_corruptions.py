"""More of corruptions.py: HDF5, labels of KITTI, polygons, folds, the preview and base colours; and
errors that are the same in all images."""
import json

import cv2
import h5py
import numpy as np

from corruptions import found_by
from format_corruptions import edit_label


def edit_hdf5(copy, name, function):
    with h5py.File(copy.folder / name, "r+") as file:
        function(file)


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


def replace_text(file, name, function):
    value = json.loads(file[name][()])
    function(value)
    del file[name]
    file.create_dataset(name, data=np.bytes_(json.dumps(value)))


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


@found_by("coco_polygons")
def outline_that_says_nothing_of_what_is_in_sight(copy):
    copy.edit_json("annotations_polygons.json",
                   lambda root: root["annotations"][0].pop("attributes"))


@found_by("coco_polygons")
def polygon_a_pixel_off(copy):
    def shift(root):
        corners = root["annotations"][0]["segmentation"][0]
        corners[::2] = [x + 1 for x in corners[::2]]
    copy.edit_json("annotations_polygons.json", shift)


@found_by("coco_polygons")
def polygon_without_a_corner(copy):
    def cut(root):
        corners = max((one for annotation in root["annotations"]
                       for one in annotation["segmentation"]), key=len)
        del corners[:2]
    copy.edit_json("annotations_polygons.json", cut)


@found_by("coco_polygons")
def polygons_missing(copy):
    copy.edit_json("annotations_polygons.json",
                   lambda root: root["annotations"][0].update(segmentation=[]))


def edit_list(copy, name, function):
    path = copy.folder / name
    lines = path.read_text().splitlines()
    function(lines)
    path.write_text("".join(line + "\n" for line in lines))


@found_by("folds")
def picture_trained_on_and_held_back(copy):
    held_back = (copy.folder / "folds/fold_0_val.txt").read_text().splitlines()[0]
    edit_list(copy, "folds/fold_0_train.txt", lambda lines: lines.append(held_back))


@found_by("folds")
def picture_never_held_back(copy):
    edit_list(copy, "folds/fold_1_val.txt", lambda lines: lines.pop())


@found_by("folds")
def picture_of_nothing(copy):
    edit_list(copy, "folds/fold_1_val.txt", lambda lines: lines.append("rgb/000999.png"))


@found_by("folds")
def fold_with_the_annotations_of_another(copy):
    copy.swap("folds/fold_0_val.json", "folds/fold_1_val.json")


@found_by("folds")
def fold_with_another_mask(copy):
    def empty(root):
        root["annotations"][0]["area"] += 1
    copy.edit_json("folds/fold_0_val.json", empty)


def read_video(path):
    video, pictures = cv2.VideoCapture(str(path)), []
    while True:
        good, picture = video.read()
        if not good:
            return pictures
        pictures.append(picture)


def edit_video(copy, function, speed=1.0):
    """Rewrites the video with changed images; `speed` multiplies its frame rate."""
    path = copy.folder / "preview.mp4"
    rate = speed * cv2.VideoCapture(str(path)).get(cv2.CAP_PROP_FPS)
    pictures = function(read_video(path))
    height, width = pictures[0].shape[:2]
    video = cv2.VideoWriter(str(path), cv2.VideoWriter_fourcc(*"mp4v"), rate, (width, height))
    for picture in pictures:
        video.write(picture)
    video.release()


@found_by("video")
def video_without_its_last_picture(copy):
    edit_video(copy, lambda pictures: pictures[:-1])


@found_by("video")
def video_backwards(copy):
    edit_video(copy, lambda pictures: pictures[::-1])


@found_by("video")
def video_at_twice_the_speed(copy):
    edit_video(copy, lambda pictures: pictures, speed=2.0)


@found_by("video")
def video_cut_off(copy):
    copy.edit_bytes("preview.mp4", lambda data: data[:len(data) // 2])


@found_by("albedo")
def albedo_as_it_is_lit(copy):
    copy.write("albedo/000001.png", copy.read("rgb/000001.png"))


@found_by("albedo")
def albedo_linear(copy):
    copy.edit("albedo/000001.png",
              lambda image: np.round(255 * (image / 255.0) ** 2.2).astype(np.uint8))


@found_by("surface")
def thing_erased(copy):
    """Replaces an object of tiny_room by the wall behind it, in every image."""
    frame = copy.card["frames"][1]
    lens = copy.card["conventions"]["intrinsics"]
    ids = {entry["name"]: entry for entry in copy.card["objects"]}
    image = copy.read("instance/000001.png")
    targets = [entry["id"] for entry in copy.card["objects"] if entry["role"] == "target"]
    erased = max(targets, key=lambda one: (image == one).sum())
    rows, columns = np.nonzero(image == erased)
    assert len(rows) > 200
    source_from_world = np.array(copy.card["scene"]["source_from_world"])
    x, y, z, w = frame["quaternion_xyzw"]
    axes = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
    along = np.stack([(columns + 0.5 - lens["cx"]) / lens["fx"],
                      (rows + 0.5 - lens["cy"]) / lens["fy"], np.ones(len(rows))])
    along = source_from_world[:3, :3] @ axes @ along
    start = (source_from_world @ [*frame["position"], 1])[:3, None]
    planes = [("wall_1", 0, 0), ("wall_2", 0, 4), ("floor", 1, 0), ("ceiling", 1, 2.6),
              ("wall_3", 2, 0), ("wall_4", 2, 3)]
    with np.errstate(divide="ignore"):
        depths = np.array([(place - start[axis]) / along[axis] for _, axis, place in planes])
    depths[depths <= 0] = np.inf
    nearest = depths.argmin(axis=0)
    metres = depths.min(axis=0)
    wall = [ids[name] for name, _, _ in planes]
    for name, values in (("instance", [wall[i]["id"] for i in nearest]),
                         ("semantic", [wall[i]["nyu40"] for i in nearest]),
                         ("depth", np.round(1000 * metres))):
        changed = copy.read(f"{name}/000001.png")
        changed[rows, columns] = values
        copy.write(f"{name}/000001.png", changed)
    exact = copy.read("depth_exr/000001.exr")
    exact[rows, columns] = metres
    copy.write("depth_exr/000001.exr", exact)


@found_by("captures")
def nothing_captured_anywhere(copy):
    counted = copy.card["metrics"]["counted"]
    counted["captured"] = 0
    for one in counted["per_object"]:
        one.update(captured=False, best_frame=-1)


@found_by("captures")
def capture_of_a_thing_missing(copy):
    counted = copy.card["metrics"]["counted"]
    gone = counted["per_object"].pop()
    counted["objects"] -= 1
    counted["captured"] -= int(gone["captured"])


@found_by("holes")
def exact_depth_of_nothing(copy):
    copy.edit("depth_exr/000001.exr", lambda image: 0 * image)


@found_by("frames")
def columns_of_one_name(copy):
    def rename(rows):
        rows[0][-2:] = ["frame", "frame"]
    copy.edit_rows("frames.csv", rename)


@found_by("coco")
def annotations_nested_without_end(copy):
    (copy.folder / "annotations.json").write_text("[" * 200_000)


@found_by("imu")
def times_exchanged(copy):
    frames = copy.card["frames"]
    frames[1]["time_s"], frames[2]["time_s"] = frames[2]["time_s"], frames[1]["time_s"]
