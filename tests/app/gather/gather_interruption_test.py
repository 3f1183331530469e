#!/usr/bin/python3
"""Damaged datasets, folders that `gather` refuses, and runs that are interrupted and continued.

Usage: gather_interruption_test.py PROGRAM [unittest arguments]
"""
import hashlib
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import unittest

from gather_case import GatherCase, sums_of
from support.program import PROGRAM, hashes, run, start, wait_for


class Interruption(GatherCase):
    # --- damage

    def test_unfinished_and_damaged_datasets_are_named_or_left_out(self):
        def flip(folder):
            picture = folder / "rgb" / "000002.png"
            data = bytearray(picture.read_bytes())
            data[-20] ^= 1
            picture.write_bytes(data)

        def cut_annotations(folder):
            text = (folder / "annotations.json").read_text()
            (folder / "annotations.json").write_text(text[:-10])

        def unfinish(folder):
            (folder / "dataset.json").unlink()
            (folder / ".dollytrack-export").write_text("{}\n")

        def copy_without_card(folder):
            (folder / "dataset.json").unlink()

        for damage, word in [(flip, "000002.png"), (cut_annotations, "annotations.json"),
                             (lambda folder: (folder / "rgb" / "000001.png").unlink(), "000001.png"),
                             (unfinish, "dataset.json"), (copy_without_card, "dataset.json"),
                             (lambda folder: (folder / "dataset.json").write_text("{"), "dataset.json")]:
            with self.subTest(word):
                around = self.damaged(damage)
                out = self.new_folder()
                self.assertFails(run("-q", "gather", around, "--out", out, "--format", "imagefolder"),
                                 4, str(around / "bad"), word)
                self.assertFalse((out / "gather.json").exists())
                done = run("-q", "gather", around, "--out", out, "--format", "imagefolder",
                           "--skip-damaged")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn("left out", done.stderr)
                card = self.card(out)
                self.assertEqual([one["name"] for one in card["sources"]], ["good"])
                self.assertEqual(card["skipped"], ["bad"])
        self.assertFails(run("-q", "gather", around / "bad", "--out", self.new_folder(), "--format",
                             "yolo", "--skip-damaged"), 4, "All datasets")

    def test_what_a_recording_cannot_hold_is_said(self):
        def edit_card(folder, change):
            card = json.loads((folder / "dataset.json").read_text())
            change(card)
            (folder / "dataset.json").write_text(json.dumps(card))

        def turn_back(card):
            card["frames"][4]["time_s"] = card["frames"][2]["time_s"]

        def edit_measurements(change):
            def damage(folder):
                path = folder / "imu.csv"
                path.write_text(change(path.read_text()))
                edit_card(folder, lambda card: card["files"].update(
                    {"imu.csv": hashlib.sha256(path.read_bytes()).hexdigest()}))
            return damage

        for damage, words in [
                (lambda folder: edit_card(folder, turn_back), ["frames[4].time_s", "earlier"]),
                (lambda folder: edit_card(folder, lambda card: card["frames"][0].update(time_s=-1)),
                 ["frames[0].time_s", "negative"]),
                (edit_measurements(lambda text: text + text.splitlines()[1] + "\n"),
                 ["imu.csv:", "earlier"]),
                (edit_measurements(lambda text: text + "1,2,3\n"), ["imu.csv:", "3 values"]),
                (lambda folder: (folder / "imu.csv").write_text("changed"), ["imu.csv", "SHA-256"]),
                (lambda folder: (folder / "imu.csv").unlink(), ["imu.csv is missing"])]:
            with self.subTest(words):
                around = self.damaged(damage)
                out = self.new_folder()
                command = ["-q", "gather", around, "--out", out, "--format", "mcap"]
                self.assertFails(run(*command), 4, str(around / "bad"), *words)
                self.assertEqual(list(out.rglob("*.mcap")), [])
                done = run(*command, "--skip-damaged")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual([path.name for path in out.rglob("*.mcap")], ["good.mcap"])
                self.assertEqual(self.card(out)["skipped"], ["bad"])

    def test_only_png_files_are_depth_images(self):
        around = self.damaged(
            lambda folder: self.replace_listed(folder, "depth/000003.png", b"\xFF\xD8\xFF\xE0"))
        refused = run("-q", "gather", around, "--out", self.new_folder(), "--format", "mcap")
        self.assertFails(refused, 4, str(around / "bad" / "depth" / "000003.png"), "not a PNG file")

    def test_what_is_no_dataset_is_said(self):
        nothing = self.folder / "nothing"
        nothing.mkdir()
        for argument, word in [(nothing, "no dataset"), (nothing / "none", "does not exist"),
                               (self.folder / "0.dolly", "file"),
                               (f"{nothing}/*", "does not exist")]:
            self.assertFails(run("-q", "gather", argument, "--out", self.new_folder(), "--format",
                                 "yolo"), 4, str(argument), word)
        for arguments, word in [(["--format", "yolo", "--split", "by-room", "0/1"], "80/10/10"),
                                (["--format", "yolo", "--split", "by-room", "50/50/50"], "add up to 150"),
                                (["--format", "yolo", "--split", "by-scene"], "by-room"),
                                (["--format", "webdataset", "--shard-size", "1"], "1GB")]:
            self.assertFails(run("-q", "gather", self.datasets, "--out", self.new_folder(),
                                 *arguments), 2, word)

    # --- the folder

    def test_complete_results_are_replaced_only_when_asked_and_other_files_stay(self):
        out = self.gather("--format", "yolo", datasets=[self.datasets / "room_0"])
        before = hashes(out)
        again = ["-q", "gather", self.datasets / "room_1", "--out", out, "--format", "coco"]
        self.assertFails(run(*again), 2, "complete", "--overwrite", "--resume")
        self.assertFails(run(*again, "--resume"), 2, "another complete dataset")
        self.assertEqual(hashes(out), before)
        (out / "images" / "train" / "mine.png").write_bytes(b"mine")
        done = run(*again, "--overwrite")
        self.assertEqual(done.returncode, 0, done.stderr)
        left = set(hashes(out))
        self.assertEqual(left - set(sums_of(out)) - {"SHA256SUMS", "gather.json"},
                         {"images/train/mine.png"})
        done = run(*again, "--resume")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("complete", done.stdout)
        (out / "README.md").write_text("damaged")
        self.assertFails(run(*again, "--resume"), 4, "README.md", "--overwrite")

    def test_folders_of_other_files_are_refused(self):
        out = self.new_folder()
        out.mkdir()
        (out / "notes.txt").write_text("mine")
        command = ["-q", "gather", self.datasets / "room_0", "--out"]
        self.assertFails(run(*command, out, "--format", "yolo"), 6, "--overwrite")
        dataset = self.folder / "a_dataset"
        shutil.copytree(self.datasets / "room_1", dataset)
        before = hashes(dataset)
        self.assertFails(run(*command, dataset, "--format", "yolo", "--overwrite"), 6,
                         "exported dataset")
        self.assertFails(run(*command, self.datasets / "room_0" / "out", "--format", "yolo"), 2,
                         "inside the source dataset")
        self.assertEqual(hashes(dataset), before)
        done = run(*command, out, "--format", "yolo", "--overwrite")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((out / "notes.txt").read_text(), "mine")

    def test_no_link_in_the_folder_is_followed(self):
        elsewhere = self.folder / "elsewhere"
        (elsewhere / "train").mkdir(parents=True)
        (elsewhere / "file").write_text("mine")
        before = hashes(elsewhere)
        for place, target in [("images", elsewhere), ("images/train", elsewhere / "train"),
                              ("README.md", elsewhere / "file"), (".dollytrack-new", elsewhere),
                              (".dollytrack-gather", elsewhere / "file")]:
            for mode in [[], ["--resume"], ["--overwrite"]]:
                with self.subTest(place=place, mode=mode):
                    out = self.new_folder()
                    (out / place).parent.mkdir(parents=True)
                    if place != ".dollytrack-gather":
                        (out / ".dollytrack-gather").write_text("{}\n")
                    (out / place).symlink_to(target)
                    refused = run("-q", "gather", self.datasets / "room_0", "--out", out,
                                  "--format", "yolo", *mode)
                    self.assertFails(refused, 6, str(out))
                    self.assertTrue((out / place).is_symlink())
                    self.assertEqual(hashes(elsewhere), before)

    def test_linked_pictures_of_a_dataset_are_copied(self):
        linked = self.folder / "linked"
        shutil.copytree(self.datasets / "room_0", linked)
        shutil.move(linked / "rgb", self.folder / "other_disk")
        (linked / "rgb").symlink_to(self.folder / "other_disk")
        for more in [[], ["--hard-links"]]:
            out = self.gather("--format", "yolo", *more, datasets=[linked])
            self.assertEqual(len(list((out / "images" / "train").iterdir())), 6)

    def test_hard_links_only_when_asked(self):
        for more, count in [([], 1), (["--hard-links"], 2)]:
            copy = pathlib.Path(tempfile.mkdtemp(dir=self.folder)) / "room"
            shutil.copytree(self.datasets / "room_0", copy)
            out = self.gather("--format", "coco", *more, datasets=[copy])
            links = {path.stat().st_nlink for path in (out / "train").iterdir()}
            self.assertEqual(links, {count})

    # --- interruptions

    def test_a_run_that_met_damage_goes_on_to_the_same_bytes(self):
        around = self.folder / "mended"
        for number in range(6):
            self.copy_as(self.datasets / "room_1", around / f"copy_{number}", 100 + number)
        picture = around / "copy_4" / "rgb" / "000003.png"
        right = picture.read_bytes()
        for layout in ["yolo", "coco", "imagefolder", "webdataset", "mcap", "rosbag"]:
            with self.subTest(layout):
                arguments = ["--format", layout, "--shard-frames", 5]
                whole = self.gather(*arguments, datasets=[around])
                out = self.new_folder()
                command = ["-q", "gather", around, "--out", out, *arguments]
                picture.write_bytes(right[:-1])
                self.assertFails(run(*command), 4, str(picture))
                picture.write_bytes(right)
                staged = out / ".dollytrack-new"
                ending = {"webdataset": "tar", "mcap": "mcap", "rosbag": "bag"}.get(layout, "png")
                pictures = sorted(staged.rglob(f"*.{ending}"))
                self.assertGreater(len(pictures), 3)
                self.assertFails(run(*command, "--resume", "--title", "Others"), 2,
                                 "another unfinished result",
                                 "the title")
                # An image lost in a power cut is written again; complete files stay.
                lost, kept = pictures[:2]
                before = kept.stat()
                if layout != "webdataset":
                    lost.write_bytes(b"\0" * lost.stat().st_size)
                done = run(*command, "--resume")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(hashes(out), hashes(whole))
                after = (out / kept.relative_to(staged)).stat()
                self.assertEqual((after.st_ino, after.st_mtime_ns), (before.st_ino, before.st_mtime_ns))

    def test_a_damaged_tar_file_is_written_again(self):
        around = self.damaged(lambda folder: (folder / "rgb" / "000004.png").write_bytes(b"x"))
        out = self.new_folder()
        command = ["-q", "gather", around / "good", around / "bad", "--out", out, "--format",
                   "webdataset", "--shard-frames", 2]
        self.assertEqual(run(*command).returncode, 4)
        first = out / ".dollytrack-new" / "train-000000.tar"
        first.write_bytes(b"\0" * first.stat().st_size)
        shutil.copy(self.datasets / "room_1" / "rgb" / "000004.png", around / "bad" / "rgb")
        done = run(*command, "--resume")
        self.assertEqual(done.returncode, 0, done.stderr)
        whole = self.gather(*command[-4:], datasets=[around / "good", around / "bad"])
        self.assertEqual(hashes(out), hashes(whole))

    def test_an_interrupted_run_goes_on_to_the_same_bytes(self):
        for layout, more in [("coco", []), ("webdataset", ["--shard-frames", 5]), ("mcap", []),
                             ("rosbag", [])]:
            with self.subTest(layout):
                arguments = ["--format", layout, "--split", "by-room", "80/10/10", *more]
                whole = self.gather(*arguments, datasets=[self.many()])
                out = self.new_folder()
                staged = out / ".dollytrack-new"
                command = ["-q", "--threads", 1, "gather", self.many(), "--out", out, *arguments]
                stops = 0
                for sent in [signal.SIGINT, signal.SIGKILL, signal.SIGTERM]:
                    process = start(*command, *(["--resume"] if stops else []))
                    files = sum(len(names) for _, _, names in os.walk(staged))
                    self.assertTrue(wait_for(lambda: process.poll() is not None or sum(
                        len(names) for _, _, names in os.walk(staged)) > files + 3))
                    process.send_signal(sent)
                    _, errors = process.communicate()
                    if process.returncode == 0:
                        break
                    stops += 1
                    self.assertFalse((out / "gather.json").exists())
                    self.assertEqual(process.returncode, -9 if sent == signal.SIGKILL else 128 + sent,
                                     errors)
                self.assertGreater(stops, 0)
                done = run(*command, "--resume")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(hashes(out), hashes(whole))

    def test_a_replacement_that_was_cut_off_is_ended(self):
        """As if the program was killed after it decided to replace, before any file was moved."""
        out = self.gather("--format", "yolo", datasets=[self.datasets / "room_0"])
        new = self.gather("--format", "coco", datasets=[self.datasets / "room_1"])
        staged = out / ".dollytrack-new"
        shutil.copytree(new, staged)
        shutil.copy(out / "SHA256SUMS", staged / "replaced.sums")
        (out / "gather.json").rename(staged / "replaced.json")
        (out / ".dollytrack-gather").write_text('{"identity": {}, "version": 1}\n')
        refused = run("-q", "gather", self.datasets / "room_1", "--out", out, "--format", "coco")
        self.assertFails(refused, 2, "complete")
        self.assertEqual(hashes(out), hashes(new))

    def test_memory_does_not_grow_with_frames(self):
        for layout in ["webdataset", "parquet", "mcap", "rosbag"]:
            with self.subTest(layout):
                out = self.new_folder()
                done = subprocess.run(["/usr/bin/env", "python3", "-c", (
                    "import resource, subprocess, sys\n"
                    "code = subprocess.call(sys.argv[1:])\n"
                    "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)\n"
                    "sys.exit(code)"), PROGRAM, "-q", "gather", self.many(), "--out", out, "--format",
                    layout], capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertLess(int(done.stdout.split()[-1]), 200_000)  # KiB


if __name__ == "__main__":
    unittest.main()
