#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace dollytrack {

constexpr int kNyu40Count = 40;

/// The classes that the code refers to by number; all others are looked up by name.
enum Nyu40 : int {
    kNyuUnknown = 0,
    kNyuWall = 1,
    kNyuFloor = 2,
    kNyuDoor = 8,
    kNyuWindow = 9,
    kNyuCeiling = 22,
    kNyuLamp = 35,
    kNyuOtherStructure = 38,
    kNyuOtherFurniture = 39,
    kNyuOtherProp = 40,
};

/// "wall" for 1 .. "otherprop" for 40, "void" for 0; empty outside 0..40.
std::string_view nyu40Name(int nyu40);

/// 1..40 for a class name in any usual spelling ("night stand", "night_stand",
/// "refridgerator"), 0 when it is none.
int nyu40FromName(std::string_view name);

/// Display colour, 8-bit sRGB; black for 0.
std::array<std::uint8_t, 3> nyu40Color(int nyu40);

}  // namespace dollytrack
