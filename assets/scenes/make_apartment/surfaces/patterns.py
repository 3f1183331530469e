"""Repeating surfaces: wood, stone, tiles, cloth. Each returns one tile of the pattern."""

import numpy as np

from surfaces.noise import color, mixed, noise, plain, polygon, rectangle, shaded


def wood(seed, light, dark, height=256, width=512, contrast=1.0):
    """Grain along x: broad bands bent by slow noise, fine fibres and dark pores."""
    y = np.linspace(0, 1, height, endpoint=False)[:, None]
    bend = noise(seed, height, width, 1.6, (1.0, 5.0))
    bands = 0.5 + 0.5 * np.sin(2 * np.pi * (5 * y + 0.35 * bend))
    fibre = noise(seed + 1, height, width, 0.9, (1.0, 40.0))
    pores = np.clip(noise(seed + 2, height, width, 0.5, (1.0, 22.0)) - 1.4, 0, 1.5)
    share = 0.30 + contrast * (0.30 * (bands - 0.5) + 0.11 * fibre + 0.10 * bend)
    return shaded(mixed(color(light), color(dark), share), -0.10 * contrast * pores)


def planks(seed, light, dark, boards=4, height=512, width=512):
    """Rows of floor boards, each with its own grain and tone, a fine dark joint between."""
    rows = []
    rng = np.random.default_rng(seed)
    tall = height // boards
    for i in range(boards):
        board = wood(seed + 10 * i, light, dark, tall, width, 0.85)
        board = shaded(board, np.full((tall, width), 0.09 * (rng.random() - 0.5)))
        edge = np.minimum(np.arange(tall), np.arange(tall)[::-1])
        board = shaded(
            board,
            np.tile(
                np.where(edge == 0, -0.38, np.where(edge == 1, -0.10, 0.0))[:, None], (1, width)
            ),
        )
        rows.append(board)
    return np.concatenate(rows)


def plaster(seed, text, size=256):
    """Painted wall: hardly there, so that large walls are not dead flat."""
    field = noise(seed, size, size, 0.7) * 0.007 + noise(seed + 1, size, size, 1.6) * 0.006
    return shaded(color(text), field)


def tiles(seed, text, joint, columns, rows, joint_px=3, vary=0.06, size=512, offset=0.0):
    """Hand-made tiles: each a little different in tone, softly shaded at its edges."""
    picture = plain(size, size, joint)
    rng = np.random.default_rng(seed)
    wide, tall = size / columns, size / rows
    gloss = noise(seed + 1, size, size, 1.2)
    for r in range(rows):
        for c in range(columns):
            tone = rng.random()
            shift = offset * (r % 2)
            x0, x1 = (c + shift) * wide + joint_px / 2, (c + 1 + shift) * wide - joint_px / 2
            y0, y1 = r * tall + joint_px / 2, (r + 1) * tall - joint_px / 2
            for wrap in (0, -size):
                xa, xb = int(round(max(x0 + wrap, 0))), int(round(min(x1 + wrap, size)))
                if xb <= xa:
                    continue
                ya, yb = int(round(y0)), int(round(y1))
                field = gloss[ya:yb, xa:xb] * 0.012 + vary * (tone - 0.5)
                picture[ya:yb, xa:xb] = shaded(color(text), field)
    return picture


def terrazzo(seed, ground, chips, count=420, size=512):
    picture = shaded(color(ground), noise(seed, size, size, 0.8) * 0.012)
    rng = np.random.default_rng(seed)
    for _ in range(count):
        x, y = rng.random(2)
        radius = 0.004 + 0.013 * rng.random() ** 2
        angles = np.sort(rng.random(6)) * 2 * np.pi
        reach = radius * (0.7 + 0.5 * rng.random(6))
        text = chips[int(rng.random() * len(chips))]
        for dx in (-1, 0, 1):
            for dy in (-1, 0, 1):
                if -0.02 < x + dx < 1.02 and -0.02 < y + dy < 1.02:
                    points = np.column_stack(
                        [x + dx + reach * np.cos(angles), y + dy + reach * np.sin(angles)]
                    )
                    picture = polygon(picture, points, text)
    return picture


def marble(seed, ground, vein, size=512):
    warp = noise(seed, size, size, 1.9)
    field = noise(seed + 1, size, size, 1.5) + 0.6 * warp
    lines = np.exp(-np.abs(field) * 14) * np.clip(
        0.5 + 0.5 * noise(seed + 2, size, size, 1.7), 0, 1
    )
    clouds = 0.10 + 0.05 * noise(seed + 3, size, size, 1.6)
    return mixed(color(ground), color(vein), 0.55 * lines + clouds)


def weave(seed, size=256, threads=32, contrast=0.16):
    """Plain cloth in near-white, to be tinted by its material."""
    y, x = np.mgrid[0:size, 0:size] * (threads / size)
    over = ((np.floor(x) + np.floor(y)) % 2).astype(float)
    across, down = np.abs(np.sin(np.pi * x)), np.abs(np.sin(np.pi * y))
    height = np.where(over > 0, down * (0.75 + 0.25 * across), across * (0.75 + 0.25 * down))
    slub = noise(seed, size, size, 0.5, (1, 7)) + noise(seed + 1, size, size, 0.5, (7, 1))
    field = contrast * (height - 0.75) + 0.035 * slub + 0.02 * noise(seed + 2, size, size, 1.0)
    return shaded(plain(size, size, "#eeeeee"), field)


def knit(seed, size=256, columns=14, rows=18):
    """Rows of V stitches, near-white."""
    y, x = np.mgrid[0:size, 0:size] / size
    u = (x * columns) % 1.0
    lean = np.abs(u - 0.5) * 1.1
    v = (y * rows + lean) % 1.0
    stitch = np.sin(np.pi * v) ** 0.6 * np.sin(np.pi * ((u * 2) % 1.0)) ** 0.5
    return shaded(
        plain(size, size, "#ececec"), 0.34 * (stitch - 0.75) + 0.03 * noise(seed, size, size, 0.6)
    )


def pile(seed, size=256):
    """Short carpet or towelling, near-white."""
    field = 0.075 * noise(seed, size, size, 0.25) + 0.03 * noise(seed + 1, size, size, 1.2)
    return shaded(plain(size, size, "#e8e8e8"), field)


def rattan(seed, light="#c9a878", dark="#7c5a35", size=256, cells=8):
    """Basket weave: bands over and under one another."""
    y, x = np.mgrid[0:size, 0:size] * (cells / size)
    over = ((np.floor(x) + np.floor(y)) % 2) > 0
    u, v = x % 1.0, y % 1.0
    swell = np.where(
        over,
        np.sin(np.pi * u) * np.sin(np.pi * v) ** 0.4,
        np.sin(np.pi * v) * np.sin(np.pi * u) ** 0.4,
    )
    fibre = np.where(
        over, noise(seed, size, size, 0.5, (1, 9)), noise(seed, size, size, 0.5, (9, 1))
    )
    return mixed(color(dark), color(light), 0.15 + 0.85 * swell + 0.07 * fibre)


def leather(seed, text, size=256):
    field = noise(seed, size, size, 0.8)
    creases = -0.10 * np.exp(-np.abs(noise(seed + 1, size, size, 1.0)) * 9)
    return shaded(color(text), 0.05 * field + creases)


def leaf_skin(seed, text, vein, size=128):
    """One leaf: stem at the bottom, mid-rib and side veins."""
    y, x = np.mgrid[0:size, 0:size] / size
    off = np.abs(x - 0.5)
    rib = np.exp(-((off / 0.018) ** 2))
    side = np.exp(-((((y * 9 - off * 7) % 1.0 - 0.5) / 0.10) ** 2)) * 0.45
    picture = mixed(color(text), color(vein), 0.8 * np.maximum(rib, side * (1 - rib)))
    return shaded(picture, 0.06 * noise(seed, size, size, 1.0) - 0.10 * (off > 0.47))


def soil(seed, size=128):
    return shaded(color("#3d2e25"), 0.22 * noise(seed, size, size, 0.3))


def slats(text, gap, count=16, size=256):
    """Upright fluted strips, as on a cabinet front."""
    x = (np.arange(size) * count / size) % 1.0
    tone = np.sin(np.pi * x) ** 0.35
    picture = mixed(
        np.tile(color(gap), (1, size, 1)), np.tile(color(text), (1, size, 1)), tone[None, :]
    )
    return np.repeat(picture, size, axis=0)


def checks(seed, ground, line, size=256, cells=4):
    """A linen check for tea towels and blankets."""
    picture = weave(seed, size, 64, 0.10) * color(ground)
    for i in range(cells):
        a = (i + 0.38) / cells
        for x0, y0, x1, y1 in ((a, 0, a + 0.24 / cells, 1), (0, a, 1, a + 0.24 / cells)):
            band = rectangle(np.zeros((size, size, 3)), x0, y0, x1, y1, "#ffffff")[..., 0]
            picture = mixed(picture, picture * color(line), 0.75 * band)
    return picture
