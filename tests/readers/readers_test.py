#!/usr/bin/python3
"""Third-party programs open Dollytrack's exports and must find the true values.

Usage: readers_test.py PROGRAM APARTMENT [unittest arguments]
       readers_test.py PROGRAM APARTMENT colmap_reader      one of them
"""
import pathlib
import sys
import unittest

import exports

exports.PROGRAM, exports.APARTMENT = sys.argv.pop(1), sys.argv.pop(1)
exports.OPENCV_KITTI = pathlib.Path(exports.PROGRAM).with_name("opencv_kitti")
READERS = ["array_reader", "blender_reader", "colmap_reader", "gltf_validator_reader", "kitti_reader", "label_reader",
           "mcap_reader", "open3d_reader", "opencv_reader", "rosbag_reader", "video_reader"]


if __name__ == "__main__":
    if len(sys.argv) == 1:
        sys.argv += READERS
    unittest.main(module=None)
