"""Scenes of data sets with the whole program: the folders of models and annotations are
remembered."""
import json
import pathlib
import unittest

from support import program, tiny_room


def house(valid=True):
    """A 3D-FRONT house of one room with a box for furniture, 4 x 2.6 x 3 m."""
    def quad(kind, number, corners):
        return {"uid": f"{kind}/{number}", "jid": "", "type": kind, "material": "",
                "xyz": [x for corner in corners for x in corner], "normal": [], "uv": [],
                "faces": [0, 1, 2, 0, 2, 3]}
    a, b, c, d = (0, 0, 0), (4, 0, 0), (4, 0, 3), (0, 0, 3)
    e, f, g, h = (0, 2.6, 0), (4, 2.6, 0), (4, 2.6, 3), (0, 2.6, 3)
    return {
        "uid": "house",
        "furniture": [{"uid": "1/model", "jid": "abc", "category": "Dining Table",
                       "valid": valid}],
        "mesh": [quad("Floor", 0, (a, d, c, b)), quad("Ceiling", 0, (e, f, g, h)),
                 quad("WallInner", 0, (a, b, f, e)), quad("WallInner1", 0, (b, c, g, f)),
                 quad("WallInner2", 0, (c, d, h, g)), quad("WallInner3", 0, (d, a, e, h))],
        "material": [],
        "scene": {"room": [{"type": "DiningRoom", "instanceid": "DiningRoom-1", "children": [
            {"ref": "1/model", "pos": [2, 0, 1.5], "rot": [0, 0, 0, 1], "scale": [1, 1, 1]}]}]},
    }


class DatasetsTest(program.FolderCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        models = cls.folder / "library" / "abc"
        models.mkdir(parents=True)
        tiny_room.write_boxes(models / "raw_model.obj", [("t", (-0.5, 0, -0.4), (0.5, 0.7, 0.4))])
        (cls.folder / "houses").mkdir()
        cls.house = cls.folder / "houses" / "house.json"
        cls.house.write_text(json.dumps(house()))
        (cls.folder / "houses" / "notes.json").write_text('{"milk": 2}')

    def objects(self, *arguments):
        result = program.run("info", *arguments, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        return {one["name"]: one for one in json.loads(result.stdout)["objects"]}

    def test_a_project_keeps_the_folder_of_models(self):
        self.assertNotIn("Dining Table", self.objects(self.house))
        table = self.objects(self.house, "--models", self.folder / "library")["Dining Table"]
        self.assertEqual(table["class"], "table")
        self.assertEqual(table["center_m"], [2, -1.5, 0.35])
        self.assertEqual(table["front"], [0, -1, 0])
        project = self.folder / "house.dolly"
        result = program.run("plan", self.house, "--models", self.folder / "library",
                             "-o", project, "--max-frames", "20")
        self.assertIn(result.returncode, (0, 3), result.stderr)
        said = json.loads(project.read_text())["scene"]["import"]
        self.assertEqual(said, {"model_folders": [str(self.folder / "library")]})
        self.assertIn("Dining Table", self.objects(project))

    def test_a_folder_that_is_not_there_is_a_slip(self):
        result = program.run("info", self.house, "--models", self.folder / "nowhere")
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn("nowhere", result.stderr)

    def test_batches_pick_houses_and_hand_the_models_on(self):
        jobs = self.folder / "jobs.toml"
        jobs.write_text('out = "made"\nscenes = ["houses/*"]\n[import]\nmodels = "library"\n')
        result = program.run("batch", jobs, "--dry-run")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("house", result.stdout)
        self.assertNotIn("notes", result.stdout)
        jobs.write_text('out = "made"\nscenes = ["houses/*"]\n[import]\nmodels = ["nowhere"]\n')
        self.assertFails(program.run("batch", jobs, "--dry-run"), 4, "jobs.toml:4", "nowhere")

    def test_a_folder_is_refused_with_the_scenes_in_it(self):
        folder = self.folder / "house_of_files"
        (folder / "rooms" / "a").mkdir(parents=True)
        self.assertFails(program.run("info", folder), 4, "folder without a scene file", ".glb")
        for name in ("rooms/a/kitchen.glb", "rooms/bath.obj", "readme.txt"):
            (folder / name).write_bytes(b"")
        result = program.run("info", folder)
        self.assertFails(result, 4, "scene file inside it: rooms/bath.obj, rooms/a/kitchen.glb")
        self.assertNotIn("readme", result.stderr)

    def test_hypersim_without_geometry_says_what_is_there(self):
        detail = self.folder / "ai_001_001" / "_detail" / "mesh"
        detail.mkdir(parents=True)
        (detail / "metadata_objects.csv").write_text("object_name\nbed\n")
        self.assertFails(program.run("info", self.folder / "ai_001_001"), 2, "Hypersim",
                         "mesh_objects_si.hdf5")


if __name__ == "__main__":
    unittest.main()
