#!/usr/bin/python3
"""Batches of exports: their results, and how they are continued.

Usage: batch_test.py PROGRAM [unittest arguments]
"""
import fcntl
import html.parser
import json
import os
import shutil
import unittest
import urllib.parse
import xml.etree.ElementTree

from batch_case import BatchCase
from support.program import hashes, run, start, wait_for


class Links(html.parser.HTMLParser):
    """All links of a page."""

    def __init__(self, text):
        super().__init__()
        self.found = []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.found += [value for name, value in attributes if name in ("href", "src")]


class Batch(BatchCase):
    def test_links_in_its_folders_are_not_followed(self):
        self.rooms("a.obj")
        file = self.jobs('scenes = ["rooms/*.obj"]')
        mine = self.place / "mine"
        mine.mkdir()
        (mine / "text").write_text("mine")
        job = self.out / "a.small"
        for name in ["", "log.txt", "metrics.json", "result.json", ".lock", "dataset"]:
            with self.subTest(name):
                shutil.rmtree(self.out, ignore_errors=True)
                (job if name else self.out).mkdir(parents=True)
                (self.out / "jobs.json").write_text('{"format": "dollytrack-batch"}')
                link = job / name if name else job
                link.symlink_to(mine if name in ("", "dataset") else mine / "text")
                result = run("-q", "batch", file)
                self.assertEqual(result.returncode, 3, result.stderr)
                message = self.summary()["a.small"]["message"]
                self.assertIn(str(link), message)
                self.assertIn("link", message)
                self.assertEqual(hashes(mine), {"text": hashes(mine)["text"]})
                self.assertEqual((mine / "text").read_text(), "mine")
        for name in ["jobs.json", "summary.json", "junit.xml", "index.html"]:
            with self.subTest(name):
                shutil.rmtree(self.out)
                self.out.mkdir()
                if name != "jobs.json":
                    (self.out / "jobs.json").write_text('{"format": "dollytrack-batch"}')
                (self.out / name).symlink_to(mine / "text")
                self.assertFails(run("-q", "batch", file), 6, str(self.out / name), "link")
                self.assertEqual((mine / "text").read_text(), "mine")

    # --- results

    def test_every_combination_is_an_export_of_its_own(self):
        self.rooms("bath.obj", "kitchen.obj")
        (self.place / "rooms" / "notes.txt").write_text("no scene")
        (self.place / "rooms" / "broken.obj").write_text("no scene\n")
        file = self.jobs('scenes = ["rooms/*"]\nplanners = ["dollytrack", "uniform"]\n'
                         "seeds = [1, 2]")
        result = run("batch", file, "--jobs", 2)
        self.assertEqual(result.returncode, 3, result.stderr)
        names = [f"{room}.small.{planner}.seed{seed}" for room in ("bath", "broken", "kitchen")
                 for planner in ("dollytrack", "uniform") for seed in (1, 2)]
        verdicts = self.verdicts()
        self.assertEqual(list(verdicts), names)
        for name, verdict in verdicts.items():
            self.assertEqual(verdict, "failed" if name.startswith("broken") else "good")
        # A job gives the same files as a call of the program by hand.
        by_hand = self.place / "by_hand"
        run("export", self.place / "rooms/kitchen.obj", "--planner", "uniform", "--seed", 2,
            "--max-frames", 6, "--set", "width_px=64", "--set", "height_px=48", "--out", by_hand)
        self.assertEqual(hashes(self.out / "kitchen.small.uniform.seed2/dataset"),
                         hashes(by_hand))
        # The scene is found at its old path; without the scene, verify says what it could not
        # check.
        dataset = self.out / "kitchen.small.dollytrack.seed2/dataset"
        elsewhere = self.place / "elsewhere"
        shutil.copytree(dataset, elsewhere)
        verified = run("-q", "verify", dataset)
        self.assertEqual(verified.returncode, 0, verified.stdout)
        self.assertTrue(verified.stdout.strip().endswith(": sound"), verified.stdout)
        card = json.loads((elsewhere / "dataset.json").read_text())
        card["scene"]["path"] = str(self.place / "moved.obj")
        (elsewhere / "dataset.json").write_text(json.dumps(card))
        verified = run("-q", "verify", elsewhere)
        self.assertEqual(verified.returncode, 0, verified.stdout)
        last = verified.stdout.strip().splitlines()[-1]
        self.assertIn("sound as far as checked", last)
        self.assertIn("--scene", last)
        self.assertGreater(json.loads(run("-q", "verify", elsewhere, "--json").stdout)
                           ["unproven_without_scene"], 0)
        card = json.loads((by_hand / "dataset.json").read_text())
        metrics = self.summary()["kitchen.small.uniform.seed2"]["metrics"]
        self.assertEqual(metrics["counted.capture_rate"],
                         card["metrics"]["counted"]["capture_rate"])
        self.assertEqual(metrics["frames"], 6)

        suite = xml.etree.ElementTree.parse(self.out / "junit.xml").getroot().find("testsuite")
        self.assertEqual((suite.get("tests"), suite.get("errors"), suite.get("failures")),
                         ("12", "4", "0"))
        self.assertEqual([case.get("name") for case in suite.iter("testcase")], names)
        self.assertEqual([case.get("name") for case in suite.iter("testcase")
                          if case.find("error") is not None],
                         [name for name in names if name.startswith("broken")])
        links = Links((self.out / "index.html").read_text()).found
        for link in links:
            self.assertTrue((self.out / urllib.parse.unquote(link)).exists(), link)
        self.assertEqual(sum(link.endswith("contact_sheet.jpg") for link in links), 2 * 8)
        self.assertIn("cannot be read as a 3D scene", (self.out / "index.html").read_text())

    def test_without_an_export_jobs_only_plan(self):
        self.rooms("bath.obj")
        result = run("batch", self.jobs('scenes = "rooms/bath.obj"', export=""), "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        job, = json.loads(result.stdout)["jobs"]
        planned = json.loads(run("plan", self.place / "rooms/bath.obj", "--json", "--set",
                                 "width_px=64", "--set", "height_px=48").stdout)
        self.assertEqual(job["metrics"]["well_captured_rate"], planned["well_captured_rate"])
        self.assertFalse((self.out / "bath.small/dataset").exists())

    def test_a_preset_selects_what_every_job_exports(self):
        self.rooms("bath.obj")
        export = '\n[export]\nmax_frames = 3\npreset = "nerf"\nformats = ["colmap"]\n'
        result = run("batch", self.jobs('scenes = "rooms/bath.obj"', export=export))
        self.assertEqual(result.returncode, 0, result.stderr)
        written = json.loads((self.out / "bath.small/dataset/dataset.json").read_text())
        self.assertEqual(list(written["modalities"]), ["rgb", "depth"])
        self.assertTrue((self.out / "bath.small/dataset/sparse/0").exists())
        self.assertFalse((self.out / "bath.small/dataset/transforms.json").exists())

    def test_names_stay_when_scenes_come(self):
        self.rooms("bath.obj")
        file = self.jobs('scenes = ["rooms/**/*", "rooms/*.obj"]', export="")
        self.assertEqual(run("batch", file).returncode, 0)
        written = (self.out / "bath.small/result.json").stat().st_mtime_ns
        (self.place / "rooms/a").mkdir()
        self.rooms("a/bath.obj", "a.obj")
        listed = json.loads(run("batch", file, "--dry-run", "--json").stdout)
        self.assertEqual({job["name"]: job["to_do"] for job in listed},
                         {"a_bath.small": "begin", "a.small": "begin", "bath.small": "done"})
        self.assertEqual((self.out / "bath.small/result.json").stat().st_mtime_ns, written)
        # Two scenes that would get the same name get different ones.
        (self.place / "rooms/a/bath.ply").write_text("ply")
        listed = json.loads(run("batch", file, "--dry-run", "--json").stdout)
        self.assertEqual(len({job["name"] for job in listed}), 4)

    def test_requirements_are_asked_of_every_job(self):
        self.rooms("bath.obj")
        file = self.jobs('scenes = "rooms/*.obj"\nplanners = ["dollytrack", "uniform"]')
        asked = ["--require", "counted.well_captured_rate>=0.9", "--require", "objects>=1"]
        result = run("batch", file, *asked)
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertEqual(self.verdicts(), {"bath.small.dollytrack": "good",
                                           "bath.small.uniform": "unmet"})
        suite = xml.etree.ElementTree.parse(self.out / "junit.xml").getroot().find("testsuite")
        self.assertEqual(suite.get("failures"), "1")
        # The page shows the end of the log, but not 30 lines of progress.
        log = self.out / "bath.small.uniform" / "log.txt"
        log.write_text("note: a word of its own\n" + " 41 %  frames, 0:12 left\n" * 30)
        self.assertEqual(run("batch", file, *asked).returncode, 3)
        page = (self.out / "index.html").read_text()
        self.assertIn("note: a word of its own", page)
        self.assertNotIn("41 %  frames", page)
        # A new constraint is checked on the existing results; nothing is made again.
        again = run("batch", file)
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertFalse(any(job["ran_now"] for job in self.summary().values()))
        # A constraint on a value that the trajectory lacks is not met; an unknown name is refused.
        self.assertEqual(run("batch", file, "--require", "path_length_m<=1000").returncode, 3)
        self.assertFails(run("batch", file, "--require", "wel_captured_rate>=1"), 2,
                         "well_captured_rate")

    # --- continuing

    def test_a_changed_table_of_labels_and_the_scene_of_a_project_count_too(self):
        self.rooms("bath.obj")
        project, labels = self.place / "rooms/bath.dolly", self.place / "names.csv"
        planned = run("plan", self.place / "rooms/bath.obj", "-o", project)
        self.assertEqual(planned.returncode, 0, planned.stderr)
        labels.write_text("mug,box\n")
        file = self.jobs('scenes = "rooms/*.dolly"\n[import]\nlabels = "names.csv"')
        self.assertEqual(run("batch", file).returncode, 0)
        self.assertNotIn("changed", run("batch", file).stderr)
        labels.write_text("mug,bag\n")
        self.assertIn("its scene has changed", run("batch", file).stderr)
        room = self.place / "rooms/bath.obj"
        room.write_text(room.read_text().replace("v 0.9 ", "v 0.8 "))
        self.assertIn("its scene has changed", run("batch", file).stderr)

    def test_what_is_done_is_left_alone_and_what_changed_begins_anew(self):
        self.rooms("bath.obj", "kitchen.obj")
        file = self.jobs('scenes = "rooms/*.obj"')
        self.assertEqual(run("batch", file).returncode, 0)
        before = hashes(self.out)
        self.assertEqual(run("batch", file, "--resume").returncode, 0)
        after = hashes(self.out)
        reports = {"summary.json"}  # says that nothing ran
        self.assertEqual({name for name in before if before[name] != after[name]}, reports)

        room = self.place / "rooms/bath.obj"
        os.utime(room)  # touched, but the same
        self.assertEqual(run("batch", file).returncode, 0)
        self.assertFalse(self.summary()["bath.small"]["ran_now"])
        room.write_text(room.read_text().replace("v 0.9 ", "v 0.8 "))
        result = run("batch", file)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("its scene has changed", result.stderr)
        self.assertEqual([name for name, job in self.summary().items() if job["ran_now"]],
                         ["bath.small"])
        file = self.jobs('scenes = "rooms/*.obj"', export="[export]\nmax_frames = 5\n")
        result = run("batch", file)
        self.assertIn("its settings have changed", result.stderr)
        self.assertEqual({job["metrics"]["exported_frames"] for job in self.summary().values()},
                         {5})
        (self.out / "bath.small/dataset/dataset.json").unlink()
        self.assertEqual(run("batch", file).returncode, 0)
        self.assertTrue((self.out / "bath.small/dataset/dataset.json").exists())

    def test_shards_share_the_jobs_and_are_put_together(self):
        self.rooms("a.obj", "b.obj", "c.obj")
        file = self.jobs('scenes = "rooms/*.obj"\nseeds = [1, 2]', export="")
        whole = self.place / "whole"
        self.assertEqual(run("batch", file, "--out", whole).returncode, 0)
        seen = []
        for i in range(2):
            result = run("batch", file, "--shard", f"{i}/3")
            self.assertEqual(result.returncode, 0, result.stderr)
            part = self.summary(self.out / f"@shards/{i}-of-3")
            seen += part
            for link in Links((self.out / f"@shards/{i}-of-3/index.html").read_text()).found:
                self.assertTrue((self.out / f"@shards/{i}-of-3" / link).exists(), link)
        # One part is missing: the report says so and does not count as success.
        self.assertEqual(run("batch", "--merge", self.out).returncode, 3)
        self.assertEqual(list(self.verdicts().values()).count("not run"), 2)
        # The last part runs twice at the same time: each job is done by one of them, and the one
        # that ends last finds all jobs done.
        twice = [start("batch", file, "--shard", "2/3") for _ in range(2)]
        codes = []
        for one in twice:
            one.communicate()
            codes.append(one.returncode)
        self.assertIn(sorted(codes), [[0, 0], [0, 3]])
        seen += self.summary(self.out / "@shards/2-of-3")
        self.assertEqual(sorted(seen), sorted(self.summary(whole)))
        merged = run("batch", "--merge", self.out, "--require", "capture_rate>=0.1")
        self.assertEqual(merged.returncode, 0, merged.stderr)
        def numbers(folder):
            return {name: {key: value for key, value in job["metrics"].items()
                           if not key.endswith("_ms")}
                    for name, job in self.summary(folder).items()}
        self.assertEqual(numbers(self.out), numbers(whole))

    def test_a_metric_that_is_no_number_is_none(self):
        self.rooms("a.obj")
        file = self.jobs('scenes = "rooms/*.obj"', export="")
        self.assertEqual(run("batch", file).returncode, 0)
        kept = self.out / "a.small/result.json"
        result = json.loads(kept.read_text())
        result["metrics"]["capture_rate"] = "much"
        kept.write_text(json.dumps(result))
        merged = run("batch", "--merge", self.out, "--require", "capture_rate>=0")
        self.assertEqual(merged.returncode, 3, merged.stderr)
        self.assertEqual(self.verdicts(), {"a.small": "unmet"})

    def test_what_another_batch_is_at_is_looked_at_again(self):
        self.rooms("a.obj", "b.obj")
        file = self.jobs('scenes = "rooms/*.obj"')
        lock = self.out / "a.small/.lock"
        lock.parent.mkdir(parents=True)
        (self.out / "jobs.json").write_text('{"format": "dollytrack-batch"}')
        with lock.open("w") as held:
            fcntl.flock(held, fcntl.LOCK_EX)
            result = run("batch", file)
            self.assertEqual(result.returncode, 3, result.stderr)
            self.assertEqual(self.verdicts(), {"a.small": "busy", "b.small": "good"})
            shutil.rmtree(self.out / "b.small")
            process = start("batch", file)
            self.assertTrue(wait_for((self.out / "b.small/log.txt").exists))
        _, errors = process.communicate()
        self.assertEqual(process.returncode, 0, errors)
        self.assertEqual(self.verdicts(), {"a.small": "good", "b.small": "good"})

    # --- errors name their place

    def test_what_is_wrong_in_the_file_is_said_with_its_line(self):
        self.rooms("a.obj")
        good = 'out = "out"\nscenes = ["rooms/*.obj"]\n'
        for text, line, word in [
            ("sceens = []\n", 3, "did you mean 'scenes'"),
            ('seeds = ["1"]\n', 3, "whole numbers"),
            ("seeds = [1, 1]\n", 3, "twice"),
            ('planners = ["dollytrack",\n "unifrm"]\n', 4, "uniform"),
            ('require = ["well_captured_rate>"]\n', 3, "condition"),
            ('require = ["frames>=1",\n "well_captured_rat>=0.5"]\n', 4, "well_captured_rate"),
            ("timeout_s = -1\n", 3, "number"),
            ('[[set]]\nname = "a"\nset = { fil = 1 }\n', 5, "fill"),
            ('[[set]]\nname = "a"\nset = { fill = 7 }\n', 5, "0.1 .. 1"),
            ('[[set]]\nname = "a"\n[[set]]\nname = "a"\n', 6, "two sets"),
            ('[[set]]\nset = { fill = 1 }\n', 3, "name"),
            ('[[set]]\nname = "../a"\n', 4, "letters"),
            ('[export]\nmodalities = ["rgb", "dept"]\n', 4, "depth"),
            ('[export]\nformats = ["cocoa"]\n', 4, "coco"),
            ('[export]\npreset = "nerv"\n', 4, "did you mean 'nerf'"),
            ('[export]\narguments = ["--preset=nerf"]\n', 4, "--preset"),
            ('[export]\nrange = "1:2:0"\n', 4, "range"),
            ('[export]\narguments = ["--out=x"]\n', 4, "--out"),
            ('[export]\nmax_frame = 3\n', 4, "max_frames"),
            ('export = 3\n', 3, "[export]"),
            ('[import]\nup = "w"\n', 4, "-y"),
            ('exclude = "rooms/*"\n', 3, "no scene"),
            ('x = = 3\n', 3, ""),
        ]:
            with self.subTest(text):
                file = self.place / "bad.toml"
                file.write_text(good + text)
                result = run("batch", file)
                self.assertFails(result, 4, f"bad.toml:{line}: ", word)
        for text, word in [('out = "x"\n', "scenes"), ('scenes = "none/*.obj"\n', "none"),
                           ('scenes = "rooms/*.glb"\n', "matches no scene"),
                           ('scenes = "b.obj"\n', "b.obj")]:
            file.write_text(text)
            self.assertFails(run("batch", file), 4, word)
        self.assertFails(run("batch", self.place / "none.toml"), 4, "no such file")
        self.assertFails(run("batch", self.place), 4, "folder")
        self.assertFalse(self.out.exists())

    def test_wrong_arguments_are_usage_errors(self):
        self.rooms("a.obj")
        file = self.jobs('scenes = "rooms/*.obj"')
        for arguments, word in [((), "jobs file"), ((file, "--shard", "3/3"), "0/4"),
                                ((file, "--shard", "a"), "0/4"), ((file, "--shard", "1/0"), "0/4"),
                                ((file, "--merge", self.out), "--merge"),
                                ((file, "--require", "x"), "condition")]:
            self.assertFails(run("batch", *arguments), 2, word)
        self.assertFails(run("batch", "--merge", self.place), 4, "jobs.json")
        file.write_text('scenes = "rooms/*.obj"\n')
        self.assertFails(run("batch", file), 2, "--out")
        # A folder with other files is not written to.
        self.assertFails(run("batch", file, "--out", self.place), 6, "not from a Dollytrack batch")
        self.assertFails(run("batch", file, "--out", "/proc/nothing"), 6, "/proc/nothing")


if __name__ == "__main__":
    unittest.main()
