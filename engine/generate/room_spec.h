#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace dollytrack::generate {

enum class RoomKind { Bedroom, Living, Dining, Kitchen, Office, Studio, Suite };

/// Name of a kind, such as "bedroom".
std::string_view roomKindName(RoomKind kind);

/// Requirements for a room.
struct RoomSpec {
    RoomKind kind = RoomKind::Living;
    double length_m = 5.0;
    double width_m = 4.0;
    double height_m = 2.7;
    int objects = 50;  // intended number, without doors and windows
};

constexpr double kLeastSide = 2.5;  // m
constexpr double kMostSide = 15.0;
constexpr double kLeastHeight = 2.4;
constexpr double kMostHeight = 5.0;
constexpr int kMostObjects = 120;

/// A room type of the comparison of camera planners in Information 2025, 16(4), 315 (Table 2), with
/// its mean size and number of objects.
struct RoomPreset {
    std::string_view name;
    RoomSpec spec;
};

std::span<const RoomPreset> roomPresets();
/// Random variation for room `number` of a set: its size is within 5 % of `spec`, its number of
/// objects within 10 %.
RoomSpec varied(const RoomSpec& spec, std::uint64_t seed, std::uint64_t number);
/// The preset of this name; null if there is none.
const RoomPreset* presetNamed(std::string_view name);

}  // namespace dollytrack::generate
