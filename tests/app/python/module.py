"""Functions that the tests of the Python module share. Arguments: the program, the folder with the
module."""
import pathlib
import signal
import subprocess
import sys

from support import tiny_room  # noqa: F401
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
