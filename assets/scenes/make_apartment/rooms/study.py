"""Study and music room: north-east."""

from furniture import crockery, lamps, ornaments, plants, seating, small, storage, study, tables
from rooms.living import rug
from shapes.mesh import joined
from shapes.soft import soft_box
from shapes.solids import box, cylinder, extrude, lathe, rod

WEST, EAST, SOUTH, NORTH = 6.82, 11.0, 4.52, 8.0


def furnish(scene):
    scene.room = "study"
    scene.add("rug_study", "floor mat", rug("kilim", 2.1, 1.1), 9.1, 6.03)
    _desk(scene)
    _shelf(scene)
    scene.add("piano", "otherfurniture", study.upright_piano(), WEST + 0.30, 6.35, turn=90)
    scene.add("piano_stool", "chair", seating.piano_stool(), WEST + 0.98, 6.35, turn=90)
    scene.add("metronome", "otherprop", _metronome(), WEST + 0.17, 5.85, on="piano", turn=80)
    scene.add(
        "photo_2",
        "picture",
        ornaments.photo_stand("sea", 0.20, 0.14, "oak"),
        WEST + 0.16,
        6.80,
        on="piano",
        turn=80,
    )
    scene.add(
        "vase_5",
        "otherprop",
        plants.branches(33, "stoneware_black", 0.22, 0.20, 3),
        WEST + 0.18,
        6.30,
        on="piano",
    )
    scene.add(
        "sheet_music",
        "paper",
        small.sheet().turned(90 - 12, "x").moved(z=0.0),
        WEST + 0.255,
        6.35,
        0.8355,
        90,
        "piano",
    )
    scene.add("guitar", "otherprop", study.guitar(), EAST - 0.42, NORTH - 0.42, turn=-38)
    scene.add(
        "sofa_2",
        "sofa",
        seating.sofa(1.25, 0.86, "linen_ink", 1),
        EAST - 2.2,
        SOUTH + 0.50,
        turn=180,
    )
    scene.add(
        "cushion_6",
        "pillow",
        small.leaning_cushion("linen_ochre", 0.44, 24),
        EAST - 2.40,
        SOUTH + 0.62,
        0.446,
        184,
        "sofa_2",
    )
    scene.add("arc_lamp", "lamp", lamps.arc_lamp(0.80, 1.85), EAST - 1.28, SOUTH + 0.28, turn=-104)
    scene.add(
        "side_table_2", "table", tables.side_table(0.46, 0.19, "oak"), EAST - 3.10, SOUTH + 0.46
    )
    scene.add(
        "mug_6",
        "otherprop",
        crockery.mug("stoneware_sage"),
        EAST - 3.14,
        SOUTH + 0.40,
        on="side_table_2",
        turn=60,
    )
    scene.add(
        "book_8",
        "books",
        small.flat_book(6, 0.13, 0.19, 0.02),
        EAST - 3.05,
        SOUTH + 0.52,
        on="side_table_2",
        turn=24,
    )
    scene.add(
        "potted_plant_8",
        "otherprop",
        plants.broad_leaved(35, 1.15, "terracotta", 12),
        WEST + 0.38,
        NORTH - 0.40,
    )
    scene.add(
        "picture_8",
        "picture",
        ornaments.framed("map", 0.92, 0.69, "walnut", 0.03),
        WEST,
        6.35,
        1.72,
        90,
        "wall_study_west",
        "hangs",
    )
    scene.add(
        "picture_9",
        "picture",
        ornaments.framed("waves", 0.36, 0.36, "oak", 0.05),
        EAST - 2.55,
        SOUTH,
        1.62,
        180,
        "wall_study_south",
        "hangs",
    )
    scene.add(
        "picture_10",
        "picture",
        ornaments.framed("branch", 0.27, 0.38, "oak", 0.05),
        EAST - 1.95,
        SOUTH,
        1.62,
        180,
        "wall_study_south",
        "hangs",
    )
    scene.add(
        "ceiling_lamp_3",
        "lamp",
        lamps.globe_pendant(0.42, 0.30),
        9.0,
        6.15,
        2.60,
        0,
        "ceiling_study",
        "hangs",
    )
    scene.add("yoga_mat", "floor mat", study.yoga_mat(), EAST - 0.14, SOUTH + 0.14)
    scene.add(
        "study_cabinet",
        "cabinet",
        tables.chest(0.62, 0.42, 0.58, 1, 2, "oak", "cream_paint"),
        EAST - 0.66,
        SOUTH + 0.235,
        turn=180,
    )
    scene.add(
        "printer",
        "otherprop",
        study.printer(),
        EAST - 0.66,
        SOUTH + 0.215,
        on="study_cabinet",
        turn=180,
    )


def _desk(scene):
    x, y = 9.05, NORTH - 0.37
    scene.add("desk", "desk", tables.desk(), x, y)
    scene.add("monitor", "otherprop", study.monitor(), x - 0.10, y + 0.14, on="desk")
    scene.add("keyboard", "otherprop", study.keyboard(), x - 0.10, y - 0.17, on="desk")
    scene.add("mouse", "otherprop", study.mouse(), x + 0.18, y - 0.17, on="desk", turn=-6)
    scene.add("laptop", "otherprop", study.laptop(), x - 0.54, y + 0.02, on="desk", turn=24)
    scene.add("desk_lamp", "lamp", lamps.desk_lamp(), x + 0.58, y + 0.20, on="desk", turn=200)
    scene.add("pen_cup", "otherprop", study.pen_cup(), x + 0.34, y + 0.22, on="desk")
    scene.add(
        "notebook",
        "books",
        small.flat_book(1, 0.15, 0.21, 0.016),
        x + 0.42,
        y - 0.14,
        on="desk",
        turn=-12,
    )
    scene.add(
        "mug_7", "otherprop", crockery.mug("terracotta"), x + 0.38, y + 0.06, on="desk", turn=-30
    )
    scene.add("cactus", "otherprop", plants.cactus(), x + 0.66, y + 0.02, on="desk")
    scene.add("office_chair", "chair", seating.office_chair(), x - 0.06, y - 0.72, 0.0, 172)
    scene.things["office_chair"].on = "floor_study"
    scene.add("waste_bin", "otherprop", study.waste_bin(), x - 0.52, y + 0.10)
    scene.add("carton_2", "box", small.carton(0.34, 0.28, 0.24), x + 0.42, y + 0.14, turn=-6)


def _shelf(scene):
    shelf, z = storage.bookshelf(1.1, 0.30, 1.62, 4, 1, "walnut")
    x, y0 = EAST - 0.17, 6.25
    scene.add("bookshelf_2", "bookshelf", shelf, x, y0, turn=-90)

    def put(name, nyu40, model, along, level, turn=0.0):
        # The shelf faces west, so its left end is to the north.
        scene.add(name, nyu40, model, x - 0.02, y0 - along, z[level], turn - 90, "bookshelf_2")

    put("box_7", "box", small.storage_box(0.32, 0.24, 0.22, "linen_clay"), -0.32, 0)
    put("box_8", "box", small.storage_box(0.32, 0.24, 0.22, "linen_blue"), 0.04, 0)
    put("basket_3", "otherprop", small.basket(0.12, 0.20), 0.37, 0)
    put("books_8", "books", small.book_row(8, 9, lean=1), -0.33, 1)
    put("camera", "otherprop", _camera(), 0.06, 1, 12)
    put("books_9", "books", small.book_row(9, 7), 0.36, 1)
    put("books_10", "books", small.book_row(10, 8), -0.34, 2)
    put("vase_6", "otherprop", crockery.vase("stoneware_blue", 0.24, 0.09, 0.028, 0.3), 0.02, 2)
    put("books_11", "books", small.book_row(11, 8, lean=2), 0.34, 2)
    put("trophy", "otherprop", _trophy(), -0.36, 3)
    put("books_12", "books", small.book_row(12, 10), -0.02, 3)
    put("photo_3", "picture", ornaments.photo_stand("hills", 0.21, 0.14, "brass"), 0.36, 3, -6)
    top = scene.things["bookshelf_2"].bounds()[1][2]
    scene.add(
        "potted_plant_9",
        "otherprop",
        plants.bushy(37, "stoneware_sage", 0.085, 19, 0.09),
        x - 0.02,
        y0 + 0.30,
        top,
        0,
        "bookshelf_2",
    )
    scene.add(
        "hat_box",
        "box",
        small.storage_box(0.30, 0.24, 0.16, "linen_ochre"),
        x,
        y0 - 0.26,
        top,
        -86,
        "bookshelf_2",
    )


def _camera():
    lens = cylinder("black_metal", 0.031, 0.045, 28, 0.004).turned(90, "x").moved(y=-0.025, z=0.042)
    return joined(
        [
            soft_box("leather_black", 0.135, 0.05, 0.075, 0.012),
            box("steel", 0.133, 0.048, 0.018, 0.004).moved(z=0.073),
            lens,
            cylinder("dark_glass", 0.024, 0.002, 24, 0).turned(90, "x").moved(y=-0.0695, z=0.042),
            box("steel", 0.045, 0.044, 0.014, 0.004).moved(z=0.090),
            cylinder("steel", 0.010, 0.010, 16, 0.002, 0.090).moved(x=0.045),
            cylinder("steel", 0.013, 0.008, 16, 0.002, 0.090).moved(x=-0.045),
        ]
    )


def _trophy():
    return joined(
        [
            box("walnut", 0.08, 0.08, 0.05, 0.004),
            lathe(
                "brass",
                [
                    (0, 0.05),
                    (0.03, 0.05),
                    (0.008, 0.07),
                    (0.008, 0.10),
                    (0.035, 0.13),
                    (0.048, 0.20),
                    (0.045, 0.20),
                    (0.03, 0.135),
                    (0, 0.12),
                ],
                32,
                50,
            ),
        ]
    )


def _metronome():
    body = (
        extrude("oak", [(-0.055, 0), (0.055, 0), (0.028, 0.21), (-0.028, 0.21)], 0.09, 0.004)
        .turned(90, "x")
        .moved(y=0.045)
    )
    return joined(
        [
            body,
            box("walnut", 0.12, 0.10, 0.012, 0.003).moved(z=-0.012),
            rod("steel", (0, -0.048, 0.03), (0.02, -0.048, 0.19), 0.002, segments=8),
            box("brass", 0.016, 0.006, 0.02, 0.002).moved(x=0.013, y=-0.049, z=0.13),
        ]
    ).moved(z=0.012)
