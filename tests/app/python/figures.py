"""Prints how fast dollytrack.Dataset reads, compared with OpenCV reading only the same PNG files:
the best of seven times per frame, both in turn. Usage: figures.py PROGRAM MODULE DATASET. Run by
hand: times do not decide a test."""
import sys
import time

import cv2

from module import dt


def seconds(read):
    begin = time.process_time()
    read()
    return time.process_time() - begin


cv2.setNumThreads(1)
data = dt.Dataset(sys.argv[1])[:50]
names = [name for name in ("rgb", "depth", "instance", "semantic") if name in data.modalities]
for chosen in [[name] for name in names] + [names]:
    ours = theirs = 0.0
    for sample in data:
        files = [str(data.folder / name / f"{sample.index:06d}.png") for name in chosen]
        times = [(seconds(lambda: [sample[name] for name in chosen]),
                  seconds(lambda: [cv2.imread(file, cv2.IMREAD_UNCHANGED) for file in files]))
                 for _ in range(7)]
        ours += min(time for time, _ in times)
        theirs += min(time for _, time in times)
    print(f"{'+'.join(chosen):32} {len(data) / ours:7.1f} frames/s, OpenCV "
          f"{len(data) / theirs:7.1f}; ratio {theirs / ours:.2f}")
