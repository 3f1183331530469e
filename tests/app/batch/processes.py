"""What /proc says about the processes that a batch starts."""
import pathlib


def children(pid):
    return [int(word) for word in
            pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]


def alive(pid):
    try:
        return "\nState:\tZ" not in pathlib.Path(f"/proc/{pid}/status").read_text()
    except FileNotFoundError:
        return False


def memory_kb(pid):
    """Memory of the process without mapped files, whose pages the system drops and reloads freely.
    None once it has ended."""
    status = pathlib.Path(f"/proc/{pid}/status").read_text()
    return int(status.split("RssAnon:")[1].split()[0]) if "RssAnon:" in status else None
