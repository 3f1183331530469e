#include "engine/generate/room_spec.h"

#include "engine/core/random.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dollytrack::generate {
namespace {

constexpr std::array<RoomPreset, 9> kPresets = {{
    {"3d-front-suite", {RoomKind::Suite, 9.8, 8.6, 3.1, 50}},
    {"3d-front-office", {RoomKind::Office, 7.7, 6.4, 2.9, 39}},
    {"3d-front-studio", {RoomKind::Studio, 3.2, 2.9, 2.7, 26}},
    {"scenenet-living-room", {RoomKind::Living, 6.2, 4.8, 2.9, 78}},
    {"scenenet-office", {RoomKind::Office, 4.4, 4.2, 3.0, 102}},
    {"scenenet-kitchen", {RoomKind::Kitchen, 3.5, 3.2, 2.9, 83}},
    {"hypersim-living-room", {RoomKind::Living, 8.8, 7.7, 3.1, 52}},
    {"hypersim-dining-room", {RoomKind::Dining, 6.2, 5.5, 2.9, 56}},
    {"hypersim-bedroom", {RoomKind::Bedroom, 5.4, 5.2, 2.9, 49}},
}};

}  // namespace

std::string_view roomKindName(RoomKind kind) {
    switch (kind) {
        case RoomKind::Bedroom:
            return "bedroom";
        case RoomKind::Living:
            return "living room";
        case RoomKind::Dining:
            return "dining room";
        case RoomKind::Kitchen:
            return "kitchen";
        case RoomKind::Office:
            return "office";
        case RoomKind::Studio:
            return "studio";
        case RoomKind::Suite:
            return "suite";
    }
    return "";
}

std::span<const RoomPreset> roomPresets() {
    return kPresets;
}

RoomSpec varied(const RoomSpec& spec, std::uint64_t seed, std::uint64_t number) {
    constexpr std::uint64_t kStream = std::uint64_t{1} << 40;  // differs from the rooms' streams
    Random random(seed, kStream + number);
    const auto about = [&](double value, double share) {
        return value * random.uniform(1.0 - share, 1.0 + share);
    };
    const auto centimetres = [](double value) { return std::round(100.0 * value) / 100.0; };
    RoomSpec result = spec;
    result.length_m = centimetres(about(spec.length_m, 0.05));
    result.width_m = centimetres(about(spec.width_m, 0.05));
    result.height_m = centimetres(about(spec.height_m, 0.05));
    result.objects =
        std::min(kMostObjects, static_cast<int>(std::lround(about(spec.objects, 0.1))));
    return result;
}

const RoomPreset* presetNamed(std::string_view name) {
    const auto* found = std::find_if(kPresets.begin(), kPresets.end(),
                                     [&](const auto& preset) { return preset.name == name; });
    return found == kPresets.end() ? nullptr : found;
}

}  // namespace dollytrack::generate
