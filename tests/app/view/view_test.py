#!/usr/bin/python3
"""The command that writes the web page of a dataset: files, content and exit codes.

Usage: view_test.py PROGRAM [unittest arguments]
"""
import os
import resource
import shutil
import unittest

import cv2
import numpy as np

from support import tiny_room
from support.program import run
from view_case import FRAMES, ViewCase, changed_copy, data_of


class Command(ViewCase):
    def test_equal_input_gives_equal_bytes(self):
        pages = []
        for threads in ("1", "3"):
            page = self.folder / f"threads{threads}.html"
            self.view(self.dataset, "-o", page, "--threads", threads)
            pages.append(page.read_bytes())
        self.assertEqual(pages[0], pages[1])
        self.assertLess(len(pages[0]), 10_000_000)

    def test_the_page_lies_beside_the_dataset_unasked(self):
        copy = self.folder / "unnamed"
        shutil.copytree(self.dataset, copy)
        said = self.view(f"{copy}/").stdout
        self.assertIn(f"{FRAMES} frames", said)
        self.assertTrue((self.folder / "unnamed.html").is_file())

    def test_what_is_in_the_way_stays(self):
        page = self.folder / "there.html"
        page.write_text("mine")
        self.assertFails(run("view", self.dataset, "-o", page), 2, "--overwrite")
        self.assertEqual(page.read_text(), "mine")
        self.view(self.dataset, "-o", page, "--overwrite")
        self.assertIn("<!DOCTYPE html>", page.read_text())
        other = self.folder / "other.txt"
        other.write_text("mine")
        link = self.folder / "link.html"
        link.symlink_to(other)
        for more in ([], ["--overwrite"]):
            self.assertFails(run("view", self.dataset, "-o", link, *more), 6, "link.html")
        self.assertEqual(other.read_text(), "mine")
        self.assertFails(run("view", self.dataset, "-o", self.folder), 6, "folder")
        self.assertFails(run("view", self.dataset, "-o", self.folder / "no" / "x.html"), 6, "no")

    def test_what_is_no_dataset_is_told(self):
        empty = self.folder / "empty"
        empty.mkdir()
        self.assertFails(run("view", empty), 4, "no dataset.json", "--resume")
        self.assertFails(run("view", self.folder / "nowhere"), 4, "does not exist")
        self.assertFails(run("view", self.folder / "room.obj"), 4, "path is a file")
        unfinished = self.folder / "unfinished"
        shutil.copytree(self.dataset, unfinished)
        (unfinished / "dataset.json").unlink()
        self.assertFails(run("view", unfinished), 4, "did not finish")
        rooms = self.folder / "rooms"
        rooms.mkdir()
        (rooms / "rooms.json").write_text('{"rooms": [{"name": "kitchen"}, {"name": "hall"}]}')
        self.assertFails(run("view", rooms), 4, "kitchen, hall")
        self.assertFalse(list(self.folder.glob("empty*.html")))

    def test_without_three_js_it_says_what_to_install(self):
        nothing = self.folder / "nothing"
        nothing.mkdir()
        page = self.folder / "without.html"
        self.assertFails(run("view", self.dataset, "-o", page, "--three", nothing), 4,
                         "libjs-three")
        self.assertFalse(page.exists())

    def test_another_scene_is_refused(self):
        tiny_room.write_two(self.folder / "two.obj")
        self.assertFails(run("view", self.dataset, "-o", self.folder / "x.html", "--scene",
                             self.folder / "two.obj"), 4, "not the scene")

    def test_damaged_pictures_are_told(self):
        def change(card):
            card["scene"]["path"] = ""
        copy = changed_copy(self.dataset, self.folder / "damaged", change)
        (copy / "rgb" / "000002.png").write_bytes(b"no picture")
        (copy / "depth" / "000003.png").unlink()
        page = self.folder / "damaged.html"
        made = self.view(copy, "-o", page)
        self.assertIn("images in the dataset: 2;", made.stderr)
        kinds = {kind["modality"]: kind for kind in data_of(page, "pictures")}
        self.assertEqual(list(kinds), ["rgb", "depth", "instance", "semantic"])
        self.assertEqual([i for i, file in enumerate(kinds["rgb"]["files"]) if not file], [2])
        self.assertEqual([i for i, file in enumerate(kinds["depth"]["files"]) if not file], [3])

    def test_more_motions_than_memory_holds_are_refused(self):
        """Each of 20,000 objects moves in one frame, but would get a row in all 20,000 frames."""
        moved = {"position": [1, 0, 0], "quaternion_xyzw": [0, 0, 0, 1]}

        def change(card):
            frame = card["frames"][0]
            card["frames"] = [{**frame, "index": i} for i in range(20_000)]
            card["frames"][0]["moving"] = [{**moved, "object_id": i} for i in range(20_000)]
        copy = changed_copy(self.dataset, self.folder / "motions", change)
        limit = (8 << 30, 8 << 30)
        self.assertFails(
            run("view", copy, "-o", self.folder / "motions.html",
                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, limit)),
            4, "do not fit")

    def test_a_picture_of_one_column_is_a_damaged_one(self):
        """At the page's width of 320 px it would be 16,000 px high; longer ones would take
        gigabytes."""
        copy = changed_copy(self.dataset, self.folder / "column", lambda card: None)
        cv2.imwrite(str(copy / "rgb" / "000002.png"), np.zeros((50, 1, 3), np.uint8))
        page = self.folder / "column.html"
        self.assertIn("damaged images in the dataset: 1;", self.view(copy, "-o", page).stderr)
        files = data_of(page, "pictures")[0]["files"]
        self.assertEqual([i for i, file in enumerate(files) if not file], [2])

    def test_a_picture_larger_than_any_export_is_a_damaged_one(self):
        copy = changed_copy(self.dataset, self.folder / "huge", lambda card: None)
        cv2.imwrite(str(copy / "rgb" / "000002.png"), np.zeros((9000, 9000), np.uint8))
        self.assertIn("damaged images in the dataset: 1;", self.view(copy, "-o", self.folder / "huge.html").stderr)

    def test_many_large_pictures_stay_below_the_limit(self):
        noise = np.random.default_rng(1).integers(0, 256, (240, 320, 3), np.uint8)
        count = 700

        def change(card):
            frame = card["frames"][0]
            card["frames"] = [{**frame, "index": i, "time_s": 0.1 * i} for i in range(count)]
        copy = changed_copy(self.dataset, self.folder / "many", change)
        for kind, picture in (("rgb", noise), ("instance", noise[:, :, 0].astype(np.uint16)),
                              ("semantic", noise[:, :, 0] % 41)):
            shutil.rmtree(copy / kind)
            (copy / kind).mkdir()
            cv2.imwrite(str(copy / kind / "000000.png"), picture)
            for i in range(1, count):
                os.link(copy / kind / "000000.png", copy / kind / f"{i:06d}.png")
        page = self.folder / "many.html"
        self.view(copy, "-o", page)
        size = page.stat().st_size
        self.assertLess(size, 10_000_000)
        self.assertGreater(size, 8_000_000)  # as much as fits
        files = data_of(page, "pictures")[0]["files"]
        pictured = {i for i, file in enumerate(files) if file}
        best = {row["best_frame"] for row in self.card["metrics"]["counted"]["per_object"]}
        self.assertGreaterEqual(pictured, best)
        self.assertGreater(len(pictured), 50)
        self.assertTrue(any(f"{len(pictured)} of {count} frames" in note
                            for note in data_of(page, "notes")))


if __name__ == "__main__":
    unittest.main()
