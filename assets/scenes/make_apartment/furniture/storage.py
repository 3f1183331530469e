"""Shelves, wardrobes, hooks."""

from shapes.mesh import joined
from shapes.solids import arc, box, cylinder, rod, tube


def bookshelf(width=1.3, depth=0.32, height=2.0, shelves=5, bays=1, body="oak", back=True):
    """Open shelves. Returns the model and the height of each board a thing can stand on."""
    board, foot = 0.022, 0.07
    parts = []
    sides = [-width / 2 + board / 2 + k * (width - board) / bays for k in range(bays + 1)]
    for k, x in enumerate(sides):
        outer = k in (0, bays)
        low = 0.0 if outer else foot + board
        high = height if outer else height - board
        parts.append(box(body, board, depth, high - low, 0.003, "z").moved(x=x, z=low))
    levels = []
    for k in range(shelves + 1):
        z = foot + (height - foot - board) * k / shelves
        parts.append(box(body, width - 2 * board, depth - 0.004, board, 0.002, "x").moved(z=z))
        levels.append(z + board)
    parts.append(box(body, width - 2 * board, 0.015, foot, 0).moved(y=-depth / 2 + 0.04))
    if back:
        parts.append(
            box("cream_paint", width - 2 * board, 0.006, height - foot, 0).moved(
                y=depth / 2 - 0.004, z=foot
            )
        )
    return joined(parts), levels


def wall_shelf(width=0.9, depth=0.20):
    """An oak board on two brass brackets; its back is at y = 0, the board's top at z = 0."""
    parts = [box("oak", width, depth, 0.024, 0.004).moved(y=-depth / 2, z=-0.024)]
    for x in (-width / 2 + 0.12, width / 2 - 0.12):
        parts.append(box("brass", 0.02, 0.006, 0.15, 0.001).moved(x=x, y=-0.004, z=-0.174))
        parts.append(
            rod("brass", (x, -0.006, -0.16), (x, -depth + 0.03, -0.026), 0.005, segments=8)
        )
    return joined(parts)


def wardrobe(width=1.9, depth=0.58, height=2.15, doors=4):
    parts = [
        box("oak", width, depth - 0.022, height - 0.06, 0.004, "z").moved(y=0.011, z=0.06),
        box("oak", width - 0.06, depth - 0.08, 0.06, 0).moved(y=0.03),
    ]
    each = (width - 0.024) / doors
    for k in range(doors):
        x = -width / 2 + 0.012 + each * (k + 0.5)
        parts.append(
            box("sage_paint", each - 0.006, 0.02, height - 0.09, 0.004).moved(
                x=x, y=-depth / 2 + 0.014, z=0.075
            )
        )
        # A frame around a lower panel, as on a framed door.
        for dx in (-1, 1):
            parts.append(
                box("sage_paint", 0.07, 0.008, height - 0.10, 0.003).moved(
                    x=x + dx * (each / 2 - 0.04), y=-depth / 2 + 0.004, z=0.08
                )
            )
        for z in (0.08, height - 0.095 - 0.005):
            parts.append(
                box("sage_paint", each - 0.15, 0.008, 0.07, 0.003).moved(
                    x=x, y=-depth / 2 + 0.004, z=z if z < 1 else z - 0.07 + 0.075
                )
            )
        side = 1 if k % 2 == 0 else -1
        hx = x + side * (each / 2 - 0.04)
        parts.append(
            rod(
                "brass",
                (hx, -depth / 2 - 0.022, 0.98),
                (hx, -depth / 2 - 0.022, 1.14),
                0.006,
                segments=10,
            )
        )
        for z in (1.0, 1.12):
            parts.append(
                rod(
                    "brass",
                    (hx, -depth / 2 + 0.002, z),
                    (hx, -depth / 2 - 0.022, z),
                    0.005,
                    segments=8,
                )
            )
    return joined(parts)


def coat_hooks(width=0.75, hooks=5):
    """Oak rail with brass hooks; the wall is at y = 0, the rail centred at z = 0."""
    parts = [box("oak", width, 0.022, 0.10, 0.005).moved(y=-0.011, z=-0.05)]
    for k in range(hooks):
        x = -width / 2 + width * (k + 0.5) / hooks
        bend = [(x, -0.020, 0.02), (x, -0.05, 0.015)] + [
            (x, -0.05 - r, z - 0.02 + 0.015) for r, z in arc(0.02, -90, 40, 5, (0.0, 0.0))
        ]
        bend = [(x, -0.020, -0.01), (x, -0.045, -0.015), (x, -0.062, -0.005), (x, -0.066, 0.02)]
        parts.append(tube("brass", bend, 0.006, 8))
        parts.append(cylinder("brass", 0.009, 0.012, 10, 0.004).moved(x, -0.066, 0.016))
    return joined(parts)


def shoe_bench(width=0.8, depth=0.34, height=0.45):
    """A seat over two slatted racks. Returns the racks' heights."""
    parts = [box("oak", width, depth, 0.028, 0.006).moved(z=height - 0.028)]
    for x in (-width / 2 + 0.02, width / 2 - 0.02):
        for y in (-depth / 2 + 0.025, depth / 2 - 0.025):
            parts.append(box("oak", 0.03, 0.03, height - 0.028, 0.004).moved(x=x, y=y))
    racks = (0.06, 0.24)
    for z in racks:
        for k in range(4):
            parts.append(
                box("oak", width - 0.06, 0.05, 0.014, 0.003).moved(
                    y=-0.115 + 0.076 * k, z=z - 0.014
                )
            )
    return joined(parts), racks
