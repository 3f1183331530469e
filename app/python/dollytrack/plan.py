"""Planned trajectories, their frames and datasets."""
from __future__ import annotations

import csv
import io
import json
import operator
from typing import (TYPE_CHECKING, Any, Dict, Iterable, Iterator, List, Literal, Mapping, NoReturn,
                    Optional, Sequence, Union, get_args)

import numpy as np
import numpy.typing as npt

from . import _core, arguments
from .arguments import PICTURE_SECTIONS, OpenGl, Path, Progress, Value
from .errors import Usage, failure

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .arguments import PictureParameters
    from .scene import Scene

_OFTEN_USED = ("render_mode", "antialias", "light_preset", "time_of_day_h", "sun_strength",
               "exposure_ev", "light_variation", "sensor_preset")
_OF_PLAN = ("The parameter belongs to the plan; pass it to Scene.plan(). Only those of "
            f"{', '.join(PICTURE_SECTIONS)} can be changed here.")

#: The images that Plan.render() makes.
ImageName = Literal["rgb", "depth", "instance", "semantic", "normal_world", "normal_camera",
                    "albedo", "rgb_right", "depth_right", "hdr", "diffuse_reflectance",
                    "diffuse_illumination", "direct_illumination", "indirect_illumination",
                    "residual"]
#: Names that other programs use for images.
_SYNONYMS = {"color": "rgb", "colour": "rgb", "image": "rgb", "normals": "normal_world",
             "segmentation": "semantic", "mask": "instance"}


class Frame(Mapping[str, npt.NDArray[Any]]):
    """One rendered frame: its images by name, as in frame["rgb"], and its camera.

    rgb, albedo, rgb_right: (H, W, 3) uint8, sRGB. depth, depth_right: (H, W) float32, metres along
    the viewing axis, 0 where no surface is visible. instance: (H, W) uint16, ids of objects, 0: none.
    semantic: (H, W) uint16, ids of Scene.classes; Scene.void_id: no class, which is 0 with NYU40 but
    not with own classes that use 0. normal_world, normal_camera: (H, W, 3) float32 unit vectors. hdr and the
    layers of light: (H, W, 3) float32, linear, exposed as rgb.
    """

    def __init__(self, index: int, time_s: float, pose: npt.NDArray[np.float64],
                 images: Dict[str, npt.NDArray[Any]]) -> None:
        self.index = index  #: frame number in the trajectory
        self.time_s = time_s
        self.pose = pose  #: (4, 4) world_from_camera; x right, y down, z forward
        self._images = images

    def __getitem__(self, name: str) -> npt.NDArray[Any]:
        return self._images[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._images)

    def __len__(self) -> int:
        return len(self._images)

    # Arrays have no truth value, so that mappings of them cannot be compared.
    __eq__ = object.__eq__
    __hash__ = object.__hash__

    def __repr__(self) -> str:
        return f"<Frame {self.index}: {', '.join(self._images)}>"


class Frames(Iterator[Frame]):
    """Iterator that renders the frames of a plan one by one. len() is the total number of frames."""

    def __init__(self, core: "_core.Frames") -> None:
        self._core = core

    def __len__(self) -> int:
        return self._core.count()

    def __next__(self) -> Frame:
        drawn = self._core.next()
        if drawn is None:
            raise StopIteration
        return Frame(*drawn)

    def close(self) -> None:
        """Ends the iteration and frees the resources of rendering."""
        self._core.close()

    def __enter__(self) -> "Frames":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


class Plan:
    """A planned trajectory, made by Scene.plan(). Immutable. It cannot be passed to other processes:
    save() it and load it there."""

    def __init__(self, core: "_core.Plan", scene: "Scene") -> None:
        if not isinstance(core, _core.Plan):
            raise failure(Usage, "Use Scene.plan().", "Plan")
        self._core = core
        self.scene = scene

    @property
    def metrics(self) -> Dict[str, Any]:
        """The metrics that 'dollytrack plan --json' prints: counts, rates (0 .. 1), lengths, times."""
        metrics: Dict[str, Any] = json.loads(self._core.metrics())
        return metrics

    @property
    def parameters(self) -> Dict[str, Dict[str, Value]]:
        """All parameters of the plan, by section and name."""
        parameters: Dict[str, Dict[str, Value]] = json.loads(self._core.parameters())
        return parameters

    @property
    def poses(self) -> npt.NDArray[np.float64]:
        """(N, 4, 4) world_from_camera, m; camera axes x right, y down, z forward."""
        return self._core.poses()

    @property
    def times(self) -> npt.NDArray[np.float64]:
        """(N,) times of the frames, s."""
        return self._core.frames()["times"]

    @property
    def paths(self) -> npt.NDArray[np.int32]:
        """(N,) number of the continuous motion that each frame belongs to; there is no motion between
        frames of different numbers."""
        return self._core.frames()["paths"]

    @property
    def key_frames(self) -> npt.NDArray[np.bool_]:
        """(N,) whether the frame is a key frame: a view that was planned to capture objects."""
        return self._core.frames()["keys"].astype(np.bool_)

    @property
    def intrinsics(self) -> npt.NDArray[np.float64]:
        """(3, 3) camera matrix, px; the centre of the first pixel is at (0.5, 0.5)."""
        _, _, fx, fy, cx, cy = self._core.intrinsics()
        return np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1]], dtype=np.float64)

    @property
    def ledger(self) -> List[Dict[str, Any]]:
        """For each target, the frame that captures it, or the reason why none does."""
        ledger: List[Dict[str, Any]] = self.metrics.get("ledger", [])
        return ledger

    def explain(self, target: Union[str, int], progress: Progress = None) -> Dict[str, Any]:
        """The ledger's row of an object (name or id). If the object is not well captured, the row has a
        "remedy": a change that captures it, found by planning again, which takes seconds."""
        one = self.scene[target]
        rows = [row for row in self.ledger if row["id"] == one.id]
        if not rows:
            raise failure(Usage, "The object is not a target of this plan.", repr(target))
        if rows[0].get("loss") is None:
            return rows[0]
        found = json.loads(self._core.explain(ids=[one.id], progress=arguments.reporter(progress)))
        row: Dict[str, Any] = found[0]
        return row

    def coverage(self, *files: Path, progress: Progress = None) -> Dict[str, Dict[str, Any]]:
        """The capture rates of plans with increasing budgets.

        files: .csv, .svg or .png files to write the result to.
        The result has "frames" and "length", the two kinds of budget; each has arrays of equal length:
        frames, path_length_m, captured, well_captured, capture_rate, well_captured_rate.
        """
        table = self._core.coverage(files=[arguments.path(one, "files") for one in files],
                                    progress=arguments.reporter(progress))
        rows = list(csv.DictReader(io.StringIO(table)))
        names = ("frames", "path_length_m", "captured", "well_captured", "capture_rate",
                 "well_captured_rate")
        return {kind: {name: np.array([float(row[name]) for row in rows if row["budget"] == kind])
                       for name in names} for kind in ("frames", "length")}

    @arguments.takes_parameters(_OFTEN_USED, sections=PICTURE_SECTIONS, others=_OF_PLAN)
    def render(self, *images: ImageName, range: str = "::", still: bool = False,
               gl: OpenGl = "auto", progress: Progress = None,
               **parameters: Unpack[PictureParameters]) -> Frames:
        """Renders the frames one by one; nothing is written.

        images: "rgb", "depth", "instance", "semantic", "normal_world", "normal_camera", "albedo",
            "rgb_right", "depth_right"; default: the first four. With render_mode="traced" or
            "reference" also "hdr", "diffuse_reflectance", "diffuse_illumination",
            "direct_illumination", "indirect_illumination", "residual". See Frame for their arrays.
        range: "a:b:s", frames a to b (b not included), every s-th.
        still: objects with a track stay at their planned poses.
        gl: OpenGL backend: "auto", "egl" (GPU) or "osmesa" (CPU).
        progress: as in export(), for the light, which is computed before the first frame.

        Raises NoOpenGl if there is no OpenGL driver that can render.
        """
        return Frames(self._core.render(
            modalities=_images(images), range=_text(range, "range"), still=bool(still),
            gl=_text(gl, "gl"), assignments=arguments.assignments(parameters),
            progress=arguments.reporter(progress)))

    def save(self, file: Path) -> None:
        """Writes a .dolly project, which the command line, the editor and load() open. A scene of
        Scene.from_arrays() must have been given a file."""
        if self.scene._temporary:
            raise failure(Usage, "The scene is in a temporary file, which a project cannot refer to; "
                                 "pass a file to from_arrays().", str(file))
        self._core.save(file=arguments.path(file, "file"))

    @arguments.takes_parameters(_OFTEN_USED, sections=PICTURE_SECTIONS, others=_OF_PLAN)
    def export(self, folder: Path, *, preset: Optional[str] = None,
               modalities: Union[None, str, Iterable[str]] = None,
               formats: Union[None, str, Iterable[str]] = None, range: str = "::",
               flow_distances: Union[int, Sequence[int]] = (1,), folds: int = 0, fold_seed: int = 1,
               rig: Optional[Path] = None, cameras: Union[None, str, Iterable[str]] = None,
               still: bool = False, overwrite: bool = False, resume: bool = False,
               gl: OpenGl = "auto", progress: Progress = None,
               **parameters: Unpack[PictureParameters]) -> Dict[str, Any]:
        """Writes a dataset, byte-identical to that of 'dollytrack export'.

        preset: name of a preset, e.g. "nerf", that selects modalities and formats; see
            'dollytrack export --list'.
        modalities, formats: names of 'dollytrack export --list', or "all", as a list; None: those
            of the preset, or the default ones.
        range: "a:b:s", frames a to b (b not included), every s-th.
        flow_distances: one or several distances of optical flow, in frames later and earlier.
        folds, fold_seed: number of cross-validation folds, and the random seed of the split.
        rig, cameras: a rig file of additional cameras, and single cameras as text, "left:yaw_deg=90".
        still: objects with a track stay at their planned poses.
        overwrite: replace a complete dataset; resume: continue an interrupted export.
        gl: OpenGL backend: "auto", "egl" (GPU) or "osmesa" (CPU).
        progress: True for a progress bar, or a function of a fraction (0 .. 1) and the stage's name.

        The result is that of 'dollytrack export --json'. After Ctrl-C the finished frames are kept;
        resume=True continues after them.
        """
        report = arguments.reporter(progress)
        text = self._core.export(
            folder=arguments.path(folder, "folder"),
            preset="" if preset is None else _text(preset, "preset"),
            modalities=arguments.names(modalities, "modalities"),
            formats=arguments.names(formats, "formats"), range=_text(range, "range"),
            flow_distances=_distances(flow_distances),
            folds=arguments.whole(folds, "folds", 0, 100),
            fold_seed=arguments.whole(fold_seed, "fold_seed", 0, 2**64 - 1),
            rig=b"" if rig is None else arguments.path(rig, "rig"),
            cameras=arguments.words(cameras, "cameras"), still=bool(still),
            overwrite=bool(overwrite), resume=bool(resume), gl=_text(gl, "gl"),
            assignments=arguments.assignments(parameters), progress=report)
        arguments.finish(report)
        summary: Dict[str, Any] = json.loads(text)
        return summary

    def __reduce__(self) -> NoReturn:
        raise TypeError("a Plan cannot be passed to another process or pickled; use plan.save(file), and "
                        "dollytrack.load(file).saved_plan() there")

    def __len__(self) -> int:
        return len(self.times)

    def __repr__(self) -> str:
        metrics = self.metrics
        return (f"<Plan of {self.scene.name!r}: {len(self)} frames, {metrics.get('captured')} of "
                f"{metrics.get('objects')} targets captured>")


def _images(images: Sequence[Any]) -> List[str]:
    """The names of images; the default ones if there are none."""
    known = get_args(ImageName)
    for one in images:
        if not isinstance(one, str):
            raise failure(Usage, "Pass each name as an argument of its own, as in render('rgb', "
                                 f"'depth'), not a {type(one).__name__}.", "images")
        if one in known:
            continue
        if "," in one:
            separate = ", ".join(map(repr, arguments.parts(one)))
            raise failure(Usage, f"{one!r} has several names; pass each as an argument of its own: "
                                 f"render({separate}).", "images")
        meant = arguments.nearest(one, known, _SYNONYMS)
        if one in _core.modalities():
            hint = f"render() does not have '{one}'; export() writes it. It has"
        elif meant:
            hint = f"There is no image '{one}'; did you mean '{meant}'? There are"
        else:
            hint = f"There is no image '{one}'; there are"
        raise failure(Usage, f"{hint} {', '.join(known)}.", "images")
    return list(images) or ["rgb", "depth", "instance", "semantic"]


def _distances(value: Any) -> List[int]:
    try:
        listed: Iterable[Any] = [operator.index(value)]
    except TypeError:
        listed = value if isinstance(value, Iterable) else [value]
    return [arguments.whole(one, "flow_distances") for one in listed]


def _text(value: Any, what: str) -> str:
    if not isinstance(value, str):
        raise failure(Usage, f"The value must be a str, not {type(value).__name__}.", what)
    return value
