"""Contradictions in dataset.json: conventions, classes, relations, metrics and boxes."""
from corruptions import found_by


@found_by("card")
def focal_length(copy):
    copy.card["conventions"]["intrinsics"]["fx"] *= 1.01


@found_by("card")
def principal_point_by_half_a_pixel(copy):
    copy.card["conventions"]["intrinsics"]["cx"] -= 0.5


@found_by("scene")
def transform_to_the_scene_file(copy):
    copy.card["scene"]["source_from_world"][0][0] += 0.01


@found_by("card")
def depth_scale_said(copy):
    copy.card["conventions"]["depth"]["scale_m"] = 0.0002


@found_by("card")
def class_table_shifted(copy):
    names = [row["name"] for row in copy.card["classes"]]
    for row, name in zip(copy.card["classes"], names[1:] + names[:1]):
        row["name"] = name


@found_by("card")
def colour_of_a_class(copy):
    copy.card["classes"][5]["color"][0] ^= 1


@found_by("card")
def misspelt_key_of_a_class(copy):
    row = copy.card["classes"][5]
    row["colour"] = row.pop("color")


@found_by("card")
def relation_to_nothing(copy):
    related = next(one for one in copy.card["objects"] if one["relations"])
    related["relations"][0]["id"] = len(copy.card["objects"]) + 1


@found_by("scene")
def box_of_an_object(copy):
    copy.card["objects"][-1]["box"]["center"][0] += 0.3


# --- captures

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
