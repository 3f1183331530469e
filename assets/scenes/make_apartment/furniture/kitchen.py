"""Kitchen cabinets and what stands on them."""

import math

from furniture.small import printed
from shapes.mesh import joined
from shapes.soft import ellipsoid, soft_box
from shapes.solids import arc, box, cylinder, lathe, rod, rounded_rectangle, slab, tube

DEPTH, COUNTER = 0.60, 0.90  # cabinets' depth, worktop's height


def _handle(width):
    bar = [rod("brass", (-width / 2, -0.03, 0), (width / 2, -0.03, 0), 0.005, segments=8)]
    for x in (-width / 2 + 0.015, width / 2 - 0.015):
        bar.append(rod("brass", (x, 0, 0), (x, -0.03, 0), 0.004, segments=8))
    return joined(bar)


def base_cabinets(widths, paint="sage_paint"):
    """A run of cabinets without a worktop, its left end at x = 0 and back at y = 0.

    A positive width is a door, a negative one three drawers; 0.0 leaves nothing.
    """
    top, plinth, parts, x = COUNTER - 0.04, 0.10, [], 0.0
    total = sum(abs(w) for w in widths)
    parts.append(slab(paint, (0, -DEPTH + 0.022, plinth), (total, 0, top)))
    parts.append(slab("black_plastic", (0.0, -DEPTH + 0.07, 0), (total, -0.02, plinth)))
    for w in widths:
        wide = abs(w)
        bands = [(plinth, 0.32), (plinth + 0.32, 0.26), (plinth + 0.58, top - plinth - 0.58)] if w < 0 \
            else [(plinth, top - plinth)]
        for z, tall in bands:
            parts.append(slab(paint, (x + 0.002, -DEPTH, z + 0.002), (x + wide - 0.002, -DEPTH + 0.02, z + tall - 0.002), 0.003))
            rim = 0.055
            if tall > 0.3:  # a framed door: four strips standing 5 mm proud
                for x0, x1, z0, z1 in ((x + 0.003, x + wide - 0.003, z + 0.003, z + rim), (x + 0.003, x + wide - 0.003, z + tall - rim, z + tall - 0.003),
                                       (x + 0.003, x + rim, z + rim, z + tall - rim), (x + wide - rim, x + wide - 0.003, z + rim, z + tall - rim)):
                    parts.append(slab(paint, (x0, -DEPTH - 0.005, z0), (x1, -DEPTH + 0.005, z1), 0.002))
            parts.append(_handle(0.16).moved(x + wide / 2, -DEPTH - (0.004 if tall > 0.3 else 0), z + tall - (0.028 if tall > 0.3 else tall / 2)))
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
    parts = [slab("steel", (-w - 0.012, -d - 0.012, 0), (-w + t, d + 0.012, 0.004)), slab("steel", (w - t, -d - 0.012, 0), (w + 0.012, d + 0.012, 0.004)),
             slab("steel", (-w + t, -d - 0.012, 0), (w - t, -d + t, 0.004)), slab("steel", (-w + t, d - t, 0), (w - t, d + 0.012, 0.004)),
             slab("steel", (-w, -d, -deep), (w, d, -deep + t)), slab("steel", (-w, -d, -deep + t), (-w + t, d, 0)), slab("steel", (w - t, -d, -deep + t), (w, d, 0)),
             slab("steel", (-w + t, -d, -deep + t), (w - t, -d + t, 0)), slab("steel", (-w + t, d - t, -deep + t), (w - t, d, 0)),
             cylinder("chrome", 0.035, 0.004, 24, 0.001, -deep + t)]
    return joined(parts)


def tap():
    """A high brass bow, spout towards -y."""
    bow = [(0, 0, 0.03), (0, 0, 0.24)] + [(0, y - 0.09, z) for y, z in arc(0.09, 0, 180, 12, (0.0, 0.24))][1:] + [(0, -0.18, 0.19)]
    return joined([cylinder("brass", 0.026, 0.035, 24, 0.004), tube("brass", bow, 0.011, 12), rod("brass", (0.02, 0, 0.06), (0.075, 0, 0.085), 0.006)])


def oven():
    """A built-in oven's front panel, 0.59 m wide, standing on the plinth in a base cabinet run."""
    parts = [slab("black_lacquer", (-0.295, -DEPTH - 0.004, 0.14), (0.295, -DEPTH + 0.12, 0.70), 0.004),
             slab("dark_glass", (-0.24, -DEPTH - 0.007, 0.22), (0.24, -DEPTH, 0.54)),
             slab("steel", (-0.295, -DEPTH - 0.004, 0.705), (0.295, -DEPTH + 0.12, 0.855), 0.004),
             rod("steel", (-0.24, -DEPTH - 0.045, 0.63), (0.24, -DEPTH - 0.045, 0.63), 0.009)]
    for x in (-0.21, 0.21):
        parts.append(rod("steel", (x, -DEPTH, 0.63), (x, -DEPTH - 0.045, 0.63), 0.007))
    for x in (-0.21, -0.13, 0.13, 0.21):
        parts.append(cylinder("black_plastic", 0.020, 0.024, 20, 0.004).turned(90, "x").moved(x, -DEPTH - 0.004, 0.78))
    parts.append(slab("dark_glass", (-0.07, -DEPTH - 0.006, 0.755), (0.07, -DEPTH, 0.805)))
    return joined(parts)


def hob():
    return joined([box("dark_glass", 0.58, 0.50, 0.006, 0.002), printed("hob", 0.56, 0.48, 0.001).turned(-90, "x").moved(y=-0.24, z=0.0062)])


def range_hood():
    """Back at y = 0, hangs with its lower edge at z = 0 and goes up to 1.0."""
    return joined([box("steel", 0.60, 0.46, 0.05, 0.004).moved(y=-0.23), box("steel", 0.26, 0.26, 0.99, 0.004).moved(y=-0.15, z=0.045),
                   box("black_plastic", 0.50, 0.36, 0.004, 0.001).moved(y=-0.23, z=-0.002)])


def wall_cabinet(width, height=0.70, doors=2, paint="cream_paint"):
    """Back at y = 0, bottom at z = 0."""
    depth = 0.34
    parts = [slab(paint, (-width / 2, -depth + 0.02, 0), (width / 2, 0, height))]
    each = width / doors
    for k in range(doors):
        x = -width / 2 + each * (k + 0.5)
        parts.append(slab(paint, (x - each / 2 + 0.002, -depth, 0.002), (x + each / 2 - 0.002, -depth + 0.018, height - 0.002), 0.003))
        side = 1 if k % 2 == 0 else -1
        parts.append(_handle(0.14).turned(90, "y").moved(x + side * (each / 2 - 0.045), -depth, 0.12))
    return joined(parts)


def fridge(width=0.66, height=1.92):
    depth = 0.64
    parts = [slab("cream_paint", (-width / 2, -depth + 0.05, 0.03), (width / 2, 0, height), 0.01), slab("black_plastic", (-width / 2 + 0.02, -depth + 0.08, 0), (width / 2 - 0.02, -0.03, 0.03))]
    for z0, z1 in ((0.04, 0.66), (0.672, height)):
        door = soft_box("cream_paint", width, 0.055, z1 - z0, 0.018, arc=3).moved(y=-depth + 0.0225, z=z0)
        parts.append(door)
    for z0, z1 in ((0.36, 0.60), (0.74, 1.14)):
        parts.append(rod("brass", (-width / 2 + 0.06, -depth - 0.042, z0), (-width / 2 + 0.06, -depth - 0.042, z1), 0.009))
        for z in (z0 + 0.03, z1 - 0.03):
            parts.append(rod("brass", (-width / 2 + 0.06, -depth, z), (-width / 2 + 0.06, -depth - 0.042, z), 0.007))
    return joined(parts)


def kettle():
    body = lathe("sage_paint", [(0, 0), (0.082, 0), (0.088, 0.008), (0.090, 0.04), (0.074, 0.14), (0.055, 0.185), (0.02, 0.20), (0, 0.20)], 36, 50)
    return joined([body, ellipsoid("oak", 0.028, 0.028, 0.028).moved(z=0.198), tube("sage_paint", [(0, -0.07, 0.07), (0, -0.115, 0.11), (0, -0.145, 0.165)], [0.019, 0.014, 0.010], 14),
                   tube("oak", [(0, 0.062, 0.17), (0, 0.105, 0.175), (0, 0.118, 0.11), (0, 0.085, 0.06)], 0.010, 10)])


def toaster():
    parts = [soft_box("cream_paint", 0.29, 0.17, 0.185, 0.045, arc=3).moved(z=0.012), box("black_plastic", 0.25, 0.13, 0.014, 0.002)]
    for y in (-0.032, 0.032):
        parts.append(box("black_metal", 0.20, 0.022, 0.002, 0).moved(y=y, z=0.1965))
        parts.append(soft_box("bread", 0.12, 0.015, 0.05, 0.007).moved(x=0.0, y=y, z=0.19))
    parts.append(box("black_plastic", 0.02, 0.03, 0.014, 0.003).moved(x=0.152, z=0.13))
    parts.append(cylinder("brass", 0.014, 0.016, 18, 0.003).turned(90, "y").moved(0.143, 0.0, 0.06))
    return joined(parts)


def coffee_machine():
    return joined([box("black_lacquer", 0.20, 0.30, 0.03, 0.006), box("black_lacquer", 0.20, 0.12, 0.30, 0.012).moved(y=0.09, z=0.025), soft_box("steel", 0.20, 0.30, 0.10, 0.02).moved(z=0.26),
                   cylinder("black_plastic", 0.035, 0.05, 20, 0.004, 0.215).moved(y=-0.06), rod("black_plastic", (0, -0.06, 0.235), (0, -0.20, 0.225), 0.011),
                   box("steel", 0.15, 0.14, 0.006, 0.002).moved(y=-0.07, z=0.03), cylinder("brass", 0.016, 0.02, 18, 0.003).turned(90, "x").moved(0.06, -0.148, 0.31)])


def pot(color="clay_paint", radius=0.12, height=0.13):
    """An enamelled pot with its lid on."""
    r, h = radius, height
    parts = [lathe(color, [(0, 0), (r - 0.01, 0), (r, 0.012), (r, h), (0, h)], 36, 50), lathe(color, [(0, h), (r + 0.004, h), (r + 0.004, h + 0.008), (r * 0.6, h + 0.026), (0, h + 0.032)], 36, 40),
             cylinder("brass", 0.018, 0.026, 20, 0.004, h + 0.028)]
    for side in (-1, 1):
        parts.append(tube(color, [(side * r * 0.97, -0.035, h * 0.78), (side * (r + 0.035), -0.03, h * 0.80), (side * (r + 0.035), 0.03, h * 0.80), (side * r * 0.97, 0.035, h * 0.78)], 0.007, 8))
    return joined(parts)


def pan():
    return joined([lathe("black_metal", [(0, 0), (0.10, 0), (0.13, 0.045), (0.127, 0.045), (0.098, 0.005), (0, 0.005)], 36, 50), tube("oak", [(0, -0.125, 0.035), (0, -0.21, 0.055), (0, -0.30, 0.06)], [0.009, 0.011, 0.012], 10)])


def cutting_board(width=0.26, height=0.40):
    """Leaning upright against the wall at +y."""
    return box("walnut", width, 0.02, height, 0.006).turned(-9, "x").moved(z=0.0016)


def board_flat():
    return box("oak", 0.36, 0.22, 0.022, 0.006)


def loaf():
    body = soft_box("bread", 0.11, 0.24, 0.095, 0.045, arc=3, middle=6, puff=(0.004, 0.008, 0.012))
    return joined([body] + [tube("paper", [(-0.03, y, 0.103), (0.0, y + 0.018, 0.1085), (0.03, y + 0.03, 0.102)], 0.004, 6) for y in (-0.08, -0.02, 0.04)])


def knife_block():
    parts = [box("walnut", 0.11, 0.15, 0.20, 0.006).turned(0)]
    for k, x in enumerate((-0.035, -0.012, 0.012, 0.035)):
        parts.append(box("black_plastic", 0.014, 0.024, 0.085 - 0.006 * k, 0.004).moved(x, 0.03 - 0.02 * (k % 2), 0.20))
    return joined(parts)


def apple(color):
    w = 0.078
    return joined([lathe(color, [(0, 0.006), (0.012, 0.0), (0.028, 0.008), (0.039, 0.034), (0.037, 0.055), (0.024, 0.069), (0.008, 0.064), (0, 0.058)], 24, 60),
                   tube("bark", [(0, 0, 0.058), (0.002, 0, 0.07), (0.006, 0, 0.08)], 0.0016, 6)])


def lemon():
    return lathe("lemon", [(0, 0), (0.006, 0.004), (0.022, 0.014), (0.029, 0.038), (0.022, 0.062), (0.007, 0.073), (0, 0.078)], 20, 60).turned(90, "y").moved(x=-0.039, z=0.029)


def orange():
    return ellipsoid("orange", 0.076, 0.076, 0.072, 20, 12)


def utensils():
    parts = [lathe("stoneware", [(0, 0), (0.05, 0), (0.054, 0.006), (0.056, 0.15), (0.051, 0.15), (0.048, 0.012), (0, 0.01)], 32, 50)]
    for k, (a, tall) in enumerate(((0.3, 0.30), (1.6, 0.27), (2.9, 0.32), (4.4, 0.28))):
        foot, top = (0.018 * math.cos(a), 0.018 * math.sin(a), 0.014), (0.05 * math.cos(a), 0.05 * math.sin(a), tall)
        parts.append(rod("oak", foot, top, 0.005, 0.006))
        parts.append(ellipsoid("oak" if k % 2 else "walnut", 0.05, 0.018, 0.075).turned(math.degrees(a)).moved(*top[:2], tall - 0.012))
    return joined(parts)


def towel_rail_cloth(cloth="checks"):
    """A tea towel over an oven's bar; its fold at z = 0, bar at y = 0."""
    from shapes.soft import ribbon
    path = [(-0.012, -0.42), (-0.013, -0.10), (-0.0125, -0.01)] + [(0.0125 * math.cos(a), 0.0125 * math.sin(a)) for a in (2.6, 2.0, 1.57, 1.1, 0.5)] + [(0.0125, -0.01), (0.013, -0.12), (0.012, -0.34)]
    return ribbon(cloth, path, 0.004, 0.30)
