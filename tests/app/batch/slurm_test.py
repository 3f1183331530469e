#!/usr/bin/python3
"""A batch in parts on a real Slurm, whose daemons run on this machine during the test.

Usage: slurm_test.py PROGRAM SUBMIT [unittest arguments]
"""
import json
import os
import pathlib
import subprocess
import sys
import unittest

import slurm_cluster
from support import tiny_room
from support.program import PROGRAM, FolderCase, hashes, run, wait_for

SUBMIT = pathlib.Path(sys.argv.pop(1)).resolve()
OURS = {"DOLLYTRACK": os.path.abspath(PROGRAM)}
ROOMS = 3


class Slurm(FolderCase):
    @classmethod
    def setUpClass(cls):
        reason = slurm_cluster.missing()
        if reason and os.environ.get("DOLLYTRACK_REQUIRE_SLURM") == "1":
            raise RuntimeError("Slurm is required, but " + reason)
        if reason:
            raise unittest.SkipTest("no Slurm: " + reason)
        super().setUpClass()
        cls.cluster = slurm_cluster.Cluster()
        cls.addClassCleanup(cls.cluster.stop)
        for i in range(ROOMS):
            tiny_room.write(cls.folder / f"room_{i}.obj")
        cls.jobs = cls.write_jobs("jobs.toml", 64, 48)

    @classmethod
    def write_jobs(cls, name, width, height):
        jobs = cls.folder / name
        jobs.write_text('scenes = "room_*.obj"\nseeds = [1, 2]\n[[set]]\nname = "small"\n'
                        f"set = {{ width_px = {width}, height_px = {height} }}\n"
                        "[export]\nmax_frames = 30\n")
        return jobs

    def submit(self, parts, out, jobs):
        environment = {**self.cluster.environment, **OURS}
        result = subprocess.run([SUBMIT, str(parts), out, jobs, "--cpus-per-task=1", "--mem=500M"],
                                env=environment, capture_output=True, text=True, cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr + self.cluster.logs())
        return result.stdout.split()

    def sbatch(self, *arguments, **environment):
        result = subprocess.run(["sbatch", "--parsable", "--cpus-per-task=1", "--mem=500M",
                                 *map(str, arguments)], cwd=self.folder, text=True,
                                env={**self.cluster.environment, **OURS, **environment},
                                capture_output=True)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout.strip()

    def datasets(self, out):
        return {path.parent.parent.name: hashes(path.parent)
                for path in out.glob("*/dataset/dataset.json")}

    def summary(self, out):
        return json.loads((out / "summary.json").read_text())

    def test_parts_make_what_one_machine_makes(self):
        out, alone = self.folder / "parts", self.folder / "alone"
        array, merge = self.submit(3, out, self.jobs)
        self.assertEqual(run("batch", self.jobs, "--out", alone).returncode, 0)
        tasks = self.cluster.wait_until_ended(array)
        self.assertEqual(tasks, {i: ("COMPLETED", 0) for i in range(3)})
        self.assertEqual(self.cluster.wait_until_ended(merge), {None: ("COMPLETED", 0)})
        summary = self.summary(out)
        self.assertEqual(summary["verdicts"], {"good": 2 * ROOMS})
        self.assertEqual([job["name"] for job in summary["jobs"]],
                         [job["name"] for job in self.summary(alone)["jobs"]])
        self.assertEqual(self.datasets(out), self.datasets(alone))
        self.assertEqual(len(self.datasets(out)), 2 * ROOMS)

    def test_a_part_that_was_stopped_goes_on(self):
        out = self.folder / "stopped"
        # Larger images: the part takes seconds and is stopped during the first one.
        jobs = self.write_jobs("larger.toml", 640, 480)
        array, merge = self.submit(2, out, jobs)
        self.assertTrue(wait_for(lambda: list(out.glob("room_0.small.seed1/dataset/rgb/*.png"))))
        # Slurm ends jobs in this way when they ran too long or were cancelled.
        self.cluster.ask("scancel", f"{array}_0")
        tasks = self.cluster.wait_until_ended(array)
        self.assertEqual(tasks[1], ("COMPLETED", 0))
        self.assertEqual(tasks[0][0], "CANCELLED")
        # The existing parts are merged; missing ones are reported.
        self.assertEqual(self.cluster.wait_until_ended(merge), {None: ("FAILED", 3)})
        self.assertEqual(self.summary(out)["verdicts"]["good"], ROOMS)
        again = self.sbatch("--array=0", SUBMIT.parent / "dollytrack.sbatch", jobs, "--out",
                            out, DOLLYTRACK_PARTS="2")
        self.assertEqual(self.cluster.wait_until_ended(again), {0: ("COMPLETED", 0)})
        merge = self.sbatch(SUBMIT.parent / "merge.sbatch", out)
        self.assertEqual(self.cluster.wait_until_ended(merge), {None: ("COMPLETED", 0)})
        self.assertEqual(self.summary(out)["verdicts"], {"good": 2 * ROOMS})
        # Equal rooms: the continued export has the same images as the uninterrupted one.
        made = self.datasets(out)
        pictures = [{name: value for name, value in made[f"room_{i}.small.seed1"].items()
                     if name.startswith(("rgb/", "depth/"))} for i in range(2)]
        self.assertEqual(pictures[0], pictures[1])

    def test_a_part_of_an_unknown_number_of_parts_is_refused(self):
        array = self.sbatch("--array=1,3", SUBMIT.parent / "dollytrack.sbatch", self.jobs, "--out",
                            self.folder / "unknown")
        tasks = self.cluster.wait_until_ended(array)
        self.assertEqual(tasks, {1: ("FAILED", 2), 3: ("FAILED", 2)})
        self.assertFalse((self.folder / "unknown").exists())


if __name__ == "__main__":
    unittest.main()
