"""Damages files in realistic ways: flipped bits, cuts, repeats, numbers out of range, wrong values in
valid JSON."""
import json
import random
import re
import struct

EVIL = [b"-1", b"0", b"4294967295", b"2147483648", b"99999999999999999999", b"nan", b"inf",
        b"1e999", b"-99", b"\0", b"", b"[[[[", b"\xff\xfe", b"%n%s", b"../../etc/passwd"]
EVIL_VALUES = [None, True, -1, 0, 1, 0.5, 255, 65_536, 2**31, 2**32 - 1, 2**53, 2**64 - 1, 1e308,
               -1e-308,
               "", "0", "../room.obj", "x" * 300, [], {}, [[]], [1e38] * 16]
EVIL_WORDS = [0, 1, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0xFFFFFF00, 0x00010000, 0x7FC00000]


def _place(data, rng):
    """An offset; half of those of a long file are in its first bytes, where counts are."""
    return rng.randrange(min(len(data), rng.choice([400, len(data)])))


def _flip(data, rng):
    for _ in range(rng.randint(1, 8)):
        data[_place(data, rng)] ^= 1 << rng.randrange(8)


def _cut(data, rng):
    del data[rng.randrange(len(data)):]


def _drop(data, rng):
    at = _place(data, rng)
    del data[at:at + rng.randint(1, 32)]


def _repeat(data, rng):
    at = _place(data, rng)
    piece = data[at:at + rng.randint(1, 64)]
    data[at:at] = piece * rng.choice([1, 2, 50])


def _number(data, rng):
    numbers = list(re.finditer(rb"-?\d+(\.\d+)?", bytes(data)))
    if not numbers:
        return _word(data, rng)
    found = rng.choice(numbers)
    data[found.start():found.end()] = rng.choice(EVIL)


def _word(data, rng):
    at = min(_place(data, rng), max(0, len(data) - 4))
    data[at:at + 4] = struct.pack("<I", rng.choice(EVIL_WORDS))


def _noise(data, rng):
    at = _place(data, rng)
    data[at:at] = rng.randbytes(rng.randint(1, 16))


def _places(value):
    """All (container, key) pairs of a JSON document."""
    found = []
    pairs = value.items() if isinstance(value, dict) else enumerate(value)
    for key, inner in pairs:
        found.append((value, key))
        if isinstance(inner, (dict, list)):
            found += _places(inner)
    return found


def _json(data, rng):
    """Replaces, removes, exchanges or repeats values of a JSON file or of a GLB file's JSON."""
    is_glb = data[:4] == b"glTF" and len(data) > 20
    end = 20 + struct.unpack_from("<I", data, 12)[0] if is_glb else len(data)
    try:
        document = json.loads(bytes(data[20 if is_glb else 0:end]))
        places = _places(document)
    except (ValueError, RecursionError, TypeError, AttributeError):
        places = []
    if not places:
        return _number(data, rng)
    container, key = rng.choice(places)
    way = rng.randrange(4)
    if way == 0:
        container[key] = rng.choice(EVIL_VALUES)
    elif way == 1:
        del container[key]
    elif way == 2:
        other, other_key = rng.choice(places)
        # Copies, because an exchange may put a value into itself.
        one, two = json.dumps(container[key]), json.dumps(other[other_key])
        container[key], other[other_key] = json.loads(two), json.loads(one)
    elif isinstance(container[key], list) and container[key]:
        container[key] = container[key] * rng.choice([2, 100])
    elif isinstance(container[key], (int, float)):
        container[key] = container[key] * rng.choice([-1, 2, 1000, 2**20])
    text = json.dumps(document).encode()
    if is_glb:
        text += b" " * (-len(text) % 4)
        struct.pack_into("<I", data, 8, len(data) - end + 20 + len(text))
        struct.pack_into("<I", data, 12, len(text))
        data[20:end] = text
    else:
        data[:] = text


WAYS = [_flip, _cut, _drop, _repeat, _number, _number, _word, _noise, _json, _json]


def mutant(seed_bytes, number):
    """A damaged copy; the same number gives the same copy on every machine."""
    rng = random.Random(number)
    data = bytearray(seed_bytes)
    for _ in range(rng.choice([1, 1, 2, 3])):
        if data:
            rng.choice(WAYS)(data, rng)
    return bytes(data)
