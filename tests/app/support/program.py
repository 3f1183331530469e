"""Functions that the tests of the whole program share."""
import hashlib
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import unittest.mock

PROGRAM = sys.argv.pop(1)
# Tests do not share a cache, and the user's cache stays unchanged.
NO_CACHE = "DOLLYTRACK_NO_CACHE"
os.environ[NO_CACHE] = "1"


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, **options)


def start(*arguments):
    return subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True)


def wait_for(condition, seconds=120):
    """Waits until the condition holds; returns False when it does not in time."""
    deadline = time.time() + seconds
    while time.time() < deadline:
        if condition():
            return True
        time.sleep(0.005)
    return False


def hold(process):
    """Stops a running process, with all its threads, until SIGCONT."""
    process.send_signal(signal.SIGSTOP)
    os.waitid(os.P_PID, process.pid, os.WSTOPPED | os.WEXITED | os.WNOWAIT)


def lines_in(file):
    """Number of lines in the file so far; 0 if the file does not exist."""
    try:
        return file.read_bytes().count(b"\n")
    except FileNotFoundError:
        return 0


def hashes(folder):
    """Relative path -> SHA-256 of every file below a folder."""
    return {
        str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(pathlib.Path(folder).rglob("*"))
        if path.is_file()
    }


class FolderCase(unittest.TestCase):
    """Tests with a temporary folder that all tests of a class share."""

    # Whether imported geometry and baked light are cached for the class's other runs, as for users.
    # For tests that stop exports: without the cache they would mostly stop during baking.
    keeps_cache = False

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        if cls.keeps_cache:
            kept = {name: value for name, value in os.environ.items() if name != NO_CACHE}
            kept["XDG_CACHE_HOME"] = str(cls.folder / "cache")
            environment = unittest.mock.patch.dict(os.environ, kept, clear=True)
            environment.start()
            cls.addClassCleanup(environment.stop)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def assertFails(self, result, code, *words):
        """Checks that the run failed, and that its last line is one sentence that contains the
        words."""
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertEqual(result.stdout, "")
        message = result.stderr.strip().splitlines()[-1]
        for word in words:
            self.assertIn(word, message)
