"""Printed things, books, boxes, baskets, cushions: what every room has."""

import math

import numpy as np

from shapes.mesh import joined
from shapes.soft import pillow, soft_box
from shapes.solids import box, lathe
from surfaces.prints import COVERS, SPINES


def printed(material, width, height, depth, region=(0.0, 0.0, 1.0, 1.0)):
    """A plate facing -y whose front shows a picture (or a region u0, v0, u1, v1 of it)."""
    model = box(material, width, depth, height, 0.0)
    part = model.parts[0]
    u = part.positions[:, 0] / width + 0.5
    v = part.positions[:, 2] / height
    u0, v0, u1, v1 = region
    # Half a pixel inside, so that a repeating picture does not bleed over its edges.
    u, v = u0 + (0.004 + 0.992 * u) * (u1 - u0), v0 + (0.004 + 0.992 * v) * (v1 - v0)
    part.uvs = np.column_stack([u, v])
    return model


def _one_color(material, model, u, v):
    """Every corner shows the same spot of an atlas."""
    for part in model.parts:
        part.material = material
        part.uvs = np.tile([u, v], (len(part.positions), 1))
    return model


def book(index, thickness, height, depth):
    """Stands upright, spine towards -y; the pages show on top inside the cover's rim."""
    i = index % SPINES
    cover = _one_color(
        "spines", box("paper", thickness, depth, height, 0.0), (i + 0.12) / SPINES, 0.40
    )
    part = cover.parts[0]
    front = part.normals[:, 1] < -0.5
    u = (i + 0.5 + 0.99 * part.positions[front, 0] / thickness) / SPINES
    part.uvs[front] = np.column_stack([u, 0.004 + 0.992 * part.positions[front, 2] / height])
    return cover + box("paper", thickness - 0.005, depth - 0.006, 0.0006, 0.0).moved(
        y=0.002, z=height
    )


def book_row(seed, count, height=0.23, depth=0.16, lean=0):
    """Books side by side on a shelf, the last `lean` of them leaning; centred on x."""
    rng = np.random.default_rng(seed)
    parts, x = [], 0.0
    for k in range(count):
        t = 0.016 + 0.026 * rng.random()
        h = height * (0.80 + 0.2 * rng.random())
        d = depth * (0.88 + 0.12 * rng.random())
        one = book(int(rng.random() * SPINES), t, h, d).moved(y=-depth / 2 + d / 2)
        if k >= count - lean:  # tilted against the one before, standing on an edge
            one = one.turned(-14, "y").grounded()
            one = one.moved(x=x - one.low()[0])
            x += t / math.cos(math.radians(14)) + 0.0005
        else:
            one = one.moved(x=x + t / 2)
            x += t + 0.0006
        parts.append(one)
    model = joined(parts)
    return model.moved(x=-(model.low()[0] + model.high()[0]) / 2)


def flat_book(index, width=0.17, depth=0.23, thickness=0.026):
    """Lies with its cover up; the spine is at -x."""
    i = index % COVERS
    u, v = (i % 4) / 4, 0.5 - (i // 4) / 2
    cell = (u, v, u + 0.25, v + 0.5)
    spot = (u + 0.02, v + 0.48)
    top = (
        printed("covers", width, depth, 0.003, cell)
        .turned(-90, "x")
        .moved(y=-depth / 2, z=thickness - 0.0015)
    )
    bottom = _one_color("covers", box("paper", width, depth, 0.003, 0.0), *spot)
    spine = _one_color(
        "covers",
        box("paper", 0.003, depth, thickness - 0.006, 0.0).moved(x=-width / 2 + 0.0015, z=0.003),
        *spot
    )
    pages = box("paper", width - 0.010, depth - 0.010, thickness - 0.006, 0.0).moved(
        x=-0.002, z=0.003
    )
    return joined([top, bottom, spine, pages])


def magazine(index):
    return flat_book(index, 0.21, 0.28, 0.008)


def tray(width=0.42, depth=0.28):
    return joined(
        [box("walnut", width, depth, 0.010, 0.003)]
        + [
            box("walnut", sx, sy, 0.032, 0.004).moved(x=x, y=y)
            for sx, sy, x, y in (
                (width, 0.012, 0, depth / 2 - 0.006),
                (width, 0.012, 0, -depth / 2 + 0.006),
                (0.012, depth - 0.024, width / 2 - 0.006, 0),
                (0.012, depth - 0.024, -width / 2 + 0.006, 0),
            )
        ]
    )


def basket(radius=0.19, height=0.26, material="rattan"):
    r, h = radius, height
    return lathe(
        material,
        [
            (0, 0),
            (r * 0.84, 0),
            (r * 0.88, 0.01),
            (r, h * 0.6),
            (r * 0.97, h),
            (r * 0.97 - 0.012, h),
            (r - 0.014, h * 0.6),
            (r * 0.84, 0.018),
            (0, 0.016),
        ],
        36,
        50,
    )


def storage_box(width=0.30, depth=0.24, height=0.18, cloth="linen_grey", label=True):
    parts = [
        box(cloth, width, depth, height - 0.03, 0.006),
        box(cloth, width + 0.006, depth + 0.006, 0.035, 0.005).moved(z=height - 0.035),
    ]
    if label:
        parts.append(
            box("brass", 0.07, 0.004, 0.035, 0.001).moved(y=-depth / 2 - 0.001, z=height * 0.42)
        )
        parts.append(
            box("paper", 0.058, 0.002, 0.024, 0).moved(
                y=-depth / 2 - 0.003, z=height * 0.42 + 0.0055
            )
        )
    return joined(parts)


def carton(width=0.42, depth=0.32, height=0.28):
    return joined(
        [
            box("cardboard", width, depth, height, 0.003),
            box("paper", 0.05, depth + 0.001, 0.001, 0).moved(z=height),
            printed("label_sage", 0.16, 0.09, 0.001).moved(y=-depth / 2 - 0.0005, z=height * 0.4),
        ]
    )


def leaning_cushion(cloth, size=0.45, lean=18, thickness=0.15):
    """Stands on its edge, leaning back towards +y."""
    model = pillow(cloth, size, size, thickness).turned(90 - lean, "x")
    return model.moved(y=-(model.low()[1] + model.high()[1]) / 2, z=-model.low()[2])


def folded(cloth, width, depth, height, layers=3):
    """A folded blanket or towels: round-edged layers on one another."""
    each = height / layers
    return joined(
        [
            soft_box(cloth, width - 0.006 * (k % 2), depth, each, each * 0.48).moved(z=each * k)
            for k in range(layers)
        ]
    )


def sheet(picture="notes"):
    return printed(picture, 0.21, 0.297, 0.0012).turned(-90, "x").moved(y=-0.1485, z=0.0006)
