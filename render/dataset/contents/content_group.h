#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace dollytrack::render {

/// What a modality or a format is for; lists of them are shown by group.
enum class ContentGroup {
    Colour,
    Geometry,
    Labels,
    Motion,
    Sensors,
    Light,
    Poses,
    Measurements,
    Other
};

/// The groups' headings, in the order in which they are shown.
inline constexpr std::array<std::string_view, 9> kContentGroupNames = {
    "Colour", "Geometry",     "Labels", "Motion", "Stereo and sensors", "Path-traced light",
    "Poses",  "Measurements", "Other"};

[[nodiscard]] constexpr std::string_view groupName(ContentGroup group) {
    return kContentGroupNames[static_cast<std::size_t>(group)];
}

}  // namespace dollytrack::render
