"""COLMAP reads our model, and triangulates its own features with our poses."""
import pathlib
import re
import tempfile
import unittest

import exports

MAX_ERROR_PX = 1.0


class Colmap(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        exports.need_program("colmap", "colmap")
        cls.data = exports.walk()
        cls.model = cls.data.folder / "sparse" / "0"

    def analyzed(self, model):
        """The numbers that model_analyzer prints."""
        text = exports.call("colmap", "model_analyzer", "--path", model)
        return {name.strip(): float(value) for name, value in
                re.findall(r"^([A-Z][A-Za-z ]+): *([\d.]+)", text, re.MULTILINE)}

    def test_it_reads_the_model(self):
        found = self.analyzed(self.model)
        self.assertEqual(found["Cameras"], 1)
        self.assertEqual(found["Registered images"], len(self.data.frames))
        self.assertGreater(found["Points"], 1000)

    def test_features_triangulate_to_less_than_a_pixel(self):
        lens = (self.model / "cameras.txt").read_text().splitlines()[-1].split()[4:]
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            database, points = folder / "features.db", folder / "points"
            points.mkdir()
            images = self.data.folder / "rgb"
            exports.call("colmap", "feature_extractor", "--database_path", database,
                         "--image_path", images, "--ImageReader.camera_model", "PINHOLE",
                         "--ImageReader.single_camera", 1, "--ImageReader.camera_params",
                         ",".join(lens), "--SiftExtraction.use_gpu", 0,
                         "--SiftExtraction.max_num_features", 2000)
            exports.call("colmap", "sequential_matcher", "--database_path", database,
                         "--SiftMatching.use_gpu", 0, "--SequentialMatching.overlap", 4)
            exports.call("colmap", "point_triangulator", "--database_path", database,
                         "--image_path", images, "--input_path", self.model, "--output_path",
                         points, "--clear_points", 1)
            found = self.analyzed(points)
        print(f"\nCOLMAP: {found['Points']:.0f} points from {found['Observations']:.0f} features, "
              f"{found['Mean reprojection error']:.2f} px")
        self.assertGreater(found["Points"], 250)
        self.assertGreater(found["Mean track length"], 3)
        self.assertLess(found["Mean reprojection error"], MAX_ERROR_PX)
