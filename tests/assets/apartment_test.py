"""Checks the committed apartment by reading the file directly, independently of its generator.

    /usr/bin/python3 tests/assets/apartment_test.py            the file and its answer sheet
    /usr/bin/python3 tests/assets/apartment_test.py --remake   also that the program makes them
"""

import json
import pathlib
import struct
import subprocess
import sys
import unittest

import cv2
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENES = ROOT / "assets" / "scenes"
REMAKE = "--remake" in sys.argv
# Soft or perforated supports: objects on them have no flat contact to measure.
SOFT = {"sofa", "sofa_2", "armchair_2", "bed", "fruit_bowl", "lemon_bowl", "umbrella_stand"}


def read_glb(path):
    """{name: [(positions, normals, triangles) of each material]} in metres, z up."""
    data = path.read_bytes()
    length = struct.unpack("<I", data[12:16])[0]
    document, blob = json.loads(data[20 : 20 + length]), data[28 + length :]

    def accessor(number):
        entry = document["accessors"][number]
        view = document["bufferViews"][entry["bufferView"]]
        kind = {5126: "<f4", 5123: "<u2", 5125: "<u4"}[entry["componentType"]]
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}[entry["type"]]
        start = view["byteOffset"] + entry.get("byteOffset", 0)
        return np.frombuffer(blob, kind, entry["count"] * width, start).reshape(-1, width)

    objects = {}
    for node in document["nodes"]:
        _, s, _, c = node.get("rotation", [0, 0, 0, 1])
        turn = np.array([[1 - 2 * s * s, 0, 2 * s * c], [0, 1, 0], [-2 * s * c, 0, 1 - 2 * s * s]])
        z_up = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])
        objects[node["name"]] = [
            (
                (accessor(p["attributes"]["POSITION"]) @ turn.T + node["translation"]) @ z_up.T,
                accessor(p["attributes"]["NORMAL"]) @ turn.T @ z_up.T,
                accessor(p["indices"]).astype(np.int64).reshape(-1, 3),
            )
            for p in document["meshes"][node["mesh"]]["primitives"]
        ]
    images = [
        blob[v["byteOffset"] : v["byteOffset"] + v["byteLength"]]
        for v in (document["bufferViews"][i["bufferView"]] for i in document["images"])
    ]
    return objects, images


def corners(parts):
    return np.concatenate([p[t] for p, _, t in parts])


def heights_over(triangles, x, y):
    """Heights at which a vertical line through (x, y) hits the triangles."""
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    area = (b[:, 1] - c[:, 1]) * (a[:, 0] - c[:, 0]) + (c[:, 0] - b[:, 0]) * (a[:, 1] - c[:, 1])
    a, b, c, area = (v[np.abs(area) > 1e-12] for v in (a, b, c, area))
    u = ((b[:, 1] - c[:, 1]) * (x - c[:, 0]) + (c[:, 0] - b[:, 0]) * (y - c[:, 1])) / area
    v = ((c[:, 1] - a[:, 1]) * (x - c[:, 0]) + (a[:, 0] - c[:, 0]) * (y - c[:, 1])) / area
    hit = (u > -1e-6) & (v > -1e-6) & (u + v < 1 + 1e-6)
    return (u * a[:, 2] + v * b[:, 2] + (1 - u - v) * c[:, 2])[hit]


class Apartment(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.objects, cls.images = read_glb(SCENES / "apartment.glb")
        sheet = json.loads((SCENES / "apartment.json").read_text())
        cls.sheet = {entry["name"]: entry for entry in sheet["objects"]}

    def test_is_as_rich_and_as_small_as_promised(self):
        targets = [e for e in self.sheet.values() if not e["structure"]]
        self.assertGreaterEqual(len(targets), 60)
        self.assertGreaterEqual(len({e["room"] for e in targets}), 2)
        self.assertLessEqual((SCENES / "apartment.glb").stat().st_size, 5_000_000)

    def test_answer_sheet_agrees_with_the_model(self):
        self.assertEqual(set(self.sheet), set(self.objects))
        for name, parts in self.objects.items():
            points = np.concatenate([p for p, _, _ in parts])
            np.testing.assert_allclose(
                points.min(axis=0), self.sheet[name]["low_m"], atol=2e-4, err_msg=name
            )
            np.testing.assert_allclose(
                points.max(axis=0), self.sheet[name]["high_m"], atol=2e-4, err_msg=name
            )

    def test_triangles_face_outwards(self):
        for name, parts in self.objects.items():
            volume = 0.0
            for positions, normals, triangles in parts:
                p = positions[triangles]
                face = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
                mean = normals[triangles].sum(axis=1)
                against = np.sum(face * mean, axis=1) < 0
                # At the seams of upholstery a normal may point away from its triangle, but not on
                # whole surfaces.
                self.assertLess(
                    np.linalg.norm(face[against], axis=1).sum(),
                    0.02 * np.linalg.norm(face, axis=1).sum(),
                    name,
                )
                centre = positions.mean(axis=0)
                volume += np.einsum("ij,ij->i", p[:, 0] - centre, face).sum() / 6
            self.assertGreater(volume, 0.0, name)

    def test_things_rest_on_what_carries_them(self):
        checked = 0
        for name, entry in self.sheet.items():
            if (
                entry["how"] != "stands"
                or entry["on"] in SOFT
                or name in ("potted_plant_2", "wooden_rack")
            ):
                continue
            own = corners(self.objects[name]).reshape(-1, 3)
            foot = own[:, 2].min()
            low = own[own[:, 2] < foot + 2e-4]
            below = corners(self.objects[entry["on"]])
            nearest = min(
                (
                    abs(h - foot)
                    for p in low[:: max(1, len(low) // 12)]
                    for h in heights_over(below, *(0.98 * p[:2] + 0.02 * low[:, :2].mean(axis=0)))
                ),
                default=np.inf,
            )
            with self.subTest(thing=name, on=entry["on"]):
                self.assertLess(nearest, 0.0011)
            checked += 1
        self.assertGreater(checked, 150)

    def test_pictures_are_readable_and_small(self):
        for image in self.images:
            pixels = cv2.imdecode(np.frombuffer(image, np.uint8), cv2.IMREAD_COLOR)
            self.assertIsNotNone(pixels)
            self.assertLessEqual(max(pixels.shape), 512)

    @unittest.skipUnless(REMAKE, "needs --remake")
    def test_program_makes_these_very_files(self):
        made = subprocess.run(
            [sys.executable, str(SCENES / "make_apartment"), "--check"],
            capture_output=True,
            text=True,
            check=False,
        )
        self.assertEqual(made.returncode, 0, made.stderr)


if __name__ == "__main__":
    unittest.main(argv=[a for a in sys.argv if a != "--remake"])
