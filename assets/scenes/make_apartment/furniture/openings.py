"""Windows, doors and curtains.

All face the room at -y; the wall's inner face is y = 0 and its outer face y = +thickness.
"""

import math

from furniture.small import printed
from shapes.mesh import joined
from shapes.soft import ribbon
from shapes.solids import cylinder, rod, slab


def window(width, height, thickness=0.15, leaves=2, bar=None):
    """A painted frame in an opening whose lower middle is the origin, with panes and a sill."""
    f, parts = 0.055, []
    y0, y1 = 0.06, 0.12

    def member(x0, x1, z0, z1, a=y0, b=y1):
        parts.append(slab("trim_white", (x0, a, z0), (x1, b, z1), 0.003))

    half = width / 2
    member(-half, half, 0, f)
    member(-half, half, height - f, height)
    member(-half, -half + f, f, height - f)
    member(half - f, half, f, height - f)
    for k in range(1, leaves):
        x = -half + width * k / leaves
        member(x - f / 2, x + f / 2, f, height - f)
    if bar:
        member(-half + f, half - f, bar - 0.02, bar + 0.02, y0 + 0.01, y1 - 0.01)
    parts.append(
        slab("glass_pane", (-half + f / 2, 0.088, f / 2), (half - f / 2, 0.094, height - f / 2))
    )
    # The lining hides the wall's raw edge; the sill reaches into the room.
    parts.append(slab("trim_white", (-half - 0.04, -0.09, -0.03), (half + 0.04, y0, 0.0), 0.005))
    return joined(parts)


def sky(width, height):
    """The view: a picture standing a step outside."""
    return printed("outside", width, height, 0.01)


def door_frame(width, height, thickness):
    """Lining and architraves around an opening centred on x = 0."""
    lining, face, proud = 0.02, 0.07, 0.014
    half, parts = width / 2, []
    for side in (-1, 1):
        x0, x1 = sorted((side * half, side * (half - lining)))
        parts.append(slab("trim_white", (x0, 0, 0), (x1, thickness, height)))
        for y0, y1 in ((-proud, 0.0), (thickness, thickness + proud)):
            x0, x1 = sorted((side * (half - 0.006), side * (half + face)))
            parts.append(slab("trim_white", (x0, y0, 0), (x1, y1, height + face), 0.003))
    parts.append(slab("trim_white", (-half, 0, height - lining), (half, thickness, height)))
    for y0, y1 in ((-proud, 0.0), (thickness, thickness + proud)):
        parts.append(
            slab("trim_white", (-half, y0, height - 0.006), (half, y1, height + face), 0.003)
        )
    return joined(parts)


def door_leaf(width, height, material="trim_white", panels=2):
    """Hinged at the origin, reaching along +x, 40 mm thick around y = 0."""
    thick = 0.04
    parts = [slab(material, (0, -thick / 2, 0.008), (width, thick / 2, height), 0.003)]
    rim, gap = 0.11, 0.10
    tall = (height - 0.22 - gap * (panels - 1) - 0.11) / panels
    for k in range(panels):
        z0 = 0.22 + k * (tall + gap)
        for y in (-1, 1):
            a, b = sorted((y * thick / 2, y * (thick / 2 + 0.006)))
            for x0, x1, za, zb in (
                (rim, width - rim, z0, z0 + 0.03),
                (rim, width - rim, z0 + tall - 0.03, z0 + tall),
                (rim, rim + 0.03, z0, z0 + tall),
                (width - rim - 0.03, width - rim, z0, z0 + tall),
            ):
                parts.append(slab(material, (x0, a, za), (x1, b, zb), 0.005))
    for y in (-1, 1):
        x = width - 0.06
        parts.append(
            cylinder("brass", 0.024, 0.008, 24).turned(-90 * y, "x").moved(x, y * thick / 2, 1.02)
        )
        parts.append(
            rod("brass", (x, y * thick / 2, 1.02), (x, y * (thick / 2 + 0.05), 1.02), 0.008)
        )
        parts.append(
            rod(
                "brass",
                (x + 0.008, y * (thick / 2 + 0.05), 1.02),
                (x - 0.12, y * (thick / 2 + 0.05), 1.02),
                0.008,
            )
        )
    return joined(parts)


def curtain(width, height, folds=6, depth=0.045, material="linen_white"):
    """Hangs in waves, centred on x = 0, bottom at z = 0, its middle plane at y = 0."""
    steps = folds * 8
    path = []
    for k in range(steps + 1):
        t = k / steps
        swell = 1.0 + 0.25 * math.sin(5.0 * t)
        path.append((depth * swell * math.sin(2 * math.pi * folds * t), width * (0.5 - t)))
    return ribbon(material, path, 0.004, height).turned(-90, "y").moved(z=height / 2)


def curtain_rod(width, reach=0.10):
    """At z = 0; the wall is at y = 0."""
    parts = [rod("brass", (-width / 2, -reach, 0), (width / 2, -reach, 0), 0.010, segments=12)]
    for x in (-width / 2 + 0.10, width / 2 - 0.10):
        parts.append(rod("brass", (x, 0, 0), (x, -reach, 0), 0.006, segments=8))
        parts.append(cylinder("brass", 0.022, 0.008, 18).turned(90, "x").moved(x=x))
    for side in (-1, 1):
        parts.append(
            cylinder("brass", 0.018, 0.035, 16, 0.006)
            .turned(90 * side, "y")
            .moved(side * width / 2, -reach, 0)
        )
    return joined(parts)
