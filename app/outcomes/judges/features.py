"""Corners, correct matches between consecutive frames, boxes per frame (OpenCV's ORB)."""
import dataset  # imported first: it sets the number of threads

import cv2
import numpy as np

CORNERS = 1000        # number of strongest corners that ORB keeps
FEW = 100             # corners per frame, below which tracking usually fails
CORRECT_NEEDED = 30   # correct matches that a pair of frames needs
CORRECT_PX = 3.0      # largest error of a correct match, against the true motion
HAMMING = 64          # largest Hamming distance of matched descriptors, of 256 bits
SAME_SURFACE = 0.05   # largest depth difference to the other frame's surface, as a share of the depth

METRICS = {
    "corners_per_frame": {"unit": "", "better": "higher"},
    "few_corners_rate": {"unit": "%", "better": "lower"},
    "matches_per_pair": {"unit": "", "better": "higher"},
    "correct_per_pair": {"unit": "", "better": "higher"},
    "correct_rate": {"unit": "%", "better": "higher"},
    "matched_pair_rate": {"unit": "%", "better": "higher"},
    "boxes_per_frame": {"unit": "", "better": "higher"},
    "frames": {"unit": "", "better": ""},
}


def check():
    return f"OpenCV {cv2.__version__}, NumPy {np.__version__}"


def correct_matches(data, first, second, matches, points, others):
    """The number of matches that agree with the true depth and motion."""
    if not matches:
        return 0
    here = np.array([points[match.queryIdx].pt for match in matches]) + 0.5
    there = np.array([others[match.trainIdx].pt for match in matches]) + 0.5
    depth = data.depth(first)
    columns = np.clip(here[:, 0].astype(int), 0, data.width - 1)
    rows = np.clip(here[:, 1].astype(int), 0, data.height - 1)
    z = depth[rows, columns].astype(float)
    local = np.column_stack([(here[:, 0] - data.cx) / data.fx * z,
                             (here[:, 1] - data.cy) / data.fy * z, z])
    pose = data.poses[first]
    pixels, far = data.project(second, local @ pose[:3, :3].T + pose[:3, 3])
    near = np.linalg.norm(pixels - there, axis=1) <= CORRECT_PX
    other = data.depth(second)[np.clip(there[:, 1].astype(int), 0, data.height - 1),
                               np.clip(there[:, 0].astype(int), 0, data.width - 1)]
    same = np.abs(other - far) <= SAME_SURFACE * far
    return int(np.count_nonzero((z > 0) & (far > 0) & near & same))


def measure(data, _request, _entry):
    orb = cv2.ORB_create(nfeatures=CORNERS)
    matcher = cv2.BFMatcher(cv2.NORM_HAMMING, crossCheck=True)
    corners, boxes, matched, correct = [], [], [], []
    before = None
    for index in range(len(data)):
        points, descriptors = orb.detectAndCompute(data.gray(index), None)
        corners.append(len(points))
        boxes.append(len(data.boxes(index)))
        if before is not None:
            found = []
            if before[1] is not None and descriptors is not None:
                found = [match for match in matcher.match(before[1], descriptors)
                         if match.distance <= HAMMING]
            matched.append(len(found))
            correct.append(correct_matches(data, index - 1, index, found, before[0], points))
        before = points, descriptors
    pairs = max(len(correct), 1)
    return {
        "corners_per_frame": dataset.mean(corners),
        "few_corners_rate": dataset.mean([count < FEW for count in corners]),
        "matches_per_pair": dataset.mean(matched),
        "correct_per_pair": dataset.mean(correct),
        "correct_rate": sum(correct) / sum(matched) if sum(matched) else None,
        "matched_pair_rate": (sum(count >= CORRECT_NEEDED for count in correct) / pairs
                              if correct else None),
        "boxes_per_frame": dataset.mean(boxes),
        "frames": len(data),
    }


if __name__ == "__main__":
    dataset.run(check, lambda request: dataset.judge_entries("features", request, measure, METRICS))
