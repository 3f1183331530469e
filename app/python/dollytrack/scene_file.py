"""Writes arrays of triangles as a scene file: GLB, with annotations that name its objects."""
from __future__ import annotations

import json
import os
import re
import struct
from pathlib import Path
from typing import Any, Dict, List, Optional, Sequence, Tuple

import numpy as np
import numpy.typing as npt

from .errors import CannotWrite, Usage, failure

_MOST = 50_000_000  # vertices, and triangles
_GREY = (204, 204, 204)
_STRUCTURE = ("wall", "floor", "ceiling", "door", "window", "doorway", "roof", "ground", "sky")


def write(file: Path, vertices: npt.ArrayLike, faces: npt.ArrayLike,
          object_ids: Optional[npt.ArrayLike], names: Optional[Sequence[str]],
          classes: Optional[Sequence[Optional[str]]], structure: Optional[npt.ArrayLike],
          colors: Optional[npt.ArrayLike]) -> Dict[str, str]:
    """See Scene.from_arrays(). Returns the class words by the names of the objects; empty without
    object_ids."""
    if object_ids is None:
        for what, given in (("names", names), ("classes", classes), ("structure", structure)):
            if given is not None:
                raise failure(Usage, "The argument has a value for each object; give object_ids, too.",
                              what)
    points = array_of(vertices, "vertices", "iuf", (None, 3))
    check_finite(points, "vertices")
    far = np.abs(points) > 1e6
    if far.any():
        raise failure(Usage, "A coordinate is beyond 1e6 m.", f"vertices[{first_row(far)}]")
    triangles = array_of(faces, "faces", "iu", (None, 3)).astype(np.int64)
    _check_range(triangles, "faces", "index", len(points) - 1)
    ids = np.zeros(len(triangles), np.int64)
    if object_ids is not None:
        ids = array_of(object_ids, "object_ids", "iu", (len(triangles),)).astype(np.int64)
    _check_range(ids, "object_ids", "id", 65534)
    count = int(ids.max()) + 1
    titles = _titles(names, count, "names") if names is not None else [
        f"object_{i}" for i in range(count)]
    kinds = _titles(classes, count, "classes") if classes is not None else [None] * count
    if len(set(titles)) != count or None in titles:
        raise failure(Usage, "Each object needs a unique name.", "names")
    words = [kind or title for kind, title in zip(kinds, titles)]
    if structure is None:
        building = [re.sub(r"[\W\d_]+$", "", word).lower() in _STRUCTURE for word in words]
    else:
        building = array_of(structure, "structure", "b", (count,)).tolist()
    colours = _colours(colors, ids, count)

    blob, gltf = bytearray(), _empty()
    # glTF has y up.
    points = np.ascontiguousarray(points[:, (0, 2, 1)] * (1, 1, -1), np.float32)
    order = np.argsort(ids, kind="stable")
    bounds = np.searchsorted(ids[order], np.arange(count + 1))
    materials: Dict[int, int] = {}
    named = []
    for one in range(count):
        mine = order[bounds[one]:bounds[one + 1]]
        if not len(mine):
            continue
        primitives = []
        for colour in np.unique(colours[mine]):
            used, corners = np.unique(triangles[mine[colours[mine] == colour]], return_inverse=True)
            if colour not in materials:
                materials[colour] = len(materials)
                gltf["materials"].append(_material(int(colour)))
            primitives.append({
                "attributes": {"POSITION": _add(gltf, blob, points[used], "VEC3", 5126, 34962)},
                "indices": _add(gltf, blob, corners.astype(np.uint32).reshape(-1), "SCALAR", 5125,
                                34963),
                "material": materials[colour]})
        gltf["nodes"].append({"name": titles[one], "mesh": len(gltf["meshes"])})
        gltf["meshes"].append({"name": titles[one], "primitives": primitives})
        named.append({"name": titles[one], "nodes": [titles[one]], "class": words[one],
                      "structure": building[one]})
    gltf["scenes"][0]["nodes"] = list(range(len(gltf["nodes"])))
    gltf["buffers"] = [{"byteLength": len(blob)}]
    annotations = {"format": "dollytrack-objects", "version": 1, "objects": named}
    beside = file.with_name(file.name + ".objects.json")
    for taken in (file, beside):
        if os.path.lexists(taken):
            raise failure(CannotWrite, "The file already exists; remove it or give another name.",
                          str(taken))
    try:
        if object_ids is not None:
            beside.write_text(json.dumps(annotations))
        unfinished = file.with_name(file.name + ".part")
        unfinished.write_bytes(_glb(gltf, bytes(blob)))
        os.replace(unfinished, file)
    except OSError as error:
        raise failure(CannotWrite, f"The file cannot be written ({error.strerror}).", str(file)) from None
    return {row["name"]: row["class"] for row in named} if object_ids is not None else {}


_TYPES = {"b": "booleans", "iu": "integers"}  # by the kinds of NumPy; others are numbers


def array_of(values: npt.ArrayLike, what: str, kinds: str, shape: Tuple[Optional[int], ...],
             most: int = _MOST) -> npt.NDArray[Any]:
    """An array of a kind and shape; None: a side from 1 to `most`. Raises Usage for others."""
    try:
        array = np.asarray(values)
    except (TypeError, ValueError):
        raise failure(Usage, "Give an array of numbers.", what) from None
    if array.dtype.kind not in kinds:
        raise failure(Usage, f"The type is {array.dtype}; it must be {_TYPES.get(kinds, 'numbers')}.",
                      what)
    fits = array.ndim == len(shape) and all(
        0 < a <= most if b is None else a == b for a, b in zip(array.shape, shape))
    if not fits:
        wanted = str(shape).replace("None", "N")
        limits = f", N from 1 to {most}" if None in shape else ""
        raise failure(Usage, f"The shape is {array.shape}; it must be {wanted}{limits}.", what)
    return array


def first_row(bad: npt.NDArray[np.bool_]) -> int:
    """The first row with a true value."""
    return int(np.argmax(bad.reshape(len(bad), -1).any(axis=1)))


def check_finite(array: npt.NDArray[Any], what: str) -> None:
    """Raises Usage with the first row that has NaN or infinity."""
    bad = ~np.isfinite(array)
    if bad.any():
        raise failure(Usage, f"A number is not finite: {array[bad][0]}.",
                      f"{what}[{first_row(bad)}]")


def _check_range(array: npt.NDArray[np.int64], what: str, noun: str, most: int) -> None:
    bad = (array < 0) | (array > most)
    if bad.any():
        raise failure(Usage, f"The {noun} {array[bad][0]} is not in the range 0 .. {most}.",
                      f"{what}[{first_row(bad)}]")


def _titles(values: Any, count: int, what: str) -> List[Any]:
    listed = [values] if isinstance(values, str) else list(values)
    if len(listed) < count:
        raise failure(Usage, f"There are {len(listed)} values for {count} objects.", what)
    for one in listed:
        if not (one is None or (isinstance(one, str) and one.isprintable() and one)):
            raise failure(Usage, "The values must be str of printable characters.", what)
    return listed[:count]


def _colours(colors: Optional[npt.ArrayLike], ids: npt.NDArray[np.int64],
             count: int) -> npt.NDArray[np.int64]:
    """One number per triangle: red, green and blue, one byte each."""
    if colors is None:
        rgb = np.tile(np.array(_GREY, np.int64), (len(ids), 1))
    else:
        given = array_of(colors, "colors", "uif", (None, 3))
        if len(given) not in (len(ids), count):
            raise failure(Usage,
                          f"There are {len(given)} colours; give one per triangle or one per object.",
                          "colors")
        if given.dtype.kind == "f":
            given = np.rint(given * 255) if np.isfinite(given).all() else given
        if not np.isfinite(given).all() or given.min() < 0 or given.max() > 255:
            raise failure(Usage, "Colours must be 0 .. 255, or floats 0 .. 1.", "colors")
        rgb = given.astype(np.int64)
        if len(given) != len(ids):
            rgb = rgb[ids]
    return (rgb[:, 0] << 16) | (rgb[:, 1] << 8) | rgb[:, 2]


def _material(colour: int) -> Dict[str, Any]:
    encoded = np.array([colour >> 16, colour >> 8 & 255, colour & 255]) / 255
    linear = np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
    return {"name": f"{colour:06x}", "doubleSided": True,
            "pbrMetallicRoughness": {"baseColorFactor": [*linear.tolist(), 1.0],
                                     "metallicFactor": 0.0, "roughnessFactor": 0.8}}


def _empty() -> Dict[str, Any]:
    return {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [],
            "meshes": [], "materials": [], "accessors": [], "bufferViews": []}


def _add(gltf: Dict[str, Any], blob: bytearray, values: npt.NDArray[Any], kind: str, component: int,
         target: int) -> int:
    gltf["bufferViews"].append({"buffer": 0, "byteOffset": len(blob), "byteLength": values.nbytes,
                                "target": target})
    accessor = {"bufferView": len(gltf["bufferViews"]) - 1, "componentType": component,
                "count": len(values), "type": kind}
    if kind == "VEC3":
        accessor["min"] = values.min(axis=0).tolist()
        accessor["max"] = values.max(axis=0).tolist()
    blob += values.tobytes()
    gltf["accessors"].append(accessor)
    return len(gltf["accessors"]) - 1


def _glb(gltf: Dict[str, Any], blob: bytes) -> bytes:
    text = json.dumps(gltf).encode()
    text += b" " * (-len(text) % 4)
    blob += b"\0" * (-len(blob) % 4)
    return (struct.pack("<III", 0x46546C67, 2, 28 + len(text) + len(blob))
            + struct.pack("<II", len(text), 0x4E4F534A) + text
            + struct.pack("<II", len(blob), 0x004E4942) + blob)
