"""An export with all modalities and formats that is small enough to be made hundreds of times."""
import json

from support import tiny_room
from support.program import run

SIZE = ["--set", "width_px=64", "--set", "height_px=48"]
EVERYTHING = ["--modalities", "all", "--formats", "all", "--flow-distances", "1,2",
              "--camera", "wide:lens=fisheye,width_px=32,height_px=32"]
TRACK = {"op": "object_track", "object": "mug", "keys": [
    {"time_s": 0}, {"time_s": 20, "offset": [0.2, 0.1, 0], "turn_deg": 90}]}


def plan(folder, frames):
    """A project of the tiny room, where the mug moves, with a plan of the given number of
    frames."""
    tiny_room.write(folder / "room.obj")
    (folder / "LICENSE").write_text("CC-BY 4.0\n")
    project = folder / "room.dolly"
    for command in [
        ["plan", folder / "room.obj", "--max-frames", frames, "-o", project, *SIZE],
        ["edit", project, "--op", json.dumps(TRACK), "--plan"],
    ]:
        made = run(*command)
        assert made.returncode == 0, made.stderr
    return project
