#pragma once

#include "engine/plan/capture_ledger.h"
#include "engine/scene/scene.h"

#include <nlohmann/json.hpp>

namespace dollytrack {

/// The operations (operation.h) that apply the remedy of an object, for `dollytrack edit --script`.
/// Empty if the remedy is to move an object: where to, only the user can say.
nlohmann::json remedyOperations(const Scene& scene, int object_id, const Remedy& remedy);

}  // namespace dollytrack
