"""mAP after COCO, and mIoU."""
from dataset import mean

import numpy as np

IOUS = np.linspace(0.5, 0.95, 10)


def box_iou(first, second):
    """N x M intersection over union of boxes (x0, y0, x1, y1)."""
    low = np.maximum(first[:, None, :2], second[None, :, :2])
    high = np.minimum(first[:, None, 2:], second[None, :, 2:])
    shared = np.prod(np.clip(high - low, 0, None), axis=2)
    areas = [np.prod(boxes[:, 2:] - boxes[:, :2], axis=1) for boxes in (first, second)]
    return shared / np.maximum(areas[0][:, None] + areas[1][None, :] - shared, 1e-9)


def match_image(boxes, scores, truth, ignored, threshold):
    """COCO's greedy matching of one class in one image.

    Returns for each box, in order of decreasing score, 1 (right), 0 (wrong) or -1 (on an ignored object).
    """
    order = np.argsort(-scores, kind="stable")
    marks = np.zeros(len(order), int)
    if len(truth) == 0:
        return marks
    overlap = box_iou(boxes[order], truth)
    free = np.ones(len(truth), bool)
    for i in range(len(order)):
        for skip, mark in ((ignored, 1), (~ignored, -1)):
            usable = np.where(free & ~skip, overlap[i], -1.0)
            best = int(np.argmax(usable))
            if usable[best] >= threshold:
                free[best] = False
                marks[i] = mark
                break
    return marks


def average_precision(images, threshold):
    """AP of one class; None if it has no object. `images`: (boxes, scores, truth, ignored) per image."""
    scores, marks, objects = [], [], 0
    for boxes, confidence, truth, ignored in images:
        objects += int((~ignored).sum())
        scores.append(-np.sort(-confidence, kind="stable"))
        marks.append(match_image(boxes, confidence, truth, ignored, threshold))
    if objects == 0:
        return None
    scores, marks = np.concatenate(scores), np.concatenate(marks)
    scores, marks = scores[marks >= 0], marks[marks >= 0]
    right = np.cumsum(marks[np.argsort(-scores, kind="stable")])
    if len(right) == 0:
        return 0.0
    recall = right / objects
    precision = right / np.arange(1, len(right) + 1)
    precision = np.maximum.accumulate(precision[::-1])[::-1]
    at = np.searchsorted(recall, np.linspace(0, 1, 101), side="left")
    return float(np.where(at < len(precision), precision[np.minimum(at, len(precision) - 1)], 0.0).mean())


def mean_average_precision(predictions, truths, classes):
    """mAP at IoU 0.5 and mean over IoU 0.5 to 0.95; None if there are no objects.

    Predictions are (boxes, scores, labels) per image, truths (boxes, labels, ignored); labels are 0 .. classes - 1.
    """
    at_half, over_all = [], []
    for label in range(classes):
        images = []
        for (boxes, scores, labels), (truth, truth_labels, ignored) in zip(predictions, truths):
            mine, its = labels == label, truth_labels == label
            images.append((boxes[mine], scores[mine], truth[its], ignored[its]))
        values = [average_precision(images, threshold) for threshold in IOUS]
        if values[0] is not None:
            at_half.append(values[0])
            over_all.append(float(np.mean(values)))
    return mean(at_half), mean(over_all)


def mean_iou(confusion):
    """Mean intersection over union of the classes with true pixels (rows: truth); None if there are none."""
    right = np.diag(confusion).astype(float)
    present = confusion.sum(axis=1)
    union = present + confusion.sum(axis=0) - right
    return mean((right / np.maximum(union, 1))[present > 0])
