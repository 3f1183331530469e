#pragma once

#include "engine/core/result.h"
#include "engine/generate/furniture_catalog.h"

#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::generate {

/// What a piece is for in a room.
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
    WallThing,
    FloorThing,
    WorkFloorThing,  // where people work and eat
    DeskThing,
    LivingThing,
    KitchenThing,
    BedroomThing,
    ShelfThing,
};
constexpr int kRoleCount = static_cast<int>(FurnitureRole::ShelfThing) + 1;

/// "night_stand" and so on, as the table of roles has it.
std::string_view roleName(FurnitureRole role);

/// Which pieces play a role: by name, kind and size, since libraries hold sets of furniture, toys
/// and oddities under plain names.
struct RoleRule {
    enum class Place { Floor, High, Wall, Any };
    struct Range {
        double low = 0.0;
        double high = 0.0;
        [[nodiscard]] bool holds(double value) const { return low <= value && value <= high; }
    };
    FurnitureRole role = FurnitureRole::Door;
    Place place = Place::Any;
    std::string category;  // empty: any; "-Office": any but that
    Range width, depth, height;
    std::vector<std::string> names;    // English
    std::vector<std::string> without;  // ids

    [[nodiscard]] bool admits(const CatalogPiece& piece) const;
};

/// The rules of a table like assets/furniture/roles.csv, or the first line that is wrong.
Result<std::vector<RoleRule>> parseRoles(std::string_view csv, const std::string& where);

/// assets/furniture/roles.csv.
const std::vector<RoleRule>& builtInRoles();

}  // namespace dollytrack::generate
