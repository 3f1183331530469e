#!/usr/bin/python3
"""`generate`: rooms that are read back as their ground truth says, equal for equal seeds.

Usage: generate_test.py PROGRAM [unittest arguments]
"""
import hashlib
import json
import math
import pathlib
import signal
import unittest
import zipfile

from support import program
from support.program import FolderCase, hashes, run

LIBRARY = pathlib.Path("/usr/share/sweethome3d/furniture")


def turned(vector, degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return (c * vector[0] - s * vector[1], s * vector[0] + c * vector[1])


def corners(centre, size, yaw_deg):
    """Corners of the box's outline from above."""
    for x in (-0.5, 0.5):
        for y in (-0.5, 0.5):
            dx, dy = turned((x * size[0], y * size[1]), yaw_deg)
            yield centre[0] + dx, centre[1] + dy


def outside(corner, truth):
    """Distance of a point outside the outline of the ground truth box, m."""
    dx, dy = corner[0] - truth["center_m"][0], corner[1] - truth["center_m"][1]
    x, y = turned((dx, dy), -truth["yaw_deg"])
    return max(abs(x) - 0.5 * truth["size_m"][0], abs(y) - 0.5 * truth["size_m"][1], 0.0)


@unittest.skipUnless(LIBRARY.is_dir(), "Debian's sweethome3d-furniture is not installed")
class Generate(FolderCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.rooms = cls.folder / "rooms"
        cls.made = run("generate", "--rooms", 3, "--seed", 7, "--out", cls.rooms, "--preset",
                       "3d-front-studio,scenenet-kitchen,hypersim-bedroom", "--json")

    def test_lists_what_it_made(self):
        self.assertEqual(self.made.returncode, 0, self.made.stderr)
        listed = json.loads(self.made.stdout)
        self.assertEqual(listed, json.loads((self.rooms / "generated.json").read_text()))
        self.assertEqual([room["preset"] for room in listed["rooms"]],
                         ["3d-front-studio", "scenenet-kitchen", "hypersim-bedroom"])
        for room in listed["rooms"]:
            truth = json.loads((self.rooms / room["folder"] / "objects.json").read_text())
            things = [one for one in truth["objects"] if not one["structure"]]
            self.assertEqual(room["objects"], len(things))
            self.assertEqual(room["size_m"], truth["size_m"])

    def test_is_read_back_as_the_truth_says(self):
        for room in json.loads(self.made.stdout)["rooms"]:
            result = run("info", self.rooms / room["scene"], "--json")
            self.assertEqual(result.returncode, 0, result.stderr)
            info = json.loads(result.stdout)
            self.assertEqual(info["warnings"], [])
            self.assertEqual(info["textures_missing"], [])
            self.assertEqual(info["unit_m"], 0.01)
            read = {one["name"]: one for one in info["objects"]}
            truth = json.loads((self.rooms / room["folder"] / "objects.json").read_text())
            for one in truth["objects"]:
                found = read.pop(one["name"])
                self.assertEqual(found["class"], one["class"], one["name"])
                self.assertEqual(found["role"], "structure" if one["structure"] else "target")
                self.assertEqual(found["front_source"], "annotation")
                for a, b in zip(found["front"], one["front"]):
                    self.assertAlmostEqual(a, b, delta=0.002, msg=one["name"])
                self.assertAlmostEqual(found["center_m"][2], one["center_m"][2], delta=0.002)
                self.assertAlmostEqual(found["size_m"][2], one["size_m"][2], delta=0.002)
                # A tighter box may be turned against the ground truth box; its corners then stick
                # out a little.
                area = found["size_m"][0] * found["size_m"][1]
                self.assertLess(area, one["size_m"][0] * one["size_m"][1] * 1.01 + 2e-4,
                                one["name"])
                reach = 0.25 * math.hypot(*one["size_m"][:2]) + 0.002
                for corner in corners(found["center_m"], found["size_m"], found["yaw_deg"]):
                    self.assertLess(outside(corner, one), reach, one["name"])
            self.assertEqual(len(read), 6, read.keys())  # walls, floor, ceiling

    def test_supporters_are_found_by_contact(self):
        room = self.rooms / "room_0000" / "room_0000.sh3d"
        truth = json.loads((room.parent / "objects.json").read_text())
        names = {one["name"] for one in truth["objects"]}
        for one in truth["objects"]:
            self.assertIn(one["supporter"], names | {"floor", "wall", "ceiling"})
        self.assertTrue(any(one["supporter"] in names for one in truth["objects"]))

    def test_names_every_model_and_its_licence(self):
        for folder in sorted(self.rooms.glob("room_*")):
            truth = json.loads((folder / "objects.json").read_text())
            licences = (folder / "LICENSES").read_text()
            for one in truth["objects"]:
                line = next(x for x in licences.splitlines() if x.startswith(one["model"] + ":"))
                self.assertRegex(line, "Creative Commons|Free Art|CC|Licen")
            with zipfile.ZipFile(folder / (folder.name + ".sh3d")) as archive:
                self.assertIsNone(archive.testzip())
                self.assertEqual(archive.read("LICENSES").decode(), licences)

    def test_licences_go_with_the_images(self):
        """From two rooms through their datasets into one published folder."""
        names = ["room_0000", "room_0001"]
        for name in names:
            made = run("-q", "export", self.rooms / name / f"{name}.sh3d", "--out",
                       self.folder / "datasets" / name, "--max-frames", 2, "--set", "width_px=160",
                       "--set", "height_px=120")
            self.assertEqual(made.returncode, 0, made.stderr)
        out = self.folder / "published"
        made = run("-q", "gather", self.folder / "datasets", "--out", out, "--format", "coco")
        self.assertEqual(made.returncode, 0, made.stderr)
        published = (out / "LICENSES").read_text()
        for name in names:
            licences = (self.rooms / name / "LICENSES").read_bytes()
            dataset = self.folder / "datasets" / name
            self.assertEqual((dataset / "LICENSES").read_bytes(), licences)
            listed = json.loads((dataset / "dataset.json").read_text())["files"]["LICENSES"]
            self.assertEqual(listed, hashlib.sha256(licences).hexdigest())
            self.assertEqual(published.count(licences.decode()), 1)

    def test_the_same_seed_gives_the_same_bytes(self):
        again = self.folder / "again"
        environment = {"LC_ALL": "de_DE.UTF-8", "TZ": "Asia/Tokyo", "PATH": "/usr/bin"}
        result = run("--threads", 1, "generate", "--rooms", 3, "--seed", 7, "--out", again,
                     "--preset", "3d-front-studio,scenenet-kitchen,hypersim-bedroom",
                     env=environment)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(len(result.stdout.splitlines()), 3)
        self.assertEqual(hashes(again), hashes(self.rooms))

    def test_size_and_clutter_are_what_was_asked_for(self):
        out = self.folder / "exact"
        result = run("generate", "--out", out, "--preset", "scenenet-living-room", "--size",
                     "6x5x2.6", "--objects", 100)
        self.assertEqual(result.returncode, 0, result.stderr)
        truth = json.loads((out / "room_0000" / "objects.json").read_text())
        self.assertEqual(truth["size_m"], [6, 5, 2.6])
        self.assertEqual(truth["objects_asked"], 100)
        self.assertGreaterEqual(truth["objects_placed"], 95)
        self.assertLessEqual(truth["objects_placed"], 100)

    def test_plans_in_a_room(self):
        result = run("plan", self.rooms / "room_0000" / "room_0000.sh3d", "-o",
                     self.folder / "room.dolly", "--json", "--set", "width_px=160",
                     "--set", "height_px=120")
        self.assertIn(result.returncode, (0, 3), result.stderr)
        planned = json.loads(result.stdout)
        self.assertGreater(planned["captured"], 0.5 * planned["objects"])

    def test_rooms_that_are_there_are_replaced_only_when_asked(self):
        out = self.folder / "twice"
        first = ("generate", "--out", out, "--preset", "3d-front-studio", "--objects", 3)
        self.assertEqual(run(*first, "--rooms", 2).returncode, 0)
        before = hashes(out)
        self.assertFails(run(*first), 2, "--overwrite")
        self.assertEqual(hashes(out), before)
        mine = [out / "room_notes.txt", out / "room_0001" / "plan.dolly", out / "room_plans" / "a"]
        for path in mine:
            path.parent.mkdir(exist_ok=True)
            path.write_text("mine")
        self.assertEqual(run(*first, "--overwrite").returncode, 0)
        for path in mine:
            self.assertEqual(path.read_text(), "mine")
            path.unlink()
        self.assertEqual([path.name for path in out.glob("room_*/*.sh3d")], ["room_0000.sh3d"])

    def test_ctrl_c_keeps_what_is_finished(self):
        out = self.folder / "stopped"
        running = program.start("generate", "--rooms", 500, "--out", out, "--objects", 5)
        self.assertTrue(program.wait_for(lambda: (out / "room_0001").is_dir()))
        running.send_signal(signal.SIGINT)
        running.communicate(timeout=60)
        self.assertEqual(running.returncode, 130)
        for room in json.loads((out / "generated.json").read_text())["rooms"]:
            self.assertEqual(run("info", out / room["scene"]).returncode, 0)

    def test_batches_pick_them(self):
        jobs = self.folder / "jobs.toml"
        jobs.write_text('out = "planned"\nscenes = ["rooms/**/*.sh3d"]\n')
        result = run("batch", jobs, "--dry-run")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("room_0002", result.stdout)


class Slips(FolderCase):
    def test_a_missing_library_names_the_package(self):
        result = run("generate", "--out", self.folder / "x", "--library", self.folder)
        self.assertFails(result, 4, "sweethome3d-furniture")
        self.assertFalse((self.folder / "x").exists())

    def test_slips_are_told(self):
        out = ("generate", "--out", self.folder / "x")
        self.assertFails(run(*out, "--preset", "scenenet-ofice"), 2, "scenenet-office")
        for size in ("5x4", "5x4x2.7x1", "1x4x2.7", "5x4x9", "axbxc", "5x4x2.7 ", "nanx4x3"):
            self.assertFails(run(*out, "--size", size), 2, "--size")
        self.assertEqual(run(*out, "--rooms", "0").returncode, 2)
        self.assertEqual(run(*out, "--objects", "121").returncode, 2)
        self.assertEqual(run("generate").returncode, 2)

    def test_a_folder_of_other_files_is_left_alone(self):
        folder = self.folder / "mine"
        folder.mkdir()
        (folder / "room_notes.txt").write_text("mine")
        if LIBRARY.is_dir():
            self.assertFails(run("generate", "--out", folder, "--overwrite"), 6, "other files")
        self.assertEqual((folder / "room_notes.txt").read_text(), "mine")

    def test_lists_the_presets(self):
        result = run("generate", "--list")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(len(result.stdout.splitlines()), 9)


if __name__ == "__main__":
    unittest.main()
