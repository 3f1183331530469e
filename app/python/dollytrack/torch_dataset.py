"""Datasets for PyTorch's DataLoader."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Callable, Dict, List, Optional, Sequence, Tuple

import numpy as np
import numpy.typing as npt
import torch

from .errors import Usage, failure

if TYPE_CHECKING:
    from .dataset import Dataset

_FORMS = ("coco", "xyxy", "yolo")


class TorchDataset(torch.utils.data.Dataset):  # type: ignore
    """Pairs of an image and a target; see Dataset.torch()."""

    def __init__(self, dataset: "Dataset", boxes: Optional[str], images: Sequence[str], pad: bool,
                 transform: Optional[Callable[[Any, Dict[str, Any]], Any]]) -> None:
        if boxes is not None and boxes not in _FORMS:
            raise failure(Usage, f"{boxes!r} is not a box format: give {', '.join(_FORMS)} or None.",
                          "boxes")
        images = [images] if isinstance(images, str) else list(images)
        for name in ("rgb", *images):
            if name not in dataset.modalities:
                raise failure(Usage, f"{name!r} is not in the dataset; it has "
                                     f"{', '.join(dataset.modalities)}.", "images")
        self.dataset = dataset
        self._form = boxes
        self._images = images
        self._transform = transform
        self._most = 0
        if boxes is not None and pad:  # read here, so that the processes of a loader share it
            counts = np.diff(dataset._boxes().starts)[dataset._indices]
            self._most = int(counts.max(initial=0))
        self._pad = pad

    def __len__(self) -> int:
        return len(self.dataset)

    def __getitem__(self, index: int) -> Any:
        sample = self.dataset[index]
        picture = torch.from_numpy(np.ascontiguousarray(sample["rgb"].transpose(2, 0, 1)))
        target: Dict[str, Any] = {"image_id": torch.tensor(sample.index)}
        if self._form is not None:
            count = len(sample.labels)
            rows = max(count, self._most) if self._pad else count
            boxes = np.zeros((rows, 4), np.float32)
            boxes[:count] = self._shaped(sample.boxes)
            labels = np.full(rows, -1, np.int64)
            labels[:count] = sample.labels
            target["boxes"] = torch.from_numpy(boxes)
            target["labels"] = torch.from_numpy(labels)
            target["count"] = torch.tensor(count)
        for name in self._images:
            pixels = sample[name]
            if pixels.dtype == np.uint16 or name in ("instance", "semantic"):
                pixels = pixels.astype(np.int64)
            target[name] = torch.from_numpy(np.ascontiguousarray(
                pixels.transpose(2, 0, 1) if pixels.ndim == 3 else pixels))
        picture = picture.to(torch.float32).div_(255)
        return (picture, target) if self._transform is None else self._transform(picture, target)

    def _shaped(self, coco: npt.NDArray[np.float32]) -> npt.NDArray[np.float32]:
        corner, size = coco[:, :2], coco[:, 2:]
        if self._form == "xyxy":
            return np.hstack([corner, corner + size])
        if self._form == "yolo":
            image = np.array(self.dataset.size, np.float32)
            return np.hstack([(corner + 0.5 * size) / image, size / image])
        return coco

    @staticmethod
    def collate(batch: List[Tuple[Any, Dict[str, Any]]]) -> Tuple[Any, List[Dict[str, Any]]]:
        """Collates targets of different shapes: the images as one tensor, the targets as a list."""
        pictures, targets = zip(*batch)
        return torch.stack(pictures), list(targets)
