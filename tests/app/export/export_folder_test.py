#!/usr/bin/python3
"""Files that an export leaves in its folder, and folders that it refuses: export_folder_test.py
PROGRAM."""
import hashlib
import json
import os
import pathlib
import shutil
import signal
import tempfile
import unittest
import zipfile

from support import small_models, tiny_room
from support.program import FolderCase, hashes, hold, lines_in, run, start, wait_for

SIZE = ["--set", "width_px=64", "--set", "height_px=48"]
FRAMES = 10
# Takes seconds to render: enough time to stop an export that has begun.
MANY_FRAMES = ["--max-frames", 600, "--set", "max_repeat_rate=1"]


class ExportFolder(FolderCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.room = cls.folder / "room.obj"
        cls.project = cls.folder / "room.dolly"
        tiny_room.write(cls.room)
        made = run("plan", cls.room, "-o", cls.project, "--max-frames", FRAMES, *SIZE)
        assert made.returncode == 0, made.stderr

    def new_folder(self):
        return pathlib.Path(tempfile.mkdtemp(dir=self.folder)) / "dataset"

    def export(self, out, *arguments):
        result = run("-q", "export", self.project, "--out", out, *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    # --- without images

    def test_what_is_no_picture_needs_no_contact_sheet(self):
        for modality in ["flow_forward", "amodal", "depth_exr", "flow_forward,amodal"]:
            with self.subTest(modality):
                out = self.new_folder()
                summary = json.loads(self.export(out, "--modalities", modality, "--range", "0:4",
                                                 "--json").stdout)
                self.assertIsNone(summary["contact_sheet"])
                self.assertFalse((out / "contact_sheet.jpg").exists())
                self.assertNotIn("contact_sheet.jpg",
                                 json.loads((out / "dataset.json").read_text())["files"])
                verified = run("-q", "verify", out)
                self.assertEqual(verified.returncode, 0, verified.stdout)
                self.export(out, "--modalities", modality, "--range", "0:4", "--resume")

    def test_the_sheet_shows_what_pictures_there_are(self):
        import cv2
        for modality in ["amodal,disparity", "normal_world", "depth_right"]:
            with self.subTest(modality):
                out = self.new_folder()
                self.export(out, "--modalities", modality, "--range", "0:4")
                sheet = cv2.imread(str(out / "contact_sheet.jpg"))
                # The images below the title must not be of a single colour.
                self.assertGreater(sheet[60:].std(), 10)

    # --- a complete dataset

    def test_a_complete_dataset_is_not_replaced_unasked(self):
        out = self.new_folder()
        self.export(out, "--modalities", "rgb")
        before = hashes(out)
        for arguments in [[], ["--range", "0:2"], ["--modalities", "rgb"]]:
            refused = run("-q", "export", self.project, "--out", out, *arguments)
            self.assertFails(refused, 2, f"complete dataset of {FRAMES} frames", "--overwrite",
                             "--resume", "another folder")
            self.assertEqual(hashes(out), before)
        # The same dataset is found complete; another one is reported as such.
        self.export(out, "--modalities", "rgb", "--resume")
        self.assertFails(run("-q", "export", self.project, "--out", out, "--range", "0:2",
                             "--resume"), 2, "another complete dataset", "--overwrite")
        self.assertEqual(hashes(out), before)
        self.export(out, "--range", "0:2", "--overwrite")
        self.assertEqual(len(list((out / "rgb").iterdir())), 2)

    def test_what_is_mistyped_is_said_before_that_the_folder_is_taken(self):
        out = self.new_folder()
        self.export(out, "--modalities", "depth", "--range", "0:2")
        for scene, arguments, code, word in [
            (self.folder / "none.obj", [], 4, "none.obj"),
            (self.folder / "none.dolly", [], 4, "none.dolly"),
            (self.project, ["--set", "hfov_deg=900"], 2, "hfov_deg"),
            (self.project, ["--set", "lamp_temperature_K=500"], 2, "0, or 1000 .. 20000 K"),
            (self.project, ["--set", "hfof_deg=90"], 2, "hfov_deg"),
            (self.project, ["--modalities", "dept"], 2, "did you mean 'depth'"),
            (self.project, ["--formats", "cocoa"], 2, "did you mean 'coco'"),
            (self.project, ["--planner", "dollitrack"], 2, "dollytrack"),
            (self.project, [], 2, "--overwrite"),
        ]:
            with self.subTest(word):
                result = run("-q", "export", scene, "--out", out, *arguments)
                self.assertFails(result, code, word)
                if arguments or scene != self.project:
                    self.assertNotIn("--overwrite", result.stderr)

    # --- files that are not the dataset's

    def pictures(self, out):
        """A folder of the user's numbered images beside an output folder, and its hashes."""
        pictures = out.parent / "pictures"
        pictures.mkdir(parents=True)
        for i in range(12):
            (pictures / f"{i:06}.png").write_bytes(b"mine %d" % i)
        out.mkdir()
        return pictures, hashes(pictures)

    def test_no_link_in_the_folder_is_followed(self):
        for mode in [[], ["--resume"], ["--overwrite"]]:
            for place in [".dollytrack-export", "rgb", "annotations.json",
                          ".dollytrack-new"]:
                with self.subTest(mode=mode, place=place):
                    out = self.new_folder()
                    pictures, before = self.pictures(out)
                    (out / ".dollytrack-export").write_text("{}\n")
                    link = out / place
                    link.unlink(missing_ok=True)
                    file = place in (".dollytrack-export", "annotations.json")
                    link.symlink_to("../pictures/000000.png" if file else "../pictures")
                    refused = run("-q", "export", self.project, "--out", out, "--range", "0:2",
                                  "--modalities", "rgb,instance", "--formats", "coco", *mode)
                    self.assertFails(refused, 6, str(link), "link")
                    self.assertEqual(hashes(pictures), before)

    def test_a_link_in_the_way_of_a_file_is_said_before_anything_is_drawn(self):
        for place in ["camera.json", "dataset.json", "contact_sheet.jpg", "rgb/000001.png"]:
            with self.subTest(place=place):
                out = self.new_folder()
                pictures, before = self.pictures(out)
                (out / "rgb").mkdir()
                (out / place).symlink_to(pictures / "000000.png")
                refused = run("-q", "export", self.project, "--out", out, "--range", "0:2",
                              "--modalities", "rgb", "--formats", "camera_json", "--overwrite")
                self.assertFails(refused, 6, str(out / place), "link")
                self.assertNotIn("frames are finished", refused.stderr)
                self.assertFalse((out / "rgb" / "000000.png").exists())
                self.assertEqual(hashes(pictures), before)

    def test_a_journal_with_a_second_name_is_not_written(self):
        out = self.new_folder()
        pictures, before = self.pictures(out)
        (out / ".dollytrack-export").hardlink_to(pictures / "000003.png")
        self.assertFails(run("-q", "export", self.project, "--out", out, "--range", "0:2"), 6,
                         ".dollytrack-export", "second name")
        self.assertEqual(hashes(pictures), before)

    def test_overwriting_removes_only_what_the_old_dataset_lists(self):
        out = self.new_folder()
        pictures, before = self.pictures(out)
        (out / "albedo").symlink_to("../pictures")
        (out / "dataset.json").write_text('{"format": "dollytrack dataset"}')
        made = ["--range", "0:2", "--overwrite", "--formats", "camera_json", "--modalities"]
        self.export(out, *made, "depth")
        self.assertEqual(hashes(pictures), before)
        self.assertFails(run("-q", "export", self.project, "--out", out, *made, "albedo"), 6,
                         str(out / "albedo"), "link")
        (out / "depth" / "000007.png").write_text("mine")
        (out / "notes.txt").write_text("mine")
        listed = json.loads((out / "dataset.json").read_text())
        for name in ["../pictures/000001.png", str(pictures / "000002.png"), "albedo/000003.png"]:
            listed["files"][name] = ""
        (out / "dataset.json").write_text(json.dumps(listed))
        self.assertFails(run("-q", "export", self.project, "--out", out, *made, "instance"), 6,
                         str(out / "albedo"), "link")
        (out / "albedo").unlink()
        self.export(out, *made, "instance")
        self.assertEqual(hashes(pictures), before)
        self.assertEqual(sorted(hashes(out)),
                         ["camera.json", "contact_sheet.jpg", "dataset.json", "depth/000007.png",
                          "instance/000000.png", "instance/000001.png", "notes.txt"])

    # --- licences beside the scene

    def scene_with(self, **texts):
        """A new folder with the scene and files of these names and contents."""
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
        shutil.copy(self.room, folder)
        for name, content in texts.items():
            (folder / name.replace("_", ".")).write_bytes(content)
        return folder

    def export_scene(self, scene, out, *arguments):
        result = run("export", scene / "room.obj", "--out", out, "--max-frames", 2, *SIZE,
                     "--modalities", "depth", *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stderr

    def test_licences_beside_the_scene_are_in_the_dataset(self):
        mit, credits = "MIT\n\n© me\n".encode(), b"chair: by A"
        scene = self.scene_with(Licence_TXT=mit, ATTRIBUTION_md=credits, licenses_json=b"{}",
                                room_mtl=b"")
        out = self.new_folder()
        self.assertNotIn("left out of the dataset", self.export_scene(scene, out))
        text = (out / "LICENSES").read_bytes()
        self.assertEqual(text, credits + b"\n\n" + mit)
        card = json.loads((out / "dataset.json").read_text())
        self.assertEqual(card["files"]["LICENSES"], hashlib.sha256(text).hexdigest())
        verified = run("-q", "verify", out)
        self.assertEqual(verified.returncode, 0, verified.stdout)
        # Without licence files, nothing is written, and all other files are the same.
        plain = self.new_folder()
        self.export_scene(self.scene_with(room_mtl=b""), plain)
        with_them, without = hashes(out), hashes(plain)
        for files in (with_them, without):
            del files["dataset.json"]
        del with_them["LICENSES"]
        self.assertEqual(with_them, without)

    def test_licences_of_folders_of_models_are_in_the_dataset(self):
        """Each text once. A home, which is an untrusted archive, is not opened for them."""
        scene = self.scene_with(LICENSE=b"beside\n")
        home = scene / "flat.sh3d"
        home.write_bytes(small_models.sh3d())
        with zipfile.ZipFile(home, "a") as file:
            file.writestr("LICENSE.TXT", "inside\n")
        models = self.new_folder()
        models.mkdir()
        (models / "Copying").write_text("folder\n")
        (models / "license").write_text("beside\n")
        (models / "chair.txt").write_text("no licence\n")
        out = self.new_folder()
        result = run("export", home, "--models", models, "--out", out, "--max-frames", 2, *SIZE,
                     "--modalities", "depth")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual((out / "LICENSES").read_text(), "beside\n\nfolder\n")
        self.assertNotIn("licence", result.stderr)
        self.assertNotIn("left out of the dataset", result.stderr)

    def test_other_licences_make_another_dataset(self):
        scene = self.scene_with(LICENSE=b"first\n")
        out = self.new_folder()
        self.export_scene(scene, out)
        before = hashes(out)
        self.export_scene(scene, out, "--resume")
        for change in ["second\n", ""]:
            (scene / "LICENSE").write_text(change)
            self.assertFails(run("-q", "export", scene / "room.obj", "--out", out, "--max-frames", 2,
                                 *SIZE, "--modalities", "depth", "--resume"), 2,
                             "different: LICENSES")
        self.assertEqual(hashes(out), before)
        self.export_scene(scene, out, "--overwrite")
        self.assertFalse((out / "LICENSES").exists())

    def test_an_unfinished_export_has_its_own_licences(self):
        scene = self.scene_with(LICENSE=b"first\n")
        out = self.new_folder()
        command = ["-q", "export", scene / "room.obj", "--out", out, *MANY_FRAMES, *SIZE,
                   "--modalities", "depth"]
        process = start(*command)
        self.assertTrue(wait_for(lambda: process.poll() is not None or
                                 lines_in(out / ".dollytrack-export") > 3))
        process.send_signal(signal.SIGINT)
        process.communicate()
        self.assertEqual(process.returncode, 130)
        (scene / "LICENSE").write_text("second\n")
        self.assertFails(run(*command, "--resume"), 2, "different: the scene's licences")
        (scene / "LICENSE").write_text("first\n")
        resumed = run(*command, "--resume")
        self.assertEqual(resumed.returncode, 0, resumed.stderr)
        self.assertEqual((out / "LICENSES").read_text(), "first\n")

    def test_links_and_large_files_are_no_licences_of_a_dataset(self):
        secret = self.folder / "secret"
        secret.write_text("private\n")
        most = 1 << 20
        for name, make, expected in [
            ("LICENSE", lambda path: path.symlink_to(secret), None),
            ("COPYING", lambda path: path.write_bytes(b"a" * (most + 1)), None),
            ("LICENSES", lambda path: path.mkdir(), None),
            ("license.txt", os.mkfifo, None),
            # Together with the other text it would be too large.
            ("LICENSE.md", lambda path: path.write_bytes(b"b" * (most - 4)), b"kept\n"),
        ]:
            with self.subTest(name):
                scene = self.scene_with(**({"COPYING": expected} if expected else {}))
                make(scene / name)
                out = self.new_folder()
                said = self.export_scene(scene, out)
                self.assertRegex(said, f"{name}: left out of the dataset")
                self.assertEqual((out / "LICENSES").exists(), expected is not None)
                if expected:
                    self.assertEqual((out / "LICENSES").read_bytes(), expected)
                self.assertFalse(any(b"private" in path.read_bytes()
                                     for path in out.rglob("*") if path.is_file()))

    def test_licences_are_clean_text(self):
        out = self.new_folder()
        said = self.export_scene(self.scene_with(COPYING=b"by Andr\xe9\x1b[31m\tX\r\n"), out)
        self.assertIn("COPYING: some characters are not UTF-8", said)
        self.assertEqual((out / "LICENSES").read_bytes().decode(), "by Andr\ufffd[31m\tX\n")

    def test_a_licence_in_the_datasets_own_folder_stays_as_it_is(self):
        scene = self.scene_with(LICENSES=b"mine \xe9")
        said = self.export_scene(scene, scene, "--overwrite")
        self.assertIn("LICENSES: left out of the dataset, whose folder contains it", said)
        self.assertEqual((scene / "LICENSES").read_bytes(), b"mine \xe9")
        card = json.loads((scene / "dataset.json").read_text())
        self.assertNotIn("LICENSES", card["files"])

    # --- a dataset that is replaced

    def test_an_export_that_does_not_end_leaves_the_old_dataset_whole(self):
        out = self.new_folder()
        self.export(out, "--modalities", "depth", "--range", "0:3")
        before = hashes(out)
        again = ["export", self.room, "--out", out, *MANY_FRAMES, "--modalities", "rgb,albedo",
                 "--set", "width_px=160", "--set", "height_px=120"]
        for end in [signal.SIGINT, signal.SIGKILL]:
            process = start("-q", *again, "--overwrite",
                            *(["--resume"] if end == signal.SIGKILL else []))
            self.assertTrue(wait_for(lambda: process.poll() is not None or
                                     lines_in(out / ".dollytrack-export") > 3))
            process.send_signal(end)
            process.communicate()
            self.assertNotEqual(process.returncode, 0)
            left = hashes(out)
            self.assertEqual({name: left.get(name) for name in before}, before)
            verified = run("-q", "verify", out, "--scene", self.project)
            self.assertEqual(verified.returncode, 0, verified.stdout)
        refused = run("-q", *again)
        self.assertFails(refused, 2, "complete dataset of 3 frames")
        resumed = run(*again, "--resume")
        self.assertEqual(resumed.returncode, 0, resumed.stderr)
        self.assertIn("resuming", resumed.stderr)
        fresh = self.new_folder()
        made = run("-q", "export", self.room, "--out", fresh, *again[4:])
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertEqual(hashes(out), hashes(fresh))
        self.assertEqual(list(out.glob(".*")), [])

    # --- allowed, but hardly intended

    def test_light_by_frame_that_does_not_vary_or_is_not_recorded_is_warned_of(self):
        by_frame = ["--set", "light_varies=frame", "--modalities", "rgb", "--range", "0:1"]
        for arguments, said in [
            (["--formats", "frames"], "light_variation=0"),
            (["--formats", "coco", "--modalities", "instance", "--set", "light_variation=0.5"],
             "add frames to --formats"),
            (["--formats", "frames", "--set", "light_variation=0.5"], None),
        ]:
            with self.subTest(said):
                warnings = self.export(self.new_folder(), *by_frame, *arguments).stderr
                self.assertEqual(warnings.count("light_varies"), 0 if said is None else 1, warnings)
                self.assertIn(said or "", warnings)
        self.assertNotIn("light", self.export(self.new_folder(), "--modalities", "rgb", "--range",
                                              "0:1").stderr)

    def test_settings_that_others_make_idle_are_warned_of(self):
        sensor = ["--modalities", "rgb_sensor"]
        for settings, said, more in [
            (["light_preset=night", "sun_strength=2"], "sun_strength", []),
            (["light_preset=night", "sun_azimuth_deg=10"], "sun_azimuth_deg", []),
            (["light_preset=night"], None, []),
            (["light_preset=day", "sun_strength=2", "sun_azimuth_deg=10"], None, []),
            (["reference_samples=2"], "reference_samples", []),
            (["reference_samples=2", "render_mode=reference"], None, []),
            (["traced_samples=2", "render_mode=reference", "reference_samples=2"],
             "traced_samples", []),
            (["traced_samples=2", "render_mode=traced"], None, []),
            (["light_seed=2"], "light_seed has no effect with light_variation=0; set "
                               "light_variation above 0", []),
            (["focus_m=2"], "focus_m", sensor),
            (["looks=1", "readout_s=0"], "looks", sensor),
            (["looks=1", "readout_s=0"], None, ["--modalities", "rgb,depth_sensor"]),
            (["looks=1"], None, sensor),
            (["looks=1", "sensor_preset=ideal"], None, sensor),
            (["looks=2", "readout_s=0"], None, sensor),
        ]:
            with self.subTest(settings):
                words = [word for one in settings for word in ("--set", one)]
                warnings = self.export(self.new_folder(), *(more or ["--modalities", "rgb"]),
                                       "--range", "0:1", *words).stderr
                told = [line for line in warnings.splitlines() if " has no effect with " in line]
                self.assertEqual(len(told), 0 if said is None else 1, warnings)
                self.assertIn(said or "", "".join(told))

    def test_other_pictures_than_were_planned_are_said_to_be_other_views(self):
        for arguments, said in [(["--set", "width_px=80"],
                                 "width_px; planning again, so the views will differ; to plan only "
                                 "once, give --set width_px=80 to 'dollytrack plan'"),
                                (["--set", "light_preset=night"], None)]:
            warnings = self.export(self.new_folder(), "--modalities", "depth", "--range", "0:1",
                                   *arguments).stderr
            self.assertEqual("views will differ" in warnings, said is not None, warnings)
            self.assertIn(said or "", warnings)

    def test_a_folder_that_was_taken_away_is_not_to_be_continued(self):
        out = self.new_folder()
        process = start("-q", "export", self.room, "--out", out, *MANY_FRAMES,
                        "--formats", "camera_json")
        self.assertTrue(wait_for(lambda: process.poll() is not None or
                                 lines_in(out / ".dollytrack-export") > 2))
        hold(process)
        shutil.rmtree(out)
        process.send_signal(signal.SIGCONT)
        _, errors = process.communicate()
        self.assertEqual(process.returncode, 6, errors)
        self.assertIn("were removed meanwhile", errors)
        self.assertNotIn("--resume", errors)
        self.assertFalse(out.exists())

    # --- one dataset per room

    def two_rooms(self):
        """A project with one trajectory per room."""
        project = self.folder / "two_rooms.dolly"
        if not project.exists():
            scene = self.folder / "two_rooms.obj"
            tiny_room.write_two(scene)
            made = run("plan", scene, "-o", project, "--set", "rooms=each", "--max-frames", 10,
                       *SIZE, "--json")
            self.assertEqual(made.returncode, 0, made.stderr)
        rooms = json.loads(project.read_text())["result"]["metrics"]["rooms"]
        return project, rooms

    def test_too_few_frames_of_a_room_are_said_before_any_is_rendered(self):
        project, rooms = self.two_rooms()
        self.assertGreater(len(rooms), 1)
        fewest = min(rooms, key=lambda room: room["frames"])
        for arguments, word in [(["--folds", fewest["frames"] + 1], "--folds"),
                                (["--range", f"{fewest['frames']}:"], "--range")]:
            out = self.new_folder()
            self.assertFails(run("-q", "export", project, "--out", out, *arguments), 2,
                             fewest["name"], word)
            self.assertFalse(out.exists())

    def test_a_rooms_folder_that_is_a_link_is_not_followed(self):
        project, rooms = self.two_rooms()
        out = self.new_folder()
        pictures, before = self.pictures(out)
        for name in ["rooms.json", rooms[-1]["name"]]:
            (out / name).symlink_to("../pictures/000000.png" if name == "rooms.json"
                                    else "../pictures")
            self.assertFails(run("-q", "export", project, "--out", out, "--modalities", "instance",
                                 "--overwrite"), 6, str(out / name), "link")
            self.assertEqual(hashes(pictures), before)
            (out / name).unlink()

    def test_rooms_that_were_not_come_to_are_missed(self):
        project, rooms = self.two_rooms()
        out = self.new_folder()
        made = run("-q", "export", project, "--out", out, "--modalities", "instance")
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertEqual(run("-q", "verify", out).returncode, 0)
        before = hashes(out)
        shutil.rmtree(out / rooms[0]["name"])
        again = run("-q", "export", project, "--out", out, "--modalities", "instance")
        self.assertFails(again, 2, "complete dataset", rooms[1]["name"])
        self.assertFalse((out / rooms[0]["name"]).exists())  # reported before any is rendered
        again = run("-q", "export", project, "--out", out, "--modalities", "instance", "--resume")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(hashes(out), before)
        last = rooms[-1]["name"]
        (out / last / "dataset.json").unlink()
        for _ in range(2):  # unfinished, and not begun
            verified = run("-q", "verify", out)
            self.assertEqual(verified.returncode, 4, verified.stdout)
            self.assertIn("UNFINISHED", verified.stdout)
            self.assertIn(last, verified.stdout.splitlines()[-1])
            report = json.loads(run("-q", "verify", out, "--json").stdout)
            self.assertFalse(report["sound"])
            self.assertEqual(report["missing"], [last])
            shutil.rmtree(out / last, ignore_errors=True)
        (out / "rooms.json").write_text('{"rooms": [{"name": "../elsewhere"}]}')
        self.assertFails(run("-q", "verify", out), 4, "elsewhere", "rooms.json")


if __name__ == "__main__":
    unittest.main()
