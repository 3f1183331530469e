#!/usr/bin/python3
"""Blender files are converted by Blender, which can do no harm. Usage: conversion_test.py PROGRAM

Ends with 77 where Blender is not installed, or the system has no Landlock or seccomp.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from support.program import FolderCase, PROGRAM, run

MAKE_ROOM = """
import bpy
bpy.ops.wm.read_factory_settings(use_empty=True)
def box(name, size, at):
    bpy.ops.mesh.primitive_cube_add(size=1, location=at)
    bpy.context.object.name = name
    bpy.context.object.scale = size
box('floor', (5, 4, 0.1), (0, 0, -0.05))
box('wall_n', (5, 0.1, 2.6), (0, 2, 1.3))
box('wall_s', (5, 0.1, 2.6), (0, -2, 1.3))
box('wall_e', (0.1, 4, 2.6), (2.5, 0, 1.3))
box('wall_w', (0.1, 4, 2.6), (-2.5, 0, 1.3))
box('table', (1.2, 0.8, 0.75), (0.5, 0.5, 0.375))
text = bpy.data.texts.new('run_me.py')
text.write("open({marker!r}, 'w').write('harm')")
text.use_module = True
box('hidden_crate', (0.5, 0.5, 0.5), (-1, -1, 0.25))
bpy.context.object.hide_render = True
image = bpy.data.images.new('carpet', 8, 8)
image.use_fake_user = True
image.source = 'FILE'
image.filepath = '//../elsewhere/carpet.png'
bpy.ops.wm.save_as_mainfile(filepath={path!r})
"""
IMPORTER = str(pathlib.Path(PROGRAM).with_name("dollytrack-import"))


class Conversion(FolderCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.marker = cls.folder / "marker"
        cls.seed = cls.folder / "seed.blend"
        script = MAKE_ROOM.format(marker=str(cls.marker), path=str(cls.seed))
        subprocess.run(["blender", "-b", "--factory-startup", "--python-expr", script],
                       check=True, capture_output=True)
        # The script in the file works where Blender is allowed to run it.
        subprocess.run(["blender", "-b", "--factory-startup", "--enable-autoexec", cls.seed],
                       check=True, capture_output=True)
        assert cls.marker.exists()
        cls.marker.unlink()

    def room(self):
        folder = self.folder / self.id().split(".")[-1]
        folder.mkdir()
        return pathlib.Path(shutil.copy(self.seed, folder / "room.blend"))

    def test_a_room_is_converted_once_and_planned(self):
        scene = self.room()
        result = run("info", scene, "--convert", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        objects = {one["name"]: one for one in json.loads(result.stdout)["objects"]}
        self.assertEqual(set(objects), {"floor", "wall_n", "wall_s", "wall_e", "wall_w", "table"})
        for found, made in zip(objects["table"]["size_m"], (1.2, 0.8, 0.75)):
            self.assertAlmostEqual(found, made, delta=1e-3)
        self.assertEqual(sorted(path.name for path in scene.parent.iterdir()),
                         ["room.blend", "room.blend.glb"])
        self.assertFalse(self.marker.exists(), "a script of the file ran")
        self.assertIn("could not read 1 file of the scene", result.stderr)
        self.assertIn("elsewhere/carpet.png", result.stderr)
        self.assertIn("1 object is hidden in renders and left out: hidden_crate", result.stderr)
        before = (scene.parent / "room.blend.glb").stat().st_mtime_ns
        plan = run("plan", scene, "--convert", "-o", scene.with_suffix(".dolly"), "--max-frames", 4)
        self.assertEqual(plan.returncode, 0, plan.stderr)
        self.assertEqual((scene.parent / "room.blend.glb").stat().st_mtime_ns, before)
        project = json.loads(scene.with_suffix(".dolly").read_text())
        self.assertIn("room.blend.glb", project["scene"]["path"])
        os.utime(scene, ns=(before - 10**9, before - 10**9))
        self.assertEqual(run("info", scene, "--convert").returncode, 0)
        self.assertEqual((scene.parent / "room.blend.glb").stat().st_mtime_ns, before - 10**9)

    def test_a_file_of_the_user_is_not_overwritten(self):
        scene = self.room()
        own = scene.with_name("room.blend.glb")
        own.write_text("mine")
        self.assertFails(run("info", scene, "--convert"), 4, "room.blend.glb", "move it away")
        self.assertEqual(own.read_text(), "mine")

    def test_links_and_capitals(self):
        scene = self.room()
        (scene.parent / "elsewhere").mkdir()
        link = scene.parent / "elsewhere" / "ROOM.BLEND"
        link.symlink_to(scene)
        self.assertEqual(run("info", link, "--convert").returncode, 0)
        self.assertEqual(sorted(path.name for path in link.parent.iterdir()),
                         ["ROOM.BLEND", "ROOM.BLEND.glb"])

    def test_without_the_option_it_is_named(self):
        self.assertFails(run("info", self.room()), 4, "Blender file", "--convert")

    def test_a_damaged_file_leaves_nothing(self):
        for name, data in {"cut": self.seed.read_bytes()[:2000], "text": b"BLENDER, no"}.items():
            folder = self.folder / name
            folder.mkdir()
            (folder / "room.blend").write_bytes(data)
            result = run("info", folder / "room.blend", "--convert")
            self.assertFails(result, 4, "room.blend", "Blender cannot convert it: it cannot read")
            self.assertEqual([path.name for path in folder.iterdir()], ["room.blend"])

    def test_without_blender_the_package_is_named(self):
        result = run("info", self.room(), "--convert", env={**os.environ, "PATH": "/nowhere"})
        self.assertFails(result, 4, "needs Blender", "apt install blender")


class Confinement(FolderCase):
    def confined(self, code):
        """Exit code of a Python program in confinement; see confined_program.h."""
        output, readable = self.folder / "output", self.folder / "readable"
        for folder in (output, readable):
            folder.mkdir(exist_ok=True)
        (readable / "scene").write_text("scene")
        (self.folder / "secret").write_text("secret")
        command = [IMPORTER, "--confine", str(os.getpid()), str(output), str(readable),
                   os.path.realpath("/usr/bin/python3"), "-c", code.format(folder=self.folder)]
        return subprocess.run(command, capture_output=True).returncode

    def test_what_it_needs_is_allowed(self):
        self.assertEqual(self.confined("open('{folder}/readable/scene').read()\n"
                                       "open('{folder}/output/made', 'w').write('made')"), 0)
        self.assertEqual((self.folder / "output" / "made").read_text(), "made")

    def test_everything_else_is_refused(self):
        for code in ["open('{folder}/secret')", "open('{folder}/readable/scene', 'w')",
                     "open('{folder}/new', 'w')", "import socket; socket.socket()",
                     "import os; os.kill(os.getppid(), 0)", "import os; os.listdir('{folder}')",
                     "import os; os.rename('{folder}/output', '{folder}/gone')",
                     "import os; os.chmod('{folder}/secret', 0o777)",
                     "import os; os.setpriority(os.PRIO_PROCESS, os.getppid(), 1)",
                     "import os, resource; resource.prlimit(os.getppid(), resource.RLIMIT_CORE, (0, 0))",
                     "import os; os.truncate('{folder}/secret', 0)",
                     "import os; os.open('{folder}/readable/scene', os.O_RDONLY | os.O_TRUNC)",
                     "import os; os.utime('{folder}/secret')", "import os; os.setsid()",
                     "import os; os.fork()", "import os; open('/proc/%d/cmdline' % os.getppid())"]:
            refused = ("try:\n    " + code + "\nexcept PermissionError:\n    raise SystemExit(42)")
            self.assertEqual(self.confined(refused), 42, code)

    def test_it_has_no_environment_of_the_user(self):
        self.assertEqual(self.confined(
            "import os; raise SystemExit(42 if set(os.environ) <= "
            "{{'PATH', 'LANG', 'LC_CTYPE', 'HOME', 'TMPDIR', 'XDG_RUNTIME_DIR'}} else 1)"), 42)


def can_confine():
    with tempfile.TemporaryDirectory() as folder:
        command = [IMPORTER, "--confine", str(os.getpid()), folder, folder, "/usr/bin/true"]
        return subprocess.run(command).returncode != 123  # ConfinedExit::kCannotConfine


if __name__ == "__main__":
    required = os.environ.get("DOLLYTRACK_REQUIRE_READERS") == "1"
    if not required and not (shutil.which("blender") and can_confine()):
        print("Blender is not installed, or this system cannot confine it", file=sys.stderr)
        sys.exit(77)
    unittest.main()
