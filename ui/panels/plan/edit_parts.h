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

// What the panels that edit share: operations as JSON, names, and rows of widgets.

nlohmann::json pointJson(const Eigen::Vector3d& point);
nlohmann::json turnJson(const Eigen::Quaterniond& rotation);
/// The operation that adds a no-go box; flat ones get a thickness that can be grabbed.
nlohmann::json addNoGoOperation(const OrientedBox& box);

/// "sofa", or "object 12" where it has no name; empty for 0.
std::string objectName(const Scene& scene, int id);
/// "sofa", "sofa and lamp", "sofa and 3 more".
std::string objectNames(const Scene& scene, const std::vector<int>& ids);
/// "hidden by sofa", "touching sofa": why a candidate was not taken, or "legal".
std::string verdictText(Verdict verdict, const std::string& occluder = {});

/// "1.20 × 0.80 × 0.75 m".
std::string sizeText(const Eigen::Vector3d& size);
/// "1.20, 0.80, 0.75".
std::string placeText(const Eigen::Vector3d& place);

/// Names of objects that can be clicked, in lines as wide as there is room; at most so many.
/// Returns what was clicked.
std::optional<Selection> objectLinks(const Scene& scene, const std::vector<int>& ids,
                                     const std::string& name, std::size_t most = 8);

/// "chair", or "unknown" for no class.
std::string className(const Object& object);

/// The rows of a no-go box inside a form; asks for its new name or its move.
void noGoRows(const NoGoBox& box, const std::string& name, EditRequest& edit);

/// The object's change in the newest edits; null when nothing was said of it.
const ObjectChange* findChange(const Edits& edits, const Scene& scene, int id);
/// The pinned point that stands for exactly these objects (ids, in any order).
const PinnedPoint* findPin(const Edits& edits, const Scene& scene, std::vector<int> ids);
bool isRemoved(const Edits& edits, const Scene& scene, std::vector<int> ids);

}  // namespace dollytrack::ui
