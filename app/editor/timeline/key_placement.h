#pragma once

#include "engine/document/given_motion.h"
#include "engine/plan/plan.h"
#include "planning/plan_params.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace dollytrack::editor {

/// The time of a new key, which never replaces another one. `after` is the index of the key that it
/// follows; -1: the last key before or at the playhead. The new key lies between that key and the
/// next one: at the playhead's time, on a whole frame, if the playhead is between them, otherwise
/// halfway. After the last key it is as much later as the motion limits need. `plan` is the plan of
/// these keys; null: it is still being made, and the playhead is ignored.
[[nodiscard]] double timeOfNewKey(const std::vector<MotionKey>& keys, const Plan* plan,
                                  int playhead, int after, const Pose& view,
                                  const planning::TimingParams& timing);

/// The key that the playhead is on, if any.
[[nodiscard]] std::optional<std::size_t> keyAtPlayhead(const std::vector<MotionKey>& keys,
                                                       const Plan* plan, int playhead);

}  // namespace dollytrack::editor
