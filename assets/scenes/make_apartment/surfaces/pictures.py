"""Things that are printed or painted: art for the walls, screens, the view outside."""

import cv2
import numpy as np

from surfaces.noise import color, ellipse, mixed, noise, plain, polygon, rectangle, shaded, stroke


def _paper(seed, picture, amount=0.02):
    height, width = picture.shape[:2]
    return shaded(picture, amount * noise(seed, height, width, 0.5))


def hills(seed=61):
    """Layered landscape under a low sun."""
    height, width = 256, 384
    picture = mixed(
        plain(height, width, "#f1ddc4"),
        plain(height, width, "#e9b48f"),
        np.linspace(0, 1.0, height)[:, None] * np.ones((1, width)),
    )
    picture = ellipse(picture, 0.66, 0.34, 0.085, 0.1275, "#d9734f")
    x = np.linspace(0, 1, 60)
    for i, text in enumerate(("#b9c0ad", "#93a28f", "#6d8274", "#4a6058", "#34453f")):
        ridge = (
            0.46
            + 0.11 * i
            + sum(
                (0.055 / k) * np.sin(2 * np.pi * (k * 1.1 * x + 0.31 * i * k + 0.13 * seed))
                for k in (1, 2, 3)
            )
        )
        picture = polygon(picture, [*zip(x, ridge), (1, 1.01), (0, 1.01)], text)
    return _paper(seed, picture)


def shapes(seed=62):
    """Cut-paper composition."""
    picture = plain(384, 272, "#efe7da")
    picture = ellipse(picture, 0.40, 0.34, 0.27, 0.19, "#c76d4c")
    picture = polygon(
        picture, [(0.5, 0.30), (0.86, 0.30), (0.86, 0.78), (0.68, 0.86), (0.5, 0.78)], "#7f917b"
    )
    picture = ellipse(picture, 0.34, 0.70, 0.16, 0.16, "#2f3e46")
    picture = ellipse(picture, 0.70, 0.30, 0.10, 0.07, "#dcb15f")
    arch = [(0.18 + 0.15 * np.cos(a), 0.52 - 0.09 * np.sin(a)) for a in np.linspace(0, np.pi, 20)]
    picture = stroke(picture, arch, 0.012, "#2f3e46")
    return _paper(seed, picture)


def branch(seed=63):
    """A botanical sheet: one stem with leaves."""
    picture = plain(384, 272, "#f3eee3")
    t = np.linspace(0, 1, 30)
    stem = np.column_stack([0.5 + 0.06 * np.sin(2.6 * t), 0.92 - 0.78 * t])
    picture = stroke(picture, stem, 0.007, "#5a6b4f")
    for k in range(11):
        x, y = stem[3 + int(k * 2.4)]
        side = 1 if k % 2 else -1
        reach = 0.25 * (1 - 0.045 * k)
        turn = -side * (38 + 2 * k)
        cx, cy = x + side * reach * 0.5, y - 0.055
        picture = ellipse(
            picture,
            cx,
            cy,
            reach * 0.52,
            0.030,
            ("#6f8561", "#849a76", "#5d7353")[k % 3],
            turn * 0.6,
        )
    return _paper(seed, picture)


def sea(seed=64):
    """Horizon in broad brush strokes."""
    height, width = 272, 384
    v = np.linspace(0, 1, height)[:, None] * np.ones((1, width))
    sky = mixed(color("#c7d3d8"), color("#f2e6d3"), v / 0.45)
    water = mixed(color("#5f8793"), color("#22434f"), (v - 0.45) / 0.4)
    picture = mixed(sky, water, np.clip((v - 0.45) * 60, 0, 1))
    sand = color("#d8c19a") * np.ones((height, width, 1))
    picture = mixed(
        picture, sand, np.clip((v - 0.80 + 0.02 * noise(seed, height, width, 2.0)) * 40, 0, 1)
    )
    strokes = noise(seed + 1, height, width, 0.9, (1.0, 14.0))
    return shaded(picture, 0.07 * strokes)


def waves(seed=65):
    """Concentric arcs, a mid-century print."""
    picture = plain(320, 320, "#2f4a4d")
    for row in range(6, -1, -1):
        for column in range(-1, 6):
            cx = (column + 0.5 * (row % 2)) / 4.5
            cy = 1.12 - row / 6.2
            for scale, text in (
                (0.125, "#e8d9bd"),
                (0.103, "#2f4a4d"),
                (0.082, "#d08a5b"),
                (0.061, "#2f4a4d"),
                (0.040, "#e8d9bd"),
            ):
                picture = ellipse(picture, cx, cy, scale, scale, text)
    return _paper(seed, picture)


def portrait(seed=66):
    """One continuous line on paper: a face in profile."""
    picture = plain(384, 272, "#f4f0e8")
    line = [
        (0.62, 0.16),
        (0.47, 0.17),
        (0.36, 0.25),
        (0.335, 0.35),
        (0.35, 0.41),
        (0.285, 0.505),
        (0.335, 0.525),
        (0.325, 0.56),
        (0.345, 0.585),
        (0.33, 0.62),
        (0.35, 0.685),
        (0.44, 0.70),
        (0.47, 0.74),
        (0.46, 0.86),
    ]
    smooth = cv2.resize(
        np.array(line)[:, None, :].astype(np.float32), (1, 120), interpolation=cv2.INTER_CUBIC
    )[:, 0]
    picture = ellipse(picture, 0.60, 0.40, 0.20, 0.15, "#e3b49c")
    picture = stroke(picture, smooth, 0.010, "#2b2b2b")
    picture = stroke(picture, [(0.40, 0.385), (0.45, 0.375), (0.49, 0.39)], 0.008, "#2b2b2b")
    hair = [
        (0.62 + 0.17 * np.cos(a), 0.33 + 0.17 * np.sin(a) * 0.9) for a in np.linspace(-1.6, 1.9, 30)
    ]
    return _paper(seed, stroke(picture, hair, 0.010, "#2b2b2b"))


def city_map(seed=67):
    """Streets, a river and parks."""
    picture = plain(384, 512, "#ece5d8")
    rng = np.random.default_rng(seed)
    x = np.linspace(-0.05, 1.05, 40)
    for k in range(7):
        a, b = rng.random(2)
        picture = ellipse(
            picture,
            a,
            b,
            0.04 + 0.05 * rng.random(),
            0.05 + 0.04 * rng.random(),
            "#b9c7a6",
            40 * rng.random(),
        )
    river = np.column_stack([x, 0.55 + 0.16 * np.sin(3.4 * x + 0.5) - 0.10 * x])
    picture = stroke(picture, river, 0.055, "#9dbcc4")
    for k in range(16):
        p = rng.random()
        picture = stroke(picture, [(p, 0), (p + 0.18 * (rng.random() - 0.5), 1)], 0.004, "#ffffff")
        picture = stroke(picture, [(0, p), (1, p + 0.22 * (rng.random() - 0.5))], 0.004, "#ffffff")
    for a, b in (((0.1, 0), (0.8, 1)), ((0.0, 0.8), (1.0, 0.2)), ((0.45, 0), (0.52, 1))):
        picture = stroke(picture, [a, b], 0.010, "#dca866")
    frame = rectangle(np.zeros((384, 512, 3)), 0.03, 0.04, 0.97, 0.96, "#ffffff")[..., 0]
    return _paper(seed, mixed(color("#f6f2ea"), picture, frame))


def tv_screen(seed=71):
    """A film paused on a mountain lake at dusk."""
    height, width = 256, 448
    v = np.linspace(0, 1, height)[:, None] * np.ones((1, width))
    picture = mixed(color("#24365e"), color("#f0a878"), np.clip(v / 0.55, 0, 1) ** 1.4)
    x = np.linspace(0, 1, 90)
    for base, rise, text, phase in (
        (0.44, 0.20, "#5d5f86", 0.2),
        (0.50, 0.15, "#3f476b", 1.4),
        (0.55, 0.07, "#232e47", 2.9),
    ):
        ridge = (
            base
            - rise * np.abs(np.sin(5 * x + phase) * np.sin(2.3 * x + phase))
            - 0.012 * np.sin(37 * x + phase)
        )
        picture = polygon(picture, [*zip(x, ridge), (1, 0.6), (0, 0.6)], text)
    mirror = picture[: int(height * 0.58)][::-1] * np.array([0.72, 0.78, 0.86])
    top = int(height * 0.58)
    picture[top:] = cv2.resize(mirror, (width, height - top), interpolation=cv2.INTER_AREA)
    ripple = noise(seed, height, width, 1.0, (1.0, 12.0)) * (v > 0.58)
    return shaded(picture, 0.06 * ripple)


def desktop_screen(seed=72):
    """A drawing program: a plan of a room, a tool column, a list."""
    picture = plain(288, 512, "#20262b")
    picture = rectangle(picture, 0, 0, 1, 0.055, "#161a1e")
    picture = rectangle(picture, 0.07, 0.055, 0.78, 1, "#f5f3ee")
    for k in range(9):
        picture = rectangle(
            picture,
            0.02,
            0.10 + 0.09 * k,
            0.05,
            0.15 + 0.09 * k,
            "#c9764f" if k == 2 else "#5c666e",
        )
    room = [
        (0.15, 0.18),
        (0.70, 0.18),
        (0.70, 0.60),
        (0.52, 0.60),
        (0.52, 0.88),
        (0.15, 0.88),
        (0.15, 0.18),
    ]
    picture = stroke(picture, room, 0.020, "#2d3940")
    for x0, y0, x1, y1, text in (
        (0.20, 0.24, 0.32, 0.40, "#a7b8a0"),
        (0.38, 0.24, 0.50, 0.34, "#dcb98a"),
        (0.56, 0.30, 0.65, 0.52, "#c98567"),
        (0.22, 0.58, 0.42, 0.80, "#9fb3bd"),
    ):
        picture = rectangle(picture, x0, y0, x1, y1, text)
    track = [
        (0.27, 0.50),
        (0.36, 0.46),
        (0.46, 0.42),
        (0.53, 0.38),
        (0.54, 0.50),
        (0.47, 0.56),
        (0.46, 0.70),
    ]
    picture = stroke(picture, track, 0.010, "#d0512e")
    for k in range(12):
        picture = rectangle(
            picture,
            0.80,
            0.10 + 0.065 * k,
            0.84 + 0.13 * ((k * 7) % 5) / 5,
            0.13 + 0.065 * k,
            "#7c8790",
        )
    return picture


def laptop_screen(seed=73):
    picture = plain(224, 352, "#f2efe8")
    picture = rectangle(picture, 0, 0, 1, 0.09, "#7f917b")
    picture = rectangle(picture, 0.06, 0.16, 0.46, 0.56, "#e2b48f")
    picture = ellipse(picture, 0.26, 0.38, 0.09, 0.14, "#c76d4c")
    for k in range(6):
        picture = rectangle(
            picture,
            0.52,
            0.17 + 0.065 * k,
            0.80 + 0.12 * ((k * 3) % 4) / 4,
            0.20 + 0.065 * k,
            "#8a8f92",
        )
    for k in range(5):
        picture = rectangle(
            picture,
            0.06,
            0.64 + 0.06 * k,
            0.78 + 0.14 * ((k * 5) % 3) / 3,
            0.67 + 0.06 * k,
            "#b4b6b4",
        )
    return picture


def outside(seed=74):
    """A hazy garden far out of focus: sky above, trees below."""
    height, width = 256, 384
    v = np.linspace(0, 1, height)[:, None] * np.ones((1, width))
    sky = mixed(color("#cfe2ee"), color("#f4f3ea"), v / 0.6)
    clouds = np.clip(noise(seed, height, width, 1.9, (1.0, 2.5)) * 0.5, 0, 1)
    sky = mixed(sky, color("#ffffff"), 0.6 * clouds)
    crown = 0.62 + 0.06 * noise(seed + 1, 1, width, 1.4)[0]
    trees = mixed(
        color("#b7cba4"), color("#7f9d74"), 0.5 + 0.35 * noise(seed + 2, height, width, 1.3)
    )
    lawn = mixed(trees, color("#bcd09a"), np.clip((v - 0.84) * 9, 0, 1))
    picture = mixed(sky, lawn, np.clip((v - crown[None, :]) * 14, 0, 1))
    return cv2.GaussianBlur(picture, (0, 0), 3.0)
