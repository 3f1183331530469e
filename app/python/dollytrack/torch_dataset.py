"""Datasets for PyTorch's DataLoader."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Callable, Dict, List, Optional, Tuple, TypeVar

import numpy as np
import numpy.typing as npt
import torch

from .dataset import Sample
from .errors import Usage, failure

if TYPE_CHECKING:
    from .dataset import BoxFormat, Dataset

_Item = TypeVar("_Item", covariant=True)


class TorchDataset(torch.utils.data.Dataset[_Item]):
    """Pairs of an image and a target; see Dataset.torch()."""

    def __init__(self, dataset: "Dataset", boxes: Optional["BoxFormat"], images: List[str],
                 rows: int, transform: Optional[Callable[..., Any]]) -> None:
        """Takes checked arguments; rows: the least number of rows of boxes and labels."""
        self.dataset = dataset
        self._form = boxes
        self._images = images
        self._transform = transform
        self._rows = rows

    def __len__(self) -> int:
        return len(self.dataset)

    def __getitem__(self, index: int) -> _Item:
        sample = self.dataset[index]
        if not isinstance(sample, Sample):
            raise failure(Usage, "Select frames before torch(), as in data[0:3].torch().", "index")
        picture = torch.from_numpy(np.ascontiguousarray(sample["rgb"].transpose(2, 0, 1)))
        target: Dict[str, Any] = {"image_id": torch.tensor(sample.index)}
        if self._form is not None:
            count = len(sample.labels)
            rows = max(count, self._rows)
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
        item: Any = picture, target
        if self._transform is not None:
            item = self._transform(picture, target)
        result: _Item = item
        return result

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
