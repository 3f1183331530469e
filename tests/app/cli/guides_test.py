#!/usr/bin/python3
"""The command blocks of README.md and of the guides work as they are printed.

    guides_test.py PROGRAM [PYTHON_MODULE_FOLDER] [-v]

Every block runs in a folder that holds what the text assumes: a room, its project, a dataset of it,
a trajectory, a jobs file. Exports are small (see Guides.write_program); a block that needs other
people's data, programs or the network is only checked for subcommands and options that exist.
"""
import json
import os
import pathlib
import re
import shlex
import shutil
import struct
import subprocess
import sys
import unittest

from support.program import PROGRAM, FolderCase, run

SOURCE = pathlib.Path(__file__).resolve().parents[3]
MODULE = sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else ""
LIBRARY = pathlib.Path("/usr/share/sweethome3d/furniture")
SUBCOMMANDS = ["info", "plan", "edit", "repair", "export", "verify", "view", "statistics",
               "evaluate", "compare", "sweep", "batch", "gather", "generate", "params"]
# Parts of commands that cannot run in a test.
ELSEWHERE = ["3D-FRONT/", "scenes/0/", "ai_001_001", "replica_cad", "worlds/", "/opt/", "apt install",
             "/usr/share/", "app/demo", "app/setup", "app/package", "editor", "generate --rooms 20"]
BOXES = {
    "floor": ((0, -0.1, 0), (5, 0, 4)), "ceiling": ((0, 2.6, 0), (5, 2.7, 4)),
    "wall_1": ((-0.1, 0, 0), (0, 2.6, 4)), "wall_2": ((5, 0, 0), (5.1, 2.6, 4)),
    "wall_3": ((0, 0, -0.1), (5, 2.6, 0)), "wall_4": ((0, 0, 4), (5, 2.6, 4.1)),
    "table": ((3.6, 0, 1.4), (4.4, 0.74, 2.8)), "lamp_3": ((3.9, 0.74, 1.9), (4.1, 1.2, 2.1)),
    "books": ((4.0, 0.74, 2.4), (4.25, 0.8, 2.6)), "sofa": ((0.1, 0, 1), (0.9, 0.7, 2.8)),
    "chair": ((2.0, 0, 2.0), (2.45, 0.85, 2.45)), "crate": ((0.2, 0, 3.3), (0.7, 0.5, 3.8)),
}


def write_glb(path):
    """A room of boxes, one node each, as binary glTF."""
    data, views, accessors, meshes, nodes = b"", [], [], [], []
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    indices = [i for a, b, c, d in faces for i in (a, b, c, a, c, d)]
    for name, (low, high) in BOXES.items():
        corners = [(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1])
                   for z in (low[2], high[2])]
        for values, kind, form, shape in (([v for c in corners for v in c], 5126, "f", "VEC3"),
                                          (indices, 5123, "H", "SCALAR")):
            part = struct.pack(f"<{len(values)}{form}", *values)
            views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(part)})
            accessor = {"bufferView": len(views) - 1, "componentType": kind, "type": shape,
                        "count": len(values) // (3 if shape == "VEC3" else 1)}
            if shape == "VEC3":
                accessor.update(min=list(low), max=list(high))
            accessors.append(accessor)
            data += part
        last = len(accessors) - 1
        meshes.append({"primitives": [{"attributes": {"POSITION": last - 1}, "indices": last}]})
        nodes.append({"name": name, "mesh": len(meshes) - 1})
    text = json.dumps({"asset": {"version": "2.0"}, "scene": 0, "buffers": [{"byteLength": len(data)}],
                       "scenes": [{"nodes": list(range(len(nodes)))}], "nodes": nodes,
                       "meshes": meshes, "accessors": accessors, "bufferViews": views}).encode()
    text += b" " * (-len(text) % 4)
    path.write_bytes(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(data)) +
                     struct.pack("<I4s", len(text), b"JSON") + text +
                     struct.pack("<I4s", len(data), b"BIN\0") + data)


def blocks_of(file):
    """(line, language, text) of every fenced block."""
    text = file.read_text()
    return [(text.count("\n", 0, match.start()) + 1, match[1], match[2])
            for match in re.finditer(r"^```(\w*)\n(.*?)^```$", text, re.M | re.S)]


class Guides(FolderCase):
    keeps_cache = True

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.tools = cls.folder / "tools"
        cls.tools.mkdir()
        cls.write_program(cls.tools / "dollytrack")
        cls.room = cls.folder / "template"
        cls.room.mkdir()
        write_glb(cls.room / "room.glb")
        small = ["--set", "width_px=64", "--set", "height_px=48", "--max-frames", "6"]
        for arguments in (
                ["plan", cls.room / "room.glb", "-o", cls.room / "room.dolly"],
                ["export", cls.room / "room.dolly", "--out", cls.room / "dataset", *small,
                 "--formats", "coco,camera_json,frames,tum", "--modalities", "rgb,depth,instance"]):
            done = run("-q", *arguments)
            assert done.returncode == 0, done.stderr
        (cls.room / "assets").symlink_to(SOURCE / "assets")
        poses = next((cls.room / "dataset").glob("*.tum"), None) or \
            next(p for p in (cls.room / "dataset").glob("*.txt") if "groundtruth" in p.name)
        for name in ("poses.txt", "CameraTrajectory.txt"):
            shutil.copy(poses, cls.room / name)
        (cls.room / "map.ply").write_text(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
            "property float z\nend_header\n0 0 1\n0.1 0 1\n0 0.1 1\n")

    @staticmethod
    def write_program(path):
        """`dollytrack` as the blocks call it; exports and comparisons with few small frames."""
        path.write_text(f"""#!/usr/bin/python3
import os, re, sys
words = sys.argv[1:]
command = next((word for word in words if not word.startswith("-")), "")
if command in ("export", "compare"):
    for i, word in enumerate(words[:-1]):
        if word == "--max-frames":
            words[i + 1] = "6"
    if "--max-frames" not in words:
        words += ["--max-frames", "6"]
if command == "export" and not any(word.startswith("width_px") for word in words):
    words += ["--set", "width_px=64", "--set", "height_px=48"]
if command == "compare" and "--outcomes" in words:
    words += ["--resolution", "64x48"]
os.execv({PROGRAM!r}, [{PROGRAM!r}, *words])
""")
        path.chmod(0o755)

    def folder_for(self, guide):
        folder = self.folder / guide.stem
        shutil.copytree(self.room, folder, symlinks=True)
        return folder

    def environment(self):
        return dict(os.environ, PATH=f"{self.tools}:{os.environ['PATH']}", PYTHONPATH=MODULE)

    def check_options(self, text, where):
        """The commands have subcommands and options that exist."""
        text = text.replace("\\\n", " ")
        commands = re.findall(r"\bdollytrack ([a-z]+)([^\n#]*)", text)
        for subcommand, rest in commands:
            self.assertIn(subcommand, SUBCOMMANDS, where)
            known = run(subcommand, "--help").stdout
            try:
                words = shlex.split(rest)
            except ValueError:
                words = rest.split()
            for word in words:
                if re.fullmatch(r"--[a-z][a-z-]*", word):
                    self.assertRegex(known, rf"{word}\b", f"{where}: {subcommand}")

    def run_block(self, language, text, folder, where):
        if language in ("sh", "bash"):
            lines = text.replace("\\\n", "\0").splitlines()
            here = [line for line in lines if not any(word in line for word in ELSEWHERE)]
            self.check_options(text, where)
            text = "\n".join(here).replace("\0", "\\\n")
            command = ["bash", "-e", "-c", text]
        elif language == "python":
            command = ["/usr/bin/python3", "-B", "-c", text]
        else:
            return
        done = subprocess.run(command, cwd=folder, env=self.environment(), capture_output=True,
                              text=True, timeout=600, check=False)
        self.assertEqual(done.returncode, 0, f"{where}:\n{text}\n{done.stdout}\n{done.stderr}")

    def check(self, guide, text_of=lambda text: text, without=()):
        folder = self.folder_for(guide)
        for name in without:
            shutil.rmtree(folder / name)
        blocks = blocks_of(guide)
        self.assertTrue(blocks)
        for line, language, text in blocks:
            with self.subTest(guide=guide.name, line=line):
                self.run_block(language, text_of(text), folder, f"{guide.name}:{line}")

    def guide(self, name):
        return SOURCE / "app" / "guides" / f"{name}.md"

    def test_readme(self):
        # The room's own project and dataset come from the commands.
        guide = SOURCE / "README.md"
        folder = self.folder_for(guide)
        (folder / "room.dolly").unlink()
        shutil.rmtree(folder / "dataset")
        for line, language, text in blocks_of(guide):
            with self.subTest(line=line):
                text = text.replace('export PATH="$PWD/build/headless/bin:$PATH"\n', "")
                self.run_block(language, text, folder, f"README.md:{line}")
        self.assertTrue((folder / "dataset.html").is_file())
        self.assertTrue((folder / "room.png").is_file())

    def test_batches(self):
        guide = self.guide("batches")
        folder = self.folder_for(guide)
        (folder / "rooms" / "old").mkdir(parents=True)
        shutil.copy(folder / "room.glb", folder / "rooms" / "kitchen.glb")
        shutil.copy(folder / "room.dolly", folder / "office.dolly")
        jobs = next(text for _, language, text in blocks_of(guide) if language == "toml")
        self.assertIn("max_frames = 300", jobs)
        jobs = jobs.replace("max_frames = 300", "max_frames = 4").replace("seeds = [1, 2, 3]", "seeds = [1]")
        jobs = jobs.replace("fill = 0.5 }", "fill = 0.5, width_px = 64, height_px = 48 }")
        jobs = re.sub(r"^require = .*\n", "", jobs, flags=re.M)  # four frames cannot meet them
        (folder / "rooms.toml").write_text(jobs)
        for line, language, text in blocks_of(guide):
            self.run_block(language, text, folder, f"batches.md:{line}")
        self.assertEqual(len(list((folder / "datasets").rglob("dataset.json"))), 4)

    def test_cameras(self):
        guide = self.guide("cameras")
        folder = self.folder_for(guide)
        rigs = [text for _, language, text in blocks_of(guide) if language == "json"]
        self.assertEqual(len(rigs), 2)
        for i, rig in enumerate(rigs):
            (folder / "rig.json").write_text(rig.replace("2048", "128").replace("1024", "64"))
            self.run_block("sh", f"dollytrack export room.dolly --out rig{i} --rig rig.json", folder,
                           f"cameras.md, rig {i + 1}")

    @unittest.skipUnless(LIBRARY.is_dir(), "Debian's sweethome3d-furniture is not installed")
    def test_datasets(self):
        guide = self.guide("datasets")
        self.check(guide, without=["dataset"])  # the first command makes it
        classes = next(text for _, language, text in blocks_of(guide)
                       if language == "json" and '"matches"' in text)
        folder = self.folder / "datasets"
        (folder / "classes.json").write_text(classes)
        listed = run("info", folder / "room.glb", "--labels", folder / "classes.json")
        self.assertRegex(listed.stdout, r"sofa +seat")

    def test_inputs(self):
        guide = self.guide("inputs")
        self.check(guide)
        annotations = next(text for _, language, text in blocks_of(guide)
                           if language == "json" and "dollytrack-objects" in text)
        schema = json.loads((SOURCE / "assets/schemas/objects.schema.json").read_text())
        self.assertLessEqual(set(json.loads(annotations)), set(schema["properties"]))

    def test_other_guides(self):
        for name in ("install", "light", "planners", "planning", "sensors", "verify"):
            self.check(self.guide(name))

    @unittest.skipUnless(MODULE, "the Python module is not built")
    def test_python(self):
        try:
            import torch  # noqa: F401
        except ImportError:
            self.skipTest("PyTorch is not installed")
        self.check(self.guide("python"), lambda text: text.replace(
            "plan(max_frames=300)", "plan(max_frames=8, width_px=64, height_px=48)").replace(
                'f"{room}.glb"', '"room.glb"'), ["dataset"])


if __name__ == "__main__":
    unittest.main()
