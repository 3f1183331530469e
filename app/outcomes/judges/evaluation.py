"""Measures estimated trajectories with `dollytrack evaluate`; shared by judges."""
import json
import pathlib
import shutil
import subprocess

import numpy as np


def write_tum(path, times, poses):
    """Writes world_from_camera matrices as a TUM trajectory."""
    with open(path, "w", encoding="utf-8") as file:
        for time, pose in zip(times, poses):
            x, y, z, w = quaternion_of(pose[:3, :3])
            px, py, pz = pose[:3, 3]
            file.write(f"{time:.6f} {px:.9f} {py:.9f} {pz:.9f} {x:.9f} {y:.9f} {z:.9f} {w:.9f}\n")


def quaternion_of(rotation):
    """The quaternion x y z w of a rotation matrix, an eigenvector of a symmetric 4 x 4 matrix."""
    m = np.asarray(rotation, dtype=float)
    form = np.array([
        [m[0, 0] - m[1, 1] - m[2, 2], m[1, 0] + m[0, 1], m[2, 0] + m[0, 2], m[2, 1] - m[1, 2]],
        [m[1, 0] + m[0, 1], m[1, 1] - m[0, 0] - m[2, 2], m[2, 1] + m[1, 2], m[0, 2] - m[2, 0]],
        [m[2, 0] + m[0, 2], m[2, 1] + m[1, 2], m[2, 2] - m[0, 0] - m[1, 1], m[1, 0] - m[0, 1]],
        [m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], np.trace(m)]]) / 3.0
    values, vectors = np.linalg.eigh(form)
    found = vectors[:, np.argmax(values)]
    return found if found[3] >= 0 else -found


def evaluate(program, dataset, estimates, align):
    """Runs `dollytrack evaluate --json`; returns its results in the order of the files."""
    command = [program, "evaluate", str(dataset), "--align", align, "--json"]
    for path in estimates:
        command += ["--estimated", str(path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip() or "dollytrack evaluate failed")
    return json.loads(done.stdout)["runs"]


def figure(run, name):
    """The RMSE of one error of a run; None if it could not be measured."""
    return (run.get(name) or {}).get("rmse")


def centimetres(metres):
    return None if metres is None else 100 * metres


def scratch(request, *names):
    """Makes an empty folder for the files of one entry, in the judge's folder."""
    folder = pathlib.Path(request["work"]).joinpath(*[str(name) for name in names])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    return folder
