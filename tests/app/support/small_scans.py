"""Small undamaged scans, label files and pictures of further kinds, for tests that damage them, in
the form of small_models.SCENES."""
import json
import struct

from support import small_models
from support.small_models import CORNERS, QUADS, SIDES, TRIANGLES

STEPS = 10  # points along an edge of a side of the scanned room


def points():
    """Points on the six sides of the room, which is scaled to about 2 m."""
    found = []
    for a, b, c, d in QUADS:
        for i in range(STEPS):
            for j in range(STEPS):
                u, v = (i + 0.5) / STEPS, (j + 0.5) / STEPS
                found.append(tuple(
                    0.5 * ((1 - u) * (1 - v) * CORNERS[a][k] + u * (1 - v) * CORNERS[b][k] +
                           u * v * CORNERS[c][k] + (1 - u) * v * CORNERS[d][k]) for k in range(3)))
    return found


def _ply_head(form, *properties):
    lines = [f"property {p}" for p in properties]
    return "\n".join(["ply", f"format {form} 1.0", f"element vertex {6 * STEPS ** 2}", *lines,
                      "end_header\n"]).encode()


def points_ply():
    head = _ply_head("binary_little_endian", "float x", "float y", "float z", "uchar red",
                     "uchar green", "uchar blue")
    return head + b"".join(struct.pack("<3f3B", *p, 200, 150, 100) for p in points())


def splats_ply():
    names = ["x", "y", "z", "f_dc_0", "f_dc_1", "f_dc_2", "opacity", "scale_0", "scale_1",
             "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"]
    head = _ply_head("binary_little_endian", *[f"float {name}" for name in names])
    return head + b"".join(struct.pack("<14f", *p, 0.5, 0.2, 0.1, 3, -4, -4, -4, 1, 0, 0, 0)
                           for p in points())


def pcd(data="binary"):
    count = 6 * STEPS ** 2
    head = (f"# .PCD v0.7\nVERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\n"
            f"COUNT 1 1 1 1\nWIDTH {count}\nHEIGHT 1\nVIEWPOINT 1 1 1 1 0 0 0\nPOINTS {count}\n"
            f"DATA {data}\n").encode()
    if data == "ascii":
        return head + "".join("%g %g %g 8421504\n" % p for p in points()).encode()
    if data == "binary":
        return head + b"".join(struct.pack("<3fI", *p, 8421504) for p in points())
    columns = b"".join(struct.pack("<f", p[k]) for k in range(3) for p in points())
    columns += struct.pack("<I", 8421504) * count
    # LZF without any repetition: blocks of up to 32 bytes, each after its length minus one.
    blocks = [columns[i:i + 32] for i in range(0, len(columns), 32)]
    packed = b"".join(bytes([len(block) - 1]) + block for block in blocks)
    return head + struct.pack("<II", len(packed), len(columns)) + packed


def text_points():
    return "".join("%.3f %.3f %.3f 200 150 100\n" % p for p in points()).encode()


def colored_glb():
    """The room of unconnected triangles; the vertices of each side have its label's colour."""
    corners = [CORNERS[v] for t in TRIANGLES for v in t]
    positions = b"".join(struct.pack("<3f", *c) for c in corners)
    colors = b"".join(bytes([40 * (i // 6), 0, 255, 255]) for i in range(len(corners)))
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "COLOR_0": 1}}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 36, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5121, "normalized": True, "count": 36,
             "type": "VEC4"}],
        "bufferViews": [{"buffer": 0, "byteLength": len(positions)},
                        {"buffer": 0, "byteOffset": len(positions), "byteLength": len(colors)}],
        "buffers": [{"byteLength": len(positions) + len(colors)}]}
    return small_models.container(document, positions + colors)


def color_names():
    lines = ["HM3D Semantic Annotations"]
    lines += [f'{i + 1},{40 * i:02X}00FF,"{name}",0' for i, name in enumerate(SIDES)]
    return "\n".join(lines).encode() + b"\n"


def mended_obj():
    """An OBJ file with the flaws that are mended before it is read."""
    lines = ["mtllib room.mtl", "o room"] + ["v %g %g %g" % c for c in CORNERS]
    lines[3] = "v 5 0. .0"
    lines[4] = "  " + lines[4]
    lines += ["vt .5 -.5", "vt 1 0", "vt 1 1", "vn 0 0 1", "usemtl oak"]
    faces = ["f " + " ".join(f"{v + 1}/1/1" for v in q) for q in QUADS]
    faces[1] = faces[1].replace("/1/", "/0/")
    faces[2] = faces[2].replace("/1/", "/9/")
    return "\n".join(lines + faces).encode() + b"\n"


def gltf_beside():
    """A glTF file with a buffer and an image as files beside it; also the buffer's bytes."""
    document, data = small_models.gltf_json("room.bin")
    document["images"] = [{"uri": "oak.png"}]
    return json.dumps(document).encode(), data


def picture(ending):
    import cv2
    import numpy
    pixels = numpy.random.default_rng(1).integers(0, 256, (16, 16, 3), dtype=numpy.uint8)
    if ending == ".tga":
        return struct.pack("<3B2xHB4HBB", 0, 0, 2, 0, 0, 0, 0, 16, 16, 24, 0) + pixels.tobytes()
    if ending == ".hdr":
        pixels = pixels.astype(numpy.float32) / 255
    return cv2.imencode(ending, pixels)[1].tobytes()


PICTURES = [".png", ".jpg", ".webp", ".tiff", ".bmp", ".ppm", ".hdr", ".tga"]


def segments():
    return json.dumps({"segIndices": [0, 0, 0, 0, 1, 1, 1, 1]}).encode()


def segment_groups():
    return json.dumps({"segGroups": [{"id": 1, "objectId": 1, "label": "floor", "segments": [0]},
                                     {"id": 2, "objectId": 2, "label": "ceiling",
                                      "segments": [1]}]}).encode()


def object_names():
    return json.dumps({str(i): name for i, name in enumerate(SIDES)}).encode()


def write_beside(folder):
    """Writes the other files that the scenes below need."""
    files = {"mended/room.mtl": small_models.mtl(), "mended/oak.png": small_models.png(),
             "beside/room.gltf": gltf_beside()[0], "beside/room.bin": gltf_beside()[1],
             "beside/oak.png": small_models.png(),
             "hm3d/a.semantic.glb": colored_glb(), "hm3d/a.semantic.txt": color_names(),
             "hm3d/a.basis.glb": small_models.glb(),
             "scannetpp/mesh_aligned_0.05.ply": small_models.ply(),
             "scannetpp/segments.json": segments(),
             "scannetpp/segments_anno.json": segment_groups(),
             "named/a.ply": small_models.labelled_ply(), "named/a.labels.json": object_names()}
    for ending in PICTURES:
        name = "pictures/" + ending[1:]
        files[name + ".obj"] = small_models.obj().replace(b"room.mtl", ending[1:].encode() + b".mtl")
        files[name + ".mtl"] = small_models.mtl().replace(b"oak.png", b"oak" + ending.encode())
        files["pictures/oak" + ending] = picture(ending)
    for name, data in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)


# As in small_models.SCENES.
SCENES = [
    ("points.ply", points_ply, None, None), ("splats.ply", splats_ply, None, None),
    ("text.pcd", lambda: pcd("ascii"), None, None), ("binary.pcd", pcd, None, None),
    ("packed.pcd", lambda: pcd("binary_compressed"), None, None),
    ("points.xyz", text_points, None, None),
    ("mended/room.obj", mended_obj, "mended/room.obj", 12),
    ("beside/room.gltf", lambda: gltf_beside()[0], "beside/room.gltf", 12),
    ("beside/room.bin", lambda: gltf_beside()[1], "beside/room.gltf", 12),
    ("hm3d/a.semantic.glb", colored_glb, "hm3d/a.basis.glb", 12),
    ("hm3d/a.semantic.txt", color_names, "hm3d/a.basis.glb", 12),
    ("scannetpp/segments.json", segments, "scannetpp/mesh_aligned_0.05.ply", 12),
    ("scannetpp/segments_anno.json", segment_groups, "scannetpp/mesh_aligned_0.05.ply", 12),
    ("named/a.labels.json", object_names, "named/a.ply", 12)]
SCENES += [(f"pictures/oak{ending}", lambda ending=ending: picture(ending),
            f"pictures/{ending[1:]}.obj", 12) for ending in PICTURES]
