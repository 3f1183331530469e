#pragma once

#include "engine/document/given_motion.h"
#include "engine/plan/plan.h"
#include "planning/plan_params.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace dollytrack::editor {

/// Where a key that is recorded from a view goes among the keys of the camera path.
struct KeyPlacement {
    std::optional<std::size_t> replaces;  // index of the key that it replaces
    double time_s = 0.0;                  // otherwise: its time
};

/// The place of a new key. It replaces the selected key, or the key at the playhead unless that is
/// the last one. Between two keys it gets the playhead's time, on a whole frame. Otherwise it
/// follows the last key, as much later as the motion limits need. `plan` is the plan of these keys;
/// null: it is still being made, and the key follows the last one. `selected` is an index; -1:
/// none.
[[nodiscard]] KeyPlacement placeKey(const std::vector<MotionKey>& keys, const Plan* plan,
                                    int playhead, int selected, const Pose& view,
                                    const planning::TimingParams& timing);

}  // namespace dollytrack::editor
