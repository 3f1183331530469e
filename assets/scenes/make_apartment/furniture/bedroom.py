"""The bed."""

import math

import numpy as np

from shapes.mesh import joined, smooth_normals
from shapes.soft import pillow, ribbon, soft_box
from shapes.solids import box, rod


def bed(width=1.6, length=2.05):
    """Head at +y. An oak frame with a padded headboard, mattress and a duvet with soft folds."""
    parts = [box("oak", width + 0.08, length + 0.04, 0.12, 0.008, "y").moved(z=0.18)]
    for x in (-width / 2 + 0.08, width / 2 - 0.08):
        for y in (-length / 2 + 0.10, length / 2 - 0.10):
            parts.append(rod("oak", (x, y, 0), (x, y, 0.18), 0.022, 0.03, 14))
    each = (width + 0.12) / 4
    for k in range(4):
        x = -(width + 0.12) / 2 + each * (k + 0.5)
        parts.append(
            soft_box(
                "linen_sage", each - 0.004, 0.10, 0.86, 0.035, middle=5, puff=(0, 0.012, 0)
            ).moved(x=x, y=length / 2 + 0.045, z=0.22)
        )
    parts.append(soft_box("linen_white", width - 0.02, length - 0.06, 0.24, 0.06).moved(z=0.28))
    parts.append(_duvet(width, 1.42).moved(y=-0.34))
    return joined(parts)


def _duvet(width, length):
    """Lies over the mattress (top at 0.52) and hangs down at both sides and the foot."""
    model = soft_box("linen_oat", width + 0.06, length, 0.36, 0.07, arc=2, middle=12)
    part = model.parts[0]
    x, y, z = part.positions.T
    upper = np.clip((z - 0.15) / 0.2, 0, 1)
    side = np.clip((np.abs(x) - width / 2 + 0.12) / 0.12, 0, 1)
    part.positions[:, 2] += (
        upper
        * (
            0.010 * np.sin(7.0 * x + 3.0 * y) * np.cos(4.3 * y - 1.7 * x)
            + 0.008 * np.sin(11 * y + 2 * x)
        )
        * (1 - side)
    )
    part.positions[:, 0] += np.sign(x) * side * (1 - upper) * 0.012 * np.sin(13 * y)
    part.positions[:, 2] += 0.225
    part.normals = smooth_normals(part.positions, part.triangles)
    fold = soft_box("linen_white", width + 0.075, 0.26, 0.05, 0.024, middle=3).moved(
        y=length / 2 - 0.10, z=0.558
    )
    return joined([model, fold])


def bed_throw(cloth="knit_clay", width=0.52):
    """A knitted blanket across the foot end; along x, hanging at both sides. Bed top is z = 0."""
    half, hang = 0.845, 0.24
    path = [
        (-half - 0.004, -hang),
        (-half - 0.008, -0.10),
        (-half, -0.035),
        (-half + 0.03, 0.0),
        (-half + 0.09, 0.012),
    ]
    path += [(t, 0.014 + 0.004 * math.sin(9 * t)) for t in np.linspace(-half + 0.2, half - 0.2, 9)]
    path += [(-y, z) for y, z in path[:5][::-1]]
    return ribbon(cloth, path, 0.014, width).turned(90)


def sleeping_pillow(cloth="linen_white"):
    return pillow(cloth, 0.68, 0.46, 0.17, 12, 0.05)
