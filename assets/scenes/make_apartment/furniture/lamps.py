"""Lamps. Shades are thin shells, bulbs glow."""

import math

from shapes.mesh import joined
from shapes.soft import ellipsoid
from shapes.solids import cylinder, lathe, rod, tube


def shade(material, low, high, height, thickness=0.003, segments=32):
    """An open cone: outside up, inside down."""
    return lathe(
        material,
        [
            (low - thickness, 0),
            (low, 0),
            (high, height),
            (high - thickness, height),
            (low - thickness, 0),
        ],
        segments,
    )


def floor_lamp():
    """Three oak legs, a linen shade; 1.55 m."""
    parts = []
    for k in range(3):
        a = math.radians(120 * k + 90)
        foot = (0.26 * math.cos(a), 0.26 * math.sin(a), 0.0)
        parts.append(
            rod("oak", foot, (0.02 * math.cos(a), 0.02 * math.sin(a), 1.18), 0.011, 0.013, 12)
        )
    parts += [
        cylinder("brass", 0.032, 0.05, 20, base=1.15),
        cylinder("brass", 0.009, 0.22, 10, base=1.19),
        shade("lampshade", 0.23, 0.17, 0.32).moved(z=1.24),
        ellipsoid("opal", 0.07, 0.07, 0.10).moved(z=1.33),
    ]
    return joined(parts)


def arc_lamp(reach=0.95, height=1.95):
    """Marble foot, a long brass bow, a dome over the chair; the dome hangs at -y."""
    bow = [(0, 0, 0.05), (0, 0, 0.9)]
    for k in range(1, 13):
        a = math.pi / 12 * k * 0.86
        bow.append(
            (
                0,
                -reach / 2 * (1 - math.cos(a)),
                0.9
                + (height - 0.9) * math.sin(min(a, math.pi / 2))
                - max(0.0, a - math.pi / 2) * 0.10,
            )
        )
    end = bow[-1]
    dome = lathe(
        "brass",
        [
            (0.147, 0),
            (0.15, 0),
            (0.142, 0.06),
            (0.11, 0.12),
            (0.03, 0.16),
            (0, 0.162),
            (0, 0.157),
            (0.028, 0.155),
            (0.107, 0.117),
            (0.139, 0.058),
            (0.147, 0),
        ],
        32,
        50,
    )
    place = dict(y=end[1], z=end[2] - 0.19)
    return joined(
        [
            cylinder("marble", 0.15, 0.055, 40, 0.008),
            tube("brass", bow, 0.009, 10),
            rod("brass", end, (end[0], end[1], end[2] - 0.04), 0.007),
            dome.moved(**place),
            ellipsoid("opal", 0.08, 0.08, 0.09).moved(y=end[1], z=end[2] - 0.15),
        ]
    )


def table_lamp(body="stoneware_sage", height=0.42):
    """A turned ceramic body under a linen shade."""
    profile = [
        (0, 0),
        (0.055, 0),
        (0.06, 0.006),
        (0.085, 0.07),
        (0.082, 0.12),
        (0.05, 0.17),
        (0.02, 0.20),
        (0.014, 0.21),
        (0, 0.21),
    ]
    return joined(
        [
            lathe(body, profile, 32, 45),
            cylinder("brass", 0.007, 0.10, 10, base=0.205),
            shade("lampshade", 0.14, 0.10, 0.18).moved(z=height - 0.18),
            ellipsoid("opal", 0.05, 0.05, 0.07).moved(z=height - 0.14),
        ]
    )


def mushroom_lamp(color="clay_paint"):
    """A metal dome on a stem."""
    dome = lathe(
        color,
        [
            (0.0, 0.20),
            (0.108, 0.20),
            (0.112, 0.204),
            (0.110, 0.23),
            (0.101, 0.256),
            (0.086, 0.28),
            (0.065, 0.30),
            (0.036, 0.315),
            (0, 0.32),
        ],
        36,
        50,
    )
    return joined(
        [
            cylinder(color, 0.075, 0.018, 36, 0.006),
            cylinder(color, 0.016, 0.19, 16, base=0.015),
            dome,
            ellipsoid("opal", 0.08, 0.08, 0.03).moved(z=0.185),
        ]
    )


def desk_lamp():
    """Jointed arm in black metal."""
    elbow, head = (-0.10, 0.0, 0.30), (0.14, -0.02, 0.44)
    cone = lathe(
        "black_metal",
        [(0, 0.0), (0.062, 0), (0.065, 0.004), (0.03, 0.075), (0.018, 0.10), (0, 0.10)],
        24,
        50,
    )
    return joined(
        [
            cylinder("black_metal", 0.08, 0.016, 32, 0.005),
            rod("black_metal", (0, 0, 0.01), elbow, 0.007),
            rod("black_metal", elbow, head, 0.007),
            ellipsoid("brass", 0.026, 0.026, 0.026).moved(*elbow[:2], elbow[2] - 0.013),
            cone.turned(-25, "y").moved(head[0] + 0.035, head[1], head[2] - 0.085),
        ]
    )


def pendant(drop=0.95, material="rattan", width=0.46):
    """Hangs from z = 0 downwards: a bell of wicker, or a dome."""
    low, r = -drop, width / 2
    bell = [
        (r - 0.004, 0),
        (r, 0),
        (r * 0.93, 0.07),
        (r * 0.72, 0.15),
        (r * 0.40, 0.21),
        (0.05, 0.235),
        (0.03, 0.25),
        (0.027, 0.247),
        (0.047, 0.231),
        (r * 0.40 - 0.006, 0.205),
        (r * 0.72 - 0.006, 0.146),
        (r * 0.93 - 0.005, 0.068),
        (r - 0.004, 0),
    ]
    return joined(
        [
            lathe(material, bell, 40, 50).moved(z=low),
            cylinder("black_plastic", 0.004, drop - 0.26, 8, base=low + 0.24),
            cylinder("brass", 0.018, 0.06, 16, base=low + 0.20),
            cylinder("brass", 0.05, 0.022, 28, base=-0.022),
            ellipsoid("opal", 0.095, 0.095, 0.11).moved(z=low + 0.10),
        ]
    )


def globe_pendant(drop=0.55, width=0.30):
    return joined(
        [
            ellipsoid("opal", width, width, width, 32, 18).moved(z=-drop),
            cylinder("brass", 0.03, 0.03, 20, base=-drop + width - 0.012),
            cylinder("brass", 0.005, drop - width, 8, base=-drop + width),
            cylinder("brass", 0.05, 0.02, 28, base=-0.02),
        ]
    )


def ceiling_disc(width=0.36):
    """A flat opal lamp under the ceiling at z = 0."""
    r = width / 2
    return joined(
        [
            lathe(
                "opal",
                [
                    (0, -0.075),
                    (r * 0.6, -0.07),
                    (r * 0.93, -0.05),
                    (r, -0.025),
                    (r, -0.012),
                    (0, -0.012),
                ],
                40,
                50,
            ),
            cylinder("brass", r * 0.94, 0.012, 40, 0.002, -0.012),
        ]
    )


def wall_lamp():
    """Globe on a brass arm; the wall is at y = 0."""
    return joined(
        [
            cylinder("brass", 0.05, 0.016, 28, 0.004).turned(90, "x"),
            tube("brass", [(0, -0.014, 0), (0, -0.08, 0.0), (0, -0.10, 0.03)], 0.006, 10),
            cylinder("brass", 0.022, 0.025, 18, base=0.025).moved(y=-0.10),
            ellipsoid("opal", 0.13, 0.13, 0.13, 24, 14).moved(y=-0.10, z=0.045),
        ]
    )
