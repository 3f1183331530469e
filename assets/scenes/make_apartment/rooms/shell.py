"""The building: floors, walls with their openings, ceilings, windows, doors.

Plan, metres, x to the east and y to the north:

    y 8.00  +-------------+---------+-------------+
            |  bedroom    |  bath   |   study     |
    y 4.46  +------[ ]----+-[ ]-----+-[ ]---------+
            |  living room          dining kitchen|
    y 0.00  +-------------------------------[ ]---+
           x 0           4.26      6.76           11
"""

from furniture.openings import curtain, curtain_rod, door_frame, door_leaf, sky, window
from shapes.mesh import Model, Part, joined
from shapes.solids import slab

import numpy as np

HEIGHT, OUTER, LEAF_HEIGHT = 2.60, 0.15, 2.06
EAST, NORTH = 11.0, 8.0
SPLIT = 4.46  # middle of the wall between the living room and the others
BATH_WEST, BATH_EAST = 4.26, 6.76  # middles of the bathroom's walls
HALF = 0.06  # half a partition's thickness
DOOR = 0.88  # opening; 0.84 m between the linings
DOORS = {"bedroom": 3.42, "bathroom": 5.18, "study": 7.88}  # middles along x
ENTRANCE = 9.42

# name: (room, wall side, middle along the wall, width, sill, height)
WINDOWS = {
    "living_west": ("living", "west", 2.15, 1.9, 0.45, 1.85),
    "living_south": ("living", "south", 2.6, 2.2, 0.95, 1.35),
    "dining_south": ("living", "south", 7.5, 1.7, 0.55, 1.75),
    "kitchen_east": ("living", "east", 2.45, 1.2, 1.10, 1.05),
    "bedroom_north": ("bedroom", "north", 2.0, 1.7, 0.80, 1.45),
    "bathroom_north": ("bathroom", "north", 5.25, 0.8, 1.45, 0.75),
    "study_north": ("study", "north", 9.05, 1.7, 0.95, 1.35),
}


def wall(material, side, start, end, inner, outer, openings=()):
    """A wall along one side of a room, its faces at `inner` and `outer`, with a baseboard.

    Openings are (from, to, lower, upper) along the wall.
    """
    parts, at = [], start
    into_room = 1.0 if inner > outer else -1.0

    def piece(a, b, z0, z1, material=material, near=inner, far=outer, bevel=0.0):
        lo, hi = sorted((near, far))
        if side in ("south", "north"):
            parts.append(slab(material, (a, lo, z0), (b, hi, z1), bevel))
        else:
            parts.append(slab(material, (lo, a, z0), (hi, b, z1), bevel))

    def base(a, b):
        piece(a, b, 0.0, 0.08, "trim_white", inner + 0.012 * into_room, inner, 0.003)

    for a, b, low, high in sorted(openings):
        if a > at:
            piece(at, a, 0.0, HEIGHT)
            base(at, a)
        if low > 0:
            piece(a, b, 0.0, low)
            base(a, b)
        piece(a, b, high, HEIGHT)
        at = b
    piece(at, end, 0.0, HEIGHT)
    base(at, end)
    return joined(parts)


def boards(x0, x1, y0, y1, seed):
    """Oak boards 0.16 m wide along x, each its own stretch of the picture."""
    rng = np.random.default_rng(seed)
    positions, uvs, triangles = [], [], []
    row, y = 0, y0
    while y < y1 - 1e-9:
        top = min(y + 0.16, y1)
        x = x0 - 1.4 * rng.random()
        while x < x1:
            end = x + 1.2 + 0.8 * rng.random()
            a, b = max(x, x0), min(end, x1)
            if b > a:
                u, v = 1.6 * rng.random(), 0.16 * int(rng.random() * 4)
                start = len(positions)
                positions += [(a, y, 0), (b, y, 0), (b, top, 0), (a, top, 0)]
                uvs += [(u, v), (u + b - a, v), (u + b - a, v + top - y), (u, v + top - y)]
                triangles += [(start, start + 1, start + 2), (start, start + 2, start + 3)]
            x = end
        y, row = top, row + 1
    normals = [(0, 0, 1)] * len(positions)
    return Model([Part("floor_planks", positions, normals, uvs, triangles)]) + slab(
        "walnut", (x0, y0, -0.06), (x1, y1, -0.002)
    )


def _window_holes(room, side):
    return [
        (middle - width / 2, middle + width / 2, sill, sill + height)
        for r, s, middle, width, sill, height in WINDOWS.values()
        if (r, s) == (room, side)
    ]


def build(scene):
    low, high = SPLIT - HALF, SPLIT + HALF
    w0, w1 = BATH_WEST - HALF, BATH_WEST + HALF
    e0, e1 = BATH_EAST - HALF, BATH_EAST + HALF
    extents = {
        "living": (0.0, EAST, 0.0, low),
        "bedroom": (0.0, w0, high, NORTH),
        "bathroom": (w1, e0, high, NORTH),
        "study": (e1, EAST, high, NORTH),
    }
    for k, (room, (x0, x1, y0, y1)) in enumerate(extents.items()):
        scene.room = room
        if room == "bathroom":
            floor = slab("terrazzo", (x0, y0, -0.06), (x1, y1, 0.0))
        else:
            floor = boards(x0, x1, y0, y1, 100 + k)
        if room in DOORS:  # the threshold
            x = DOORS[room]
            floor = floor + slab(
                "oak", (x - DOOR / 2, low, -0.06), (x + DOOR / 2, high, 0.0), grain="x"
            )
        if room == "living":
            floor = floor + slab(
                "oak", (ENTRANCE - 0.48, -OUTER, -0.06), (ENTRANCE + 0.48, 0.0, 0.0), grain="x"
            )
        scene.add(f"floor_{room}", "floor", floor)
        scene.add(
            f"ceiling_{room}",
            "ceiling",
            slab(
                "ceiling_white",
                (x0 - HALF, y0 - HALF, HEIGHT),
                (x1 + HALF, y1 + HALF, HEIGHT + 0.10),
            ),
        )
        _walls(scene, room, x0, x1, y0, y1)
    for name, spec in WINDOWS.items():
        _window(scene, name, *spec)
    for room, x in DOORS.items():
        scene.room = room
        scene.add(f"door_frame_{room}", "door", door_frame(DOOR, LEAF_HEIGHT, 2 * HALF), x, low)
    leaf = door_leaf(DOOR - 0.05, LEAF_HEIGHT - 0.03)
    # Every leaf stands open into its room, away from the furniture.
    for room, hinge, turn in (("bedroom", 1, 97), ("bathroom", -1, 83), ("study", -1, 84)):
        scene.room = room
        x = DOORS[room] + hinge * (DOOR / 2 - 0.045)
        scene.add(f"door_{room}", "door", leaf, x, high + 0.035, 0.0, turn)
    scene.room = "living"
    scene.add(
        "door_frame_entrance", "door", door_frame(0.96, LEAF_HEIGHT, OUTER), ENTRANCE, 0.0, 0.0, 180
    )
    scene.add(
        "door_entrance",
        "door",
        door_leaf(0.915, LEAF_HEIGHT - 0.03, "sage_paint", 3),
        ENTRANCE + 0.4575,
        -0.06,
        0.0,
        180,
    )


def _walls(scene, room, x0, x1, y0, y1):
    paint = {
        "living": "wall_white",
        "bedroom": "wall_sage",
        "bathroom": "tile_white",
        "study": "wall_blue",
    }[room]
    door = (
        []
        if room == "living"
        else [(DOORS[room] - DOOR / 2, DOORS[room] + DOOR / 2, 0.0, LEAF_HEIGHT)]
    )
    if room == "living":
        door = [(x - DOOR / 2, x + DOOR / 2, 0.0, LEAF_HEIGHT) for x in DOORS.values()]
        outer_south, outer_north = -OUTER, SPLIT
        south = [(ENTRANCE - 0.48, ENTRANCE + 0.48, 0.0, LEAF_HEIGHT)] + _window_holes(
            room, "south"
        )
        north = door
    else:
        outer_south, outer_north = SPLIT, NORTH + OUTER
        south, north = door, _window_holes(room, "north")
    outer_west = -OUTER if x0 == 0.0 else x0 - HALF
    outer_east = EAST + OUTER if x1 == EAST else x1 + HALF
    scene.add(
        f"wall_{room}_south",
        "wall",
        wall(paint, "south", outer_west, outer_east, y0, outer_south, south),
    )
    scene.add(
        f"wall_{room}_north",
        "wall",
        wall(paint, "north", outer_west, outer_east, y1, outer_north, north),
    )
    scene.add(
        f"wall_{room}_west",
        "wall",
        wall(
            "wall_clay" if room == "study" else paint,
            "west",
            y0,
            y1,
            x0,
            outer_west,
            _window_holes(room, "west"),
        ),
    )
    scene.add(
        f"wall_{room}_east",
        "wall",
        wall(paint, "east", y0, y1, x1, outer_east, _window_holes(room, "east")),
    )


def _window(scene, name, room, side, middle, width, sill, height):
    scene.room = room
    turn = {"north": 0, "south": 180, "west": 90, "east": -90}[side]
    x, y = {
        "north": (middle, NORTH),
        "south": (middle, 0.0),
        "west": (0.0, middle),
        "east": (EAST, middle),
    }[side]
    scene.add(
        f"window_{name}",
        "window",
        window(width, height, OUTER, 3 if width > 2 else 2),
        x,
        y,
        sill,
        turn,
    )
    out = {"north": (0, 0.5), "south": (0, -0.5), "west": (-0.5, 0), "east": (0.5, 0)}[side]
    view = sky(width + 1.6, height + 1.2)
    scene.add(f"sky_{name}", "otherstructure", view, x + out[0], y + out[1], sill - 0.6, turn)


def hang_curtains(scene, name, cloth, drop=0.02, wide=0.42):
    """A rod with a curtain on either side of a window, down to just above the floor."""
    room, side, middle, width, sill, height = WINDOWS[name]
    top = min(sill + height + 0.14, HEIGHT - 0.10)
    turn = {"north": 0, "south": 180, "west": 90, "east": -90}[side]
    along = {"north": (1, 0), "south": (-1, 0), "west": (0, 1), "east": (0, -1)}[side]
    away = {"north": (0, -1), "south": (0, 1), "west": (1, 0), "east": (-1, 0)}[side]
    x, y = {
        "north": (middle, NORTH),
        "south": (middle, 0.0),
        "west": (0.0, middle),
        "east": (EAST, middle),
    }[side]
    scene.add(
        f"curtain_rod_{name}",
        "curtain",
        curtain_rod(width + 0.95, 0.13),
        x,
        y,
        top,
        turn,
        on=f"wall_{room}_{side}",
        how="hangs",
    )
    panel = curtain(wide, top - 0.012 - drop, 6, 0.038, cloth)
    for label, sign in (("left", -1), ("right", 1)):
        reach = sign * (width / 2 + 0.20)
        scene.add(
            f"curtain_{name}_{label}",
            "curtain",
            panel,
            x + along[0] * reach + 0.13 * away[0],
            y + along[1] * reach + 0.13 * away[1],
            drop,
            turn,
            on=f"curtain_rod_{name}",
            how="hangs",
        )
