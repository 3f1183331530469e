"""OpenCV paints the labels of every format; the result must be the instance image."""
import json
import unittest

import numpy as np

import exports


class Labels(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        try:
            global cv2
            import cv2
        except ImportError:
            exports.missing("OpenCV", "python3-opencv")
        cls.data = exports.walk()
        cls.objects = {entry["id"]: entry for entry in cls.data.card["objects"]}

    def instance(self, index):
        return cv2.imread(self.data.file("instance", index), cv2.IMREAD_UNCHANGED)

    def paint(self, polygons):
        """Pixels whose centres are inside any polygon; corners are on a grid four times as fine."""
        fine = np.zeros((4 * self.data.height, 4 * self.data.width), np.uint8)
        for polygon in polygons:
            # The outline itself counts as inside for OpenCV: the centres are two steps away.
            cv2.fillPoly(fine, [np.round(4 * np.reshape(polygon, (-1, 2))).astype(np.int32)], 1)
        return fine[2::4, 2::4]

    def test_coco_polygons_cover_the_masks(self):
        coco = json.loads((self.data.folder / "annotations_polygons.json").read_text())
        whole = json.loads((self.data.folder / "annotations.json").read_text())
        self.assertEqual([a["bbox"] for a in coco["annotations"]],
                         [a["bbox"] for a in whole["annotations"]])
        checked = 0
        for annotation in coco["annotations"]:
            index = annotation["image_id"] - 1
            self.assertLessEqual(0, annotation["attributes"]["visible_fraction"])
            self.assertLessEqual(annotation["attributes"]["visible_fraction"], 1)
            if index % 13 != 0:
                continue
            mask = self.instance(index) == annotation["object_id"]
            self.assertEqual(mask.sum(), annotation["area"])
            painted = self.paint(annotation["segmentation"]) == 1
            self.assertTrue(painted[mask].all())
            # The polygons may only add pixels that the mask encloses.
            outside = cv2.copyMakeBorder(mask.astype(np.uint8), 1, 1, 1, 1, cv2.BORDER_CONSTANT)
            cv2.floodFill(outside, None, (0, 0), 2, flags=4)
            self.assertFalse(((outside[1:-1, 1:-1] == 2) & painted).any())
            checked += 1
        self.assertGreater(checked, 5)

    def test_yolo_boxes_are_those_of_coco(self):
        coco = json.loads((self.data.folder / "annotations.json").read_text())
        for index in (0, 13, 26):
            expected = sorted((a["category_id"] - 1, *a["bbox"]) for a in coco["annotations"]
                              if a["image_id"] == index + 1)
            found = []
            with open(self.data.file("labels", index, ".txt")) as file:
                for line in file:
                    number, x, y, w, h = map(float, line.split())
                    w, h = w * self.data.width, h * self.data.height
                    found.append((number, x * self.data.width - w / 2,
                                  y * self.data.height - h / 2, w, h))
            self.assertEqual(len(found), len(expected))
            if found:
                self.assertLess(np.abs(np.array(sorted(map(tuple, np.round(found)))) -
                                       expected).max(), 1e-9)
                self.assertLess(np.abs(np.array(found) - np.round(found)).max(), 1e-2)

    def test_bop_masks_and_poses_agree(self):
        truth, info, cameras = (json.loads((self.data.folder / name).read_text()) for name in
                                ("scene_gt.json", "scene_gt_info.json", "scene_camera.json"))
        checked = 0
        for index in (0, 13, 26):
            key, instance = str(index), self.instance(index)
            camera = cameras[key]
            w2c = np.eye(4)
            w2c[:3, :3] = np.reshape(camera["cam_R_w2c"], (3, 3))
            w2c[:3, 3] = np.array(camera["cam_t_w2c"]) / 1000
            self.assertLess(np.abs(w2c @ self.data.pose(index) - np.eye(4)).max(), 1e-9)
            for number, (entry, facts) in enumerate(zip(truth[key], info[key])):
                seen = instance == entry["obj_id"]
                visible, whole = (cv2.imread(str(
                    self.data.folder / folder / f"{index:06d}_{number:06d}.png"),
                    cv2.IMREAD_UNCHANGED) == 255 for folder in ("mask_visib", "mask"))
                self.assertTrue((visible == seen).all())
                self.assertTrue(whole[visible].all())
                self.assertEqual(facts["px_count_visib"], visible.sum())
                self.assertEqual(facts["px_count_valid"], whole.sum())
                ys, xs = np.nonzero(seen)
                self.assertEqual(facts["bbox_visib"], [xs.min(), ys.min(), np.ptp(xs) + 1,
                                                       np.ptp(ys) + 1])
                box = self.objects[entry["obj_id"]]["box"]
                centre = (w2c @ [*box["center"], 1])[:3]
                self.assertLess(np.abs(centre * 1000 - entry["cam_t_m2c"]).max(), 1e-6)
                checked += 1
        self.assertGreater(checked, 5)

    def test_kitti_boxes_stand_where_the_objects_do(self):
        for index in (0, 13, 26):
            with open(self.data.file("label_2", index, ".txt")) as file:
                lines = [line.split() for line in file]
            self.assertTrue(lines)
            centres = []
            for line in lines:
                self.assertEqual(len(line), 15)
                h, w, l, x, y, z = map(float, line[8:14])
                up = np.linalg.inv(self.data.pose(index)[:3, :3]) @ [0, 0, 1]
                centres.append(self.data.pose(index) @ [*(np.array([x, y, z]) + up * h / 2), 1])
            for centre in centres:
                nearest = min(np.abs(np.subtract(centre[:3], entry["box"]["center"])).max()
                              for entry in self.objects.values())
                self.assertLess(nearest, 1e-4)
