#pragma once

#include "engine/io/import/raw_scene.h"
#include "engine/io/object_parts/object_grouping.h"
#include "engine/math/up_axis.h"

#include <Eigen/Geometry>

#include <optional>
#include <string>
#include <vector>

namespace dollytrack {

/// Metres per source unit and the source's upward axis, and how each was found.
struct FrameChoice {
    double unit_m = 1.0;
    std::string unit_source;
    UpAxis up_axis = 'y';
    std::string up_source;
    std::optional<UpAxis>
        likelier_up;  // a more plausible axis, where the file's axis is doubtful but was kept
    std::string unit_doubt;  // why, without a full stop; empty where the unit is believed
    std::vector<std::string> warnings;

    /// x, y, z of the source to right-handed, z up, metres.
    [[nodiscard]] Eigen::Affine3d worldFromSource() const;
};

/// What was given counts; else what the file says, if the room then has a believable size and
/// nearly everything does not stand on another side; else what sizes of named things, the room's
/// height, floor-like surfaces and gravity make likeliest. Doubts are among the warnings.
FrameChoice chooseFrame(const RawScene& raw, const std::vector<ObjectDraft>& drafts,
                        std::optional<double> given_unit_m, std::optional<UpAxis> given_up_axis);

}  // namespace dollytrack
