"""Crockery, vases, candles, bottles."""

import math

import numpy as np

from shapes.mesh import joined
from shapes.soft import ellipsoid
from shapes.solids import arc, cylinder, lathe, tube


def mug(color="stoneware"):
    body = lathe(
        color,
        [
            (0, 0),
            (0.034, 0),
            (0.039, 0.006),
            (0.041, 0.09),
            (0.038, 0.092),
            (0.036, 0.088),
            (0.034, 0.012),
            (0, 0.010),
        ],
        28,
        50,
    )
    handle = [(0.038 + x, 0, z) for x, z in arc(0.027, 75, -75, 9, (0.0, 0.048))]
    return joined([body, tube(color, handle, 0.0055, 8)])


def bowl(color="stoneware", radius=0.13, height=0.075):
    r, h = radius, height
    return lathe(
        color,
        [
            (0, 0),
            (r * 0.42, 0),
            (r * 0.44, 0.008),
            (r * 0.75, h * 0.42),
            (r * 0.97, h * 0.95),
            (r, h),
            (r - 0.007, h),
            (r * 0.71, h * 0.47),
            (r * 0.40, 0.018),
            (0, 0.014),
        ],
        40,
        50,
    )


def plate(color="porcelain", radius=0.13):
    r = radius
    return lathe(
        color,
        [
            (0, 0),
            (r * 0.6, 0),
            (r * 0.64, 0.005),
            (r, 0.020),
            (r - 0.003, 0.023),
            (r * 0.64, 0.009),
            (0, 0.008),
        ],
        40,
        50,
    )


def vase(color="stoneware", height=0.28, belly=0.085, neck=0.03, low=0.35):
    """Belly at `low` of the height, drawn in to a neck with a lip."""
    outer = [(0, 0), (belly * 0.55, 0)]
    for k in range(1, 13):
        t = k / 12
        if t <= low:
            r = belly * (0.55 + 0.45 * math.sin(math.pi / 2 * t / low))
        else:
            s = (t - low) / (1 - low)
            r = neck + (belly - neck) * (0.5 + 0.5 * math.cos(math.pi * min(1.0, s * 1.12)))
        outer.append((r, height * t))
    lip = outer[-1][0]
    inner = [(lip - 0.005, height), (lip - 0.006, height * 0.85), (0, height * 0.80)]
    return lathe(color, outer + inner, 36, 50)


def jar(color="stoneware", lid="oak", radius=0.055, height=0.14):
    return joined(
        [
            lathe(
                color,
                [
                    (0, 0),
                    (radius - 0.006, 0),
                    (radius, 0.008),
                    (radius, height - 0.012),
                    (radius - 0.008, height),
                    (0, height),
                ],
                32,
                50,
            ),
            cylinder(lid, radius - 0.004, 0.02, 32, 0.004, height),
            ellipsoid(lid, 0.022, 0.022, 0.02).moved(z=height + 0.017),
        ]
    )


def bottle(glass="glass_amber", height=0.30, radius=0.037, label="label_clay"):
    r, h = radius, height
    body = lathe(
        glass,
        [
            (0, 0),
            (r - 0.004, 0),
            (r, 0.006),
            (r, h * 0.58),
            (r * 0.85, h * 0.66),
            (r * 0.38, h * 0.76),
            (r * 0.36, h * 0.95),
            (0, h * 0.95),
        ],
        28,
        50,
    )
    wrap = lathe(
        label,
        [
            (r - 0.001, h * 0.16),
            (r + 0.0006, h * 0.16),
            (r + 0.0006, h * 0.48),
            (r - 0.001, h * 0.48),
        ],
        28,
    )
    part = wrap.parts[0]

    part.uvs = np.column_stack(
        [
            part.uvs[:, 0] / (2 * math.pi * (r + 0.0006)),
            (part.positions[:, 2] - h * 0.16) / (h * 0.32),
        ]
    )
    return joined([body, wrap, cylinder("cork", r * 0.33, h * 0.06, 16, 0.002, h * 0.94)])


def candle(holder="brass", height=0.24):
    return joined(
        [
            lathe(
                holder,
                [
                    (0, 0),
                    (0.045, 0),
                    (0.047, 0.006),
                    (0.014, 0.016),
                    (0.010, 0.05),
                    (0.018, 0.065),
                    (0.018, 0.085),
                    (0, 0.085),
                ],
                28,
                50,
            ),
            cylinder("wax", 0.011, height - 0.09, 16, 0.003, 0.08),
            cylinder("black_plastic", 0.001, 0.012, 6, 0, height - 0.012),
        ]
    )


def tea_light(color="stoneware_sage"):
    return joined(
        [
            lathe(
                color,
                [
                    (0, 0),
                    (0.038, 0),
                    (0.043, 0.008),
                    (0.043, 0.055),
                    (0.039, 0.055),
                    (0.037, 0.035),
                    (0, 0.035),
                ],
                28,
                50,
            ),
            cylinder("wax", 0.034, 0.008, 24, 0.002, 0.033),
        ]
    )
