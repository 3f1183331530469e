"""A separate display for a window, or the reason why there is none."""
import ctypes
import os
import shutil
import signal
import subprocess
import sys
import unittest

try:
    from Xlib import display
except ImportError:  # the tests are then skipped, or fail where a window is required
    display = None

REQUIRED = os.environ.get("DOLLYTRACK_REQUIRE_WINDOW") == "1"


def die_with_parent():
    """Called in the child process, so that a killed test leaves nothing running."""
    pr_set_pdeathsig = 1
    ctypes.CDLL(None).prctl(pr_set_pdeathsig, signal.SIGKILL)


def why_no_window():
    """The reason why no window can be opened; empty if one can."""
    if display is None:
        return "python3-xlib is not installed"
    if shutil.which("Xvfb") is None:
        return "Xvfb is not installed"
    return ""


def need_window():
    """Skips where no window can be opened, and says so; fails where one is required."""
    why = why_no_window()
    if why and REQUIRED:
        sys.exit(f"a window is required, but {why}")
    if why:
        print("skipped: " + why)
        raise unittest.SkipTest(why)


class Screen:
    """A separate display."""

    def __init__(self, width=1920, height=1080):
        read, write = os.pipe()
        self.process = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", f"{width}x{height}x24",
             "-nolisten", "tcp", "-noreset"],
            pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            preexec_fn=die_with_parent)
        os.close(write)
        with os.fdopen(read) as numbers:
            number = numbers.readline().strip()
        if not number:
            raise RuntimeError("Xvfb did not start")
        self.name = ":" + number
        self.size = (width, height)

    def close(self):
        self.process.terminate()
        self.process.wait()
