"""Bedroom: north-west."""

from furniture import (
    bedroom,
    clothes,
    crockery,
    lamps,
    ornaments,
    plants,
    seating,
    small,
    storage,
    tables,
)
from rooms.living import rug
from rooms.shell import hang_curtains
from shapes.mesh import joined
from shapes.solids import rod

NORTH, SOUTH_WALL, EAST_WALL = 8.0, 4.52, 4.20


def furnish(scene):
    scene.room = "bedroom"
    hang_curtains(scene, "bedroom_north", "linen_sage")
    y = 6.52
    scene.add("bed", "bed", bedroom.bed(), 1.155, y, turn=90)
    for k, (dy, cloth) in enumerate(((-0.38, "linen_white"), (0.38, "linen_white")), 1):
        scene.add(
            f"pillow_{k}", "pillow", bedroom.sleeping_pillow(cloth), 0.40, y + dy, 0.520, 90, "bed"
        )
    scene.add(
        "cushion_5",
        "pillow",
        small.leaning_cushion("linen_clay", 0.42, 38, 0.14),
        0.80,
        y + 0.02,
        0.60,
        90,
        "bed",
    )
    scene.add("blanket", "otherprop", bedroom.bed_throw(), 1.78, y, 0.5955, 90, "bed")
    _nightstands(scene, y)
    scene.add("rug_bedroom", "floor mat", rug("rug_bedroom", 1.7, 1.15), 2.82, y, turn=90)
    scene.add("bench", "chair", seating.bench(), 2.52, y, 0.010, 90, "rug_bedroom")
    scene.add(
        "towels_1",
        "towel",
        small.folded("towel_sage", 0.34, 0.26, 0.10),
        2.52,
        y + 0.30,
        on="bench",
        turn=88,
    )
    scene.add("book_6", "books", small.flat_book(7), 2.52, y - 0.28, on="bench", turn=110)
    scene.add(
        "wardrobe", "cabinet", storage.wardrobe(1.9, 0.58, 2.15), EAST_WALL - 0.31, 6.92, turn=-90
    )
    scene.add(
        "suitcase",
        "bag",
        clothes.suitcase().turned(90, "x").moved(y=0.33).grounded(),
        EAST_WALL - 0.31,
        7.35,
        on="wardrobe",
    )
    scene.add(
        "box_4",
        "box",
        small.storage_box(0.42, 0.34, 0.24, "linen_oat"),
        EAST_WALL - 0.30,
        6.50,
        on="wardrobe",
        turn=-88,
    )
    _dresser(scene)
    scene.add(
        "picture_6",
        "picture",
        ornaments.framed("hills", 0.75, 0.50, "oak", 0.07),
        0.0,
        y,
        1.62,
        90,
        "wall_bedroom_west",
        "hangs",
    )
    scene.add(
        "ceiling_lamp_1",
        "lamp",
        lamps.pendant(0.50, "lampshade", 0.50),
        2.1,
        y - 0.1,
        2.60,
        0,
        "ceiling_bedroom",
        "hangs",
    )
    scene.add("potted_plant_6", "otherprop", plants.snake_plant(), 3.23, 7.72)


def _nightstands(scene, y):
    stand, shelf = tables.nightstand()
    for side, dy in (("left", -1.12), ("right", 1.12)):
        scene.add(f"nightstand_{side}", "night stand", stand, 0.225, y + dy, turn=90)
    left, right = y - 1.12, y + 1.12
    scene.add(
        "table_lamp_2", "lamp", lamps.mushroom_lamp(), 0.20, left - 0.06, on="nightstand_left"
    )
    scene.add(
        "book_7",
        "books",
        small.flat_book(0, 0.13, 0.19, 0.022),
        0.28,
        left + 0.13,
        on="nightstand_left",
        turn=70,
    )
    scene.add(
        "books_7",
        "books",
        small.book_row(17, 5, 0.165, 0.13),
        0.24,
        left,
        shelf,
        90,
        "nightstand_left",
    )
    scene.add(
        "table_lamp_3", "lamp", lamps.mushroom_lamp(), 0.20, right - 0.02, on="nightstand_right"
    )
    scene.add(
        "alarm_clock",
        "otherprop",
        _alarm_clock(),
        0.30,
        right - 0.16,
        on="nightstand_right",
        turn=80,
    )
    scene.add(
        "mug_5",
        "otherprop",
        crockery.mug("stoneware"),
        0.33,
        right + 0.13,
        on="nightstand_right",
        turn=30,
    )
    scene.add(
        "box_5",
        "box",
        small.storage_box(0.26, 0.22, 0.14, "linen_clay"),
        0.23,
        right,
        shelf,
        90,
        "nightstand_right",
    )


def _alarm_clock():
    face = ornaments.clock(0.055).moved(z=0.065)
    return (
        joined(
            [
                face,
                rod("oak", (-0.03, -0.015, 0.018), (-0.042, -0.012, 0.0), 0.005),
                rod("oak", (0.03, -0.015, 0.018), (0.042, -0.012, 0.0), 0.005),
            ]
        )
        .moved(y=0.015)
        .grounded()
    )


def _dresser(scene):
    x, y = 1.45, SOUTH_WALL + 0.245
    scene.add(
        "dresser",
        "dresser",
        tables.chest(1.15, 0.44, 0.80, 2, 3, "oak", "cream_paint"),
        x,
        y,
        turn=180,
    )
    scene.add(
        "mirror_bedroom",
        "mirror",
        ornaments.round_mirror(0.34),
        x,
        SOUTH_WALL,
        1.42,
        180,
        "wall_bedroom_south",
        "hangs",
    )
    scene.add(
        "vase_4",
        "otherprop",
        crockery.vase("stoneware_sage", 0.24, 0.075, 0.026),
        x - 0.42,
        y - 0.02,
        on="dresser",
    )
    scene.add(
        "box_6",
        "box",
        small.storage_box(0.20, 0.15, 0.10, "linen_blue", False),
        x + 0.36,
        y,
        on="dresser",
        turn=176,
    )
    scene.add(
        "tray_2", "otherprop", small.tray(0.30, 0.20), x + 0.02, y + 0.04, on="dresser", turn=180
    )
    inside = 0.80 + 0.010
    scene.add(
        "perfume",
        "otherprop",
        crockery.bottle("glass_amber", 0.12, 0.022, "label_sage"),
        x + 0.07,
        y + 0.05,
        inside,
        180,
        "tray_2",
    )
    scene.add(
        "candle_4",
        "otherprop",
        crockery.tea_light("white_clay"),
        x - 0.05,
        y + 0.03,
        inside,
        0,
        "tray_2",
    )
