"""Bathroom fittings."""

import math

import numpy as np

from shapes.mesh import Model, joined, smooth_normals
from shapes.soft import ribbon, soft_box
from shapes.solids import arc, box, cylinder, extrude, lathe, rod, rounded_rectangle, slab, tube


def bathtub(length=1.7, width=0.75, height=0.56):
    """A free-standing tub: an oval bowl with a rolled rim. Along x."""
    steps = 44
    profile = [
        (0.0, 0.0),
        (0.72, 0.0),
        (0.78, 0.012),
        (0.86, 0.20),
        (0.95, 0.44),
        (0.985, height - 0.03),
        (1.0, height - 0.012),
        (0.992, height),
        (0.968, height),
        (0.955, height - 0.012),
        (0.925, 0.42),
        (0.84, 0.18),
        (0.74, 0.09),
        (0.60, 0.075),
        (0.0, 0.07),
    ]
    model = lathe("porcelain", profile, steps, 60)
    part = model.parts[0]
    x, y = part.positions[:, 0], part.positions[:, 1]
    radius, angle = np.hypot(x, y), np.arctan2(y, x)
    # A squarish oval: the ends are fuller than an ellipse's.
    fuller = (np.abs(np.cos(angle)) ** 2.6 + np.abs(np.sin(angle)) ** 2.6) ** (-1 / 2.6)
    part.positions[:, 0] = radius * fuller * np.cos(angle) * length / 2
    part.positions[:, 1] = radius * fuller * np.sin(angle) * width / 2
    part.normals = smooth_normals(part.positions, part.triangles)
    return joined(
        [Model([part]), cylinder("chrome", 0.025, 0.004, 24, 0.001, 0.071).moved(x=length * 0.28)]
    )


def tub_tap():
    """Floor-standing filler, spout towards -y."""
    bow = [(0, 0, 0.0), (0, 0, 0.80)] + [
        (0, y - 0.08, z) for y, z in arc(0.08, 0, 150, 9, (0.0, 0.80))
    ][1:]
    return joined(
        [
            cylinder("brass", 0.04, 0.012, 28, 0.003),
            tube("brass", bow, 0.012, 12),
            rod("brass", (-0.07, 0, 0.62), (0.07, 0, 0.62), 0.009),
            cylinder("brass", 0.02, 0.03, 18, 0.004).turned(90, "y").moved(x=0.06, z=0.62),
            cylinder("brass", 0.02, 0.03, 18, 0.004).turned(-90, "y").moved(x=-0.06, z=0.62),
        ]
    )


def toilet():
    """Cistern at the back, y = 0 behind it."""
    bowl = extrude("porcelain", [(x * 0.5, y) for x, y in _egg(0.74, 0.52)], 0.09, 0.02).moved(
        y=-0.36, z=0.31
    )
    foot = (
        lathe(
            "porcelain",
            [
                (0, 0),
                (0.13, 0),
                (0.135, 0.01),
                (0.105, 0.12),
                (0.12, 0.24),
                (0.165, 0.33),
                (0, 0.33),
            ],
            32,
            60,
        )
        .scaled(0.92, 1.35, 1.0)
        .moved(y=-0.30)
    )
    lid = extrude("white_plastic", [(x * 0.5, y) for x, y in _egg(0.75, 0.50)], 0.028, 0.009).moved(
        y=-0.365, z=0.402
    )
    tank = soft_box("porcelain", 0.38, 0.17, 0.38, 0.035, arc=3).moved(y=-0.09, z=0.39)
    cover = soft_box("porcelain", 0.40, 0.185, 0.035, 0.014).moved(y=-0.095, z=0.768)
    neck = box("porcelain", 0.20, 0.22, 0.32, 0.03).moved(y=-0.13, z=0.08)
    return joined(
        [
            foot,
            neck,
            bowl,
            lid,
            tank,
            cover,
            cylinder("chrome", 0.022, 0.008, 24, 0.002, 0.802).moved(y=-0.095),
        ]
    )


def _egg(width, length, steps=36):
    """Round in front (-y), flatter behind."""
    points = []
    for a in np.linspace(0, 2 * math.pi, steps, endpoint=False):
        x, y = math.cos(a), math.sin(a)
        y = min(y, 0.80)
        points.append((width / 2 * x * (1 - 0.10 * y), length / 2 * y))
    return [
        p
        for i, p in enumerate(points)
        if i == 0 or np.hypot(p[0] - points[i - 1][0], p[1] - points[i - 1][1]) > 1e-6
    ]


def vanity(width=1.0, depth=0.46, height=0.80):
    """Floating oak drawers with a stone top; hangs on the wall at y = 0."""
    parts = [
        slab("oak", (-width / 2, -depth + 0.02, 0.32), (width / 2, 0, height - 0.03), 0.003),
        slab(
            "marble",
            (-width / 2 - 0.01, -depth - 0.01, height - 0.03),
            (width / 2 + 0.01, 0, height),
            0.004,
        ),
    ]
    for side in (-1, 1):
        for z0, z1 in ((0.325, 0.54), (0.546, height - 0.035)):
            a, b = sorted((side * 0.003, side * (width / 2 - 0.003)))
            parts.append(slab("oak_slats", (a, -depth, z0), (b, -depth + 0.02, z1), 0.003))
            parts.append(
                rod(
                    "brass",
                    ((a + b) / 2 - 0.06, -depth - 0.022, z1 - 0.04),
                    ((a + b) / 2 + 0.06, -depth - 0.022, z1 - 0.04),
                    0.005,
                    segments=8,
                )
            )
            for x in ((a + b) / 2 - 0.05, (a + b) / 2 + 0.05):
                parts.append(
                    rod(
                        "brass",
                        (x, -depth, z1 - 0.04),
                        (x, -depth - 0.022, z1 - 0.04),
                        0.004,
                        segments=8,
                    )
                )
    return joined(parts)


def washbasin(radius=0.20, height=0.13):
    """A bowl standing on the worktop."""
    r, h = radius, height
    return joined(
        [
            lathe(
                "porcelain",
                [
                    (0, 0),
                    (r * 0.55, 0),
                    (r * 0.62, 0.006),
                    (r * 0.93, h * 0.6),
                    (r, h),
                    (r - 0.008, h + 0.002),
                    (r - 0.016, h * 0.95),
                    (r * 0.85, h * 0.5),
                    (r * 0.5, 0.018),
                    (0, 0.014),
                ],
                48,
                60,
            ),
            cylinder("brass", 0.022, 0.004, 20, 0.001, 0.014),
        ]
    ).scaled(1.15, 0.92, 1)


def basin_tap():
    bow = [(0, 0, 0.0), (0, 0, 0.24)] + [
        (0, y - 0.05, z) for y, z in arc(0.05, 0, 165, 8, (0.0, 0.24))
    ][1:]
    return joined(
        [
            cylinder("brass", 0.025, 0.02, 24, 0.004),
            tube("brass", bow, 0.010, 12),
            rod("brass", (0.012, 0, 0.10), (0.06, 0, 0.12), 0.005),
        ]
    )


def towel_rail(width=0.60):
    """Wall at y = 0, bar at z = 0 and y = -0.07."""
    parts = [rod("brass", (-width / 2, -0.07, 0), (width / 2, -0.07, 0), 0.008, segments=12)]
    for x in (-width / 2 + 0.02, width / 2 - 0.02):
        parts += [
            rod("brass", (x, 0, 0), (x, -0.07, 0), 0.007),
            cylinder("brass", 0.02, 0.008, 20, 0.002).turned(90, "x").moved(x=x),
        ]
    return joined(parts)


def hanging_towel(cloth, width=0.42, front=0.62, back=0.50):
    """Folded over a bar at y = 0, z = 0."""
    path = (
        [(-0.021, -front), (-0.020, -0.3), (-0.018, -0.012)]
        + [(0.0155 * math.cos(a), 0.0155 * math.sin(a)) for a in (2.7, 2.1, 1.57, 1.0, 0.4)]
        + [(0.017, -0.012), (0.019, -0.25), (0.020, -back)]
    )
    return joined(
        [
            ribbon(cloth, path, 0.011, width),
            box("linen_white", width, 0.0125, 0.02, 0).moved(y=-0.0207, z=-front + 0.05),
        ]
    )


def washing_machine():
    parts = [
        box("white_metal", 0.59, 0.56, 0.83, 0.008).moved(y=0.01, z=0.012),
        box("white_plastic", 0.57, 0.01, 0.10, 0.003).moved(y=-0.272, z=0.73),
        lathe("chrome", [(0.15, 0), (0.205, 0), (0.20, 0.025), (0.165, 0.03), (0.15, 0.0)], 44, 50)
        .turned(90, "x")
        .moved(y=-0.268, z=0.40),
        lathe("dark_glass", [(0, 0), (0.155, 0), (0.15, 0.018), (0.08, 0.034), (0, 0.038)], 40, 50)
        .turned(90, "x")
        .moved(y=-0.268, z=0.40),
        cylinder("chrome", 0.035, 0.025, 28, 0.004).turned(90, "x").moved(0.10, -0.275, 0.78),
        box("dark_glass", 0.12, 0.004, 0.04, 0).moved(x=-0.03, y=-0.278, z=0.76),
    ]
    for x in (-0.24, 0.24):
        for y in (-0.2, 0.22):
            parts.append(cylinder("black_plastic", 0.022, 0.014, 14).moved(x, y))
    return joined(parts)


def dispenser(color="glass_amber", height=0.15):
    return joined(
        [
            lathe(
                color,
                [
                    (0, 0),
                    (0.034, 0),
                    (0.037, 0.005),
                    (0.037, height),
                    (0.030, height + 0.012),
                    (0.014, height + 0.016),
                    (0, height + 0.016),
                ],
                28,
                50,
            ),
            cylinder("black_plastic", 0.013, 0.03, 16, 0.002, height + 0.014),
            tube(
                "black_plastic",
                [(0, 0, height + 0.04), (0, 0, height + 0.06), (0, -0.04, height + 0.058)],
                0.005,
                8,
            ),
        ]
    )


def tumbler_with_brushes():
    parts = [
        lathe(
            "stoneware",
            [
                (0, 0),
                (0.034, 0),
                (0.037, 0.006),
                (0.037, 0.10),
                (0.033, 0.10),
                (0.032, 0.01),
                (0, 0.008),
            ],
            28,
            50,
        )
    ]
    for k, color in enumerate(("sage_paint", "clay_paint")):
        s = 1 if k else -1
        parts.append(rod(color, (s * 0.015, 0, 0.012), (-s * 0.032, 0.0, 0.175), 0.004, segments=8))
        parts.append(
            box("white_plastic", 0.012, 0.016, 0.028, 0.003).moved(-s * 0.036, -0.008, 0.150)
        )
    return joined(parts)


def paper_holder():
    """Wall at y = 0; the roll's axis at z = 0."""
    roll = lathe(
        "paper", [(0.02, -0.05), (0.055, -0.05), (0.055, 0.05), (0.02, 0.05), (0.02, -0.05)], 32, 50
    ).turned(90, "y")
    return joined(
        [
            rod("brass", (-0.075, -0.07, 0), (0.07, -0.07, 0), 0.006),
            rod("brass", (-0.075, 0, 0), (-0.075, -0.07, 0), 0.006),
            cylinder("brass", 0.022, 0.006, 20, 0.002).turned(90, "x").moved(x=-0.075),
            roll.moved(y=-0.07),
        ]
    )


def paper_roll():
    return lathe("paper", [(0.02, 0), (0.055, 0), (0.055, 0.10), (0.02, 0.10), (0.02, 0)], 32, 50)


def brush():
    return joined(
        [
            lathe(
                "stoneware_black",
                [
                    (0, 0),
                    (0.045, 0),
                    (0.048, 0.006),
                    (0.045, 0.14),
                    (0.036, 0.14),
                    (0.036, 0.01),
                    (0, 0.008),
                ],
                28,
                50,
            ),
            rod("brass", (0, 0, 0.02), (0, 0, 0.38), 0.006),
            cylinder("brass", 0.010, 0.02, 14, 0.003, 0.375),
        ]
    )


def scale():
    return joined(
        [
            extrude("white_plastic", rounded_rectangle(0.30, 0.30, 0.04), 0.028, 0.006),
            box("dark_glass", 0.09, 0.05, 0.001, 0).moved(y=0.10, z=0.028),
        ]
    )


def bath_caddy():
    """An oak board across the tub's rim, along y."""
    return joined(
        [box("oak", 0.05, 0.80, 0.018, 0.004).moved(x=x) for x in (-0.06, 0.0, 0.06)]
        + [box("oak", 0.17, 0.03, 0.012, 0.003).moved(y=y, z=-0.012) for y in (-0.25, 0.25)]
    )
