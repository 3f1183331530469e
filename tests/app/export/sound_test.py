#!/usr/bin/python3
"""`verify` raises no false alarm on fresh exports of many rooms.

Usage: sound_test.py PROGRAM [--long | --rooms N --frames N] [SCENE ...]

Without --long two generated rooms with few small frames; with it 200 rooms with 300 frames of the
usual size. Given scenes are exported instead of generated ones.
"""
import argparse
import json
import pathlib
import shutil
import sys
import tempfile

from support.program import run

LIBRARY = pathlib.Path("/usr/share/sweethome3d/furniture")


def alarms(scene, folder, arguments):
    """Errors that verify reports for a fresh export."""
    out = folder / "dataset"
    made = run("-q", "export", scene, "--out", out, *arguments)
    if made.returncode != 0:
        return [f"not exported: {made.stderr}"]
    done = run("-q", "verify", out, "--scene", scene, "--json")
    shutil.rmtree(out)
    if done.returncode not in (0, 4):
        return [f"not verified: {done.stderr}"]
    return [f"{check['check']}: {finding}" for check in json.loads(done.stdout)["checks"]
            for finding in check.get("findings", []) if check["status"] == "failed"]


def main():
    options = argparse.ArgumentParser()
    options.add_argument("--long", action="store_true")
    options.add_argument("--rooms", type=int)
    options.add_argument("--frames", type=int)
    options.add_argument("scenes", nargs="*", type=pathlib.Path)
    asked = options.parse_args()
    rooms = asked.rooms or (200 if asked.long else 2)
    frames = asked.frames or (300 if asked.long else 12)
    size = [] if asked.long or asked.frames else ["--set", "width_px=320", "--set", "height_px=240"]
    damaged = 0
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        scenes = asked.scenes
        if not scenes:
            if not LIBRARY.is_dir():
                print("Debian's sweethome3d-furniture is not installed")
                return 77
            made = run("generate", "--rooms", rooms, "--seed", 11, "--out", folder / "rooms", "--json")
            assert made.returncode == 0, made.stderr
            scenes = [folder / "rooms" / room["scene"] for room in json.loads(made.stdout)["rooms"]]
        for scene in scenes:
            found = alarms(scene, folder, ["--max-frames", str(frames), *size])
            damaged += bool(found)
            print(f"{scene}: {'sound' if not found else found[:5]}", flush=True)
    print(f"{len(scenes)} exports of at most {frames} frames, {damaged} called damaged")
    return 1 if damaged else 0


if __name__ == "__main__":
    sys.exit(main())
