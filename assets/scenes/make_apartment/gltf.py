"""Writes a scene as one binary glTF 2.0 file: y up, pictures inside, one node an object."""

import hashlib
import json
import math
import struct
import zlib

import cv2
import numpy as np

from surfaces.materials import MATERIALS, PICTURES

JPEG_QUALITY = 75
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963


class _Buffer:
    """The binary chunk. All accessors of one kind share a view: it keeps the JSON short."""

    def __init__(self):
        self.pictures = []
        self.arrays = {}  # (kind, component, target) -> chunks
        self.accessors = []

    def picture(self, payload):
        self.pictures.append(payload)
        return len(self.pictures) - 1  # pictures have the first views

    def accessor(self, array, kind, component, target, bounds=False):
        chunks = self.arrays.setdefault((kind, component, target), [])
        offset = sum(len(c) for c in chunks)
        data = array.tobytes()
        chunks.append(data + b"\0" * (-len(data) % 4))
        entry = {
            "bufferView": list(self.arrays).index((kind, component, target)),
            "byteOffset": offset,
            "componentType": component,
            "count": len(array),
            "type": kind,
        }
        if bounds:
            entry["min"] = [float(str(v)) for v in array.min(axis=0)]  # the shortest
            entry["max"] = [float(str(v)) for v in array.max(axis=0)]
        self.accessors.append(entry)
        return len(self.accessors) - 1

    def packed(self):
        """The bytes and the views over them; accessors then know their view's number."""
        data, views = bytearray(), []
        for payload in self.pictures:
            data += b"\0" * (-len(data) % 4)
            views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(payload)})
            data += payload
        for (kind, component, target), chunks in self.arrays.items():
            data += b"\0" * (-len(data) % 4)
            views.append(
                {
                    "buffer": 0,
                    "byteOffset": len(data),
                    "byteLength": sum(len(c) for c in chunks),
                    "target": target,
                }
            )
            if target == ARRAY_BUFFER:
                views[-1]["byteStride"] = {"VEC3": 12, "VEC2": 8}[kind]
            for chunk in chunks:
                data += chunk
        for entry in self.accessors:
            entry["bufferView"] += len(self.pictures)
        data += b"\0" * (-len(data) % 4)
        return bytes(data), views


def linear(text):
    """Linear factors of an sRGB "#rrggbb"."""
    values = [int(text[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    return [round(v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4, 5) for v in values]


def glb(scene):
    """The file's bytes. The same scene gives the same bytes."""
    buffer = _Buffer()
    used = sorted({part.material for thing in scene.things.values() for part in thing.model.parts})
    images, textures = [], {}
    for picture in sorted({MATERIALS[m].picture for m in used if MATERIALS[m].picture}):
        textures[picture] = len(images)
        images.append(
            {
                "name": picture,
                "mimeType": "image/jpeg",
                "bufferView": buffer.picture(_jpeg(PICTURES[picture]())),
            }
        )
    materials = [_material(name, textures) for name in used]
    index = {name: i for i, name in enumerate(used)}
    meshes, nodes, known = [], [], {}
    for thing in scene.things.values():
        key = _fingerprint(thing.model)
        if key not in known:
            known[key] = len(meshes)
            meshes.append(
                {
                    "name": thing.name,
                    "primitives": [
                        _primitive(buffer, part, index, thing.name)
                        for part in thing.model.by_material()
                    ],
                }
            )
        x, y, z = thing.position
        node = {
            "name": thing.name,
            "mesh": known[key],
            "translation": [round(x, 5), round(z, 5), round(-y, 5)],
        }
        if thing.turn % 360:
            half = math.radians(thing.turn) / 2
            node["rotation"] = [0.0, round(math.sin(half), 9), 0.0, round(math.cos(half), 9)]
        nodes.append(node)
    data, views = buffer.packed()
    document = {
        "asset": {"version": "2.0", "generator": "Dollytrack make_apartment"},
        "scene": 0,
        "scenes": [{"name": "apartment", "nodes": list(range(len(nodes)))}],
        "nodes": nodes,
        "meshes": meshes,
        "materials": materials,
        "textures": [{"sampler": 0, "source": i} for i in range(len(images))],
        "images": images,
        "samplers": [{"magFilter": 9729, "minFilter": 9987, "wrapS": 10497, "wrapT": 10497}],
        "accessors": buffer.accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": len(data)}],
    }
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    total = 12 + 8 + len(text) + 8 + len(data)
    return (
        struct.pack("<4sII", b"glTF", 2, total)
        + struct.pack("<I4s", len(text), b"JSON")
        + text
        + struct.pack("<I4s", len(data), b"BIN\0")
        + data
    )


def _jpeg(picture):
    pixels = np.clip(np.floor(picture * 255 + 0.5), 0, 255).astype(np.uint8)
    if max(pixels.shape[:2]) > 512:
        raise ValueError(f"picture of {pixels.shape[1]} x {pixels.shape[0]} px: at most 512")
    done, data = cv2.imencode(".jpg", pixels[..., ::-1], [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY])
    if not done:
        raise RuntimeError("OpenCV could not write a JPEG")
    return data.tobytes()


def _material(name, textures):
    m = MATERIALS[name]
    surface = {
        "baseColorFactor": linear(m.tint) + [m.opacity],
        "metallicFactor": m.metallic,
        "roughnessFactor": m.roughness,
    }
    entry = {"name": name, "pbrMetallicRoughness": surface}
    if m.picture:
        surface["baseColorTexture"] = {"index": textures[m.picture]}
    if m.glow:
        entry["emissiveFactor"] = linear(m.glow)
        if m.picture:
            entry["emissiveTexture"] = {"index": textures[m.picture]}
    if m.opacity < 1:
        entry["alphaMode"] = "BLEND"
    return entry


def _settled(values, step):
    """Rounded to a grid a little off the usual one, so that another processor's last bit does
    not show in the file."""
    return (np.floor(values / step + 0.5003) * step).astype(np.float32)


def _fingerprint(model):
    """Equal for equal models: two mugs of one kind share a mesh."""
    digest = hashlib.sha256()
    for part in model.parts:
        digest.update(part.material.encode())
        for array in (part.positions, part.uvs, part.triangles):
            digest.update(np.ascontiguousarray(array).tobytes())
    return digest.digest()


def _primitive(buffer, part, index, name):
    material = MATERIALS[part.material]
    uv = part.uvs / np.array(material.tile_m) * bool(material.picture)
    if material.tile_m != (1.0, 1.0) and material.wander:
        shift = zlib.crc32(f"{name}/{part.material}".encode())
        uv = uv + np.array([(shift & 1023) / 1024, (shift >> 10 & 1023) / 1024])
    corners = np.column_stack(
        [
            _settled(part.positions[:, [0]], 1e-5),
            _settled(part.positions[:, [2]], 1e-5),
            _settled(-part.positions[:, [1]], 1e-5),
            _settled(part.normals[:, [0]], 1e-4),
            _settled(part.normals[:, [2]], 1e-4),
            _settled(-part.normals[:, [1]], 1e-4),
            _settled(uv[:, [0]], 1e-4),
            _settled(1 - uv[:, [1]], 1e-4),
        ]
    ) + np.float32(0)
    _, first, place = np.unique(corners, axis=0, return_index=True, return_inverse=True)
    order = np.argsort(first)
    rank = np.empty(len(order), dtype=np.int64)
    rank[order] = np.arange(len(order))
    corners = corners[first[order]]
    triangles = rank[place.reshape(-1)][part.triangles].reshape(-1, 1)
    normals = corners[:, 3:6]
    normals = (normals / np.linalg.norm(normals, axis=1, keepdims=True)).astype(np.float32)
    wide = len(corners) > 65535
    indices = triangles.astype(np.uint32 if wide else np.uint16)
    attributes = {
        "POSITION": buffer.accessor(
            np.ascontiguousarray(corners[:, :3]), "VEC3", 5126, ARRAY_BUFFER, bounds=True
        ),
        "NORMAL": buffer.accessor(normals, "VEC3", 5126, ARRAY_BUFFER),
    }
    if material.picture:
        attributes["TEXCOORD_0"] = buffer.accessor(
            np.ascontiguousarray(corners[:, 6:]), "VEC2", 5126, ARRAY_BUFFER
        )
    return {
        "attributes": attributes,
        "indices": buffer.accessor(indices, "SCALAR", 5125 if wide else 5123, ELEMENT_ARRAY_BUFFER),
        "material": index[part.material],
    }
