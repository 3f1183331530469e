"""Small things that lie about: books, crockery, pictures, boxes, clothes."""

import math

import numpy as np

from shapes.mesh import Model, joined
from shapes.soft import ellipsoid, pillow, ribbon, soft_box
from shapes.solids import arc, box, cylinder, extrude, lathe, rod, rounded_rectangle, slab, tube
from surfaces.prints import COVERS, SPINES


def printed(material, width, height, depth, region=(0.0, 0.0, 1.0, 1.0)):
    """A plate facing -y whose front shows a picture (or a region u0, v0, u1, v1 of it)."""
    model = box(material, width, depth, height, 0.0)
    part = model.parts[0]
    u = part.positions[:, 0] / width + 0.5
    v = part.positions[:, 2] / height
    u0, v0, u1, v1 = region
    # Half a pixel inside, so that a repeating picture does not bleed over its edges.
    u, v = u0 + (0.004 + 0.992 * u) * (u1 - u0), v0 + (0.004 + 0.992 * v) * (v1 - v0)
    part.uvs = np.column_stack([u, v])
    return model


def _one_color(material, model, u, v):
    """Every corner shows the same spot of an atlas."""
    for part in model.parts:
        part.material = material
        part.uvs = np.tile([u, v], (len(part.positions), 1))
    return model


def book(index, thickness, height, depth):
    """Stands upright, spine towards -y."""
    i = index % SPINES
    plain = ((i + 0.12) / SPINES, 0.40)
    parts = [printed("spines", thickness, height, 0.003, (i / SPINES, 0, (i + 1) / SPINES, 1))
             .moved(y=-depth / 2 + 0.0015)]
    for side in (-1, 1):
        board = box("paper", 0.0025, depth - 0.003, height, 0.0)
        parts.append(_one_color("spines", board.moved(x=side * (thickness / 2 - 0.00125), y=0.0015), *plain))
    parts.append(box("paper", thickness - 0.005, depth - 0.012, height - 0.010, 0.0).moved(y=-0.001, z=0.005))
    return joined(parts)


def book_row(seed, count, height=0.23, depth=0.16, lean=0):
    """Books side by side on a shelf, the last `lean` of them leaning; centred on x."""
    rng = np.random.default_rng(seed)
    parts, x = [], 0.0
    for k in range(count):
        t = 0.016 + 0.026 * rng.random()
        h = height * (0.80 + 0.2 * rng.random())
        d = depth * (0.88 + 0.12 * rng.random())
        one = book(int(rng.random() * SPINES), t, h, d).moved(y=-depth / 2 + d / 2)
        if k >= count - lean:
            tilt = math.degrees(math.atan2(0.055, h))
            one = one.moved(x=t / 2).turned(-tilt, "y")
            one = one.moved(x=x - one.low()[0] - 0.055 * (k == count - lean) * 0, z=-one.low()[2])
            x = x + t / math.cos(math.radians(tilt)) + 0.0005
            if k == count - lean:  # the top of a leaning book touches the one before
                x += 0.0
        else:
            one = one.moved(x=x + t / 2)
            x += t + 0.0006
        parts.append(one)
    model = joined(parts)
    return model.moved(x=-(model.low()[0] + model.high()[0]) / 2)


def flat_book(index, width=0.17, depth=0.23, thickness=0.026):
    """Lies with its cover up; the spine is at -x."""
    i = index % COVERS
    u, v = (i % 4) / 4, 0.5 - (i // 4) / 2
    cell = (u, v, u + 0.25, v + 0.5)
    spot = (u + 0.02, v + 0.48)
    top = printed("covers", width, depth, 0.003, cell).turned(-90, "x").moved(y=-depth / 2, z=thickness - 0.0015)
    bottom = _one_color("covers", box("paper", width, depth, 0.003, 0.0), *spot)
    spine = _one_color("covers", box("paper", 0.003, depth, thickness - 0.006, 0.0)
                       .moved(x=-width / 2 + 0.0015, z=0.003), *spot)
    pages = box("paper", width - 0.010, depth - 0.010, thickness - 0.006, 0.0).moved(x=-0.002, z=0.003)
    return joined([top, bottom, spine, pages])


def magazine(index):
    return flat_book(index, 0.21, 0.28, 0.008)


def framed(picture, width, height, frame="oak", mat=0.0, depth=0.022):
    """A picture on a wall: its back at y = 0, its middle at z = 0."""
    rim = 0.018
    w, h = width + 2 * (mat + rim), height + 2 * (mat + rim)
    parts = []
    for z in (-h / 2, h / 2 - rim):
        parts.append(box(frame, w, depth, rim, 0.002).moved(y=-depth / 2, z=z))
    for x in (-w / 2 + rim / 2, w / 2 - rim / 2):
        parts.append(box(frame, rim, depth, h - 2 * rim, 0.002).moved(x=x, y=-depth / 2, z=-h / 2 + rim))
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
    rim = lathe("oak", [(0, 0), (radius, 0), (radius, 0.035), (radius - 0.014, 0.04), (radius - 0.018, 0.022), (0, 0.022)],
                48, 50).turned(90, "x")
    face = extrude("clock", arc(radius - 0.017, 0, 352.5, 47), 0.002)
    for part in face.parts:
        part.uvs = part.positions[:, :2] / (2 * (radius - 0.017)) + 0.5
    return joined([rim, face.turned(90, "x").moved(y=-0.022)])


def round_mirror(radius=0.36, frame="brass"):
    ring = lathe(frame, [(0, 0), (radius, 0), (radius, 0.022), (radius - 0.012, 0.022), (radius - 0.014, 0.014), (0, 0.014)],
                 56, 50).turned(90, "x")
    return joined([ring, cylinder("mirror", radius - 0.014, 0.003, 56, 0).turned(90, "x").moved(y=-0.014)])


def tall_mirror(width=0.55, height=1.65):
    """Leans against a wall; its foot is in front."""
    frame = []
    for z in (0, height - 0.03):
        frame.append(box("oak", width, 0.03, 0.03, 0.004).moved(z=z))
    for x in (-width / 2 + 0.015, width / 2 - 0.015):
        frame.append(box("oak", 0.03, 0.03, height - 0.06, 0.004).moved(x=x, z=0.03))
    frame.append(box("mirror", width - 0.05, 0.008, height - 0.05, 0).moved(z=0.025))
    model = joined(frame).turned(-6, "x")
    return model.moved(z=-model.low()[2])


def mug(color="stoneware"):
    body = lathe(color, [(0, 0), (0.034, 0), (0.039, 0.006), (0.041, 0.09), (0.038, 0.092), (0.036, 0.088),
                         (0.034, 0.012), (0, 0.010)], 28, 50)
    handle = [(0.038 + x, 0, z) for x, z in arc(0.027, 75, -75, 9, (0.0, 0.048))]
    return joined([body, tube(color, handle, 0.0055, 8)])


def bowl(color="stoneware", radius=0.13, height=0.075):
    r, h = radius, height
    return lathe(color, [(0, 0), (r * 0.42, 0), (r * 0.44, 0.008), (r * 0.75, h * 0.42), (r * 0.97, h * 0.95), (r, h),
                         (r - 0.007, h), (r * 0.71, h * 0.47), (r * 0.40, 0.018), (0, 0.014)], 40, 50)


def plate(color="porcelain", radius=0.13):
    r = radius
    return lathe(color, [(0, 0), (r * 0.6, 0), (r * 0.64, 0.005), (r, 0.020), (r - 0.003, 0.023), (r * 0.64, 0.009), (0, 0.008)], 40, 50)


def vase(color="stoneware", height=0.28, belly=0.085, neck=0.03, low=0.35):
    """Belly at `low` of the height, drawn in to a neck with a lip."""
    outer = [(0, 0), (belly * 0.55, 0)]
    for k in range(1, 13):
        t = k / 12
        if t <= low:
            r = belly * (0.55 + 0.45 * math.sin(math.pi / 2 * t / low))
        else:
            s = (t - low) / (1 - low)
            r = neck + (belly - neck) * (0.5 + 0.5 * math.cos(math.pi * min(1.0, s * 1.12)))
        outer.append((r, height * t))
    lip = outer[-1][0]
    inner = [(lip - 0.005, height), (lip - 0.006, height * 0.85), (0, height * 0.80)]
    return lathe(color, outer + inner, 36, 50)


def jar(color="stoneware", lid="oak", radius=0.055, height=0.14):
    return joined([lathe(color, [(0, 0), (radius - 0.006, 0), (radius, 0.008), (radius, height - 0.012), (radius - 0.008, height), (0, height)], 32, 50),
                   cylinder(lid, radius - 0.004, 0.02, 32, 0.004, height), ellipsoid(lid, 0.022, 0.022, 0.02).moved(z=height + 0.017)])


def bottle(glass="glass_amber", height=0.30, radius=0.037, label="label_clay"):
    r, h = radius, height
    body = lathe(glass, [(0, 0), (r - 0.004, 0), (r, 0.006), (r, h * 0.58), (r * 0.85, h * 0.66), (r * 0.38, h * 0.76),
                         (r * 0.36, h * 0.95), (0, h * 0.95)], 28, 50)
    wrap = lathe(label, [(r - 0.001, h * 0.16), (r + 0.0006, h * 0.16), (r + 0.0006, h * 0.48), (r - 0.001, h * 0.48)], 28)
    part = wrap.parts[0]
    turn = np.arctan2(-part.positions[:, 0], part.positions[:, 1])
    part.uvs = np.column_stack([part.uvs[:, 0] / (2 * math.pi * (r + 0.0006)), (part.positions[:, 2] - h * 0.16) / (h * 0.32)])
    return joined([body, wrap, cylinder("cork", r * 0.33, h * 0.06, 16, 0.002, h * 0.94)])


def candle(holder="brass", height=0.24):
    return joined([lathe(holder, [(0, 0), (0.045, 0), (0.047, 0.006), (0.014, 0.016), (0.010, 0.05), (0.018, 0.065), (0.018, 0.085), (0, 0.085)], 28, 50),
                   cylinder("wax", 0.011, height - 0.09, 16, 0.003, 0.08), cylinder("black_plastic", 0.001, 0.012, 6, 0, height - 0.012)])


def tea_light(color="stoneware_sage"):
    return joined([lathe(color, [(0, 0), (0.038, 0), (0.043, 0.008), (0.043, 0.055), (0.039, 0.055), (0.037, 0.035), (0, 0.035)], 28, 50),
                   cylinder("wax", 0.034, 0.008, 24, 0.002, 0.033)])


def tray(width=0.42, depth=0.28):
    return joined([box("walnut", width, depth, 0.010, 0.003)] + [
        box("walnut", sx, sy, 0.032, 0.004).moved(x=x, y=y) for sx, sy, x, y in
        ((width, 0.012, 0, depth / 2 - 0.006), (width, 0.012, 0, -depth / 2 + 0.006),
         (0.012, depth - 0.024, width / 2 - 0.006, 0), (0.012, depth - 0.024, -width / 2 + 0.006, 0))])


def basket(radius=0.19, height=0.26, material="rattan"):
    r, h = radius, height
    return lathe(material, [(0, 0), (r * 0.84, 0), (r * 0.88, 0.01), (r, h * 0.6), (r * 0.97, h), (r * 0.97 - 0.012, h), (r - 0.014, h * 0.6),
                            (r * 0.84, 0.018), (0, 0.016)], 36, 50)


def storage_box(width=0.30, depth=0.24, height=0.18, cloth="linen_grey", label=True):
    parts = [box(cloth, width, depth, height - 0.03, 0.006), box(cloth, width + 0.006, depth + 0.006, 0.035, 0.005).moved(z=height - 0.035)]
    if label:
        parts.append(box("brass", 0.07, 0.004, 0.035, 0.001).moved(y=-depth / 2 - 0.001, z=height * 0.42))
        parts.append(box("paper", 0.058, 0.002, 0.024, 0).moved(y=-depth / 2 - 0.003, z=height * 0.42 + 0.0055))
    return joined(parts)


def carton(width=0.42, depth=0.32, height=0.28):
    return joined([box("cardboard", width, depth, height, 0.003), box("paper", 0.05, depth + 0.001, 0.001, 0).moved(z=height),
                   printed("label_sage", 0.16, 0.09, 0.001).moved(y=-depth / 2 - 0.0005, z=height * 0.4)])


def remote():
    parts = [soft_box("black_plastic", 0.045, 0.17, 0.018, 0.007)]
    for k in range(9):
        parts.append(cylinder("grey_plastic", 0.0055, 0.003, 10, 0.001, 0.0172).moved(x=-0.012 + 0.012 * (k % 3), y=-0.05 + 0.016 * (k // 3)))
    parts.append(cylinder("clay_paint", 0.006, 0.003, 10, 0.001, 0.0172).moved(y=0.065))
    return joined(parts)


def shoe(color="leather", sole="white_plastic"):
    """One of a pair, its toe towards -y."""
    upper = soft_box(color, 0.092, 0.27, 0.075, 0.036, arc=3, middle=6)
    part = upper.parts[0]
    y, z = part.positions[:, 1], part.positions[:, 2]
    part.positions[:, 2] = z * (0.66 + 0.34 * np.clip((y + 0.06) / 0.12, 0, 1))
    part.positions[:, 0] *= 1 - 0.18 * np.clip((y - 0.02) / 0.12, 0, 1) - 0.25 * np.clip((-y - 0.08) / 0.06, 0, 1) ** 2
    base = extrude(sole, [(x * 0.096, y * 0.28) for x, y in [(-.30, -.42), (-.15, -.5), (.15, -.5), (.34, -.42), (.47, -.25), (.40, .05), (.40, .35),
                                                             (.28, .48), (-.28, .48), (-.40, .35), (-.40, .05), (-.45, -.25)]], 0.022, 0.004)
    collar = lathe(color, [(0.024, 0), (0.034, 0), (0.033, 0.035), (0.028, 0.037), (0.024, 0.0)], 20, 60).scaled(1, 1.5, 1).moved(y=0.075, z=0.068)
    return joined([base, upper.moved(z=0.018), collar])


def shoes(color="leather", sole="white_plastic"):
    return joined([shoe(color, sole).moved(x=-0.06), shoe(color, sole).turned(5).moved(x=0.06, y=0.012)])


def hanging_coat(cloth="linen_ink", width=0.42, height=0.95):
    """Hangs from z = 0 downwards against a wall at y = 0: body with folds, two sleeves."""
    body = soft_box(cloth, width, 0.11, height, 0.05, arc=3, middle=10)
    part = body.parts[0]
    x, y, z = part.positions.T
    share = z / height
    shoulder = np.clip((1 - share) / 0.16, 0, 1)
    part.positions[:, 0] = x * (0.30 + 0.62 * shoulder ** 0.7) * (1.05 - 0.12 * share)
    part.positions[:, 1] = y * (0.45 + 0.55 * shoulder) + 0.010 * np.sin(x * 46) * (1 - share)
    from shapes.mesh import smooth_normals
    part.normals = smooth_normals(part.positions, part.triangles)
    sleeves = [tube(cloth, [(s * width * 0.36, -0.005, height * 0.86), (s * width * 0.49, -0.015, height * 0.66), (s * width * 0.51, -0.02, height * 0.32)],
                    [0.045, 0.05, 0.042], 12) for s in (-1, 1)]
    collar = tube(cloth, [(-0.07, -0.01, height * 0.955), (0, 0.015, height), (0.07, -0.01, height * 0.955)], [0.018, 0.02, 0.018], 10)
    buttons = [cylinder("walnut", 0.011, 0.006, 12, 0.001).turned(90, "x").moved(0.03, -0.052, height * t) for t in (0.35, 0.5, 0.65)]
    return joined([body, *sleeves, collar, *buttons]).moved(y=-0.075, z=-height)


def tote_bag(cloth="linen_clay", width=0.36, height=0.38):
    """Hangs by its straps from z = 0, wall at y = 0."""
    body = soft_box(cloth, width, 0.09, height, 0.035, arc=3, middle=6, puff=(0, 0.012, 0)).moved(y=-0.06, z=-height - 0.24)
    straps = [tube(cloth, [(-0.09, -0.06 + s, -0.26), (-0.05, -0.06 + s, -0.05), (0, -0.06 + s * 0.4, 0.0), (0.05, -0.06 + s, -0.05), (0.09, -0.06 + s, -0.26)], 0.008, 8)
              for s in (-0.03, 0.03)]
    return joined([body, *straps])


def hat():
    return joined([lathe("rattan", [(0, 0.0), (0.19, 0.004), (0.20, 0.010), (0.19, 0.014), (0.095, 0.018), (0.09, 0.09), (0.06, 0.115), (0, 0.118)], 40, 50),
                   lathe("linen_ink", [(0.093, 0.020), (0.0975, 0.020), (0.0945, 0.05), (0.090, 0.05)], 40)])


def umbrella():
    parts = [rod("oak", (0, 0, 0.0), (0, 0, 0.82), 0.007), lathe("linen_ink", [(0, 0.10), (0.012, 0.10), (0.035, 0.40), (0.030, 0.62), (0.012, 0.66), (0, 0.66)], 12, 50)]
    parts.append(tube("oak", [(0, 0, 0.82)] + [(0.035 - 0.035 * math.cos(a), 0, 0.82 + 0.035 * math.sin(a)) for a in np.linspace(0.3, math.pi * 1.15, 9)], 0.008, 8))
    return joined(parts)


def umbrella_stand():
    return lathe("black_metal", [(0, 0), (0.11, 0), (0.112, 0.01), (0.105, 0.45), (0.100, 0.45), (0.105, 0.014), (0, 0.012)], 36, 50)


def suitcase(color="sage_paint"):
    shell = soft_box(color, 0.46, 0.26, 0.66, 0.05, arc=3)
    ribs = [box(color, 0.016, 0.268, 0.52, 0.004).moved(x=x, z=0.07) for x in (-0.15, -0.075, 0, 0.075, 0.15)]
    wheels = [cylinder("black_plastic", 0.025, 0.02, 14).turned(90, "x").moved(x, y + 0.01, -0.015) for x in (-0.18, 0.18) for y in (-0.09, 0.09)]
    handle = tube("black_plastic", [(-0.07, 0, 0.66), (-0.065, 0, 0.69), (0.065, 0, 0.69), (0.07, 0, 0.66)], 0.009, 8)
    band = box("black_plastic", 0.464, 0.012, 0.60, 0.002).moved(z=0.03)
    return joined([shell, *ribs, *wheels, handle, band]).moved(z=0.04)


def cushion(cloth, size=0.46, thickness=0.15):
    """Lies on z = 0; turn it upright with .turned(90 - lean, "x")."""
    return pillow(cloth, size, size, thickness)


def leaning_cushion(cloth, size=0.45, lean=18, thickness=0.15):
    """Stands on its edge, leaning back towards +y."""
    model = pillow(cloth, size, size, thickness).turned(90 - lean, "x")
    return model.moved(y=-(model.low()[1] + model.high()[1]) / 2, z=-model.low()[2])


def folded(cloth, width, depth, height, layers=3):
    """A folded blanket or towels: round-edged layers on one another."""
    each = height / layers
    return joined([soft_box(cloth, width - 0.006 * (k % 2), depth, each, each * 0.48).moved(z=each * k) for k in range(layers)])


def sheet(picture="notes"):
    return printed(picture, 0.21, 0.297, 0.0012).turned(-90, "x").moved(y=-0.1485, z=0.0006)


def speaker():
    parts = [box("walnut", 0.17, 0.20, 0.28, 0.005), box("black_plastic", 0.16, 0.006, 0.27, 0.003).moved(y=-0.102, z=0.005)]
    for z, r in ((0.095, 0.058), (0.21, 0.030)):
        cone = lathe("grey_plastic", [(0, 0), (r, 0), (r, 0.006), (r * 0.9, 0.008), (r * 0.35, 0.001), (0, 0.004)], 28, 50)
        parts.append(cone.turned(90, "x").moved(y=-0.104, z=z))
    return joined(parts)


def radio():
    return joined([soft_box("oak", 0.27, 0.11, 0.16, 0.022), box("rattan", 0.15, 0.006, 0.11, 0.002).moved(x=-0.045, y=-0.056, z=0.025),
                   cylinder("brass", 0.022, 0.016, 24, 0.003).turned(90, "x").moved(0.085, -0.054, 0.105),
                   cylinder("brass", 0.012, 0.014, 20, 0.003).turned(90, "x").moved(0.085, -0.054, 0.05)])


def record_player():
    return joined([box("walnut", 0.44, 0.36, 0.09, 0.006).moved(z=0.012), cylinder("steel", 0.148, 0.012, 48, 0.003, 0.102).moved(x=-0.045),
                   cylinder("black_lacquer", 0.150, 0.004, 48, 0.001, 0.114).moved(x=-0.045), cylinder("clay_paint", 0.05, 0.0012, 32, 0, 0.118).moved(x=-0.045),
                   cylinder("brass", 0.022, 0.035, 20, 0.003, 0.102).moved(0.17, 0.12), tube("steel", [(0.17, 0.12, 0.132), (0.165, -0.04, 0.132), (0.07, -0.10, 0.123)], 0.0045, 8),
                   *[cylinder("black_plastic", 0.018, 0.012, 14).moved(x, y) for x in (-0.18, 0.18) for y in (-0.14, 0.14)]])


def globe():
    ball = ellipsoid("globe", 0.25, 0.25, 0.25, 36, 20)
    part = ball.parts[0]
    part.uvs = part.uvs / np.array([math.pi * 0.25, math.pi * 0.25 / 2])
    ring = tube("brass", [(0.138 * math.cos(a), 0, 0.138 * math.sin(a)) for a in np.radians(np.linspace(-78, 102, 25))], 0.005, 8)
    return joined([cylinder("walnut", 0.085, 0.02, 36, 0.005), cylinder("brass", 0.010, 0.045, 12, base=0.018),
                   ball.moved(z=-0.125).turned(20, "y").moved(z=0.20), ring.turned(12, "y").moved(z=0.20)])


def hourglass():
    return joined([cylinder("walnut", 0.045, 0.012, 28, 0.003), cylinder("walnut", 0.045, 0.012, 28, 0.003, 0.148),
                   lathe("glass", [(0, 0.012), (0.034, 0.014), (0.036, 0.045), (0.006, 0.080), (0.006, 0.084), (0.036, 0.118), (0.034, 0.146), (0, 0.148)], 28, 60),
                   lathe("cork", [(0, 0.0125), (0.032, 0.0145), (0.030, 0.03), (0, 0.045)], 24),
                   *[rod("brass", (0.038 * math.cos(a), 0.038 * math.sin(a), 0.01), (0.038 * math.cos(a), 0.038 * math.sin(a), 0.15), 0.003, segments=8)
                     for a in (0.5, 2.6, 4.7)]])


def bust():
    """A smooth abstract head."""
    return joined([box("marble", 0.09, 0.09, 0.05, 0.004), cylinder("white_clay", 0.030, 0.07, 24, 0.006, 0.05),
                   ellipsoid("white_clay", 0.12, 0.145, 0.17, 28, 18).moved(y=-0.012, z=0.105), ellipsoid("white_clay", 0.026, 0.035, 0.05).moved(y=-0.083, z=0.160)])


def knot():
    """A ceramic ring sculpture."""
    ring = tube("white_clay", [(0.085 * math.cos(a), 0, 0.085 * math.sin(a)) for a in np.linspace(0, 2 * math.pi, 33)[:-1]], 0.026, 14, closed=True)
    second = tube("terracotta", [(0.058 * math.cos(a), 0, 0.058 * math.sin(a)) for a in np.linspace(0, 2 * math.pi, 29)[:-1]], 0.020, 14, closed=True)
    return joined([ring.moved(z=0.111), second.turned(90, "z").moved(x=0.10, z=0.078)])


def bookend():
    return joined([box("marble", 0.06, 0.10, 0.14, 0.004)])
