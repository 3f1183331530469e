"""Reads exported datasets; needs only NumPy."""
from __future__ import annotations

import json
import operator
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import (TYPE_CHECKING, Any, Callable, Dict, Iterator, List, Literal, NamedTuple, Optional,
                    Tuple, TypeVar, Union, get_args, overload)

import numpy as np
import numpy.typing as npt

from . import png
from .errors import BadInput, Usage, failure

if TYPE_CHECKING:
    import os

    from .torch_dataset import TorchDataset

    from torch import Tensor

    Pair = Tuple[Tensor, Dict[str, Tensor]]
    _Samples = Sequence["Sample"]
    _Images = Mapping[str, npt.NDArray[Any]]
else:
    _Samples = Sequence
    _Images = Mapping

_Result = TypeVar("_Result")

#: Formats of boxes in targets; Dataset.torch() describes them.
BoxFormat = Literal["coco", "xyxy", "yolo"]

#: The modalities that can be read, with the scale of their pixel values; None: values as stored.
_READ: Dict[str, Optional[float]] = {
    "rgb": None, "albedo": None, "rgb_right": None, "rgb_sensor": None, "instance": None,
    "semantic": None, "depth": 1e-3, "depth_right": 1e-3, "depth_sensor": 1e-3,
    "normal_camera": 2 / 65535, "normal_world": 2 / 65535, "object_coordinates": 1 / 65535,
    "disparity": 1 / 256, "roughness": 1 / 255, "metallic": 1 / 255,
}


class Tracks(NamedTuple):
    """Points on surfaces, followed through a clip: N tracks, T frames.

    first_frame: index of the clip's first frame.
    points: (N, T, 2) x and y in px; (-1, -1) nearer than near_m and behind the camera.
    points_3d: (N, T, 3) positions in the world, m.
    occluded: (N, T) whether the point is hidden by a surface or outside the image.
    query_points: (N, 3) frame counted from the clip's first, y and x in px, where the point is visible.
    object_ids: (N,) ids of the objects.
    """

    first_frame: int
    points: npt.NDArray[np.float32]
    points_3d: npt.NDArray[np.float32]
    occluded: npt.NDArray[np.bool_]
    query_points: npt.NDArray[np.float32]
    object_ids: npt.NDArray[np.uint16]


class _Boxes:
    """The annotations of annotations.json, as arrays ordered by frame."""

    def __init__(self, file: Path, frames: int) -> None:
        rows = _read_json(file)["annotations"]
        frame = np.array([row["image_id"] - 1 for row in rows], np.int64)
        if ((frame < 0) | (frame >= frames)).any():
            raise ValueError("image_id")
        order = np.argsort(frame, kind="stable")
        chosen = [rows[i] for i in order]
        self.boxes = np.array([row["bbox"] for row in chosen], np.float32).reshape(-1, 4)
        self.labels = np.array([row["category_id"] for row in chosen], np.int64)
        self.objects = np.array([row["object_id"] for row in chosen], np.int64)
        self.areas = np.array([row["area"] for row in chosen], np.float32)
        self.starts = np.searchsorted(frame[order], np.arange(frames + 1))


class Sample(_Images):
    """One frame of a dataset: its images by name, as in sample["rgb"], each read on access.

    rgb, albedo, rgb_right, rgb_sensor: (H, W, 3) uint8, sRGB. depth, depth_right, depth_sensor:
    (H, W) float32, metres along the viewing axis, 0 where no surface is visible. instance: (H, W)
    uint16, Dataset.objects' ids, 0: no object. semantic: (H, W) uint8 (uint16 if a class id is above 255),
    ids of Dataset.classes; Dataset.void_id: no class, which is 0 with NYU40 but not with own classes
    that use 0.
    normal_world, normal_camera: (H, W, 3) float32 unit vectors. object_coordinates: (H, W, 3) float32,
    0 .. 1. disparity: (H, W) float32, px. roughness, metallic: (H, W) float32, 0 .. 1.
    """

    def __init__(self, dataset: "Dataset", index: int) -> None:
        self._dataset = dataset
        self.index = index  #: frame number in the dataset, also in the file names
        self._row = dataset._card["frames"][index]

    @property
    def time_s(self) -> float:
        return float(self._row["time_s"])

    @property
    def pose(self) -> npt.NDArray[np.float64]:
        """(4, 4) world_from_camera, m; the world has z up, a camera x right, y down, z forward."""
        x, y, z, w = self._row["quaternion_xyzw"]
        pose = np.eye(4)
        pose[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
        pose[:3, 3] = self._row["position"]
        return pose

    @property
    def boxes(self) -> npt.NDArray[np.float32]:
        """(n, 4) x, y, width, height of the box around each target's visible pixels, px (COCO)."""
        boxes: npt.NDArray[np.float32] = self._annotations("boxes")
        return boxes

    @property
    def labels(self) -> npt.NDArray[np.int64]:
        """(n,) class id of each box, a key of Dataset.classes. Objects of unknown class are 40 (otherprop)
        with NYU40, but Dataset.void_id in semantic images."""
        labels: npt.NDArray[np.int64] = self._annotations("labels")
        return labels

    @property
    def object_ids(self) -> npt.NDArray[np.int64]:
        """(n,) object id of each box, the value in the instance image."""
        objects: npt.NDArray[np.int64] = self._annotations("objects")
        return objects

    @property
    def areas(self) -> npt.NDArray[np.float32]:
        """(n,) number of visible pixels of each box's object."""
        areas: npt.NDArray[np.float32] = self._annotations("areas")
        return areas

    def _annotations(self, what: str) -> Any:
        boxes = self._dataset._boxes()
        return getattr(boxes, what)[boxes.starts[self.index]:boxes.starts[self.index + 1]]

    def __getitem__(self, name: str) -> npt.NDArray[Any]:
        return self._dataset._image(name, self.index)

    def __iter__(self) -> Iterator[str]:
        return iter(self._dataset.modalities)

    def __len__(self) -> int:
        return len(self._dataset.modalities)

    def __contains__(self, name: object) -> bool:
        return name in self._dataset.modalities

    # Arrays have no truth value, so that mappings of them cannot be compared.
    __eq__ = object.__eq__
    __hash__ = object.__hash__

    def __repr__(self) -> str:
        return f"<Sample {self.index} of {self._dataset.folder}: {', '.join(self)}>"


class _Splits(Dict[str, "Dataset"]):
    def __missing__(self, name: str) -> "Dataset":
        has = f"it has {', '.join(self)}" if self else "it has none; export it with folds=5"
        raise KeyError(f"The dataset has no split '{name}': {has}.")


def _why_no_dataset(folder: Path) -> str:
    if (folder / "gather.json").exists():
        return ("The folder contains a gathered dataset, whose files 'sha256sum -c SHA256SUMS' checks; "
                "give the datasets that it was gathered from.")
    within = sorted([*folder.glob("*/dataset.json"), *folder.glob("*/dataset/dataset.json")])
    if within:
        return f"The folder contains datasets; give one of them, such as {within[0].parent}."
    if (folder / ".dollytrack-export").exists():  # the journal of an export
        return ("The folder has no dataset.json: its export did not finish. Call export() again with "
                "the same arguments and resume=True.")
    return ("The folder has no dataset.json, so it is not a dataset; give a folder that export() "
            "wrote.")


class Dataset(_Samples):
    """A dataset in a folder, or some of its frames. Indexing gives a Sample; a slice or an array of
    indices or booleans (also a PyTorch tensor) gives a Dataset of those frames. Image files are read on
    access. It can be passed to other processes.

    folder: path of the dataset.
    modalities: names of the images that can be read; Sample describes their arrays.
    size: width and height of the images, px.
    intrinsics: (3, 3) camera matrix, px. The centre of the first pixel is at (0.5, 0.5); OpenCV has it
        at (0, 0): subtract 0.5 from cx and cy for it.
    classes: class names by id; ids are the values of labels and semantic images.
    void_id: the value of semantic images where there is no class: 0 with NYU40; with own classes 0, or
        255 or 65535 if 0 is a class, or the "void" of the file of classes.
    objects: the scene's objects, each with id (the value in instance images), name, nyu40 (class id),
        role ("target", "structure" or "excluded"), box (center and size, m, world; yaw_rad) and
        relations; with own classes also class_id.

    Raises BadInput if the folder contains no complete dataset, or one of its files is damaged.
    """

    def __init__(self, folder: Union[str, "os.PathLike[str]"]) -> None:
        try:
            self.folder = Path(folder)
        except TypeError:
            raise failure(Usage, "The folder must be a str or os.PathLike.", repr(folder)) from None
        file = self.folder / "dataset.json"
        if not self.folder.is_dir():
            exists = self.folder.exists()
            raise failure(BadInput, "The path is a file; give the folder of a dataset." if exists
                          else "The folder does not exist; check the path.", str(folder))
        if not file.exists():
            raise failure(BadInput, _why_no_dataset(self.folder), str(folder))
        self._card = _read_json(file)
        if not isinstance(self._card, dict) or self._card.get("format") != "dollytrack dataset":
            raise failure(BadInput, "The file is not the dataset.json of a Dollytrack dataset.",
                          str(file))
        try:
            self._indices = np.arange(len(self._card["frames"]))
            #: Class names by id; ids are the values of semantic images and labels.
            self.classes: Dict[int, str] = {row["id"]: row["name"]
                                            for row in self._card["classes"][1:]}
            #: The value of semantic images where there is no class.
            self.void_id: int = int(self._card["classes"][0]["id"])
            #: Names of the images that the dataset has and that can be read.
            self.modalities: List[str] = [m for m in self._card["modalities"] if m in _READ]
            #: The scene's objects: id, name, nyu40, role, box, relations and so on.
            self.objects: List[Dict[str, Any]] = self._card["objects"]
            camera = self._card["conventions"]["intrinsics"]
            #: Width and height of the images, px.
            self.size: Tuple[int, int] = (int(camera["width"]), int(camera["height"]))
            #: (3, 3) camera matrix, px; the centre of the first pixel is at (0.5, 0.5), not (0, 0).
            self.intrinsics: npt.NDArray[np.float64] = np.array(
                [[camera["fx"], 0, camera["cx"]], [0, camera["fy"], camera["cy"]], [0, 0, 1]], float)
        except (KeyError, IndexError, TypeError, ValueError, OverflowError):
            raise failure(BadInput, "A field is missing or of the wrong type; export the dataset "
                          "again.", str(file)) from None
        self._cache: Dict[str, Any] = {}  # shared by the parts of this dataset

    def _image(self, name: str, index: int) -> npt.NDArray[Any]:
        if name not in self.modalities:
            raise KeyError(f"{name!r} is not in the dataset; it has {', '.join(self.modalities)}")
        file = self.folder / name / f"{index:06d}.png"
        try:
            pixels = png.decode(file.read_bytes(), _READ[name])
        except OSError as error:
            if name == "rgb_sensor" and file.with_suffix(".jpg").exists():
                return _read_jpeg(file.with_suffix(".jpg"))
            raise failure(BadInput, f"The file cannot be read ({error.strerror}).", str(file)) from None
        except png.Damaged as error:
            raise failure(BadInput, f"The image is damaged ({error}); export the dataset again.",
                          str(file)) from None
        if pixels.shape[:2] != self.size[::-1]:
            raise failure(BadInput, "The image has another size than dataset.json says; export the "
                          "dataset again.", str(file))
        if name.startswith("normal"):
            nothing = ~pixels.any(axis=2)
            pixels -= 1
            pixels[nothing] = 0
        return pixels

    def _boxes(self) -> _Boxes:
        if "boxes" not in self._cache:
            file = self.folder / "annotations.json"
            if not file.exists():
                raise failure(BadInput, "The file is missing; add 'coco' to the formats of export().",
                              str(file))
            try:
                self._cache["boxes"] = _Boxes(file, len(self._card["frames"]))
            except (KeyError, TypeError, ValueError, OverflowError) as error:
                if isinstance(error, BadInput):
                    raise
                raise failure(BadInput, "The file is damaged; export the dataset again.",
                              str(file)) from None
        boxes: _Boxes = self._cache["boxes"]
        return boxes

    @property
    def poses(self) -> npt.NDArray[np.float64]:
        """(N, 4, 4) world_from_camera, m; camera axes x right, y down, z forward."""
        return np.array([sample.pose for sample in self]).reshape(-1, 4, 4)

    @property
    def times(self) -> npt.NDArray[np.float64]:
        """(N,) times of the frames, s."""
        return np.array([sample.time_s for sample in self], dtype=np.float64)

    def tracks(self, frame: int = 0) -> Tracks:
        """The point tracks of the clip that contains a frame, by its index in the whole dataset. The
        arrays are read from the files when their values are used.

        Raises Usage if the dataset has no tracks or no such frame, BadInput if a file is damaged.
        """
        count = len(self._card["frames"])
        if "tracks" not in self._card["modalities"]:
            raise failure(Usage, "The dataset has no tracks; add 'tracks' to the modalities of "
                          "export().", str(self.folder))
        if not isinstance(frame, (int, np.integer)) or not 0 <= frame < count:
            raise failure(Usage, f"There is no such frame; give a number from 0 to {count - 1}.",
                          repr(frame))
        try:
            clip = max(1, int(self._card["conventions"]["tracks"]["clip_frames"]))
        except (KeyError, TypeError, ValueError):
            raise failure(BadInput, "The field conventions.tracks.clip_frames is missing; export the "
                          "dataset again.", str(self.folder / "dataset.json")) from None
        first = int(frame) // clip * clip
        frames = min(clip, count - first)

        def read(name: str, dtype: Any, *shape: Optional[int]) -> npt.NDArray[Any]:
            file = self.folder / "tracks" / f"{first:06d}_{name}.npy"
            try:
                values: npt.NDArray[Any] = np.load(file, mmap_mode="r", allow_pickle=False)
            except (OSError, ValueError, EOFError, TypeError) as error:
                raise failure(BadInput, f"The file cannot be read ({error}); export the dataset "
                              "again.", str(file)) from None
            fits = values.ndim == len(shape) and all(
                size is None or size == found for size, found in zip(shape, values.shape))
            if values.dtype != dtype or not fits:
                raise failure(BadInput, "The array has another type or shape than the clip's frames "
                              "and tracks need; export the dataset again.", str(file))
            return values

        points = read("points", np.float32, None, frames, 2)
        n = len(points)
        return Tracks(first, points, read("points_3d", np.float32, n, frames, 3),
                      read("occluded", np.bool_, n, frames), read("query_points", np.float32, n, 3),
                      read("object_ids", np.uint16, n))

    @property
    def splits(self) -> Dict[str, "Dataset"]:
        """The dataset's splits by name: "train" and "val" (those of the first fold, or of YOLO), and
        "fold_0_train", "fold_0_val" and so on of export(folds=n). A name that the dataset lacks raises a KeyError with those that it
        has."""
        files = {file.stem: file for file in (self.folder / "folds").glob("fold_*.txt")}
        for part in ("train", "val"):
            listed = self.folder / f"{part}.txt"
            file = files.get(f"fold_0_{part}", listed if listed.exists() else None)
            if file is not None:
                files[part] = file
        kept = set(self._indices.tolist())
        return _Splits({name: self._part([i for i in self._listed(file) if i in kept])
                        for name, file in sorted(files.items())})

    def _listed(self, file: Path) -> List[int]:
        try:
            indices = [int(Path(line).stem) for line in file.read_text().split()]
        except (OSError, ValueError):
            indices = [-1]
        if any(not 0 <= i < len(self._card["frames"]) for i in indices):
            raise failure(BadInput, "The file is damaged; export the dataset again.", str(file))
        return indices

    def _part(self, indices: Any) -> "Dataset":
        part = object.__new__(Dataset)
        part.__dict__.update(self.__dict__)
        part._indices = np.asarray(indices, dtype=np.int64).reshape(-1)
        return part

    @overload
    def torch(self, boxes: Optional[BoxFormat] = "coco", images: Union[str, Sequence[str]] = (),
              pad: Union[bool, int] = True, transform: None = None) -> "TorchDataset[Pair]": ...

    @overload
    def torch(self, boxes: Optional[BoxFormat] = "coco", images: Union[str, Sequence[str]] = (),
              pad: Union[bool, int] = True, *,
              transform: Callable[[Tensor, Dict[str, Tensor]], _Result]
              ) -> "TorchDataset[_Result]": ...

    def torch(self, boxes: Optional[BoxFormat] = "coco", images: Union[str, Sequence[str]] = (),
              pad: Union[bool, int] = True, transform: Optional[Callable[..., Any]] = None) -> Any:
        """The dataset for torch.utils.data.DataLoader: pairs of an image and a target. Needs PyTorch.

        The image is a (3, H, W) float32 tensor, 0 .. 1. The target is a dict of tensors: boxes (K, 4)
        float32 px, labels (K,) int64, count (number of boxes) and image_id (the sample's index), both
        int64 scalars, and the images asked for.

        boxes: "coco" (x, y, width, height), "xyxy" (two corners), "yolo" (centre and size as
            fractions of the image size); None: no boxes, labels and count.
        images: further images of the dataset to put into the target, such as "depth" and "semantic".
            instance and semantic are (H, W) int64; depth and other numbers (H, W) float32; normals
            (3, H, W) float32; colours (3, H, W) uint8.
        pad: True: pad boxes with 0 and labels with -1 to the largest number in a frame, so that all
            targets have one shape. A whole number: pad to that number, so that several datasets have
            one shape, too. False: do not pad; pass collate_fn=data.torch(...).collate to the loader,
            whose batches are then the images as one (B, 3, H, W) tensor and a list of B targets.
        transform: called with image and target; its result is returned instead of the pair.

        Raises Usage if a frame has more boxes than `pad`, ModuleNotFoundError without PyTorch.
        """
        forms = get_args(BoxFormat)
        if boxes is not None and boxes not in forms:
            raise failure(Usage, f"{boxes!r} is not a box format; give {', '.join(forms)} or None.",
                          "boxes")
        if transform is not None and not callable(transform):
            raise failure(Usage, "Give a function of image and target, not "
                                 f"{type(transform).__name__}.", "transform")
        further = [images] if isinstance(images, str) else list(images)
        for name in ("rgb", *further):
            if name not in self.modalities:
                raise failure(Usage, f"{name!r} is not in the dataset; it has "
                                     f"{', '.join(self.modalities)}.", "images")
        rows = 0  # the least number of rows of boxes and labels
        # The boxes are read here, so that the processes of a loader share them.
        if boxes is not None and pad is not False:
            counts = np.diff(self._boxes().starts)[self._indices]
            rows = _rows_of(pad, int(counts.max(initial=0)), self)
        try:
            from .torch_dataset import TorchDataset
        except ModuleNotFoundError as error:
            if error.name != "torch":
                raise
            raise ModuleNotFoundError(
                "Dataset.torch() needs PyTorch: install Debian's package python3-torch, or torch "
                "with pip.", name="torch") from None
        return TorchDataset(self, boxes, further, rows, transform)

    @overload
    def __getitem__(self, index: int) -> Sample: ...

    @overload
    def __getitem__(self, index: Union[slice, Sequence[int], npt.NDArray[Any]]) -> "Dataset": ...

    def __getitem__(self, index: Any) -> Any:
        many = isinstance(index, (list, tuple)) or (
            hasattr(index, "__array__") and getattr(index, "ndim", 0) > 0)
        if isinstance(index, slice) or (many and not (isinstance(index, tuple) and not index)):
            chosen: Any = index if isinstance(index, slice) else np.asarray(index)
            if isinstance(chosen, np.ndarray) and not chosen.size:
                return self._part([])
            if isinstance(chosen, np.ndarray) and (chosen.ndim != 1 or chosen.dtype.kind not in "iub"):
                raise failure(Usage, "Indices must be a list of whole numbers or booleans.",
                              "index")
            return self._part(self._indices[chosen])
        try:
            if isinstance(index, bool) or (hasattr(index, "__array__")
                                           and np.asarray(index).dtype.kind == "b"):
                raise TypeError
            number = operator.index(index)
        except TypeError:
            raise failure(Usage, "An index must be a whole number, a slice or a list of whole numbers, "
                          f"not {type(index).__name__}.",
                          "index") from None
        if not -len(self) <= number < len(self):
            raise IndexError(f"there are {len(self)} frames")
        return Sample(self, int(self._indices[number]))

    def __len__(self) -> int:
        return len(self._indices)

    def __repr__(self) -> str:
        return f"<Dataset {str(self.folder)!r}: {len(self)} frames of {', '.join(self.modalities)}>"


def _rows_of(pad: Union[bool, int], most: int, dataset: Dataset) -> int:
    """The number of rows that all frames get. Raises Usage if a frame has more boxes."""
    if isinstance(pad, (bool, np.bool_)):
        return most if pad else 0
    try:
        rows = operator.index(pad)
    except TypeError:
        raise failure(Usage, f"Give True, False or a whole number, not {type(pad).__name__}.",
                      "pad") from None
    if rows < most or rows < 1:
        raise failure(Usage, f"A frame of {dataset.folder} has {most} boxes; {rows} is too small.",
                      "pad")
    return rows


def _read_json(file: Path) -> Any:
    try:
        with open(file, encoding="utf-8") as opened:
            return json.load(opened)
    except OSError as error:
        raise failure(BadInput, f"The file cannot be read ({error.strerror}).", str(file)) from None
    except (ValueError, RecursionError):
        raise failure(BadInput, "The file is not valid JSON; export the dataset again.", str(file)) from None


def _read_jpeg(file: Path) -> npt.NDArray[np.uint8]:
    """Reads a JPEG file with OpenCV, because NumPy alone cannot decode JPEG."""
    try:
        import cv2  # type: ignore[import]
    except ImportError:
        raise failure(BadInput, "Reading JPEG images needs OpenCV; install python3-opencv.",
                      str(file)) from None
    picture = cv2.imread(str(file), cv2.IMREAD_COLOR)
    if picture is None:
        raise failure(BadInput, "The file is damaged; export the dataset again.", str(file))
    rgb: npt.NDArray[np.uint8] = np.ascontiguousarray(picture[:, :, ::-1])
    return rgb
