#pragma once

#include "engine/core/result.h"
#include "engine/generate/furniture/furniture_catalog.h"

#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::generate {

/// The function of a piece in a room.
enum class FurnitureRole {
    Door,
    Window,
    Bed,
    NightStand,
    Wardrobe,
    Dresser,
    Sofa,
    Armchair,
    CoffeeTable,
    TvStand,
    Television,
    Bookcase,
    Cabinet,
    Desk,
    OfficeChair,
    DiningTable,
    DiningChair,
    KitchenBase,  // as high as a counter: cabinets, sink, stove, dishwasher
    KitchenTall,
    KitchenUpper,
    FloorLamp,
    CeilingLamp,
    TableLamp,
    FloorPlant,
    WallItem,
    FloorItem,
    WorkFloorItem,  // on the floor of kitchens, dining rooms and offices
    DeskItem,
    LivingRoomItem,
    KitchenItem,
    BedroomItem,
    ShelfItem,
};
constexpr int kRoleCount = static_cast<int>(FurnitureRole::ShelfItem) + 1;

/// The role's name in roles.csv, such as "night_stand"; that of DeskItem is "desk_thing".
std::string_view roleName(FurnitureRole role);

/// Which pieces have a role: by name, category, elevation and size, because libraries also contain
/// sets of furniture and toys under the same names.
struct RoleRule {
    /// Floor: elevation of at most 20 cm. High: of at least 60 cm. Wall: doors and windows, which
    /// all other values exclude.
    enum class Place { Floor, High, Wall, Any };
    struct Range {
        double low = 0.0;
        double high = 0.0;
        [[nodiscard]] bool holds(double value) const { return low <= value && value <= high; }
    };
    FurnitureRole role = FurnitureRole::Door;
    Place place = Place::Any;
    std::string category;  // empty: any; "-Office": any other category
    Range width, depth, height;
    std::vector<std::string> names;    // English names of the pieces
    std::vector<std::string> without;  // ids of excluded pieces

    [[nodiscard]] bool admits(const CatalogPiece& piece) const;
};

/// Parses a table like assets/furniture/roles.csv. Error: BadInput, with the first wrong line.
Result<std::vector<RoleRule>> parseRoles(std::string_view csv, const std::string& where);

/// The rules of assets/furniture/roles.csv.
const std::vector<RoleRule>& builtInRoles();

}  // namespace dollytrack::generate
