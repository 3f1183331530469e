"""Runs `dollytrack verify` on an untouched dataset and on damaged ones: verify_test.py PROGRAM."""
import json
import pathlib
import re
import shutil
import tempfile
import unittest

import annotation_corruptions
import card_corruptions  # noqa: F401  (adds to corruptions.ALL)
import corruptions
import detection_corruptions  # noqa: F401
import file_corruptions  # noqa: F401
import geometry_corruptions
import motion_corruptions  # noqa: F401
import picture_corruptions  # noqa: F401
import reconstruction_corruptions  # noqa: F401
import rig_corruptions
import sensor_corruptions  # noqa: F401
import slam_corruptions  # noqa: F401
from dataset_copy import Copy
from support import tiny_room
from support.program import FolderCase, run


def forget_path(dataset, path=None):
    """Changes the scene's path in dataset.json, as if the scene had been moved away."""
    file = dataset / "dataset.json"
    card = json.loads(file.read_text())
    card["scene"]["path"] = path or str(dataset / "nowhere" / "room.obj")
    file.write_text(json.dumps(card))


class VerifyTest(FolderCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        tiny_room.write(cls.folder / "room.obj")
        (cls.folder / "LICENSE").write_text("CC-BY 4.0\n")
        plan = run("plan", cls.folder / "room.obj", "-o", cls.folder / "room.dolly",
                   "--set", "width_px=128", "--set", "height_px=96", "--max-frames", 6)
        assert plan.returncode == 0, plan.stderr
        cls.dataset = cls.folder / "dataset"
        export = run("export", cls.folder / "room.dolly", "--out", cls.dataset,
                     "--modalities", "all", "--formats", "all", "--folds", 3,
                     *rig_corruptions.RIG)
        assert export.returncode == 0, export.stderr

    def verify(self, folder, *arguments):
        """The exit code and the result of each check."""
        result = run("-q", "verify", folder, "--json", *arguments)
        self.assertIn(result.returncode, (0, 4), result.stderr)
        report = json.loads(result.stdout)
        self.assertEqual(report["sound"], result.returncode == 0)
        return result.returncode, {check["check"]: check for check in report["checks"]}

    def damaged(self, function):
        folder = self.folder / "damaged"
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(self.dataset, folder)
        copy = Copy(folder)
        function(copy)
        copy.save()
        return folder

    def test_an_untouched_dataset_passes_every_check(self):
        code, checks = self.verify(self.dataset)
        # Only path-traced images have layers of light; see tests/app/export/traced_test.py.
        self.assertEqual({name: one["status"] for name, one in checks.items()},
                         {name: "skipped" if name == "light" else "passed" for name in checks})
        self.assertEqual(code, 0)

    # Depth in integer millimetres does not tell on which side of the other camera's near plane a
    # surface is, or whether a motion is longer than the file format allows.
    def test_motions_at_the_edge_of_what_is_known_are_sound(self):
        project, out = self.folder / "close.dolly", self.folder / "close"
        for command in [
            ["plan", self.folder / "room.obj", "-o", project, "--set", "width_px=160", "--set",
             "height_px=120", "--max-frames", 24],
            ["export", project, "--out", out, "--modalities", "depth,flow_forward,flow_backward",
             "--flow-distances", "1,2,3,5,8", "--formats", "kitti"],
        ]:
            result = run(*command)
            self.assertEqual(result.returncode, 0, result.stderr)
        code, checks = self.verify(out)
        self.assertEqual(code, 0, [one for one in checks.values() if one["status"] == "failed"])

    def test_the_scene_is_found_through_a_project(self):
        for with_project, status in [(True, "passed"), (False, "skipped")]:
            folder = pathlib.Path(tempfile.mkdtemp(dir=self.folder)) / "deep"
            (folder / "rooms").mkdir(parents=True)
            shutil.copy(self.folder / "room.obj", folder / "rooms")
            shutil.copytree(self.dataset, folder / "dataset")
            forget_path(folder / "dataset")
            if with_project:
                planned = run("plan", folder / "rooms" / "room.obj", "-o", folder / "a.dolly",
                              "--max-frames", 2)
                self.assertEqual(planned.returncode, 0, planned.stderr)
            code, checks = self.verify(folder / "dataset")
            self.assertEqual((code, checks["scene"]["status"]), (0, status))

    def test_the_scene_is_found_where_it_was(self):
        away = self.folder / "far" / "from" / "the_scene"
        shutil.copytree(self.dataset, away)
        self.assertEqual(json.loads((away / "dataset.json").read_text())["scene"]["path"],
                         str(self.folder / "room.obj"))
        code, checks = self.verify(away)
        self.assertEqual((code, checks["scene"]["status"]), (0, "passed"))
        forget_path(away)
        self.assertEqual(self.verify(away)[1]["scene"]["status"], "skipped")
        # A path that leads to something else is ignored.
        for path in ("/dev/zero", str(self.folder), str(away / "dataset.json"), "room.obj", ""):
            forget_path(away, path)
            code, checks = self.verify(away)
            self.assertEqual((code, checks["scene"]["status"]), (0, "skipped"), path)

    def test_mended_hashes_alone_damage_nothing(self):
        code, checks = self.verify(self.damaged(lambda copy: None))
        self.assertEqual(code, 0, [one for one in checks.values() if one["status"] == "failed"])

    def test_each_corruption_is_found_by_the_check_that_should(self):
        self.assertGreaterEqual(len(corruptions.ALL), 175)
        for name, check, function in corruptions.ALL:
            with self.subTest(name):
                folder = self.damaged(function)
                code, checks = self.verify(folder)
                failed = [one for one, result in checks.items() if result["status"] == "failed"]
                self.assertEqual(code, 4)
                self.assertIn(check, failed)
                finding = checks[check]["findings"][0]
                self.assertTrue(finding["file"] and finding["found"], finding)
                if check not in ("albedo", "scene"):  # only the scene knows these
                    self.found_without_the_scene(folder)

    def found_without_the_scene(self, folder):
        away = self.folder / "away" / "from" / "it"
        shutil.rmtree(away, ignore_errors=True)
        away.parent.mkdir(parents=True, exist_ok=True)
        folder.rename(away)
        forget_path(away)
        code, checks = self.verify(away)
        self.assertEqual(checks["surface"]["status"], "skipped")
        self.assertIn("--scene", checks["surface"]["reason"])
        # The same shift of half a pixel in all poses can only be detected by the poses in
        # other files.
        self.assertEqual(code, 4)

    def test_the_card_says_what_holds_each_thing(self):
        objects = json.loads((self.dataset / "dataset.json").read_text())["objects"]
        names = {one["id"]: one["name"] for one in objects}
        held = {one["name"]: [(held["kind"], names[held["id"]]) for held in one["relations"]]
                for one in objects if one["role"] == "target"}
        self.assertEqual(held, {"table": [("on", "floor")], "mug": [("on", "table")],
                                "book": [("on", "table")], "sofa": [("on", "floor")],
                                "picture": [("hangs_on", "wall_3")]})

    def test_things_that_move_are_followed(self):
        moving = self.folder / "moving.dolly"
        track = {"op": "object_track", "object": "table", "keys": [
            {"time_s": 0}, {"time_s": 5, "offset": [0.3, 0.2, 0], "turn_deg": 30}]}
        edit = run("edit", self.folder / "room.dolly", "-o", moving, "--op", json.dumps(track))
        self.assertEqual(edit.returncode, 0, edit.stderr)
        out = self.folder / "moving"
        export = run("export", moving, "--out", out, "--modalities", "all", "--formats", "all", "--folds", 3, *rig_corruptions.RIG)
        self.assertEqual(export.returncode, 0, export.stderr)
        code, checks = self.verify(out)
        self.assertEqual(code, 0, [one for one in checks.values() if one["status"] == "failed"])
        copy = Copy(out)
        self.assertTrue(all(frame["moving"] for frame in copy.card["frames"]))
        for frame in copy.card["frames"]:
            for moved in frame["moving"]:
                moved["position"] = [-value for value in moved["position"]]
        copy.save()
        failed = {one for one, result in self.verify(out)[1].items()
                  if result["status"] == "failed"}
        self.assertLessEqual({"cameras", "flow", "surface", "object_coordinates"}, failed)

    def test_a_finding_names_file_frame_and_pixel(self):
        folder = self.damaged(annotation_corruptions.one_pixel_of_another_class)
        finding = self.verify(folder)[1]["classes"]["findings"][0]
        self.assertEqual((finding["file"], finding["frame"], finding["pixel"]),
                         ("semantic/000001.png", 1, [30, 20]))
        printed = run("-q", "verify", folder)
        self.assertEqual(printed.returncode, 4)
        self.assertIn("semantic/000001.png, frame 1, pixel (30, 20)", " ".join(printed.stdout.split()))
        self.assertIn("DAMAGED", printed.stdout)

    def test_the_report_is_the_same_for_any_number_of_threads(self):
        folder = self.damaged(geometry_corruptions.depth_along_the_ray)
        reports = [run("-q", "--threads", count, "verify", folder, "--json").stdout
                   for count in (1, 2, 5)]
        self.assertEqual(reports[0], reports[1])
        self.assertEqual(reports[0], reports[2])

    def test_a_project_is_a_scene_and_another_scene_is_refused(self):
        code, checks = self.verify(self.dataset, "--scene", self.folder / "room.dolly")
        self.assertEqual((code, checks["surface"]["status"]), (0, "passed"))
        tiny_room.write_boxes(self.folder / "other.obj", [("floor", (0, -0.1, 0), (4, 0, 3))])
        self.assertFails(run("-q", "verify", self.dataset, "--scene", self.folder / "other.obj"), 4,
                         "other.obj", "not the scene")

    def test_a_folder_without_a_dataset_is_said_to_be_none(self):
        (self.folder / "nothing").mkdir(exist_ok=True)
        self.assertFails(run("verify", self.folder / "nothing"), 4, "dataset.json")

    def test_a_size_that_no_image_has_is_refused(self):
        def widen(copy):
            copy.card["conventions"]["intrinsics"]["width"] = 2 ** 30
        self.assertFails(run("verify", self.damaged(widen)), 4, "conventions.intrinsics", "16384")

    def test_a_card_with_a_wrong_type_is_refused_with_the_field(self):
        def changed(copy, change):
            copy.mended = False
            change(copy.card)
        for field, change in {
            "objects": lambda card: card.update(objects=5),
            "objects[1]": lambda card: card["objects"][1].update(name=[]),
            "frames[0]": lambda card: card["frames"][0].update(time_s="soon"),
            "formats": lambda card: card.update(formats={"coco": 1}),
            "files": lambda card: card["files"].update({"rgb/000000.png": 5}),
            "conventions.intrinsics": lambda card: card.update(conventions=None),
        }.items():
            with self.subTest(field):
                result = run("verify", self.damaged(lambda copy: changed(copy, change)))
                self.assertFails(result, 4, f"dataset.json: {field}: ", "export the dataset again")
                self.assertNotIn("json.exception", result.stderr)

    def test_a_few_modalities_are_checked_as_far_as_they_go(self):
        out = self.folder / "few"
        export = run("export", self.folder / "room.dolly", "--out", out, "--modalities",
                     "rgb,depth", "--formats", "camera_json")
        self.assertEqual(export.returncode, 0, export.stderr)
        code, checks = self.verify(out)
        self.assertEqual(code, 0)
        self.assertEqual(checks["coco"]["status"], "skipped")
        self.assertIn("coco", checks["coco"]["reason"])
        self.assertEqual(checks["poses"]["status"], "passed")

    def test_a_preview_of_a_very_slow_trajectory_is_sound(self):
        project = self.folder / "slow.dolly"
        plan = run("plan", self.folder / "room.obj", "-o", project, "--set", "width_px=64", "--set",
                   "height_px=48", "--max-frames", 4, "--set", "motion_preset=custom",
                   "--set", "max_speed_mps=0.005")
        self.assertEqual(plan.returncode, 0, plan.stderr)
        out = self.folder / "slow"
        export = run("export", project, "--out", out, "--modalities", "rgb", "--formats", "video")
        self.assertEqual(export.returncode, 0, export.stderr)
        frames = json.loads((out / "dataset.json").read_text())["frames"]
        self.assertGreater(frames[1]["time_s"] - frames[0]["time_s"], 100.0)
        code, checks = self.verify(out)
        self.assertEqual(code, 0)
        self.assertEqual(checks["video"]["status"], "passed")

    def test_the_last_line_says_how_much_was_not_looked_at_and_why(self):
        whole = run("-q", "verify", self.dataset).stdout.strip().splitlines()[-1]
        self.assertRegex(whole, r"^\d+ passed, 0 failed, 1 skipped \(1 concerns files that were not "
                                r"exported\): sound$")
        out = self.folder / "away_from_it" / "all" / "fewer"
        export = run("export", self.folder / "room.dolly", "--out", out, "--modalities",
                     "rgb,depth", "--formats", "camera_json")
        self.assertEqual(export.returncode, 0, export.stderr)
        near = run("-q", "verify", out, "--scene", self.folder / "room.obj").stdout
        names = re.search(r"not exported: (.*?)\n\n", near, re.DOTALL).group(1).split(",")
        skipped = len(names)
        self.assertEqual({name.strip() for name in names},
                         {name for name, check in self.verify(out)[1].items()
                          if check["status"] == "skipped"})
        self.assertGreater(skipped, 5)
        self.assertIn(f"{skipped} skipped ({skipped} concern files that were not exported): sound",
                      near)
        # Only the check 'scene' needs the scene, since neither ids nor surfaces were written.
        forget_path(out)
        away = run("-q", "verify", out).stdout
        self.assertIn(f"{skipped + 1} skipped ({skipped} concern files that were not exported; "
                      "1 needs the scene: pass it with --scene): sound as far as checked", away)

    def test_the_list_names_every_check(self):
        listed = run("verify", "--list")
        self.assertEqual(listed.returncode, 0)
        for name in self.verify(self.dataset)[1]:
            self.assertIn(name, listed.stdout)


if __name__ == "__main__":
    unittest.main()
