"""A small furnished room as an OBJ file, for tests of the whole program."""
import base64
import json
import struct


def box(name, low, high, lines, count):
    """Appends a closed box (y up, metres) as one named group; returns the new vertex count."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    corners = [(x, y, z) for x in (x0, x1) for y in (y0, y1) for z in (z0, z1)]
    lines.append(f"o {name}")
    lines += [f"v {x} {y} {z}" for x, y, z in corners]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    lines += ["f " + " ".join(str(count + i + 1) for i in face) for face in faces]
    return count + 8


def write_boxes(path, boxes):
    """An OBJ file of named boxes."""
    lines, count = [], 0
    for name, low, high in boxes:
        count = box(name, low, high, lines, count)
    with open(path, "w") as file:
        file.write("\n".join(lines) + "\n")


def write_two(path):
    """Two closed rooms, side by side and without a door."""
    write_boxes(path, [
        ("floor", (0, -0.1, 0), (8, 0, 3)),
        ("ceiling", (0, 2.6, 0), (8, 2.7, 3)),
        ("wall_1", (-0.1, 0, 0), (0, 2.6, 3)),
        ("wall_2", (4, 0, 0), (4.1, 2.6, 3)),
        ("wall_3", (0, 0, -0.1), (8, 2.6, 0)),
        ("wall_4", (0, 0, 3), (8, 2.6, 3.1)),
        ("wall_5", (8, 0, 0), (8.1, 2.6, 3)),
        ("table", (2.8, 0, 0.8), (3.6, 0.74, 2.2)),
        ("mug", (3.1, 0.74, 1.2), (3.19, 0.84, 1.29)),
        ("sofa", (0.1, 0, 0.6), (0.9, 0.7, 2.4)),
        ("picture", (1.5, 1.3, 0.0), (2.1, 1.7, 0.02)),
        ("desk", (7.0, 0, 0.8), (7.8, 0.74, 2.2)),
    ])


def write(path):
    """4 x 2.6 x 3 m with a table, a mug and a book on it, a sofa and a picture."""
    write_boxes(path, [
        ("floor", (0, -0.1, 0), (4, 0, 3)),
        ("ceiling", (0, 2.6, 0), (4, 2.7, 3)),
        ("wall_1", (-0.1, 0, 0), (0, 2.6, 3)),
        ("wall_2", (4, 0, 0), (4.1, 2.6, 3)),
        ("wall_3", (0, 0, -0.1), (4, 2.6, 0)),
        ("wall_4", (0, 0, 3), (4, 2.6, 3.1)),
        ("table", (2.8, 0, 0.8), (3.6, 0.74, 2.2)),
        ("mug", (3.1, 0.74, 1.2), (3.19, 0.84, 1.29)),
        ("book", (3.2, 0.74, 1.6), (3.42, 0.78, 1.76)),
        ("sofa", (0.1, 0, 0.6), (0.9, 0.7, 2.4)),
        ("picture", (1.5, 1.3, 0.0), (2.1, 1.7, 0.02)),
    ])


def write_as_one_mesh(path):
    """A furnished room as a glTF file of one mesh, turned so that z instead of y is up."""
    boxes = [((0, 0, -0.1), (5, 4, 0)), ((0, 0, 2.6), (5, 4, 2.7)), ((-0.1, 0, 0), (0, 4, 2.6)),
             ((5, 0, 0), (5.1, 4, 2.6)), ((0, -0.1, 0), (5, 0, 2.6)), ((0, 4, 0), (5, 4.1, 2.6)),
             ((1.8, 1.5, 0), (3.2, 2.3, 0.74)), ((2.0, 1.7, 0.74), (2.09, 1.79, 0.84)),
             ((2.5, 1.8, 0.74), (2.72, 1.96, 0.78)), ((1.2, 1.6, 0), (1.65, 2.05, 0.9)),
             ((0.2, 3.0, 0), (2.2, 3.8, 0.8)), ((4.6, 0.5, 0), (4.9, 1.5, 2.0)),
             ((1.5, 0.0, 1.3), (2.1, 0.02, 1.7))]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 5, 7, 3)]
    corners = [tuple((high if i >> axis & 1 else low)[axis] for axis in range(3))
               for low, high in boxes for i in range(8)]
    indices = [8 * box + face[i] for box in range(len(boxes)) for face in faces
               for i in (0, 1, 2, 0, 2, 3)]
    points = b"".join(struct.pack("<3f", *corner) for corner in corners)
    data = points + struct.pack(f"<{len(indices)}H", *indices)
    path.write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "all", "mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64,"
                     + base64.b64encode(data).decode()}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": len(points)},
                        {"buffer": 0, "byteOffset": len(points),
                         "byteLength": len(data) - len(points)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(corners),
                       "type": "VEC3", "min": [min(c[i] for c in corners) for i in range(3)],
                       "max": [max(c[i] for c in corners) for i in range(3)]},
                      {"bufferView": 1, "componentType": 5123, "count": len(indices),
                       "type": "SCALAR"}]}))


def move_corners(path, move):
    """Moves every vertex of an OBJ file by `move(x, y, z)`."""
    with open(path) as file:
        lines = file.read().splitlines()
    for i, line in enumerate(lines):
        if line.startswith("v "):
            lines[i] = "v %g %g %g" % move(*map(float, line.split()[1:]))
    with open(path, "w") as file:
        file.write("\n".join(lines) + "\n")
