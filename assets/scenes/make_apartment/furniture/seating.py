"""Sofas, chairs, stools, the bench."""

import math

from shapes.mesh import joined
from shapes.soft import ribbon, soft_box
from shapes.solids import arc, box, cylinder, extrude, rod, rounded_rectangle, tube


def _legs(material, xs, ys, height, top, foot, splay=0.0):
    """Tapered round legs; `splay` moves the feet outwards."""
    legs = []
    for x in xs:
        for y in ys:
            out = (math.copysign(splay, x), math.copysign(splay, y))
            legs.append(rod(material, (x + out[0], y + out[1], 0), (x, y, height), foot, top, 12))
    return joined(legs)


def sofa(width=2.2, depth=0.92, cloth="linen_oat", seats=3):
    """Seat at 0.43 m; loose seat and back cushions between slim arms."""
    arm, base = 0.17, 0.14
    inner = width - 2 * arm
    parts = [
        _legs(
            "oak",
            (-width / 2 + 0.12, width / 2 - 0.12),
            (-depth / 2 + 0.1, depth / 2 - 0.1),
            base,
            0.024,
            0.015,
        ),
        soft_box(cloth, width - 0.04, depth - 0.04, 0.15, 0.03).moved(z=base),
        soft_box(cloth, width - 0.02, 0.20, 0.66, 0.07).moved(y=depth / 2 - 0.11, z=base + 0.02),
    ]
    for side in (-1, 1):
        parts.append(
            soft_box(cloth, arm, depth - 0.02, 0.46, 0.06, middle=4, puff=(0.01, 0, 0.01)).moved(
                x=side * (width - arm) / 2, z=base
            )
        )
    each = inner / seats
    for k in range(seats):
        x = -inner / 2 + each * (k + 0.5)
        parts.append(
            soft_box(
                cloth, each - 0.006, depth - 0.24, 0.14, 0.045, middle=4, puff=(0, 0, 0.016)
            ).moved(x=x, y=-0.11, z=base + 0.145)
        )
        parts.append(
            soft_box(cloth, each - 0.012, 0.17, 0.40, 0.06, middle=4, puff=(0, 0.025, 0.0))
            .turned(-12, "x")
            .moved(x=x, y=depth / 2 - 0.34, z=base + 0.31)
        )
    return joined(parts)


def armchair(cloth="boucle", width=0.78):
    """A round-backed chair; the shell wraps from arm to arm."""
    outer, inner, steps = width / 2, width / 2 - 0.13, 18
    shell = arc(outer, -32, 212, steps) + arc(inner, 212, -32, steps)
    parts = [_legs("walnut", (-0.24, 0.24), (-0.22, 0.22), 0.16, 0.02, 0.013, 0.03)]
    parts.append(extrude(cloth, shell, 0.54, 0.035).moved(z=0.15))
    parts.append(
        soft_box(cloth, 2 * inner + 0.02, 2 * inner + 0.02, 0.10, 0.045).moved(y=-0.03, z=0.15)
    )
    parts.append(
        soft_box(
            cloth, 2 * inner - 0.03, 2 * inner + 0.06, 0.17, 0.07, middle=4, puff=(0, 0, 0.02)
        ).moved(y=-0.06, z=0.24)
    )
    return joined(parts).grounded()


def lounge_chair():
    """Oak frame with leather sling cushions, for reading."""
    parts = []
    for side in (-0.32, 0.32):
        parts.append(
            tube(
                "oak",
                [(side, 0.36, 0.0), (side, 0.27, 0.30), (side, 0.10, 0.60)],
                [0.014, 0.018, 0.014],
                10,
            )
        )
        parts.append(tube("oak", [(side, -0.34, 0.0), (side, -0.30, 0.58)], [0.014, 0.018], 10))
        parts.append(box("oak", 0.06, 0.62, 0.028, 0.008).moved(x=side, y=-0.08, z=0.575))
        parts.append(rod("oak", (side, -0.32, 0.30), (side, 0.28, 0.22), 0.014))
    parts.append(rod("oak", (-0.32, -0.31, 0.28), (0.32, -0.31, 0.28), 0.014))
    parts.append(rod("oak", (-0.32, 0.26, 0.24), (0.32, 0.26, 0.24), 0.014))
    parts.append(
        soft_box("leather", 0.58, 0.60, 0.13, 0.045, middle=4, puff=(0, 0, 0.012))
        .turned(-7, "x")
        .moved(y=-0.03, z=0.265)
    )
    parts.append(
        soft_box("leather", 0.58, 0.13, 0.60, 0.045, middle=4, puff=(0, 0.015, 0))
        .turned(-22, "x")
        .moved(y=0.20, z=0.36)
    )
    return joined(parts).grounded()


def dining_chair(seat="cord"):
    """A light oak chair with a bent top rail and a woven seat at 0.45 m."""
    parts = []
    for side in (-1, 1):
        parts.append(
            tube("oak", [(side * 0.20, -0.20, 0), (side * 0.205, -0.20, 0.44)], [0.012, 0.017], 10)
        )
        parts.append(
            tube(
                "oak",
                [
                    (side * 0.185, 0.22, 0),
                    (side * 0.19, 0.19, 0.40),
                    (side * 0.20, 0.215, 0.60),
                    (side * 0.215, 0.25, 0.74),
                ],
                [0.012, 0.018, 0.016, 0.012],
                10,
            )
        )
        parts.append(rod("oak", (side * 0.20, -0.20, 0.25), (side * 0.187, 0.205, 0.25), 0.009))
        parts.append(rod("oak", (side * 0.20, -0.20, 0.42), (side * 0.19, 0.19, 0.42), 0.013))
    for y in (-0.20, 0.195):
        parts.append(rod("oak", (-0.20, y, 0.42), (0.20, y, 0.42), 0.013))
    parts.append(soft_box(seat, 0.43, 0.42, 0.032, 0.014).moved(y=-0.005, z=0.42))
    bow = [
        (x, 0.27 - 0.20 * (x / 0.26) ** 2 * 0.55) for x in [-0.25 + 0.5 * k / 14 for k in range(15)]
    ]
    rail = [(x, y + 0.014) for x, y in bow[::-1]] + [(x, y - 0.008) for x, y in bow]
    parts.append(extrude("oak", rail, 0.075, 0.004, 30).moved(z=0.70))
    return joined(parts)


def office_chair():
    """Five-star base, gas spring, shell with a padded seat."""
    parts = [
        cylinder("black_metal", 0.03, 0.30, 14, base=0.09),
        cylinder("black_plastic", 0.045, 0.06, 14, base=0.07),
    ]
    for k in range(5):
        a = math.radians(72 * k + 18)
        end = (0.29 * math.cos(a), 0.29 * math.sin(a))
        parts.append(
            tube(
                "steel",
                [(0.03 * math.cos(a), 0.03 * math.sin(a), 0.105), (end[0], end[1], 0.075)],
                [0.022, 0.014],
                8,
            )
        )
        parts.append(
            cylinder("black_plastic", 0.027, 0.03, 12)
            .turned(90, "x")
            .turned(72 * k + 18)
            .moved(end[0] - 0.015 * math.sin(a), end[1] + 0.015 * math.cos(a), 0.027)
        )
    parts.append(box("black_plastic", 0.24, 0.20, 0.025, 0.01).moved(z=0.385))
    parts.append(
        soft_box("linen_sage", 0.49, 0.48, 0.075, 0.035, middle=4, puff=(0, 0, 0.008)).moved(z=0.41)
    )
    parts.append(tube("black_metal", [(0, 0.12, 0.40), (0, 0.27, 0.42), (0, 0.29, 0.62)], 0.018, 8))
    parts.append(
        soft_box("linen_sage", 0.44, 0.07, 0.46, 0.033, middle=4, puff=(0, 0.012, 0))
        .turned(-8, "x")
        .moved(y=0.235, z=0.55)
    )
    for side in (-1, 1):
        parts.append(
            tube(
                "black_metal",
                [(side * 0.23, 0.05, 0.43), (side * 0.275, 0.05, 0.45), (side * 0.275, 0.05, 0.63)],
                0.012,
                8,
            )
        )
        parts.append(
            soft_box("black_plastic", 0.06, 0.24, 0.028, 0.012).moved(x=side * 0.275, z=0.63)
        )
    return joined(parts)


def stool(seat="oak", height=0.45):
    return joined(
        [
            _legs("oak", (-0.11, 0.11), (-0.11, 0.11), height - 0.03, 0.016, 0.012, 0.035),
            cylinder(seat, 0.17, 0.035, 28, 0.01, height - 0.035),
        ]
    ).grounded()


def piano_stool():
    parts = [
        _legs("black_lacquer", (-0.22, 0.22), (-0.12, 0.12), 0.42, 0.02, 0.014),
        box("black_lacquer", 0.54, 0.34, 0.05, 0.005).moved(z=0.40),
        soft_box("leather_black", 0.53, 0.33, 0.06, 0.025, middle=4, puff=(0, 0, 0.008)).moved(
            z=0.45
        ),
    ]
    return joined(parts)


def bench(width=1.2):
    """Upholstered seat on an oak frame for the end of the bed."""
    return joined(
        [
            _legs("oak", (-width / 2 + 0.07, width / 2 - 0.07), (-0.13, 0.13), 0.34, 0.02, 0.014),
            box("oak", width, 0.36, 0.05, 0.006).moved(z=0.32),
            soft_box(
                "linen_clay", width - 0.02, 0.36, 0.085, 0.035, middle=4, puff=(0, 0, 0.006)
            ).moved(z=0.37),
        ]
    )


def pouf():
    """A knitted footstool."""
    return soft_box("knit_cream", 0.52, 0.52, 0.36, 0.165, arc=5, middle=4, puff=(0.02, 0.02, 0.01))


def throw(cloth, width, path):
    """A folded blanket laid along a path in (y, z)."""
    return ribbon(cloth, path, 0.012, width)


def seat_pad():
    return extrude("linen_clay", rounded_rectangle(0.40, 0.38, 0.08), 0.025, 0.008)
