#!/usr/bin/python3
"""compare and sweep as users call them. NumPy writes the same trajectory in every format that the
program reads; all must get the same judgement.

Usage: compare_test.py PROGRAM [unittest arguments]
"""
import csv
import json
import unittest
import xml.etree.ElementTree

import h5py
import numpy

from support import tiny_room
from support.program import FolderCase, run

Y_UP = numpy.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]], float)  # y-up from z-up


def rotation(q):
    x, y, z, w = q
    return numpy.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def quaternion(m):
    """x, y, z, w of a rotation matrix by an eigenvector, which needs no special cases."""
    k = numpy.array([
        [m[0, 0] - m[1, 1] - m[2, 2], m[0, 1] + m[1, 0], m[0, 2] + m[2, 0], m[2, 1] - m[1, 2]],
        [m[0, 1] + m[1, 0], m[1, 1] - m[0, 0] - m[2, 2], m[1, 2] + m[2, 1], m[0, 2] - m[2, 0]],
        [m[0, 2] + m[2, 0], m[1, 2] + m[2, 1], m[2, 2] - m[0, 0] - m[1, 1], m[1, 0] - m[0, 1]],
        [m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], m[0, 0] + m[1, 1] + m[2, 2]]])
    values, vectors = numpy.linalg.eigh(k / 3)
    return vectors[:, numpy.argmax(values)]


def text(*numbers):
    flat = numpy.concatenate([numpy.ravel(n) for n in numbers])
    return " ".join(f"{n:.12g}" for n in flat) + "\n"


def write_all(folder, frames):
    """frames: (time, position, matrix world from camera); returns format -> file."""
    files = {}
    for name in ["tum", "kitti", "tartanair", "scenenet"]:
        files[name] = folder / name / "poses.txt"
        files[name].parent.mkdir()
    ned = numpy.diag([1.0, -1, -1])
    body = numpy.array([[0, 1, 0], [0, 0, 1], [1, 0, 0]], float)  # our camera from TartanAir's
    level = numpy.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]], float)  # KITTI's world from ours
    tum, kitti, tartan, scene_net, colmap = [], [], [], ["#first three elements, eye\n"], []
    transforms, front = [], []
    for i, (time, p, r) in enumerate(frames):
        tum.append(text(time, p, quaternion(r)))
        kitti.append(text(numpy.column_stack([level @ r, level @ p])))
        tartan.append(text(ned @ p, quaternion(ned @ r @ body)))
        eye, look = Y_UP @ p, Y_UP @ (p + 2 * r[:, 2])
        scene_net += [text(time - 0.01, eye, look), text(time + 0.01, eye, look)]
        x, y, z, w = quaternion(r.T)
        colmap.append(f"{i + 1} " + text(w, x, y, z, -r.T @ p).strip() + f" 1 {i:06}.png\n\n")
        gl = numpy.eye(4)
        gl[:3, :3], gl[:3, 3] = r @ numpy.diag([1, -1, -1]), p
        transforms.append({"file_path": f"{i:06}.png", "transform_matrix": gl.tolist()})
        front.append({"pos": eye.tolist(), "target": look.tolist(), "fov": 60, "time": time})
    files["tum"].write_text("".join(tum))
    files["kitti"].write_text("".join(kitti))
    files["tartanair"].write_text("".join(tartan))
    files["scenenet"].write_text("".join(scene_net))
    files["colmap"] = folder / "images.txt"
    files["colmap"].write_text("".join(colmap))
    files["transforms"] = folder / "transforms.json"
    files["transforms"].write_text(json.dumps({"frames": transforms}))
    files["3d-front"] = folder / "cameras.json"
    files["3d-front"].write_text(json.dumps(front))
    files["hypersim"] = folder / "cam_00"
    files["hypersim"].mkdir()
    with h5py.File(files["hypersim"] / "camera_keyframe_positions.hdf5", "w") as file:
        file["dataset"] = numpy.array([Y_UP @ p for _, p, _ in frames])
    with h5py.File(files["hypersim"] / "camera_keyframe_orientations.hdf5", "w") as file:
        file["dataset"] = numpy.array(
            [Y_UP @ r @ numpy.diag([1, -1, -1]) for _, _, r in frames], numpy.float32)
    return files


class Compare(FolderCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.room = cls.folder / "room.obj"
        tiny_room.write(cls.room)

    def rows(self, *arguments):
        result = run("compare", *arguments, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        scenes = json.loads(result.stdout)["scenes"]
        return {row["planner"]: row for row in scenes[0]["rows"]}

    def test_all_planners_are_judged_and_none_beats_the_bound(self):
        rows = self.rows(self.room, "--max-frames", 30, "--bound")
        bound = rows.pop("bound")
        self.assertEqual(len(rows), 8)
        for name, row in rows.items():
            self.assertLessEqual(row["frames"], 30, name)
            self.assertEqual(row["objects"], 5)
            self.assertLessEqual(row["capture_rate"], bound["capture_rate"], name)
            self.assertLessEqual(row["well_captured_rate"], bound["well_captured_rate"], name)
        self.assertEqual(rows["dollytrack"]["capture_rate"], 1.0)
        self.assertEqual(rows["dollytrack"]["move_collision_rate"], 0.0)
        self.assertIsNone(rows["uniform"]["path_length_m"])
        self.assertIsNone(rows["two-body"]["corner_collision_rate"])

    def test_seeds_give_medians_that_repeat(self):
        wanted = ["--planners", "uniform", "--max-frames", 20]
        single = [self.rows(self.room, *wanted, "--seed", seed)["uniform"]["capture_rate"]
                  for seed in (1, 2, 3)]
        together = self.rows(self.room, *wanted, "--seeds", 3)["uniform"]["capture_rate"]
        self.assertAlmostEqual(together, sorted(single)[1])

    def test_one_trajectory_is_judged_alike_in_every_format(self):
        project = self.folder / "room.dolly"
        planned = run("plan", self.room, "--max-frames", 24, "-o", project, "--json")
        metrics = json.loads(planned.stdout)
        trajectory = json.loads(project.read_text())["result"]["trajectory"]["frames"]
        frames = [(f["time_s"], numpy.array(f["position"]), rotation(f["quaternion_xyzw"]))
                  for f in trajectory]
        files = write_all(self.folder, frames)
        arguments = []
        for name, path in files.items():
            with self.subTest(name):
                rows = self.rows(self.room, "--planners", "best-view", "--trajectory", path)
                row = rows[path.name]
                self.assertEqual(row["frames"], len(frames))
                for rate in ["capture_rate", "well_captured_rate", "repeat_rate",
                             "frame_collision_rate"]:
                    self.assertAlmostEqual(row[rate], metrics[rate], 6, rate)
                self.assertAlmostEqual(row["area_share_box"], metrics["area_share_box"], 2)
                self.assertEqual(row["outside_rate"], 0.0)
                self.assertIsNone(row["plan_ms"])

    def test_a_table_that_claims_too_many_rows_is_refused(self):
        folder = self.folder / "hostile"
        folder.mkdir()
        rows = (2 ** 64 + 2) // 3  # times 3 this overflows to 2 in 64 bits
        for name in ["positions", "orientations"]:
            with h5py.File(folder / f"camera_keyframe_{name}.hdf5", "w") as file:
                file.create_dataset("dataset", (rows, 3), "f8", chunks=(1, 3))
        result = run("compare", self.room, "--planners", "best-view", "--trajectory", folder)
        self.assertEqual(result.returncode, 4, result.stderr)
        self.assertIn("larger than", result.stderr)

    def test_our_own_camera_json_is_judged_as_the_plan(self):
        project, dataset = self.folder / "own.dolly", self.folder / "own"
        run("plan", self.room, "--max-frames", 12, "-o", project)
        exported = run("export", project, "--out", dataset)
        self.assertEqual(exported.returncode, 0, exported.stderr)
        rows = self.rows(self.room, "--planners", "dollytrack", "--max-frames", 12,
                         "--trajectory", dataset / "camera.json")
        for name in ["capture_rate", "well_captured_rate", "repeat_rate", "frames",
                     "frame_collision_rate"]:
            self.assertAlmostEqual(rows["camera.json"][name], rows["dollytrack"][name], 9, name)

    def test_files_and_several_scenes(self):
        table, picture = self.folder / "table.csv", self.folder / "table.svg"
        result = run("compare", self.room, self.folder / "missing.obj", self.room, "--planners",
                     "uniform,best-view", "--max-frames", 10, "--csv", table, "--picture", picture)
        self.assertEqual(result.returncode, 3)
        self.assertIn("missing.obj", result.stderr)
        self.assertIn("mean of 2 scenes", result.stdout)
        with open(table) as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["planner"] for row in rows], ["best-view", "uniform"] * 2)
        self.assertEqual(rows[0]["path_length_m"], "")
        self.assertEqual(rows[0]["scene"], self.folder.name + "/room")
        xml.etree.ElementTree.parse(picture)

    def test_wrong_arguments_are_usage_errors(self):
        for arguments, word in [
            ((self.room, "--planners", "two-bdy"), "two-body"),
            ((self.room, "--picture", "a.pdf"), ".svg"),
            ((), "scene"),
            ((self.room, self.room, "--trajectory", "a.txt"), "one scene"),
            ((self.room, "--trajectory", self.room, "--trajectory-format", "x"), "tum"),
        ]:
            result = run("compare", *arguments)
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertIn(word, result.stderr)
        missing = run("compare", self.room, "--trajectory", self.folder / "none.txt")
        self.assertEqual(missing.returncode, 4)

    def test_trajectories_of_one_name_are_two_rows(self):
        lines = "0 1 -1 1.5 0 0 0 1\n1 1.1 -1 1.5 0 0 0 1\n"
        paths = []
        for name in ["a/poses.txt", "b/poses.txt", "uniform"]:
            paths.append(self.folder / "names" / name)
            paths[-1].parent.mkdir(parents=True, exist_ok=True)
            paths[-1].write_text(lines)
        given = [word for path in paths + paths[:1] for word in ("--trajectory", path)]
        result = run("compare", self.room, "--planners", "uniform", *given, "--json",
                     "--max-frames", 10)
        self.assertEqual(result.returncode, 0, result.stderr)
        names = [row["planner"] for row in json.loads(result.stdout)["mean"]]
        self.assertEqual(names, ["uniform", "poses.txt", "b/poses.txt", "names/uniform",
                                 "a/poses.txt"])

    def test_seeds_beyond_the_last_number_are_refused(self):
        result = run("compare", self.room, "--planners", "uniform", "--seed", 2147483646,
                     "--seeds", 3)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn("--seed", result.stderr)

    def test_a_trajectory_elsewhere_is_warned_of(self):
        path = self.folder / "far.txt"
        path.write_text("0 100 0 0 0 0 0 1\n1 101 0 0 0 0 0 1\n")
        result = run("compare", self.room, "--planners", "best-view", "--trajectory", path)
        self.assertEqual(result.returncode, 0)
        self.assertIn("--trajectory-world", result.stderr)

    # --- sweep

    def test_sweep_gives_what_plan_gives(self):
        table, plot = self.folder / "sweep.csv", self.folder / "sweep.svg"
        result = run("sweep", self.room, "--param", "fill=0.4:0.6:0.1", "--max-frames", 20,
                     "--csv", table, "--plot", plot)
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(table) as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["fill"] for row in rows], ["0.4", "0.5", "0.6"])
        for row in rows:
            planned = json.loads(run("plan", self.room, "--json", "--max-frames", 20, "--set",
                                     "fill=" + row["fill"]).stdout)
            for name in ["capture_rate", "area_share_box", "repeat_rate", "frames"]:
                self.assertAlmostEqual(float(row[name]), planned[name], 6, name)
            self.assertIn("stage_viewpoints_ms", row)
        # The map is made only once, since it does not depend on fill.
        self.assertGreater(float(rows[0]["stage_free_space_ms"]), 1.0)
        self.assertLess(float(rows[1]["stage_free_space_ms"]), 1.0)
        svg = plot.read_text()
        xml.etree.ElementTree.fromstring(svg)
        self.assertIn("well_captured_rate", svg)

    def test_sweep_of_two_parameters_draws_a_curve_for_each(self):
        plot = self.folder / "two.svg"
        result = run("sweep", self.room, "--param", "corner_distance_m=0.1,0.4", "--param",
                     "path_mode=tour,longest_branch", "--plot", plot, "--max-frames", 20)
        self.assertEqual(result.returncode, 0, result.stderr)
        for name in ["dollytrack, path_mode=tour", "paper-smoothing, path_mode=longest_branch"]:
            self.assertIn(name, plot.read_text())

    # --- the coverage of budgets

    def test_coverage_gives_what_plans_within_the_budgets_give(self):
        table, plot = self.folder / "coverage.csv", self.folder / "coverage.svg"
        result = run("plan", self.room, "--max-frames", 30, "--coverage", table, "--coverage", plot)
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(table) as file:
            rows = list(csv.DictReader(file))
        lengths = [row for row in rows if row["budget"] == "length"]
        frames = [row for row in rows if row["budget"] == "frames"]
        for row in (frames[1], lengths[0], lengths[-2], lengths[-1]):
            budget = ["--max-frames", row["max_frames"]]
            budget += ["--max-length", row["max_length_m"]] if row["max_length_m"] else []
            planned = json.loads(run("plan", self.room, "--json", *budget).stdout)
            for name in ["capture_rate", "well_captured_rate", "frames", "path_length_m"]:
                self.assertAlmostEqual(float(row[name]), planned[name], 6, name)
            if row["max_length_m"]:
                self.assertLessEqual(planned["path_length_m"], float(row["max_length_m"]))
        svg = plot.read_text()
        xml.etree.ElementTree.fromstring(svg)
        self.assertIn("well captured", svg)

    def test_a_coverage_of_another_kind_is_a_usage_error(self):
        result = run("plan", self.room, "--coverage", self.folder / "coverage.txt")
        self.assertEqual(result.returncode, 2)
        self.assertIn(".csv, .svg or .png", result.stderr)

    def test_wrong_sweeps_are_usage_errors(self):
        for arguments, word in [
            (("--param", "fil=1:2:1"), "fill"),
            (("--param", "fill=0.5:0.4:0.1"), "FROM:TO:STEP"),
            (("--param", "fill=0.5:0.9:0"), "FROM:TO:STEP"),
            (("--param", "fill=0.5,7"), "0.1 .. 1"),
            (("--param", "fill"), "NAME="),
            (("--param", "fill=0.5", "--metric", "wel_captured_rate"), "well_captured_rate"),
            (("--param", "path_mode=tour,longest_branch", "--plot", "a.svg"), "number"),
            (("--param", "fill=0.5", "--param", "fill=0.6"), "one --param"),
            (("--param", "fill=0.2:0.9:0.001", "--param", "seed=1:100:1"), "combinations"),
        ]:
            result = run("sweep", self.room, *arguments)
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertIn(word, result.stderr)

    def test_a_value_that_leaves_no_room_is_a_gap(self):
        table = self.folder / "gap.csv"
        result = run("sweep", self.room, "--param", "camera_radius_m=0.1,1", "--max-frames", 20,
                     "--unit", 0.5, "--planners", "dollytrack,uniform", "--csv", table)
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertIn("camera_radius_m=1,", result.stderr)
        with open(table) as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["camera_radius_m"] for row in rows], ["0.1", "0.1", "1", "1"])
        self.assertEqual([row["frames"] == "" for row in rows], [False, False, True, True])

    def test_without_a_limit_all_planners_have_the_same_frames(self):
        table = self.folder / "budget.csv"
        result = run("sweep", self.room, "--param", "max_frames=0,300", "--planners", "dollytrack",
                     "--csv", table)
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(table) as file:
            frames = [row["frames"] for row in csv.DictReader(file)]
        self.assertEqual(frames[0], frames[1])

    def test_two_projects_are_compared_by_their_stored_plans(self):
        projects = [self.folder / "a.dolly", self.folder / "b.dolly"]
        metrics = []
        for project, frames in zip(projects, (40, 20)):
            planned = run("plan", self.room, "--max-frames", frames, "-o", project, "--json")
            metrics.append(json.loads(planned.stdout))
        table = self.folder / "projects.csv"
        result = run("compare", "--projects", *projects, "--json", "--csv", table)
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = {row["name"]: row for row in json.loads(result.stdout)["metrics"]}
        for name in ("capture_rate", "repeat_rate", "path_length_m", "frames", "jerk_max_mps3"):
            self.assertEqual([rows[name]["a"], rows[name]["b"]], [m[name] for m in metrics], name)
        self.assertEqual(rows["capture_rate"]["better"], "higher")
        self.assertEqual(rows["frames"]["better"], "")
        frames = json.loads(projects[1].read_text())["result"]["trajectory"]["frames"]
        interval = metrics[1]["frame_interval_s"]
        self.assertAlmostEqual(rows["duration_s"]["b"],
                               frames[-1]["time_s"] - frames[0]["time_s"] + interval, 9)
        with open(table) as file:
            self.assertEqual([row["metric"] for row in csv.DictReader(file)], list(rows))
        text = run("compare", "--projects", *projects).stdout
        frames_row = next(line for line in text.splitlines() if line.split()[:1] == ["frames"])
        counts = [m["frames"] for m in metrics]
        self.assertEqual(frames_row.split()[1:],
                         [*map(str, counts), f"{counts[0] - counts[1]:+}"])
        same = run("compare", "--projects", projects[0], projects[0]).stdout
        self.assertNotIn("better", same)

    def test_wrong_projects_are_refused(self):
        project = self.folder / "one.dolly"
        run("plan", self.room, "--max-frames", 10, "-o", project)
        other_room, other = self.folder / "two.obj", self.folder / "two.dolly"
        tiny_room.write_two(other_room)
        run("plan", other_room, "--max-frames", 10, "-o", other)
        for arguments, code, word in [
            ((project, other), 2, "different scenes"),
            ((project, self.room), 2, "not a project"),
            ((project, self.folder / "missing.dolly"), 4, "missing.dolly"),
            ((project, project, "--planners", "uniform"), 2, "--planners"),
        ]:
            result = run("compare", "--projects", *arguments)
            self.assertEqual(result.returncode, code, result.stderr)
            self.assertIn(word, result.stderr)

    def test_a_file_that_cannot_be_written_is_said_before_the_work(self):
        nowhere = self.folder / "nowhere" / "table.csv"
        for command in (["compare"], ["sweep", "--param", "fill=0.5"]):
            result = run(*command, self.folder / "missing.obj", "--csv", nowhere)
            self.assertEqual(result.returncode, 6, result.stderr)
            self.assertIn("folder does not exist", result.stderr)


if __name__ == "__main__":
    unittest.main()
