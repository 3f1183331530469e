"""The dataset whose page the tests of `view` write, and what they read from the page."""
import json
import re
import shutil

from support import tiny_room
from support.program import FolderCase, run


FRAMES = 14
HOSTILE = "</script><script>window.hacked = 1</script><!--"
TRACK = {"op": "object_track", "object": "mug", "keys": [
    {"time_s": 0}, {"time_s": 20, "offset": [-2.0, 0.6, 0], "turn_deg": 90}]}
SIZE = ["--set", "width_px=320", "--set", "height_px=240"]


def make_dataset(folder):
    """A room where the mug moves, and its dataset with poses, labels and images."""
    tiny_room.write(folder / "room.obj")
    project = folder / "room.dolly"
    for command in [
        ["plan", folder / "room.obj", "--max-frames", FRAMES, "-o", project, *SIZE],
        ["edit", project, "--op", json.dumps(TRACK), "--plan"],
        ["export", project, "--out", folder / "dataset"],
    ]:
        made = run(*command)
        assert made.returncode in (0, 3), made.stderr
    return folder / "dataset"


def card_of(dataset):
    return json.loads((dataset / "dataset.json").read_text())


def changed_copy(dataset, folder, change):
    """A copy of the dataset with another dataset.json."""
    shutil.copytree(dataset, folder)
    card = card_of(folder)
    change(card)
    (folder / "dataset.json").write_text(json.dumps(card))
    return folder


def data_of(page, name):
    """The data stored in the page under a name."""
    text = re.search(rf'<script id="data-{name}"[^>]*>(.*?)</script>', page.read_text(), re.S)[1]
    return json.loads(text)


class ViewCase(FolderCase):
    keeps_cache = True

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.dataset = make_dataset(cls.folder)
        cls.card = card_of(cls.dataset)

    @classmethod
    def view(cls, *arguments):
        made = run("view", *arguments)
        assert made.returncode == 0, made.stderr
        return made
