"""Progress, threads, signals and forks of programs that use the Python module."""
import logging
import threading
import unittest

import numpy as np

from module import RoomCase, dt, interrupt_when, start_python


class ProcessTest(RoomCase):
    def test_drawings_in_threads_take_turns(self):
        results = {}

        def draw(number):
            results[number] = [frame["rgb"] for frame in self.plan.render("rgb")]
        threads = [threading.Thread(target=draw, args=(i,)) for i in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for number in (1, 2):
            np.testing.assert_array_equal(results[0], results[number])

    def test_progress_rises_to_the_end(self):
        told = []
        dt.load(self.room, progress=lambda fraction, stage: told.append((fraction, stage)))
        self.plan.export(self.folder / "told", progress=lambda *news: told.append(news))
        fractions = [fraction for fraction, stage in told if stage == "frames"]
        self.assertEqual(fractions, sorted(fractions))
        self.assertTrue(all(0 <= fraction <= 1 for fraction, _ in told))

    def test_an_exception_in_progress_stops_the_work(self):
        class Enough(Exception):
            pass

        def refuse(*_):
            raise Enough
        # Progress is reported every 50 ms; this export takes much longer than that.
        plan = self.scene.plan(max_frames=60, width_px=320, height_px=240)
        with self.assertRaises(Enough):
            plan.export(self.folder / "stopped", progress=refuse)
        self.assertFalse((self.folder / "stopped" / "dataset.json").exists())
        plan.export(self.folder / "stopped", resume=True)
        plan.export(self.folder / "unstopped")
        self.assertSameFiles(self.folder / "stopped", self.folder / "unstopped")

    def test_other_threads_run_meanwhile(self):
        ticks, ends = [0], threading.Event()

        def tick():
            while not ends.wait(0.001):
                ticks[0] += 1
        thread = threading.Thread(target=tick)
        thread.start()
        before = ticks[0]
        self.plan.export(self.folder / "meanwhile", overwrite=True)
        during = ticks[0] - before
        ends.set()
        thread.join()
        self.assertGreater(during, 2)

    def test_ctrl_c_keeps_finished_frames(self):
        out = self.folder / "interrupted"
        code = """
import dollytrack as dt
plan = dt.load(sys.argv[1]).plan(max_frames=300)
def told(fraction, stage):
    if stage == "frames" and fraction > 0.06:
        print("draws", flush=True)
try:
    plan.export(sys.argv[2], progress=told)
except KeyboardInterrupt:
    print("interrupted", len(plan))
"""
        printed, errors, ended = interrupt_when(start_python(code, self.room, out), "draws")
        self.assertEqual(ended, 0, errors)
        self.assertIn("interrupted", printed)
        self.assertFalse((out / "dataset.json").exists())
        self.assertTrue((out / ".dollytrack-export").exists())
        with self.assertRaisesRegex(dt.BadInput, "did not finish.*resume=True"):
            dt.Dataset(out)
        self.assertGreater(len(list((out / "rgb").iterdir())), 0)

    def test_notes_go_to_pythons_loggers(self):
        with self.assertLogs("dollytrack.planning", logging.WARNING) as logs:
            self.scene.plan(anchors="corridors", max_frames=4)
        self.assertIn("corridors", logs.output[0])

    def test_a_daemon_thread_ends_with_its_process(self):
        process = start_python("""
import sys, threading, dollytrack as dt
plan = dt.load(sys.argv[1]).plan(max_frames=300)
started = threading.Event()
threading.Thread(target=lambda: plan.export(sys.argv[2], progress=lambda *_: started.set()),
                 daemon=True).start()
started.wait()
""", self.room, self.folder / "by_daemon")
        _, errors = process.communicate(timeout=600)
        self.assertEqual(process.returncode, 0, errors[-2000:])

    def test_drawings_of_both_drivers_take_turns(self):
        with self.plan.render("rgb", gl="egl") as egl, self.plan.render("rgb", gl="egl") as other:
            first = next(egl)["rgb"]
            osmesa = self.plan.render("rgb", gl="osmesa")
            self.assertEqual(next(osmesa)["rgb"].shape, first.shape)
            other.close()
            np.testing.assert_array_equal(next(osmesa)["rgb"].shape, next(egl)["rgb"].shape)
            osmesa.close()
            self.assertEqual(next(egl)["rgb"].shape, first.shape)

    def test_a_forked_process_is_told_not_crashed(self):
        code = """
import os, sys
import dollytrack as dt
scene = dt.load(sys.argv[1])
frames = scene.plan(max_frames=4, width_px=64, height_px=48).render("instance")
next(frames)
child = os.fork()
if child == 0:
    try:
        scene.plan(max_frames=4)
    except dt.Failed as error:
        assert "spawn" in str(error)
        del frames
        os._exit(7)
    os._exit(1)
_, status = os.waitpid(child, 0)
assert os.waitstatus_to_exitcode(status) == 7, status
print(len(list(frames)))
"""
        process = start_python(code, self.room)
        out, errors = process.communicate(timeout=300)
        self.assertEqual((process.returncode, out.strip()), (0, "3"), errors)


if __name__ == "__main__":
    unittest.main()
