"""Living room: the western part of the long room."""

from furniture import crockery, lamps, ornaments, plants, seating, small, storage, study, tables
from furniture.small import printed
from rooms.shell import hang_curtains
from shapes.mesh import joined
from shapes.solids import box, cylinder

NORTH_WALL = 4.40


def rug(picture, width, depth, thick=0.010):
    """A woven picture lying face up."""
    return printed(picture, width, depth, thick).turned(-90, "x").moved(y=-depth / 2, z=thick / 2)


def furnish(scene):
    scene.room = "living"
    hang_curtains(scene, "living_west", "linen_white")
    scene.add("rug_living", "floor mat", rug("berber", 3.0, 2.1), 2.65, 1.85)
    _seats(scene)
    _coffee_table(scene)
    _television(scene)
    _bookshelf(scene)
    _sideboard(scene)
    _walls(scene)


def _seats(scene):
    scene.add("sofa", "sofa", seating.sofa(), 2.6, 0.60, turn=180)
    seat = 0.446
    for k, (cloth, x, y, turn, size) in enumerate(
        (
            ("linen_clay", 3.29, 0.66, 168, 0.46),
            ("linen_sage", 1.93, 0.66, 196, 0.46),
            ("knit_cream", 2.37, 0.74, 172, 0.38),
        ),
        1,
    ):
        scene.add(
            f"cushion_{k}",
            "pillow",
            small.leaning_cushion(cloth, size, 24),
            x,
            y,
            seat,
            turn,
            "sofa",
        )
    over = [
        (-0.30, -0.29),
        (-0.305, -0.05),
        (-0.29, 0.015),
        (-0.24, 0.026),
        (-0.08, 0.028),
        (0.06, 0.026),
    ]
    scene.add(
        "throw",
        "otherprop",
        seating.throw("knit_ochre", 0.50, over),
        2.82,
        0.78,
        seat - 0.003,
        180,
        "sofa",
    )
    scene.add("armchair_1", "chair", seating.armchair(), 0.70, 2.36, turn=62)
    scene.add("armchair_2", "chair", seating.lounge_chair(), 4.74, 1.45, turn=-72)
    scene.add(
        "cushion_4",
        "pillow",
        small.leaning_cushion("linen_ochre", 0.36, 28, 0.12),
        4.81,
        1.47,
        0.4125,
        -72,
        "armchair_2",
    )
    scene.add("pouf", "chair", seating.pouf(), 1.45, 3.10)
    scene.add("floor_lamp", "lamp", lamps.floor_lamp(), 0.72, 0.72)
    scene.add("side_table_1", "table", tables.side_table(), 4.06, 0.52)
    scene.add("table_lamp_1", "lamp", lamps.table_lamp(), 4.03, 0.45, on="side_table_1")
    scene.add(
        "candle_6", "otherprop", crockery.tea_light("terracotta"), 4.15, 0.63, on="side_table_1"
    )
    scene.add("potted_plant_1", "otherprop", plants.palm(height=1.5), 0.95, 3.50)


def _coffee_table(scene):
    table, shelf = tables.coffee_table()
    scene.add("coffee_table", "table", table, 2.65, 1.95, 0.010, on="rug_living")
    scene.add("tray", "otherprop", small.tray(), 2.38, 2.02, on="coffee_table", turn=8)
    inside = scene.things["coffee_table"].bounds()[1][2] + 0.010
    scene.add("vase_1", "otherprop", plants.tulips(), 2.30, 2.05, inside, 0, "tray")
    scene.add(
        "candle_1", "otherprop", crockery.tea_light("stoneware_sage"), 2.47, 1.97, inside, 0, "tray"
    )
    scene.add(
        "book_1",
        "books",
        small.flat_book(4, 0.22, 0.28, 0.032),
        2.90,
        1.88,
        on="coffee_table",
        turn=-14,
    )
    scene.add(
        "book_2", "books", small.flat_book(1, 0.17, 0.23, 0.024), 2.91, 1.89, on="book_1", turn=6
    )
    scene.add(
        "mug_1",
        "otherprop",
        crockery.mug("stoneware_blue"),
        2.66,
        2.13,
        on="coffee_table",
        turn=-40,
    )
    scene.add("remote", "otherprop", ornaments.remote(), 2.66, 1.77, on="coffee_table", turn=64)
    scene.add(
        "magazine_1", "books", small.magazine(6), 2.36, 1.88, shelf + 0.010, 4, "coffee_table"
    )
    scene.add(
        "basket_toys",
        "otherprop",
        small.basket(0.13, 0.10),
        2.95,
        1.95,
        shelf + 0.010,
        0,
        "coffee_table",
    )


def _television(scene):
    console, bay = tables.tv_console()
    y = NORTH_WALL - 0.24
    scene.add("tv_console", "cabinet", console, 1.62, y)
    scene.add("tv", "television", study.television(), 1.62, y + 0.03, on="tv_console")
    scene.add("speaker_1", "otherprop", ornaments.speaker(), 0.88, y, on="tv_console", turn=10)
    scene.add("speaker_2", "otherprop", ornaments.speaker(), 2.37, y, on="tv_console", turn=-10)
    scene.add("game_console", "otherprop", _set_top_box(), 1.50, y - 0.03, bay, 0, "tv_console")
    scene.add(
        "box_1",
        "box",
        small.storage_box(0.15, 0.24, 0.14, "linen_clay"),
        1.80,
        y - 0.03,
        bay,
        0,
        "tv_console",
    )


def _set_top_box():
    return joined(
        [
            box("black_plastic", 0.28, 0.20, 0.05, 0.006),
            box("dark_glass", 0.10, 0.002, 0.02, 0).moved(x=-0.05, y=-0.1005, z=0.015),
            cylinder("brass", 0.012, 0.008, 20, 0.002).turned(90, "x").moved(0.10, -0.098, 0.025),
        ]
    )


def _bookshelf(scene):
    shelf, z = storage.bookshelf(1.36, 0.32, 2.02, 5, 2)
    x0, y = 6.62, NORTH_WALL - 0.18
    scene.add("bookshelf_1", "bookshelf", shelf, x0, y)
    left, right = x0 - 0.335, x0 + 0.335
    front = y - 0.03

    def put(name, nyu40, model, x, level, turn=0.0, dy=0.0):
        scene.add(name, nyu40, model, x, front + dy, z[level], turn, "bookshelf_1")

    put("box_2", "box", small.storage_box(0.30, 0.25, 0.20, "linen_grey"), left - 0.15, 0)
    put("box_3", "box", small.storage_box(0.26, 0.25, 0.17, "linen_oat"), left + 0.17, 0)
    put("basket_1", "otherprop", small.basket(0.135, 0.22), right - 0.13, 0)
    put("radio", "otherprop", ornaments.radio(), right + 0.16, 0)
    put("books_1", "books", small.book_row(1, 9), left - 0.16, 1)
    put("vase_2", "otherprop", crockery.vase("terracotta", 0.25, 0.085, 0.03, 0.4), left + 0.19, 1)
    put("books_2", "books", small.book_row(2, 7, lean=1), right - 0.17, 1)
    put("bowl_1", "otherprop", crockery.bowl("stoneware_blue", 0.10, 0.07), right + 0.17, 1)
    put("globe", "otherprop", ornaments.globe(), left - 0.14, 2)
    put("books_3", "books", small.book_row(3, 8), left + 0.16, 2)
    put("book_3", "books", small.flat_book(3, 0.20, 0.26, 0.034), right - 0.16, 2, 3)
    put("books_4", "books", small.book_row(4, 6), right + 0.17, 2)
    put("books_5", "books", small.book_row(5, 8, lean=2), left - 0.15, 3)
    put("bust", "otherprop", ornaments.bust(), left + 0.18, 3, 20)
    put("books_6", "books", small.book_row(6, 9, 0.21), right - 0.14, 3)
    put("hourglass", "otherprop", ornaments.hourglass(), right + 0.19, 3)
    put("potted_plant_2", "otherprop", plants.trailing(drop=0.34), left - 0.16, 4, dy=0.02)
    put("jar_1", "otherprop", crockery.jar("stoneware_sage"), left + 0.16, 4)
    put("photo_1", "picture", ornaments.photo_stand("portrait", 0.15, 0.205), right - 0.16, 4, -8)
    put("sculpture", "otherprop", ornaments.knot(), right + 0.12, 4, -10)
    top = scene.things["bookshelf_1"].bounds()[1][2]
    scene.add(
        "basket_2",
        "otherprop",
        small.basket(0.15, 0.20),
        x0 - 0.42,
        y - 0.01,
        top,
        0,
        "bookshelf_1",
    )
    scene.add(
        "carton", "box", small.carton(0.36, 0.26, 0.22), x0 + 0.35, y - 0.01, top, 4, "bookshelf_1"
    )
    scene.add(
        "book_4",
        "books",
        small.flat_book(5, 0.16, 0.21, 0.028),
        right - 0.16,
        front,
        z[2] + 0.034,
        -7,
        "book_3",
    )


def _sideboard(scene):
    scene.add(
        "sideboard",
        "cabinet",
        tables.chest(1.3, 0.42, 0.74, 3, 1, "walnut", "walnut"),
        5.55,
        0.235,
        turn=180,
    )
    scene.add(
        "record_player",
        "otherprop",
        ornaments.record_player(),
        5.92,
        0.24,
        on="sideboard",
        turn=180,
    )
    scene.add("vase_3", "otherprop", plants.branches(), 5.12, 0.25, on="sideboard")
    scene.add("candle_2", "otherprop", crockery.candle("brass", 0.26), 5.42, 0.24, on="sideboard")
    scene.add("candle_3", "otherprop", crockery.candle("brass", 0.20), 5.54, 0.29, on="sideboard")


def _walls(scene):
    def hang(name, nyu40, model, x, y, z, turn, wall):
        scene.add(name, nyu40, model, x, y, z, turn, f"wall_living_{wall}", "hangs")

    hang(
        "picture_1",
        "picture",
        ornaments.framed("waves", 0.62, 0.62, "walnut", 0.06),
        5.55,
        0.0,
        1.58,
        180,
        "south",
    )
    hang("wall_clock", "otherprop", ornaments.clock(), 6.58, 0.0, 1.78, 180, "south")
    hang(
        "picture_2",
        "picture",
        ornaments.framed("shapes", 0.28, 0.395, "oak", 0.05),
        4.36,
        NORTH_WALL,
        1.70,
        0,
        "north",
    )
    hang(
        "picture_3",
        "picture",
        ornaments.framed("portrait", 0.24, 0.34, "oak", 0.04),
        4.36,
        NORTH_WALL,
        1.16,
        0,
        "north",
    )
    hang(
        "picture_4",
        "picture",
        ornaments.framed("branch", 0.24, 0.34, "brass", 0.05),
        0.0,
        3.62,
        1.62,
        90,
        "west",
    )
    hang(
        "picture_5",
        "picture",
        ornaments.framed("sea", 0.40, 0.283, "brass", 0.05),
        0.0,
        0.55,
        1.72,
        90,
        "west",
    )
    scene.add(
        "pendant_lamp_1",
        "lamp",
        lamps.globe_pendant(0.55, 0.34),
        2.65,
        1.95,
        2.60,
        0,
        "ceiling_living",
        "hangs",
    )
