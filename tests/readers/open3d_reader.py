"""Open3D fuses our depth images with our poses; the result must match the room."""
import json
import struct
import unittest

import numpy as np

import exports

MAX_MEDIAN_M = 0.01
VOXEL_M = 0.015


def triangles(path):
    """Vertices and indices of every mesh in a .glb, z up."""
    data = path.read_bytes()
    length = struct.unpack("<I", data[12:16])[0]
    root, binary = json.loads(data[20:20 + length]), data[28 + length:]

    def values(index, kind, width):
        accessor = root["accessors"][index]
        start = root["bufferViews"][accessor["bufferView"]]["byteOffset"]
        return np.frombuffer(binary, kind, accessor["count"] * width, start).reshape(-1, width)

    for node in root["nodes"]:
        for part in root["meshes"][node["mesh"]]["primitives"] if "mesh" in node else []:
            x, y, z = (values(part["attributes"]["POSITION"], np.float32, 3) +
                       np.float32(node["translation"])).T
            yield (np.ascontiguousarray(np.stack([x, -z, y], 1)),
                   np.ascontiguousarray(values(part["indices"], np.uint32, 1).reshape(-1, 3)))


class Open3d(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        try:
            global o3d
            import open3d as o3d
        except ImportError:
            exports.missing("Open3D", "python3-open3d")
        cls.data = exports.walk()

    def fused(self):
        """The surface fused from the images and poses of the TUM lists."""
        data = self.data
        # Open3D's pixel centres have integer coordinates.
        lens = o3d.camera.PinholeCameraIntrinsic(data.width, data.height, data.fx, data.fy,
                                                 data.cx - 0.5, data.cy - 0.5)
        fusion = o3d.pipelines.integration
        volume = fusion.ScalableTSDFVolume(VOXEL_M, 4 * VOXEL_M, fusion.TSDFVolumeColorType.RGB8)
        poses = np.loadtxt(data.folder / "groundtruth.txt")
        pictures = [line.split() for line in
                    (data.folder / "associations.txt").read_text().splitlines()]
        self.assertEqual(len(poses), len(pictures))
        scale = data.card["conventions"]["tum"]["depth_per_m"]
        for pose, (_, rgb, _, depth) in zip(poses, pictures):
            world_from_camera = np.eye(4)
            world_from_camera[:3, :3] = exports.rotation(pose[4:])
            world_from_camera[:3, 3] = pose[1:4]
            frame = o3d.geometry.RGBDImage.create_from_color_and_depth(
                o3d.io.read_image(str(data.folder / rgb)),
                o3d.io.read_image(str(data.folder / depth)), depth_scale=scale, depth_trunc=5.0,
                convert_rgb_to_intensity=False)
            volume.integrate(frame, lens, np.linalg.inv(world_from_camera))
        return np.asarray(volume.extract_point_cloud().points, np.float32)

    def test_the_fused_room_lies_on_the_scenes_triangles(self):
        scene = o3d.t.geometry.RaycastingScene()
        for corners, indices in triangles(self.data.folder / "trajectory.glb"):
            scene.add_triangles(o3d.core.Tensor(corners), o3d.core.Tensor(indices))
        points = self.fused()
        distances = scene.compute_distance(o3d.core.Tensor(points)).numpy()
        print(f"\nOpen3D: {len(points)} points, {1000 * np.median(distances):.2f} mm median")
        self.assertGreater(len(points), 50_000)
        self.assertLess(np.median(distances), MAX_MEDIAN_M)
        self.assertLess(np.percentile(distances, 90), 2 * MAX_MEDIAN_M)
