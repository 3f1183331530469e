#pragma once

#include "engine/camera/camera_params.h"
#include "engine/document/given_motion.h"
#include "engine/plan/passed_key.h"
#include "ui/overlays/legend.h"

#include <vector>

namespace dollytrack::ui {

/// The keys of a given camera motion as small cameras, which can be clicked. Those with a note in
/// `passed` are red; `passed` is ignored if it has another number of keys. `selected` is an index;
/// -1: none.
[[nodiscard]] PlanLayer cameraKeysLayer(const std::vector<MotionKey>& keys,
                                        const std::vector<PassedKey>& passed,
                                        const CameraParams& camera, int selected);

}  // namespace dollytrack::ui
