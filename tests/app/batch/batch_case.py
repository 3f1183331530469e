"""A folder with tiny rooms and a jobs file, for tests of batches."""
import json
import os
import pathlib
import shutil
import signal
import tempfile

from processes import alive, jobs_of, state
from support import tiny_room
from support.program import FolderCase, start, wait_for

SMALL = "set = { width_px = 64, height_px = 48 }"


class BatchCase(FolderCase):
    def setUp(self):
        self.place = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
        self.out = self.place / "out"

    def rooms(self, *names):
        (self.place / "rooms").mkdir(exist_ok=True)
        for name in names:
            tiny_room.write(self.place / "rooms" / name)

    def jobs(self, text, export="[export]\nmax_frames = 6\n", sets=SMALL, head=""):
        file = self.place / "jobs.toml"
        file.write_text(f'out = "out"\n{head}\n{text}\n[[set]]\nname = "small"\n{sets}\n{export}')
        return file

    def summary(self, folder=None):
        jobs = json.loads(((folder or self.out) / "summary.json").read_text())["jobs"]
        return {job["name"]: job for job in jobs}

    def verdicts(self):
        return {name: job["verdict"] for name, job in self.summary().items()}

    def start_and_stop_a_job(self, *arguments):
        """Starts a batch and stops one of its jobs (SIGSTOP) before that has ended. Returns the
        batch's process, and the job's process id."""
        while True:
            process = start("batch", *arguments)
            found = []
            self.assertTrue(wait_for(lambda: process.poll() is not None
                                     or found.extend(jobs_of(process.pid)) or found))
            if found and alive(found[0]):
                os.kill(found[0], signal.SIGSTOP)
                self.assertTrue(wait_for(lambda: state(found[0]) in "TZ"))
                if state(found[0]) == "T":
                    return process, found[0]
            process.communicate()  # the job was faster: again
            shutil.rmtree(self.out)
