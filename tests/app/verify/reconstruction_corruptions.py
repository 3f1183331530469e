"""Damages files for reconstruction and viewers: camera.json, transforms.json, COLMAP and glTF."""
import json
import struct

from corruptions import found_by


# --- camera.json

@found_by("camera_json")
def vertical_field_of_view(copy):
    def lower(root):
        for entry in root:
            entry["fov"] *= entry["height"] / entry["width"]
    copy.edit_json("camera.json", lower)


@found_by("camera_json")
def far_plane_inside_the_room(copy):
    copy.edit_json("camera.json", lambda root: root[0].update(far=2.0))


@found_by("camera_json")
def targets_of_another_frame(copy):
    def move(root):
        targets = [entry["targets"] for entry in root]
        for entry, other in zip(root, targets[1:] + targets[:1]):
            entry["targets"] = other
    copy.edit_json("camera.json", move)


# --- transforms.json

@found_by("transforms")
def pictures_of_the_next_frame(copy):
    def move(root):
        names = [frame["file_path"] for frame in root["frames"]]
        for frame, other in zip(root["frames"], names[1:] + names[:1]):
            frame["file_path"] = other
    copy.edit_json("transforms.json", move)


@found_by("poses")
def matrix_that_is_no_rotation(copy):
    def stretch(root):
        root["frames"][1]["transform_matrix"][0][0] += 0.001
    copy.edit_json("transforms.json", stretch)


@found_by("transforms")
def principal_point_of_other_pixels(copy):
    copy.edit_json("transforms.json", lambda root: root.update(cx=root["cx"] - 0.5))


@found_by("transforms")
def room_beyond_the_unit_cube(copy):
    copy.edit_json("transforms_ngp.json", lambda root: root.update(scale=3 * root["scale"]))


@found_by("transforms")
def depth_of_the_first_frame(copy):
    def first(root):
        for frame in root["frames"]:
            frame["depth_path"] = "depth/000000.png"
    copy.edit_json("transforms_ngp.json", first)


# --- COLMAP

@found_by("colmap")
def colmap_focal_lengths_of_another_size(copy):
    def halve(rows):
        rows[-1][4] = str(float(rows[-1][4]) / 2)
    copy.edit_lines("sparse/0/cameras.txt", halve)


@found_by("colmap")
def colmap_pictures_exchanged(copy):
    def exchange(rows):
        rows[2][9], rows[4][9] = rows[4][9], rows[2][9]
    copy.edit_lines("sparse/0/images.txt", exchange)


@found_by("colmap")
def points_before_the_surfaces(copy):
    """Moves each point halfway to the middle of the room: visible, but not on a surface."""
    def shrink(rows):
        for row in rows[1:]:
            for axis, middle in ((1, 2.0), (2, -1.5), (3, 1.3)):
                row[axis] = f"{(float(row[axis]) + middle) / 2:.9f}"
    copy.edit_lines("sparse/0/points3D.txt", shrink)


@found_by("colmap")
def points_in_other_axes(copy):
    def exchange(rows):
        for row in rows[1:]:
            row[2], row[3] = row[3], row[2]
    copy.edit_lines("sparse/0/points3D.txt", exchange)


# --- glTF

def edit_glb(copy, function):
    """Edits the JSON and the binary part of trajectory.glb."""
    path = copy.folder / "trajectory.glb"
    data = path.read_bytes()
    length, = struct.unpack_from("<I", data, 12)
    root, binary = json.loads(data[20:20 + length]), bytearray(data[28 + length:])
    function(root, binary)
    text = json.dumps(root).encode()
    text += b" " * (-len(text) % 4)
    whole = struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary))
    whole += struct.pack("<I4s", len(text), b"JSON") + text
    path.write_bytes(whole + struct.pack("<I4s", len(binary), b"BIN\0") + bytes(binary))


def keys_of_camera(root, path):
    """Start of the floats of the camera's channel in the binary part, and their number."""
    camera = next(i for i, node in enumerate(root["nodes"]) if "camera" in node)
    animation = root["animations"][0]
    channel = next(one for one in animation["channels"]
                   if one["target"] == {"node": camera, "path": path})
    accessor = root["accessors"][animation["samplers"][channel["sampler"]]["output"]]
    return root["bufferViews"][accessor["bufferView"]].get("byteOffset", 0), accessor["count"]


@found_by("gltf")
def gltf_camera_in_our_axes(copy):
    def swap(root, binary):
        begin, count = keys_of_camera(root, "translation")
        for i in range(count):
            x, y, z = struct.unpack_from("<fff", binary, begin + 12 * i)
            struct.pack_into("<fff", binary, begin + 12 * i, x, -z, y)
    edit_glb(copy, swap)


@found_by("gltf")
def gltf_camera_looks_back(copy):
    def turn(root, binary):
        begin, _ = keys_of_camera(root, "rotation")
        x, y, z, w = struct.unpack_from("<ffff", binary, begin)
        struct.pack_into("<ffff", binary, begin, -z, w, x, -y)
    edit_glb(copy, turn)


@found_by("gltf")
def gltf_field_of_view_of_the_width(copy):
    def widen(root, binary):
        root["cameras"][0]["perspective"]["yfov"] *= 4 / 3
    edit_glb(copy, widen)
