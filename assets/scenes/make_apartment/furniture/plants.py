"""Potted and cut plants."""

import math

import numpy as np

from furniture.crockery import vase
from shapes.mesh import joined, smooth_normals
from shapes.soft import ellipsoid, leaf
from shapes.solids import cylinder, lathe, tube


def pot(color="terracotta", radius=0.15, height=0.28, saucer=False):
    """A pot with soil; the soil is at 0.88 of its height."""
    r, h = radius, height
    parts = [
        lathe(
            color,
            [
                (0, 0),
                (r * 0.72, 0),
                (r * 0.76, 0.006),
                (r, h),
                (r - 0.012, h),
                (r * 0.94 - 0.012, h * 0.86),
                (0, h * 0.86),
            ],
            36,
            50,
        ),
        cylinder("soil", r * 0.95 - 0.012, h * 0.03, 28, 0, h * 0.85),
    ]
    if saucer:
        parts.append(
            lathe(
                color,
                [(0, 0), (r * 0.9, 0), (r, 0.02), (r - 0.008, 0.02), (r * 0.85, 0.008), (0, 0.008)],
                36,
                50,
            )
        )
    return joined(parts)


def _stalk(points, radius, material="stem"):
    return tube(material, points, [radius, radius * 0.8, radius * 0.5], 6)


def broad_leaved(seed=5, height=1.25, color="white_clay", leaves=15):
    """A rubber tree: upright stems with large dark leaves."""
    rng = np.random.default_rng(seed)
    parts = [pot(color, 0.19, 0.34)]
    for s in range(3):
        lean = np.radians(120 * s + 40)
        tip = height * (0.80 + 0.1 * s)
        base = (0.05 * math.cos(lean), 0.05 * math.sin(lean), 0.28)
        top = (0.15 * math.cos(lean), 0.15 * math.sin(lean), tip)
        middle = (0.07 * math.cos(lean), 0.07 * math.sin(lean), (0.3 + tip) / 2)
        parts.append(_stalk([base, middle, top], 0.012, "bark"))
        count = leaves // 3
        for k in range(count):
            t = 0.30 + 0.70 * (k + 0.5) / count
            at = np.array(base) * (1 - t) + np.array(top) * t
            turn = 137.5 * k + 70 * s + 20 * rng.random()
            size = 0.25 + 0.07 * rng.random() - 0.06 * t
            blade = leaf(
                "leaf_dark", size, size * 0.52, 58 - 22 * (1 - t), 75 + 25 * rng.random(), 0.22, 5
            )
            parts.append(blade.turned(turn).moved(*at))
    return joined(parts)


def palm(seed=6, height=1.6, color="rattan", fronds=6):
    """Arching fronds of narrow leaflets in a basket."""
    rng = np.random.default_rng(seed)
    parts = [pot(color, 0.21, 0.36)]
    for f in range(fronds):
        turn = 360 * f / fronds + 18 * rng.random()
        reach, rise = 0.42 + 0.18 * rng.random(), height * (0.72 + 0.28 * rng.random())
        pieces, spine = [], []
        for k in range(11):
            t = k / 10
            spine.append(
                (
                    0.0,
                    0.04 + reach * t**1.6,
                    0.30 + (rise - 0.30) * math.sin(t * 1.75) / math.sin(1.57),
                )
            )
        pieces.append(tube("stem", spine, list(np.linspace(0.008, 0.003, 11)), 6))
        for k in range(7):
            t = 0.34 + 0.66 * k / 7
            i = min(int(t * 10), 9)
            at = np.array(spine[i]) + (np.array(spine[i + 1]) - np.array(spine[i])) * (t * 10 - i)
            size = 0.30 * math.sin(math.pi * (0.18 + 0.74 * (t - 0.30) / 0.7)) + 0.06
            for side in (-1, 1):
                blade = leaf("leaf", size, 0.032, 22, 70 + 20 * rng.random(), 0.3, 3)
                pieces.append(blade.turned(-side * (58 - 26 * t)).moved(*at))
        pieces.append(leaf("leaf", 0.24, 0.032, -10, 60, 0.3, 3).moved(*spine[-1]))
        parts.append(joined(pieces).turned(turn))
    return joined(parts)


def snake_plant(seed=7, color="stoneware_sage", leaves=11, height=0.62, radius=0.13):
    """Stiff upright blades."""
    rng = np.random.default_rng(seed)
    parts = [pot(color, radius, radius * 1.7)]
    for k in range(leaves):
        a = 2.399 * k
        out = radius * 0.55 * math.sqrt((k + 0.5) / leaves)
        tall = height * (0.62 + 0.38 * rng.random())
        blade = leaf("leaf_dark", tall, 0.055, 88 - 9 * rng.random(), 6, 0.35, 4, 0.8)
        parts.append(
            blade.turned(math.degrees(a) - 90 + 30 * rng.random()).moved(
                out * math.cos(a), out * math.sin(a), radius * 1.7 * 0.86
            )
        )
    return joined(parts)


def bushy(seed=8, color="white_clay", radius=0.085, leaves=18, reach=0.16, material="leaf"):
    """A small round-leaved plant for tables and shelves."""
    rng = np.random.default_rng(seed)
    height = radius * 1.55
    parts = [pot(color, radius, height)]
    for k in range(leaves):
        a = 137.5 * k
        level = (k + 0.5) / leaves
        rise = 20 + 62 * level
        stem = reach * (0.45 + 0.55 * rng.random())
        r = math.radians(rise)
        tip = (stem * math.cos(r), stem * math.sin(r) + height * 0.86)
        branch = tube(
            "stem",
            [
                (0, 0.01, height * 0.86),
                (0, tip[0] * 0.6, height * 0.86 + (tip[1] - height * 0.86) * 0.75),
                (0, tip[0], tip[1]),
            ],
            [0.0025, 0.002, 0.0015],
            4,
        )
        blade = leaf(material, 0.075 + 0.03 * rng.random(), 0.055, rise - 25, 70, 0.2, 2).moved(
            y=tip[0], z=tip[1]
        )
        parts.append(joined([branch, blade]).turned(a + 25 * rng.random()))
    return joined(parts)


def trailing(seed=9, color="stoneware", radius=0.08, vines=9, drop=0.42):
    """Vines that hang over a shelf's edge; the shelf is under the pot, free air at -y."""
    rng = np.random.default_rng(seed)
    height = radius * 1.5
    parts = [pot(color, radius, height)]
    for v in range(vines):
        a = -90 + (v - (vines - 1) / 2) * 21
        over = radius + 0.03 + 0.02 * rng.random()
        falls = abs((v - (vines - 1) / 2)) < vines * 0.30
        fall = drop * (0.45 + 0.55 * rng.random()) if falls else -0.01
        path = [
            (0, 0.02, height * 0.86),
            (0, over * 0.6, height + 0.025),
            (0, over, height),
            (0, over + 0.03, height - 0.5 * (fall + 0.01)),
            (0, over + 0.028, height - fall),
        ]
        pieces = [tube("stem", path, 0.002, 5)]
        for k in range(9):
            t = (k + 0.7) / 9 * 3.999
            i = int(t)
            at = np.array(path[i]) + (np.array(path[i + 1]) - np.array(path[i])) * (t - i)
            blade = leaf("leaf", 0.060 + 0.02 * rng.random(), 0.050, 10 - 30 * (t > 2), 60, 0.15, 2)
            pieces.append(blade.turned(60 * (-1) ** k + 20 * rng.random()).moved(*at))
        parts.append(joined(pieces).turned(a - 90))
    return joined(parts)


def cactus(color="terracotta"):
    parts = [pot(color, 0.06, 0.09)]
    for x, y, w, h in (
        (0, 0, 0.062, 0.15),
        (0.035, 0.012, 0.04, 0.08),
        (-0.032, -0.012, 0.036, 0.06),
    ):
        ribs = 5
        body = ellipsoid("leaf_grey", w, w, h, 20, 8)
        p = body.parts[0]
        angle = np.arctan2(p.positions[:, 1], p.positions[:, 0])
        p.positions[:, :2] *= (1 + 0.09 * np.cos(ribs * angle))[:, None]
        p.normals = smooth_normals(p.positions, p.triangles)
        p.uvs = np.column_stack([angle * 0 + 0.2, p.positions[:, 2] / h])
        parts.append(body.moved(x, y, 0.072))
    return joined(parts)


def branches(seed=10, color="stoneware", height=0.30, spread=0.30, count=6):
    """Eucalyptus in a vase."""
    rng = np.random.default_rng(seed)
    parts = [vase(color, height, height * 0.30, 0.032, 0.38)]
    for k in range(count):
        lean, tall = spread * (0.35 + 0.65 * rng.random()), 0.36 + 0.14 * rng.random()
        path = [
            (0, 0.008, height * 0.82),
            (0, 0.02, height),
            (0, lean * 0.5, height + tall * 0.65),
            (0, lean, height + tall),
        ]
        pieces = [tube("bark", path, [0.003, 0.003, 0.0025, 0.0015], 5)]
        for j in range(9):
            t = 1.25 + 1.74 * j / 8
            i = int(t)
            at = np.array(path[i]) + (np.array(path[i + 1]) - np.array(path[i])) * (t - i)
            blade = leaf("leaf_grey", 0.05, 0.044, 35, 40, 0.12, 2)
            pieces.append(blade.turned(80 * (-1) ** j + 30 * rng.random()).moved(*at))
        parts.append(joined(pieces).turned(360 * k / count + 25 * rng.random()))
    return joined(parts)


def tulips(seed=11, color="glass", count=7):
    rng = np.random.default_rng(seed)
    parts = [
        lathe(
            color,
            [
                (0, 0),
                (0.045, 0),
                (0.05, 0.004),
                (0.042, 0.18),
                (0.039, 0.18),
                (0.046, 0.008),
                (0, 0.008),
            ],
            28,
            50,
        )
    ]
    for k in range(count):
        a, lean = 360 * k / count, 0.05 + 0.05 * rng.random()
        tall = 0.33 + 0.05 * rng.random()
        stem = tube("stem", [(0, 0.012, 0.012), (0, 0.03, 0.18), (0, lean + 0.02, tall)], 0.0035, 6)
        cup = lathe(
            "petal" if k % 3 else "clay_paint",
            [(0, 0), (0.016, 0.006), (0.024, 0.025), (0.019, 0.05), (0.008, 0.058), (0, 0.05)],
            14,
            60,
        )
        blade = leaf("leaf", 0.18, 0.028, 70, 50, 0.3, 5).turned(40).moved(y=0.03, z=0.17)
        parts.append(
            joined([stem, cup.turned(-14, "x").moved(y=lean + 0.02, z=tall - 0.006), blade]).turned(
                a
            )
        )
    return joined(parts)
