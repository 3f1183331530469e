"""Damages labels of objects: classes, instances.csv, amodal masks, COCO's annotations and folds."""
import json

import numpy as np

from corruptions import found_by


# --- class and instance images

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


@found_by("classes")
def object_that_does_not_exist(copy):
    def foreign(ids):
        ids[20, 30] = 9999
        return ids
    copy.edit("instance/000001.png", foreign)


# --- instances.csv

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


# --- amodal masks

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


# --- annotations.json

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


@found_by("coco")
def annotations_nested_without_end(copy):
    (copy.folder / "annotations.json").write_text("[" * 200_000)


# --- annotations_polygons.json

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


# --- folds

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
