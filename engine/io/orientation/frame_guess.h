#pragma once

#include "engine/io/object_parts/object_grouping.h"
#include "engine/io/raw_scene/raw_scene.h"
#include "engine/math/up_axis.h"

#include <Eigen/Geometry>

#include <optional>
#include <string>
#include <vector>

namespace dollytrack {

/// Metres per source unit and the source's up axis, and how each was determined.
struct FrameChoice {
    double unit_m = 1.0;
    std::string unit_source;
    UpAxis up_axis = 'y';
    std::string up_source;
    bool up_is_certain =
        false;  // the user gave the axis, or the exporter always writes it correctly
    std::optional<UpAxis>
        likelier_up;         // a more plausible axis, if the file's axis is doubtful but was kept
    std::string unit_doubt;  // reason, without a full stop; empty if the unit is plausible
    std::optional<double> other_unit_m;  // another, equally plausible unit, if there is one
    std::vector<std::string> warnings;

    /// Transform from the source's axes and unit to the world: right-handed, z up, metres.
    [[nodiscard]] Eigen::Affine3d worldFromSource() const;
};

/// Chooses unit and up axis: the given ones, otherwise the file's if the room's size is plausible
/// and the evidence is not clearly for another axis, otherwise the most likely ones by the sizes of
/// named objects, the room's height, floor-like surfaces and gravity. Of two axes that are about
/// equally likely, `usual_up` is used, the one that most files of the format have. Doubts become
/// warnings.
FrameChoice chooseFrame(const RawScene& raw, const std::vector<ObjectDraft>& drafts,
                        std::optional<double> given_unit_m, std::optional<UpAxis> given_up_axis,
                        UpAxis usual_up = {});

}  // namespace dollytrack
