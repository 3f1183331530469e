"""Decodes PNG files with zlib and NumPy alone."""
import struct
import zlib
from typing import Any

import numpy as np
import numpy.typing as npt

_CHANNELS = {0: 1, 2: 3, 4: 2, 6: 4}  # by colour type; palettes are not used in datasets
_LARGEST_SIDE = 1 << 16


class Damaged(ValueError):
    """It is no PNG file that can be decoded here; says why."""


def decode(data: bytes) -> npt.NDArray[Any]:
    """The picture of a PNG file: (H, W) or (H, W, channels), uint8 or uint16."""
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        raise Damaged("it is no PNG file")
    at, packed, header = 8, [], b""
    while at + 8 <= len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        chunk = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            header = chunk
        elif kind == b"IDAT":
            packed.append(chunk)
        elif kind == b"IEND":
            break
        at += 12 + length
    else:
        raise Damaged("it ends too early")
    if len(header) != 13:
        raise Damaged("it has no header")
    width, height, depth, colour, _, _, interlaced = struct.unpack(">IIBBBBB", header)
    sides_fit = 0 < width <= _LARGEST_SIDE and 0 < height <= _LARGEST_SIDE
    if not sides_fit or depth not in (8, 16) or colour not in _CHANNELS or interlaced:
        raise Damaged("it is of a kind that datasets do not have")
    channels = _CHANNELS[colour]
    pixel = channels * depth // 8
    size = height * (1 + width * pixel)
    try:
        unpacker = zlib.decompressobj()
        raw = unpacker.decompress(b"".join(packed), size)
    except zlib.error as error:
        raise Damaged(str(error)) from None
    if len(raw) != size:
        raise Damaged("pixels are missing")
    lines = np.frombuffer(raw, np.uint8).reshape(height, 1 + width * pixel)
    pixels = _unfiltered(lines[:, 0], lines[:, 1:].reshape(height, width, pixel))
    if depth == 16:
        shape = (height, width, channels)
        words = pixels.reshape(height, width * pixel).view(">u2").astype(np.uint16).reshape(shape)
        return words[:, :, 0] if channels == 1 else words
    return pixels[:, :, 0] if channels == 1 else pixels


def _unfiltered(filters: npt.NDArray[np.uint8],
                lines: npt.NDArray[np.uint8]) -> npt.NDArray[np.uint8]:
    """Undoes the filters, a run of lines of the same one at a time."""
    height = len(lines)
    starts = [0, *(np.flatnonzero(np.diff(filters)) + 1).tolist(), height]
    pixels = np.empty_like(lines)
    above = np.zeros_like(lines[0])
    for begin, end in zip(starts, starts[1:]):
        kind, run, out = int(filters[begin]), lines[begin:end], pixels[begin:end]
        if kind == 0:
            out[:] = run
        elif kind == 1:
            np.cumsum(run, axis=1, dtype=np.uint8, out=out)
        elif kind == 2:
            np.cumsum(run, axis=0, dtype=np.uint8, out=out)
            out += above
        elif kind in (3, 4):
            for y, line in enumerate(run):
                above = out[y] = (_average if kind == 3 else _paeth)(line, above)
        else:
            raise Damaged(f"it has an unknown filter {kind}")
        above = pixels[end - 1]
    return pixels


def _average(line: npt.NDArray[np.uint8], above: npt.NDArray[np.uint8]) -> npt.NDArray[np.uint8]:
    out = np.empty_like(line)
    left = np.zeros(line.shape[1], np.int32)
    for x in range(len(line)):
        left = (line[x] + ((left + above[x]) >> 1)) & 255
        out[x] = left
    return out


def _paeth(line: npt.NDArray[np.uint8], above: npt.NDArray[np.uint8]) -> npt.NDArray[np.uint8]:
    out = np.empty_like(line)
    left = np.zeros(line.shape[1], np.int32)
    corner = left
    for x in range(len(line)):
        top = above[x].astype(np.int32)
        to_left, to_top, to_corner = abs(top - corner), abs(left - corner), abs(left + top - 2 * corner)
        nearest = np.where((to_left <= to_top) & (to_left <= to_corner), left,
                           np.where(to_top <= to_corner, top, corner))
        left = (line[x] + nearest) & 255
        out[x] = left
        corner = top
    return out
