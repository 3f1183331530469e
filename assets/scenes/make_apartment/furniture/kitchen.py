"""Kitchen cabinets, worktops and what is built into them."""

from furniture.small import printed
from shapes.mesh import joined
from shapes.soft import soft_box
from shapes.solids import arc, box, cylinder, rod, slab, tube

DEPTH, COUNTER = 0.60, 0.90  # cabinets' depth, worktop's height


def _handle(width):
    bar = [rod("brass", (-width / 2, -0.03, 0), (width / 2, -0.03, 0), 0.005, segments=8)]
    for x in (-width / 2 + 0.015, width / 2 - 0.015):
        bar.append(rod("brass", (x, 0, 0), (x, -0.03, 0), 0.004, segments=8))
    return joined(bar)


def base_cabinets(widths, paint="sage_paint", bowl=None):
    """A run of cabinets without a worktop, its left end at x = 0 and back at y = 0.

    A positive width is a door, a negative one three drawers. Between the two ends of `bowl` the
    body is low enough for a sink.
    """
    top, plinth, parts, x = COUNTER - 0.04, 0.10, [], 0.0
    total = sum(abs(w) for w in widths)
    cuts = [0.0, *(bowl or ()), total]
    for k, (a, b) in enumerate(zip(cuts, cuts[1:])):
        parts.append(slab(paint, (a, -DEPTH + 0.022, plinth), (b, 0, top - 0.20 * (k == 1))))
    parts.append(slab("black_plastic", (0.0, -DEPTH + 0.07, 0), (total, -0.02, plinth)))
    for w in widths:
        wide = abs(w)
        bands = (
            [(plinth, 0.32), (plinth + 0.32, 0.26), (plinth + 0.58, top - plinth - 0.58)]
            if w < 0
            else [(plinth, top - plinth)]
        )
        for z, tall in bands:
            parts.append(
                slab(
                    paint,
                    (x + 0.002, -DEPTH, z + 0.002),
                    (x + wide - 0.002, -DEPTH + 0.02, z + tall - 0.002),
                    0.003,
                )
            )
            rim = 0.055
            if tall > 0.3:  # a framed door: four strips standing 5 mm proud
                for x0, x1, z0, z1 in (
                    (x + 0.003, x + wide - 0.003, z + 0.003, z + rim),
                    (x + 0.003, x + wide - 0.003, z + tall - rim, z + tall - 0.003),
                    (x + 0.003, x + rim, z + rim, z + tall - rim),
                    (x + wide - rim, x + wide - 0.003, z + rim, z + tall - rim),
                ):
                    parts.append(
                        slab(paint, (x0, -DEPTH - 0.005, z0), (x1, -DEPTH + 0.005, z1), 0.002)
                    )
            parts.append(
                _handle(0.16).moved(
                    x + wide / 2,
                    -DEPTH - (0.004 if tall > 0.3 else 0),
                    z + tall - (0.028 if tall > 0.3 else tall / 2),
                )
            )
        x += wide
    return joined(parts)


def worktop(length, holes=()):
    """Marble slab, left end x = 0, back y = 0; `holes` are (x0, x1, y0, y1) cut-outs."""
    z0, z1, front = COUNTER - 0.04, COUNTER, -DEPTH - 0.02
    if not holes:
        return slab("marble", (0, front, z0), (length, 0, z1), 0.004)
    parts, x = [], 0.0
    for x0, x1, y0, y1 in holes:
        parts.append(slab("marble", (x, front, z0), (x0, 0, z1)))
        parts.append(slab("marble", (x0, front, z0), (x1, y0, z1)))
        parts.append(slab("marble", (x0, y1, z0), (x1, 0, z1)))
        x = x1
    parts.append(slab("marble", (x, front, z0), (length, 0, z1)))
    return joined(parts)


def sink(width=0.54, depth=0.40, deep=0.18):
    """A steel bowl whose rim lies on the worktop; rim's underside at z = 0."""
    t, w, d = 0.006, width / 2, depth / 2
    parts = [
        slab("steel", (-w - 0.012, -d - 0.012, 0), (-w + t, d + 0.012, 0.004)),
        slab("steel", (w - t, -d - 0.012, 0), (w + 0.012, d + 0.012, 0.004)),
        slab("steel", (-w + t, -d - 0.012, 0), (w - t, -d + t, 0.004)),
        slab("steel", (-w + t, d - t, 0), (w - t, d + 0.012, 0.004)),
        slab("steel", (-w, -d, -deep), (w, d, -deep + t)),
        slab("steel", (-w, -d, -deep + t), (-w + t, d, 0)),
        slab("steel", (w - t, -d, -deep + t), (w, d, 0)),
        slab("steel", (-w + t, -d, -deep + t), (w - t, -d + t, 0)),
        slab("steel", (-w + t, d - t, -deep + t), (w - t, d, 0)),
        cylinder("chrome", 0.035, 0.004, 24, 0.001, -deep + t),
    ]
    return joined(parts)


def tap():
    """A high brass bow, spout towards -y."""
    bow = (
        [(0, 0, 0.03), (0, 0, 0.24)]
        + [(0, y - 0.09, z) for y, z in arc(0.09, 0, 180, 12, (0.0, 0.24))][1:]
        + [(0, -0.18, 0.19)]
    )
    return joined(
        [
            cylinder("brass", 0.026, 0.035, 24, 0.004),
            tube("brass", bow, 0.011, 12),
            rod("brass", (0.02, 0, 0.06), (0.075, 0, 0.085), 0.006),
        ]
    )


def oven():
    """A built-in oven's front panel, 0.59 m wide, standing on the plinth in a base cabinet run."""
    parts = [
        slab("black_lacquer", (-0.295, -DEPTH - 0.004, 0.14), (0.295, -DEPTH + 0.12, 0.70), 0.004),
        slab("dark_glass", (-0.24, -DEPTH - 0.007, 0.22), (0.24, -DEPTH, 0.54)),
        slab("steel", (-0.295, -DEPTH - 0.004, 0.705), (0.295, -DEPTH + 0.12, 0.855), 0.004),
        rod("steel", (-0.24, -DEPTH - 0.045, 0.63), (0.24, -DEPTH - 0.045, 0.63), 0.009),
    ]
    for x in (-0.21, 0.21):
        parts.append(rod("steel", (x, -DEPTH, 0.63), (x, -DEPTH - 0.045, 0.63), 0.007))
    for x in (-0.21, -0.13, 0.13, 0.21):
        parts.append(
            cylinder("black_plastic", 0.020, 0.024, 20, 0.004)
            .turned(90, "x")
            .moved(x, -DEPTH - 0.004, 0.78)
        )
    parts.append(slab("dark_glass", (-0.07, -DEPTH - 0.006, 0.755), (0.07, -DEPTH, 0.805)))
    return joined(parts)


def hob():
    return joined(
        [
            box("dark_glass", 0.58, 0.50, 0.006, 0.002),
            printed("hob", 0.56, 0.48, 0.001).turned(-90, "x").moved(y=-0.24, z=0.0062),
        ]
    )


def range_hood():
    """Back at y = 0, hangs with its lower edge at z = 0 and goes up to 1.0."""
    return joined(
        [
            box("steel", 0.60, 0.46, 0.05, 0.004).moved(y=-0.23),
            box("steel", 0.26, 0.26, 0.99, 0.004).moved(y=-0.15, z=0.045),
            box("black_plastic", 0.50, 0.36, 0.004, 0.001).moved(y=-0.23, z=-0.002),
        ]
    )


def wall_cabinet(width, height=0.70, doors=2, paint="cream_paint"):
    """Back at y = 0, bottom at z = 0."""
    depth = 0.34
    parts = [slab(paint, (-width / 2, -depth + 0.02, 0), (width / 2, 0, height))]
    each = width / doors
    for k in range(doors):
        x = -width / 2 + each * (k + 0.5)
        parts.append(
            slab(
                paint,
                (x - each / 2 + 0.002, -depth, 0.002),
                (x + each / 2 - 0.002, -depth + 0.018, height - 0.002),
                0.003,
            )
        )
        side = 1 if k % 2 == 0 else -1
        parts.append(
            _handle(0.14).turned(90, "y").moved(x + side * (each / 2 - 0.045), -depth, 0.12)
        )
    return joined(parts)


def fridge(width=0.66, height=1.92):
    depth = 0.64
    parts = [
        slab("cream_paint", (-width / 2, -depth + 0.05, 0.03), (width / 2, 0, height), 0.01),
        slab(
            "black_plastic", (-width / 2 + 0.02, -depth + 0.08, 0), (width / 2 - 0.02, -0.03, 0.03)
        ),
    ]
    for z0, z1 in ((0.04, 0.66), (0.672, height)):
        door = soft_box("cream_paint", width, 0.055, z1 - z0, 0.018, arc=3).moved(
            y=-depth + 0.0225, z=z0
        )
        parts.append(door)
    for z0, z1 in ((0.36, 0.60), (0.74, 1.14)):
        parts.append(
            rod(
                "brass",
                (-width / 2 + 0.06, -depth - 0.042, z0),
                (-width / 2 + 0.06, -depth - 0.042, z1),
                0.009,
            )
        )
        for z in (z0 + 0.03, z1 - 0.03):
            parts.append(
                rod(
                    "brass",
                    (-width / 2 + 0.06, -depth, z),
                    (-width / 2 + 0.06, -depth - 0.042, z),
                    0.007,
                )
            )
    return joined(parts)
