"""Atlases for small printed things: book spines and covers, clock, keys, labels."""

import cv2
import numpy as np

from surfaces.noise import color, ellipse, noise, plain, polygon, rectangle, shaded, stroke

SPINES = 16  # side by side in book_spines()
COVERS = 8  # four columns, two rows in book_covers()

BOOK_COLORS = [
    "#a8563d",
    "#e9e0cf",
    "#5f7466",
    "#2f3f4a",
    "#d6a552",
    "#8c9fa6",
    "#c9b79c",
    "#6e3f3a",
    "#41576b",
    "#dfd6c6",
    "#7d8a5a",
    "#c47f5a",
    "#28302f",
    "#b8b0a2",
    "#93614a",
    "#4d6a63",
]


def _ink(text):
    return "#f4ecdc" if color(text).mean() < 0.55 else "#3a3530"


def book_spines(seed=81):
    picture = plain(256, 512, "#ffffff")
    rng = np.random.default_rng(seed)
    for i, ground in enumerate(BOOK_COLORS):
        x0, x1 = i / SPINES, (i + 1) / SPINES
        middle, ink = (x0 + x1) / 2, _ink(ground)
        picture = rectangle(picture, x0, 0, x1, 1, ground)
        style = i % 4
        if style in (0, 3):
            for y in (0.08, 0.11, 0.88, 0.91):
                picture = rectangle(picture, x0, y, x1, y + 0.012, ink)
        if style == 2:
            picture = rectangle(picture, x0, 0.70, x1, 0.86, BOOK_COLORS[(i + 5) % SPINES])
        top, bottom = 0.18, 0.48 + 0.15 * rng.random()
        y = top
        while y < bottom:  # lettering seen from a step away: short dashes along the spine
            step = 0.02 + 0.05 * rng.random()
            picture = rectangle(picture, middle - 0.008, y, middle + 0.008, y + step, ink)
            y += step + 0.014
        if style != 2:
            picture = rectangle(picture, middle - 0.005, 0.72, middle + 0.005, 0.80, ink)
    return shaded(picture, 0.02 * noise(seed, 256, 512, 0.6))


def book_covers(seed=82):
    picture = plain(512, 512, "#ffffff")
    for i in range(COVERS):
        x0, y0 = (i % 4) / 4, (i // 4) / 2
        ground = BOOK_COLORS[(i * 3) % SPINES]
        ink, second = _ink(ground), BOOK_COLORS[(i * 3 + 7) % SPINES]

        def at(x, y):
            return x0 + x / 4, y0 + y / 2

        picture = rectangle(picture, *at(0, 0), *at(1, 1), ground)
        if i % 4 == 0:
            picture = ellipse(picture, *at(0.5, 0.42), 0.085, 0.085, second)
            picture = ellipse(picture, *at(0.5, 0.42), 0.045, 0.045, ground)
        elif i % 4 == 1:
            for k in range(5):
                picture = polygon(
                    picture,
                    [
                        at(0.1, 0.25 + 0.1 * k),
                        at(0.9, 0.18 + 0.1 * k),
                        at(0.9, 0.22 + 0.1 * k),
                        at(0.1, 0.29 + 0.1 * k),
                    ],
                    second,
                )
        elif i % 4 == 2:
            picture = polygon(picture, [at(0.12, 0.62), at(0.45, 0.22), at(0.88, 0.62)], second)
        else:
            picture = rectangle(picture, *at(0.12, 0.14), *at(0.88, 0.60), second)
            picture = ellipse(picture, *at(0.5, 0.37), 0.05, 0.05, ink)
        for k, w in enumerate((0.62, 0.44, 0.28)):
            y = 0.74 + 0.07 * k
            picture = rectangle(picture, *at(0.5 - w / 2, y), *at(0.5 + w / 2, y + 0.03), ink)
    return shaded(picture, 0.02 * noise(seed, 512, 512, 0.6))


def clock_face(seed=83):
    """Two hands at ten past ten; the picture is the disc's square."""
    picture = plain(256, 256, "#f6f2ea")
    for k in range(60):
        a = 2 * np.pi * k / 60
        long = k % 5 == 0
        p = [(0.5 + r * np.sin(a), 0.5 - r * np.cos(a)) for r in ((0.38 if long else 0.42), 0.45)]
        picture = stroke(picture, p, 0.020 if long else 0.006, "#2f3437")
    for minutes, reach, width in ((10, 0.36, 0.016), (10 * 5 + 50 / 60 * 0 + 1, 0.24, 0.026)):
        a = 2 * np.pi * minutes / 60
        picture = stroke(
            picture,
            [
                (0.5 - 0.05 * np.sin(a), 0.5 + 0.05 * np.cos(a)),
                (0.5 + reach * np.sin(a), 0.5 - reach * np.cos(a)),
            ],
            width,
            "#2f3437",
        )
    return ellipse(picture, 0.5, 0.5, 0.025, 0.025, "#b98a3e")


def keyboard_keys(seed=84):
    picture = plain(128, 384, "#c9c9c6")
    for row in range(5):
        widths = [1.0] * 15 if row < 4 else [1.2, 1.2, 1.2, 6.0, 1.2, 1.2, 1.0, 1.0, 1.0]
        unit, x = 1.0 / sum(widths), 0.0
        for w in widths:
            a, b = x * unit + 0.006, (x + w) * unit - 0.006
            top, bottom = row / 5 + 0.03, (row + 1) / 5 - 0.03
            key = "#b9694b" if row == 0 and x == 0 else "#f2f1ec"
            picture = rectangle(picture, a, top, b, bottom, key)
            if w == 1.0:
                picture = rectangle(
                    picture,
                    (a + b) / 2 - 0.006,
                    top + 0.05,
                    (a + b) / 2 + 0.006,
                    top + 0.10,
                    "#6b6b68",
                )
            x += w
    return picture


def piano_keys(seed=85):
    picture = plain(64, 512, "#f7f4ec")
    count = 52
    for k in range(1, count):
        picture = rectangle(picture, k / count - 0.0012, 0, k / count + 0.0012, 1, "#77736b")
        if (k + 5) % 7 not in (2, 6):
            picture = rectangle(picture, (k - 0.28) / count, 0, (k + 0.28) / count, 0.62, "#1d1c1b")
    return picture


def globe_map(seed=86):
    height, width = 192, 384
    v = np.linspace(-1, 1, height)[:, None]
    land = noise(seed, height, width, 2.1) - 0.35 - 0.9 * np.abs(v) ** 3 > 0.0
    picture = plain(height, width, "#8fb0b8")
    picture[land] = color("#d9c08e")
    edge = cv2.morphologyEx(land.astype(np.uint8), cv2.MORPH_GRADIENT, np.ones((2, 2), np.uint8))
    picture[edge > 0] = color("#8c7448")
    for k in range(12):
        picture = stroke(picture, [(k / 12, 0), (k / 12, 1)], 0.003, "#6d929b")
    return picture


def label(seed, ground, ink, accent):
    """Wraps around a bottle or box."""
    picture = plain(96, 192, ground)
    picture = rectangle(picture, 0, 0.08, 1, 0.14, accent)
    picture = rectangle(picture, 0, 0.86, 1, 0.92, accent)
    for cx in (0.25, 0.75):
        picture = ellipse(picture, cx, 0.40, 0.06, 0.12, accent)
        for k, w in enumerate((0.30, 0.20)):
            picture = rectangle(
                picture, cx - w / 2, 0.60 + 0.11 * k, cx + w / 2, 0.66 + 0.11 * k, ink
            )
    return picture


def notes(seed=87):
    """A sheet of paper with handwriting and a sketch."""
    picture = plain(256, 192, "#fbf9f3")
    rng = np.random.default_rng(seed)
    for k in range(9):
        x, y = 0.10, 0.10 + 0.052 * k
        end = 0.55 + 0.35 * rng.random()
        while x < end:
            step = 0.03 + 0.07 * rng.random()
            picture = stroke(
                picture, [(x, y), (x + step * 0.4, y - 0.012), (x + step, y)], 0.004, "#3b4a63"
            )
            x += step + 0.025
    picture = stroke(
        picture,
        [(0.15, 0.92), (0.15, 0.64), (0.55, 0.64), (0.85, 0.78), (0.85, 0.92), (0.15, 0.92)],
        0.008,
        "#b9694b",
    )
    return picture


def hob_plate(seed=88):
    picture = plain(256, 256, "#17181a")
    for cx, cy, r in (
        (0.28, 0.28, 0.17),
        (0.74, 0.28, 0.13),
        (0.28, 0.72, 0.13),
        (0.74, 0.70, 0.19),
    ):
        for scale, text in (
            (1.0, "#8d8f92"),
            (0.965, "#17181a"),
            (0.62, "#4a4c4f"),
            (0.60, "#17181a"),
        ):
            picture = ellipse(picture, cx, cy, r * scale, r * scale, text)
    return rectangle(picture, 0.38, 0.94, 0.62, 0.955, "#8d8f92")
