"""Structure from motion without poses: frames registered, pose error, points (COLMAP)."""
import dataset  # imported first: it sets the number of threads

import pathlib
import subprocess

import numpy as np

import evaluation

THREADS = "2"
OPTIONS = {"every": 1, "matching": "exhaustive"}
METRICS = {
    "registered_rate": {"unit": "%", "better": "higher"},
    "ate_cm": {"unit": "cm", "better": "lower"},
    "points": {"unit": "", "better": "higher"},
    "reprojection_px": {"unit": "px", "better": "lower"},
    "models": {"unit": "", "better": "lower"},
    "images": {"unit": "", "better": ""},
}


def check():
    program = dataset.need_program("colmap", "colmap")
    said = subprocess.run([program, "-h"], capture_output=True, text=True, check=False).stdout
    return next((line.strip() for line in said.splitlines() if line.startswith("COLMAP")), "COLMAP")


def colmap(folder, *arguments):
    command = [dataset.need_program("colmap", "colmap"), *map(str, arguments)]
    with open(folder / "log.txt", "a", encoding="utf-8") as log:
        # Without this, Qt needs a display even if nothing is shown.
        done = subprocess.run(["env", "QT_QPA_PLATFORM=offscreen", *command], stdout=log,
                              stderr=log, check=False)
    return done.returncode == 0


def link_images(data, folder, every):
    images = folder / "images"
    images.mkdir()
    chosen = list(range(0, len(data), every))
    for index in chosen:
        (images / f"{index:06d}.png").symlink_to(data.path("rgb", index).resolve())
    return images, chosen


def read_model(folder):
    """Camera poses by frame, and the points' reprojection errors, of a text model."""
    poses = {}
    lines = [line for line in (folder / "images.txt").read_text().splitlines()
             if not line.startswith("#")]
    for line in lines[::2]:  # the second line of each image lists its points
        word = line.split()
        w, x, y, z, tx, ty, tz = map(float, word[1:8])
        camera_from_world = np.eye(4)
        camera_from_world[:3, :3] = dataset.rotation_of([x, y, z, w])
        camera_from_world[:3, 3] = [tx, ty, tz]
        poses[int(pathlib.Path(word[9]).stem)] = np.linalg.inv(camera_from_world)
    errors = [float(line.split()[7]) for line in (folder / "points3D.txt").read_text().splitlines()
              if line and not line.startswith("#")]
    return poses, errors


def reconstruct(data, folder, options):
    """Runs COLMAP; returns its models, largest first."""
    every, matching = max(1, options["every"]), options["matching"]
    if matching not in ("exhaustive", "sequential"):
        raise ValueError(f"matching={matching} is neither exhaustive nor sequential")
    images, chosen = link_images(data, folder, every)
    database = ["--database_path", folder / "database.db"]
    lens = f"{data.fx},{data.fy},{data.cx},{data.cy}"
    steps = [
        ["feature_extractor", *database, "--image_path", images, "--ImageReader.single_camera", 1,
         "--ImageReader.camera_model", "PINHOLE", "--ImageReader.camera_params", lens,
         "--SiftExtraction.use_gpu", 0, "--SiftExtraction.num_threads", THREADS],
        [f"{matching}_matcher", *database, "--SiftMatching.use_gpu", 0,
         "--SiftMatching.num_threads", THREADS],
    ]
    for step in steps:
        if not colmap(folder, *step):
            raise RuntimeError(f"colmap {step[0]} failed, see {folder / 'log.txt'}")
    (folder / "sparse").mkdir()
    # The mapper fails without an initial image pair; a result without a model is valid.
    colmap(folder, "mapper", *database, "--image_path", images, "--output_path", folder / "sparse",
           "--Mapper.num_threads", THREADS, "--Mapper.ba_refine_focal_length", 0,
           "--Mapper.ba_refine_principal_point", 0, "--Mapper.ba_refine_extra_params", 0)
    models = []
    for model in sorted((folder / "sparse").iterdir()):
        if colmap(folder, "model_converter", "--input_path", model, "--output_path", model,
                  "--output_type", "TXT"):
            models.append(read_model(model))
    return sorted(models, key=lambda one: -len(one[0])), chosen


def measure(data, request, entry):
    folder = evaluation.scratch(request, "sfm", dataset.entry_folder(entry))
    models, chosen = reconstruct(data, folder, request["options"])
    poses, errors = models[0] if models else ({}, [])
    values = {"registered_rate": len(poses) / len(chosen), "images": len(chosen),
              "models": len(models), "points": len(errors),
              "reprojection_px": float(np.mean(errors)) if errors else None, "ate_cm": None}
    if poses:
        frames = sorted(poses)
        evaluation.write_tum(folder / "estimate.txt", data.times[frames],
                             [poses[frame] for frame in frames])
        run = evaluation.evaluate(request["program"], data.folder, [folder / "estimate.txt"],
                                  "sim3")[0]
        values["ate_cm"] = evaluation.centimetres(evaluation.figure(run, "ate_m"))
    (folder / "database.db").unlink(missing_ok=True)
    return values


if __name__ == "__main__":
    dataset.run(check, lambda request: dataset.judge_entries("sfm", request, measure, METRICS), OPTIONS)
