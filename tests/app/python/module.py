"""Functions that the tests of the Python module share. Arguments: the program, the folder with the
module."""
import pathlib
import signal
import subprocess
import sys

from support import tiny_room
from support.program import FolderCase, PROGRAM, hashes, run  # noqa: F401

ROOT = pathlib.Path(__file__).resolve().parents[3]
MODULE = sys.argv.pop(1)
sys.path.insert(0, MODULE)
import dollytrack as dt  # noqa: E402,F401

SIZE = {"width_px": 64, "height_px": 48}
SET = [word for name, value in SIZE.items() for word in ("--set", f"{name}={value}")]


def start_python(code, *arguments, **options):
    """Starts another interpreter that runs the code, with the module on its path."""
    prelude = f"import sys; sys.path.insert(0, {MODULE!r})\n"
    return subprocess.Popen([sys.executable, "-c", prelude + code, *map(str, arguments)],
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)


def interrupt_when(process, line):
    """Sends Ctrl-C when it has printed the line; returns its further output and its exit code."""
    for printed in process.stdout:
        if printed.strip() == line:
            process.send_signal(signal.SIGINT)
            break
    out, errors = process.communicate(timeout=300)
    return out, errors, process.returncode


class RoomCase(FolderCase):
    """Tests with a small room, loaded and planned."""
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.room = cls.folder / "room.obj"
        tiny_room.write(cls.room)
        cls.scene = dt.load(cls.room)
        cls.plan = cls.scene.plan(max_frames=8, **SIZE)

    def assertSameFiles(self, one, other):
        ours, theirs = hashes(one), hashes(other)
        self.assertGreater(len(ours), 10)
        self.assertEqual(sorted(ours), sorted(theirs))
        self.assertEqual([name for name in ours if ours[name] != theirs[name]], [])
