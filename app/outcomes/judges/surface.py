"""Reconstruction of the scene's surface by TSDF fusion of the depth: accuracy, completion (Open3D)."""
import dataset  # imported first: it sets the number of threads

import numpy as np

VOXEL_M = 0.02
TRUNCATION_M = 0.06
FARTHEST_M = 10.0   # larger depths are not fused
NEAR_M = 0.05       # a reference sample is covered if fused surface is this near
BESIDE_M = 0.2      # fused surface farther than this from all samples is not in the reference

METRICS = {
    "completion_rate": {"unit": "%", "better": "higher"},
    "completion_cm": {"unit": "cm", "better": "lower"},
    "accuracy_cm": {"unit": "cm", "better": "lower"},
    "beyond_rate": {"unit": "%", "better": "lower"},
    "reference_samples": {"unit": "", "better": ""},
}


def check():
    return f"Open3D {dataset.need('open3d', 'python3-open3d').__version__}"


def fuse(data):
    """Surface points of the fused true depths and poses, without hole filling."""
    o3d = dataset.need("open3d", "python3-open3d")
    integration = o3d.pipelines.integration
    volume = integration.ScalableTSDFVolume(
        voxel_length=VOXEL_M, sdf_trunc=TRUNCATION_M,
        color_type=integration.TSDFVolumeColorType.NoColor)
    k = data.matrix(pixel_centres=True)
    camera = o3d.camera.PinholeCameraIntrinsic(data.width, data.height, k[0, 0], k[1, 1], k[0, 2],
                                               k[1, 2])
    blank = o3d.geometry.Image(np.zeros((data.height, data.width, 3), np.uint8))
    for index in range(len(data)):
        image = o3d.geometry.RGBDImage.create_from_color_and_depth(
            blank, o3d.geometry.Image(data.depth(index)), depth_scale=1.0, depth_trunc=FARTHEST_M,
            convert_rgb_to_intensity=False)
        volume.integrate(image, camera, np.linalg.inv(data.poses[index]))
    return np.asarray(volume.extract_point_cloud().points)


def nearest(points, of):
    """For each point, the index of the nearest one in `of` and its distance."""
    o3d = dataset.need("open3d", "python3-open3d")
    search = o3d.core.nns.NearestNeighborSearch(o3d.core.Tensor(np.ascontiguousarray(of)))
    search.knn_index()
    index, squared = search.knn_search(o3d.core.Tensor(np.ascontiguousarray(points)), 1)
    return index.numpy().ravel(), np.sqrt(squared.numpy().ravel())


def measure(data, request, entry):
    if entry["scene"] not in request["references"]:
        raise ValueError("the scene has no reference surface")
    reference = np.load(request["references"][entry["scene"]]).astype(np.float64)
    samples, normals = reference[:, :3], reference[:, 3:6]
    fused = fuse(data)
    if len(fused) == 0:
        return {"completion_rate": 0.0, "reference_samples": len(samples)}
    _, gaps = nearest(samples, fused)
    closest, distance = nearest(fused, samples)
    # Point-to-plane distance, because samples are centimetres apart.
    off = np.abs(np.sum((fused - samples[closest]) * normals[closest], axis=1))
    beside = distance <= BESIDE_M
    return {"completion_rate": float(np.mean(gaps <= NEAR_M)),
            "completion_cm": 100 * float(np.mean(gaps)),
            "accuracy_cm": 100 * float(np.mean(off[beside])) if beside.any() else None,
            "beyond_rate": float(np.mean(~beside)), "reference_samples": len(samples)}


if __name__ == "__main__":
    dataset.run(check, lambda request: dataset.judge_entries("surface", request, measure, METRICS))
