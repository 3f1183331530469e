"""The datasets that the tests of `gather` share, and checks of every gathered folder."""
import hashlib
import json
import os
import pathlib
import shutil
import subprocess
import tempfile

import numpy as np

from support import tiny_room
from support.program import FolderCase, hashes, run


SIZE = ["--set", "width_px=160", "--set", "height_px=120"]
PARTS = ["train", "val", "test"]


def sums_of(folder):
    """SHA256SUMS as a dict of hashes by name."""
    return {line[66:]: line[:64] for line in (folder / "SHA256SUMS").read_text().splitlines()}


def mask_of(segmentation):
    """The pixels of COCO's compressed run lengths, decoded by their specification."""
    counts, value, shift = [], 0, 0
    for char in segmentation["counts"].encode():
        bits = char - 48
        value |= (bits & 31) << shift
        shift += 5
        if bits & 32:
            continue
        if bits & 16:
            value -= 1 << shift
        counts.append(value + counts[-2] if len(counts) > 2 else value)
        value, shift = 0, 0
    height, width = segmentation["size"]
    pixels = np.repeat(np.arange(len(counts)) % 2, counts)
    return pixels.reshape(width, height).T


def rotation(xyzw):
    """The matrix of a quaternion."""
    x, y, z, w = xyzw
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


class GatherCase(FolderCase):
    """Datasets of six scenes; a seventh dataset is of the first scene, too."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.datasets = cls.folder / "datasets"
        for number in range(2):
            scene = cls.folder / f"room_{number}.obj"
            tiny_room.write(scene)
            if number:
                tiny_room.move_corners(scene, lambda x, y, z: (1.1 * x, y, z))
            made = run("-q", "plan", scene, "-o", cls.folder / f"{number}.dolly", "--max-frames", 6,
                       *SIZE)
            assert made.returncode == 0, made.stderr
            cls.export(cls.folder / f"{number}.dolly", cls.datasets / f"room_{number}")
        cls.export(cls.folder / "0.dolly", cls.datasets / "again" / "dataset", "--range", "0:3")
        # Other hashes make them datasets of other scenes.
        for number in range(2, 6):
            cls.copy_as(cls.datasets / "room_1", cls.datasets / f"room_{number}", number)

    @classmethod
    def export(cls, project, out, *arguments):
        made = run("-q", "export", project, "--out", out, *arguments)
        assert made.returncode == 0, made.stderr

    @staticmethod
    def copy_as(dataset, copy, number, copy_file=shutil.copy2):
        """A copy of the dataset with the hashes of another scene."""
        shutil.copytree(dataset, copy, copy_function=copy_file)
        card = json.loads((copy / "dataset.json").read_text())
        (copy / "dataset.json").unlink()
        for name in ("sha256", "geometry_sha256"):
            card["scene"][name] = hashlib.sha256(b"%d" % number).hexdigest()
        (copy / "dataset.json").write_text(json.dumps(card))

    def new_folder(self):
        return pathlib.Path(tempfile.mkdtemp(dir=self.folder)) / "published"

    def gather(self, *arguments, out=None, datasets=None):
        """Runs gather; returns the output folder."""
        out = out or self.new_folder()
        done = run("-q", "gather", *(datasets or [self.datasets]), "--out", out, *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([path for path in out.rglob("*") if path.is_symlink()], [])
        self.assertEqual(list(out.glob(".*")), [])
        checked = subprocess.run(["sha256sum", "-c", "--quiet", "SHA256SUMS"], cwd=out)
        self.assertEqual(checked.returncode, 0)
        listed = set(sums_of(out)) | {"SHA256SUMS", "gather.json"}
        self.assertEqual(set(hashes(out)), listed)
        return out

    def card(self, out):
        return json.loads((out / "gather.json").read_text())

    def frames(self):
        """(name, dataset, index) of each frame; the name is the one in the gathered dataset."""
        for name in ["again", *(f"room_{i}" for i in range(6))]:
            folder = self.datasets / name
            folder = folder / "dataset" if name == "again" else folder
            for picture in sorted((folder / "rgb").iterdir()):
                yield f"{name}_{picture.stem}", folder, int(picture.stem)

    @staticmethod
    def boxes_of(folder, index):
        """Category, box and object of annotations.json."""
        rows = json.loads((folder / "annotations.json").read_text())["annotations"]
        return [(row["category_id"], row["bbox"], row["object_id"]) for row in rows
                if row["image_id"] == index + 1]

    def many(self):
        """Many frames, as hard links to a dataset's files, so that gathering can be interrupted."""
        around = self.folder / "many"
        for number in range(0 if around.exists() else 100):
            self.copy_as(self.datasets / "room_1", around / f"copy_{number}", 100 + number, os.link)
        return around

    @staticmethod
    def replace_listed(dataset, name, content):
        """Replaces a file of a dataset and its hash in dataset.json."""
        (dataset / name).write_bytes(content)
        card = json.loads((dataset / "dataset.json").read_text())
        card["files"][name] = hashlib.sha256(content).hexdigest()
        (dataset / "dataset.json").write_text(json.dumps(card))

    def damaged(self, damage):
        """Two datasets, the second of them damaged."""
        around = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
        for name in ["good", "bad"]:
            shutil.copytree(self.datasets / ("room_0" if name == "good" else "room_1"),
                            around / name)
        damage(around / "bad")
        return around
