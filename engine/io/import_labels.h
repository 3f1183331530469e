#pragma once

#include "engine/core/result.h"
#include "engine/io/scene_import.h"
#include "engine/scene/label_table.h"

namespace dollytrack {

/// The built-in label tables with the lines of the user's own. Errors: those of that file.
Result<LabelTable> labelsOf(const ImportOptions& options);

}  // namespace dollytrack
