"""Scenes, read from files or made of arrays."""
from __future__ import annotations

import atexit
import json
import logging
import shutil
import tempfile
from dataclasses import dataclass, field
from pathlib import Path as FilePath
from typing import (TYPE_CHECKING, Any, Dict, Iterable, Iterator, List, Literal, NoReturn, Optional,
                    Sequence, Tuple, Union, get_args)

import numpy as np
import numpy.typing as npt

from . import _core, arguments, scene_file
from .arguments import Path, Progress
from .errors import BadInput, Usage, failure
from .plan import Plan

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .arguments import JudgeParameters, PlanParameters

UpAxis = Literal["x", "y", "z", "-x", "-y", "-z"]
_MOST_POSES = 1_000_000
#: The name of a pinned point of the project, or a camera position (x, y, z) and the point it looks
#: at (x, y, z), m.
End = Union[None, str, Tuple[Sequence[float], Sequence[float]]]


@dataclass(frozen=True, eq=False)
class SceneObject:
    """An object of a scene.

    id: 1 .. n, also the value in instance images.
    class_id: the value in semantic images.
    role: "target" (to be captured), "structure" (part of the building) or "excluded".
    large: whether the planner views it as a large object.
    center: (3,) centre of its box, world, m.
    size: (3,) size of its upright box along the box's axes, m.
    yaw: angle from the world's x axis to the box's first axis, radians.
    front: (3,) direction of its front, a horizontal unit vector.
    corners: (8, 3) corners of its box, world, m.
    faces: its rows in Scene.faces.
    """

    id: int
    name: str
    class_id: int
    class_name: str
    role: str
    large: bool
    center: npt.NDArray[np.float64]
    size: npt.NDArray[np.float64]
    yaw: float
    front: npt.NDArray[np.float64]
    corners: npt.NDArray[np.float64] = field(repr=False)
    faces: slice = field(repr=False)


class Scene:
    """A room or home with objects, classes and boxes, made by load() or Scene.from_arrays(). Immutable;
    vertices and faces are read-only views of the engine's memory."""

    def __init__(self, core: "_core.Scene") -> None:
        if not isinstance(core, _core.Scene):
            raise failure(Usage, "Use load() or Scene.from_arrays().", "Scene")
        self._core = core
        self._objects: Optional[List[SceneObject]] = None

    @classmethod
    def from_arrays(cls, vertices: npt.ArrayLike, faces: npt.ArrayLike,
                    object_ids: Optional[npt.ArrayLike] = None,
                    names: Optional[Sequence[str]] = None,
                    classes: Optional[Sequence[Optional[str]]] = None,
                    structure: Optional[npt.ArrayLike] = None,
                    colors: Optional[npt.ArrayLike] = None, file: Optional[Path] = None,
                    progress: Progress = None) -> "Scene":
        """Makes a scene of triangles.

        vertices: (N, 3) metres, z up.
        faces: (F, 3) vertex indices, counter-clockwise seen from outside.
        object_ids: (F,) object of each triangle, 0 .. K-1; None: connected pieces become objects.
        names: K object names. Names, classes and structure need object_ids.
        classes: K class words (NYU40 names or common words for them); None, also for single objects:
            found by the object's name.
        structure: (K,) booleans: whether the object is part of the building, not a target; None: objects
            whose class word (their name, if they have none) means wall, floor, ceiling, door, window,
            roof, ground or sky. The class word counts first: an object named floor of
            class table is a target.
        colors: (F, 3) or (K, 3), uint8 sRGB, or floats 0 .. 1.
        file: a new .glb file for the scene, so that projects can refer to it; names and classes are
            written to FILE.glb.objects.json beside it. None: a temporary file, removed when Python
            ends.
        """
        folder = None
        if file is None:
            folder = FilePath(tempfile.mkdtemp(prefix="dollytrack-"))
            atexit.register(shutil.rmtree, folder, ignore_errors=True)
            file = folder / "scene.glb"
        elif FilePath(arguments.path(file, "file").decode("utf-8", "replace")).suffix != ".glb":
            raise failure(Usage, "The file's name must end in .glb.", str(file))
        words = scene_file.write(FilePath(file), vertices, faces, object_ids, names, classes,
                                 structure, colors)
        # The engine warns of each object whose class is unknown, in words for files.
        with arguments.intercepted(f'annotations: "{word}", the class of "{name}", is unknown'
                                   for name, word in words.items()) as warnings:
            scene = load(file, unit_m=1.0, up_axis="y", progress=progress)
        scene._temporary = folder is not None
        if warnings:
            _warn_of_classes(scene, words)
        return scene

    _temporary = False

    @property
    def name(self) -> str:
        """The name of its file, without the extension."""
        return self._core.name.decode("utf-8", "replace")

    @property
    def source(self) -> FilePath:
        """The scene file."""
        return FilePath(self._core.source.decode("utf-8", "surrogateescape"))

    @property
    def objects(self) -> List[SceneObject]:
        """All objects, including walls and floors, in order of id."""
        if self._objects is None:
            self._objects = [SceneObject(**row) for row in self._core.objects()]
        return list(self._objects)

    def __getitem__(self, name: Union[str, int]) -> SceneObject:
        """The object of this name or id."""
        found = [o for o in self.objects if name in (o.name, o.id) and not isinstance(name, bool)]
        if len(found) == 1:
            return found[0]
        problem = "Several objects have" if found else "No object has"
        raise failure(Usage, f"{problem} this name or id; Scene.objects lists all objects.", repr(name))

    def __len__(self) -> int:
        return len(self.objects)

    def __iter__(self) -> Iterator[SceneObject]:
        return iter(self.objects)

    def __contains__(self, name: object) -> bool:
        """Whether the scene has this object, or an object with this name or id."""
        return any(name is o or (not isinstance(name, bool) and name in (o.name, o.id))
                   for o in self.objects)

    @property
    def classes(self) -> Dict[int, str]:
        """Class names of the scene's datasets by id: those of NYU40, or of `labels`."""
        return self._core.classes()

    @property
    def void_id(self) -> int:
        """The value of semantic images where there is no class: 0 with NYU40; with `labels` 0, or 255 or
        65535 if 0 is a class, or the file's "void"."""
        return self._core.void_id

    @property
    def boxes(self) -> npt.NDArray[np.float64]:
        """(K, 7) upright boxes of all objects: centre x, y, z, and size along the box's axes, m; yaw."""
        rows = [[*o.center, *o.size, o.yaw] for o in self.objects]
        return np.array(rows, dtype=np.float64).reshape(-1, 7)

    @property
    def vertices(self) -> npt.NDArray[np.float32]:
        """(N, 3) positions in the world, m."""
        return self._core.vertices()

    @property
    def normals(self) -> npt.NDArray[np.float32]:
        """(N, 3) unit normals, one per vertex."""
        return self._core.normals()

    @property
    def faces(self) -> npt.NDArray[np.uint32]:
        """(F, 3) vertex indices, counter-clockwise seen from outside."""
        return self._core.faces()

    @property
    def face_objects(self) -> npt.NDArray[np.uint16]:
        """(F,) object id of each triangle."""
        return self._core.face_objects()

    @property
    def report(self) -> Dict[str, Any]:
        """The report of 'dollytrack info --json': sizes, classes, notes and warnings of import."""
        report: Dict[str, Any] = json.loads(self._core.report())
        return report

    @arguments.takes_parameters(("max_frames", "max_length_m", "fill", "frame_rate", "duration_s",
                                 "width_px", "height_px", "hfov_deg", "camera_preset", "rooms",
                                 "loop", "seed"))
    def plan(self, *, ignore: Union[None, str, Iterable[str]] = None,
             only: Union[None, str, Iterable[str]] = None, start: End = None, end: End = None,
             time_s: Optional[float] = None, progress: Progress = None,
             **parameters: Unpack[PlanParameters]) -> Plan:
        """Plans a camera trajectory that captures the scene's targets.

        ignore, only: classes, or names with * and ?, that are not targets, or the only targets.
        start, end: start and end pose of the trajectory; None: anywhere.
        time_s: plan with moving objects at their tracks' poses at this time.
        progress: True for a progress bar, or a function of a fraction (0 .. 1) and the stage's name.

        A further plan repeats only the stages whose parameters have changed. Raises Usage for unknown
        parameters and values out of range, BadInput if the camera has no free position.
        """
        core = self._core.plan(
            assignments=arguments.assignments(parameters), ignore=arguments.words(ignore, "ignore"),
            only=arguments.words(only, "only"), start=_end_text(start, "start"),
            end=_end_text(end, "end"), time_s=None if time_s is None else float(time_s),
            progress=arguments.reporter(progress))
        return Plan(core, self)

    def saved_plan(self, progress: Progress = None) -> Optional[Plan]:
        """The plan stored in the opened project; None if it has none, or one that is out of date."""
        core = self._core.stored_plan(progress=arguments.reporter(progress))
        return None if core is None else Plan(core, self)

    def __reduce__(self) -> NoReturn:
        raise TypeError("a Scene cannot be passed to another process or pickled; load its file there")

    def __repr__(self) -> str:
        targets = sum(o.role == "target" for o in self.objects)
        return f"<Scene {self.name!r}: {len(self)} objects, {targets} of them targets>"


def _warn_of_classes(scene: Scene, words: Dict[str, str]) -> None:
    """Warns once of all objects whose words mean no class."""
    lost = [words[o.name] for o in scene.objects if o.class_id == scene.void_id and o.name in words]
    different = list(dict.fromkeys(lost))
    listed = ", ".join(f'"{word}"' for word in different[:5])
    if len(different) > 5:
        listed += f" and {len(different) - 5} more"
    logging.getLogger("dollytrack.import").warning(
        "classes: no class is known for %s (%d of %d objects); give classes of Scene.classes, or "
        "pass file, and load it with labels", listed, len(lost), len(scene))


def _end_text(end: End, what: str) -> str:
    if end is None or isinstance(end, str):
        return end or ""
    try:
        position, target = end
        numbers = [float(number) for number in (*position, *target)]
    except (TypeError, ValueError):
        numbers = []
    if len(numbers) != 6 or not np.isfinite(numbers).all():
        raise failure(Usage, "Give a pinned point's name, or a position and a target of three "
                             "finite numbers each.", what)
    return ",".join(map(repr, numbers))


def load(path: Path, *, unit_m: Optional[float] = None, up_axis: Optional[UpAxis] = None,
         labels: Optional[Path] = None, models: Union[None, Path, Iterable[Path]] = None,
         annotations: Optional[Path] = None, keep_meshes: bool = False, convert: bool = False,
         cloud: Optional[Dict[str, float]] = None, progress: Progress = None) -> Scene:
    """Reads a scene (OBJ, FBX, glTF, GLB, DAE, PLY, STL, Gazebo, URDF, Habitat, labelled meshes,
    point clouds, homes, 3D-FRONT, SceneNet RGB-D; Blender with convert) or a .dolly project.

    unit_m: metres per unit of the scene; None: detected.
    up_axis: the file's upward axis: "x", "y", "z", "-x", "-y" or "-z"; None: detected.
    labels: words and their NYU40 classes (CSV), or your own classes (JSON).
    models: folders with the models that the scene refers to.
    annotations: a file SCENE.objects.json, or the folder of a Hypersim scene.
    keep_meshes: neither split meshes that contain several objects, nor join meshes of one object.
    convert: convert a Blender file to glTF beside it with the installed Blender, in a sandbox.
    cloud: reconstruction of a point cloud: voxel_m, max_points, gap_m, hole_m, plane_m, object_m.

    The file is read in a sandboxed process, so malicious files can do no harm. Notes and warnings go
    to the logger "dollytrack.import". Raises BadInput if the file cannot be used.
    """
    if up_axis is not None and up_axis not in get_args(UpAxis):
        raise failure(Usage, f"{up_axis!r} is not an upward axis: give x, y, z, -x, -y or -z.", "up_axis")
    if isinstance(models, (str, bytes)) or hasattr(models, "__fspath__"):
        models = [models]  # type: ignore[list-item]
    return Scene(_core.open_scene(
        path=arguments.path(path, "path"), unit_m=_metres(unit_m),
        up_axis=up_axis, labels=None if labels is None else arguments.path(labels, "labels"),
        models=[arguments.path(one, "models") for one in models or ()],
        annotations=None if annotations is None else arguments.path(annotations, "annotations"),
        keep_meshes=bool(keep_meshes), convert=bool(convert),
        cloud=arguments.assignments(cloud or {}),
        progress=arguments.reporter(progress)))


def _metres(unit_m: Optional[float]) -> Optional[float]:
    if unit_m is None:
        return None
    try:
        if isinstance(unit_m, str):
            raise TypeError
        metres = float(unit_m)
    except (TypeError, ValueError, OverflowError):
        raise failure(Usage, f"{unit_m!r} is not a number: give metres per unit, such as 0.01 for cm or "
                             "0.0254 for inches.", "unit_m") from None
    if not 0 < metres < 1e6:
        raise failure(Usage, f"{metres:g} is not above 0 and below 1e6: give metres per unit, such as "
                             "0.01 for cm or 0.0254 for inches.", "unit_m")
    return metres


@arguments.takes_parameters(("camera_radius_m", "width_px", "height_px", "hfov_deg"),
                            sections=arguments.JUDGE_SECTIONS,
                            others="judge() does not use the parameter; it takes those of "
                                   f"{', '.join(arguments.JUDGE_SECTIONS)}.",
                            instead={name: "judge() takes the times of the frames from the "
                                           "argument times instead." for name in ("frame_rate", "fps")})
def judge(scene: Scene, poses: npt.ArrayLike, times: Optional[npt.ArrayLike] = None,
          paths: Optional[npt.ArrayLike] = None, *, progress: Progress = None,
          **parameters: Unpack[JudgeParameters]) -> Dict[str, Any]:
    """Measures a trajectory of any origin in a scene, from its poses alone.

    poses: (N, 4, 4) world_from_camera; camera axes x right, y down, z forward.
    times: (N,) increasing seconds; None: ten frames per second.
    paths: (N,) integers; there is no motion between frames of different numbers. None: one path.

    The result has the metrics of 'dollytrack compare' (rates 0 .. 1; None if not applicable), and as
    "ledger" a list with a dictionary per target: object, id, captured, well_captured, and the frame
    that shows it best (-1: never seen) with visible_fraction and box_share.
    """
    if not isinstance(scene, Scene):
        raise failure(Usage, f"The scene must be a Scene, not {type(scene).__name__}.", "scene")
    checked = _poses(poses)
    count = len(checked)
    if times is None:
        seconds = np.arange(count) * 0.1
    else:
        seconds = _numbers(times, np.float64, (count,), "times")
        early = np.diff(seconds) <= 0
        if early.any():
            raise failure(Usage, "Each time must be later than the previous one.",
                          f"times[{int(np.argmax(early)) + 1}]")
    numbers = np.zeros(count, np.int32)
    if paths is not None:
        numbers = _numbers(paths, np.int32, (count,), "paths")
    text = scene._core.judge(poses=checked, times_s=seconds, paths=numbers,
                             assignments=arguments.assignments(parameters),
                             progress=arguments.reporter(progress))
    metrics: Dict[str, Any] = json.loads(text)
    return metrics


def _numbers(values: npt.ArrayLike, dtype: Any, shape: Tuple[Optional[int], ...], what: str) -> Any:
    array = scene_file.array_of(values, what, "iuf", shape, _MOST_POSES)
    scene_file.check_finite(array, what)
    if np.issubdtype(dtype, np.integer):
        limits = np.iinfo(dtype)
        bad = (array < limits.min) | (array > limits.max) | (np.floor(array) != array)
        if bad.any():
            row = scene_file.first_row(bad)
            raise failure(Usage, f"{array[row]} is not an integer of {limits.bits} bits.",
                          f"{what}[{row}]")
    return np.ascontiguousarray(array, dtype)


def _poses(poses: npt.ArrayLike) -> npt.NDArray[np.float64]:
    checked: npt.NDArray[np.float64] = _numbers(poses, np.float64, (None, 4, 4), "poses")
    turns = checked[:, :3, :3]
    off = np.abs(turns @ turns.transpose(0, 2, 1) - np.eye(3)).max(axis=(1, 2))
    bad = (off > 1e-4) | (np.linalg.det(turns) < 0) | (checked[:, 3] != (0, 0, 0, 1)).any(axis=1)
    bad |= (np.abs(checked[:, :3, 3]) > 1e6).any(axis=1)
    if bad.any():
        raise failure(BadInput, "The matrix is not a rigid transform (world_from_camera).",
                      f"poses[{int(np.argmax(bad))}]")
    return checked


def set_threads(count: int) -> None:
    """Sets the number of the engine's worker threads; 0: one per core."""
    _core.set_threads(arguments.whole(count, "count", 0, 1024))
