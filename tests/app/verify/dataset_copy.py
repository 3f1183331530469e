"""A copy of a dataset that tests may change, file by file."""
import hashlib
import json
import os
import pathlib
import struct

os.environ["OPENCV_IO_ENABLE_OPENEXR"] = "1"
import cv2  # noqa: E402
import numpy as np  # noqa: E402


class Copy:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.card = json.loads((self.folder / "dataset.json").read_text())
        self.mended = True

    def read(self, name):
        return cv2.imread(str(self.folder / name), cv2.IMREAD_UNCHANGED)

    def write(self, name, image):
        assert cv2.imwrite(str(self.folder / name), image), name

    def edit(self, name, function):
        self.write(name, function(self.read(name)))

    def edit_bytes(self, name, function):
        path = self.folder / name
        path.write_bytes(function(bytearray(path.read_bytes())))

    def edit_json(self, name, function):
        path = self.folder / name
        root = json.loads(path.read_text())
        function(root)
        path.write_text(json.dumps(root))

    def edit_rows(self, name, function):
        """Edits the rows of a CSV file as lists of strings; the first row has the column names."""
        path = self.folder / name
        rows = [line.split(",") for line in path.read_text().splitlines()]
        function(rows)
        path.write_text("\n".join(",".join(row) for row in rows) + "\n")

    def edit_lines(self, name, function):
        """Edits the words of each line of a text file."""
        path = self.folder / name
        rows = [line.split(" ") for line in path.read_text().splitlines()]
        function(rows)
        path.write_text("".join(" ".join(row) + "\n" for row in rows))

    def edit_flow(self, name, function):
        """Edits the flow as an array, rows x columns x 2."""
        path = self.folder / name
        data = path.read_bytes()
        width, height = struct.unpack("<ii", data[4:12])
        motions = np.frombuffer(data, "<f4", offset=12).reshape(height, width, 2).copy()
        path.write_bytes(data[:12] + function(motions).astype("<f4").tobytes())

    def swap(self, a, b):
        first, second = (self.folder / a).read_bytes(), (self.folder / b).read_bytes()
        (self.folder / a).write_bytes(second)
        (self.folder / b).write_bytes(first)

    def remove(self, name):
        (self.folder / name).unlink()
        del self.card["files"][name]

    def save(self):
        """Writes dataset.json with correct hashes."""
        if self.mended:
            for name in self.card["files"]:
                data = (self.folder / name).read_bytes()
                self.card["files"][name] = hashlib.sha256(data).hexdigest()
            self.card["trajectory_sha256"] = trajectory_hash(self.card)
        (self.folder / "dataset.json").write_text(json.dumps(self.card))


def trajectory_hash(card):
    text = json.dumps(card["frames"], separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()
