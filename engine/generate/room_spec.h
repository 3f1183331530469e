#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace dollytrack::generate {

enum class RoomKind { Bedroom, Living, Dining, Kitchen, Office, Studio, Suite };

/// "bedroom" and so on.
std::string_view roomKindName(RoomKind kind);

/// What a room is to be like.
struct RoomSpec {
    RoomKind kind = RoomKind::Living;
    double length_m = 5.0;
    double width_m = 4.0;
    double height_m = 2.7;
    int objects = 50;  // aimed at, doors and windows aside
};

constexpr double kLeastSide = 2.5;  // m
constexpr double kMostSide = 15.0;
constexpr double kLeastHeight = 2.4;
constexpr double kMostHeight = 5.0;
constexpr int kMostObjects = 120;

/// A type of room in the comparison of camera planners (Table 2 of Information 2025, 16(4), 315),
/// with its mean size and number of objects.
struct RoomPreset {
    std::string_view name;
    RoomSpec spec;
};

std::span<const RoomPreset> roomPresets();
/// The room of this number: sides and height within 5 %, objects within 10 % of what is given.
RoomSpec varied(const RoomSpec& spec, std::uint64_t seed, std::uint64_t number);
/// Null for an unknown name.
const RoomPreset* presetNamed(std::string_view name);

}  // namespace dollytrack::generate
