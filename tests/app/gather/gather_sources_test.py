#!/usr/bin/python3
"""Which datasets `gather` finds and combines: splits by scene, names, class tables, image sizes.

Usage: gather_sources_test.py PROGRAM [unittest arguments]
"""
import collections
import hashlib
import json
import pathlib
import shutil
import tempfile
import unittest

from gather_case import PARTS, GatherCase, sums_of
from support.program import hashes, run


LABELS = {"classes": [{"id": 1, "name": "seat", "matches": ["chair", "*sofa*"]},
                      {"id": 2, "name": "cup", "matches": ["*mug*"]}], "other": "ignore"}


class Sources(GatherCase):
    # --- splits

    def test_no_room_is_on_both_sides_whatever_the_seed(self):
        splits = set()
        for seed in range(12):
            out = self.gather("--format", "webdataset", "--split", "by-room", "60/20/20",
                              "--seed", seed)
            card = self.card(out)
            part_of = collections.defaultdict(set)
            for one in card["sources"]:
                part_of[one["scene_sha256"]].add(one["part"])
            self.assertTrue(all(len(parts) == 1 for parts in part_of.values()))
            self.assertEqual(len(part_of), 6)
            frames = {one["name"]: one["frames"] for one in card["parts"]}
            self.assertEqual(set(frames), set(PARTS))
            # A scene has 6 or 9 of 39 frames: the sizes of the splits are as close as whole scenes
            # allow.
            self.assertLessEqual(abs(frames["train"] - 0.6 * sum(frames.values())), 5)
            splits.add(tuple(one["part"] for one in card["sources"]))
            if seed == 0:
                again = self.gather("--format", "webdataset", "--split", "by-room", "60/20/20",
                                    "--seed", 0)
                self.assertEqual(hashes(again), hashes(out))
        self.assertGreater(len(splits), 3)

    def test_fewer_scenes_than_parts_are_refused(self):
        result = run("-q", "gather", self.datasets / "room_0", self.datasets / "again", "--out",
                     self.new_folder(), "--format", "yolo", "--split", "by-room", "80/20")
        self.assertFails(result, 2, "1 scene cannot be split into 2 parts")

    def test_shares_in_several_arguments_are_refused(self):
        result = run("-q", "gather", self.datasets, "--out", self.new_folder(), "--format", "yolo",
                     "--split", "by-room", 80, 20)
        self.assertFails(result, 2, "as in 80/10/10")

    def test_a_dataset_behind_split_none_is_one(self):
        out = self.new_folder()
        done = run("-q", "gather", "--out", out, "--format", "yolo", "--split", "none",
                   self.datasets / "room_0", self.datasets / "room_1")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(self.card(out)["sources"]), 2)

    # --- cameras

    def test_layouts_without_rig_cameras_name_those_that_keep_them(self):
        rig = self.folder / "rig"
        self.export(self.folder / "0.dolly", rig, "--range", "0:2", "--camera",
                    "side:width_px=80,height_px=60", "--modalities", "rgb,depth,instance,cameras")
        for layout, is_told in [("yolo", True), ("webdataset", True), ("mcap", False),
                                ("rosbag", False)]:
            done = run("gather", rig, "--out", self.new_folder(), "--format", layout)
            self.assertEqual(done.returncode, 0, done.stderr)
            hint = "'--format mcap' and '--format rosbag' keep the cameras of a rig"
            self.assertEqual(f"cameras; {hint}" in done.stderr, is_told, done.stderr)
            self.assertEqual(hint in done.stderr, is_told)

    # --- names

    def test_equal_names_are_told_apart(self):
        around = self.folder / "alike"
        for part in ["a/kitchen", "b/kitchen", "b/Kitchen"]:
            shutil.copytree(self.datasets / "room_0", around / part)
        out = self.gather("--format", "coco", datasets=[f"{around}/*"])
        names = [one["name"] for one in self.card(out)["sources"]]
        self.assertEqual(len({name.lower() for name in names}), 3, names)
        self.assertEqual(len(list((out / "train").iterdir())), 18)

    def test_a_batch_and_rooms_are_found(self):
        jobs = self.folder / "jobs.toml"
        jobs.write_text('out = "batch_out"\nscenes = ["room_0.obj", "room_1.obj"]\n'
                        "[[set]]\nname = \"s\"\nset = { width_px = 160, height_px = 120 }\n"
                        "[export]\nmax_frames = 2\n")
        done = run("-q", "batch", jobs, "-j", 2)
        self.assertEqual(done.returncode, 0, done.stderr)
        out = self.gather("--format", "coco", datasets=[self.folder / "batch_out"])
        self.assertEqual([one["name"] for one in self.card(out)["sources"]],
                         ["room_0_s", "room_1_s"])
        job = next((self.folder / "batch_out").glob("room_1*")) / "dataset"
        shutil.rmtree(job)
        self.assertFails(run("-q", "gather", self.folder / "batch_out", "--out", self.new_folder(),
                             "--format", "coco"), 4, str(job))

    # --- licences

    def with_licences(self, *texts):
        """Copies of a dataset with these texts as their licences."""
        around = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
        for number, text in enumerate(texts):
            self.copy_as(self.datasets / "room_0", around / f"room_{number}", number)
            if text is not None:
                self.replace_listed(around / f"room_{number}", "LICENSES", text)
        return around

    def test_each_licence_is_written_once(self):
        texts = [b"by A\n", None, b"by B\n\nmore", b"by A\n"]
        around = self.with_licences(*texts)
        for layout in ["yolo", "webdataset"]:
            out = self.gather("--format", layout, "--license", "cc-by-4.0", datasets=[around])
            written = (out / "LICENSES").read_text()
            sections = written.split("\n===== ")[1:]
            self.assertEqual([one.split(" =====\n\n") for one in sections],
                             [["room_0, room_3", "by A\n\n"], ["room_2", "by B\n\nmore\n"]])
            self.assertEqual(sums_of(out)["LICENSES"],
                             hashlib.sha256(written.encode()).hexdigest())
            self.assertEqual([one["licenses_sha256"] for one in self.card(out)["sources"]],
                             [hashlib.sha256(text).hexdigest() if text else "" for text in texts])
            self.assertIn("[LICENSES](LICENSES) has the licence files of the scenes of 3 of the "
                          "4 source datasets", (out / "README.md").read_text())
            again = run("-q", "gather", around, "--out", out, "--format", layout, "--license",
                        "cc-by-4.0", "--resume")
            self.assertEqual(again.returncode, 0, again.stderr)
            (out / "LICENSES").write_text("none")
            self.assertFails(run("-q", "gather", around, "--out", out, "--format", layout,
                                 "--license", "cc-by-4.0", "--resume"), 4, "LICENSES", "damaged")

    def test_datasets_without_licences_have_no_licence_file(self):
        out = self.gather("--format", "yolo", datasets=[self.with_licences(None, None)])
        self.assertFalse((out / "LICENSES").exists())
        self.assertNotIn("LICENSES", (out / "README.md").read_text())

    def test_damaged_licences_are_damage(self):
        for damage in [lambda file: file.unlink(), lambda file: file.write_bytes(b"by C\n")]:
            around = self.with_licences(b"by A\n", b"by B\n")
            damage(around / "room_1" / "LICENSES")
            command = ["-q", "gather", around, "--format", "yolo", "--out"]
            self.assertFails(run(*command, self.new_folder()), 4, "LICENSES")
            out = self.gather("--format", "yolo", "--skip-damaged", datasets=[around])
            self.assertEqual(self.card(out)["skipped"], ["room_1"])
            self.assertNotIn("room_1", (out / "LICENSES").read_text())
        huge = self.with_licences(b"a" * ((1 << 20) + 1))
        self.assertFails(run("-q", "gather", huge, "--format", "yolo", "--out", self.new_folder()),
                         4, "LICENSES")

    # --- datasets that do not match

    def test_contradicting_class_tables_are_refused_or_mapped(self):
        (self.folder / "labels.json").write_text(json.dumps(LABELS))
        other = json.loads(json.dumps(LABELS))
        other["classes"][1]["name"] = "mug"
        (self.folder / "other.json").write_text(json.dumps(other))
        own, own_2 = self.folder / "own", self.folder / "own_2"
        self.export(self.folder / "0.dolly", own, "--labels", self.folder / "labels.json")
        self.export(self.folder / "1.dolly", own_2, "--labels", self.folder / "other.json")
        nyu40 = self.datasets / "room_0"
        for pair, words in [((own, nyu40), ["NYU40"]), ((own, own_2), ["'cup'", "'mug'", "class 2"])]:
            out = self.new_folder()
            refused = run("-q", "gather", *pair, "--out", out, "--format", "coco")
            self.assertFails(refused, 4, str(pair[0]), str(pair[1]), "--class-map", *words)
            self.assertFalse(out.exists())
        for name, text in [("map.json", '{"cup": "mug"}'), ("map.csv", "# names\ncup, mug\n")]:
            (self.folder / name).write_text(text)
            out = self.gather("--format", "webdataset", "--class-map", self.folder / name,
                              datasets=[own, own_2])
            card = self.card(out)
            self.assertEqual([one["name"] for one in card["classes"]], ["seat", "mug"])
            self.assertNotIn("semantic", card["modalities"])
            self.assertEqual(card["class_map"], {"cup": "mug"})
        done = run("-q", "gather", own, own_2, "--out", self.folder / "recordings", "--format", "mcap",
                   "--class-map", self.folder / "map.json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("semantic is left out", done.stderr)
        recordings = list((self.folder / "recordings").rglob("*.mcap"))
        self.assertEqual(len(recordings), 2)
        for path in recordings:
            self.assertNotIn(b"/camera/semantic", path.read_bytes())
        (self.folder / "map.json").write_text('{"cups": "mug"}')
        refused = run("-q", "gather", own, own_2, "--out", self.new_folder(), "--format", "coco",
                      "--class-map", self.folder / "map.json")
        self.assertFails(refused, 4, "'cups'", "did you mean 'cup'?")

    def test_other_sizes_and_lenses_are_refused_naming_both(self):
        small, wide = self.folder / "small", self.folder / "wide"
        self.export(self.folder / "0.dolly", small, "--range", "0:2", "--set", "width_px=80", "--set",
                    "height_px=60")
        self.export(self.folder / "0.dolly", wide, "--range", "0:2", "--set", "hfov_deg=100")
        first = self.datasets / "room_0"
        for second, word in [(small, "80 x 60"), (wide, "--mixed-lenses")]:
            refused = run("-q", "gather", first, second, "--out", self.new_folder(), "--format",
                          "yolo")
            self.assertFails(refused, 4, str(first), str(second), word)
        self.gather("--format", "yolo", "--mixed-lenses", datasets=[first, wide])
        # Recordings stand alone.
        out = self.gather("--format", "mcap", datasets=[first, small, wide])
        self.assertEqual(len(list(out.rglob("*.mcap"))), 3)
        self.assertNotIn(" px", (out / "README.md").read_text())
        out = self.gather("--format", "mcap", datasets=[first, wide])
        self.assertIn("frames of 160 x 120 px with", (out / "README.md").read_text())


if __name__ == "__main__":
    unittest.main()
