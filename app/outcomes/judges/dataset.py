"""Reads datasets of `dollytrack export` and requests of `dollytrack compare`; shared by all judges."""
import csv
import functools
import hashlib
import importlib
import json
import os
import pathlib
import signal
import sys

# One thread by default, so that sums are reproducible and judges can share the machine. The variables
# must be set before the libraries are imported.
os.environ.setdefault("OMP_NUM_THREADS", "1")

import cv2  # noqa: E402
import numpy as np  # noqa: E402

IMAGE_PIXELS = 640 * 480  # reference image size of limits in pixels
SHOWN_PX = 120            # smallest number of pixels, at that size, of an object that counts as shown
USAGE = 2                 # exit code for a wrong option or argument
MISSING = 3               # exit code of --check if a program or library is missing
TERMINATED = 143          # exit code after SIGTERM


class Missing(Exception):
    """Raised if a program or library of a judge is not installed; the text says how to install it."""


class BadOption(Exception):
    """Raised for an unknown option of a judge or an invalid value."""


class Dataset:
    """A dataset's camera, poses, objects and images. Metres, seconds, pixels; world z up.

    Camera axes are x right, y down, z forward. The centre of the first pixel is at (0.5, 0.5), as in
    COLMAP. In OpenCV, Open3D, ORB-SLAM and DSO it is at (0, 0): use `matrix(pixel_centres=True)`
    for them.
    """

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        with open(self.folder / "dataset.json", encoding="utf-8") as file:
            self.json = json.load(file)
        camera = self.json["conventions"]["intrinsics"]
        self.width, self.height = int(camera["width"]), int(camera["height"])
        self.fx, self.fy = float(camera["fx"]), float(camera["fy"])
        self.cx, self.cy = float(camera["cx"]), float(camera["cy"])
        self.frames = self.json["frames"]
        self.objects = {int(one["id"]): one for one in self.json["objects"]}
        self.targets = {i for i, one in self.objects.items() if one.get("role") == "target"}
        self.times = np.array([float(frame["time_s"]) for frame in self.frames])
        self.poses = np.array([self._pose(frame) for frame in self.frames]).reshape(-1, 4, 4)

    def __len__(self):
        return len(self.frames)

    @staticmethod
    def _pose(frame):
        pose = np.eye(4)
        pose[:3, :3] = rotation_of(frame["quaternion_xyzw"])
        pose[:3, 3] = frame["position"]
        return pose

    def matrix(self, pixel_centres=False):
        """The 3 x 3 camera matrix; with pixel_centres, the centre of pixel (0, 0) is at (0, 0)."""
        shift = 0.5 if pixel_centres else 0.0
        return np.array([[self.fx, 0, self.cx - shift], [0, self.fy, self.cy - shift], [0, 0, 1.0]])

    @property
    def shown_px(self):
        """Smallest number of pixels of an object that counts as shown: 120 at 640 x 480, scaled to the
        dataset's image size."""
        return SHOWN_PX * self.width * self.height / IMAGE_PIXELS

    def path(self, modality, index):
        frame = int(self.frames[index]["index"])
        folder = self.folder / modality
        found = folder / f"{frame:06d}.png"
        return found if found.exists() or modality != "rgb_sensor" else found.with_suffix(".jpg")

    def _read(self, modality, index, flags):
        path = self.path(modality, index)
        image = cv2.imread(str(path), flags)
        if image is None:
            raise ValueError(f"{path}: the image cannot be read")
        return image

    def rgb(self, index):
        """Colour image, height x width x 3 uint8, RGB."""
        return cv2.cvtColor(self._read("rgb", index, cv2.IMREAD_COLOR), cv2.COLOR_BGR2RGB)

    def gray(self, index):
        return self._read("rgb", index, cv2.IMREAD_GRAYSCALE)

    def depth(self, index):
        """Depth along the viewing axis, m; 0 where no surface is visible."""
        scale = float(self.json["conventions"]["depth"]["scale_m"])
        return self._read("depth", index, cv2.IMREAD_UNCHANGED).astype(np.float32) * scale

    def instance(self, index):
        """Object ids; 0 where no object is visible."""
        return self._read("instance", index, cv2.IMREAD_UNCHANGED)

    def semantic(self, index):
        """Class ids; 0 where no class is visible."""
        return self._read("semantic", index, cv2.IMREAD_UNCHANGED)

    def boxes(self, index, least_px=None):
        """The targets shown in a frame: {"id", "label", "px", "x", "y", "width", "height"} each."""
        least = self.shown_px if least_px is None else least_px
        ids = self.instance(index)
        pixels = np.bincount(ids.ravel())
        found = []
        for one in np.flatnonzero(pixels >= max(least, 1)):
            if int(one) not in self.targets:
                continue
            x, y, width, height = cv2.boundingRect((ids == one).astype(np.uint8))
            found.append({"id": int(one), "label": int(self.objects[int(one)].get("nyu40") or 0),
                          "px": int(pixels[one]), "x": x, "y": y, "width": width, "height": height})
        return found

    def points(self, index, step=1):
        """World points of every step-th pixel that has depth, and their (row, column)."""
        depth = self.depth(index)[::step, ::step]
        rows, columns = np.nonzero(depth > 0)
        z = depth[rows, columns].astype(np.float64)
        x = (columns * step + 0.5 - self.cx) / self.fx * z
        y = (rows * step + 0.5 - self.cy) / self.fy * z
        pose = self.poses[index]
        world = np.column_stack([x, y, z]) @ pose[:3, :3].T + pose[:3, 3]
        return world, np.column_stack([rows, columns]) * step

    def project(self, index, points):
        """Pixels (x, y) and depths of world points in a frame; points with depth <= 0 are behind the camera."""
        pose = self.poses[index]
        local = (np.asarray(points) - pose[:3, 3]) @ pose[:3, :3]
        depth = local[:, 2]
        safe = np.where(depth > 0, depth, np.nan)
        return np.column_stack([local[:, 0] / safe * self.fx + self.cx,
                                local[:, 1] / safe * self.fy + self.cy]), depth

    @functools.cached_property
    def rows(self):
        """The rows of frames.csv as dictionaries of strings; empty if the file does not exist."""
        try:
            with open(self.folder / "frames.csv", newline="", encoding="utf-8") as file:
                return list(csv.DictReader(file))
        except FileNotFoundError:
            return []


def rotation_of(quaternion_xyzw):
    x, y, z, w = np.asarray(quaternion_xyzw, dtype=float) / np.linalg.norm(quaternion_xyzw)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def need(module, package):
    """Imports a library. Raises Missing with its Debian package."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise Missing(f"Python's {module} is missing; install Debian's {package}.") from error


def need_program(name, package):
    """The path of a program. Raises Missing with its Debian package."""
    for folder in os.environ.get("PATH", "").split(os.pathsep):
        path = os.path.join(folder, name)
        if os.access(path, os.X_OK) and os.path.isfile(path):
            return path
    raise Missing(f"The program {name} is missing; install Debian's {package}.")


def options_of(request, defaults):
    """The options of a request, with these defaults and their types. Raises BadOption."""
    judge = pathlib.Path(sys.argv[0]).stem
    options = dict(defaults)
    for name, value in (request.get("options") or {}).items():
        if name not in defaults:
            there = f"its options are {', '.join(defaults)}" if defaults else "it has no options"
            raise BadOption(f"The judge {judge} has no option '{name}'; {there}.")
        try:
            options[name] = type(defaults[name])(value)
        except ValueError as error:
            kind = "a whole number" if isinstance(defaults[name], int) else "a number"
            raise BadOption(f"The option {judge}.{name} must be {kind}, not '{value}'.") from error
    return options


def mean(values):
    """The mean of the values that are not None; None if there are none."""
    known = [float(value) for value in values if value is not None and np.isfinite(value)]
    return float(np.mean(known)) if known else None


def finite(value):
    """A number for the result file; None if it is not finite."""
    return None if value is None or not np.isfinite(value) else float(value)


def progress(text):
    print(text, file=sys.stderr, flush=True)


def entry_name(entry):
    return f"{entry['scene']} {entry['planner']} seed {entry.get('seed', 1)}"


def entry_folder(entry):
    """The name of an entry's folder for scratch files."""
    name = f"{entry['scene']}.{entry['planner']}.seed{entry.get('seed', 1)}"
    return "".join(c if c.isalnum() or c in "._-" else "_" for c in name)


def write_result(path, result):
    """Writes a file atomically, via a temporary file."""
    temporary = f"{path}.{os.getpid()}.tmp"
    with open(temporary, "w", encoding="utf-8") as file:
        json.dump(result, file, indent=1, allow_nan=False)
        file.write("\n")
    os.replace(temporary, path)


def judge_entries(name, request, measure, metrics):
    """The result of a judge that measures each dataset separately.

    `measure(dataset, request, entry)` returns values by name; if it raises, they are null and the
    exception becomes a note. `metrics` describes all values: {"name": {"unit", "better":
    "higher"|"lower"|""}}. Each row is saved in the work folder once measured, so that a stopped judge
    can continue with the next one.
    """
    rows, notes = [], []
    for entry in request["entries"]:
        row = {key: entry.get(key) for key in ("planner", "scene", "seed")}
        row["values"] = dict.fromkeys(metrics)
        try:
            kept = kept_row(name, request, entry)
            values = read_json(kept)
            if values is None:
                values = measure(Dataset(entry["dataset"]), request, entry)
                values = {key: finite(value) for key, value in values.items()}
                write_result(kept, values)
            row["values"].update(values)
        except Missing:
            raise
        except Exception as error:  # pylint: disable=broad-except  # measure the other entries
            notes.append(f"{entry_name(entry)}: {text_of(error)}")
        rows.append(row)
        progress(f"{name}: {entry_name(entry)} done")
    return {"judge": name, "rows": rows, "metrics": metrics, "notes": notes}


def text_of(error):
    """The text of an exception, in one line."""
    return " ".join(str(error).split()) or type(error).__name__


def digest_of(request):
    """A SHA-256 of the judges' code and the settings that all values depend on, to be updated further."""
    digest = hashlib.sha256()
    folders = {pathlib.Path(path).resolve().parent for path in (sys.argv[0], __file__)}
    for path in sorted(path for folder in folders for path in folder.glob("*.py")):
        digest.update(path.name.encode() + b"\0" + path.read_bytes())
    keys = ("options", "programs", "seed", "version", "versions")
    digest.update(json.dumps([request.get(key) for key in keys], sort_keys=True).encode())
    return digest


def kept_row(name, request, entry):
    """The file that caches an entry's values; its name has a hash of everything they depend on."""
    digest = digest_of(request)
    reference = request.get("references", {}).get(entry["scene"])
    tests = [one for one in request.get("tests", []) if one["scene"] == entry["scene"]]
    for one in [entry, *tests]:
        digest.update(one.get("distribution", "").encode())
        digest.update((pathlib.Path(one["dataset"]) / "dataset.json").read_bytes())
    digest.update(pathlib.Path(reference).read_bytes() if reference else b"-")
    folder = pathlib.Path(request["work"])
    folder.mkdir(parents=True, exist_ok=True)
    return folder / f"{name}.{entry_folder(entry)}.{digest.hexdigest()[:16]}.json"


def read_json(path):
    """The content of a JSON file; None if it is missing or invalid."""
    try:
        return json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None


def run(check, judge, defaults=None, check_request=None):
    """The command line of a judge: --check [REQUEST.json], or REQUEST.json RESULT.json.

    `check()` returns the versions found as one line, or raises Missing; `judge(request)` returns the
    result. `defaults` are the judge's options, see options_of(). `check_request(request)` raises
    Missing if a program in the request is missing.
    """
    # SIGTERM raises SystemExit, so that judges can end the programs that they started.
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(TERMINATED))
    arguments = sys.argv[1:]
    checking = arguments[:1] == ["--check"]
    files = arguments[1:] if checking else arguments
    if len(files) not in ((0, 1) if checking else (2,)):
        print(f"Usage: {sys.argv[0]} --check [REQUEST.json] | REQUEST.json RESULT.json", file=sys.stderr)
        sys.exit(USAGE)
    try:
        versions = check()
        request = json.loads(pathlib.Path(files[0]).read_text(encoding="utf-8")) if files else None
        if request is not None:
            request.update(options=options_of(request, defaults or {}), versions=versions)
            if check_request is not None:
                check_request(request)
        if checking:
            print(versions)
            sys.exit(0)
        seed = int(request.get("seed", 1))
        np.random.seed(seed)
        cv2.setRNGSeed(seed)
        cv2.setNumThreads(1)
        result = judge(request)
    except Missing as error:
        print(error)
        sys.exit(MISSING)
    except BadOption as error:
        print(error, file=sys.stderr)
        sys.exit(USAGE)
    result["versions"] = versions
    write_result(files[1], result)
