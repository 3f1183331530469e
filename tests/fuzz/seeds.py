"""Writes small valid inputs as seeds for the fuzzers. Usage: seeds.py FOLDER"""
import json
import pathlib
import struct
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "app"))
from support import small_models  # noqa: E402

ROOT = pathlib.Path(sys.argv[1])
FORMATS = 10


def write(kind, name, data):
    folder = ROOT / kind
    folder.mkdir(parents=True, exist_ok=True)
    (folder / name).write_bytes(data)


project = {"dollytrack_project": 1, "scene": {"path": "room.glb", "sha256": "0" * 64},
           "import": {"unit_m": 1.0, "up_axis": "y", "labels": "a.csv"},
           "parameters": {"fill": 0.5}, "edits": {"scene": {"ignore": ["chair"]}}, "result": None}
write("project", "small", json.dumps(project).encode())
write("labels", "small", b"# words\nsofa,sofa\ncoffee table,table,target\nleg,,part\n")
head = b"ply\nformat %s 1.0\nelement vertex 2\nproperty float x\nproperty float y\n" \
       b"property float z\nelement face 1\nproperty list uchar int v\nend_header\n"
write("ply_points", "text", head % b"ascii" + b"0 0 0\n1 2 3\n3 0 1 1\n")
write("ply_points", "binary", head % b"binary_little_endian" + struct.pack("<6f", *range(6)))
texts = {"tum": b"# t\n0.0 0 0 0 0 0 0 1\n0.1 1 0 0 0 0 0 1\n",
         "kitti": b"1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 1 0 1 0 0 0 0 1 0\n",
         "colmap": b"1 1 0 0 0 0 0 0 1 a.png\n\n2 1 0 0 0 1 0 0 1 b.png\n\n",
         "json": json.dumps([{"pos": [0, 0, 1], "target": [1, 0, 1], "fov": 60}]).encode(),
         "frames": json.dumps({"camera_angle_x": 1, "frames": [
             {"file_path": "a", "transform_matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0],
                                                     [0, 0, 0, 1]]}]}).encode()}
for name, text in texts.items():
    for kind in range(FORMATS):
        write("trajectory", f"{name}{kind}", bytes([kind]) + text)
for number, make in enumerate([small_models.world, small_models.urdf,
                               small_models.material_script]):
    write("gazebo", make.__name__, bytes([number]) + make())
write("gazebo", "hall", b"\0" + small_models.hall())
for make in (small_models.scene_instance, small_models.dataset_config, small_models.object_config):
    write("habitat", make.__name__, make())
for form in ("ascii", "binary_little_endian"):
    write("labelled_ply", form, small_models.labelled_ply(form))
write("front3d", "small", small_models.front3d())
for name in ("room.gltf", "room.glb", "draco.glb", "sequential.glb", "meshopt.glb"):
    write("gltf", name, small_models.SEEDS[name]())
write("scenenet", "small", small_models.scenenet())
write("home", "xml", small_models.home_xml())
write("home", "archive", small_models.sh3d())
write("scene_serialization", "zeros", bytes(200))
write("scene_serialization", "one_node", struct.pack("<QQ4sii", 1, 4, b"room", -1, 0) + bytes(180))
