#pragma once

#include "engine/plan/capture_ledger.h"
#include "engine/scene/scene.h"

#include <nlohmann/json.hpp>

namespace dollytrack {

/// A list of operations (operation.h) that apply the remedy of an object, for `dollytrack edit
/// --script`. Empty when a person has to do it: to find another place for an object.
nlohmann::json remedyOperations(const Scene& scene, int object_id, const Remedy& remedy);

}  // namespace dollytrack
