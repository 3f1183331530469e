#pragma once

#include "engine/document/edits.h"
#include "engine/plan/viewpoint.h"
#include "engine/scene/scene.h"
#include "ui/edit_request.h"
#include "ui/selection.h"

#include <optional>
#include <string>
#include <vector>

namespace dollytrack::ui {

// Shared parts of the editing panels: operations as JSON, names, and rows of widgets.

nlohmann::json pointJson(const Eigen::Vector3d& point);
nlohmann::json turnJson(const Eigen::Quaterniond& rotation);
/// The operation that adds a no-go box; each side is at least 5 cm long.
nlohmann::json addNoGoOperation(const OrientedBox& box);

/// "sofa", or "object 12" if it has no name; empty for an id that is not in the scene.
std::string objectName(const Scene& scene, int id);
/// "sofa", "sofa and lamp", "sofa and 3 more".
std::string objectNames(const Scene& scene, const std::vector<int>& ids);
/// The verdict on a candidate for display: "hidden by sofa", "touching sofa", "legal".
std::string verdictText(Verdict verdict, const std::string& occluder = {});

/// "1.20 × 0.80 × 0.75 m".
std::string sizeText(const Eigen::Vector3d& size);
/// "1.20, 0.80, 0.75".
std::string placeText(const Eigen::Vector3d& place);

/// Draws object names as links, wrapped to the available width: at most `most`, then "and 4 more".
/// Returns the clicked object.
std::optional<Selection> objectLinks(const Scene& scene, const std::vector<int>& ids,
                                     const std::string& name, std::size_t most = 8);

/// Draws the rows of a no-go box inside a form; `edit` receives the operation that renames or moves
/// it.
void noGoRows(const NoGoBox& box, const std::string& name, EditRequest& edit);

/// The entry for the object in the newest edits; null if there is none.
const ObjectChange* findChange(const Edits& edits, const Scene& scene, int id);
/// The pinned point for exactly these objects (ids, in any order); null if there is none.
const PinnedPoint* findPin(const Edits& edits, const Scene& scene, std::vector<int> ids);
bool isRemoved(const Edits& edits, const Scene& scene, std::vector<int> ids);

}  // namespace dollytrack::ui
