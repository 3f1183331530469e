"""Woven rugs; the picture covers the whole rug."""

import numpy as np

from surfaces.noise import noise, plain, polygon, rectangle, shaded


def _wool(seed, picture):
    height, width = picture.shape[:2]
    lines = np.sin(np.arange(height) * np.pi / 1.5)[:, None] * np.ones((1, width))
    return shaded(
        picture,
        0.018 * lines
        + 0.035 * noise(seed, height, width, 0.3)
        + 0.02 * noise(seed + 1, height, width, 1.3),
    )


def berber(seed=41, height=384, width=512):
    """Off-white wool with a loose lattice of diamonds."""
    picture = plain(height, width, "#e6dfd2")
    rng = np.random.default_rng(seed)
    wide, tall = 1 / 5, 1 / 4
    for i in range(-1, 6):
        for j in range(-1, 5):
            cx, cy = (i + 0.5) * wide, (j + 0.5) * tall
            for scale, text in ((1.0, "#6f655b"), (0.93, "#e6dfd2")):
                wobble = (rng.random((4, 2)) - 0.5) * 0.008
                points = np.array(
                    [
                        (cx, cy - tall / 2 * scale),
                        (cx + wide / 2 * scale, cy),
                        (cx, cy + tall / 2 * scale),
                        (cx - wide / 2 * scale, cy),
                    ]
                )
                picture = polygon(picture, points + wobble, text)
            if (i + j) % 3 == 0:
                for scale, text in ((0.30, "#b9694b"), (0.16, "#e6dfd2")):
                    picture = polygon(
                        picture,
                        [
                            (cx, cy - tall / 2 * scale),
                            (cx + wide / 2 * scale, cy),
                            (cx, cy + tall / 2 * scale),
                            (cx - wide / 2 * scale, cy),
                        ],
                        text,
                    )
    return _wool(seed, picture)


def kilim(seed=43, height=384, width=512):
    """Stripes and rows of triangles in clay, sage and cream."""
    picture = plain(height, width, "#d9cdb8")
    bands = [
        ("#b9694b", 0.00, 0.05),
        ("#7d8f78", 0.07, 0.10),
        ("#c9a45c", 0.24, 0.27),
        ("#4f5d63", 0.30, 0.32),
        ("#b9694b", 0.46, 0.54),
    ]
    for text, a, b in bands:
        picture = rectangle(picture, a, 0, b, 1, text)
        picture = rectangle(picture, 1 - b, 0, 1 - a, 1, text)
    for x, text, count in ((0.12, "#4f5d63", 9), (0.35, "#7d8f78", 9)):
        for k in range(count):
            y0, y1 = k / count, (k + 1) / count
            for side in (x, 1 - x):
                reach = 0.07 if side < 0.5 else -0.07
                picture = polygon(
                    picture, [(side, y0), (side + reach, (y0 + y1) / 2), (side, y1)], text
                )
    return _wool(seed, picture)


def bordered(seed, ground, border, height=256, width=384):
    picture = plain(height, width, border)
    picture = rectangle(picture, 0.05, 0.075, 0.95, 0.925, ground)
    picture = rectangle(picture, 0.075, 0.11, 0.925, 0.89, border)
    picture = rectangle(picture, 0.085, 0.125, 0.915, 0.875, ground)
    return _wool(seed, picture)


def rings(seed=47, size=384):
    """A round jute rug: a spiral of braid."""
    y, x = np.mgrid[0:size, 0:size] / size - 0.5
    radius, angle = np.hypot(x, y), np.arctan2(y, x)
    turn = (radius * 44 + angle / (2 * np.pi)) % 1.0
    braid = np.sin(np.pi * turn) ** 0.5 * (0.85 + 0.15 * np.sin(angle * 90 * radius * 4))
    picture = plain(size, size, "#c2a67e")
    return shaded(picture, 0.45 * (braid - 0.8) + 0.04 * noise(seed, size, size, 0.4))
