#pragma once

#include "engine/core/result.h"
#include "engine/document/edits.h"
#include "engine/scene/scene.h"

#include <string>
#include <vector>

namespace dollytrack {

/// Edits that a person wrote with names alone, with the numbers that the objects have in this
/// scene, in the order that edits are kept in. What names no object, or several, is left out and
/// said in `warnings`; of two changes of one object the first stays. Error: as applySceneEdits().
Result<Edits> numberObjects(Edits edits, const Scene& imported, std::vector<std::string>& warnings);

}  // namespace dollytrack
