"""Tests the judges that learn from frames or render new views, on tiny datasets with known results.

Needs no program: the datasets are written here. Tests that need torch or Open3D are skipped where
these are missing.
"""
import importlib.util
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

JUDGES = pathlib.Path(__file__).resolve().parents[3] / "app" / "outcomes" / "judges"
sys.path.insert(0, str(JUDGES))
import detection_scores  # noqa: E402
import detector  # noqa: E402
import dataset  # noqa: E402
import novel_views  # noqa: E402
import slam  # noqa: E402

import cv2  # noqa: E402
import numpy as np  # noqa: E402

HAS_TORCH = importlib.util.find_spec("torch") is not None
HAS_OPEN3D = importlib.util.find_spec("open3d") is not None
WIDTH, HEIGHT = 96, 72
CLASSES = {5: (200, 40, 40), 7: (40, 60, 210)}   # NYU40's chair and table, and their colours here
WALL = 1


RUN_SFM = """import sys
sys.path.insert(0, sys.argv.pop(1))
import dataset, sfm
sys.argv[0] = sfm.__file__
dataset.run(lambda: "", None, sfm.OPTIONS)
"""
RUN_RAISING = """import sys
sys.path.insert(0, sys.argv.pop(1))
import dataset
sys.argv[0] = dataset.__file__
def measure(data, request, entry):
    if entry["planner"] == "bad":
        raise ZeroDivisionError
    return {"one": 1}
dataset.run(lambda: "", lambda request: dataset.judge_entries("j", request, measure, {"one": {}}))
"""


def write_dataset(folder, frames, poses=None, depths=None):
    """A dataset of (rgb, instance) frames; object 1 is the wall, 2 a chair, 3 a table."""
    classes = {1: WALL, 2: 5, 3: 7}
    lookup = np.array([0, WALL, 5, 7], np.uint8)
    for index, (rgb, instance) in enumerate(frames):
        depth = depths[index] if depths else np.full(instance.shape, 2000, np.uint16)
        for name, image in (("rgb", rgb[..., ::-1]), ("instance", instance.astype(np.uint16)),
                            ("semantic", lookup[instance]), ("depth", depth)):
            (folder / name).mkdir(parents=True, exist_ok=True)
            cv2.imwrite(str(folder / name / f"{index:06d}.png"), image)
    height, width = frames[0][1].shape
    focus = width / 2 / np.tan(np.radians(30))
    intrinsics = {"width": width, "height": height, "fx": focus, "fy": focus,
                  "cx": width / 2, "cy": height / 2}
    about = {"conventions": {"intrinsics": intrinsics, "depth": {"scale_m": 0.001}},
               "frames": [{"index": i, "time_s": 0.1 * i, "position": (poses or {}).get(i, [0, 0, 0]),
                           "quaternion_xyzw": [0, 0, 0, 1]} for i in range(len(frames))],
               "objects": [{"id": i, "name": f"object {i}", "nyu40": label,
                            "role": "structure" if label == WALL else "target"} for i, label in classes.items()]}
    (folder / "dataset.json").write_text(json.dumps(about), encoding="utf-8")
    return folder


def rectangles(count, seed):
    """Frames with one or two rectangles on a noisy grey wall; their colour tells the class."""
    random = np.random.default_rng(seed)
    frames = []
    for _ in range(count):
        rgb = np.full((HEIGHT, WIDTH, 3), 128, np.int64)
        instance = np.ones((HEIGHT, WIDTH), int)
        for number, (one, colour) in enumerate(CLASSES.items()):
            if random.random() < 0.2:
                continue
            wide, high = random.integers(14, 40, 2)
            x = random.integers(0, WIDTH // 2 - 8) + number * WIDTH // 2
            y = random.integers(0, HEIGHT - 16)
            rgb[y:y + high, x:x + wide] = colour
            instance[y:y + high, x:x + wide] = number + 2
        rgb += random.integers(-20, 21, rgb.shape)
        frames.append((np.clip(rgb, 0, 255).astype(np.uint8), instance))
    return frames


def boxes(*rows):
    return np.array(rows, float).reshape(-1, 4)


class Scores(unittest.TestCase):
    """mAP, mIoU, PSNR and SSIM compared with values computed by hand."""

    def precision(self, found, scores, truth, ignored=None, threshold=0.5):
        ignored = np.zeros(len(truth), bool) if ignored is None else np.array(ignored, bool)
        image = boxes(*found), np.array(scores, float), boxes(*truth), ignored
        return detection_scores.average_precision([image], threshold)

    def test_overlap_is_shared_area_over_joined_area(self):
        others = boxes((0, 0, 10, 10), (5, 0, 15, 10), (20, 0, 30, 10))
        overlap = detection_scores.box_iou(boxes((0, 0, 10, 10)), others)
        np.testing.assert_allclose(overlap, [[1, 1 / 3, 0]])

    def test_average_precision_interpolates_at_101_recalls(self):
        truth = [(0, 0, 10, 10), (20, 0, 30, 10)]
        self.assertEqual(self.precision(truth, [0.9, 0.8], truth), 1)
        # Right, wrong, right: precision 1 up to recall 0.5 (51 levels), then 2/3 (50 levels).
        found = [truth[0], (50, 50, 60, 60), truth[1]]
        self.assertAlmostEqual(self.precision(found, [0.9, 0.8, 0.7], truth), (51 + 50 * 2 / 3) / 101)
        # The wrong one first: precision is at most 2/3 everywhere.
        self.assertAlmostEqual(self.precision(found, [0.8, 0.9, 0.7], truth), 2 / 3)
        # One of two found.
        self.assertAlmostEqual(self.precision(found[:1], [0.9], truth), 51 / 101)
        self.assertEqual(self.precision([], [], truth), 0)
        self.assertIsNone(self.precision(found, [0.9, 0.8, 0.7], []))

    def test_an_object_is_found_once(self):
        truth = [(0, 0, 10, 10)]
        self.assertEqual(detection_scores.match_image(boxes(*truth * 2), np.array([0.5, 0.9]), boxes(*truth),
                                              np.zeros(1, bool), 0.5).tolist(), [1, 0])

    def test_ignored_objects_count_neither_way(self):
        truth = [(0, 0, 10, 10), (20, 0, 30, 10)]
        self.assertEqual(self.precision([truth[1], truth[0]], [0.9, 0.8], truth, [0, 1]), 1)
        self.assertEqual(self.precision([truth[0]], [0.8], truth, [0, 1]), 1)

    def test_map_is_the_mean_over_classes_and_thresholds(self):
        truth = (boxes((0, 0, 10, 10), (20, 0, 30, 10)), np.array([0, 1]), np.zeros(2, bool))
        # The second box overlaps by 0.8: right at 0.5 to 0.8 (7 of 10 thresholds), or up to 0.75 by rounding.
        found = (boxes((0, 0, 10, 10), (20, 0, 28, 10)), np.array([0.9, 0.9]), np.array([0, 1]))
        half, all_of_them = detection_scores.mean_average_precision([found], [truth], 3)
        self.assertEqual(half, 1)
        self.assertIn(round(all_of_them, 9), (round((1 + 0.7) / 2, 9), round((1 + 0.6) / 2, 9)))
        wrong_class = (found[0], found[1], np.array([0, 0]))
        self.assertAlmostEqual(detection_scores.mean_average_precision([wrong_class], [truth], 2)[0], 0.5)

    def test_mean_iou_counts_classes_that_are_there(self):
        # Class 0: 3 of 5 right, 1 of class 1 taken for it; class 2 is nowhere in the truth.
        confusion = np.array([[3, 1, 1], [1, 4, 0], [0, 0, 0]])
        self.assertAlmostEqual(detection_scores.mean_iou(confusion), (3 / 6 + 4 / 6) / 2)
        self.assertIsNone(detection_scores.mean_iou(np.zeros((2, 2), int)))

    def test_psnr_counts_pixels_of_the_mask(self):
        first = np.zeros((4, 4, 3), np.uint8)
        second = first.copy()
        second[0, 0] = 255
        everywhere = np.ones((4, 4), bool)
        self.assertAlmostEqual(novel_views.psnr(first, second, everywhere), 10 * np.log10(16))
        everywhere[0, 0] = False
        self.assertEqual(novel_views.psnr(first, second, everywhere), novel_views.BEST_PSNR)
        self.assertIsNone(novel_views.psnr(first, second, np.zeros((4, 4), bool)))

    def test_ssim_of_even_images_is_the_luminance_term(self):
        mask = np.ones((30, 40), bool)
        first, second = np.full((30, 40), 100, np.uint8), np.full((30, 40), 150, np.uint8)
        c1 = (0.01 * 255) ** 2
        self.assertAlmostEqual(novel_views.ssim(first, first, mask), 1)
        self.assertAlmostEqual(novel_views.ssim(first, second, mask),
                               (2 * 100 * 150 + c1) / (100 ** 2 + 150 ** 2 + c1), places=6)
        # Pixels outside the mask do not matter.
        mask[:, :10] = False
        second[:, 10:] = 100
        self.assertAlmostEqual(novel_views.ssim(first, second, mask), 1)


class Frames(unittest.TestCase):
    """The frames for which the detector predicts."""

    def frame(self):
        rgb, instance = rectangles(1, 3)[0]
        semantic = (instance - 1).astype(np.uint8)
        box = boxes((10, 20, 40, 52))
        return rgb, semantic, box, np.array([0]), np.array([False])

    def test_targets_give_the_box_back(self):
        heat, border, weight, asked, _ = detector.targets_of(self.frame(), 2)
        row, column = np.unravel_index(heat[0].argmax(), heat[0].shape)
        self.assertEqual(heat[0, row, column], 1)
        self.assertEqual(heat[1].max(), 0)
        x, y = (column + 0.5) * detector.STRIDE, (row + 0.5) * detector.STRIDE
        left, above, right, below = border[:, row, column]
        self.assertEqual([x - left, y - above, x + right, y + below], [10, 20, 40, 52])
        self.assertTrue((asked == 1).all())
        self.assertGreater(weight[row, column], 0)

    def test_nothing_is_asked_where_an_object_is_ignored(self):
        frame = self.frame()[:4] + (np.array([True]),)
        heat, _, weight, asked, _ = detector.targets_of(frame, 2)
        self.assertEqual((heat.max(), weight.max()), (0, 0))
        self.assertEqual(asked[0, 8, 6], 0)
        self.assertEqual(asked[0, 0, 0], 1)

    def test_boxes_move_with_their_image(self):
        rgb = np.zeros((HEIGHT, WIDTH, 3), np.uint8)
        semantic = np.zeros((HEIGHT, WIDTH), np.uint8)
        semantic[20:52, 10:40] = 1
        frame = (rgb, semantic, boxes((10, 20, 40, 52)), np.array([0]), np.array([False]))
        for seed in range(20):
            _, moved, box, _, _ = detector.augment(frame, np.random.default_rng(seed))
            rows, columns = np.nonzero(moved == 1)
            around = [columns.min(), rows.min(), columns.max() + 1, rows.max() + 1]
            np.testing.assert_allclose(box[0], around, atol=1.0)


class Judges(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def judge(self, name, request, result="result.json"):
        path = self.folder / "request.json"
        path.write_text(json.dumps(request), encoding="utf-8")
        made = subprocess.run(["/usr/bin/python3", JUDGES / f"{name}.py", path, self.folder / result],
                              capture_output=True, text=True)
        self.assertEqual(made.returncode, 0, made.stderr)
        return json.loads((self.folder / result).read_text(encoding="utf-8"))

    def request(self, entries, tests, **options):
        return {"work": str(self.folder / "work"), "seed": 1, "options": options,
                "entries": [{"planner": planner, "scene": scene, "seed": 1, "dataset": str(path)}
                            for planner, scene, path in entries],
                "tests": [{"distribution": kind, "scene": scene, "dataset": str(path)} for kind, scene, path in tests]}

    def test_check_says_versions_or_what_to_install(self):
        for name, there, package in (("detector", HAS_TORCH, "python3-torch"),
                                     ("novel_views", HAS_OPEN3D, "python3-open3d")):
            made = subprocess.run(["/usr/bin/python3", JUDGES / f"{name}.py", "--check"],
                                  capture_output=True, text=True)
            self.assertEqual(made.returncode, 0 if there else 3, made.stderr)
            self.assertEqual(len(made.stdout.splitlines()), 1)
            self.assertIn("NumPy" if there else package, made.stdout)

    @unittest.skipUnless(HAS_TORCH, "torch is missing (Debian's python3-torch)")
    def test_detector_refuses_a_device_that_it_cannot_use(self):
        import torch
        path = self.folder / "request.json"
        refused = {"tpu": "must be cpu or cuda, not 'tpu'"}
        if not torch.cuda.is_available():
            refused["cuda"] = "PyTorch finds no graphics card"
        for device, words in refused.items():
            path.write_text(json.dumps(self.request([], [], device=device)), encoding="utf-8")
            made = subprocess.run(["/usr/bin/python3", JUDGES / "detector.py", "--check", path],
                                  capture_output=True, text=True)
            self.assertEqual(made.returncode, 2, made.stderr)
            self.assertIn(words, made.stderr)

    @unittest.skipUnless(HAS_TORCH, "torch is missing (Debian's python3-torch)")
    def test_detector_learns_coloured_rectangles(self):
        known = write_dataset(self.folder / "known", rectangles(48, 1))
        other = write_dataset(self.folder / "other", rectangles(24, 2))
        request = self.request([("all", "toy", known)], [("uniform", "other", other), ("close", "toy", known)],
                               steps=120, batch=8, threads=1)
        result = self.judge("detector", request)
        values = result["rows"][0]["values"]
        self.assertEqual((values["frames"], values["classes"], values["classes_trained"]), (48, 2, 2))
        self.assertGreater(values["map50_uniform"], 0.5)
        self.assertGreater(values["ap50_any_uniform"], 0.5)
        self.assertGreater(values["miou_uniform"], 0.5)
        self.assertGreater(values["map50_uniform"], values["map_uniform"])
        self.assertNotIn("map50_close", values)
        self.assertFalse(any("no test views" in note for note in result["notes"]))

    @unittest.skipUnless(HAS_TORCH, "torch is missing (Debian's python3-torch)")
    def test_detector_without_views_of_unseen_scenes_has_no_values_and_one_note(self):
        known = write_dataset(self.folder / "known", rectangles(4, 1))
        kinds = ("uniform", "object_facing", "close")
        result = self.judge("detector", self.request([("all", "toy", known)],
                                                     [(kind, "toy", known) for kind in kinds]))
        self.assertEqual([row["planner"] for row in result["rows"]], ["all"])
        self.assertEqual(set(result["rows"][0]["values"].values()), {None})
        self.assertEqual(result["notes"], [detector.NO_TESTS])

    def test_an_option_that_a_judge_does_not_have_is_refused(self):
        path = self.folder / "request.json"
        for option, value, words in (("evry", "3", "no option 'evry'; its options are every, matching"),
                                     ("every", "x", "sfm.every must be a whole number, not 'x'")):
            path.write_text(json.dumps(self.request([], [], **{option: value})), encoding="utf-8")
            made = subprocess.run(["/usr/bin/python3", "-c", RUN_SFM, JUDGES, "--check", path],
                                  capture_output=True, text=True)
            self.assertEqual(made.returncode, 2, made.stderr)
            self.assertIn(words, made.stderr)

    def test_one_entry_that_raises_leaves_the_others(self):
        good = write_dataset(self.folder / "good", rectangles(1, 1))
        request = self.request([("bad", "toy", good), ("good", "toy", good)], [])
        path = self.folder / "request.json"
        path.write_text(json.dumps(request), encoding="utf-8")
        made = subprocess.run(["/usr/bin/python3", "-c", RUN_RAISING, JUDGES, path, self.folder / "result.json"],
                              capture_output=True, text=True)
        self.assertEqual(made.returncode, 0, made.stderr)
        result = json.loads((self.folder / "result.json").read_text(encoding="utf-8"))
        self.assertEqual([row["values"] for row in result["rows"]], [{"one": None}, {"one": 1.0}])
        self.assertEqual(result["notes"], ["toy bad seed 1: ZeroDivisionError"])

    def test_kept_values_depend_on_code_options_versions_and_tests(self):
        good = write_dataset(self.folder / "good", rectangles(1, 1))
        request = {**self.request([("one", "toy", good)], []), "version": "1", "versions": "x 1"}
        entry = request["entries"][0]
        tests = [{"distribution": "uniform", "scene": "toy", "dataset": str(good)}]
        kept = {dataset.kept_row("j", {**request, **change}, entry)
                for change in ({}, {"seed": 2}, {"version": "2"}, {"versions": "x 2"}, {"tests": tests},
                               {"options": {"a": 1}}, {"programs": [{"name": "a", "command": "b"}]})}
        self.assertEqual(len(kept), 7)

    def test_a_slam_program_that_takes_too_long_is_ended_with_its_children(self):
        pipe = self.folder / "pipe"
        os.mkfifo(pipe)
        reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
        self.addCleanup(os.close, reader)
        os.set_blocking(reader, True)
        child = f"(sleep 30; echo alive) > {pipe}"
        for line, timeout_s in ((f"exec 3> {pipe}; {child} &", 600.0), (f"{child} & wait", 0.01)):
            slam.run_shell(line, self.folder, timeout_s)
            self.assertEqual(os.read(reader, 9), b"")   # the end of the pipe: nobody holds it open
        self.assertIn("stopped after 0.01 s", (self.folder / "log.txt").read_text())

    @unittest.skipUnless(HAS_TORCH, "torch is missing (Debian's python3-torch)")
    def test_detector_repeats_exactly_and_knows_an_unreadable_dataset(self):
        known = write_dataset(self.folder / "known", rectangles(10, 1))
        other = write_dataset(self.folder / "other", rectangles(4, 2))
        request = self.request([("all", "toy", known), ("gone", "toy", self.folder / "gone")],
                               [("uniform", "other", other)], steps=6, batch=4, folds=2, threads=1)
        first = self.judge("detector", request)
        request["work"] = str(self.folder / "another")   # nothing kept there
        self.assertEqual(first, self.judge("detector", request))
        rows = {row["planner"]: row["values"] for row in first["rows"]}
        self.assertEqual(rows["all"].keys(), rows["gone"].keys())
        self.assertTrue(all(value is None for value in rows["gone"].values()))
        self.assertIsNotNone(rows["all"]["map50_folds"])
        self.assertIsNone(rows["all"]["map50_spread"])

    @unittest.skipUnless(HAS_OPEN3D, "Open3D is missing (Debian's python3-open3d)")
    def test_novel_views_draw_the_wall_that_was_fused(self):
        even = [(np.full((48, 64, 3), (150, 90, 60), np.uint8), np.ones((48, 64), int))]
        seen = write_dataset(self.folder / "seen", even)
        # The first view shows only fused surface; half of the second, at the wall's edge, was never
        # fused.
        held = write_dataset(self.folder / "held", even * 2, {0: [0.05, 0, 0.3], 1: [1.1547, 0, 0]},
                             [np.full((48, 64), depth, np.uint16) for depth in (1700, 2000)])
        request = self.request([("one", "room", seen)], [("uniform", "room", held), ("close", "room", held)])
        result = self.judge("novel_views", request)
        values = result["rows"][0]["values"]
        self.assertEqual(values["views"], 2)
        self.assertAlmostEqual(values["missing"], 0.25, delta=0.03)
        self.assertAlmostEqual(values["depth_right"], 0.75, delta=0.03)
        self.assertGreater(values["psnr"], 45)
        self.assertLess(values["psnr_filled"], values["psnr"] - 5)
        self.assertGreater(values["ssim"], 0.99)
        request["work"] = str(self.folder / "another")
        self.assertEqual(result, self.judge("novel_views", request))

    @unittest.skipUnless(HAS_OPEN3D, "Open3D is missing (Debian's python3-open3d)")
    def test_novel_views_are_null_without_tests(self):
        even = [(np.full((48, 64, 3), 100, np.uint8), np.ones((48, 64), int))]
        seen = write_dataset(self.folder / "seen", even)
        result = self.judge("novel_views", self.request([("one", "room", seen)], []))
        self.assertTrue(all(value is None for value in result["rows"][0]["values"].values()))
        self.assertEqual(len(result["notes"]), 1)


if __name__ == "__main__":
    unittest.main()
