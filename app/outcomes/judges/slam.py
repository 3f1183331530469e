"""SLAM programs given with --slam NAME=COMMAND: share of tracked frames, errors, success rate."""
import dataset  # imported first: it sets the number of threads

import os
import shlex
import shutil
import signal
import subprocess

import numpy as np

import evaluation

OPTIONS = {"runs": 3, "timeout_s": 1800.0, "align": "se3"}
VALUES = {
    "success_rate": {"unit": "%", "better": "higher"},
    "tracked_rate": {"unit": "%", "better": "higher"},
    "ate_cm": {"unit": "cm", "better": "lower"},
    "rpe_cm": {"unit": "cm", "better": "lower"},
    "rpe_deg": {"unit": "deg", "better": "lower"},
}


def check():
    return "runs the programs of --slam"


def write_settings(data, folder):
    """Writes the camera for ORB-SLAM2 and 3 (settings.yaml) and DSO (camera.txt)."""
    step = np.median(np.diff(data.times)) if len(data) > 1 else 0.1
    rate = 1.0 / step if step > 0 else 10.0
    k = data.matrix(pixel_centres=True)
    numbers = {
        "Camera.fx": k[0, 0], "Camera.fy": k[1, 1], "Camera.cx": k[0, 2], "Camera.cy": k[1, 2],
        "Camera1.fx": k[0, 0], "Camera1.fy": k[1, 1], "Camera1.cx": k[0, 2], "Camera1.cy": k[1, 2],
        "Camera.k1": 0.0, "Camera.k2": 0.0, "Camera.p1": 0.0, "Camera.p2": 0.0,
        "Camera.width": data.width, "Camera.height": data.height, "Camera.fps": round(rate, 6),
        "Camera.bf": k[0, 0] * 0.08, "Camera.RGB": 1, "ThDepth": 40.0, "DepthMapFactor": 5000.0,
        "Stereo.ThDepth": 40.0, "Stereo.b": 0.08, "RGBD.DepthMapFactor": 5000.0,
        "ORBextractor.nFeatures": 1000, "ORBextractor.scaleFactor": 1.2, "ORBextractor.nLevels": 8,
        "ORBextractor.iniThFAST": 20, "ORBextractor.minThFAST": 7,
    }
    viewer = {"KeyFrameSize": 0.05, "KeyFrameLineWidth": 1.0, "GraphLineWidth": 0.9,
              "PointSize": 2.0, "CameraSize": 0.08, "CameraLineWidth": 3.0, "ViewpointX": 0.0,
              "ViewpointY": -0.7, "ViewpointZ": -1.8, "ViewpointF": 500.0}
    lines = ["%YAML:1.0", "File.version: \"1.0\"", "Camera.type: \"PinHole\""]
    lines += [f"{key}: {value}" for key, value in numbers.items()]
    lines += [f"Viewer.{key}: {value}" for key, value in viewer.items()]
    (folder / "settings.yaml").write_text("\n".join(lines) + "\n")
    size = f"{data.width} {data.height}"
    (folder / "camera.txt").write_text(
        f"Pinhole {k[0, 0]} {k[1, 1]} {k[0, 2]} {k[1, 2]} 0\n{size}\ncrop\n{size}\n")


def run_shell(line, folder, timeout_s):
    """Runs a shell command in a folder; kills its remaining processes when it ends or exceeds its time."""
    with open(folder / "log.txt", "w", encoding="utf-8") as log:
        process = subprocess.Popen(["/bin/sh", "-c", line], cwd=folder, stdout=log, stderr=log,
                                   start_new_session=True)
        try:
            process.wait(timeout_s)
        except subprocess.TimeoutExpired:
            log.write(f"\nstopped after {timeout_s:g} s\n")
        finally:
            try:
                os.killpg(process.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass  # all processes have ended
            process.wait()


def run_once(command, data, folder, timeout_s):
    """The trajectory file of one run; an empty file if the run wrote none."""
    folder.mkdir()
    out = folder / "estimate.txt"
    write_settings(data, folder)
    words = {"rgbd_folder": data.folder.resolve(), "out": out, "settings": folder / "settings.yaml",
             "camera": folder / "camera.txt"}
    line = command
    for name, value in words.items():
        line = line.replace("{" + name + "}", shlex.quote(str(value)))
    run_shell(line, folder, timeout_s)
    # ORB-SLAM writes the first into its working folder, DSO the second.
    for name in ("CameraTrajectory.txt", "result.txt"):
        if not out.exists() and (folder / name).exists():
            shutil.move(folder / name, out)
    if not out.exists():
        out.write_text("")
    return out


def median(values):
    known = [value for value in values if value is not None]
    return float(np.median(known)) if known else None


def measure(data, request, entry):
    options = request["options"]
    values = {}
    for number, one in enumerate(request["programs"]):
        folder = evaluation.scratch(request, "slam", dataset.entry_folder(entry), str(number))
        estimates = [run_once(one["command"], data, folder / f"run{i + 1}",
                              options["timeout_s"])
                     for i in range(max(1, options["runs"]))]
        runs = evaluation.evaluate(request["program"], data.folder, estimates, options["align"])
        values.update({f"{one['name']}_{key}": value for key, value in {
            "success_rate": sum(run["success"] for run in runs) / len(runs),
            "tracked_rate": median([run["tracked_share"] for run in runs]),
            "ate_cm": evaluation.centimetres(
                median([evaluation.figure(run, "ate_m") for run in runs])),
            "rpe_cm": evaluation.centimetres(
                median([evaluation.figure(run, "rpe_m") for run in runs])),
            "rpe_deg": median([evaluation.figure(run, "rpe_deg") for run in runs]),
        }.items()})
    return values


def check_request(request):
    programs = request.get("programs", [])
    if not programs:
        raise dataset.Missing("There is no SLAM program; give --slam 'NAME=COMMAND {rgbd_folder} "
                              "{out}'.")
    for one in programs:
        word = (shlex.split(one["command"]) or [""])[0]
        found = subprocess.run(["/bin/sh", "-c", 'command -v -- "$1"', "sh", word],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
        if found.returncode != 0:
            raise dataset.Missing(f"The program '{word}' of --slam {one['name']} is missing; give "
                                  "its path.")


def judge(request):
    metrics = {f"{one['name']}_{key}": info for one in request["programs"] for key, info in VALUES.items()}
    return dataset.judge_entries("slam", request, measure, metrics)


if __name__ == "__main__":
    dataset.run(check, judge, OPTIONS, check_request)
