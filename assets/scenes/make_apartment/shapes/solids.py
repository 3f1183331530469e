"""Hard things: bevelled boxes, turned, extruded and swept shapes. All are closed."""

import functools
import math

import numpy as np

from shapes.mesh import Model, Part, without_slivers


@functools.lru_cache(maxsize=None)
def _box_topology():
    """Corners of the six faces as (axis, sign, sign_b, sign_c), and triangles over them."""
    corners, faces = [], []
    for axis in range(3):
        for sign in (-1, 1):
            for sb, sc in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                signs = [0, 0, 0]
                signs[axis], signs[(axis + 1) % 3], signs[(axis + 2) % 3] = sign, sb, sc
                corners.append((axis, tuple(signs)))
            quad = list(range(len(corners) - 4, len(corners)))
            faces.append(quad if sign > 0 else quad[::-1])
    index = {corner: i for i, corner in enumerate(corners)}
    polygons = list(faces)
    for a in range(3):
        b, c = (a + 1) % 3, (a + 2) % 3
        for sa in (-1, 1):
            for sb in (-1, 1):

                def corner(axis, sc):
                    signs = [0, 0, 0]
                    signs[a], signs[b], signs[c] = sa, sb, sc
                    return index[(axis, tuple(signs))]

                quad = [corner(a, -1), corner(b, -1), corner(b, 1), corner(a, 1)]
                polygons.append(quad if sa * sb > 0 else quad[::-1])
    for signs in [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]:
        tri = [index[(axis, signs)] for axis in range(3)]
        polygons.append(tri if signs[0] * signs[1] * signs[2] > 0 else tri[::-1])
    triangles = []
    for p in polygons:
        triangles += [(p[0], p[i], p[i + 1]) for i in range(1, len(p) - 1)]
    return corners, np.array(triangles[:12]), np.array(triangles)


def box(material, sx, sy, sz, bevel=0.003, grain=None):
    """Stands on z = 0, centred over the origin. The bevel shades like a rounded edge.

    The texture's u axis (the grain of wood) runs along the longest side, or along `grain`.
    """
    size = np.array([sx, sy, sz], dtype=np.float64)
    bevel = min(bevel, 0.45 * float(size.min()))
    corners, plain, bevelled = _box_topology()
    grain = int(np.argmax(size)) if grain is None else "xyz".index(grain)
    positions, normals, uvs = [], [], []
    for axis, signs in corners:
        signs = np.array(signs, dtype=np.float64)
        inset = np.full(3, bevel)
        inset[axis] = 0.0
        position = signs * (size / 2 - inset)
        normal = np.zeros(3)
        normal[axis] = signs[axis]
        b, c = (axis + 1) % 3, (axis + 2) % 3
        u, v = (b, c) if b == grain or (c != grain and size[b] >= size[c]) else (c, b)
        positions.append(position)
        normals.append(normal)
        uvs.append((position[u], position[v]))
    positions = np.array(positions) + np.array([0, 0, sz / 2])
    return Model([Part(material, positions, normals, uvs, bevelled if bevel > 0 else plain)])


def slab(material, low, high, bevel=0.0, grain=None):
    """A box between two corners, textured by its place in the room so that neighbours match."""
    low, high = np.array(low, dtype=np.float64), np.array(high, dtype=np.float64)
    size, centre = high - low, (high + low) / 2
    model = box(material, *size, bevel=bevel, grain=grain).moved(centre[0], centre[1], low[2])
    if grain is not None:
        return model
    part = model.parts[0]
    axis = np.argmax(np.abs(part.normals), axis=1)
    flat = {0: (1, 2), 1: (0, 2), 2: (0, 1)}
    part.uvs = np.array([p[list(flat[a])] for p, a in zip(part.positions, axis)])
    return model


def lathe(material, profile, segments=24, sharp_deg=35.0):
    """Turns a profile of (radius, z) around z. Walk it with the air on the right-hand side:
    from the middle of the underside outwards, up the outside, and back to the axis."""
    profile = [np.array(p, dtype=np.float64) for p in profile]
    edges = [(b - a) / np.linalg.norm(b - a) for a, b in zip(profile, profile[1:])]
    outward = [np.array([e[1], -e[0]]) for e in edges]
    strips = []
    length = 0.0
    for i, edge in enumerate(edges):
        ends = []
        for j, at in ((i, profile[i]), (i + 1, profile[i + 1])):
            neighbour = i - 1 if j == i else i + 1
            normal = outward[i]
            if 0 <= neighbour < len(edges):
                if np.dot(outward[i], outward[neighbour]) > math.cos(math.radians(sharp_deg)):
                    normal = normal + outward[neighbour]
            ends.append((at, normal / np.linalg.norm(normal)))
        reach = float(np.linalg.norm(profile[i + 1] - profile[i]))
        strips.append((ends[0], ends[1], length, length + reach))
        length += reach
    widest = max(p[0] for p in profile)
    segments = min(segments, int(10 + 210 * widest))  # small things need no more
    angle = np.linspace(0, 2 * math.pi, segments + 1)
    angle[-1] = 0.0  # the seam closes exactly
    ring = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    positions, all_normals, uvs, triangles = [], [], [], []
    for (a, na), (b, nb), va, vb in strips:
        start = sum(len(p) for p in positions)
        for at, n, v in ((a, na, va), (b, nb, vb)):
            positions.append(np.column_stack([ring * at[0], np.full(segments + 1, at[1])]))
            all_normals.append(np.column_stack([ring * n[0], np.full(segments + 1, n[1])]))
            turn = np.linspace(0, 2 * math.pi * widest, segments + 1)
            uvs.append(np.column_stack([turn, np.full(segments + 1, v)]))
        k = np.arange(segments) + start
        triangles.append(np.stack([k, k + 1, k + segments + 2], axis=1))
        triangles.append(np.stack([k, k + segments + 2, k + segments + 1], axis=1))
    positions = np.concatenate(positions)
    triangles = without_slivers(positions, np.concatenate(triangles))
    return Model(
        [Part(material, positions, np.concatenate(all_normals), np.concatenate(uvs), triangles)]
    )


def cylinder(material, radius, height, segments=24, bevel=0.002, base=0.0):
    b = min(bevel, radius * 0.4, height * 0.4)
    if b <= 0:
        profile = [(0, 0), (radius, 0), (radius, height), (0, height)]
    else:
        profile = [
            (0, 0),
            (radius - b, 0),
            (radius, b),
            (radius, height - b),
            (radius - b, height),
            (0, height),
        ]
    return lathe(material, profile, segments, sharp_deg=50.0).moved(z=base)


def rod(material, start, end, radius, end_radius=None, segments=8):
    """A straight bar between two points, round in section."""
    return tube(
        material, [start, end], [radius, radius if end_radius is None else end_radius], segments
    )


def tube(material, path, radius, segments=10, closed=False):
    """Sweeps a circle along a path; the radius may change from point to point."""
    path = np.array(path, dtype=np.float64)
    count = len(path)
    radii = np.full(count, radius) if np.isscalar(radius) else np.array(radius, dtype=np.float64)
    if closed:
        ahead, behind = np.roll(path, -1, axis=0), np.roll(path, 1, axis=0)
    else:
        ahead = np.concatenate([path[1:], path[-1:]])
        behind = np.concatenate([path[:1], path[:-1]])
    tangents = ahead - behind
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    across = np.cross(tangents[0], [0.0, 0.0, 1.0])
    if np.linalg.norm(across) < 1e-3:
        across = np.cross(tangents[0], [0.0, 1.0, 0.0])
    angle = np.linspace(0, 2 * math.pi, segments + 1)
    angle[-1] = 0.0
    positions, normals, uvs = [], [], []
    along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    for i in range(count):
        across = across - tangents[i] * np.dot(across, tangents[i])
        across /= np.linalg.norm(across)
        up = np.cross(tangents[i], across)
        ring = np.outer(np.cos(angle), across) + np.outer(np.sin(angle), up)
        positions.append(path[i] + ring * radii[i])
        normals.append(ring)
        turn = np.linspace(0, 2 * math.pi * radii.max(), segments + 1)
        uvs.append(np.column_stack([np.full(segments + 1, along[i]), turn]))
    triangles = []
    row = segments + 1
    for i in range(count if closed else count - 1):
        a, b = i * row, ((i + 1) % count) * row
        for k in range(segments):
            triangles += [(a + k, a + k + 1, b + k + 1), (a + k, b + k + 1, b + k)]
    if not closed and radii.max() > 0.0045:  # a stalk's ends are in the soil and in its leaf
        for i, sign in ((0, -1), (count - 1, 1)):
            start = sum(len(p) for p in positions)
            ring = positions[i][:-1]
            positions.append(np.concatenate([[path[i]], ring]))
            normals.append(np.tile(sign * tangents[i], (len(ring) + 1, 1)))
            uvs.append(np.zeros((len(ring) + 1, 2)))
            for k in range(segments):
                a, b = start + 1 + k, start + 1 + (k + 1) % segments
                triangles.append((start, a, b) if sign > 0 else (start, b, a))
    positions = np.concatenate(positions)
    triangles = without_slivers(positions, np.array(triangles))
    return Model(
        [Part(material, positions, np.concatenate(normals), np.concatenate(uvs), triangles)]
    )


def extrude(material, outline, height, bevel=0.0, sharp_deg=35.0):
    """Raises a counter-clockwise outline (no holes) from z = 0 to `height`."""
    outline = np.array(outline, dtype=np.float64)
    count = len(outline)
    edge = np.roll(outline, -1, axis=0) - outline
    edge_normal = np.column_stack([edge[:, 1], -edge[:, 0]])
    edge_normal /= np.linalg.norm(edge_normal, axis=1, keepdims=True)
    before = np.roll(edge_normal, 1, axis=0)
    mitre = edge_normal + before
    mitre /= np.maximum(np.sum(mitre * edge_normal, axis=1, keepdims=True), 0.3)
    inset = outline - mitre * bevel
    smooth = np.sum(edge_normal * before, axis=1) > math.cos(math.radians(sharp_deg))
    positions, normals, uvs, triangles = [], [], [], []
    caps = _ear_clip(inset)
    for z, sign in ((0.0, -1), (height, 1)):
        start = len(positions)
        for p in inset:
            positions.append((p[0], p[1], z))
            normals.append((0, 0, sign))
            uvs.append((p[0], p[1]))
        triangles += [
            (start + a, start + b, start + c) if sign > 0 else (start + a, start + c, start + b)
            for a, b, c in caps
        ]
    along = np.concatenate([[0], np.cumsum(np.linalg.norm(edge, axis=1))])
    for i in range(count):
        j = (i + 1) % count
        start = len(positions)
        for k, u in ((i, along[i]), (j, along[i + 1])):
            n = edge_normal[i]
            if smooth[k]:
                n = edge_normal[i] + (before[k] if k == i else edge_normal[k])
                n = n / np.linalg.norm(n)
            for z in (bevel, height - bevel):
                positions.append((outline[k][0], outline[k][1], z))
                normals.append((n[0], n[1], 0))
                uvs.append((u, z))
        triangles += [(start, start + 2, start + 3), (start, start + 3, start + 1)]
        if bevel > 0:
            triangles += [
                (i, start + 2, start),
                (i, j, start + 2),
                (start + 1, start + 3, count + j),
                (start + 1, count + j, count + i),
            ]
    positions = np.array(positions)
    return Model(
        [Part(material, positions, normals, uvs, without_slivers(positions, np.array(triangles)))]
    )


def _ear_clip(outline):
    left = list(range(len(outline)))
    triangles = []

    def area(a, b, c):
        return (outline[b][0] - outline[a][0]) * (outline[c][1] - outline[a][1]) - (
            outline[b][1] - outline[a][1]
        ) * (outline[c][0] - outline[a][0])

    while len(left) > 3:
        for i, b in enumerate(left):
            a, c = left[i - 1], left[(i + 1) % len(left)]
            if area(a, b, c) <= 1e-14:
                continue
            if any(
                area(a, b, p) >= 0 and area(b, c, p) >= 0 and area(c, a, p) >= 0
                for p in left
                if p not in (a, b, c)
            ):
                continue
            triangles.append((a, b, c))
            left.pop(i)
            break
        else:
            raise ValueError("outline crosses itself or runs clockwise")
    return triangles + [tuple(left)]


def rounded_rectangle(sx, sy, radius, steps=4):
    """Counter-clockwise outline around the origin."""
    points = []
    for cx, cy, start in ((1, 1, 0), (-1, 1, 90), (-1, -1, 180), (1, -1, 270)):
        for a in np.radians(np.linspace(start, start + 90, steps + 1)):
            points.append(
                (
                    cx * (sx / 2 - radius) + radius * math.cos(a),
                    cy * (sy / 2 - radius) + radius * math.sin(a),
                )
            )
    return points


def arc(radius, start_deg, end_deg, steps, centre=(0.0, 0.0)):
    a = np.radians(np.linspace(start_deg, end_deg, steps + 1))
    return [(centre[0] + radius * math.cos(t), centre[1] + radius * math.sin(t)) for t in a]
