"""Bathroom: north, between bedroom and study."""

from furniture import bathroom, crockery, lamps, ornaments, plants, seating, small
from rooms.living import rug
from shapes.soft import soft_box

WEST, EAST, SOUTH, NORTH = 4.32, 6.70, 4.52, 8.0


def furnish(scene):
    scene.room = "bathroom"
    scene.add("bathtub", "bathtub", bathroom.bathtub(), WEST + 0.92, NORTH - 0.46)
    scene.add("wooden_rack", "otherprop", bathroom.bath_caddy(), WEST + 1.10, NORTH - 0.46, 0.5602)
    scene.things["wooden_rack"].on = "bathtub"
    rim = 0.5602 + 0.018
    scene.add(
        "candle_5",
        "otherprop",
        crockery.tea_light("stoneware_black"),
        WEST + 1.10,
        NORTH - 0.56,
        rim,
        0,
        "wooden_rack",
    )
    scene.add("sponge", "otherprop", _sponge(), WEST + 1.10, NORTH - 0.36, rim, 20, "wooden_rack")
    scene.add("bath_tap", "otherprop", bathroom.tub_tap(), WEST + 1.87, NORTH - 0.46, turn=-90)
    scene.add(
        "rug_bathroom", "floor mat", rug("bath_mat", 0.85, 0.55, 0.012), WEST + 1.05, NORTH - 1.22
    )
    scene.add("toilet", "toilet", bathroom.toilet(), WEST + 0.012, 6.25, turn=90)
    scene.add(
        "toilet_paper",
        "otherprop",
        bathroom.paper_holder(),
        WEST,
        5.80,
        0.72,
        90,
        "wall_bathroom_west",
        "hangs",
    )
    scene.add("toilet_brush", "otherprop", bathroom.brush(), WEST + 0.10, 6.58)
    scene.add(
        "washing_machine",
        "otherfurniture",
        bathroom.washing_machine(),
        EAST - 0.315,
        4.84,
        turn=-90,
    )
    top = scene.things["washing_machine"].bounds()[1][2]
    scene.add(
        "detergent",
        "otherprop",
        crockery.bottle("liquid_soap", 0.26, 0.05, "label_sage"),
        EAST - 0.20,
        4.70,
        top,
        -90,
        "washing_machine",
    )
    scene.add(
        "towels_2",
        "towel",
        small.folded("towel_white", 0.32, 0.24, 0.14),
        EAST - 0.30,
        4.94,
        top,
        -86,
        "washing_machine",
    )
    _vanity(scene)
    scene.add(
        "towel_rail",
        "otherprop",
        bathroom.towel_rail(0.62),
        WEST,
        5.46,
        1.28,
        90,
        "wall_bathroom_west",
        "hangs",
    )
    scene.add(
        "towel",
        "towel",
        bathroom.hanging_towel("towel_clay"),
        WEST + 0.07,
        5.46,
        1.28 - 0.0015,
        90,
        "towel_rail",
        "hangs",
    )
    scene.add("laundry_basket", "otherprop", small.basket(0.18, 0.50), WEST + 0.20, SOUTH + 0.24)
    scene.add(
        "picture_7",
        "picture",
        ornaments.framed("shapes", 0.24, 0.34, "oak", 0.04),
        WEST,
        6.25,
        1.55,
        90,
        "wall_bathroom_west",
        "hangs",
    )
    scene.add(
        "ceiling_lamp_2",
        "lamp",
        lamps.ceiling_disc(),
        5.5,
        6.1,
        2.60,
        0,
        "ceiling_bathroom",
        "hangs",
    )
    scene.add(
        "potted_plant_7",
        "otherprop",
        plants.snake_plant(31, "white_clay", 8, 0.40, 0.09),
        EAST - 0.22,
        NORTH - 0.24,
    )
    scene.add("stool", "chair", seating.stool(), EAST - 0.26, 6.78)
    scene.add(
        "paper_rolls", "otherprop", bathroom.paper_roll(), WEST + 0.12, 6.14, 0.803, 0, "toilet"
    )


def _vanity(scene):
    y = 5.88
    scene.add(
        "bathroom_vanity",
        "cabinet",
        bathroom.vanity(),
        EAST,
        y,
        0.0,
        -90,
        "wall_bathroom_east",
        "hangs",
    )
    scene.add(
        "washbasin",
        "sink",
        bathroom.washbasin(),
        EAST - 0.26,
        y + 0.14,
        0.80,
        -90,
        "bathroom_vanity",
    )
    scene.add(
        "basin_tap",
        "otherprop",
        bathroom.basin_tap(),
        EAST - 0.045,
        y + 0.14,
        0.80,
        -90,
        "bathroom_vanity",
    )
    scene.add(
        "mirror_bathroom",
        "mirror",
        ornaments.round_mirror(0.36),
        EAST,
        y + 0.14,
        1.52,
        -90,
        "wall_bathroom_east",
        "hangs",
    )
    scene.add(
        "wall_lamp",
        "lamp",
        lamps.wall_lamp(),
        EAST,
        y - 0.36,
        1.55,
        -90,
        "wall_bathroom_east",
        "hangs",
    )
    scene.add(
        "soap_dispenser",
        "otherprop",
        bathroom.dispenser(),
        EAST - 0.16,
        y - 0.16,
        0.80,
        -90,
        "bathroom_vanity",
    )
    scene.add(
        "toothbrush_cup",
        "otherprop",
        bathroom.tumbler_with_brushes(),
        EAST - 0.15,
        y - 0.30,
        0.80,
        -70,
        "bathroom_vanity",
    )
    scene.add(
        "towels_3",
        "towel",
        small.folded("towel_sage", 0.20, 0.15, 0.075),
        EAST - 0.34,
        y - 0.36,
        0.80,
        -84,
        "bathroom_vanity",
    )


def _sponge():
    return soft_box("knit_ochre", 0.09, 0.12, 0.045, 0.018)
