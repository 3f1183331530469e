#pragma once

#include "engine/document/edits.h"
#include "engine/plan/plan.h"
#include "ui/edit_request.h"

#include <optional>
#include <string>

namespace dollytrack::ui {

/// The operation that adds a region; each side is at least 5 cm long.
nlohmann::json addRegionOperation(const OrientedBox& box);

/// Draws the rows of a region inside a form (name, weight, must-see, box); `edit` receives the
/// operation that changes it.
void regionRows(const Region& region, const std::string& name, EditRequest& edit);

/// "94.2 % of the visible surface seen": the share that the frames show of the region's surface
/// visible from free space; nullopt if it was no must-see region when the plan was made.
std::optional<std::string> seenText(const Plan& plan, const Region& region);

}  // namespace dollytrack::ui
