"""Opening scenes and projects, and the messages about their errors."""
import json
import shutil
import subprocess

from pictures import SCENE as APARTMENT
from task import Programs, Task, plan
from support import tiny_room


class Opening(Task):
    def test_open_a_scene_named_on_the_command_line(self):
        state = self.start(self.room)
        self.assertTrue(state["title"].startswith("room.obj"))
        self.assertFalse(state["unsaved"])
        self.assertEqual(state["history"], ["Open"])
        project = plan(self.room, self.folder / "same.dolly")
        self.assertEqual(state["plan"]["frames"], len(project["result"]["trajectory"]["frames"]))

    def test_the_scene_is_shown_before_its_plan(self):
        self.start()
        self.editor.drop(APARTMENT)
        state = self.editor.wait(lambda state: state.get("objects"), "the scene", 60)
        self.assertNotIn("plan", state)
        self.assertTrue(state["busy"]["planning"])
        self.editor.wait(lambda state: state["picture_serial"] > 0, "an image", 60)
        state = self.editor.idle()
        self.assertGreater(state["plan"]["captured"], 0)

    def test_a_scene_opens_whichever_panel_is_shown(self):
        tabs = [item for item in self.start()["items"] if item.startswith("tab.")]
        self.assertGreaterEqual(len(tabs), 6)
        for number, tab in enumerate(tabs):
            scene = self.folder / f"room_{number}.obj"
            shutil.copy(self.room, scene)
            self.editor.click(tab)
            self.editor.drop(scene)
            self.editor.wait(lambda state: state["title"].startswith(scene.name),
                             f"the scene to open while {tab} is shown")
            self.assertEqual(self.editor.idle()["plan"]["objects"], 5, tab)

    def test_edits_of_missing_objects_are_reported_once(self):
        project = self.folder / "room.dolly"
        content = plan(self.room, project)
        content.setdefault("edits", {"version": 1})["removed"] = [
            {"objects": [{"name": name}]} for name in ("first lost", "second lost")]
        project.write_text(json.dumps(content))
        self.start(project)
        self.editor.wait(lambda state: state.get("plan", {}).get("measured"), "the measures")
        self.editor.click("tab.log")
        self.editor.click("log.copy")
        told = [line for line in self.editor.clipboard().splitlines() if "lost" in line]
        self.assertEqual(len(told), 2)
        for line in told:
            self.assertNotIn("times)", line)

    def test_exit_codes_of_arguments(self):
        for arguments, code in [(["--help"], 0), (["--version"], 0), (["--nosuch"], 2),
                                (["--size", "x"], 2)]:
            done = subprocess.run([Programs.editor, *arguments], capture_output=True, text=True)
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertEqual(bool(done.stdout), code == 0)
        with open("/dev/full", "w") as full:
            done = subprocess.run([Programs.editor, "--help"], stdout=full, stderr=subprocess.PIPE)
        self.assertEqual(done.returncode, 6)

    def test_open_a_scene_by_typing_its_path(self):
        state = self.start()
        self.assertFalse(state["open"])
        self.editor.key("ctrl+o")
        self.editor.choose_file(self.room)
        self.editor.wait(lambda state: state["open"], "the room to open")
        self.assertEqual(self.editor.idle()["plan"]["objects"], 5)

    def test_type_a_path_at_once(self):
        self.start()
        self.editor.key("ctrl+o")
        self.editor.item("files.path")
        self.editor.type(str(self.room))
        self.editor.key("enter")
        self.editor.wait(lambda state: state["open"], "the room to open")

    def test_open_a_file_by_walking_through_folders(self):
        self.start()
        self.editor.key("ctrl+o")
        self.editor.item("files.path")
        self.editor.click("files.path")
        self.editor.key("ctrl+a")
        self.editor.type(str(self.room.parent) + "/")
        self.editor.key("enter")
        self.editor.click("files.row.room.obj")
        self.editor.click("files.accept")
        self.editor.wait(lambda state: state["open"], "the room to open")

    def test_drop_a_scene(self):
        self.start()
        self.editor.drop(self.room)
        self.editor.wait(lambda state: state["open"], "the room to open")
        self.assertEqual(self.editor.idle()["plan"]["captured"], 5)

    def test_drop_a_project(self):
        project = self.folder / "small d\u00f6.dolly"  # a name with escaped characters
        plan(self.room, project, "--set", "fill=0.45")
        self.start()
        self.editor.drop(project)
        self.editor.wait(lambda state: state["open"], "the project to open")
        state = self.editor.idle()
        self.assertEqual(state["project"], str(project))
        self.assertEqual(state["parameters"]["viewpoints"]["fill"], 0.45)

    def test_a_scene_of_another_unit_is_read_as_proposed_and_back(self):
        small = self.folder / "small.obj"
        tiny_room.write(small)
        tiny_room.move_corners(small, lambda x, y, z: (0.24 * x, 0.24 * y, 0.24 * z))
        self.start(small)
        self.editor.click("import_doubt.0")
        state = self.editor.wait(lambda state: "import_changed" in state["items"],
                                 "the scene to be read again")
        self.assertGreater(state["import"]["unit_m"], 2.5)
        self.assertTrue(state["unsaved"])
        self.assertEqual(self.editor.idle()["plan"]["captured"], 5)
        self.editor.click("import_changed.0")
        state = self.editor.wait(lambda state: "import_doubt" in state["items"], "the unit before")
        self.assertNotIn("unit_m", state["import"])
        self.editor.click("import_doubt.1")
        state = self.editor.wait(lambda state: "import_doubt" not in state["items"],
                                 "the bar to go")
        # What is kept is part of the project, and the question does not come again.
        self.assertAlmostEqual(state["import"]["unit_m"], 1.0)
        self.assertTrue(state["unsaved"])
        project = self.folder / "kept.dolly"
        self.editor.key("ctrl+s")
        self.editor.item("files.name")
        self.editor.key("ctrl+a")
        self.editor.type(project.name)
        self.editor.key("enter")
        self.editor.wait(lambda state: not state["unsaved"], "the project to be saved")
        # Saving begins in the scene's folder.
        self.assertAlmostEqual(json.loads(project.read_text())["scene"]["import"]["unit_m"], 1.0)
        said = subprocess.run([Programs.command_line, "plan", project], capture_output=True,
                              text=True, check=True)
        self.assertNotIn("unit is doubtful", said.stdout + said.stderr)
        for file in (project, small):
            self.editor.kill()
            self.assertNotIn("import_doubt", self.start(file)["items"])

    def test_a_scene_is_read_in_another_unit_and_with_the_meshes_of_its_file(self):
        self.start_room()
        self.editor.run_command("read the scene in feet")
        state = self.editor.wait(lambda state: "import_changed" in state["items"],
                                 "the scene to be read in feet")
        self.assertAlmostEqual(state["import"]["unit_m"], 0.3048)
        self.editor.click("import_changed.0")
        self.editor.wait(lambda state: "unit_m" not in state["import"], "the unit before")
        self.editor.run_command("keep the file's meshes")
        self.editor.wait(lambda state: state["import"].get("regroup") is False,
                         "the meshes to be kept")
        self.editor.run_command("keep the file's meshes")
        self.editor.wait(lambda state: "regroup" not in state["import"],
                         "the meshes to be regrouped")

    def test_reading_in_another_unit_is_a_step_of_the_history(self):
        self.start_project()
        self.set_parameter("fill", "0.45")
        self.editor.key("ctrl+s")
        self.editor.wait(lambda state: not state["unsaved"], "the project to be saved")
        self.editor.run_command("read the scene in feet")
        self.editor.wait(lambda state: "import_changed" in state["items"],
                         "the scene to be read in feet")
        in_feet = self.editor.idle()
        self.assertEqual(in_feet["history"][-1], "Read the scene in feet")
        self.assertTrue(in_feet["unsaved"])
        self.editor.key("ctrl+z")
        self.editor.wait(lambda state: "unit_m" not in state["import"], "the unit before")
        state = self.editor.idle()
        self.assertEqual(state["history_position"], 1)
        self.assertAlmostEqual(state["parameters"]["viewpoints"]["fill"], 0.45)
        self.assertFalse(state["unsaved"])
        self.assertNotIn("import_changed", state["items"])
        self.editor.key("ctrl+shift+z")
        self.editor.wait(lambda state: "unit_m" in state["import"], "feet again")
        self.assertEqual(self.editor.idle()["plan"], in_feet["plan"])
        # The second step is undone although the scene is still being read for the first.
        self.editor.tap("ctrl+z")
        self.editor.tap("ctrl+z")
        self.editor.wait(lambda state: "unit_m" not in state["import"], "the unit before")
        self.assertEqual(self.editor.idle()["history_position"], 0)
        self.editor.click("tab.history")
        self.editor.click("history.step.2")
        self.editor.wait(lambda state: "unit_m" in state["import"], "feet again")
        self.assertEqual(self.editor.idle()["plan"], in_feet["plan"])

    def test_any_unit_can_be_typed_and_keeping_one_is_undone(self):
        small = self.folder / "small.obj"
        tiny_room.write(small)
        tiny_room.move_corners(small, lambda x, y, z: (0.24 * x, 0.24 * y, 0.24 * z))
        self.start(small)
        self.editor.click("import_doubt.1")
        state = self.editor.wait(lambda state: "import_doubt" not in state["items"],
                                 "the bar to go")
        self.assertTrue(state["history"][-1].startswith("Keep 1 unit = 1 m"))
        self.editor.key("ctrl+z")
        state = self.editor.wait(lambda state: "import_doubt" in state["items"], "the question")
        self.assertNotIn("unit_m", state["import"])
        self.editor.run_command("read the scene in another unit")
        self.editor.item("message.number")
        self.editor.key("ctrl+a")
        self.editor.type("nothing")
        self.assertFalse(self.editor.key("enter")["items"]["message.read"][4], "disabled")
        self.editor.key("ctrl+a")
        self.editor.type("4,2")
        self.editor.key("enter")
        self.editor.wait(lambda state: state["import"].get("unit_m") == 4.2, "the unit")
        self.assertEqual(self.editor.idle()["plan"]["captured"], 5)
        self.editor.run_command("determine the unit from the file")
        self.editor.wait(lambda state: "unit_m" not in state["import"], "the file's unit")

    def test_labels_that_cannot_be_read_change_nothing(self):
        before = self.start_room()
        broken = self.folder / "labels.csv"
        broken.write_text("no labels\n")
        self.editor.run_command("use a label file")
        self.editor.choose_file(broken)
        self.assertIn("labels.csv", self.notice())
        self.dismiss("ok")
        after = self.editor.idle()
        for key in ("history", "import", "plan", "unsaved"):
            self.assertEqual(after[key], before[key], key)

    def test_missing_textures_are_told_until_that_is_hidden_and_do_not_block(self):
        scene = self.folder / "bare.obj"
        tiny_room.write(scene)
        scene.write_text("mtllib bare.mtl\nusemtl bare\n" + scene.read_text())
        scene.with_suffix(".mtl").write_text("newmtl bare\nKd 1 1 1\nmap_Kd nowhere.png\n")
        state = self.start(scene)
        self.assertEqual(state["notice"], "")
        self.assertIn("textures_missing", state["items"])
        self.editor.click("textures_missing.0")
        self.assertIn("nowhere.png", self.notice())
        self.dismiss("ok")
        self.editor.tap("ctrl+q")
        self.editor.wait_end()
        self.assertIn("textures_missing", self.start(scene)["items"])
        state = self.editor.click("textures_missing.1")
        self.assertNotIn("textures_missing", state["items"])
        self.editor.tap("ctrl+q")
        self.editor.wait_end()
        self.assertNotIn("textures_missing", self.start(scene)["items"])

    def test_a_path_is_completed_with_the_keys(self):
        folder = self.folder / "offers"
        for name in ("alpha", "beta"):
            (folder / name).mkdir(parents=True)
            tiny_room.write(folder / name / "room.obj")
        self.start()
        self.editor.key("ctrl+o")
        self.editor.click("files.path", times=2)
        self.editor.key("ctrl+a")
        self.editor.type(f"{folder}/")
        self.editor.item("files.offer.beta/")
        # Esc closes the list only; the text and the dialog stay.
        state = self.editor.key("esc")
        self.assertNotIn("files.offer.beta/", state["items"])
        self.assertTrue(state["dialogs"]["file"])
        for key in ("down", "down", "up", "down"):
            state = self.editor.key(key)
        self.assertIn("files.offer.beta/", state["items"])
        self.editor.key("enter")
        self.editor.item("files.row.room.obj")
        self.editor.type("r")
        self.editor.item("files.offer.room.obj")
        self.editor.key("down")
        self.editor.key("tab")
        self.editor.key("enter")
        self.editor.wait(lambda state: state["open"], "the room to open")
        self.assertEqual(self.editor.idle()["plan"]["objects"], 5)

    def test_a_turned_room_of_one_mesh_is_read_as_the_command_line_proposes(self):
        turned = self.folder / "turned.gltf"
        tiny_room.write_as_one_mesh(turned)
        said = subprocess.run([Programs.command_line, "info", turned], capture_output=True,
                              text=True, check=True)
        self.assertIn("try --up z", said.stdout)
        self.start(turned)
        self.editor.click("import_doubt.0")
        state = self.editor.wait(lambda state: "import_changed" in state["items"],
                                 "the scene to be read again")
        self.assertEqual(state["import"]["up_axis"], "z")
        self.editor.idle()

    def test_a_broken_scene_leaves_the_open_project_as_it_was(self):
        before = self.start_room()
        broken = self.folder / "broken.glb"
        broken.write_bytes(b"glTF" + bytes(range(200)))
        self.editor.drop(broken)
        self.assertIn("broken.glb", self.notice())
        self.dismiss("ok")
        after = self.editor.idle()
        for key in ("title", "history", "parameters", "plan", "unsaved"):
            self.assertEqual(after[key], before[key], key)

    def test_a_broken_project_is_explained(self):
        self.start_room()
        broken = self.folder / "broken.dolly"
        broken.write_text('{"dollytrack_project": 1, "scene": {')
        self.editor.drop(broken)
        self.assertIn("broken.dolly", self.notice())
        self.dismiss("ok")
        self.assertTrue(self.editor.state()["title"].startswith("room.obj"))

    def test_a_project_of_a_newer_version_is_explained(self):
        project = self.folder / "newer.dolly"
        content = plan(self.room, project)
        content["dollytrack_project"] = 99
        project.write_text(json.dumps(content))
        self.start(project)
        self.assertRegex(self.notice(), "newer|99")
        self.dismiss("ok")
        self.assertFalse(self.editor.state()["open"])

    def test_find_the_scene_of_a_project_that_has_moved(self):
        scene = self.folder / "first.obj"
        tiny_room.write(scene)
        project = self.folder / "moved.dolly"
        plan(scene, project, "--set", "fill=0.5")
        moved = self.folder / "second.obj"
        scene.rename(moved)
        self.start(project)
        notice = self.notice()
        self.assertIn(str(scene), notice)
        self.assertNotIn("scene.path", notice, "a field of the file, which nobody sees here")
        self.editor.click("message.find_the_scene")
        self.editor.choose_file(moved)
        self.editor.wait(lambda state: state["open"], "the project to open")
        state = self.editor.idle()
        self.assertEqual(state["project"], str(project))
        self.assertEqual(state["parameters"]["viewpoints"]["fill"], 0.5)
        self.assertEqual(state["plan"]["objects"], 5)
        self.assertTrue(state["unsaved"], "the file still names the old place")
        self.editor.key("ctrl+s")
        self.editor.wait(lambda state: not state["unsaved"], "the project to be saved")
        self.assertIn("second.obj", json.loads(project.read_text())["scene"]["path"])

    def test_open_a_recent_file_from_the_menu(self):
        self.start_room()
        self.editor.menu("file", "file.close")
        self.editor.wait(lambda state: not state["open"], "the room to close")
        self.editor.click("menu.file")
        self.editor.click("recent.0")
        self.editor.wait(lambda state: state["open"], "the room to open again")

    def test_drop_another_scene_while_the_first_is_planned(self):
        other = self.folder / "other.obj"
        tiny_room.write(other)
        self.start(self.room)
        self.set_parameter("octree_resolution_m", "0.02")
        self.editor.drag("parameters.octree_resolution_m",
                         (1200, self.editor.middle("parameters.octree_resolution_m")[1]), steps=2)
        self.editor.drop(other)
        self.dismiss("dont_save")
        self.editor.wait(lambda state: state["title"].startswith("other"), "the other scene")
        state = self.editor.idle()
        self.assertEqual(state["history"], ["Open"])
        self.assertEqual(state["plan"]["objects"], 5)
