"""A Slurm cluster on this machine, started and stopped by a test; others may run beside it."""
import os
import pathlib
import secrets
import shutil
import signal
import socket
import subprocess
import tempfile
import time

PROGRAMS = ["munged", "slurmctld", "slurmd", "sbatch"]


def missing():
    """The reason why no cluster can run here; empty if one can."""
    absent = [name for name in PROGRAMS if shutil.which(name) is None]
    if absent:
        return "not installed: " + ", ".join(absent)
    return "" if os.geteuid() == 0 else "slurmd runs as root only"


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Cluster:
    """One folder contains everything that it needs: keys, state, logs, and the files with its
    process ids."""

    def __init__(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)
        self.folder.chmod(0o755)  # munged wants its socket to be reachable
        self.daemons = []
        try:
            self.start_munge()
            self.start_slurm()
        except BaseException:
            self.stop()
            raise

    def start_munge(self):
        key = self.folder / "munge.key"
        key.write_bytes(secrets.token_bytes(128))
        key.chmod(0o400)
        self.run_daemon("munged", f"--socket={self.folder}/munge.socket", f"--key-file={key}",
                        f"--pid-file={self.folder}/munged.pid",
                        f"--log-file={self.folder}/munged.log",
                        f"--seed-file={self.folder}/munged.seed")

    def start_slurm(self):
        host = socket.gethostname().split(".")[0]
        controller, node = free_ports(2)
        # Slurm takes a node out of service whose settings promise more than the machine has.
        memory_mb = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") // 2**20
        conf = self.folder / "slurm.conf"
        conf.write_text(f"""
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmctldPort={controller}
SlurmdPort={node}
AuthType=auth/munge
AuthInfo=socket={self.folder}/munge.socket
StateSaveLocation={self.folder}/state
SlurmdSpoolDir={self.folder}/spool
SlurmctldPidFile={self.folder}/slurmctld.pid
SlurmdPidFile={self.folder}/slurmd.pid
SlurmctldLogFile={self.folder}/slurmctld.log
SlurmdLogFile={self.folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
MinJobAge=3600
KillWait=20
NodeName={host} NodeAddr=127.0.0.1 CPUs={min(2, os.cpu_count())} RealMemory={memory_mb * 9 // 10} State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
""")
        for name in ["state", "spool"]:
            (self.folder / name).mkdir()
        self.environment = {**os.environ, "SLURM_CONF": str(conf)}
        self.run_daemon("slurmctld", "-f", conf)
        self.run_daemon("slurmd", "-f", conf)
        if not self.wait_for(lambda: "idle" in self.ask("sinfo", "--noheader"), 30):
            raise RuntimeError("the node did not come up:\n" + self.logs())

    def run_daemon(self, name, *arguments):
        result = subprocess.run([name, *map(str, arguments)], capture_output=True, text=True)
        if result.returncode != 0:
            raise RuntimeError(f"{name} did not start: {result.stderr}{self.logs()}")
        self.daemons.append(name)

    def logs(self):
        return "".join(f"--- {path.name}\n" + "".join(path.read_text().splitlines(True)[-15:])
                       for path in sorted(self.folder.glob("*.log")))

    def ask(self, *command):
        result = subprocess.run([str(word) for word in command], env=self.environment,
                                capture_output=True, text=True, timeout=60)
        return result.stdout

    @staticmethod
    def wait_for(condition, seconds):
        deadline = time.time() + seconds
        while time.time() < deadline:
            if condition():
                return True
            time.sleep(0.2)
        return False

    def states(self, job):
        """The state of each task of the array (None: not an array), and its exit code once it has
        ended."""
        found = {}
        for line in self.ask("scontrol", "--oneliner", "show", "job", job).splitlines():
            fields = dict(word.split("=", 1) for word in line.split() if "=" in word)
            if "JobState" in fields:
                task = fields.get("ArrayTaskId")
                code = int(fields["ExitCode"].split(":")[0])
                found[int(task) if task and task.isdigit() else task] = (fields["JobState"], code)
        return found

    def wait_until_ended(self, job, seconds=600):
        """Waits until no state can change any more; returns the states."""
        def ended():
            states = self.states(job)
            return states and not any(state in ("PENDING", "RUNNING", "COMPLETING", "CONFIGURING")
                                      for state, _ in states.values())
        if not self.wait_for(ended, seconds):
            raise RuntimeError(f"job {job} did not end: {self.states(job)}\n{self.logs()}")
        return self.states(job)

    def stop(self):
        """Stops the daemons in reverse order, each by the process id in its own file."""
        for name in reversed(self.daemons):
            file = self.folder / f"{name}.pid"
            if not file.exists():
                continue
            pid = int(file.read_text())
            os.kill(pid, signal.SIGTERM)
            if not self.wait_for(lambda: not pathlib.Path(f"/proc/{pid}").exists(), 30):
                os.kill(pid, signal.SIGKILL)
        self.temporary.cleanup()
