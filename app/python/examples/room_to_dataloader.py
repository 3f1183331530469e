"""A room to a DataLoader: plans, exports and iterates over batches of pictures and boxes.

Usage: room_to_dataloader.py room.glb dataset
"""
import sys

import torch

import dollytrack as dt


def main(room, folder):
    dt.load(room).plan(max_frames=60, width_px=320, height_px=240).export(folder, overwrite=True)
    dataset = dt.Dataset(folder)
    loader = torch.utils.data.DataLoader(dataset.torch(boxes="coco"), batch_size=8, num_workers=2)
    boxes = 0
    for pictures, targets in loader:
        boxes += int(targets["count"].sum())
    print(f"{len(dataset)} pictures of {tuple(pictures.shape[1:])}, {boxes} boxes, "
          f"classes {sorted({dataset.classes[int(i)] for s in dataset for i in s.labels})}")


if __name__ == "__main__":  # workers may import this file
    main(*sys.argv[1:])
