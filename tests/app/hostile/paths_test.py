"""Names in scene files that lead out of the scene's folder, observed with strace: the importer
opens only files in that folder. Usage: paths_test.py IMPORT_MANY"""
import json
import os
import pathlib
import re
import shutil
import socket
import subprocess
import sys
import unittest

from support.program import FolderCase, PROGRAM
from support import small_models

SECRET = b"v 9 9 9\nnewmtl secret\nsecret words\n" * 10

class Traced:
    """Files that the importers opened, by scene, counted from the start of their sandbox: before
    that, no scene has any influence."""

    def __init__(self, text):
        self.given = {}
        self.scene_of = {}
        self.paths = {}
        self.network = []
        self.waiting = {}  # calls of threads whose start strace has not reported completely yet
        begun = {}
        for line in text.splitlines():
            head = re.match(r"^(\d+) +(.*)$", line)
            if not head:
                continue
            process, call = head.groups()
            if call.endswith("<unfinished ...>"):
                begun[process] = call.removesuffix("<unfinished ...>")
                continue
            rest = re.match(r"<\.\.\. \w+ resumed>(.*)$", call)
            self._take(process, begun.pop(process, "") + rest.group(1) if rest else call)

    def _take(self, process, call):
        if re.match(r'execve\(".*/dollytrack-import"', call):
            words = re.findall(r'"((?:[^"\\\\]|\\\\.)*)"', call)
            self.given[process] = pathlib.Path(words[6])
            return
        if call.startswith("prctl(PR_SET_NO_NEW_PRIVS") and process in self.given:
            self.scene_of[process] = self.given[process]
            self.paths.setdefault(self.scene_of[process], [])
            return
        scene = self.scene_of.get(process)
        if scene is None:
            if process not in self.given:
                self.waiting.setdefault(process, []).append(call)
            return
        made = re.match(r"clone3?\(.*= (\d+)$", call)
        if made:
            self.scene_of[made.group(1)] = scene
            for earlier in self.waiting.pop(made.group(1), []):
                self._take(made.group(1), earlier)
        if call.startswith(("socket(", "connect(")):
            self.network.append(call)
        done = re.search(r"\) = \d+<(.*)>$", call)
        # O_PATH only serves to look up names: nothing can be read through it.
        if "O_PATH|O_DIRECTORY" in call:
            return
        if call.startswith(("open(", "openat(", "openat2(")) and done:
            self.paths[scene].append(done.group(1))


def can_trace():
    """Whether strace works; containers may forbid it."""
    if shutil.which("strace") is None:
        return False
    tried = subprocess.run(["strace", "-qq", "-o", "/dev/null", "true"], capture_output=True)
    return tried.returncode == 0


@unittest.skipUnless(can_trace(), "strace is not installed, or may not look at other programs")
class Paths(FolderCase):
    def trace(self, scenes, *arguments):
        """Files opened for each scene, and the result of its import."""
        log = self.folder / "trace.txt"
        result = subprocess.run(
            ["strace", "-f", "-y", "-qq", "-s", "4096", "-o", log, "-e",
             "trace=open,openat,openat2,execve,clone,clone3,connect,socket,prctl", PROGRAM, *arguments],
            input="".join(f"{scene}\n" for scene in scenes), capture_output=True, text=True,
            timeout=1200)
        self.assertEqual(result.returncode, 0, result.stderr)
        answers = [json.loads(line) for line in result.stdout.splitlines()]
        return Traced(log.read_text(errors="replace")), dict(zip(scenes, answers))

    def check(self, scenes, reads=()):
        """Each scene opens its own file, the expected files, and nothing outside its folder."""
        traced, answers = self.trace(scenes)
        self.assertEqual(set(traced.paths), set(scenes))
        self.assertEqual(traced.network, [])
        for scene, paths in traced.paths.items():
            root = scene.parent.resolve()
            beneath = [p for p in paths if pathlib.Path(p).is_relative_to(root)]
            outside = [p for p in paths if p not in beneath]
            self.assertEqual(outside, [], scene)
            self.assertTrue(any(p.endswith(scene.name) for p in beneath), (scene, paths))
            for name in reads:
                self.assertTrue(any(p.endswith(name) for p in beneath), (name, beneath))
            self.assertLess(answers[scene]["seconds"], 9)
        return answers

    def new_folder(self, name):
        folder = self.folder / name / "scene"
        folder.mkdir(parents=True)
        for place in (folder.parent / "secret.mtl", folder.parent / "secret.png",
                      folder.parent / "secret.bin"):
            place.write_bytes(SECRET)
        (folder / "room.mtl").write_bytes(small_models.mtl())
        (folder / "oak.png").write_bytes(small_models.png())
        return folder

    def names(self, folder, kind):
        """The same escape attempts for every kind of name in a file."""
        outside = folder.parent / f"secret.{kind}"
        (folder / f"link.{kind}").symlink_to(outside)
        (folder / f"loop.{kind}").symlink_to(f"loop.{kind}")
        (folder / "up").symlink_to("..")
        os.mkfifo(folder / f"pipe.{kind}")
        (folder / f"folder.{kind}").mkdir()
        bound = socket.socket(socket.AF_UNIX)
        here = os.getcwd()
        os.chdir(folder)
        bound.bind(f"sock.{kind}")
        os.chdir(here)
        bound.close()
        return {
            "parent": f"../secret.{kind}", "parents": "../" * 12 + "etc/hostname",
            "absolute": str(outside), "etc": "/etc/hostname", "file": f"file://{outside}",
            "percent": f"%2e%2e%2fsecret.{kind}", "backslash": f"..\\secret.{kind}",
            "drive": f"C:\\secret.{kind}", "inside_out": f"up/secret.{kind}",
            "link": f"link.{kind}", "loop": f"loop.{kind}", "pipe": f"pipe.{kind}",
            "socket": f"sock.{kind}", "zero": "/dev/zero", "memory": "/proc/self/mem",
            "environment": "/proc/self/environ", "folder": f"folder.{kind}",
            "long": "x" * 300 + f".{kind}", "dots": f"./../scene/../secret.{kind}",
            "not_utf8": b"..\xff/secret.".decode("latin-1") + kind}

    def test_the_trace_sees_what_it_should(self):
        folder = self.new_folder("sound")
        (folder / "room.obj").write_bytes(small_models.obj())
        answer = self.check([folder / "room.obj"], ["room.mtl", "oak.png"])[folder / "room.obj"]
        self.assertEqual((answer["triangles"], answer["textures"]), (12, 1))

    def test_the_trace_would_see_more(self):
        # A link that the user gave as the scene leads out of the folder: that file is opened.
        folder = self.new_folder("seen")
        (folder.parent / "real.obj").write_bytes(small_models.obj())
        (folder / "room.obj").symlink_to("../real.obj")
        traced, answers = self.trace([folder / "room.obj"])
        answer = answers[folder / "room.obj"]
        self.assertEqual((answer["triangles"], answer["textures"]), (12, 1))
        self.assertIn(str(folder.parent.resolve() / "real.obj"), traced.paths[folder / "room.obj"])

    def test_material_libraries(self):
        folder = self.new_folder("mtllib")
        scenes = []
        for name, path in self.names(folder, "mtl").items():
            scenes.append(folder / f"{name}.obj")
            scenes[-1].write_bytes(
                small_models.obj().replace(b"room.mtl", path.encode("latin-1")))
        self.assertGreaterEqual(len(scenes), 20)
        self.check(scenes)

    def test_textures(self):
        folder = self.new_folder("textures")
        scenes = []
        for name, path in self.names(folder, "png").items():
            (folder / f"{name}.mtl").write_bytes(
                small_models.mtl().replace(b"oak.png", path.encode("latin-1")))
            scenes.append(folder / f"{name}.obj")
            scenes[-1].write_bytes(
                small_models.obj().replace(b"room.mtl", f"{name}.mtl".encode()))
        for scene, answer in self.check(scenes).items():
            self.assertEqual((answer["triangles"], answer["textures"]), (12, 0), scene)

    def test_buffers(self):
        folder = self.new_folder("buffers")
        scenes = []
        for name, path in self.names(folder, "bin").items():
            document, _ = small_models.gltf_json(path)
            document["buffers"][0]["byteLength"] = 36
            scenes.append(folder / f"{name}.gltf")
            scenes[-1].write_text(json.dumps(document))
        for answer in self.check(scenes).values():
            self.assertIn("message", answer)
            self.assertNotIn("secret words", json.dumps(answer))

    def test_names_in_scenes_made_of_models(self):
        folder = self.new_folder("models")
        small_models.write_beside(folder)
        (folder.parent / "secret.obj").write_bytes(small_models.obj())
        scenes = []
        for name, path in self.names(folder, "obj").items():
            house = json.loads(small_models.front3d())
            house["furniture"][0]["jid"] = path
            house["material"][0]["jid"] = path
            (folder / f"{name}.json").write_text(json.dumps(house))
            layout = path.encode("latin-1")
            (folder / f"{name}.txt").write_bytes(
                small_models.scenenet().replace(b"./office/layout.obj", layout)
                .replace(b"03928116/aaa", b"03928116/" + layout))
            word = layout.decode("latin-1").encode()
            (folder / f"{name}.xml").write_bytes(
                small_models.home_xml().replace(b"room.obj", word).replace(b"oak.png", word))
            scenes += [folder / f"{name}.{kind}" for kind in ("json", "txt", "xml")]
        self.check(scenes)

    def test_folders_of_models_that_are_named(self):
        folder = self.new_folder("library")
        library = folder.parent / "library" / "abc"
        library.mkdir(parents=True)
        (library / "raw_model.obj").write_bytes(small_models.obj())
        (library / "room.mtl").symlink_to("../../secret.mtl")
        house = folder / "house.json"
        house.write_bytes(small_models.front3d())
        traced, answers = self.trace([house], "--models", str(library.parent))
        self.assertEqual(answers[house]["triangles"], 14)
        inside = [folder.resolve(), library.parent.resolve()]
        for path in traced.paths[house]:
            self.assertTrue(any(pathlib.Path(path).is_relative_to(root) for root in inside), path)
        self.assertIn(str(library.resolve() / "raw_model.obj"), traced.paths[house])

    def test_what_was_refused_is_said(self):
        folder = self.new_folder("said")
        (folder / "room.obj").write_bytes(
            small_models.obj().replace(b"room.mtl", b"../secret.mtl"))
        answer = self.check([folder / "room.obj"])[folder / "room.obj"]
        self.assertEqual(answer["triangles"], 12)
        self.assertTrue([n for n in answer["notes"] if "secret.mtl" in n and "not opened" in n],
                        answer)


if __name__ == "__main__":
    unittest.main()
