"""Soft and grown things: upholstery, pillows, cloth, leaves, fruit."""

import math

import numpy as np

from shapes.mesh import Model, Part, smooth_normals, without_slivers


def soft_box(material, sx, sy, sz, radius, arc=2, middle=1, puff=(0.0, 0.0, 0.0)):
    """A box with round edges on z = 0, its faces bulging by `puff` metres along each axis.

    Edges turn in 2 * `arc` steps; the longest flat side has `middle` cells.
    """
    half = np.array([sx, sy, sz]) / 2
    radius = min(radius, float(half.min()) * 0.98)
    lines = []
    longest = max(float((half - radius).max()), 1e-9)
    for h in half:
        cells = max(1, round(middle * (h - radius) / longest))
        bend = radius * np.tan(np.linspace(math.pi / 4, 0, arc + 1))
        flat = np.linspace(-(h - radius), h - radius, cells + 1)[1:-1]
        lines.append(np.concatenate([-(h - radius) - bend, flat, (h - radius) + bend[::-1]]))
    positions, normals, uvs, triangles = [], [], [], []
    start = 0
    for axis in range(3):
        b, c = (axis + 1) % 3, (axis + 2) % 3
        for sign in (-1, 1):
            gb, gc = np.meshgrid(lines[b], lines[c], indexing="ij")
            q = np.zeros(gb.shape + (3,))
            q[..., axis], q[..., b], q[..., c] = sign * half[axis], gb, gc
            inner = np.clip(q, -(half - radius), half - radius)
            away = q - inner
            away /= np.linalg.norm(away, axis=2, keepdims=True)
            p = inner + radius * away
            u, v = (b, c) if half[b] >= half[c] else (c, b)
            positions.append(p.reshape(-1, 3))
            normals.append(away.reshape(-1, 3))
            uvs.append(q[..., [u, v]].reshape(-1, 2))
            triangles.append(_grid(*gb.shape, flip=sign < 0) + start)
            start += gb.size
    positions, triangles = np.concatenate(positions), np.concatenate(triangles)
    normals = np.concatenate(normals)
    if any(puff):
        share = positions / half
        weight = np.cos(np.clip(share, -1, 1) * math.pi / 2)
        swell = np.zeros_like(positions)
        for a in range(3):
            swell[:, a] = puff[a] * share[:, a] * weight[:, (a + 1) % 3] * weight[:, (a + 2) % 3]
        positions = positions + swell
        normals = smooth_normals(positions, triangles)
    positions[:, 2] -= positions[:, 2].min()
    return Model([Part(material, positions, normals, np.concatenate(uvs), triangles)])


def pillow(material, sx, sy, thickness, cells=10, pinch=0.08):
    """A square cushion lying on z = 0: thick in the middle, flat at its seam, corners pulled."""
    line = np.sin(np.linspace(-math.pi / 2, math.pi / 2, cells + 1))
    u, v = np.meshgrid(line, line, indexing="ij")
    height = ((1 - np.abs(u) ** 2.6) * (1 - np.abs(v) ** 2.6)) ** 0.55
    height = np.where((np.abs(u) > 0.999) | (np.abs(v) > 0.999), 0.0, height)
    # The sides of a filled cushion draw in between its corners.
    x = sx / 2 * u * (1 - pinch * (1 - v**2) * np.abs(u) ** 3)
    y = sy / 2 * v * (1 - pinch * (1 - u**2) * np.abs(v) ** 3)
    positions, uvs, triangles = [], [], []
    for k, sign in enumerate((1, -1)):
        positions.append(np.stack([x, y, sign * thickness / 2 * height], axis=2).reshape(-1, 3))
        uvs.append(np.stack([u * sx / 2, v * sy / 2], axis=2).reshape(-1, 2))
        triangles.append(_grid(cells + 1, cells + 1, flip=sign < 0) + k * (cells + 1) ** 2)
    positions, triangles = np.concatenate(positions), np.concatenate(triangles)
    normals = smooth_normals(positions, triangles)
    positions[:, 2] += thickness / 2
    return Model([Part(material, positions, normals, np.concatenate(uvs), triangles)])


def ribbon(material, path, thickness, width):
    """Cloth or bent plywood: a path in (y, z) with a thickness, drawn out along x (centred)."""
    path = np.array(path, dtype=np.float64)
    ahead = np.concatenate([path[1:], path[-1:]])
    behind = np.concatenate([path[:1], path[:-1]])
    tangent = ahead - behind
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    side = np.column_stack([-tangent[:, 1], tangent[:, 0]])
    upper, lower = path + side * thickness / 2, path - side * thickness / 2
    along = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    n = len(path)
    xs = (-width / 2, width / 2)
    positions, normals, uvs, triangles = [], [], [], []

    def strip(points, point_normals, flip):
        start = len(positions)
        for x in xs:
            for p, m, u in zip(points, point_normals, along):
                positions.append((x, p[0], p[1]))
                normals.append((0, m[0], m[1]))
                uvs.append((u, x))
        for i in range(n - 1):
            a, b, c, d = start + i, start + i + 1, start + n + i + 1, start + n + i
            triangles.extend([(a, c, b), (a, d, c)] if flip else [(a, b, c), (a, c, d)])

    strip(upper, side, True)
    strip(lower, -side, False)
    for x, sign in ((xs[0], -1), (xs[1], 1)):
        start = len(positions)
        for points in (upper, lower):
            for p, u in zip(points, along):
                positions.append((x, p[0], p[1]))
                normals.append((sign, 0, 0))
                uvs.append((u, 0))
        for i in range(n - 1):
            a, b, c, d = start + i, start + i + 1, start + n + i + 1, start + n + i
            triangles.extend([(a, c, b), (a, d, c)] if sign > 0 else [(a, b, c), (a, c, d)])
    for i, sign in ((0, -1), (n - 1, 1)):
        start = len(positions)
        for x in xs:
            for p in (upper[i], lower[i]):
                positions.append((x, p[0], p[1]))
                normals.append((0, sign * tangent[i][0], sign * tangent[i][1]))
                uvs.append((along[i], x))
        quad = [(start, start + 1, start + 3), (start, start + 3, start + 2)]
        triangles.extend(quad if sign < 0 else [t[::-1] for t in quad])
    return Model([Part(material, positions, normals, uvs, triangles)])


def leaf(material, length, width, rise_deg, droop, fold=0.25, steps=6, tip=1.0):
    """A leaf from the origin along +y, climbing at `rise_deg` and bending down by `droop`."""
    t = np.linspace(0, 1, steps + 1)
    half = width / 2 * np.sin(math.pi * np.clip(t, 0, 1) ** (0.75 * tip)) ** 0.8
    half[0], half[-1] = width * 0.02, 0.0
    pitch = np.radians(rise_deg - droop * t)
    step = length / steps
    y = np.concatenate([[0], np.cumsum(np.cos(pitch[:-1]) * step)])
    z = np.concatenate([[0], np.cumsum(np.sin(pitch[:-1]) * step)])
    spine_normal = np.column_stack([np.zeros(len(t)), -np.sin(pitch), np.cos(pitch)])
    columns = np.array([-1.0, 0.0, 1.0])
    spine = np.column_stack([np.zeros(len(t)), y, z])
    upper = (
        spine[:, None, :]
        + columns[None, :, None] * half[:, None, None] * np.array([1, 0, 0])
        + (np.abs(columns)[None, :] * half[:, None] * fold)[..., None] * spine_normal[:, None, :]
    )
    thickness = np.where(columns == 0, 0.0012, 0.0)[None, :, None] * (half > 0)[:, None, None]
    lower = upper - thickness * spine_normal[:, None, :]
    uv = np.stack(np.broadcast_arrays(columns[None, :] / 2 + 0.5, t[:, None]), axis=2)
    positions = np.concatenate([upper.reshape(-1, 3), lower.reshape(-1, 3)])
    size = upper.shape[0] * 3
    triangles = np.concatenate([_grid(len(t), 3, flip=True), _grid(len(t), 3, flip=False) + size])
    triangles = without_slivers(positions, triangles)
    normals = np.concatenate(
        [_own_normals(upper, len(t), True), _own_normals(lower, len(t), False)]
    )
    return Model(
        [Part(material, positions, normals, np.concatenate([uv.reshape(-1, 2)] * 2), triangles)]
    )


def _own_normals(grid, rows, flip):
    points = grid.reshape(-1, 3)
    return smooth_normals(points, without_slivers(points, _grid(rows, 3, flip)))


def ellipsoid(material, sx, sy, sz, segments=14, rings=8):
    """Stands on z = 0."""
    segments = min(segments, int(12 + 50 * max(sx, sy) / 2))
    u = np.linspace(0, 2 * math.pi, segments + 1)
    u[-1] = 0.0
    v = np.linspace(-math.pi / 2, math.pi / 2, rings + 1)
    gu, gv = np.meshgrid(u, v, indexing="ij")
    unit = np.stack([np.cos(gu) * np.cos(gv), np.sin(gu) * np.cos(gv), np.sin(gv)], axis=2).reshape(
        -1, 3
    )
    half = np.array([sx, sy, sz]) / 2
    positions = unit * half
    normals = unit / half
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    wide = np.linspace(0, math.pi * sx, segments + 1)
    uvs = np.stack(
        np.meshgrid(wide, (v / math.pi + 0.5) * math.pi * sz / 2, indexing="ij"), axis=2
    ).reshape(-1, 2)
    triangles = without_slivers(positions, _grid(segments + 1, rings + 1, flip=False))
    return Model([Part(material, positions + np.array([0, 0, sz / 2]), normals, uvs, triangles)])


def _grid(rows, columns, flip):
    i, j = np.meshgrid(np.arange(rows - 1), np.arange(columns - 1), indexing="ij")
    a = (i * columns + j).reshape(-1)
    b, c, d = a + columns, a + columns + 1, a + 1
    first, second = np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)
    both = np.concatenate([first, second])
    return both[:, ::-1] if flip else both
