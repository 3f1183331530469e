"""Runs `dollytrack evaluate` on trajectories and clouds whose errors are known: evaluate_test.py PROGRAM.

The figures are compared with an independent implementation in NumPy.
"""
import json
import struct
import unittest

import numpy as np

from support import tiny_room
from support.program import FolderCase, run


def matrix(x, y, z, w):
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def quaternion(r):
    """x, y, z, w of a rotation matrix, computed from the largest of the four."""
    w2 = [1 + r[0, 0] - r[1, 1] - r[2, 2], 1 - r[0, 0] + r[1, 1] - r[2, 2],
          1 - r[0, 0] - r[1, 1] + r[2, 2], 1 + np.trace(r)]
    k = int(np.argmax(w2))
    s = 2 * np.sqrt(w2[k])
    q = [0.0] * 4
    q[k] = s / 4
    if k == 3:
        q[:3] = [(r[2, 1] - r[1, 2]) / s, (r[0, 2] - r[2, 0]) / s, (r[1, 0] - r[0, 1]) / s]
    else:
        i, j = (k + 1) % 3, (k + 2) % 3
        q[i], q[j] = (r[i, k] + r[k, i]) / s, (r[j, k] + r[k, j]) / s
        q[3] = (r[j, i] - r[i, j]) / s
    return q


def about(axis, angle):
    x, y, z = np.asarray(axis) / np.linalg.norm(axis) * np.sin(angle / 2)
    return matrix(x, y, z, np.cos(angle / 2))


def aligned(estimate, truth, with_scale):
    """Horn's method with quaternions, which differs from the program's."""
    a, b = estimate - estimate.mean(0), truth - truth.mean(0)
    m = a.T @ b
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = m
    n = np.array([[xx + yy + zz, yz - zy, zx - xz, xy - yx],
                  [yz - zy, xx - yy - zz, xy + yx, zx + xz],
                  [zx - xz, xy + yx, yy - xx - zz, yz + zy],
                  [xy - yx, zx + xz, yz + zy, zz - xx - yy]])
    w, x, y, z = np.linalg.eigh(n)[1][:, -1]
    r = matrix(x, y, z, w)
    s = (b * (a @ r.T)).sum() / (a * a).sum() if with_scale else 1.0
    return s, s * estimate @ r.T + truth.mean(0) - s * r @ estimate.mean(0)


class EvaluateTest(FolderCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        tiny_room.write(cls.folder / "room.obj")
        export = run("export", cls.folder / "room.obj", "--out", cls.folder / "dataset",
                     "--set", "width_px=160", "--set", "height_px=120", "--max-frames", 40)
        assert export.returncode == 0, export.stderr
        card = json.loads((cls.folder / "dataset" / "dataset.json").read_text())
        cls.lens = card["conventions"]["intrinsics"]
        cls.times = np.array([frame["time_s"] for frame in card["frames"]])
        cls.positions = np.array([frame["position"] for frame in card["frames"]])
        cls.rotations = np.array([matrix(*frame["quaternion_xyzw"]) for frame in card["frames"]])

    def write(self, name, times, positions, rotations):
        path = self.folder / name
        lines = [" ".join(f"{value:.12f}" for value in [t, *p, *quaternion(r)])
                 for t, p, r in zip(times, positions, rotations)]
        path.write_text("# timestamp tx ty tz qx qy qz qw\n" + "\n".join(lines) + "\n")
        return path

    def moved(self, scale=1.0):
        """The true trajectory in another world frame."""
        turn = about([1, 2, 3], 0.8)
        return scale * self.positions @ turn.T + [4, -2, 1], turn @ self.rotations

    def evaluate(self, *arguments):
        result = run("-q", "evaluate", self.folder / "dataset", "--json", *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def one(self, path, *arguments):
        return self.evaluate("--estimated", path, *arguments)["runs"][0]

    def test_the_truth_in_another_world_has_no_error(self):
        run_ = self.one(self.write("moved.txt", self.times, *self.moved()))
        self.assertLess(run_["ate_m"]["max"], 1e-8)
        self.assertLess(run_["rpe_m"]["max"], 1e-8)
        self.assertLess(run_["rpe_deg"]["max"], 1e-5)
        self.assertEqual(run_["tracked"], len(self.times))
        self.assertTrue(run_["success"])

    def test_a_scale_is_found_only_where_it_may_be(self):
        path = self.write("scaled.txt", self.times, *self.moved(0.37))
        free = self.one(path, "--align", "sim3")
        self.assertAlmostEqual(free["alignment"]["scale"], 1 / 0.37, places=8)
        self.assertLess(free["ate_m"]["max"], 1e-8)
        self.assertLess(free["rpe_m"]["max"], 1e-8)
        self.assertGreater(self.one(path)["ate_m"]["rmse"], 0.1)

    def test_without_alignment_an_offset_is_the_error(self):
        path = self.write("offset.txt", self.times, self.positions + [0.3, 0, -0.4], self.rotations)
        run_ = self.one(path, "--align", "none")
        self.assertAlmostEqual(run_["ate_m"]["rmse"], 0.5, places=9)
        self.assertAlmostEqual(run_["ate_m"]["median"], 0.5, places=9)
        self.assertLess(run_["rpe_m"]["max"], 1e-9)

    def test_noise_of_known_size_is_measured_as_numpy_does(self):
        random = np.random.default_rng(5)
        noise = random.normal(0, 0.02, self.positions.shape)
        turns = np.array([about(random.normal(size=3), random.normal(0, 0.01))
                          for _ in self.times])
        positions, rotations = self.moved(0.5)
        positions, rotations = positions + 0.5 * noise, rotations @ turns
        path = self.write("noisy.txt", self.times, positions, rotations)
        for name, with_scale in (("se3", False), ("sim3", True)):
            for delta in (1, 3):
                run_ = self.one(path, "--align", name, "--delta", delta)
                scale, found = aligned(positions, self.positions, with_scale)
                off = np.linalg.norm(found - self.positions, axis=1)
                self.assertAlmostEqual(run_["alignment"]["scale"], scale, places=7)
                self.assertAlmostEqual(run_["ate_m"]["rmse"], np.sqrt((off ** 2).mean()), places=7)
                self.assertAlmostEqual(run_["ate_m"]["mean"], off.mean(), places=7)
                self.assertAlmostEqual(run_["ate_m"]["median"], np.median(off), places=7)
                self.assertAlmostEqual(run_["ate_m"]["max"], off.max(), places=7)
                lengths, angles = [], []
                for i in range(len(self.times) - delta):
                    def motion(p, r, s, i=i):
                        return r[i].T @ r[i + delta], s * r[i].T @ (p[i + delta] - p[i])
                    r0, t0 = motion(self.positions, self.rotations, 1.0)
                    r1, t1 = motion(positions, rotations, scale)
                    lengths.append(np.linalg.norm(r0.T @ (t1 - t0)))
                    angles.append(np.degrees(np.arccos(np.clip((np.trace(r0.T @ r1) - 1) / 2,
                                                               -1, 1))))
                self.assertEqual(run_["rpe_m"]["count"], len(lengths))
                self.assertAlmostEqual(run_["rpe_m"]["rmse"],
                                       np.sqrt(np.mean(np.square(lengths))), places=7)
                self.assertAlmostEqual(run_["rpe_deg"]["rmse"],
                                       np.sqrt(np.mean(np.square(angles))), places=5)
        free = self.one(path, "--align", "sim3")["ate_m"]["rmse"]
        # The alignment with scale takes 7 of the 3 n degrees of freedom.
        left = 3 * len(self.times) - 7
        self.assertAlmostEqual(free, 0.02 * np.sqrt(left / len(self.times)), delta=0.006)

    def test_poses_belong_to_the_frames_nearest_in_time(self):
        step = np.diff(self.times).min()
        # Twice the frame rate and a small delay: half of the poses have no frame.
        times = np.sort(np.concatenate([self.times, self.times + 0.5 * step])) + 0.004
        again = np.repeat(np.arange(len(self.times)), 2)
        path = self.write("dense.txt", times, self.positions[again], self.rotations[again])
        run_ = self.one(path, "--max-dt", 0.01)
        self.assertEqual(run_["tracked"], len(self.times))
        self.assertLess(run_["ate_m"]["max"], 1e-8)
        self.assertEqual(self.one(path, "--max-dt", 0.003)["tracked"], 0)

    def test_runs_that_lose_track_or_drift_or_never_begin_are_failures(self):
        good = self.write("good.txt", self.times, *self.moved())
        positions, rotations = self.moved()
        half = len(self.times) // 2
        lost = self.write("lost.txt", self.times[:half], positions[:half], rotations[:half])
        drifting = self.write("drifting.txt", self.times,
                              positions + np.linspace(0, 9, len(positions))[:, None] ** 2 * [0, 1, 0],
                              rotations)
        empty = self.folder / "empty.txt"
        empty.write_text("# timestamp tx ty tz qx qy qz qw\n")
        report = self.evaluate("--estimated", good, "--estimated", lost, "--estimated", drifting,
                               "--estimated", empty)
        self.assertEqual([one["success"] for one in report["runs"]], [True, False, False, False])
        self.assertEqual(report["success_rate"], 0.25)
        self.assertEqual(report["runs"][3]["tracked"], 0)
        lenient = self.evaluate("--estimated", good, "--estimated", lost, "--min-tracked", 0.4)
        self.assertEqual(lenient["success_rate"], 1.0)
        self.assertEqual(lenient["limits"]["min_tracked"], 0.4)
        printed = run("-q", "evaluate", self.folder / "dataset", "--estimated", good, "--estimated",
                      lost)
        self.assertIn("success rate 50.0 %", printed.stdout)
        self.assertIn("--min-tracked", printed.stdout)

    def test_a_run_without_figures_has_none_and_says_why(self):
        step = np.diff(self.times).min()
        span = f"lasts from {self.times[0]:.2f} to {self.times[-1]:.2f} s"
        empty = self.folder / "no_pose.txt"
        empty.write_text("# timestamp tx ty tz qx qy qz qw\n")
        cases = [(empty, "contains no pose")]
        for name, offset, word in [("late.txt", step / 2, "--max-dt"),
                                   ("unix.txt", 1.7e9, "no time in common")]:
            cases.append((self.write(name, self.times + offset, self.positions, self.rotations),
                          word))
        cases.append((self.write("single.txt", self.times[:1], self.positions[:1],
                                 self.rotations[:1]), "only 1 of its poses belongs"))
        for path, word in cases:
            with self.subTest(path.name):
                one = self.one(path, "--max-dt", step / 4)
                self.assertFalse(one["success"])
                self.assertIn(word, one["reason"])
                self.assertIsNone(one["alignment"])
                for figures in ("ate_m", "rpe_m", "rpe_deg"):
                    self.assertEqual(one[figures], {"rmse": None, "mean": None, "median": None,
                                                    "max": None, "count": 0})
                printed = run("-q", "evaluate", self.folder / "dataset", "--estimated", path,
                              "--max-dt", step / 4)
                self.assertEqual(printed.returncode, 0, printed.stderr)
                row = next(line for line in printed.stdout.splitlines() if "FAILED" in line)
                self.assertEqual(row.split()[2:], ["-"] * 7 + ["FAILED"])
                self.assertIn(word, printed.stdout)
                self.assertIn("the exit code is 0", printed.stdout)
                if path.name in ("late.txt", "unix.txt"):
                    self.assertIn(span, printed.stdout)
        # One pose gives only an error without alignment; two poses can be aligned with any other
        # two except for their distance.
        self.assertLess(self.one(cases[-1][0], "--align", "none")["ate_m"]["max"], 1e-8)
        ends = [0, -1]
        two = self.write("two.txt", self.times[ends], 3 * self.positions[ends],
                         self.rotations[ends])
        self.assertGreater(self.one(two)["ate_m"]["rmse"], 0.0)
        self.assertIsNone(self.one(two, "--align", "sim3")["ate_m"]["rmse"])
        self.assertNotIn("reason", self.one(self.write("good3.txt", self.times, *self.moved())))

    def test_large_errors_stay_in_their_columns(self):
        path = self.write("astray.txt", self.times, 1e4 * self.positions, self.rotations)
        printed = run("-q", "evaluate", self.folder / "dataset", "--estimated", path)
        row = next(line for line in printed.stdout.splitlines() if "FAILED" in line)
        cells = row.split()
        self.assertEqual(len(cells), 10)
        ate = self.one(path)["ate_m"]
        for cell, name in zip(cells[3:7], ("rmse", "mean", "median", "max")):
            self.assertAlmostEqual(float(cell) / (1e3 * ate[name]), 1, delta=0.01)

    def unprojected(self):
        """World points of all pixels of all frames, from the depth images."""
        import cv2
        x, y = np.meshgrid(np.arange(self.lens["width"]) + 0.5, np.arange(self.lens["height"]) + 0.5)
        rays = np.stack([(x - self.lens["cx"]) / self.lens["fx"],
                         (y - self.lens["cy"]) / self.lens["fy"], np.ones_like(x)], -1)
        points = []
        for i, (position, rotation) in enumerate(zip(self.positions, self.rotations)):
            depth = cv2.imread(str(self.folder / "dataset" / "depth" / f"{i:06}.png"),
                               cv2.IMREAD_UNCHANGED) / 1000.0
            seen = depth > 0
            points.append((rays[seen] * depth[seen][:, None]) @ rotation.T + position)
        return np.concatenate(points)

    def ply(self, name, points, form):
        """A PLY file in the given format whose points follow another element and have other
        properties, too."""
        path = self.folder / name
        mark = {"ascii": None, "binary_little_endian": "<", "binary_big_endian": ">"}[form]
        head = (f"ply\nformat {form} 1.0\ncomment made by a test\nelement camera 1\n"
                "property list uchar int what\nelement vertex "
                f"{len(points)}\nproperty uchar red\nproperty double x\nproperty double y\n"
                "property double z\nend_header\n").encode()
        if mark is None:
            body = b"2 7 8\n" + "\n".join(
                "9 " + " ".join(repr(float(v)) for v in p) for p in points).encode() + b"\n"
        else:
            body = struct.pack(mark + "Bii", 2, 7, 8) + b"".join(
                struct.pack(mark + "Bddd", 9, *p) for p in points)
        path.write_bytes(head + body)
        return path

    def test_a_cloud_of_the_depth_lies_on_the_surfaces_and_covers_them(self):
        path = self.write("cloud.txt", self.times, *self.moved(0.5))
        turn = about([1, 2, 3], 0.8)
        points = 0.5 * self.unprojected()[::7] @ turn.T + [4, -2, 1]
        reports = [self.one(path, "--align", "sim3", "--cloud", self.ply(form, points, form))
                   for form in ("ascii", "binary_little_endian", "binary_big_endian")]
        cloud = reports[0]["reconstruction"]
        self.assertEqual(cloud["points"], len(points))
        self.assertLess(cloud["p90_m"], 0.001)  # rounded to millimetres
        self.assertGreater(cloud["completeness_5cm"], 0.98)
        for other in reports[1:]:
            self.assertAlmostEqual(other["reconstruction"]["mean_m"], cloud["mean_m"], places=12)

    def test_the_distances_of_a_cloud_are_those_of_the_points(self):
        path = self.write("truth.txt", self.times, self.positions, self.rotations)
        # Over the middle of the floor, whose top is at 0: 90 points 2 cm above it, 10 points 30 cm.
        random = np.random.default_rng(3)
        points = np.column_stack([random.uniform(1.2, 2.5, 100), random.uniform(-2.5, -1.0, 100),
                                  np.where(np.arange(100) < 90, 0.02, 0.3)])
        report = self.one(path, "--align", "none", "--cloud", self.ply("floor.ply", points, "ascii"))
        cloud = report["reconstruction"]
        self.assertAlmostEqual(cloud["mean_m"], 0.9 * 0.02 + 0.1 * 0.3, places=6)
        self.assertAlmostEqual(cloud["median_m"], 0.02, places=6)
        self.assertAlmostEqual(cloud["p90_m"], 0.02, places=6)
        self.assertLess(cloud["completeness_5cm"], 0.2)

    def test_what_cannot_be_used_is_refused_with_its_place(self):
        dataset = self.folder / "dataset"
        timeless = self.folder / "timeless.txt"
        timeless.write_text("1 0 0 0 0 1 0 0 0 0 1 0\n")
        self.assertFails(run("-q", "evaluate", dataset, "--estimated", timeless), 4, "no times")
        bad = self.folder / "bad.txt"
        far = self.folder / "far.txt"
        bad.write_text("nothing of the kind\n")
        far.write_text("0 1e9 0 0 0 0 0 1\n")
        for path, word in [(bad, "not a trajectory"), (far, "1000 km")]:
            refused = run("-q", "evaluate", dataset, "--estimated", path)
            self.assertFails(refused, 4, word, path.name)
            self.assertNotIn("--trajectory", refused.stderr)  # evaluate has no such options
        self.assertFails(run("-q", "evaluate", dataset, "--estimated", "nowhere.txt"), 4,
                         "nowhere.txt")
        good = self.write("good2.txt", self.times, self.positions, self.rotations)
        broken = self.folder / "broken.ply"
        whole = self.ply("whole.ply", self.positions, "binary_little_endian").read_bytes()
        broken.write_bytes(whole[:-5])
        self.assertFails(run("-q", "evaluate", dataset, "--estimated", good, "--cloud", broken), 4,
                         "broken.ply", "ends within")
        self.assertFails(run("-q", "evaluate", dataset, "--estimated", good, "--cloud", broken,
                             "--cloud", broken), 2, "--cloud")
        self.assertFails(run("-q", "evaluate", self.folder, "--estimated", good), 4,
                         "contains datasets", str(self.folder / "dataset") + ".")


if __name__ == "__main__":
    unittest.main()
