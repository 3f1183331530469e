#pragma once

#include "render/overlays/overlay.h"

#include <cstdint>

namespace dollytrack::ui {

/// The kind of plan element that an overlay tag refers to.
enum class Picked : std::uint8_t {
    Nothing,
    ObservationPoint,  // index in Plan::observation_points
    PositionPoint,     // index in Plan::position_points
    Edge,              // index in Roadmap::edges
    RefusedEdge,       // index in Roadmap::refused
    Sample,            // index in Roadmap::samples
    Frame,             // index in Trajectory::frames
    Candidate,         // index in ViewpointSearch::candidates
    CameraKey,         // index in GivenMotion::keys
};

struct PickTag {
    Picked kind = Picked::Nothing;
    int index = 0;  // up to 2^24 - 1
    bool operator==(const PickTag&) const = default;
};

[[nodiscard]] constexpr std::int32_t toTag(Picked kind, int index) {
    return static_cast<std::int32_t>(kind) << 24 | (index & 0xffffff);
}
[[nodiscard]] constexpr PickTag fromTag(std::int32_t tag) {
    if (tag < 0) return {};
    return {static_cast<Picked>(tag >> 24), tag & 0xffffff};
}

}  // namespace dollytrack::ui
