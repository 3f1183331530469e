"""Clothes, bags and what else hangs in a hall."""

import math

import numpy as np

from shapes.mesh import joined, smooth_normals
from shapes.soft import soft_box
from shapes.solids import box, cylinder, extrude, lathe, rod, tube


def shoe(color="leather", sole="white_plastic"):
    """One of a pair, its toe towards -y."""
    upper = soft_box(color, 0.092, 0.27, 0.075, 0.036, middle=5)
    part = upper.parts[0]
    y, z = part.positions[:, 1], part.positions[:, 2]
    part.positions[:, 2] = z * (0.66 + 0.34 * np.clip((y + 0.06) / 0.12, 0, 1))
    part.positions[:, 0] *= (
        1 - 0.18 * np.clip((y - 0.02) / 0.12, 0, 1) - 0.25 * np.clip((-y - 0.08) / 0.06, 0, 1) ** 2
    )
    base = extrude(
        sole,
        [
            (x * 0.096, y * 0.28)
            for x, y in [
                (-0.30, -0.42),
                (-0.15, -0.5),
                (0.15, -0.5),
                (0.34, -0.42),
                (0.47, -0.25),
                (0.40, 0.05),
                (0.40, 0.35),
                (0.28, 0.48),
                (-0.28, 0.48),
                (-0.40, 0.35),
                (-0.40, 0.05),
                (-0.45, -0.25),
            ]
        ],
        0.022,
        0.004,
    )
    collar = (
        lathe(color, [(0.024, 0), (0.034, 0), (0.033, 0.035), (0.028, 0.037), (0.024, 0.0)], 20, 60)
        .scaled(1, 1.5, 1)
        .moved(y=0.075, z=0.068)
    )
    return joined([base, upper.moved(z=0.018), collar])


def shoes(color="leather", sole="white_plastic"):
    return joined(
        [shoe(color, sole).moved(x=-0.06), shoe(color, sole).turned(5).moved(x=0.06, y=0.012)]
    )


def hanging_coat(cloth="linen_ink", width=0.42, height=0.95):
    """Hangs from z = 0 downwards against a wall at y = 0: body with folds, two sleeves."""
    body = soft_box(cloth, width, 0.11, height, 0.05, middle=9)
    part = body.parts[0]
    x, y, z = part.positions.T
    share = z / height
    shoulder = np.clip((1 - share) / 0.16, 0, 1)
    part.positions[:, 0] = x * (0.30 + 0.62 * shoulder**0.7) * (1.05 - 0.12 * share)
    part.positions[:, 1] = y * (0.45 + 0.55 * shoulder) + 0.010 * np.sin(x * 46) * (1 - share)

    part.normals = smooth_normals(part.positions, part.triangles)
    sleeves = [
        tube(
            cloth,
            [
                (s * width * 0.36, -0.005, height * 0.86),
                (s * width * 0.49, -0.015, height * 0.66),
                (s * width * 0.51, -0.02, height * 0.32),
            ],
            [0.045, 0.05, 0.042],
            12,
        )
        for s in (-1, 1)
    ]
    collar = tube(
        cloth,
        [(-0.07, -0.01, height * 0.955), (0, 0.015, height), (0.07, -0.01, height * 0.955)],
        [0.018, 0.02, 0.018],
        10,
    )
    buttons = [
        cylinder("walnut", 0.011, 0.006, 12, 0.001).turned(90, "x").moved(0.03, -0.052, height * t)
        for t in (0.35, 0.5, 0.65)
    ]
    return joined([body, *sleeves, collar, *buttons]).moved(y=-0.075, z=-height)


def tote_bag(cloth="linen_clay", width=0.36, height=0.38):
    """Hangs by its straps from z = 0, wall at y = 0."""
    body = soft_box(cloth, width, 0.09, height, 0.035, arc=3, middle=6, puff=(0, 0.012, 0)).moved(
        y=-0.06, z=-height - 0.24
    )
    straps = [
        tube(
            cloth,
            [
                (-0.09, -0.06 + s, -0.26),
                (-0.05, -0.06 + s, -0.05),
                (0, -0.06 + s * 0.4, 0.0),
                (0.05, -0.06 + s, -0.05),
                (0.09, -0.06 + s, -0.26),
            ],
            0.008,
            8,
        )
        for s in (-0.03, 0.03)
    ]
    return joined([body, *straps])


def hat():
    return joined(
        [
            lathe(
                "rattan",
                [
                    (0, 0.0),
                    (0.19, 0.004),
                    (0.20, 0.010),
                    (0.19, 0.014),
                    (0.095, 0.018),
                    (0.09, 0.09),
                    (0.06, 0.115),
                    (0, 0.118),
                ],
                40,
                50,
            ),
            lathe(
                "linen_ink", [(0.093, 0.020), (0.0975, 0.020), (0.0945, 0.05), (0.090, 0.05)], 40
            ),
        ]
    )


def umbrella():
    parts = [
        rod("oak", (0, 0, 0.0), (0, 0, 0.82), 0.007),
        lathe(
            "linen_ink",
            [(0, 0.10), (0.012, 0.10), (0.035, 0.40), (0.030, 0.62), (0.012, 0.66), (0, 0.66)],
            12,
            50,
        ),
    ]
    parts.append(
        tube(
            "oak",
            [(0, 0, 0.82)]
            + [
                (0.035 - 0.035 * math.cos(a), 0, 0.82 + 0.035 * math.sin(a))
                for a in np.linspace(0.3, math.pi * 1.15, 9)
            ],
            0.008,
            8,
        )
    )
    return joined(parts)


def umbrella_stand():
    return lathe(
        "black_metal",
        [
            (0, 0),
            (0.11, 0),
            (0.112, 0.01),
            (0.105, 0.45),
            (0.100, 0.45),
            (0.105, 0.014),
            (0, 0.012),
        ],
        36,
        50,
    )


def suitcase(color="sage_paint"):
    shell = soft_box(color, 0.46, 0.26, 0.66, 0.05, arc=3)
    ribs = [
        box(color, 0.016, 0.268, 0.52, 0.004).moved(x=x, z=0.07)
        for x in (-0.15, -0.075, 0, 0.075, 0.15)
    ]
    wheels = [
        cylinder("black_plastic", 0.025, 0.02, 14).turned(90, "x").moved(x, y + 0.01, -0.015)
        for x in (-0.18, 0.18)
        for y in (-0.09, 0.09)
    ]
    handle = tube(
        "black_plastic",
        [(-0.07, 0, 0.66), (-0.065, 0, 0.69), (0.065, 0, 0.69), (0.07, 0, 0.66)],
        0.009,
        8,
    )
    band = box("black_plastic", 0.464, 0.012, 0.60, 0.002).moved(z=0.03)
    return joined([shell, *ribs, *wheels, handle, band]).moved(z=0.04)
