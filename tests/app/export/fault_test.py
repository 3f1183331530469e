#!/usr/bin/python3
"""Exports whose system calls fail, one call per run: none reports success when something is
missing, and all can be continued.

Usage: fault_test.py PROGRAM FAILING_CALLS.so [--long] [unittest arguments]
"""
import concurrent.futures
import errno
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from support import small_export
from support.program import PROGRAM, FolderCase, hashes, run
from support.small_export import EVERYTHING

SHIM = os.path.abspath(sys.argv.pop(1))
LONG = "--long" in sys.argv
sys.argv = [word for word in sys.argv if word != "--long"]


class Faults(FolderCase):
    keeps_cache = True

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.project = small_export.plan(cls.folder, 6 if LONG else 2)
        counts = cls.folder / "counts"
        made = cls.export(cls.folder / "unbroken", FAIL_COUNTS=counts)
        assert made.returncode == 0, made.stderr
        cls.expected = hashes(cls.folder / "unbroken")
        cls.counts = {kind: int(count) for kind, count in
                      (line.split() for line in counts.read_text().splitlines())}

    @classmethod
    def export(cls, out, *arguments, **environment):
        return subprocess.run(
            [PROGRAM, "export", cls.project, "--out", out, *EVERYTHING, *arguments],
            capture_output=True, text=True, timeout=300,
            env={**os.environ, "LD_PRELOAD": SHIM, "FAIL_BELOW": str(out),
                 **{name: str(value) for name, value in environment.items()}})

    def new_folder(self):
        return pathlib.Path(tempfile.mkdtemp(dir=self.folder)) / "out"

    def complaint(self, result, out):
        """The fault in how an export ended; empty if there is none."""
        files = hashes(out) if out.exists() else {}
        # The mark of an export that began; a mark that cannot be removed does no harm.
        files.pop(".dollytrack-export", None)
        if result.returncode == 0 and files != self.expected:
            return "it says that all is done: " + str(set(files) ^ set(self.expected))
        if result.returncode not in (0, 6):
            return f"it ended with {result.returncode}: {result.stderr}"
        if result.returncode == 6 and len(result.stderr.strip().splitlines()[-1]) < 20:
            return "it does not say why: " + result.stderr
        if "dataset.json" in files:
            listed = json.loads((out / "dataset.json").read_text())["files"]
            bad = [name for name, value in listed.items() if files.get(name) != value]
            if bad:
                return "dataset.json lists what is not there: " + str(bad)
        return ""

    def check(self, **environment):
        out = self.new_folder()
        result = self.export(out, **environment)
        complaint = self.complaint(result, out)
        if LONG and not complaint:
            # Once more with the same fault, which may now hit the continuation.
            result = self.export(out, "--resume", **environment)
            complaint = self.complaint(result, out)
        if not complaint:
            result = run("export", self.project, "--out", out, "--resume", *EVERYTHING)
            if result.returncode != 0:
                complaint = "it cannot be continued: " + result.stderr
            elif hashes(out) != self.expected:
                complaint = "continued, it has other bytes: " + str(
                    set(hashes(out).items()) ^ set(self.expected.items()))
        shutil.rmtree(out.parent)
        return complaint and f"{environment}: {complaint}"

    def check_all(self, faults):
        with concurrent.futures.ThreadPoolExecutor(2) as threads:
            complaints = [one for one in threads.map(lambda fault: self.check(**fault), faults)
                          if one]
        self.assertEqual(complaints, [])

    def test_calls_are_seen_at_all(self):
        for kind in ["open", "write", "sync", "rename", "close", "mkdir"]:
            self.assertGreater(self.counts[kind], 0, kind)

    def test_any_call_fails_once(self):
        """Fails every call with --long, otherwise about 12 of each kind, evenly spread."""
        faults = [dict(FAIL_CALL=kind, FAIL_NTH=nth, FAIL_ERRNO=errno.EIO)
                  for kind, count in self.counts.items()
                  for nth in range(1, count + 1, 1 if LONG else max(1, count // 12))]
        self.check_all(faults)
        print(f"faults: {len(faults)} system calls failed", file=sys.stderr)

    def test_a_disk_that_fills_up(self):
        count = self.counts["write"]
        self.check_all([dict(FAIL_CALL="write", FAIL_NTH=nth, FAIL_LAST=10**6,
                             FAIL_ERRNO=errno.ENOSPC)
                        for nth in range(1, count + 1, 1 if LONG else max(1, count // 8))])

    def test_any_call_of_the_whole_program_fails_at_random(self):
        """Also calls of libraries and of the scene's import; libfiu makes them fail."""
        if shutil.which("fiu-run") is None:
            self.skipTest("fiu-run is not installed")
        ended = set()
        for point in ["posix/io/oc/open", "posix/io/rw/write", "posix/io/sync/fsync",
                      "posix/io/dir/rename", "posix/io/oc/close", "posix/io/rw/read"]:
            for probability in [0.3, 0.02] * (10 if LONG else 1):
                out = self.new_folder()
                result = subprocess.run(
                    ["fiu-run", "-x", "-f", "", "-c",
                     f"enable_random name={point},probability={probability}",
                     PROGRAM, "export", self.project, "--out", out, *EVERYTHING],
                    capture_output=True, text=True, timeout=300)
                ended.add(result.returncode == 0)
                with self.subTest(point=point, probability=probability):
                    self.assertGreaterEqual(result.returncode, 0, result.stderr)
                    if result.returncode == 0:
                        self.assertEqual(hashes(out), self.expected)
                    result = run("export", self.project, "--out", out, "--resume", *EVERYTHING)
                    self.assertEqual(result.returncode, 0, result.stderr)
                    self.assertEqual(hashes(out), self.expected)
                shutil.rmtree(out.parent)
        self.assertIn(False, ended)


class Replacing(FolderCase):
    """A dataset replaces a complete one while system calls fail or the program is killed before
    them: one of the two is complete, or --resume completes the new one."""
    keeps_cache = True
    SMALL = ["--modalities", "instance", "--formats", "coco,tum,colmap"]
    OLD = ["--modalities", "depth,instance", "--formats", "coco,frames"]

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.project = small_export.plan(cls.folder, 3)
        counts = cls.folder / "counts"
        cls.old = cls.folder / "old"
        for out, arguments, environment in [
                (cls.old, [*cls.OLD, "--range", "0:2"], {}),
                (cls.folder / "new", cls.SMALL, {}),
                (cls.folder / "counted", [*cls.OLD, "--range", "0:2"], {}),
                (cls.folder / "counted", [*cls.SMALL, "--overwrite"], {"FAIL_COUNTS": counts})]:
            made = cls.export(out, *arguments, **environment)
            assert made.returncode == 0, made.stderr
        cls.expected = hashes(cls.folder / "new")
        cls.before = hashes(cls.old)
        cls.counts = {kind: int(count) for kind, count in
                      (line.split() for line in counts.read_text().splitlines())}

    @classmethod
    def export(cls, out, *arguments, **environment):
        return subprocess.run(
            [PROGRAM, "export", cls.project, "--out", out, *arguments],
            capture_output=True, text=True, timeout=300,
            env={**os.environ, "LD_PRELOAD": SHIM, "FAIL_BELOW": str(out),
                 **{name: str(value) for name, value in environment.items()}})

    def complaint(self, kind, nth, error):
        out = pathlib.Path(tempfile.mkdtemp(dir=self.folder)) / "out"
        shutil.copytree(self.old, out)
        fault = dict(FAIL_CALL=kind, FAIL_NTH=nth, FAIL_ERRNO=error)
        result = self.export(out, *self.SMALL, "--overwrite", **fault)
        left = hashes(out)
        if result.returncode not in ([0, 6] if error else [0, -9]):
            return f"{fault}: it ended with {result.returncode}: {result.stderr}"
        if result.returncode == 0 and {name: left.get(name) for name in self.expected} != self.expected:
            return f"{fault}: it says that all is done"
        if "dataset.json" in left:
            whole = self.before if left["dataset.json"] == self.before["dataset.json"] else self.expected
            if {name: left.get(name) for name in whole} != whole:
                return f"{fault}: the dataset is not whole"
        result = run("export", self.project, "--out", out, *self.SMALL, "--overwrite", "--resume")
        if result.returncode != 0:
            # An export that failed before it began leaves nothing to continue, only the old
            # dataset.
            result = run("export", self.project, "--out", out, *self.SMALL, "--overwrite")
            if {name: left.get(name) for name in self.before} != self.before:
                return f"{fault}: it cannot be continued: {result.stderr}"
        if hashes(out) != self.expected:
            return f"{fault}: continued, it has other files: " + str(
                set(hashes(out).items()) ^ set(self.expected.items()))
        shutil.rmtree(out.parent)
        return ""

    def test_the_old_dataset_or_the_new_one_is_whole(self):
        faults = [(kind, nth, error) for kind in ["rename", "unlink", "mkdir", "sync"]
                  for nth in range(1, self.counts[kind] + 1) for error in [errno.EIO, 0]
                  if LONG or (nth + (error > 0)) % 2 == 0]
        with concurrent.futures.ThreadPoolExecutor(2) as threads:
            complaints = [one for one in threads.map(lambda fault: self.complaint(*fault), faults)
                          if one]
        self.assertEqual(complaints, [])
        print(f"replacing: {len(faults)} faults", file=sys.stderr)


class Places(FolderCase):
    """Folders that cannot be written to: exit code 6, and a message that names them."""
    keeps_cache = True

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.project = small_export.plan(cls.folder, 30)

    def mount(self, options):
        place = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", options, "tmpfs", place],
                                 capture_output=True)
        if mounted.returncode != 0:
            self.skipTest("nothing can be mounted here")
        self.addCleanup(subprocess.run, ["umount", place], check=True)
        return place

    def refused(self, out, *words):
        result = run("export", self.project, "--out", out, *EVERYTHING)
        self.assertEqual(result.returncode, 6, result.stderr)
        message = result.stderr.strip().splitlines()[-1]
        for word in [str(out), *words]:
            self.assertIn(word, message)

    def test_a_disk_too_small(self):
        place = self.mount("size=256k")
        self.refused(place / "out", "MB are needed")
        self.assertFalse((place / "out").exists())

    def test_a_disk_without_room_for_more_files(self):
        # Space for all bytes but only for 40 files: the error appears only while writing.
        place = self.mount("size=64m,nr_inodes=40")
        out = place / "out"
        result = run("export", self.project, "--out", out, *EVERYTHING)
        self.assertEqual(result.returncode, 6, result.stderr)
        self.assertIn("full", result.stderr)
        self.assertFalse((out / "dataset.json").exists())
        subprocess.run(["mount", "-o", "remount,nr_inodes=4000", place], check=True)
        result = run("export", self.project, "--out", out, "--resume", *EVERYTHING)
        self.assertEqual(result.returncode, 0, result.stderr)
        whole = self.folder / "whole"
        run("export", self.project, "--out", whole, *EVERYTHING)
        self.assertEqual(hashes(out), hashes(whole))

    def test_a_read_only_disk(self):
        place = self.mount("size=64m")
        (place / "out").mkdir()
        subprocess.run(["mount", "-o", "remount,ro", place], check=True)
        self.refused(place / "out", "read-only")

    def test_a_folder_that_vanishes(self):
        out = pathlib.Path(tempfile.mkdtemp(dir=self.folder)) / "out"
        process = subprocess.Popen([PROGRAM, "export", self.project, "--out", out, *EVERYTHING],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        while process.poll() is None and not list(out.glob("rgb/*.png")):
            pass
        out.rename(out.with_name("elsewhere"))
        _, errors = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 6, errors)
        self.assertIn(str(out), errors.strip().splitlines()[-1])
        # Nothing is lost.
        result = run("export", self.project, "--out", out.with_name("elsewhere"), "--resume",
                     *EVERYTHING)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_a_folder_of_other_files(self):
        out = self.folder / "foreign"
        out.mkdir()
        (out / "thesis.txt").write_text("years of work")
        self.refused(out, "not a Dollytrack dataset")
        self.assertEqual([path.name for path in out.iterdir()], ["thesis.txt"])


if __name__ == "__main__":
    unittest.main()
