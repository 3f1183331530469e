#pragma once

#include "engine/io/orientation/frame_evidence.h"
#include "engine/math/up_axis.h"

#include <array>
#include <vector>

namespace dollytrack {

/// What speaks for one direction being up, each from -1 (against) to 1 (for), 0 where it cannot be
/// told.
struct UpEvidence {
    UpAxis axis;
    double named = 0.0;     // floors, mats, doors at the bottom, ceilings at the top
    double level = 0.0;     // share of all surfaces that lie across it: floors, ceilings, tops
    double lowest = 0.0;    // a room is lower than it is long
    double standing = 0.0;  // things begin at one height rather than end at one
    double resting = 0.0;   // things rest on others, and do not hang from them
    double support = 0.0;   // things have another's surface right below their lowest points
    double round = 0.0;     // cups, pots and lamps are round about it
    double tops = 0.0;      // the tops of furniture lie in the lower half of the room
    double floor = 0.0;     // a floor more often than a ceiling
    double shapes = 0.0;    // seats and beds are heavy below, tables above
    double score = 0.0;     // all of it, weighted
};

/// All six directions, the likeliest first. Furnished rooms differ by 3 and more in score between
/// the right one and the next, sparse ones by 1; a wrong one leads by 0.4 at most where hardly
/// anything can be told.
std::vector<UpEvidence> judgeUp(const FrameEvidence& evidence);

/// Whether the evidence contradicts an axis by a lead of that size. A single object contradicts
/// none: it may lie on its side.
[[nodiscard]] bool contradicts(const FrameEvidence& evidence, const std::vector<UpEvidence>& ranked,
                               UpAxis axis, double lead = 1.0);

}  // namespace dollytrack
