"""The datasets whose statistics are tested, and what NumPy and OpenCV make of their files."""
import csv
import json
import math
import shutil

import cv2
import numpy as np

from support import tiny_room
from support.program import FolderCase, run

FRAMES = 14
HOSTILE = "</title><script>window.hacked = 1</script>"
TRACK = {"op": "object_track", "object": "mug", "keys": [
    {"time_s": 0}, {"time_s": 20, "offset": [-2.0, 0.6, 0], "turn_deg": 90}]}
SIZE = ["--set", "width_px=320", "--set", "height_px=240"]
LABELS = {"classes": [{"id": 1, "name": HOSTILE, "matches": ["mug", "sofa"]},
                      {"id": 2, "name": "rest", "matches": ["*"]}]}


def card_of(dataset):
    return json.loads((dataset / "dataset.json").read_text())


def rows_of(file):
    with open(file) as lines:
        return list(csv.DictReader(lines))


def rotation(q):
    x, y, z, w = np.array(q) / np.linalg.norm(q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def height_above_floor(position, objects):
    """Above the highest floor box below the camera."""
    tops = []
    for one in objects:
        box = one["box"]
        (cx, cy, cz), (sx, sy, sz), yaw = box["center"], box["size"], box["yaw_rad"]
        dx, dy = position[0] - cx, position[1] - cy
        along = dx * math.cos(yaw) + dy * math.sin(yaw)
        across = dy * math.cos(yaw) - dx * math.sin(yaw)
        if one["nyu40"] == 2 and abs(along) <= sx / 2 and abs(across) <= sy / 2 and \
                cz + sz / 2 <= position[2]:
            tops.append(cz + sz / 2)
    return position[2] - max(tops, default=0)


def samples_of(dataset):
    """The values of every quantity, from the files of a dataset."""
    card = card_of(dataset)
    lens = card["conventions"]["intrinsics"]
    width, height = lens["width"], lens["height"]
    annotations = json.loads((dataset / "annotations.json").read_text())["annotations"]
    objects = {one["id"]: one for one in card["objects"]}
    values = {"box_share": [], "mask_share": [], "aspect_ratio": [], "distance_m": []}
    per_frame = np.zeros(len(card["frames"]))
    for one in annotations:
        frame = card["frames"][one["image_id"] - 1]
        per_frame[one["image_id"] - 1] += 1
        w, h = one["bbox"][2:]
        values["box_share"].append(w * h / (width * height))
        values["mask_share"].append(one["area"] / (width * height))
        values["aspect_ratio"].append(w / h)
        center = np.array(objects[one["object_id"]]["box"]["center"])
        for moved in frame.get("moving", []):
            if moved["object_id"] == one["object_id"]:
                center = rotation(moved["quaternion_xyzw"]) @ center + moved["position"]
        values["distance_m"].append(np.linalg.norm(center - frame["position"]))
    values["boxes_per_frame"] = per_frame
    values["camera_height_m"] = [height_above_floor(f["position"], card["objects"])
                                 for f in card["frames"]]
    values["camera_pitch_deg"] = [
        math.degrees(math.asin(rotation(f["quaternion_xyzw"])[2, 2])) for f in card["frames"]]
    table = rows_of(dataset / "frames.csv")
    for name in ("speed_mps", "turn_dps"):
        values[name] = [float(row[name]) for row in table if row[name]]
    values["best_visible_fraction"] = [
        row["visible_fraction"] for row in card["metrics"]["counted"]["per_object"]
        if row["visible_fraction"] > 0 and objects[row["object_id"]]["role"] == "target"]
    for name in ("visible_fraction", "truncation"):
        file = dataset / "instances.csv"
        values[name] = [float(row[name]) for row in rows_of(file)] if file.exists() else []
    values.update(luma=[], depth_m=[])
    step = int(math.sqrt(width * height / 4800))
    for i in range(len(card["frames"])):
        image = cv2.imread(str(dataset / "rgb" / f"{i:06d}.png"))
        values["luma"].append((image @ np.array([19, 183, 54])).mean() / 256)
        depth = cv2.imread(str(dataset / "depth" / f"{i:06d}.png"), cv2.IMREAD_UNCHANGED)
        depth = depth[step // 2::step, step // 2::step]
        values["depth_m"].extend(depth[depth > 0] / 1000)
    return {name: np.array(one, float) for name, one in values.items()}


class StatisticsCase(FolderCase):
    """`whole` has instances.csv and a moving object; `part` has its first frames and the default
    files; `hostile` has hostile names."""
    keeps_cache = True

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        tiny_room.write(cls.folder / "room.obj")
        project = cls.folder / "room.dolly"
        labels = cls.folder / "labels.json"
        labels.write_text(json.dumps(LABELS))
        cls.whole, cls.part = cls.folder / "whole", cls.folder / "part"
        cls.hostile = cls.folder / "hostile"
        for command in [
            ["plan", cls.folder / "room.obj", "--max-frames", FRAMES, "-o", project, *SIZE],
            ["edit", project, "--op", json.dumps(TRACK), "--plan"],
            ["export", project, "--out", cls.whole, "--formats",
             "coco,camera_json,frames,imu,instances"],
            ["export", project, "--out", cls.part, "--range", "0:6"],
            ["export", project, "--out", cls.hostile, "--range", "0:6", "--labels", labels],
        ]:
            made = run(*command)
            assert made.returncode in (0, 3), made.stderr
        card = card_of(cls.hostile)
        for one in card["objects"]:
            one["name"] = {"mug": "mug" + HOSTILE, "sofa": "sofa\u202e<b>"}.get(one["name"],
                                                                               one["name"])
        card["scene"]["file"] = HOSTILE
        (cls.hostile / "dataset.json").write_text(json.dumps(card))

    @classmethod
    def page_of(cls, *arguments):
        made = run("statistics", *arguments)
        assert made.returncode == 0, made.stderr
        return made

    def numbers_of(self, *datasets):
        page = self.folder / "numbers.html"
        return json.loads(self.page_of(*datasets, "-o", page, "--overwrite", "--json").stdout)

    def changed_copy(self, dataset, name, change):
        """A copy of the dataset with another dataset.json."""
        copy = self.folder / name
        shutil.copytree(dataset, copy)
        card = card_of(copy)
        change(card)
        (copy / "dataset.json").write_text(json.dumps(card))
        return copy
