"""Tables, desks and chests."""

from shapes.mesh import joined
from shapes.solids import box, cylinder, extrude, rod, rounded_rectangle, tube


def _tapered(material, xs, ys, height, top=0.024, foot=0.015, splay=0.0):
    legs = []
    for x in xs:
        for y in ys:
            legs.append(
                rod(
                    material,
                    (x + splay * (1 if x > 0 else -1), y + splay * (1 if y > 0 else -1), 0),
                    (x, y, height),
                    foot,
                    top,
                    14,
                )
            )
    return joined(legs)


def coffee_table(width=1.15, depth=0.62, height=0.40):
    """Rounded oak top over a slatted shelf for magazines. Returns the shelf's height too."""
    shelf = 0.15
    parts = [
        extrude("oak", rounded_rectangle(width, depth, 0.16, 8), 0.028, 0.006).moved(
            z=height - 0.028
        ),
        _tapered(
            "oak",
            (-width / 2 + 0.15, width / 2 - 0.15),
            (-depth / 2 + 0.11, depth / 2 - 0.11),
            height - 0.028,
            0.022,
            0.015,
        ),
    ]
    for k in range(7):
        y = -0.18 + 0.06 * k
        parts.append(box("oak", width - 0.30, 0.042, 0.014, 0.003).moved(y=y, z=shelf - 0.014))
    for x in (-width / 2 + 0.15, width / 2 - 0.15):
        parts.append(rod("oak", (x, -0.20, shelf - 0.023), (x, 0.20, shelf - 0.023), 0.009))
    return joined(parts), shelf


def side_table(height=0.50, radius=0.22, top="marble"):
    return joined(
        [
            cylinder(top, radius, 0.022, 40, 0.005, height - 0.022),
            cylinder("brass", 0.014, height - 0.03, 12, base=0.008),
            cylinder("brass", 0.15, 0.012, 32, 0.003),
        ]
    )


def dining_table(width=1.8, depth=0.9, height=0.74):
    parts = [
        extrude("oak", rounded_rectangle(width, depth, 0.10, 6), 0.032, 0.008).moved(
            z=height - 0.032
        ),
        _tapered(
            "oak",
            (-width / 2 + 0.17, width / 2 - 0.17),
            (-depth / 2 + 0.14, depth / 2 - 0.14),
            height - 0.032,
            0.034,
            0.02,
            0.05,
        ),
    ]
    for y in (-depth / 2 + 0.14, depth / 2 - 0.14):
        parts.append(box("oak", width - 0.36, 0.022, 0.07, 0.003).moved(y=y, z=height - 0.10))
    for x in (-width / 2 + 0.17, width / 2 - 0.17):
        parts.append(box("oak", 0.022, depth - 0.30, 0.07, 0.003).moved(x=x, z=height - 0.10))
    return joined(parts).grounded()


def chest(width, depth, height, columns, rows, body="oak", front="oak", legs=0.14, knob="brass"):
    """Drawers or doors in a grid; the fronts stand 2 mm proud with a shadow gap between."""
    corpus = height - legs
    parts = [box(body, width, depth - 0.02, corpus, 0.004).moved(y=0.01, z=legs)]
    if legs > 0:
        parts.append(
            _tapered(
                body if body in ("oak", "walnut") else "oak",
                (-width / 2 + 0.08, width / 2 - 0.08),
                (-depth / 2 + 0.08, depth / 2 - 0.07),
                legs,
                0.02,
                0.013,
            )
        )
    margin, gap = 0.02, 0.006
    cell_x, cell_z = (width - 2 * margin) / columns, (corpus - 2 * margin) / rows
    for c in range(columns):
        for r in range(rows):
            x = -width / 2 + margin + cell_x * (c + 0.5)
            z = legs + margin + cell_z * r + gap / 2
            parts.append(
                box(
                    front, cell_x - gap, 0.018, cell_z - gap, 0.003, "x" if front == "oak" else None
                ).moved(x=x, y=-depth / 2 + 0.013, z=z)
            )
            if knob:
                wide = rows > 1 or columns == 1
                kx = x if wide else x + (cell_x / 2 - 0.05) * (1 if c % 2 == 0 else -1)
                parts.append(
                    cylinder(knob, 0.012, 0.022, 14, 0.004)
                    .turned(90, "x")
                    .moved(kx, -depth / 2 + 0.005, z + cell_z * (0.5 if wide else 0.72))
                )
    return joined(parts)


def tv_console(width=1.7, depth=0.42, height=0.48):
    """Low cabinet: fluted doors on either side of an open bay. Returns the bay's floor."""
    legs, board = 0.15, 0.02
    bay = 0.56
    parts = [
        _tapered(
            "oak",
            (-width / 2 + 0.12, width / 2 - 0.12),
            (-depth / 2 + 0.09, depth / 2 - 0.09),
            legs,
            0.02,
            0.013,
            0.02,
        )
    ]
    for z in (legs, height - board):
        parts.append(box("oak", width, depth, board, 0.004).moved(z=z))
    inner = height - legs - 2 * board
    for x in (-width / 2 + board / 2, width / 2 - board / 2, -bay / 2, bay / 2):
        parts.append(box("oak", board, depth - 0.01, inner, 0.002, "y").moved(x=x, z=legs + board))
    parts.append(
        box("oak", width - 0.02, 0.008, inner, 0).moved(y=depth / 2 - 0.01, z=legs + board)
    )
    door = (width - bay) / 2 - board - 0.012
    for side in (-1, 1):
        x = side * (bay / 2 + board / 2 + 0.006 + door / 2)
        parts.append(
            box("oak_slats", door, 0.018, inner - 0.006, 0.003, "x").moved(
                x=x, y=-depth / 2 + 0.014, z=legs + board + 0.003
            )
        )
    return joined(parts), legs + board


def desk(width=1.5, depth=0.70, height=0.74):
    parts = [
        extrude("oak", rounded_rectangle(width, depth, 0.03, 3), 0.028, 0.005).moved(
            z=height - 0.028
        ),
        box("oak", 0.36, depth - 0.10, 0.13, 0.004).moved(
            x=width / 2 - 0.28, y=0.02, z=height - 0.158
        ),
        box("cream_paint", 0.33, 0.018, 0.105, 0.003).moved(
            x=width / 2 - 0.28, y=-depth / 2 + 0.062, z=height - 0.145
        ),
        cylinder("brass", 0.010, 0.02, 12, 0.003)
        .turned(90, "x")
        .moved(width / 2 - 0.28, -depth / 2 + 0.054, height - 0.095),
    ]
    for x in (-width / 2 + 0.08, width / 2 - 0.07):
        parts.append(
            tube(
                "black_metal",
                [(x, -depth / 2 + 0.06, 0.0), (x, -depth / 2 + 0.09, height - 0.028)],
                0.014,
                10,
            )
        )
        parts.append(
            tube(
                "black_metal",
                [(x, depth / 2 - 0.06, 0.0), (x, depth / 2 - 0.09, height - 0.028)],
                0.014,
                10,
            )
        )
        parts.append(
            rod("black_metal", (x, -depth / 2 + 0.075, 0.32), (x, depth / 2 - 0.075, 0.32), 0.009)
        )
    return joined(parts)


def nightstand():
    """One drawer over an open shelf. Returns the shelf's height."""
    width, depth, height, shelf = 0.45, 0.38, 0.50, 0.17
    parts = [
        _tapered(
            "oak",
            (-width / 2 + 0.04, width / 2 - 0.04),
            (-depth / 2 + 0.04, depth / 2 - 0.04),
            height - 0.02,
            0.017,
            0.013,
        ),
        box("oak", width, depth, 0.02, 0.005).moved(z=height - 0.02),
        box("oak", width - 0.03, depth - 0.03, 0.13, 0.003).moved(z=height - 0.15),
        box("cream_paint", width - 0.07, 0.014, 0.11, 0.003).moved(
            y=-depth / 2 + 0.010, z=height - 0.14
        ),
        cylinder("brass", 0.010, 0.02, 12, 0.003)
        .turned(90, "x")
        .moved(0, -depth / 2 + 0.004, height - 0.085),
        box("oak", width - 0.05, depth - 0.05, 0.014, 0.003).moved(z=shelf - 0.014),
    ]
    return joined(parts), shelf
