#!/usr/bin/python3
"""The program under system limits, with file names that could harm a terminal, and with large
input: limits_test.py PROGRAM [unittest arguments]"""
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import unittest

from support import tiny_room
from support.program import PROGRAM, FolderCase, run, wait_for

MB = 1_000_000
CONTROL = re.compile(rb"[\x00-\x08\x0b-\x1f\x7f]|\xc2[\x80-\x9f]|\xe2\x80\xae")


def run_limited(limits, *arguments, **options):
    """Runs the program with soft and hard system limits, given by kind."""
    def limit():
        for kind, most in limits.items():
            resource.setrlimit(kind, (most, most))
    return run(*arguments, preexec_fn=limit, **options)


def printed(*arguments):
    """Standard output and error output as bytes."""
    result = subprocess.run([os.fsencode(PROGRAM), *map(os.fsencode, arguments)],
                            capture_output=True)
    return result.returncode, result.stdout, result.stderr


class Limits(FolderCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.room = cls.folder / "room.obj"
        tiny_room.write(cls.room)
        cls.project = cls.folder / "room.dolly"
        planned = run("plan", cls.room, "-o", cls.project, "--max-frames", 4, "--set",
                      "width_px=64", "--set", "height_px=48")
        assert planned.returncode == 0, planned.stderr

    # --- memory

    def test_a_crash_is_explained_if_the_address_space_is_limited(self):
        for limit, code in ((64_000 * MB, 1), (resource.RLIM_INFINITY, -signal.SIGSEGV)):
            with self.subTest(limit=limit):
                out = self.folder / f"crash_{code}"
                process = subprocess.Popen(
                    [PROGRAM, "-q", "export", self.room, "--out", out, "--max-frames", "100"],
                    stderr=subprocess.PIPE, text=True,
                    preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
                self.assertTrue(wait_for(lambda: (out / ".dollytrack-export").exists()))
                process.send_signal(signal.SIGSEGV)
                _, words = process.communicate()
                self.assertEqual(process.returncode, code)
                self.assertEqual("ulimit -v" in words, code == 1)

    def test_too_little_memory_is_said_and_no_signal(self):
        ended = {}
        for kind, sizes in ((resource.RLIMIT_DATA, (60, 100, 150, 250)),
                            (resource.RLIMIT_AS, (500, 600, 700))):
            for size in sizes:
                with self.subTest(kind=kind, size=size):
                    result = run_limited({kind: size * MB}, "-q", "info", self.room)
                    if result.returncode == 127:
                        continue  # not even its libraries can be loaded
                    self.assertIn(result.returncode, (0, 1), result.stderr)
                    ended[result.returncode] = ended.get(result.returncode, 0) + 1
                    if result.returncode == 1:
                        last = result.stderr.strip().splitlines()[-1]
                        self.assertRegex(last, "memory|threads")
        self.assertIn(1, ended)

    def test_a_batch_counts_memory_that_is_used(self):
        jobs = self.folder / "jobs.toml"
        jobs.write_text(f'out = "batch"\nscenes = ["room.obj"]\nmemory_mb = 700\n')
        result = run("batch", jobs)
        self.assertEqual(result.returncode, 0, result.stderr)

    # --- files

    def test_what_cannot_be_printed_is_exit_code_6(self):
        for arguments in (["--help"], ["--version"], ["plan", "--help"], ["export", "--list"],
                          ["params"]):
            with open("/dev/full", "w") as full:
                result = subprocess.run([PROGRAM, *arguments], stdout=full,
                                        stderr=subprocess.PIPE, text=True)
            self.assertEqual(result.returncode, 6, arguments)
            self.assertIn("standard output", result.stderr)

    def test_files_that_may_not_grow_are_failed_writes(self):
        result = run_limited({resource.RLIMIT_FSIZE: 200_000}, "export", self.project, "--out",
                             self.folder / "grown", "--set", "width_px=640", "--set",
                             "height_px=480")
        self.assertFails(result, 6, "beyond the limit")

    def test_few_open_files_are_enough_or_said(self):
        result = run_limited({resource.RLIMIT_NOFILE: 16}, "info", self.room)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertNotIn("resource limits", result.stderr)
        result = run_limited({resource.RLIMIT_NOFILE: 9}, "info", self.room)
        self.assertFails(result, 1, "ulimit -n")

    def test_a_plan_that_cannot_be_saved_is_not_made(self):
        for arguments in (["-o", self.folder / "none/x.dolly"],
                          ["--picture", self.folder / "none/x.png"]):
            result = run("plan", self.room, *arguments, "--progress", "json")
            self.assertEqual(result.returncode, 6, result.stderr)
            self.assertNotIn('"stage"', result.stderr)
        moved = self.folder / "edited.dolly"
        result = run("edit", self.project, "-o", self.folder / "none" / moved.name, "--op",
                     '{"op": "set", "name": "fill", "value": 0.5}', "--plan",
                     "--progress", "json")
        self.assertEqual(result.returncode, 6, result.stderr)
        self.assertNotIn('"stage"', result.stderr)

    # --- what reaches a terminal

    def test_no_control_character_reaches_the_terminal(self):
        evil = "ro\x1b[31mom\x07\x9b2J\x7f\u202e"
        scene = self.folder / (evil + ".obj")
        shutil.copy(self.room, scene)
        for arguments in (["info", str(scene)], ["info", str(scene), "--json"],
                          ["plan", str(scene), "--max-frames", "2"],
                          ["info", str(self.folder / ("no" + evil))],
                          ["plan", str(self.room), "--set", evil + "=1"],
                          ["plan", str(self.room), "--only", evil],
                          [evil], ["info", "--" + evil],
                          ["plan", str(self.room), "--progress", "json", "--only", evil],
                          ["export", str(self.project), "--out", str(self.folder / ("o" + evil))]):
            code, out, errors = printed(*arguments)
            self.assertIsNone(CONTROL.search(out), (arguments, out))
            self.assertIsNone(CONTROL.search(errors), (arguments, errors))
            self.assertTrue(out or errors)
            out.decode()
            errors.decode()
            if "--json" in arguments:
                self.assertEqual(code, 0, errors)
                self.assertTrue(json.loads(out)["name"].startswith("ro"))

    # --- reports

    def test_an_absolute_name_that_is_not_opened_is_reported(self):
        outside = self.folder / "outside.mtl"
        outside.write_text("newmtl oak\nKd 0.5 0.3 0.1\n")
        scene = self.folder / "scene" / "absolute.obj"
        scene.parent.mkdir()
        scene.write_text(f"mtllib {outside}\n" + self.room.read_text())
        self.assertIn(f"not opened: {outside}", run("info", scene).stdout)
        (scene.parent / "beneath.mtl").write_text("newmtl oak\n")
        for name in ("beneath.mtl", scene.parent / "beneath.mtl"):
            scene.write_text(f"mtllib {name}\n" + self.room.read_text())
            for given, where in ((scene, None), (scene.name, scene.parent)):
                out = run("info", given, cwd=where).stdout
                self.assertNotIn("not opened", out)
                self.assertNotIn("missing or cannot", out)

    def test_missing_files_of_materials_are_reported(self):
        scene = self.folder / "grey" / "grey.obj"
        scene.parent.mkdir()
        os.mkfifo(scene.parent / "pipe.mtl")
        (scene.parent / "beneath.mtl").write_text("newmtl oak\n")
        for name, missing in [("/no/such.mtl", "such.mtl"), ("no.mtl", "no.mtl"),
                              ("pipe.mtl", "pipe.mtl"), ("grey.mtl", "grey.mtl"),
                              ("beneath.mtl", None), (None, None)]:
            lines = [f"mtllib {name}\n"] if name else []
            scene.write_text("".join(lines) + self.room.read_text())
            told = re.findall(r"material files are missing or cannot be read: (.*)",
                              run("info", scene).stdout)
            self.assertEqual(told, [missing] if missing else [], name)

    def test_repeated_warnings_are_folded(self):
        objects = [{"name": f"thing {i}", "nodes": [f"node {i}"]} for i in range(20_000)]
        scene = self.folder / "many.obj"
        shutil.copy(self.room, scene)
        pathlib.Path(f"{scene}.objects.json").write_text(json.dumps(
            {"format": "dollytrack-objects", "version": 1, "objects": objects}))
        result = run("info", scene)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertLess(len(result.stderr.splitlines()), 60)
        self.assertLess(len(result.stdout.splitlines()), 120)
        self.assertEqual(result.stdout.count("19990 more like this"), 1)
        self.assertNotIn("more like this", result.stderr)

    # --- size

    def test_a_room_that_is_far_too_large_takes_bounded_memory(self):
        lines = [line if not line.startswith("v ") else
                 "v " + " ".join(str(75 * float(x)) for x in line.split()[1:])
                 for line in self.room.read_text().splitlines()]
        scene = self.folder / "large.obj"
        scene.write_text("\n".join(lines))
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
        result = run("info", scene, "--unit", "m")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("too large for cells of", result.stderr)
        peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
        self.assertLess(max(before, peak) * 1024, 850 * MB)


if __name__ == "__main__":
    unittest.main()
