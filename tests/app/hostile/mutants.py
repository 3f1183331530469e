"""Damages files in realistic ways: flipped bits, cuts, repeats, numbers out of range."""
import random
import re
import struct

EVIL = [b"-1", b"0", b"4294967295", b"2147483648", b"99999999999999999999", b"nan", b"inf",
        b"1e999", b"-99", b"\0", b"", b"[[[[", b"\xff\xfe", b"%n%s", b"../../etc/passwd"]
EVIL_WORDS = [0, 1, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0xFFFFFF00, 0x00010000, 0x7FC00000]


def _flip(data, rng):
    for _ in range(rng.randint(1, 8)):
        data[rng.randrange(len(data))] ^= 1 << rng.randrange(8)


def _cut(data, rng):
    del data[rng.randrange(len(data)):]


def _drop(data, rng):
    at = rng.randrange(len(data))
    del data[at:at + rng.randint(1, 32)]


def _repeat(data, rng):
    at = rng.randrange(len(data))
    piece = data[at:at + rng.randint(1, 64)]
    data[at:at] = piece * rng.choice([1, 2, 50])


def _number(data, rng):
    numbers = list(re.finditer(rb"-?\d+(\.\d+)?", bytes(data)))
    if not numbers:
        return _word(data, rng)
    found = rng.choice(numbers)
    data[found.start():found.end()] = rng.choice(EVIL)


def _word(data, rng):
    at = rng.randrange(max(1, len(data) - 4))
    data[at:at + 4] = struct.pack("<I", rng.choice(EVIL_WORDS))


def _noise(data, rng):
    at = rng.randrange(len(data))
    data[at:at] = rng.randbytes(rng.randint(1, 16))


WAYS = [_flip, _cut, _drop, _repeat, _number, _number, _word, _noise]


def mutant(seed_bytes, number):
    """A damaged copy; the same number gives the same copy on every machine."""
    rng = random.Random(number)
    data = bytearray(seed_bytes)
    for _ in range(rng.choice([1, 1, 2, 3])):
        if data:
            rng.choice(WAYS)(data, rng)
    return bytes(data)
