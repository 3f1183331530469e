#!/usr/bin/python3
"""What an export leaves in its folder, and what it refuses to do there: export_folder_test.py PROGRAM."""
import json
import pathlib
import shutil
import signal
import tempfile
import unittest

import tiny_room
from program import FolderCase, hashes, run, start, wait_for

SIZE = ["--set", "width_px=64", "--set", "height_px=48"]
FRAMES = 10


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

    # --- without pictures

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
                # The pictures below the title, which are not all of one shade.
                self.assertGreater(sheet[60:].std(), 10)


if __name__ == "__main__":
    unittest.main()
