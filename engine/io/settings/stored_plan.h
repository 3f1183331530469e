#pragma once

#include "engine/core/result.h"

#include <nlohmann/json.hpp>

#include <string>

namespace dollytrack::io {

/// Checks the type of every field that resultJson() writes, as far as it is there; fields of other
/// names may hold anything. Readers of a stored plan rely on it. Null is no plan, and is accepted.
/// Error: BadInput, with the field ("result.metrics.ledger[3].frame"); `where` names the section.
Status checkStoredPlan(const nlohmann::json& result, const std::string& where);

}  // namespace dollytrack::io
