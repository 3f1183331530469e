#pragma once

#include "engine/core/result.h"
#include "engine/document/edits.h"
#include "engine/scene/scene.h"

#include <string>
#include <vector>

namespace dollytrack {

/// Completes edits that were written with names only: fills in the object numbers of this scene and
/// sorts the edits as they are stored. An edit whose name fits no object, or several, is left out
/// with a warning. Of two changes of one object the first is kept. Errors: as applySceneEdits().
Result<Edits> numberObjects(Edits edits, const Scene& imported, std::vector<std::string>& warnings);

}  // namespace dollytrack
