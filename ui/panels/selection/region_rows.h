#pragma once

#include "engine/document/edits.h"
#include "engine/plan/plan.h"
#include "ui/edit_request.h"

#include <optional>
#include <string>

namespace dollytrack::ui {

/// The operation that adds a region; flat boxes get a thickness.
nlohmann::json addRegionOperation(const OrientedBox& box);

/// The rows of a region inside a form: name, weight, must-see and box; asks for its change.
void regionRows(const Region& region, const std::string& name, EditRequest& edit);

/// "94.2 % seen" of the region in the plan, where it was a must-see region then.
std::optional<std::string> seenText(const Plan& plan, const Region& region);

}  // namespace dollytrack::ui
