"""Decodes PNG files with zlib and NumPy alone."""
import struct
import sys
import zlib
from typing import Any, Iterator, List, Optional

import numpy as np
import numpy.typing as npt

_CHANNELS = {0: 1, 2: 3, 4: 2, 6: 4}  # by colour type; palettes are not used in datasets
_LARGEST_SIDE = 1 << 16
_PIECE = 1 << 14  # bytes that are unpacked at a time
_BLOCK = 1 << 16  # bytes that they may become at a time


class Damaged(ValueError):
    """Raised if the file is not a PNG file that this module can decode; the text is the reason."""


def decode(data: bytes, scale: Optional[float] = None) -> npt.NDArray[Any]:
    """Decodes a PNG file to (H, W) or (H, W, channels), uint8 or uint16; with a scale, to float32 values
    times the scale. Works on a few rows at a time, so that the result is written to memory once."""
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        raise Damaged("it is not a PNG file")
    view = memoryview(data)
    at, packed, header = 8, [], b""
    while at + 8 <= len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        end = at + 8 + length
        if view[end:end + 4] != zlib.crc32(view[at + 4:end]).to_bytes(4, "big"):
            raise Damaged("its checksum is wrong" if end + 4 <= len(data) else "it ends too early")
        if kind == b"IHDR":
            header = data[at + 8:end]
        elif kind == b"IDAT":
            packed += [view[i:min(i + _PIECE, end)] for i in range(at + 8, end, _PIECE)]
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
        raise Damaged("its size, colour type or bit depth is not supported")
    channels = _CHANNELS[colour]
    stored: Any = np.uint8 if depth == 8 else np.uint16
    whole = np.empty((height, width, channels), np.float32 if scale is not None else stored)
    done, above = 0, np.zeros((width, channels * depth // 8), np.uint8)
    for lines in _lines(packed, 1 + width * channels * depth // 8, height):
        pixels = _unfiltered(lines[:, 0], lines[:, 1:].reshape(len(lines), *above.shape), above)
        above = pixels[-1]
        values = pixels.reshape(len(lines), -1).view(stored).reshape(len(lines), width, channels)
        if depth == 16 and sys.byteorder == "little":
            values = values.byteswap()
        part = whole[done:done + len(lines)]
        if scale is None:
            part[:] = values
        else:
            np.multiply(values, np.float32(scale), out=part)
        done += len(lines)
    if done != height:
        raise Damaged("pixels are missing")
    return whole[:, :, 0] if channels == 1 else whole


def _lines(packed: List[memoryview], length: int, count: int) -> Iterator[npt.NDArray[np.uint8]]:
    """Yields the decompressed rows as arrays of (n, length), n at most `count`."""
    unpacker, left = zlib.decompressobj(), b""
    block = max(_BLOCK, length)
    for piece in packed:
        source: Any = piece
        while count > 0 and len(source):
            try:
                left += unpacker.decompress(source, block)
            except zlib.error as error:
                raise Damaged(str(error)) from None
            source = unpacker.unconsumed_tail
            whole = min(len(left) // length, count)
            if whole:
                yield np.frombuffer(left, np.uint8, whole * length).reshape(whole, length)
                left = left[whole * length:]
                count -= whole


def _unfiltered(filters: npt.NDArray[np.uint8], lines: npt.NDArray[np.uint8],
                above: npt.NDArray[np.uint8]) -> npt.NDArray[np.uint8]:
    """Undoes the filters of the rows below the row `above`, one run of equal filters at a time."""
    starts = [0, *(np.flatnonzero(np.diff(filters)) + 1).tolist(), len(lines)]
    pixels = np.empty(lines.shape, np.uint8)
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
