"""Damaged and malicious files that the program itself reads, not its importer process: projects,
rigs, jobs files, trajectories, datasets, journals, caches. Usage: parent_files_test.py DOLLYTRACK
[--long]"""
import fcntl
import functools
import json
import os
import pathlib
import random
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import termios
import unittest

from support.program import FolderCase, PROGRAM, hashes, lines_in, run, start, wait_for
from mutants import mutant
from support import small_export, small_models

LONG = "--long" in sys.argv
if LONG:
    sys.argv.remove("--long")
MUTANTS = int(os.environ.get("MUTANTS", 3000)) if LONG else 100
FIRST = int(os.environ.get("FIRST_MUTANT", 0))  # the long run can be made in parts
PROCESSOR_S = 10        # a small file is read or refused much faster
MEMORY_KIB = 1 << 20
LAST_RESORT_S = 600     # against hangs, on any busy machine
CODES = {0, 2, 3, 4, 6}
TUM = "# time tx ty tz qx qy qz qw\n" + "".join(f"{i * 0.05} {i * 0.1} 0 1 0 0 0 1\n" for i in range(9))
KITTI = "".join(f"1 0 0 {i} 0 1 0 0 0 0 1 2\n" for i in range(9))
COLMAP = "".join(f"{i} 1 0 0 0 {i} 0 0 1 {i:04}.png\n\n" for i in range(1, 9))
SCENE_NET = "#first three elements\n" + "".join(f"{t} 0 {i} 0 1 0 0\n" for i in range(9) for t in (i, i))
TARTAN = "".join(f"{i} 0 1 0 0 0 1\n" for i in range(9))
JOBS = """out = "out"
scenes = ["*.obj", "**/*.dolly"]
exclude = ["none*"]
seeds = [1, 2]
planners = ["dollytrack", "uniform"]
require = ["well_captured_rate>=0.8"]
[[set]]
name = "near"
set = {fill = 0.5, max_frames = 20}
[export]
modalities = ["rgb", "depth"]
formats = ["coco"]
"""
LABELS = "coffee table,table\n=1234,chair,target\nleg,,part\nwall,wall,structure\n"
RIG = {"format": "dollytrack-rig", "version": 1, "cameras": [
    {"name": "left", "lens": "pinhole", "width_px": 64, "height_px": 48},
    {"name": "wide", "lens": "fisheye", "width_px": 64, "height_px": 64, "fov_deg": 170}]}
SCRIPT = [small_export.TRACK, {"op": "exclude", "object": "sofa"},
          {"op": "add_region", "name": "r", "center": [1, 1, 1], "size": [1, 1, 1], "weight": 2}]


class Finished:
    """The result of a run of the program, with its processor time and memory."""

    def __init__(self, arguments, **options):
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                                   preexec_fn=self.limit, **options)
        # Kills what SIGTERM did not end; a test that needs this has failed.
        try:
            self.output = process.communicate(timeout=LAST_RESORT_S)[0].decode(errors="replace")
        except subprocess.TimeoutExpired:
            process.kill()
            self.output = process.communicate()[0].decode(errors="replace") + "\nit hangs"
        self.code = process.returncode

    @staticmethod
    def limit():
        """The system ends a run that exceeds these limits; its exit code shows that."""
        resource.setrlimit(resource.RLIMIT_CPU, (4 * PROCESSOR_S, 4 * PROCESSOR_S))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


@functools.cache
def made_once():
    """A folder with a project, its plan, and a dataset with all modalities and formats."""
    folder = tempfile.TemporaryDirectory()
    work = pathlib.Path(folder.name)
    project = small_export.plan(work, 3)
    made = run("export", project, "--out", work / "dataset", *small_export.EVERYTHING)
    assert made.returncode == 0, made.stderr
    return folder


class ParentCase(FolderCase):
    """Each class gets a copy of that folder."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.work = cls.folder / "work"
        shutil.copytree(made_once().name, cls.work)
        cls.project = cls.work / "room.dolly"
        cls.dataset = cls.work / "dataset"

    def runs(self, *arguments, **options):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = Finished(arguments, **options)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        done.seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        self.assertIn(done.code, CODES, (arguments, done.output[-2000:]))
        self.assertNotIn("unexpected failure", done.output, arguments)
        self.assertNotIn("it hangs", done.output, arguments)
        self.assertLess(done.seconds, PROCESSOR_S, arguments)
        self.assertLess(after.ru_maxrss, MEMORY_KIB, arguments)  # the largest child so far
        return done

    def refuses(self, *arguments, words=()):
        done = self.runs(*arguments)
        self.assertEqual(done.code, 4, done.output)
        for word in words:
            self.assertIn(word, done.output)


class Mutants(ParentCase):
    """Each mutant replaces an undamaged file, and a command reads it."""

    def seeds(self):
        """(name, bytes, command); the command reads the file of this name in the work folder."""
        with_times = [("m.tum", TUM.encode()), ("m.scenenet", SCENE_NET.encode()),
                      ("m_camera.json", (self.dataset / "camera.json").read_bytes())]
        without_times = [("m.kitti", KITTI.encode()), ("images.txt", COLMAP.encode()),
                         ("m.tartan", TARTAN.encode()), ("m.sh3d", small_models.sh3d()),
                         ("m_transforms.json", (self.dataset / "transforms.json").read_bytes())]
        estimates = [(name, data, ["evaluate", self.dataset, "--estimated", self.work / name])
                     for name, data in with_times]
        estimates += [(name, data, ["compare", self.work / "room.obj", "--planners", "uniform",
                                    "--max-frames", "2", "--trajectory", self.work / name])
                      for name, data in without_times]
        listed = ["edit", self.work / "m.dolly"]
        project = self.project.read_bytes()
        others = [
            ("m.dolly", project, listed),
            ("m.dolly", project, ["edit", self.work / "m.dolly", "--json"]),
            ("m_rig.json", json.dumps(RIG).encode(),
             ["export", self.work / "room.obj", "--rig", self.work / "m_rig.json", "--max-frames",
              "8", "--modalities", "depth", "--out", self.work / "out"]),
            ("m.toml", JOBS.encode(), ["batch", self.work / "m.toml", "--dry-run"]),
            ("m.toml", JOBS.encode(), ["batch", self.work / "m.toml", "--dry-run"]),
            ("m.csv", LABELS.encode(), ["info", self.work / "room.obj", "--labels",
                                        self.work / "m.csv"]),
            ("m_script.json", json.dumps(SCRIPT).encode(),
             ["edit", self.project, "--script", self.work / "m_script.json", "-o",
              self.work / "out.dolly"]),
            ("room.obj.objects.json",
             json.dumps({"format": "dollytrack-objects", "version": 1, "objects": [
                 {"name": "a", "nodes": ["mug"], "class": "cup"}]}).encode(),
             ["info", self.work / "room.obj"])]
        return estimates + others

    def files_of_dataset(self):
        """One file of each kind in the dataset, and dataset.json more often."""
        kinds = {}
        for path in sorted(self.dataset.rglob("*")):
            if path.is_file():
                kinds.setdefault((path.parent, path.suffix), path)
        return [*kinds.values(), *[self.dataset / "dataset.json"] * 4]

    def outside(self):
        """Files that no run may change: all except the mutant and the outputs."""
        return {name: value for name, value in hashes(self.folder).items()
                if not name.startswith(("work/m", "work/out", "work/images", "work/room.obj.o"))}

    def test_each_seed_is_accepted_undamaged(self):
        for name, data, command in self.seeds():
            (self.work / name).write_bytes(data)
            with self.subTest(file=name):
                done = self.runs(*command)
                self.assertEqual(done.code, 0, done.output)

    def test_the_program_outlives_them_all(self):
        seeds = self.seeds()
        in_dataset = self.files_of_dataset()
        before = self.outside()
        ends = {}
        for number in range(FIRST, FIRST + MUTANTS):
            rng = random.Random(number)
            if rng.random() < 0.1:
                path = rng.choice(in_dataset)
                data, command = path.read_bytes(), ["verify", self.dataset]
                if "transforms" not in path.name and rng.random() < 0.1:
                    command = ["evaluate", self.dataset, "--estimated", self.dataset / "tum.txt"]
                elif rng.random() < 0.3:
                    command = ["statistics", self.dataset, "-o", self.work / "out.html"]
            else:
                name, data, command = rng.choice(seeds)
                path = self.work / name
            sound = path.read_bytes() if path.exists() else None
            path.write_bytes(mutant(data, number))
            with self.subTest(number=number, file=path.name, command=command[0]):
                done = self.runs(*command)
                end = (command[0], done.code)
                ends[end] = ends.get(end, 0) + 1
            if LONG and number % 100 == 99:
                print(f"{number + 1}: {ends}", file=sys.stderr, flush=True)
            if sound is None:
                path.unlink()
            else:
                path.write_bytes(sound)
            for left in self.work.glob("out*"):
                shutil.rmtree(left) if left.is_dir() else left.unlink()
        self.assertEqual(self.outside(), before)
        self.assertGreater(sum(count for (_, code), count in ends.items() if code == 4),
                           MUTANTS // 5)
        print(f"\n{MUTANTS} mutants from {FIRST}: {ends}", file=sys.stderr)


class Journals(ParentCase):
    """Whatever a journal or a cache contains, the export gives the same bytes."""

    keeps_cache = True

    def test_a_damaged_journal_or_cache_changes_nothing(self):
        out = self.work / "out"
        arguments = ["export", self.project, "--out", out, "--modalities", "rgb,depth,instance"]
        self.assertEqual(run(*arguments).returncode, 0)
        whole = hashes(out)
        shutil.rmtree(out)
        process = start(*arguments)
        self.assertTrue(wait_for(lambda: lines_in(out / ".dollytrack-export") >= 2
                                 or process.poll() is not None))
        process.kill()
        process.communicate()
        journal = out / ".dollytrack-export"
        if not journal.exists():
            self.skipTest("the export ended before it could be stopped")
        # A killed run may leave these; this one may have been killed between two files.
        (out / "instance" / "000002.png.tmp.1").write_bytes(b"half of")
        kept = self.folder / "kept"
        shutil.copytree(out, kept)
        cached = [path for path in sorted((self.folder / "cache").rglob("*"))
                  if path.suffix in (".scene", ".light")]
        self.assertEqual({path.suffix for path in cached}, {".scene", ".light"})
        for number in range(60 if LONG else 2):
            shutil.rmtree(out)
            shutil.copytree(kept, out)
            journal.write_bytes(mutant(journal.read_bytes(), number))
            entry = cached[number % len(cached)]
            entry.write_bytes(mutant(entry.read_bytes(), number))
            with self.subTest(number=number, cached=entry.name):
                done = self.runs(*arguments, "--resume")
                self.assertEqual(done.code, 0, done.output)
                self.assertEqual(hashes(out), whole)


class HandMade(ParentCase):
    """Files that are known to have stopped the program or filled its memory."""

    def test_deep_nesting(self):
        deep = "[" * 200_000 + "]" * 200_000
        path = self.work / "m.json"
        for text in ['[{"pos":[0,0,0],"target":[1,0,0],"room":%s}]' % deep,
                     '{"frames":[{"transform_matrix":%s}]}' % deep]:
            path.write_text(text)
            self.refuses("evaluate", self.dataset, "--estimated", path, words=[path.name, "nested"])
        path.write_text(deep)
        done = self.runs("edit", self.project, "--script", path)
        self.assertEqual((done.code, "nested" in done.output), (4, True), done.output)
        path = self.work / "m.dolly"
        path.write_text('{"dollytrack_project":1,"x":%s}' % deep)
        self.refuses("edit", path, words=[path.name, "nested"])
        path = self.work / "m.toml"
        path.write_text("a" + ".a" * 500_000 + "=1\n")
        self.refuses("batch", path, "--dry-run", words=["m.toml:1", "parts"])
        path.write_text('scenes = ["' + "**/" * 40 + '*.xyz"]\n')
        self.refuses("batch", path, "--dry-run", words=["matches no scene"])

    def test_pipes_and_devices(self):
        """A pipe or device in place of any file is refused as not a regular file, without
        waiting."""
        for name, arguments in [
                ("m.dolly", ["edit", self.work / "m.dolly"]),
                ("m.dolly", ["info", self.work / "m.dolly"]),
                ("m.obj", ["info", self.work / "m.obj"]),
                ("m.csv", ["info", self.work / "room.obj", "--labels", self.work / "m.csv"]),
                ("m.toml", ["batch", self.work / "m.toml", "--dry-run"]),
                ("m.json", ["edit", self.project, "--script", self.work / "m.json"]),
                ("m.tum", ["evaluate", self.dataset, "--estimated", self.work / "m.tum"])]:
            path = self.work / name
            path.unlink(missing_ok=True)
            for kind in ("pipe", "device"):
                os.mkfifo(path) if kind == "pipe" else path.symlink_to("/dev/zero")
                with self.subTest(name=name, kind=kind):
                    self.refuses(*arguments, words=[name, "not an ordinary file"])
                path.unlink()

    def test_pipes_and_devices_in_a_dataset(self):
        copy = self.work / "out"
        shutil.copytree(self.dataset, copy)
        kinds = {}
        for path in sorted(copy.rglob("*")):
            if path.is_file() and path.name != "dataset.json":
                kinds.setdefault((path.parent, path.suffix), path)
        for number, path in enumerate(kinds.values()):
            path.unlink()
            os.mkfifo(path) if number % 2 else path.symlink_to("/dev/zero")
        done = self.runs("verify", copy, "--show", 20)
        self.assertEqual(done.code, 4, done.output)
        self.assertIn("cannot be read", done.output)
        (copy / "dataset.json").unlink()
        os.mkfifo(copy / "dataset.json")
        self.refuses("verify", copy, words=["dataset.json", "not an ordinary file"])
        done = self.runs("export", self.project, "--out", copy)
        self.assertEqual(done.code, 6, done.output)
        self.assertIn("not an ordinary file", done.output)
        shutil.rmtree(copy)

    def test_files_of_a_dataset_that_are_far_too_large(self):
        copy = self.work / "out"
        shutil.copytree(self.dataset, copy)
        os.truncate(copy / "frames.csv", 1 << 40)  # takes no space on the disk
        done = self.runs("verify", copy)
        self.assertEqual(done.code, 4, done.output)
        self.assertIn("1099511627776 bytes", done.output)
        shutil.rmtree(copy)

    def test_a_stored_plan_of_the_wrong_form_is_refused_before_anything_is_rendered(self):
        for place, value in [(["metrics"], []), (["metrics", "repair"], {"rounds": 1}),
                             (["metrics", "min_clearance_at"], {}), (["metrics", "objects"], "5"),
                             (["metrics", "uncaptured"], ["mug"]), (["metrics", "rooms"], 3),
                             (["trajectory", "frames"], {}), (["rooms"], [1])]:
            project = json.loads(self.project.read_text())
            at = project["result"]
            for key in place[:-1]:
                at = at[key]
            at[place[-1]] = value
            path = self.work / "m.dolly"
            path.write_text(json.dumps(project))
            with self.subTest(place=place):
                self.refuses("export", path, "--out", self.work / "out",
                             words=["m.dolly: result." + ".".join(place)])
                self.assertFalse((self.work / "out").exists())
        for section, value in [("scene", []), ("parameters", 1), ("edits", "x"), ("scene", {}),
                               ("scene", {"path": "room.obj", "import": {"unit_m": "x"}}),
                               ("dollytrack_project", "1"), ("dollytrack_project", -1)]:
            project = {**json.loads(self.project.read_text()), section: value}
            path.write_text(json.dumps(project))
            with self.subTest(section=section):
                self.refuses("edit", path, words=["m.dolly: " + section])

    def test_impossible_numbers_in_a_dataset(self):
        """Positions, lenses and depths far beyond any scene's, which Embree would abort on."""
        copy = self.work / "out"
        shutil.copytree(self.dataset, copy)
        whole = json.loads((copy / "dataset.json").read_text())
        lens = ["conventions", "intrinsics"]
        for place, value in [(["frames", 1, "position", 0], 1e20), (lens + ["cx"], -1e30),
                             (lens + ["cy"], 1e300), (lens + ["near_m"], -1e20),
                             (lens + ["fx"], 1e20), (["frames", 0, "quaternion_xyzw", 3], 1e200),
                             (["objects", 2, "box", "center", 1], -1e18),
                             (["objects", 2, "box", "size", 0], -1), (["format_version"], 2),
                             (["conventions", "rgb_right", "baseline_m"], 1e30)]:
            card = json.loads(json.dumps(whole))
            at = card
            for key in place[:-1]:
                at = at[key]
            at[place[-1]] = value
            (copy / "dataset.json").write_text(json.dumps(card))
            with self.subTest(place=place):
                words = (["format version 2"] if value == 2 else [] if value == 1e30 else
                         ["dataset.json: " + place[0]])
                self.refuses("verify", copy, words=words)
                if words:
                    for command in ("view", "statistics"):
                        self.refuses(command, copy, "-o", self.work / "page.html", words=words)
                    self.refuses("gather", copy, "--format", "coco", "--out", self.work / "all",
                                 words=words)
        shutil.rmtree(copy)

    def test_very_many_fields_cost_no_time(self):
        """An ordered object takes quadratic time; only the list of files may be so long."""
        copy = self.work / "out"
        shutil.copytree(self.dataset, copy)
        whole = json.loads((copy / "dataset.json").read_text())
        many = {f"x/{i}": "0" * 64 for i in range(200_000)}
        for place, said in [("files", "missing"), ("metrics", "fields, more than")]:
            card = {**whole, place: {**whole[place], **many}}
            (copy / "dataset.json").write_text(json.dumps(card))
            with self.subTest(place=place):
                done = self.runs("verify", copy)
                self.assertEqual(done.code, 4)
                self.assertIn(said, done.output)
        shutil.rmtree(copy)

    def test_long_lists_are_refused(self):
        operations = [{"op": "add_no_go", "center": [1, 1, 1], "size": [1, 1, 1]}] * 50_000
        (self.work / "m.json").write_text(json.dumps(operations))
        done = self.runs("edit", self.project, "--script", self.work / "m.json", "-o",
                         self.work / "out.dolly")
        self.assertEqual((done.code, "There are 1000 no-go boxes" in done.output), (2, True), done.output)
        (self.work / "m.toml").write_text(
            f'scenes = ["room.obj"]\nout = "out"\nseeds = {list(range(200_000))}\n')
        self.refuses("batch", self.work / "m.toml", "--dry-run", words=["200000 jobs"])

    def test_frames_that_are_only_listed_cost_no_time(self):
        copy = self.work / "out"
        shutil.copytree(self.dataset, copy)
        card = json.loads((copy / "dataset.json").read_text())
        first = card["frames"][0]
        card["frames"] = [{**first, "index": i, "trajectory_frame": i, "time_s": i * 0.05}
                          for i in range(200_000)]
        (copy / "dataset.json").write_text(json.dumps(card))
        self.refuses("verify", copy, words=["dataset.json", "200000 frames", "missing"])
        shutil.rmtree(copy)

    def test_sigterm_ends_a_program_whose_output_nobody_takes(self):
        size = 4096
        process = subprocess.Popen([PROGRAM, "verify", self.dataset, "--json"],
                                   stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, pipesize=size)

        def waiting():
            found = fcntl.ioctl(process.stdout, termios.FIONREAD, struct.pack("i", 0))
            return struct.unpack("i", found)[0] == size

        # Once the pipe is full, the process sleeps forever.
        self.assertTrue(wait_for(waiting))
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(timeout=LAST_RESORT_S), 128 + signal.SIGTERM)
        process.stdout.close()


if __name__ == "__main__":
    unittest.main()
