#pragma once

#include "engine/plan/capture_ledger.h"
#include "engine/scene/scene.h"

#include <nlohmann/json_fwd.hpp>

namespace dollytrack {

/// One object a row, with everything known: for `plan --json`, projects and dataset.json. Frames
/// count in the trajectory.
nlohmann::json ledgerJson(const Scene& scene, const std::vector<LedgerRow>& ledger);

/// Those that no frame captures, each with its reason: short, for people and scripts.
nlohmann::json uncapturedJson(const Scene& scene, const std::vector<LedgerRow>& ledger);

}  // namespace dollytrack
