"""What stands on a worktop: pots, machines, food."""

import math

from shapes.mesh import joined
from shapes.soft import ellipsoid, ribbon, soft_box
from shapes.solids import box, cylinder, lathe, rod, tube


def kettle():
    body = lathe(
        "sage_paint",
        [
            (0, 0),
            (0.082, 0),
            (0.088, 0.008),
            (0.090, 0.04),
            (0.074, 0.14),
            (0.055, 0.185),
            (0.02, 0.20),
            (0, 0.20),
        ],
        36,
        50,
    )
    return joined(
        [
            body,
            ellipsoid("oak", 0.028, 0.028, 0.028).moved(z=0.198),
            tube(
                "sage_paint",
                [(0, -0.07, 0.07), (0, -0.115, 0.11), (0, -0.145, 0.165)],
                [0.019, 0.014, 0.010],
                14,
            ),
            tube(
                "oak",
                [(0, 0.062, 0.17), (0, 0.105, 0.175), (0, 0.118, 0.11), (0, 0.085, 0.06)],
                0.010,
                10,
            ),
        ]
    )


def toaster():
    parts = [
        soft_box("cream_paint", 0.29, 0.17, 0.185, 0.045, arc=3).moved(z=0.012),
        box("black_plastic", 0.25, 0.13, 0.014, 0.002),
    ]
    for y in (-0.032, 0.032):
        parts.append(box("black_metal", 0.20, 0.022, 0.002, 0).moved(y=y, z=0.1965))
        parts.append(soft_box("bread", 0.12, 0.015, 0.05, 0.007).moved(x=0.0, y=y, z=0.19))
    parts.append(box("black_plastic", 0.02, 0.03, 0.014, 0.003).moved(x=0.152, z=0.13))
    parts.append(cylinder("brass", 0.014, 0.016, 18, 0.003).turned(90, "y").moved(0.143, 0.0, 0.06))
    return joined(parts)


def coffee_machine():
    return joined(
        [
            box("black_lacquer", 0.20, 0.30, 0.03, 0.006),
            box("black_lacquer", 0.20, 0.12, 0.30, 0.012).moved(y=0.09, z=0.025),
            soft_box("steel", 0.20, 0.30, 0.10, 0.02).moved(z=0.26),
            cylinder("black_plastic", 0.035, 0.05, 20, 0.004, 0.215).moved(y=-0.06),
            rod("black_plastic", (0, -0.06, 0.235), (0, -0.20, 0.225), 0.011),
            box("steel", 0.15, 0.14, 0.006, 0.002).moved(y=-0.07, z=0.03),
            cylinder("brass", 0.016, 0.02, 18, 0.003).turned(90, "x").moved(0.06, -0.148, 0.31),
        ]
    )


def pot(color="clay_paint", radius=0.12, height=0.13):
    """An enamelled pot with its lid on."""
    r, h = radius, height
    parts = [
        lathe(color, [(0, 0), (r - 0.01, 0), (r, 0.012), (r, h), (0, h)], 36, 50),
        lathe(
            color,
            [(0, h), (r + 0.004, h), (r + 0.004, h + 0.008), (r * 0.6, h + 0.026), (0, h + 0.032)],
            36,
            40,
        ),
        cylinder("brass", 0.018, 0.026, 20, 0.004, h + 0.028),
    ]
    for side in (-1, 1):
        parts.append(
            tube(
                color,
                [
                    (side * r * 0.97, -0.035, h * 0.78),
                    (side * (r + 0.035), -0.03, h * 0.80),
                    (side * (r + 0.035), 0.03, h * 0.80),
                    (side * r * 0.97, 0.035, h * 0.78),
                ],
                0.007,
                8,
            )
        )
    return joined(parts)


def pan():
    return joined(
        [
            lathe(
                "black_metal",
                [(0, 0), (0.10, 0), (0.13, 0.045), (0.127, 0.045), (0.098, 0.005), (0, 0.005)],
                36,
                50,
            ),
            tube(
                "oak",
                [(0, -0.125, 0.035), (0, -0.21, 0.055), (0, -0.30, 0.06)],
                [0.009, 0.011, 0.012],
                10,
            ),
        ]
    )


def cutting_board(width=0.26, height=0.40):
    """Leaning upright against the wall at +y."""
    return box("walnut", width, 0.02, height, 0.006).turned(-9, "x").moved(z=0.0016)


def board_flat():
    return box("oak", 0.36, 0.22, 0.022, 0.006)


def loaf():
    body = soft_box("bread", 0.11, 0.24, 0.095, 0.045, arc=3, middle=6, puff=(0.004, 0.008, 0.012))
    return joined(
        [body]
        + [
            tube(
                "paper",
                [(-0.03, y, 0.103), (0.0, y + 0.018, 0.1085), (0.03, y + 0.03, 0.102)],
                0.004,
                6,
            )
            for y in (-0.08, -0.02, 0.04)
        ]
    )


def knife_block():
    parts = [box("walnut", 0.11, 0.15, 0.20, 0.006).turned(0)]
    for k, x in enumerate((-0.035, -0.012, 0.012, 0.035)):
        parts.append(
            box("black_plastic", 0.014, 0.024, 0.085 - 0.006 * k, 0.004).moved(
                x, 0.03 - 0.02 * (k % 2), 0.20
            )
        )
    return joined(parts)


def apple(color):
    return joined(
        [
            lathe(
                color,
                [
                    (0, 0.006),
                    (0.012, 0.0),
                    (0.028, 0.008),
                    (0.039, 0.034),
                    (0.037, 0.055),
                    (0.024, 0.069),
                    (0.008, 0.064),
                    (0, 0.058),
                ],
                24,
                60,
            ),
            tube("bark", [(0, 0, 0.058), (0.002, 0, 0.07), (0.006, 0, 0.08)], 0.0016, 6),
        ]
    )


def lemon():
    return (
        lathe(
            "lemon",
            [
                (0, 0),
                (0.006, 0.004),
                (0.022, 0.014),
                (0.029, 0.038),
                (0.022, 0.062),
                (0.007, 0.073),
                (0, 0.078),
            ],
            20,
            60,
        )
        .turned(90, "y")
        .moved(x=-0.039, z=0.029)
    )


def orange():
    return ellipsoid("orange", 0.076, 0.076, 0.072, 20, 12)


def utensils():
    parts = [
        lathe(
            "stoneware",
            [
                (0, 0),
                (0.05, 0),
                (0.054, 0.006),
                (0.056, 0.15),
                (0.051, 0.15),
                (0.048, 0.012),
                (0, 0.01),
            ],
            32,
            50,
        )
    ]
    for k, (a, tall) in enumerate(((0.3, 0.30), (1.6, 0.27), (2.9, 0.32), (4.4, 0.28))):
        foot, top = (0.018 * math.cos(a), 0.018 * math.sin(a), 0.014), (
            0.05 * math.cos(a),
            0.05 * math.sin(a),
            tall,
        )
        parts.append(rod("oak", foot, top, 0.005, 0.006))
        parts.append(
            ellipsoid("oak" if k % 2 else "walnut", 0.05, 0.018, 0.075)
            .turned(math.degrees(a))
            .moved(*top[:2], tall - 0.012)
        )
    return joined(parts)


def towel_rail_cloth(cloth="checks"):
    """A tea towel over an oven's bar; its fold at z = 0, bar at y = 0."""

    path = (
        [(-0.012, -0.42), (-0.013, -0.10), (-0.0125, -0.01)]
        + [(0.0125 * math.cos(a), 0.0125 * math.sin(a)) for a in (2.6, 2.0, 1.57, 1.1, 0.5)]
        + [(0.0125, -0.01), (0.013, -0.12), (0.012, -0.34)]
    )
    return ribbon(cloth, path, 0.004, 0.30)
