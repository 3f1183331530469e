#pragma once

#include "engine/core/result.h"

#include <nlohmann/json.hpp>

#include <string>

namespace dollytrack {

/// Checks the types of all fields in a stored plan that resultJson() writes; readers rely on them.
/// Absent fields, unknown fields and null (no plan) are accepted. `where` names the section in
/// errors. Error: BadInput, with the field ("result.metrics.ledger[3].frame").
Status checkStoredPlan(const nlohmann::json& result, const std::string& where);

}  // namespace dollytrack
