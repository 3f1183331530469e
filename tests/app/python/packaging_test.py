"""pip installs the module into a virtual environment without network, and it works there."""
import os
import pathlib
import subprocess
import sys
import unittest
import zipfile

from module import FolderCase, MODULE, ROOT, tiny_room

BUILD = pathlib.Path(MODULE).parent


class PackagingTest(FolderCase):
    def test_pip_installs_and_packs_it_without_network(self):
        tiny_room.write(self.folder / "room.obj")
        environment = {**os.environ, "DOLLYTRACK_BUILD": str(BUILD), "PIP_NO_INDEX": "1",
                       "PIP_DISABLE_PIP_VERSION_CHECK": "1"}
        environment.pop("PYTHONPATH", None)
        python = self.folder / "env" / "bin" / "python"

        def check(*command):
            done = subprocess.run(command, capture_output=True, text=True, env=environment,
                                  cwd=self.folder)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            return done.stdout

        check(sys.executable, "-m", "venv", "--system-site-packages", self.folder / "env")
        check(python, "-m", "pip", "install", "--no-build-isolation", ROOT / "app" / "python")
        out = check(python, "-c", "import dollytrack as dt; print(dt.__file__, "
                                  "len(dt.load('room.obj').plan(max_frames=3)), dt.__version__)")
        self.assertIn(str(self.folder / "env"), out)
        check(python, "-m", "pip", "wheel", "--no-deps", "-w", self.folder, ROOT / "app" / "python")
        wheel, = self.folder.glob("dollytrack-*.whl")
        with zipfile.ZipFile(wheel) as archive:
            self.assertIsNone(archive.testzip())
            names = set(archive.namelist())
        self.assertLessEqual({"dollytrack/__init__.py", "dollytrack/py.typed", "dollytrack/_core.pyi",
                              "dollytrack/dollytrack-import"}, names)
        check(python, "-m", "pip", "uninstall", "-y", "dollytrack")
        check(python, "-m", "pip", "install", "--no-deps", wheel)
        self.assertIn("dollytrack", check(python, "-m", "pip", "show", "-f", "dollytrack"))


if __name__ == "__main__":
    unittest.main()
