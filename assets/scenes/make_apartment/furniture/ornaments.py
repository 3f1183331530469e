"""Things with works inside, and things that are only looked at."""

import math

import numpy as np

from furniture.small import printed
from shapes.mesh import joined
from shapes.soft import ellipsoid, soft_box
from shapes.solids import arc, box, cylinder, extrude, lathe, rod, tube


def framed(picture, width, height, frame="oak", mat=0.0, depth=0.022):
    """A picture on a wall: its back at y = 0, its middle at z = 0."""
    rim = 0.018
    w, h = width + 2 * (mat + rim), height + 2 * (mat + rim)
    parts = []
    for z in (-h / 2, h / 2 - rim):
        parts.append(box(frame, w, depth, rim, 0.002).moved(y=-depth / 2, z=z))
    for x in (-w / 2 + rim / 2, w / 2 - rim / 2):
        parts.append(
            box(frame, rim, depth, h - 2 * rim, 0.002).moved(x=x, y=-depth / 2, z=-h / 2 + rim)
        )
    parts.append(box("paper", w - rim, 0.008, h - rim, 0.0).moved(y=-0.006, z=-h / 2 + rim / 2))
    parts.append(printed(picture, width, height, 0.002).moved(y=-0.011, z=-height / 2))
    return joined(parts)


def photo_stand(picture, width=0.13, height=0.18, frame="brass"):
    """A small frame leaning back on its strut."""
    face = framed(picture, width, height, frame, 0.012, 0.014).moved(z=height / 2 + 0.03)
    tilted = face.turned(-12, "x")
    strut = box("black_plastic", 0.03, 0.004, height * 0.75, 0.0).turned(22, "x").moved(y=0.075)
    model = joined([tilted, strut.moved(z=0.004)])
    return model.moved(z=-model.low()[2])


def clock(radius=0.16):
    """Hangs with its back at y = 0, middle at z = 0."""
    rim = lathe(
        "oak",
        [
            (0, 0),
            (radius, 0),
            (radius, 0.035),
            (radius - 0.014, 0.04),
            (radius - 0.018, 0.022),
            (0, 0.022),
        ],
        48,
        50,
    ).turned(90, "x")
    face = extrude("clock", arc(radius - 0.017, 0, 352.5, 47), 0.002)
    for part in face.parts:
        part.uvs = part.positions[:, :2] / (2 * (radius - 0.017)) + 0.5
    return joined([rim, face.turned(90, "x").moved(y=-0.022)])


def round_mirror(radius=0.36, frame="brass"):
    ring = lathe(
        frame,
        [
            (0, 0),
            (radius, 0),
            (radius, 0.022),
            (radius - 0.012, 0.022),
            (radius - 0.014, 0.014),
            (0, 0.014),
        ],
        56,
        50,
    ).turned(90, "x")
    return joined(
        [ring, cylinder("mirror", radius - 0.014, 0.003, 56, 0).turned(90, "x").moved(y=-0.014)]
    )


def remote():
    parts = [soft_box("black_plastic", 0.045, 0.17, 0.018, 0.007)]
    for k in range(9):
        parts.append(
            cylinder("grey_plastic", 0.0055, 0.003, 10, 0.001, 0.0172).moved(
                x=-0.012 + 0.012 * (k % 3), y=-0.05 + 0.016 * (k // 3)
            )
        )
    parts.append(cylinder("clay_paint", 0.006, 0.003, 10, 0.001, 0.0172).moved(y=0.065))
    return joined(parts)


def speaker():
    parts = [
        box("walnut", 0.17, 0.20, 0.28, 0.005),
        box("black_plastic", 0.16, 0.006, 0.27, 0.003).moved(y=-0.102, z=0.005),
    ]
    for z, r in ((0.095, 0.058), (0.21, 0.030)):
        cone = lathe(
            "grey_plastic",
            [(0, 0), (r, 0), (r, 0.006), (r * 0.9, 0.008), (r * 0.35, 0.001), (0, 0.004)],
            28,
            50,
        )
        parts.append(cone.turned(90, "x").moved(y=-0.104, z=z))
    return joined(parts)


def radio():
    return joined(
        [
            soft_box("oak", 0.27, 0.11, 0.16, 0.022),
            box("rattan", 0.15, 0.006, 0.11, 0.002).moved(x=-0.045, y=-0.056, z=0.025),
            cylinder("brass", 0.022, 0.016, 24, 0.003).turned(90, "x").moved(0.085, -0.054, 0.105),
            cylinder("brass", 0.012, 0.014, 20, 0.003).turned(90, "x").moved(0.085, -0.054, 0.05),
        ]
    )


def record_player():
    return joined(
        [
            box("walnut", 0.44, 0.36, 0.09, 0.006).moved(z=0.012),
            cylinder("steel", 0.148, 0.012, 48, 0.003, 0.102).moved(x=-0.045),
            cylinder("black_lacquer", 0.150, 0.004, 48, 0.001, 0.114).moved(x=-0.045),
            cylinder("clay_paint", 0.05, 0.0012, 32, 0, 0.118).moved(x=-0.045),
            cylinder("brass", 0.022, 0.035, 20, 0.003, 0.102).moved(0.17, 0.12),
            tube(
                "steel",
                [(0.17, 0.12, 0.132), (0.165, -0.04, 0.132), (0.07, -0.10, 0.123)],
                0.0045,
                8,
            ),
            *[
                cylinder("black_plastic", 0.018, 0.012, 14).moved(x, y)
                for x in (-0.18, 0.18)
                for y in (-0.14, 0.14)
            ],
        ]
    )


def globe():
    ball = ellipsoid("globe", 0.25, 0.25, 0.25, 36, 20)
    part = ball.parts[0]
    part.uvs = part.uvs / np.array([math.pi * 0.25, math.pi * 0.25 / 2])
    ring = tube(
        "brass",
        [
            (0.138 * math.cos(a), 0, 0.138 * math.sin(a))
            for a in np.radians(np.linspace(-78, 102, 25))
        ],
        0.005,
        8,
    )
    return joined(
        [
            cylinder("walnut", 0.085, 0.02, 36, 0.005),
            cylinder("brass", 0.010, 0.045, 12, base=0.018),
            ball.moved(z=-0.125).turned(20, "y").moved(z=0.20),
            ring.turned(12, "y").moved(z=0.20),
        ]
    )


def hourglass():
    return joined(
        [
            cylinder("walnut", 0.045, 0.012, 28, 0.003),
            cylinder("walnut", 0.045, 0.012, 28, 0.003, 0.148),
            lathe(
                "glass",
                [
                    (0, 0.012),
                    (0.034, 0.014),
                    (0.036, 0.045),
                    (0.006, 0.080),
                    (0.006, 0.084),
                    (0.036, 0.118),
                    (0.034, 0.146),
                    (0, 0.148),
                ],
                28,
                60,
            ),
            lathe("cork", [(0, 0.0125), (0.032, 0.0145), (0.030, 0.03), (0, 0.045)], 24),
            *[
                rod(
                    "brass",
                    (0.038 * math.cos(a), 0.038 * math.sin(a), 0.01),
                    (0.038 * math.cos(a), 0.038 * math.sin(a), 0.15),
                    0.003,
                    segments=8,
                )
                for a in (0.5, 2.6, 4.7)
            ],
        ]
    )


def bust():
    """A smooth abstract head."""
    return joined(
        [
            box("marble", 0.09, 0.09, 0.05, 0.004),
            cylinder("white_clay", 0.030, 0.07, 24, 0.006, 0.05),
            ellipsoid("white_clay", 0.12, 0.145, 0.17, 28, 18).moved(y=-0.012, z=0.105),
            ellipsoid("white_clay", 0.026, 0.035, 0.05).moved(y=-0.083, z=0.160),
        ]
    )


def knot():
    """A ceramic ring sculpture."""
    ring = tube(
        "white_clay",
        [
            (0.085 * math.cos(a), 0, 0.085 * math.sin(a))
            for a in np.linspace(0, 2 * math.pi, 33)[:-1]
        ],
        0.026,
        14,
        closed=True,
    )
    second = tube(
        "terracotta",
        [
            (0.058 * math.cos(a), 0, 0.058 * math.sin(a))
            for a in np.linspace(0, 2 * math.pi, 29)[:-1]
        ],
        0.020,
        14,
        closed=True,
    )
    return joined([ring.moved(z=0.111), second.turned(90, "z").moved(x=0.10, z=0.078)])
