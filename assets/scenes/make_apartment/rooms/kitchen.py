"""Dining place, kitchen and entrance: the eastern part of the long room."""

import numpy as np

from furniture import (
    clothes,
    crockery,
    kitchen,
    kitchenware,
    lamps,
    ornaments,
    plants,
    seating,
    small,
    storage,
    tables,
)
from rooms.living import rug
from shapes.mesh import joined
from shapes.solids import cylinder, lathe, slab

EAST, NORTH_WALL = 11.0, 4.40
COUNTER = kitchen.COUNTER


def furnish(scene):
    scene.room = "living"
    _dining(scene)
    _cabinets(scene)
    _worktops(scene)
    _entrance(scene)


def _dining(scene):
    x, y = 7.85, 1.75
    scene.add("rug_dining", "floor mat", _round_rug(1.55), x, y)
    scene.add("dining_table", "table", tables.dining_table(), x, y, 0.010, 90, "rug_dining")
    chair = seating.dining_chair()
    places = (
        (x - 0.66, y - 0.43, 90),
        (x - 0.64, y + 0.43, 90),
        (x + 0.66, y - 0.43, -90),
        (x + 0.70, y + 0.46, -100),
        (x + 0.02, y + 1.18, 0),
    )
    for k, (cx, cy, turn) in enumerate(places, 1):
        scene.add(f"dining_chair_{k}", "chair", chair, cx, cy, 0.010, turn, "rug_dining")
    scene.add("fruit_bowl", "otherprop", kitchen_bowl(), x + 0.02, y + 0.05, on="dining_table")
    inside = 0.010 + 0.74 + 0.0200
    for name, model, dx, dy, turn in (
        ("apple_1", kitchenware.apple("apple_red"), -0.048, -0.03, 0),
        ("apple_2", kitchenware.apple("apple_green"), 0.050, -0.028, 120),
        ("orange_1", kitchenware.orange(), 0.0, 0.056, 0),
    ):
        scene.add(
            name, "otherprop", model, x + 0.02 + dx, y + 0.05 + dy, inside, turn, "fruit_bowl"
        )
    scene.add(
        "plate_1",
        "otherprop",
        crockery.plate("stoneware_sage"),
        x - 0.27,
        y - 0.43,
        on="dining_table",
    )
    scene.add(
        "plate_2", "otherprop", crockery.plate("stoneware"), x + 0.27, y - 0.43, on="dining_table"
    )
    scene.add("glass_1", "otherprop", _tumbler(), x - 0.13, y - 0.24, on="dining_table")
    scene.add("glass_2", "otherprop", _tumbler(), x + 0.13, y - 0.24, on="dining_table")
    scene.add(
        "bottle_1",
        "otherprop",
        crockery.bottle("glass_amber", 0.31),
        x - 0.02,
        y - 0.36,
        on="dining_table",
    )
    scene.add(
        "mug_2",
        "otherprop",
        crockery.mug("terracotta"),
        x - 0.25,
        y + 0.45,
        on="dining_table",
        turn=200,
    )
    scene.add(
        "book_5",
        "books",
        small.flat_book(2, 0.18, 0.24, 0.022),
        x + 0.24,
        y + 0.50,
        on="dining_table",
        turn=-80,
    )
    scene.add(
        "pendant_lamp_2",
        "lamp",
        lamps.pendant(1.0, "rattan", 0.52),
        x,
        y - 0.40,
        2.60,
        0,
        "ceiling_living",
        "hangs",
    )
    scene.add(
        "pendant_lamp_3",
        "lamp",
        lamps.pendant(1.0, "rattan", 0.52),
        x,
        y + 0.42,
        2.60,
        0,
        "ceiling_living",
        "hangs",
    )
    scene.add("potted_plant_3", "otherprop", plants.broad_leaved(height=1.45), 6.42, 0.44)


def kitchen_bowl():
    return crockery.bowl("white_clay", 0.165, 0.085)


def _round_rug(radius):
    model = cylinder("jute", radius, 0.010, 72, 0.003)
    for part in model.parts:
        part.uvs = np.array(part.positions[:, :2]) / (2 * radius) + 0.5
    return model


def _tumbler():
    return lathe(
        "glass",
        [
            (0, 0),
            (0.030, 0),
            (0.033, 0.004),
            (0.038, 0.095),
            (0.0365, 0.095),
            (0.031, 0.010),
            (0, 0.009),
        ],
        28,
        50,
    )


def _cabinets(scene):
    n = NORTH_WALL
    scene.add("fridge", "refrigerator", kitchen.fridge(), 9.07, n - 0.02)
    # North run from the fridge to the corner; the oven stands in its gap.
    x0 = 9.42
    scene.add("kitchen_cabinet_1", "cabinet", kitchen.base_cabinets([0.36]), x0, n - 0.005)
    scene.add("oven", "otherfurniture", _oven_housing(), x0 + 0.36 + 0.30, n - 0.005)
    # East run, from the corner down to the entrance.
    scene.add("kitchen_cabinet_2", "cabinet", _east_cabinets(), EAST - 0.005, 3.775, turn=-90)
    scene.add(
        "worktop_1",
        "counter",
        kitchen.worktop(EAST - 0.005 - x0),
        x0,
        n - 0.005,
        0.0,
        0,
        "kitchen_cabinet_1",
    )
    # The sink's cut-out: 0.54 x 0.40 centred under the window.
    middle = 3.775 - 2.45
    scene.add(
        "worktop_2",
        "counter",
        kitchen.worktop(2.40, [(middle - 0.27, middle + 0.27, -0.51, -0.11)]),
        EAST - 0.005,
        3.775,
        0.0,
        -90,
        "kitchen_cabinet_2",
    )
    scene.add(
        "kitchen_sink",
        "sink",
        kitchen.sink(),
        EAST - 0.005 - 0.31,
        2.45,
        COUNTER,
        -90,
        "worktop_2",
        "hangs",
    )
    scene.add(
        "kitchen_tap", "otherprop", kitchen.tap(), EAST - 0.055, 2.45, COUNTER, -90, "worktop_2"
    )
    scene.add("hob", "otherfurniture", kitchen.hob(), x0 + 0.66, n - 0.32, COUNTER, 0, "worktop_1")
    scene.add(
        "range_hood",
        "otherfurniture",
        kitchen.range_hood(),
        x0 + 0.66,
        n,
        1.56,
        0,
        "wall_living_north",
        "hangs",
    )
    scene.add("wall_tiles_kitchen", "wall", _splash(x0), 0, 0, 0)
    scene.add(
        "wall_shelf_1",
        "shelves",
        storage.wall_shelf(0.50, 0.22),
        10.66,
        n - 0.005,
        1.50,
        0,
        "wall_living_north",
        "hangs",
    )
    scene.add(
        "wall_shelf_2",
        "shelves",
        storage.wall_shelf(0.50, 0.22),
        10.66,
        n,
        1.95,
        0,
        "wall_living_north",
        "hangs",
    )
    scene.add(
        "kitchen_cabinet_3",
        "cabinet",
        kitchen.wall_cabinet(0.36, 0.70, 1),
        9.60,
        n,
        1.56,
        0,
        "wall_living_north",
        "hangs",
    )


def _oven_housing():
    return joined(
        [
            kitchen.oven(),
            slab("black_metal", (-0.30, -kitchen.DEPTH + 0.11, 0.10), (0.30, 0, COUNTER - 0.04)),
            slab("black_plastic", (-0.30, -kitchen.DEPTH + 0.07, 0), (0.30, -0.02, 0.10)),
        ]
    )


def _east_cabinets():
    """Four cabinets, the one under the window open inside for the sink, and the corner's body."""
    return kitchen.base_cabinets([0.60, 0.60, -0.60, 0.60], bowl=(1.02, 1.63)) + slab(
        "sage_paint", (-0.62, -kitchen.DEPTH - 0.015, 0.0), (0.0, 0.0, COUNTER - 0.04)
    )


def _splash(x0):
    return joined(
        [
            slab("tile_sage", (x0, NORTH_WALL - 0.005, COUNTER), (EAST, NORTH_WALL, 1.50)),
            slab("tile_sage", (EAST - 0.005, 1.37, COUNTER), (EAST, NORTH_WALL - 0.005, 1.07)),
        ]
    )


def _worktops(scene):
    n = NORTH_WALL

    def put(name, nyu40, model, x, y, turn=0.0, on="worktop_1", z=COUNTER):
        scene.add(name, nyu40, model, x, y, z, turn, on)

    put("kettle", "otherprop", kitchenware.kettle(), 10.52, n - 0.36, 120)
    put("toaster", "otherprop", kitchenware.toaster(), 10.72, 3.55, -90, "worktop_2")
    put("coffee_machine", "otherprop", kitchenware.coffee_machine(), 9.61, n - 0.24, 0)
    put("pot", "otherprop", kitchenware.pot(), x=10.22, y=n - 0.20, z=COUNTER + 0.0073, on="hob")
    put(
        "pan",
        "otherprop",
        kitchenware.pan(),
        x=9.92,
        y=n - 0.44,
        z=COUNTER + 0.0073,
        on="hob",
        turn=-70,
    )
    put("utensils", "otherprop", kitchenware.utensils(), 10.82, n - 0.16)
    put(
        "cutting_board_1",
        "otherprop",
        kitchenware.cutting_board(),
        EAST - 0.075,
        3.25,
        -90,
        "worktop_2",
    )
    put("cutting_board_2", "otherprop", kitchenware.board_flat(), 10.62, 3.04, 84, "worktop_2")
    put(
        "bread",
        "otherprop",
        kitchenware.loaf(),
        10.64,
        3.06,
        70,
        "cutting_board_2",
        COUNTER + 0.022,
    )
    put("knife_block", "otherprop", kitchenware.knife_block(), 10.80, 2.00, -94, "worktop_2")
    put(
        "dish_soap",
        "otherprop",
        crockery.bottle("glass_amber", 0.20, 0.028, "label_sage"),
        10.90,
        2.84,
        -90,
        "worktop_2",
    )
    put(
        "lemon_bowl",
        "otherprop",
        crockery.bowl("stoneware_blue", 0.11, 0.06),
        10.58,
        1.84,
        0,
        "worktop_2",
    )
    for k, (dx, dy, turn) in enumerate(((-0.030, 0.0, 80), (0.032, 0.012, 110)), 1):
        put(
            f"lemon_{k}",
            "otherprop",
            kitchenware.lemon(),
            10.58 + dx,
            1.84 + dy,
            turn,
            "lemon_bowl",
            COUNTER + 0.0170,
        )
    put(
        "potted_plant_4",
        "otherprop",
        plants.bushy(21, "terracotta", 0.062, 18, 0.12),
        10.82,
        1.58,
        0,
        "worktop_2",
    )
    for k, (model, x) in enumerate(
        (
            (crockery.jar("stoneware", "oak", 0.05, 0.13), 10.50),
            (crockery.jar("stoneware_sage", "oak", 0.05, 0.15), 10.64),
            (crockery.jar("white_clay", "oak", 0.045, 0.10), 10.78),
        ),
        2,
    ):
        put(f"jar_{k}", "otherprop", model, x, n - 0.12, 0, "wall_shelf_1", 1.50)
    put(
        "bowl_2",
        "otherprop",
        crockery.bowl("stoneware_sage", 0.09, 0.06),
        10.54,
        n - 0.11,
        0,
        "wall_shelf_2",
        1.95,
    )
    put(
        "mug_3", "otherprop", crockery.mug("white_clay"), 10.69, n - 0.11, -60, "wall_shelf_2", 1.95
    )
    put(
        "mug_4",
        "otherprop",
        crockery.mug("stoneware_blue"),
        10.81,
        n - 0.11,
        -110,
        "wall_shelf_2",
        1.95,
    )
    scene.add(
        "tea_towel",
        "towel",
        kitchenware.towel_rail_cloth(),
        10.08,
        n - 0.005 - kitchen.DEPTH - 0.045,
        0.63,
        0,
        "oven",
        "hangs",
    )
    scene.add(
        "potted_plant_5",
        "otherprop",
        plants.bushy(22, "white_clay", 0.055, 17, 0.11, "leaf_grey"),
        EAST - 0.015,
        2.83,
        1.10,
        0,
        "window_kitchen_east",
    )


def _entrance(scene):
    scene.add(
        "coat_hooks",
        "otherfurniture",
        storage.coat_hooks(0.76),
        10.48,
        0.0,
        1.68,
        180,
        "wall_living_south",
        "hangs",
    )
    hook = 1.68 + 0.015
    coat = clothes.hanging_coat("linen_ink")
    scene.add("coat", "clothes", coat, 10.65, 0.045, hook, 180, "coat_hooks", "hangs")
    scene.add("tote_bag", "bag", clothes.tote_bag(), 10.20, 0.02, hook, 180, "coat_hooks", "hangs")
    bench, racks = storage.shoe_bench()
    scene.add("shoe_rack", "otherfurniture", bench, 10.48, 0.20, turn=180)
    scene.add(
        "shoes_1", "clothes", clothes.shoes("leather"), 10.66, 0.215, racks[0], 180, "shoe_rack"
    )
    scene.add(
        "shoes_2", "clothes", clothes.shoes("linen_sage"), 10.34, 0.215, racks[1], 178, "shoe_rack"
    )
    scene.add("hat", "clothes", clothes.hat(), 10.36, 0.21, on="shoe_rack", turn=20)
    scene.add("umbrella_stand", "otherprop", clothes.umbrella_stand(), 8.72, 0.16)
    scene.add(
        "umbrella",
        "otherprop",
        clothes.umbrella().turned(7, "y").moved(x=-0.05),
        8.72,
        0.16,
        0.0138,
        0,
        "umbrella_stand",
    )
    scene.add("doormat", "floor mat", rug("bath_mat", 0.75, 0.48, 0.012), 9.42, 0.42)
    scene.add(
        "mirror_hall",
        "mirror",
        ornaments.round_mirror(0.27, "oak"),
        11.0,
        0.72,
        1.58,
        -90,
        "wall_living_east",
        "hangs",
    )
