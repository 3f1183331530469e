#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace dollytrack::statistics {

/// A quantity with a histogram.
enum class Quantity : std::uint8_t {
    BoxShare,
    MaskShare,
    AspectRatio,
    BoxesPerFrame,
    VisibleFraction,
    BestVisibleFraction,
    Truncation,
    Distance,
    CameraHeight,
    CameraPitch,
    Speed,
    TurnRate,
    Depth,
    Luma,
};
inline constexpr std::size_t kQuantities = 14;

/// The bins of a histogram.
enum class AxisKind : std::uint8_t {
    Decades,   // logarithmic, five bins per factor of ten
    Octaves,   // logarithmic, four bins per factor of two
    Share,     // 0 to 1
    Byte,      // 0 to 255
    Count,     // whole numbers from 0
    FromZero,  // from 0, without the largest values if they are far from the others
    Linear,    // from the smallest to the largest value
};

struct QuantityInfo {
    Quantity quantity;
    const char* key;    // in JSON, with its unit
    const char* title;  // of the chart
    const char* axis;   // label of the axis, with the unit as shown
    const char* unit;   // behind a number, with a space; may be empty
    double factor;      // shown / stored number: 100 for shares, which are shown in %
    const char* items;  // what is counted
    AxisKind kind;
    const char* source;  // what 'export' must be asked for; empty: nothing
    const char* note;    // a sentence below the chart; may be empty
};

/// All quantities, in the order of Quantity.
[[nodiscard]] std::span<const QuantityInfo, kQuantities> quantities();

[[nodiscard]] inline const QuantityInfo& infoOf(Quantity quantity) {
    return quantities()[static_cast<std::size_t>(quantity)];
}

}  // namespace dollytrack::statistics
