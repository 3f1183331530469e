"""Seeded noise that repeats without a seam, and small drawing helpers.

Pictures are float arrays, rows from the top, RGB in 0..1 as seen on a screen (sRGB).
"""

import cv2
import numpy as np


def noise(seed, height, width, roughness=1.0, stretch=(1.0, 1.0)):
    """Mean 0, deviation 1. A larger `roughness` gives broader clouds; `stretch` (y, x) draws
    them out."""
    white = np.random.default_rng(seed).random((height, width)) - 0.5
    fy = np.fft.fftfreq(height)[:, None] * height * stretch[0]
    fx = np.fft.rfftfreq(width)[None, :] * width * stretch[1]
    falloff = (1.0 + fy**2 + fx**2) ** (-roughness / 2)
    falloff[0, 0] = 0.0
    field = np.fft.irfft2(np.fft.rfft2(white) * falloff, s=(height, width))
    return (field - field.mean()) / field.std()


def color(text):
    """(r, g, b) of "#rrggbb"."""
    return np.array([int(text[i : i + 2], 16) for i in (1, 3, 5)]) / 255.0


def plain(height, width, text):
    return np.tile(color(text), (height, width, 1))


def shaded(base, amount):
    """Multiplies a colour or picture by 1 + amount, amount being a grey field."""
    return np.clip(base * (1.0 + amount[..., None]), 0.0, 1.0)


def mixed(a, b, share):
    share = np.clip(share, 0, 1)[..., None]
    return a * (1 - share) + b * share


def polygon(picture, points, text):
    """Fills a polygon given in 0..1 coordinates, with soft edges."""
    height, width = picture.shape[:2]
    mask = np.zeros((height, width), np.uint8)
    fixed = np.round(np.array(points) * [width, height] * 16).astype(np.int32)
    cv2.fillPoly(mask, [fixed], 255, cv2.LINE_AA, shift=4)
    return mixed(picture, color(text), mask / 255.0)


def ellipse(picture, cx, cy, rx, ry, text, turn=0.0):
    angle = np.linspace(0, 2 * np.pi, 48, endpoint=False)
    c, s = np.cos(np.radians(turn)), np.sin(np.radians(turn))
    x, y = rx * np.cos(angle), ry * np.sin(angle)
    return polygon(picture, np.column_stack([cx + c * x - s * y, cy + s * x + c * y]), text)


def rectangle(picture, x0, y0, x1, y1, text):
    return polygon(picture, [(x0, y0), (x1, y0), (x1, y1), (x0, y1)], text)


def stroke(picture, points, width, text):
    """A line of `width` (share of the picture's height) through points in 0..1."""
    height, columns = picture.shape[:2]
    mask = np.zeros((height, columns), np.uint8)
    fixed = np.round(np.array(points) * [columns, height] * 16).astype(np.int32)
    cv2.polylines(mask, [fixed], False, 255, max(1, round(width * height)), cv2.LINE_AA, shift=4)
    return mixed(picture, color(text), mask / 255.0)
