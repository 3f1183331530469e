"""What /proc says about the processes that a batch starts."""
import pathlib


def children(pid):
    return [int(word) for word in
            pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]


def jobs_of(batch):
    """The batch's children that run their own program already."""
    found = []
    for child in children(batch):
        try:
            words = pathlib.Path(f"/proc/{child}/cmdline").read_bytes().split(b"\0")
        except OSError:
            continue
        if len(words) > 1 and b"batch" not in words:
            found.append(child)
    return found


def state(pid):
    """The letter of its state, as in proc(5): R, S, T when stopped; Z once it has ended."""
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return "Z"


def alive(pid):
    """Whether a thread of the process runs. Until the last one has ended, its files stay open and
    locked, even if the process counts as a zombie already."""
    try:
        threads = len(list(pathlib.Path(f"/proc/{pid}/task").iterdir()))
    except OSError:
        return False
    return threads > 1 or state(pid) != "Z"


def memory_kb(pid):
    """Memory of the process without mapped files, whose pages the system drops and reloads freely.
    None once it has ended."""
    status = pathlib.Path(f"/proc/{pid}/status").read_text()
    return int(status.split("RssAnon:")[1].split()[0]) if "RssAnon:" in status else None
