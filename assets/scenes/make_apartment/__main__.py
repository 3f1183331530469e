"""Makes the built-in apartment: apartment.glb and apartment.json beside this folder.

    python3 assets/scenes/make_apartment                 writes both files
    python3 assets/scenes/make_apartment --check         compares them with the committed ones
    python3 assets/scenes/make_apartment --out FOLDER    writes elsewhere
"""

import argparse
import json
import pathlib
import sys

import cv2

from gltf import glb
from rooms import bathroom, bedroom, kitchen, living, shell, study
from scene import Scene


def apartment():
    scene = Scene()
    shell.build(scene)
    for room in (living, kitchen, bedroom, bathroom, study):
        room.furnish(scene)
    return scene


def answer_sheet(scene):
    rows = ",\n".join("  " + json.dumps(entry) for entry in scene.truth())
    return (
        '{"frame": "metres, z up; the model file has y up: (x, z, -y)",\n "objects": [\n'
        + rows
        + "\n]}\n"
    )


def main():
    here = pathlib.Path(__file__).resolve().parent.parent
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=pathlib.Path, default=here, help="folder to write to")
    parser.add_argument("--check", action="store_true", help="write nothing, compare instead")
    options = parser.parse_args()
    cv2.setNumThreads(1)  # sums in one order on every machine
    scene = apartment()
    files = {"apartment.glb": glb(scene), "apartment.json": answer_sheet(scene).encode()}
    if options.check:
        stale = [
            name
            for name, data in files.items()
            if not (options.out / name).is_file() or (options.out / name).read_bytes() != data
        ]
        for name in stale:
            print(
                f"{options.out / name}: differs from what the program makes; run it again "
                "without --check",
                file=sys.stderr,
            )
        return 1 if stale else 0
    options.out.mkdir(parents=True, exist_ok=True)
    for name, data in files.items():
        (options.out / name).write_bytes(data)
    triangles = sum(len(p.triangles) for t in scene.things.values() for p in t.model.parts)
    targets = sum(not entry["structure"] for entry in scene.truth())
    print(
        f"{targets} objects, {len(scene.things)} nodes, {triangles} triangles, "
        f"{len(files['apartment.glb']) / 1e6:.2f} MB"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
