"""Prints how fast dollytrack.Dataset reads, against OpenCV reading the same PNG files alone, in turn.
Usage: figures.py PROGRAM MODULE DATASET. Run by hand: times decide no test."""
import time

from module import dt, sys  # noqa: F401

import cv2


def seconds(read):
    begin = time.process_time()
    read()
    return time.process_time() - begin


cv2.setNumThreads(1)
data = dt.Dataset(sys.argv[1])
names = [name for name in ("rgb", "depth", "instance", "semantic") if name in data.modalities]
for chosen in [[name] for name in names] + [names]:
    ours = theirs = 0.0
    for index in range(min(len(data), 100)):
        files = [str(data.folder / name / f"{index:06d}.png") for name in chosen]
        theirs += seconds(lambda: [cv2.imread(file, cv2.IMREAD_UNCHANGED) for file in files])
        ours += seconds(lambda: [data[index][name] for name in chosen])
    count = min(len(data), 100)
    print(f"{'+'.join(chosen):32} {count / ours:7.1f} frames/s, OpenCV {count / theirs:7.1f}; "
          f"ratio {theirs / ours:.2f}")
