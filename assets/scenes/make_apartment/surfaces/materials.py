"""Every material by name: tint, gloss, picture and how many metres one tile of it spans."""

from dataclasses import dataclass
from typing import Callable, Optional

from surfaces import patterns, pictures, prints, rugs


@dataclass(frozen=True)
class Material:
    tint: str = "#ffffff"  # multiplies the picture
    roughness: float = 0.8
    metallic: float = 0.0
    picture: Optional[str] = None  # a name in PICTURES
    tile_m: tuple = (1.0, 1.0)  # (1, 1) with texture coordinates 0..1: a fitted picture
    wander: bool = True  # shift the tiles from object to object, so that grain does not repeat
    opacity: float = 1.0
    glow: Optional[str] = None


CHIPS = ["#b9694b", "#7d8f78", "#6b6a64", "#d8b98a", "#ffffff", "#4a5357"]

# Colours are chosen around warm oak and off-white; sage, clay and brass are the accents.
PICTURES: dict[str, Callable] = {
    "oak": lambda: patterns.wood(1, "#e0c196", "#bd9260"),
    "walnut": lambda: patterns.wood(21, "#94694a", "#5d3d2a"),
    "planks": lambda: patterns.planks(2, "#dcbd92", "#b88f60"),
    "plaster": lambda: patterns.plaster(3, "#f4f0e8"),
    "tile_white": lambda: patterns.tiles(4, "#f3f0e8", "#d8d3c7", 6, 6, 3, 0.05),
    "tile_sage": lambda: patterns.tiles(14, "#a9b59f", "#dcd9cd", 8, 4, 3, 0.09, offset=0.5),
    "terrazzo": lambda: patterns.terrazzo(5, "#e9e3d8", CHIPS),
    "marble": lambda: patterns.marble(6, "#f4f1ec", "#8d8a86"),
    "weave": lambda: patterns.weave(7),
    "knit": lambda: patterns.knit(8),
    "pile": lambda: patterns.pile(9),
    "rattan": lambda: patterns.rattan(10),
    "leather": lambda: patterns.leather(11, "#a86b43"),
    "leaf": lambda: patterns.leaf_skin(12, "#4c7547", "#9dbd83"),
    "leaf_dark": lambda: patterns.leaf_skin(15, "#2f5540", "#6f9468"),
    "soil": lambda: patterns.soil(16),
    "slats": lambda: patterns.slats("#d6b184", "#85633f"),
    "checks": lambda: patterns.checks(13, "#f6f1e6", "#b9694b"),
    "berber": rugs.berber,
    "kilim": rugs.kilim,
    "jute": rugs.rings,
    "rug_bedroom": lambda: rugs.bordered(45, "#c9cfc2", "#efe9dc"),
    "bath_mat": lambda: rugs.bordered(46, "#d9b7a2", "#f2ece1"),
    "hills": pictures.hills,
    "shapes": pictures.shapes,
    "branch": pictures.branch,
    "sea": pictures.sea,
    "waves": pictures.waves,
    "portrait": pictures.portrait,
    "map": pictures.city_map,
    "tv": pictures.tv_screen,
    "desktop": pictures.desktop_screen,
    "laptop": pictures.laptop_screen,
    "outside": pictures.outside,
    "spines": prints.book_spines,
    "covers": prints.book_covers,
    "clock": prints.clock_face,
    "keys": prints.keyboard_keys,
    "piano": prints.piano_keys,
    "globe": prints.globe_map,
    "label_clay": lambda: prints.label(91, "#f2ece0", "#333333", "#b9694b"),
    "label_sage": lambda: prints.label(92, "#f4f1e8", "#3a3a36", "#6d8270"),
    "notes": prints.notes,
    "hob": prints.hob_plate,
}


def _cloth(tint, picture="weave", tile=0.16):
    return Material(tint, 0.92, picture=picture, tile_m=(tile, tile))


MATERIALS = {
    # building
    "floor_planks": Material(roughness=0.55, picture="planks", tile_m=(1.6, 0.64), wander=False),
    "wall_white": Material(roughness=0.9, picture="plaster", tile_m=(1.5, 1.5)),
    "wall_sage": Material("#c3ccb9", 0.9, picture="plaster", tile_m=(1.5, 1.5)),
    "wall_clay": Material("#ecd3c2", 0.9, picture="plaster", tile_m=(1.5, 1.5)),
    "wall_blue": Material("#cfd8db", 0.9, picture="plaster", tile_m=(1.5, 1.5)),
    "ceiling_white": Material("#fbfaf7", 0.95),
    "trim_white": Material("#f6f3ec", 0.5),
    "tile_white": Material(roughness=0.25, picture="tile_white", tile_m=(0.9, 0.9), wander=False),
    "tile_sage": Material(roughness=0.25, picture="tile_sage", tile_m=(0.6, 0.6), wander=False),
    "terrazzo": Material(roughness=0.35, picture="terrazzo", tile_m=(1.2, 1.2)),
    "glass_pane": Material("#dfeeee", 0.05, opacity=0.10),
    "glass": Material("#e3eeea", 0.05, opacity=0.28),
    "glass_amber": Material("#b9793a", 0.08, opacity=0.62),
    "outside": Material("#ffffff", 1.0, picture="outside", glow="#ffffff"),
    # wood, stone, metal, plastic
    "oak": Material(roughness=0.55, picture="oak", tile_m=(0.9, 0.45)),
    "oak_slats": Material(roughness=0.6, picture="slats", tile_m=(0.4, 0.4)),
    "walnut": Material(roughness=0.5, picture="walnut", tile_m=(0.9, 0.45)),
    "marble": Material(roughness=0.2, picture="marble", tile_m=(1.3, 1.3)),
    "brass": Material("#d3a957", 0.32, 0.85),
    "steel": Material("#c9cbcc", 0.3, 0.8),
    "chrome": Material("#dfe1e2", 0.15, 0.85),
    "black_metal": Material("#2b2c2d", 0.45, 0.4),
    "white_metal": Material("#efece5", 0.4),
    "sage_paint": Material("#9aa992", 0.55),
    "cream_paint": Material("#efe8da", 0.5),
    "clay_paint": Material("#bf7352", 0.55),
    "blue_paint": Material("#54707c", 0.5),
    "ochre_paint": Material("#d3a14e", 0.55),
    "black_lacquer": Material("#1d1c1c", 0.22),
    "black_plastic": Material("#232425", 0.5),
    "grey_plastic": Material("#9c9d9b", 0.5),
    "white_plastic": Material("#f1f0ec", 0.4),
    "dark_glass": Material("#101214", 0.08),
    "mirror": Material("#c9d3d6", 0.04, 0.95),
    # ceramics
    "porcelain": Material("#f7f6f2", 0.15),
    "stoneware": Material("#d9cfbe", 0.55),
    "stoneware_sage": Material("#93a48c", 0.4),
    "stoneware_blue": Material("#5b7683", 0.35),
    "stoneware_black": Material("#3a3836", 0.55),
    "terracotta": Material("#c37a57", 0.85),
    "white_clay": Material("#f0ebe1", 0.7),
    # cloth
    "linen_oat": _cloth("#e3d8c6"),
    "linen_white": _cloth("#fbf8f1"),
    "linen_sage": _cloth("#a3b098"),
    "linen_clay": _cloth("#c98260"),
    "linen_ochre": _cloth("#d9ab5b"),
    "linen_blue": _cloth("#7d949e"),
    "linen_grey": _cloth("#8f8f8a"),
    "linen_ink": _cloth("#47545b"),
    "boucle": _cloth("#f4eee2", "pile", 0.22),
    "towel_sage": _cloth("#b3c0a8", "pile", 0.12),
    "towel_clay": _cloth("#d79a7c", "pile", 0.12),
    "towel_white": _cloth("#fbf9f4", "pile", 0.12),
    "felt_grey": _cloth("#7e7d79", "pile", 0.25),
    "knit_cream": _cloth("#f3e9d8", "knit", 0.16),
    "knit_clay": _cloth("#cf8b68", "knit", 0.16),
    "knit_ochre": _cloth("#dcb066", "knit", 0.14),
    "checks": Material(roughness=0.9, picture="checks", tile_m=(0.3, 0.3)),
    "leather": Material(roughness=0.5, picture="leather", tile_m=(0.5, 0.5)),
    "leather_black": Material("#5a4a42", 0.5, picture="leather", tile_m=(0.5, 0.5)),
    "rattan": Material(roughness=0.8, picture="rattan", tile_m=(0.16, 0.16)),
    "cord": Material("#e8d6b4", 0.9, picture="weave", tile_m=(0.12, 0.12)),
    "lampshade": Material("#fbf3e2", 0.9, picture="weave", tile_m=(0.12, 0.12), glow="#6b5a3c"),
    "opal": Material("#fffaf0", 0.4, glow="#a89a80"),
    "flame": Material("#fff1c9", 0.6, glow="#ffd98a"),
    # living things
    "leaf": Material(roughness=0.55, picture="leaf"),
    "leaf_dark": Material(roughness=0.45, picture="leaf_dark"),
    "leaf_grey": Material("#d8e8df", 0.7, picture="leaf"),
    "stem": Material("#6f7f4c", 0.7),
    "bark": Material("#7a6248", 0.9),
    "soil": Material(roughness=1.0, picture="soil", tile_m=(0.15, 0.15)),
    "apple_red": Material("#b8402f", 0.35),
    "apple_green": Material("#a3b04a", 0.35),
    "lemon": Material("#eac64b", 0.45),
    "orange": Material("#df8b36", 0.5),
    "banana": Material("#e7c65a", 0.5),
    "bread": Material("#c08a4f", 0.85),
    "petal": Material("#e8b7a0", 0.6),
    "wax": Material("#f5ecd8", 0.5),
    "paper": Material("#f5f0e4", 0.9),
    "cardboard": Material("#c6a47a", 0.9),
    "liquid_soap": Material("#d6a06a", 0.2),
    "cork": Material("#c69c6d", 0.95),
}

# Fitted pictures: the material has the picture's name.
for _name, _roughness in {
    "berber": 1.0,
    "kilim": 1.0,
    "jute": 1.0,
    "rug_bedroom": 1.0,
    "bath_mat": 1.0,
    "hills": 0.7,
    "shapes": 0.8,
    "branch": 0.8,
    "sea": 0.6,
    "waves": 0.8,
    "portrait": 0.8,
    "map": 0.8,
    "spines": 0.7,
    "covers": 0.5,
    "clock": 0.5,
    "keys": 0.6,
    "piano": 0.3,
    "globe": 0.4,
    "label_clay": 0.7,
    "label_sage": 0.7,
    "notes": 0.9,
    "hob": 0.1,
}.items():
    MATERIALS[_name] = Material(roughness=_roughness, picture=_name)
for _name in ("tv", "desktop", "laptop"):
    MATERIALS[_name] = Material("#ffffff", 0.15, picture=_name, glow="#8a8a8a")
