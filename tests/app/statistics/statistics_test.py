#!/usr/bin/python3
"""The numbers of `statistics` against NumPy and OpenCV, and the command's files and exit codes.

Usage: statistics_test.py PROGRAM [unittest arguments]
"""
import json
import re
import shutil
import unittest

import cv2
import numpy as np

from statistics_case import FRAMES, HOSTILE, StatisticsCase, card_of, rows_of, samples_of
from support.program import run


class Numbers(StatisticsCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        page = cls.folder / "both.html"
        cls.numbers = json.loads(cls.page_of(cls.whole, cls.part, "-o", page, "--json").stdout)
        cls.samples = [samples_of(cls.whole), samples_of(cls.part)]

    def annotations(self, dataset):
        return json.loads((dataset / "annotations.json").read_text())["annotations"]

    def test_classes_are_those_of_the_annotations(self):
        for dataset, shown in zip((self.whole, self.part), self.numbers["datasets"]):
            card, annotations = card_of(dataset), self.annotations(dataset)
            classes = {one["id"]: one["name"] for one in card["classes"]}
            captured = {row["object_id"]: row for row in card["metrics"]["counted"]["per_object"]}
            targets = [one for one in card["objects"] if one["role"] == "target"]
            expected = []
            for number, name in classes.items():
                boxes = [one for one in annotations if one["category_id"] == number]
                # In NYU40, boxes of objects of unknown class are "otherprop" (40).
                in_class = [one["id"] for one in targets if (one["nyu40"] or 40) == number]
                if number and (boxes or in_class):
                    expected.append({
                        "id": number, "name": name, "boxes": len(boxes),
                        "frames": len({one["image_id"] for one in boxes}),
                        "objects": len({one["object_id"] for one in boxes}),
                        "targets": len(in_class),
                        "captured": sum(captured[one]["captured"] for one in in_class),
                        "well_captured": sum(captured[one]["well_captured"] for one in in_class)})
            self.assertGreater(len(expected), 2)
            self.assertEqual(shown["classes"], expected)

    def test_histograms_are_those_of_numpy(self):
        shown = self.numbers["datasets"]
        self.assertEqual(set(self.numbers["bin_edges"]), set(self.samples[0]))
        for name, edges in self.numbers["bin_edges"].items():
            self.assertEqual(edges, sorted(set(edges)))
            self.assertLess(len(edges), 60)
            for one, samples in zip(shown, self.samples):
                with self.subTest(name=name, dataset=one["name"]):
                    values, histogram = samples[name], one["histograms"][name]
                    counts = np.histogram(values, edges)[0]
                    self.assertEqual(histogram["counts"], counts.tolist())
                    self.assertEqual(histogram["values"], len(values))
                    self.assertEqual(histogram["beyond"], len(values) - counts.sum())
                    self.assertLessEqual(histogram["beyond"], 0.01 * len(values))
                    if not len(values):
                        self.assertNotIn("median", histogram)
                        continue
                    for key, share in (("p10", 0.1), ("median", 0.5), ("p90", 0.9)):
                        self.assertAlmostEqual(histogram[key], np.quantile(values, share), places=9)

    def test_axes_are_as_documented(self):
        edges = self.numbers["bin_edges"]
        np.testing.assert_allclose(np.diff(np.log10(edges["box_share"])), 0.2, atol=1e-9)
        np.testing.assert_allclose(np.diff(np.log2(edges["aspect_ratio"])), 0.25, atol=1e-9)
        np.testing.assert_allclose(edges["visible_fraction"], np.arange(21) / 20)
        self.assertEqual(edges["boxes_per_frame"][:2], [-0.5, 0.5])
        self.assertEqual(edges["distance_m"][0], 0)

    def test_the_heat_map_counts_box_centres(self):
        for dataset, shown in zip((self.whole, self.part), self.numbers["datasets"]):
            boxes = np.array([one["bbox"] for one in self.annotations(dataset)], float)
            x, y = boxes[:, 0] + boxes[:, 2] / 2, boxes[:, 1] + boxes[:, 3] / 2
            expected = np.histogram2d(y, x, (24, 32), ((0, 240), (0, 320)))[0]
            self.assertEqual(shown["box_center_heat_map"], expected.astype(int).tolist())

    def test_the_overview(self):
        for dataset, shown, samples in zip((self.whole, self.part), self.numbers["datasets"],
                                           self.samples):
            card, overview = card_of(dataset), shown["overview"]
            annotations, frames = self.annotations(dataset), card["frames"]
            step = [np.linalg.norm(np.subtract(b["position"], a["position"]))
                    for a, b in zip(frames, frames[1:])]
            border = sum(x == 0 or y == 0 or x + w == 320 or y + h == 240
                         for x, y, w, h in (one["bbox"] for one in annotations))
            pictures, counted = card["metrics"]["pictures"], card["metrics"]["counted"]
            expected = {
                "frames": len(frames), "width_px": 320, "height_px": 240,
                "duration_s": frames[-1]["time_s"] - frames[0]["time_s"],
                "targets": counted["objects"], "captured": counted["captured"],
                "capture_rate": counted["capture_rate"],
                "well_captured_rate": counted["well_captured_rate"],
                "classes": len({one["category_id"] for one in annotations}),
                "boxes": len(annotations), "boxes_per_frame": len(annotations) / len(frames),
                "boxes_at_border_rate": border / len(annotations),
                "box_share_median": np.median(samples["box_share"]),
                "distance_median_m": np.median(samples["distance_m"]),
                "speed_median_mps": np.median(samples["speed_mps"]),
                "turn_median_dps": np.median(samples["turn_dps"]),
                "luma_median": np.median(samples["luma"]), "dark_rate": pictures["dark_rate"],
                "white_rate": pictures["white_rate"], "flat_rate": pictures["flat_rate"]}
            path_m = overview.pop("path_length_m")
            rows = rows_of(dataset / "frames.csv")
            moved = [s for s, row in zip(step, rows[1:]) if row["speed_mps"]]
            self.assertAlmostEqual(path_m, sum(moved), delta=1e-4 * path_m)
            self.assertEqual(set(overview), set(expected))
            for name, value in expected.items():
                self.assertAlmostEqual(overview[name], value, places=9, msg=name)

    def test_one_box_less_is_one_box_less(self):
        copy = self.changed_copy(self.part, "less", lambda card: None)
        file = copy / "annotations.json"
        coco = json.loads(file.read_text())
        gone = coco["annotations"].pop()
        file.write_text(json.dumps(coco))
        before, after = self.numbers_of(self.part, copy)["datasets"]
        self.assertEqual(after["overview"]["boxes"], before["overview"]["boxes"] - 1)
        boxes = [{row["id"]: row["boxes"] for row in one["classes"]} for one in (before, after)]
        boxes[0][gone["category_id"]] -= 1
        self.assertEqual(*boxes)

    def test_datasets_of_a_folder_are_counted_together(self):
        around = self.folder / "around"
        for name, dataset in (("one", self.whole), ("two", self.part)):
            shutil.copytree(dataset, around / name)
        numbers = self.numbers_of(around, self.whole, self.part)
        together, *alone = numbers["datasets"]
        self.assertEqual([one["datasets"] for one in numbers["datasets"]], [2, 1, 1])
        self.assertEqual([one["name"] for one in numbers["datasets"]], ["around", "whole", "part"])
        for name in ("frames", "duration_s", "path_length_m", "targets", "captured", "boxes"):
            self.assertAlmostEqual(together["overview"][name],
                                   sum(one["overview"][name] for one in alone), msg=name)
        self.assertEqual(together["overview"]["boxes_per_frame"],
                         together["overview"]["boxes"] / together["overview"]["frames"])
        for row in together["classes"]:
            same = [next((other for other in one["classes"] if other["name"] == row["name"]), None)
                    for one in alone]
            for name in ("boxes", "frames", "objects", "targets", "captured", "well_captured"):
                self.assertEqual(row[name], sum(one[name] for one in same if one), msg=row["name"])
        for name, edges in numbers["bin_edges"].items():
            values = np.concatenate([samples[name] for samples in self.samples])
            histogram = together["histograms"][name]
            self.assertEqual(histogram["counts"], np.histogram(values, edges)[0].tolist(), msg=name)
            if len(values):
                self.assertAlmostEqual(histogram["median"], np.median(values))
        np.testing.assert_array_equal(together["box_center_heat_map"], np.sum(
            [one["box_center_heat_map"] for one in alone], axis=0))
        page = (self.folder / "numbers.html").read_text()
        self.assertIn(f"2 datasets, {FRAMES + 6} frames", page)
        self.assertRegex(page, "around</span>, one, frame")


class Command(StatisticsCase):
    def test_equal_input_gives_equal_bytes(self):
        pages = []
        for threads in ("1", "3"):
            page = self.folder / f"threads{threads}.html"
            said = self.page_of(self.whole, self.part, "-o", page, "--threads", threads).stdout
            self.assertIn(f"2 datasets, {FRAMES + 6} frames", said)
            pages.append(page.read_bytes())
        self.assertEqual(pages[0], pages[1])
        self.assertLess(len(pages[0]), 2_000_000)

    def test_the_page_lies_beside_the_first_dataset_unasked(self):
        self.page_of(f"{self.part}/")
        self.assertTrue((self.folder / "part-statistics.html").is_file())
        self.assertFails(run("statistics", self.part), 2, "--overwrite")

    def test_the_page_needs_nothing_else(self):
        page = self.folder / "alone.html"
        self.page_of(self.whole, "-o", page)
        text = page.read_text()
        self.assertNotRegex(text, r"<script|<link|https?://|url\(")
        self.assertEqual(len(re.findall(r'class="example"', text)), 8)
        both = self.folder / "alone2.html"
        self.page_of(self.whole, self.part, "-o", both)
        self.assertEqual(len(re.findall(r'class="example"', both.read_text())), 8)

    def test_six_large_datasets_stay_below_the_limit(self):
        """Long names, 300 classes with boxes, many boxes per frame, images of noise."""
        def change(card):
            rules = [{"id": i, "name": f"{i}" + "<é" * 32, "matches": [f"thing{i}<*"]}
                     for i in range(1, 301)]
            card["labels"] = {"classes": rules}
            sample = card["objects"][-1]
            card["objects"] = [{**sample, "id": i, "role": "target", "name": f"thing{i}" + "<é" * 500,
                                "class_id": i} for i in range(1, 301)]
            card["metrics"]["counted"]["per_object"] = []
            frame = card["frames"][0]
            card["frames"] = [{**frame, "index": i, "time_s": 0.1 * i} for i in range(1000)]
            card["formats"] = ["coco"]
        copy = self.changed_copy(self.part, "large", change)
        coco = {"annotations": [
            {"image_id": i // 100 + 1, "category_id": i % 300 + 1, "object_id": i % 300 + 1,
             "bbox": [i * 7 % 319, i * 11 % 239, 1, 1], "area": 1} for i in range(100_000)]}
        (copy / "annotations.json").write_text(json.dumps(coco))
        noise = np.random.default_rng(1).integers(0, 256, (240, 320, 3), np.uint8)
        for i in range(1000):
            cv2.imwrite(str(copy / "rgb" / f"{i:06d}.png"), noise)
        page = self.folder / "large.html"
        self.page_of(*[copy] * 6, "-o", page)
        self.assertLess(page.stat().st_size, 2_000_000)
        self.assertIn("200 more classes", page.read_text())
        self.assertEqual(page.read_text().count("class=\"example\""), 6)
        self.page_of(copy, "-o", page, "--overwrite")
        self.assertLess(page.stat().st_size, 2_000_000)
        self.assertEqual(page.read_text().count("class=\"example\""), 8)

    def test_examples_of_many_datasets_are_not_all_their_first_frames(self):
        folder = self.folder / "many"
        for name in range(8):
            self.changed_copy(self.part, f"many/{name}", lambda card: None)
        page = self.folder / "many.html"
        self.page_of(folder, "-o", page)
        shown = re.findall(r"<figcaption>.*?frame (\d+)", page.read_text())
        self.assertEqual(len(shown), 8)
        self.assertGreater(len(set(shown)), 3)

    def test_names_are_escaped(self):
        page = self.folder / "hostile.html"
        numbers = json.loads(self.page_of(self.hostile, self.part, "-o", page, "--json").stdout)
        self.assertIn(HOSTILE, [row["name"] for row in numbers["datasets"][0]["classes"]])
        text = page.read_text()
        self.assertNotIn("<script", text)
        self.assertNotIn("\u202e", text)
        self.assertNotIn("sofa<b>", text)
        self.assertIn("sofa&lt;b&gt;", text)
        self.assertIn("&lt;script&gt;", text)
        self.assertEqual(text.count("</title>"), text.count("<title>"))

    def test_datasets_of_one_name_are_numbered(self):
        other, third = (self.folder / name / "part" for name in ("other", "third"))
        shutil.copytree(self.part, other)
        shutil.copytree(self.part, third)
        page = self.folder / "named.html"
        made = self.page_of(self.part, other, f"{third}/", "-o", page, "--json")
        self.assertEqual([one["name"] for one in json.loads(made.stdout)["datasets"]],
                         ["part", "part (2)", "part (3)"])
        self.assertNotIn(str(self.folder), page.read_text() + made.stdout)

    def test_equal_pitch_is_one_bar(self):
        """The pitch of turned cameras differs by rounding only."""
        def change(card):
            x, y, z, w = card["frames"][0]["quaternion_xyzw"]
            for i, frame in enumerate(card["frames"]):
                c, s = np.cos(0.37 * i), np.sin(0.37 * i)
                frame["quaternion_xyzw"] = [c * x - s * y, c * y + s * x, c * z + s * w,
                                            c * w - s * z]
                frame["time_s"] = 999.7 * i / 5
        copy = self.changed_copy(self.part, "equal", change)
        pitch = samples_of(copy)["camera_pitch_deg"]
        self.assertLess(0, np.ptp(pitch))
        self.assertLess(np.ptp(pitch), 1e-9)
        numbers = self.numbers_of(copy)
        edges = np.array(numbers["bin_edges"]["camera_pitch_deg"])
        self.assertGreater(np.diff(edges).min(), 1e-6)
        counts = numbers["datasets"][0]["histograms"]["camera_pitch_deg"]["counts"]
        self.assertEqual(sum(counts), 6)
        self.assertLessEqual(np.count_nonzero(counts), 2)  # rounding may meet an edge
        page = (self.folder / "numbers.html").read_text()
        chart = re.search(r'data-chart="camera_pitch_deg".*?</figure>', page, re.S)[0]
        ticks = re.findall(r'class="x">(.*?)</text>', chart)
        self.assertGreater(len(ticks), 2)
        self.assertEqual(len(ticks), len(set(ticks)))
        # 999.7 s, with three digits.
        self.assertIn("<tr><th>duration, s</th><td class=\"first\">1,000</td></tr>", page)

    def test_classes_with_few_boxes_keep_their_captures(self):
        """20 classes have boxes, another one the only target."""
        def change(card):
            names = [f"many{i}" for i in range(1, 21)] + ["rare"]
            card["labels"] = {"classes": [{"id": i, "name": name, "matches": [name]}
                                          for i, name in enumerate(names, 1)]}
            sample = card["objects"][-1]
            card["objects"] = [{**sample, "id": i, "name": name, "class_id": i,
                                "role": "target" if name == "rare" else "context"}
                               for i, name in enumerate(names, 1)]
            card["metrics"]["counted"]["per_object"] = []
            card["formats"], card["modalities"] = ["coco"], []
            for frame in card["frames"]:
                frame.pop("moving", None)
        copy = self.changed_copy(self.part, "rare", change)
        (copy / "annotations.json").write_text(json.dumps({"annotations": [
            {"image_id": 1, "category_id": i, "object_id": i, "bbox": [0, 0, 5, 5], "area": 9}
            for i in range(1, 21)]}))
        page = self.folder / "rare.html"
        self.page_of(copy, "-o", page)
        charts = dict(re.findall(r'data-chart="(\w+)">(.*?)</figure>', page.read_text(), re.S))
        self.assertIn(">rare<", charts["captured_by_class"])
        self.assertNotIn("many", charts["captured_by_class"])
        self.assertNotIn(">rare<", charts["boxes_by_class"])
        self.assertIn("The 15 classes with the most boxes.", charts["boxes_by_class"])

    def test_without_tables_their_numbers_are_missing(self):
        copy = self.changed_copy(self.part, "few", lambda card: card.update(
            formats=["camera_json"], modalities=[]))
        for name in ("annotations.json", "frames.csv"):
            (copy / name).unlink()
        shutil.rmtree(copy / "rgb")
        page = self.folder / "few.html"
        numbers = json.loads(self.page_of(copy, "-o", page, "--json").stdout)
        self.assertEqual(set(numbers["bin_edges"]),
                         {"best_visible_fraction", "camera_height_m", "camera_pitch_deg"})
        self.assertIsNone(numbers["datasets"][0]["overview"]["boxes"])
        for words in ("coco in --formats", "frames in --formats", "instances in --formats",
                      "rgb in --modalities", "depth in --modalities"):
            self.assertIn(words, page.read_text())
        # Beside a whole dataset, there is no heat map of nothing.
        self.page_of(copy, self.part, "-o", page, "--overwrite")
        self.assertEqual(page.read_text().count('data-chart="box_centers"'), 1)
        self.assertIn("depth at a grid", page.read_text())
        card = card_of(copy)
        card.update(modalities=["rgb"])
        (copy / "dataset.json").write_text(json.dumps(card))
        shutil.copytree(self.part / "rgb", copy / "rgb")
        self.page_of(copy, "-o", page, "--overwrite")
        self.assertIn("Measured in 6 evenly spaced frames.", page.read_text())

    def test_without_speeds_there_is_no_path_length(self):
        copy = self.changed_copy(self.part, "still", lambda card: None)
        head, *rows = (copy / "frames.csv").read_text().splitlines()
        columns = [head.split(",").index(name) for name in ("speed_mps", "turn_dps")]
        rows = [",".join("" if i in columns else field for i, field in enumerate(row.split(",")))
                for row in rows]
        (copy / "frames.csv").write_text("\n".join([head, *rows]) + "\n")
        before, after = self.numbers_of(self.part, copy)["datasets"]
        self.assertGreater(before["overview"]["path_length_m"], 0)
        self.assertIsNone(after["overview"]["path_length_m"])

    def test_damaged_images_are_told(self):
        copy = self.changed_copy(self.part, "images", lambda card: None)
        (copy / "rgb" / "000000.png").write_bytes(b"no picture")
        (copy / "depth" / "000003.png").unlink()
        shutil.copy(copy / "depth" / "000001.png", copy / "rgb" / "000002.png")
        made = self.page_of(copy, "-o", self.folder / "images.html", "--json")
        self.assertIn("missing or damaged images: 3;", made.stderr)
        histograms = json.loads(made.stdout)["datasets"][0]["histograms"]
        self.assertEqual(histograms["luma"]["values"], 4)

    def test_what_is_no_dataset_is_told(self):
        empty = self.folder / "empty"
        empty.mkdir()
        self.assertFails(run("statistics", empty), 4, "no dataset", "empty")
        (empty / "loop").symlink_to(empty)
        self.assertFails(run("statistics", empty), 4, "no dataset", "empty")
        self.assertFails(run("statistics", self.part, empty, "-o", self.folder / "x.html"), 4,
                         "no dataset", "empty")
        self.assertFails(run("statistics", self.folder / "nowhere"), 4, "does not exist")
        self.assertFails(run("statistics", self.folder / "room.obj"), 4, "path is a file")
        foreign = self.folder / "foreign"
        foreign.mkdir()
        (foreign / "dataset.json").write_text('{"images": []}')
        self.assertFails(run("statistics", foreign), 4, "not the dataset.json")
        rooms = self.folder / "rooms"
        rooms.mkdir()
        (rooms / "rooms.json").write_text('{"rooms": [{"name": "kitchen"}, {"name": "hall"}]}')
        self.assertFails(run("statistics", rooms), 4, "rooms/kitchen")
        gathered = self.folder / "gathered"
        gathered.mkdir()
        (gathered / "gather.json").write_text("{}")
        self.assertFails(run("statistics", gathered), 4, "gathered")
        none = self.changed_copy(self.part, "none", lambda card: card.update(frames=[]))
        self.assertFails(run("statistics", none), 4, "no frames")
        self.assertFails(run("statistics", *[self.part] * 7), 2, "at most 6")
        self.assertEqual(list(self.folder.glob("*x.html")), [])

    def test_damaged_datasets_of_a_folder_are_left_out_when_asked(self):
        around = self.folder / "damaged_one"
        for name in ("a", "b", "c"):
            shutil.copytree(self.part, around / name)
        (around / "b" / "annotations.json").write_text("{")
        page = self.folder / "left_out.html"
        self.assertFails(run("statistics", around, "-o", page), 4, "b/annotations.json")
        self.assertFalse(page.exists())
        made = self.page_of(around, "-o", page, "--skip-damaged")
        self.assertIn("b: left out", made.stderr)
        self.assertIn("2 datasets, 12 frames", made.stdout)
        said = self.page_of(f"{around}/?", "-o", page, "--overwrite", "--skip-damaged").stdout
        self.assertIn("2 datasets, 12 frames", said)
        for name in ("a", "c"):
            shutil.rmtree(around / name)
        self.assertFails(run("statistics", around, "-o", page, "--overwrite", "--skip-damaged"), 4,
                         "no complete dataset")

    def test_datasets_of_a_folder_have_one_image_size(self):
        around = self.folder / "sizes"
        for name in ("a", "b"):
            shutil.copytree(self.part, around / name)
        card = card_of(around / "b")
        card["conventions"]["intrinsics"]["width"] = 400
        (around / "b" / "dataset.json").write_text(json.dumps(card))
        self.assertFails(run("statistics", around, "-o", self.folder / "sizes.html"), 4, "400 x 240",
                         "320 x 240", "sizes/b")

    def test_files_beside_folders_are_left_out(self):
        beside = self.folder / "beside.html"
        beside.write_text("a page")
        made = run("statistics", beside, self.part, "-o", self.folder / "without.html")
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertIn("beside.html: not a folder; left out", made.stderr)
        self.assertIn("1 dataset,", made.stdout)

    def test_what_is_in_the_way_stays(self):
        other = self.folder / "other.txt"
        other.write_text("mine")
        link = self.folder / "link.html"
        link.symlink_to(other)
        for more in ([], ["--overwrite"]):
            self.assertFails(run("statistics", self.part, "-o", link, *more), 6, "link.html")
        self.assertEqual(other.read_text(), "mine")
        self.assertFails(run("statistics", self.part, "-o", self.folder), 6, "folder")
        self.assertFails(run("statistics", self.part, "-o", self.folder / "no" / "x.html"), 6, "no")

    def test_damaged_tables_are_refused(self):
        copy = self.changed_copy(self.whole, "damaged", lambda card: None)
        coco = json.loads((copy / "annotations.json").read_text())

        def refuses(file, text, *words):
            whole = (copy / file).read_text()
            (copy / file).write_text(text)
            with self.subTest(file=file, words=words, text=text[-60:]):
                self.assertFails(run("statistics", copy, "-o", self.folder / "bad.html"), 4, file,
                                 *words)
            (copy / file).write_text(whole)

        for change in ({"image_id": 0}, {"image_id": FRAMES + 1}, {"image_id": 1.5},
                       {"image_id": 1 << 64}, {"category_id": 99}, {"category_id": 0},
                       {"object_id": 12345}, {"bbox": [0, 0, 0, 5]}, {"bbox": [300, 0, 30, 5]},
                       {"bbox": [-1, 0, 30, 5]}, {"bbox": [0, 0, 5]}, {"bbox": "all"},
                       {"area": 0}, {"area": 1e9}, {"area": None}):
            bad = {**coco, "annotations": [{**coco["annotations"][0], **change}]}
            refuses("annotations.json", json.dumps(bad), "in an annotation".capitalize())
        text = (copy / "annotations.json").read_text()
        refuses("annotations.json", text[:len(text) // 2])
        refuses("annotations.json", "")
        text = (copy / "frames.csv").read_text()
        refuses("frames.csv", text[:text.rindex("\n", 0, -1) + 1], f"{FRAMES - 1} rows")
        rows = text.splitlines()
        fields = rows[3].split(",")
        for column in ("speed_mps", "turn_dps"):
            for value in ("1e300", "-1", "abc", ""):
                changed = list(fields)
                changed[rows[0].split(",").index(column)] = value
                refuses("frames.csv", "\n".join([*rows[:3], ",".join(changed), *rows[4:]]) + "\n",
                        column, "frames.csv:4")
            refuses("frames.csv", text.replace(column, "other", 1), f'no column "{column}"')
        text = (copy / "instances.csv").read_text()
        refuses("instances.csv", text.replace("visible_fraction", "other", 1), "visible_fraction")
        refuses("instances.csv", text.splitlines()[0] + "\n1,2\n", "values for")
        for name in ("annotations.json", "frames.csv", "instances.csv"):
            (copy / name).rename(copy / "away")
            self.assertFails(run("statistics", copy, "-o", self.folder / "bad.html"), 4, name)
            (copy / "away").rename(copy / name)
        text = (copy / "dataset.json").read_text()
        refuses("dataset.json", text[:len(text) // 2])
        card = json.loads(text)
        card["frames"][1]["time_s"] = 1e300
        refuses("dataset.json", json.dumps(card), "frames[1]")
        card = json.loads(text)
        card["metrics"]["pictures"]["dark"] = 3
        refuses("dataset.json", json.dumps(card), "metrics.pictures")
        self.assertFalse((self.folder / "bad.html").exists())


if __name__ == "__main__":
    unittest.main()
