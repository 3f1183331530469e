"""Screens, instruments, office things."""

import math

import numpy as np

from furniture.small import printed
from shapes.mesh import joined
from shapes.soft import ribbon, soft_box
from shapes.solids import box, cylinder, extrude, lathe, rod, rounded_rectangle, tube


def television(width=1.23, height=0.71):
    """On two feet, screen towards -y."""
    parts = [
        box("black_plastic", width, 0.035, height, 0.006).moved(z=0.06),
        printed("tv", width - 0.02, height - 0.025, 0.002).moved(y=-0.0178, z=0.0745),
        box("black_plastic", width * 0.5, 0.03, height * 0.45, 0.008).moved(y=0.03, z=0.12),
    ]
    for x in (-width * 0.33, width * 0.33):
        parts.append(rod("black_metal", (x, 0, 0.08), (x, -0.10, 0.006), 0.006))
        parts.append(rod("black_metal", (x, 0, 0.08), (x, 0.10, 0.006), 0.006))
    return joined(parts).grounded()


def monitor(width=0.61, height=0.36):
    return joined(
        [
            box("white_plastic", width, 0.022, height, 0.005).moved(z=0.11),
            printed("desktop", width - 0.014, height - 0.014, 0.002).moved(y=-0.0113, z=0.117),
            box("white_plastic", 0.055, 0.02, 0.30, 0.005).moved(y=0.025, z=0.004),
            extrude("white_plastic", rounded_rectangle(0.24, 0.18, 0.03), 0.010, 0.003).moved(
                y=0.01
            ),
        ]
    )


def keyboard():
    return joined(
        [
            extrude("white_plastic", rounded_rectangle(0.36, 0.125, 0.012), 0.016, 0.004),
            printed("keys", 0.346, 0.111, 0.003).turned(-90, "x").moved(y=-0.0555, z=0.0168),
        ]
    )


def mouse():
    body = soft_box("white_plastic", 0.062, 0.11, 0.034, 0.016, arc=3, middle=4, puff=(0, 0, 0.004))
    return joined(
        [
            body,
            cylinder("grey_plastic", 0.008, 0.006, 14).turned(90, "y").moved(-0.003, -0.028, 0.034),
        ]
    )


def laptop(open_deg=108):
    lid = (
        joined(
            [
                box("steel", 0.32, 0.008, 0.215, 0.003),
                printed("laptop", 0.306, 0.20, 0.001).moved(y=-0.0042, z=0.008),
            ]
        )
        .turned(-(open_deg - 90), "x")
        .moved(y=0.105, z=0.014)
    )
    return joined(
        [
            box("steel", 0.32, 0.22, 0.014, 0.004),
            printed("keys", 0.27, 0.10, 0.001).turned(-90, "x").moved(y=-0.02, z=0.0142),
            box("grey_plastic", 0.10, 0.065, 0.0006, 0).moved(y=-0.068, z=0.014),
            lid,
        ]
    )


def pen_cup():
    parts = [
        lathe(
            "terracotta",
            [
                (0, 0),
                (0.038, 0),
                (0.040, 0.004),
                (0.040, 0.095),
                (0.036, 0.095),
                (0.036, 0.008),
                (0, 0.006),
            ],
            28,
            50,
        )
    ]
    for k, color in enumerate(("ochre_paint", "blue_paint", "black_plastic", "sage_paint", "oak")):
        a = 1.26 * k
        parts.append(
            rod(
                color,
                (0.012 * math.cos(a + 3), 0.012 * math.sin(a + 3), 0.01),
                (0.030 * math.cos(a), 0.030 * math.sin(a), 0.155 + 0.008 * (k % 3)),
                0.0036,
                segments=8,
            )
        )
    return joined(parts)


def upright_piano():
    """Back at +y; keys at 0.73 m."""
    w, d, h = 1.46, 0.56, 1.12
    parts = [
        box("walnut", w, 0.28, h - 0.03, 0.006).moved(y=d / 2 - 0.15),
        box("walnut", w + 0.03, 0.33, 0.03, 0.006).moved(y=d / 2 - 0.165, z=h - 0.03),
        box("walnut", w, 0.30, 0.05, 0.005).moved(y=-d / 2 + 0.15, z=0.64),
        printed("piano", w - 0.18, 0.15, 0.004).turned(-90, "x").moved(y=-d / 2 + 0.02, z=0.712),
        box("walnut", w - 0.18, 0.15, 0.02, 0).moved(y=-d / 2 + 0.095, z=0.69),
        box("walnut", w, 0.04, 0.10, 0.004).moved(y=-d / 2 + 0.215, z=0.69),
    ]
    for side in (-1, 1):
        parts.append(
            box("walnut", 0.09, 0.27, 0.13, 0.012).moved(
                x=side * (w / 2 - 0.045), y=-d / 2 + 0.14, z=0.64
            )
        )
        parts.append(
            rod(
                "walnut",
                (side * (w / 2 - 0.06), -d / 2 + 0.06, 0.0),
                (side * (w / 2 - 0.06), -d / 2 + 0.06, 0.64),
                0.022,
                0.032,
                14,
            )
        )
    parts.append(box("walnut", w - 0.30, 0.012, 0.30, 0.004).moved(y=d / 2 - 0.296, z=0.78))
    parts.append(box("walnut", w - 0.20, 0.012, 0.48, 0.004).moved(y=d / 2 - 0.296, z=0.10))
    for x in (-0.06, 0.06):
        parts.append(box("brass", 0.035, 0.09, 0.010, 0.003).moved(x=x, y=d / 2 - 0.33, z=0.05))
    parts.append(box("walnut", 0.60, 0.03, 0.015, 0.003).moved(y=d / 2 - 0.31, z=0.83))
    return joined(parts)


def guitar():
    """On its stand, front towards -y."""
    left = [
        (0.05, 0.0),
        (0.15, 0.02),
        (0.188, 0.09),
        (0.18, 0.16),
        (0.135, 0.225),
        (0.128, 0.27),
        (0.145, 0.33),
        (0.135, 0.40),
        (0.08, 0.455),
        (0.03, 0.465),
    ]
    dense = []
    for k in range(len(left) - 1):
        dense += [tuple(np.array(left[k]) * (1 - t) + np.array(left[k + 1]) * t) for t in (0, 0.5)]
    dense.append(left[-1])
    pts = np.array(dense)
    pts[1:-1] = (pts[:-2] + 2 * pts[1:-1] + pts[2:]) / 4
    outline = [(x, z) for x, z in pts] + [(-x, z) for x, z in pts[::-1]]
    body = extrude("walnut", outline, 0.085, 0.004, 50)
    top = extrude("oak", [(x * 0.985, 0.003 + z * 0.985) for x, z in outline], 0.003, 0.0).moved(
        z=0.0845
    )
    hole = cylinder("black_lacquer", 0.045, 0.001, 32, 0).moved(y=0.30, z=0.0872)
    ring = lathe(
        "walnut", [(0.046, 0), (0.054, 0), (0.054, 0.0012), (0.046, 0.0012), (0.046, 0)], 32, 50
    ).moved(y=0.30, z=0.0872)
    neck = box("walnut", 0.052, 0.40, 0.022, 0.006).moved(y=0.625, z=0.072)
    board = box("black_lacquer", 0.050, 0.47, 0.007, 0.001).moved(y=0.595, z=0.0945)
    head = box("walnut", 0.075, 0.16, 0.018, 0.006).moved(y=0.90, z=0.070)
    bridge = box("black_lacquer", 0.13, 0.025, 0.010, 0.003).moved(y=0.13, z=0.087)
    pegs = [
        cylinder("brass", 0.006, 0.022, 10, 0.001)
        .turned(90 * s, "y")
        .moved(s * 0.036, 0.85 + 0.045 * k, 0.079)
        for s in (-1, 1)
        for k in range(3)
    ]
    strings = [
        rod(
            "brass",
            (-0.018 + 0.0072 * k, 0.13, 0.098),
            (-0.016 + 0.0064 * k, 0.84, 0.1035),
            0.0009,
            segments=5,
        )
        for k in range(6)
    ]
    lying = joined([body, top, hole, ring, neck, board, head, bridge, *pegs, *strings])
    standing = lying.turned(90, "x").moved(z=0.14).turned(-10, "x")
    stand = []
    for s in (-1, 1):
        stand.append(
            tube(
                "black_metal",
                [(s * 0.17, -0.20, 0.008), (s * 0.10, -0.06, 0.16), (s * 0.05, 0.06, 0.33)],
                0.008,
                8,
            )
        )
        stand.append(
            rod("black_metal", (s * 0.10, -0.055, 0.155), (s * 0.10, -0.145, 0.130), 0.008)
        )
        stand.append(rod("black_metal", (s * 0.05, 0.06, 0.33), (s * 0.05, 0.20, 0.006), 0.008))
    stand.append(rod("black_metal", (-0.05, 0.06, 0.33), (0.05, 0.06, 0.33), 0.008))
    model = joined([standing.moved(y=-0.03), *stand])
    return model.moved(z=-model.low()[2])


def printer():
    return joined(
        [
            soft_box("white_plastic", 0.44, 0.36, 0.16, 0.02),
            box("grey_plastic", 0.34, 0.26, 0.012, 0.004).moved(y=0.0, z=0.158),
            box("dark_glass", 0.09, 0.004, 0.05, 0).moved(x=0.14, y=-0.179, z=0.095),
            box("black_plastic", 0.28, 0.05, 0.03, 0.003).moved(y=-0.162, z=0.03),
            box("white_plastic", 0.26, 0.14, 0.008, 0.002).moved(y=-0.23, z=0.03),
            box("paper", 0.21, 0.13, 0.004, 0).moved(y=-0.23, z=0.038),
        ]
    )


def waste_bin():
    return lathe(
        "sage_paint",
        [
            (0, 0),
            (0.115, 0),
            (0.118, 0.006),
            (0.14, 0.32),
            (0.134, 0.32),
            (0.112, 0.01),
            (0, 0.008),
        ],
        32,
        50,
    )


def pin_board(width=0.9, height=0.6):
    """Wall at y = 0, middle at z = 0; with notes pinned to it."""
    parts = [box("cork", width, 0.012, height, 0.001).moved(y=-0.006, z=-height / 2)]
    for sx, sz, x, z in (
        (width + 0.03, 0.02, 0, height / 2 - 0.005),
        (width + 0.03, 0.02, 0, -height / 2 - 0.015),
        (0.02, height, -width / 2 - 0.005, -height / 2),
        (0.02, height, width / 2 + 0.005, -height / 2),
    ):
        parts.append(box("oak", sx, 0.022, sz, 0.003).moved(x=x, y=-0.011, z=z))
    for k, (picture, w, h, x, z, tilt) in enumerate(
        (
            ("notes", 0.16, 0.21, -0.29, -0.04, 3),
            ("branch", 0.12, 0.17, -0.08, 0.02, -4),
            ("sea", 0.20, 0.14, 0.14, 0.07, 2),
            ("hills", 0.17, 0.115, 0.12, -0.15, -3),
            ("notes", 0.11, 0.15, 0.33, -0.12, 5),
        )
    ):
        card = printed(picture, w, h, 0.0015).turned(tilt, "y").moved(x, -0.0130, z)
        parts.append(card)
        parts.append(
            cylinder("clay_paint" if k % 2 else "brass", 0.007, 0.008, 12, 0.002)
            .turned(90, "x")
            .moved(x, -0.0135, z + h * 0.88)
        )
    return joined(parts)


def yoga_mat():
    spiral = [
        (0.018 + 0.0032 * t) * np.array([math.cos(t), math.sin(t)]) for t in np.linspace(0, 15, 70)
    ]
    return ribbon("stoneware_sage", spiral[::-1], 0.007, 0.61).turned(90, "y").moved(z=0.305)
