"""Exports from the editor, and the preview of their images."""
import hashlib
import json
import pathlib
import subprocess

import cv2
import numpy

from task import Programs, Task, plan

DONE, CANCELLED = 3, 4  # of ui/export_job.h
# Slow enough to be stopped halfway even on a busy machine.
FRAMES = 120
SLOW = ("--set", "width_px=320", "--set", "height_px=240", "--max-frames", str(FRAMES), "--set",
        "max_repeat_rate=1")
SMALL = ("--set", "width_px=160", "--set", "height_px=120", "--max-frames", "12")


class Exporting(Task):
    def queue(self, folder, *left_out):
        """Fills in the export panel and queues the dataset; returns the job's number."""
        self.name_folder(folder)
        for name in left_out:
            self.press_in_panel(name)
        self.press_in_panel("export.add")
        state = self.editor.wait(lambda now: now["exports"], "the job")
        return state["exports"][-1]["id"]

    def name_folder(self, folder):
        self.editor.key("ctrl+e")
        self.editor.click("export.folder")
        self.editor.key("ctrl+a")
        self.editor.type(str(folder))
        self.editor.key("enter")

    def press_in_panel(self, name):
        left, top, right, bottom = self.editor.reach(name, self.panel_place())[:4]
        self.editor.click(((left + right) / 2, (top + bottom) / 2))

    def panel_place(self):
        """A position over the settings, but not over a field that the wheel would change."""
        left, top, *_ = self.editor.item("tab.timeline")[:4]
        return left + 8, top + 110

    def finished(self, job, state=DONE, seconds=120):
        def at_end(now):
            return any(one["id"] == job and one["state"] == state for one in now["exports"])
        now = self.editor.wait(at_end, "the export to end", seconds)
        return next(one for one in now["exports"] if one["id"] == job)

    def by_command_line(self, folder, *arguments):
        subprocess.run([Programs.command_line, "-q", "export", str(self.project), "--out",
                        str(folder), *arguments], check=True, stdout=subprocess.DEVNULL)

    def hashes(self, folder):
        """Hashes of all files of the dataset, without the writer's mark, which depends on the
        run."""
        return {str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
                for path in sorted(folder.rglob("*"))
                if path.is_file() and not path.name.startswith(".")}

    def test_export_what_the_command_line_exports(self):
        self.start_project(*SMALL)
        out = self.folder / "dataset"
        job = self.finished(self.queue(out))
        self.assertEqual(job["frames_done"], 12)
        same = self.folder / "same"
        self.by_command_line(same)
        ours, theirs = self.hashes(out), self.hashes(same)
        self.assertEqual(set(ours), set(theirs))
        differing = [name for name in ours if ours[name] != theirs[name] and
                     name != "dataset.json"]
        self.assertEqual(differing, [])

    def test_a_preset_exports_what_the_command_lines_preset_exports(self):
        self.start_project(*SMALL)
        out = self.folder / "dataset"
        self.name_folder(out)
        self.assertNotIn("export.preset_modified", self.editor.items())
        self.editor.click("export.preset.nerf")
        self.assertNotIn("export.preset_modified", self.editor.items())
        self.press_in_panel("export.add")
        job = self.editor.wait(lambda now: now["exports"], "the job")["exports"][0]
        self.assertEqual(job["frames"], 12, "known before the export reports it")
        self.finished(job["id"])
        self.assertIn(f"export.job.{job['id']}.folder", self.editor.items())
        same = self.folder / "same"
        self.by_command_line(same, "--preset", "nerf")
        self.assertEqual(self.hashes(out), self.hashes(same))
        self.assertTrue((out / "transforms.json").exists())

    def test_find_a_modality_and_add_it_to_a_preset(self):
        self.start_project(*SMALL)
        out = self.folder / "dataset"
        self.name_folder(out)
        self.editor.click("export.preset.detection")
        self.editor.click("export.filter")
        self.editor.type("MILLIMETRES")  # in the descriptions of depth, depth_right, depth_sensor
        shown = {name.split(".")[2] for name in self.editor.items()
                 if name.startswith("export.modality.")}
        self.assertEqual(shown, {"depth", "depth_right", "depth_sensor"})
        self.editor.click("export.modality.depth")
        self.editor.item("export.preset_modified")
        self.editor.click("export.filter")
        self.editor.key("ctrl+a")
        self.editor.key("del")
        self.press_in_panel("export.add")
        job = self.editor.wait(lambda now: now["exports"], "the job")["exports"][0]
        self.finished(job["id"])
        written = json.loads((out / "dataset.json").read_text())
        self.assertEqual(list(written["modalities"]), ["rgb", "depth"])
        self.assertTrue((out / "labels").exists(), "the formats are the preset's")
        self.editor.click("export.preset.detection")
        self.editor.item("export.preset")

    def test_look_at_the_contact_sheet(self):
        self.start_project(*SMALL)
        job = self.queue(self.folder / "dataset")
        self.finished(job)
        self.press_job(job, "sheet")
        self.editor.wait(lambda now: now["dialogs"]["sheet"], "the contact sheet")
        self.editor.item("image.pane")
        self.assertFalse(self.editor.key("esc")["dialogs"]["sheet"])

    def press_job(self, job, what):
        name = f"export.job.{job}.{what}"
        if name not in self.editor.items():
            place = (1000, self.editor.item("tab.timeline")[1] + 110)
            item = self.editor.reach(name, place)
            self.editor.click(((item[0] + item[2]) / 2, (item[1] + item[3]) / 2))
        else:
            self.editor.click(name)

    def test_cancel_an_export_and_continue_it(self):
        self.start_project(*SLOW)
        out = self.folder / "dataset"
        job = self.queue(out)
        self.editor.wait(lambda now: now["exports"][0]["frames_done"] >= 2, "two frames")
        self.press_job(job, "cancel")
        cancelled = self.finished(job, CANCELLED)
        self.assertLess(cancelled["frames_done"], FRAMES)
        self.press_job(job, "resume")
        self.assertEqual(self.finished(job)["frames_done"], FRAMES)
        self.assertEqual(len(list((out / "depth").glob("*.png"))), FRAMES)

    def test_leaving_while_an_export_runs_asks(self):
        self.start_project(*SLOW)
        out = self.folder / "dataset"
        self.queue(out)
        self.editor.wait(lambda now: now["exports"][0]["frames_done"] >= 2, "two frames")
        self.editor.close_window()
        self.editor.wait(lambda now: now["dialogs"]["exports"], "the question")
        self.dismiss("keep_exporting")
        before = self.editor.state()["exports"][0]["frames_done"]
        self.editor.wait(lambda now: now["exports"][0]["frames_done"] > before, "another frame")
        self.ends = True
        self.editor.close_window()
        self.editor.point("message.stop_and_quit")
        self.editor.press()
        self.editor.release()
        self.assertEqual(self.editor.wait_end(), 0)
        self.assertFalse((out / "dataset.json").exists(), "it was stopped")
        self.assertGreaterEqual(len(list((out / "depth").glob("*.png"))), before)
        self.by_command_line(out, "--resume")
        same = self.folder / "same"
        self.by_command_line(same)
        self.assertEqual(self.hashes(out), self.hashes(same))

    def test_an_export_that_a_crash_cut_off_is_offered_again(self):
        self.start_project(*SLOW)
        out = self.folder / "dataset"
        self.queue(out)
        self.editor.wait(lambda now: now["exports"][0]["frames_done"] >= 3, "three frames")
        self.editor.kill()
        self.start()
        now = self.editor.wait(lambda now: now["dialogs"]["found_exports"], "the question")
        self.assertIn("The dataset dataset is not finished", now["asked"])
        self.assertIn(str(out), now["asked"])
        self.dismiss("later")
        job = self.editor.idle()["exports"][0]
        self.assertEqual((job["state"], job["frames"]), (CANCELLED, FRAMES))
        self.editor.kill()
        self.start()
        self.editor.wait(lambda now: now["dialogs"]["found_exports"], "the question again")
        self.dismiss("continue")
        job = self.editor.wait(lambda now: now["exports"], "the queue")["exports"][0]
        self.assertEqual(self.finished(job["id"])["frames_done"], FRAMES)
        same = self.folder / "same"
        self.by_command_line(same)
        self.assertEqual(self.hashes(out), self.hashes(same))
        self.editor.kill()
        self.start()
        self.assertFalse(self.editor.idle()["exports"], "it is done")

    def test_a_mistyped_folder_is_asked_about(self):
        self.start_project(*SMALL)
        out = self.folder / "datsets" / "room"
        self.editor.key("ctrl+e")
        self.editor.click("export.folder")
        self.editor.type(str(out))
        self.editor.key("enter")
        self.press_in_panel("export.add")
        self.editor.wait(lambda now: now["dialogs"]["confirmation"], "the question")
        self.dismiss("cancel")
        self.assertFalse(self.editor.idle()["exports"])
        self.assertFalse(out.parent.exists())
        self.press_in_panel("export.add")
        self.dismiss("create_and_export")
        job = self.editor.wait(lambda now: now["exports"], "the job")["exports"][0]
        self.finished(job["id"])
        self.assertTrue((out / "dataset.json").exists())

    def test_exporting_again_asks_whether_to_replace_the_dataset(self):
        self.start_project(*SMALL)
        out = self.folder / "dataset"
        self.finished(self.queue(out))
        before = self.hashes(out)
        self.press_in_panel("export.add")
        asked = self.editor.wait(lambda now: now["dialogs"]["confirmation"], "the question")["asked"]
        self.assertIn("12 frames, written 20", asked)
        self.dismiss("cancel")
        self.assertEqual(len(self.editor.idle()["exports"]), 1)
        self.press_in_panel("export.add")
        self.dismiss("export_to_dataset2")
        jobs = self.editor.wait(lambda now: len(now["exports"]) == 2, "the job")["exports"]
        added = max(jobs, key=lambda job: job["id"])
        self.assertEqual(added["folder"], str(self.folder / "dataset_2"))
        self.finished(added["id"])
        self.assertEqual(self.hashes(out), before)
        (out / "rgb" / "000000.png").unlink()
        self.name_folder(out)
        self.press_in_panel("export.add")
        self.dismiss("overwrite")
        jobs = self.editor.wait(lambda now: len(now["exports"]) == 3, "the job")["exports"]
        self.finished(max(job["id"] for job in jobs))
        self.assertEqual(self.hashes(out), before)

    def test_a_cancelled_export_is_not_asked_about_again(self):
        self.start_project(*SLOW)
        out = self.folder / "dataset"
        job = self.queue(out)
        self.editor.wait(lambda now: now["exports"][0]["frames_done"] >= 2, "two frames")
        self.press_job(job, "cancel")
        self.finished(job, CANCELLED)
        # The state is written to disk in the background.
        self.editor.wait(lambda _: any('"settled"' in note.read_text() for note
                                       in self.editor.home.rglob("export-*.json")), "the note")
        self.editor.kill()
        self.start()
        now = self.editor.wait(lambda now: now["exports"], "the queue")
        self.assertFalse(now["dialogs"]["found_exports"], now["asked"])
        self.assertFalse(self.editor.idle()["dialogs"]["found_exports"])

    def test_set_the_size_of_the_image_where_one_exports(self):
        self.start_project(*SMALL)
        self.editor.key("ctrl+e")
        self.editor.item("export.width_px")
        self.editor.type_value("export.width_px", "200")
        state = self.editor.idle()
        self.assertEqual(state["parameters"]["camera"]["width_px"], 200)
        self.assertEqual(state["history"][-1], "Set width to 200")
        out = self.folder / "dataset"
        self.finished(self.queue(out))
        picture = cv2.imread(str(next((out / "rgb").glob("*.png"))))
        self.assertEqual(picture.shape[:2], (120, 200))

    def test_choose_a_rig_and_how_pictures_are_made(self):
        self.start_project(*SMALL)
        rig = self.folder / "rig.json"
        rig.write_text(json.dumps({
            "format": "dollytrack-rig", "version": 1, "cameras": [
                {"name": "around", "lens": "equirectangular", "width_px": 64, "height_px": 32}]}))
        out = self.folder / "dataset"
        self.name_folder(out)
        self.press_in_panel("export.antialias")
        self.editor.click("choice.edges")
        state = self.editor.idle()
        self.assertEqual(state["parameters"]["picture"]["antialias"], "edges")
        self.assertEqual(state["history"][-1], "Set antialias to edges")
        self.press_in_panel("export.choose_rig")
        self.editor.choose_file(rig)
        self.press_in_panel("export.add")
        job = self.editor.wait(lambda now: now["exports"], "the job")["exports"][0]
        self.finished(job["id"])
        same = self.folder / "same"
        self.by_command_line(same, "--rig", rig, "--set", "antialias=edges")
        self.assertTrue(list((out / "cameras/around/rgb").glob("*.png")))
        self.assertEqual(self.hashes(out), self.hashes(same))
        plain = self.folder / "plain"
        self.by_command_line(plain)
        self.assertNotEqual(self.hashes(out / "rgb"), self.hashes(plain / "rgb"), "other pictures")

    def test_queue_two_projects(self):
        self.start_project(*SMALL)
        other = self.folder / "other.dolly"
        plan(self.room, other, *SMALL, "--set", "fill=0.4")
        first = self.queue(self.folder / "dataset")
        self.editor.click("export.add_files")
        self.editor.choose_file(other)
        jobs = self.editor.wait(lambda now: len(now["exports"]) == 2, "the second job")["exports"]
        second = jobs[1]["id"]
        for job in (first, second):
            self.assertEqual(self.finished(job)["frames_done"], 12)
        folders = [one["folder"] for one in self.editor.state()["exports"]]
        self.assertEqual(len(set(folders)), 2)
        same = self.folder / "same"
        self.project = other
        self.by_command_line(same)
        ours, theirs = self.hashes(pathlib.Path(folders[1])), self.hashes(same)
        self.assertEqual(set(ours), set(theirs))
        self.assertEqual([name for name in ours if ours[name] != theirs[name] and
                          name != "dataset.json"], [])

    def test_another_project_is_judged_by_its_own_parameters(self):
        self.start_project(*SMALL, "--set", "render_mode=traced", "--set", "traced_samples=2")
        fast = self.folder / "fast.dolly"
        plan(self.room, fast, *SMALL)
        self.name_folder(self.folder / "dataset")
        self.editor.click("export.filter")
        self.editor.type("residual")
        self.editor.click("export.modality.residual")
        self.editor.click("export.add_files")
        self.editor.choose_file(fast)
        self.assertIn("without residual", self.notice())
        self.dismiss("ok")
        jobs = self.editor.wait(lambda now: now["exports"], "the job")["exports"]
        self.finished(jobs[0]["id"])
        written = pathlib.Path(jobs[0]["folder"])
        self.assertTrue((written / "rgb").is_dir())
        self.assertFalse((written / "residual").exists())

    def test_two_exports_do_not_go_into_one_folder(self):
        self.start_project(*SLOW)
        out = self.folder / "dataset"
        job = self.queue(out)
        self.press_in_panel("export.add")
        self.assertEqual(len(self.editor.idle()["exports"]), 1, "the folder is the first one's")
        self.press_job(job, "cancel")
        self.finished(job, CANCELLED)
        self.press_in_panel("export.add")
        self.editor.wait(lambda now: len(now["exports"]) == 2, "the second, in its place")
        self.press_job(job, "resume")
        self.assertIn("in use", self.notice())
        self.dismiss("ok")
        self.assertEqual(self.editor.state()["exports"][0]["state"], CANCELLED)

    def saved_preview(self, modality, frame):
        self.editor.type_value("timeline.frame", str(frame))
        if modality != "rgb":
            self.editor.click("preview.modality")
            self.editor.click("preview.modality." + modality)
        self.editor.wait(lambda now: now["preview"]["frame"] == frame and
                         now["preview"]["final_light"] and not now["busy"]["drawing"],
                         "the preview", 60)
        path = self.folder / f"{modality}.png"
        self.editor.click("preview.save")
        self.editor.choose_file(path)
        for _ in range(100):
            self.editor.state()
            if path.exists():
                break
        return cv2.imread(str(path), cv2.IMREAD_UNCHANGED)

    def exported(self, folder, modality):
        """The image of the dataset's only frame."""
        found = list((folder / modality).glob("*.png"))
        self.assertEqual(len(found), 1, modality)
        return cv2.imread(str(found[0]), cv2.IMREAD_UNCHANGED)

    def test_the_preview_is_what_will_be_exported(self):
        self.start_project(*SMALL)
        out = self.folder / "dataset"
        self.by_command_line(out, "--range", "7:8")
        for modality in ("rgb", "depth", "instance", "semantic"):
            ours = self.saved_preview(modality, 7)
            theirs = self.exported(out, modality)
            self.assertEqual((ours.shape, ours.dtype), (theirs.shape, theirs.dtype), modality)
            apart = numpy.abs(ours.astype(int) - theirs.astype(int)).max()
            self.assertLessEqual(apart, 1 if modality == "rgb" else 0, modality)
            self.assertGreater(len(numpy.unique(ours)), 1, "not an empty picture")

    def test_the_preview_has_the_light_that_is_set(self):
        self.start_project(*SMALL, "--set", "light_preset=night")
        out, neutral = self.folder / "dataset", self.folder / "neutral"
        self.by_command_line(out, "--range", "7:8")
        self.by_command_line(neutral, "--range", "7:8", "--set", "light_preset=neutral")
        ours = self.saved_preview("rgb", 7).astype(int)
        self.assertLessEqual(numpy.abs(ours - self.exported(out, "rgb")).max(), 1)
        self.assertGreater(numpy.abs(ours - self.exported(neutral, "rgb")).mean(), 5)
