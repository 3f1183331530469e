#!/usr/bin/python3
"""Jobs of a batch do not affect each other: crashes, hangs, memory, signals.

Usage: batch_jobs_test.py PROGRAM [--long] [unittest arguments]
"""
import json
import os
import signal
import subprocess
import sys
import unittest

from batch_case import BatchCase
from processes import alive, children, memory_kb
from support.program import hashes, run, start, wait_for

LONG = "--long" in sys.argv
if LONG:
    sys.argv.remove("--long")


class BatchJobs(BatchCase):
    def test_a_crash_stops_nobody_else(self):
        self.rooms("a.obj", "b.obj")
        file = self.jobs('scenes = "rooms/*.obj"', export="[export]\nmax_frames = 40\n")
        process, job = self.start_and_stop_a_job(file)
        os.kill(job, signal.SIGSEGV)
        os.kill(job, signal.SIGCONT)
        _, errors = process.communicate()
        self.assertEqual(process.returncode, 3, errors)
        self.assertEqual(sorted(self.verdicts().values()), ["crashed", "good"])
        self.assertEqual(["Segmentation fault" in row["message"]
                          for row in self.summary().values() if row["verdict"] == "crashed"], [True])
        self.assertEqual(run("batch", file).returncode, 0)
        self.assertEqual(set(self.verdicts().values()), {"good"})
        # Two equal rooms: the continued export equals the uninterrupted one.
        self.assertEqual(
            {name: value for name, value in hashes(self.out / "a.small/dataset/rgb").items()},
            {name: value for name, value in hashes(self.out / "b.small/dataset/rgb").items()})

    def test_a_job_that_hangs_is_ended(self):
        self.rooms("a.obj", "b.obj")
        file = self.jobs('scenes = "rooms/*.obj"')
        # The time that the job that does not hang may take on a busy machine.
        process, _ = self.start_and_stop_a_job(file, "--timeout", 30)
        _, errors = process.communicate()
        self.assertEqual(process.returncode, 3, errors)
        self.assertEqual(sorted(self.verdicts().values()), ["good", "timed out"])

    def test_a_job_without_memory_stops_nobody_else(self):
        self.rooms("a.obj")
        big = '[[set]]\nname = "big"\nset = { width_px = 8000, height_px = 8000 }\n'
        file = self.jobs('scenes = "rooms/*.obj"', head="memory_mb = 3000",
                         export=big + "[export]\nmax_frames = 4\n")
        result = run("batch", file)
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertEqual(self.verdicts()["a.small"], "good")
        self.assertIn(self.verdicts()["a.big"], ["failed", "crashed"])

    def test_ctrl_c_ends_the_jobs_and_keeps_what_is_done(self):
        self.rooms("a.obj", "b.obj", "c.obj")
        file = self.jobs('scenes = "rooms/*.obj"', export="[export]\nmax_frames = 40\n")
        process = start("batch", file)
        self.assertTrue(wait_for(lambda: (self.out / "b.small/dataset/rgb").exists()))
        child, = children(process.pid)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, errors)
        self.assertIn("1 of 3 jobs", errors)
        self.assertFalse(alive(child))
        verdicts = self.verdicts()
        self.assertEqual(verdicts["a.small"], "good")
        self.assertEqual(verdicts["c.small"], "not run")
        again = run("batch", file)
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertFalse(self.summary()["a.small"]["ran_now"])
        self.assertEqual(hashes(self.out / "a.small/dataset/rgb"),
                         hashes(self.out / "b.small/dataset/rgb"))

    def test_killed_it_takes_its_jobs_along_and_goes_on_later(self):
        self.rooms("a.obj")
        file = self.jobs('scenes = "rooms/*.obj"', export="[export]\nmax_frames = 40\n")
        process = start("batch", file)
        self.assertTrue(wait_for(lambda: list(self.out.glob("a.small/dataset/rgb/*.png"))))
        child, = children(process.pid)
        process.kill()
        process.communicate()
        self.assertTrue(wait_for(lambda: not alive(child), 10))
        merged = run("batch", "--merge", self.out)
        self.assertEqual(merged.returncode, 3)
        self.assertEqual(self.verdicts(), {"a.small": "begun"})
        listed, = json.loads(run("batch", file, "--dry-run", "--json").stdout)
        self.assertEqual(listed["to_do"], "go on")
        self.assertIn("--resume", listed["runs"])
        result = run("batch", file)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("resuming", (self.out / "a.small/log.txt").read_text())

    def test_its_own_memory_does_not_grow_with_the_scenes(self):
        count = 200 if LONG else 24
        self.rooms(*[f"{i:03}.obj" for i in range(count)])
        file = self.jobs('scenes = "rooms/*.obj"', export="",
                         sets="set = { width_px = 64, height_px = 48, octree_resolution_m = 0.2 }")
        process = start("batch", file, "--quiet")
        samples = []
        while process.poll() is None:
            done = len(list(self.out.glob("*/result.json")))
            samples.append((done, memory_kb(process.pid)))
            try:
                process.wait(0.1)
            except subprocess.TimeoutExpired:
                pass
        _, errors = process.communicate()
        self.assertEqual(process.returncode, 0, errors)
        samples = [(done, kb) for done, kb in samples if kb is not None]
        first = next(kb for done, kb in samples if done >= 4)
        growth_kb = (max(kb for _, kb in samples) - first) / (count - 4)
        print(f"memory: {growth_kb:.1f} kB a scene over {count} scenes", file=sys.stderr)
        self.assertLess(growth_kb, 100)


if __name__ == "__main__":
    unittest.main()
