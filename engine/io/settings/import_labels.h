#pragma once

#include "engine/core/result.h"
#include "engine/io/settings/import_options.h"
#include "engine/scene/class_table.h"
#include "engine/scene/label_table.h"

#include <memory>

namespace dollytrack {

/// The table of words, and the classes for datasets of the scene.
struct ImportLabels {
    LabelTable words;                           // the built-in words and the user's
    std::shared_ptr<const ClassTable> classes;  // null: NYU40
};

/// Reads the options' label file, if any. Errors as of readLabelFile().
Result<ImportLabels> importLabels(const ImportOptions& options);

/// Only the words of importLabels(), for readers of scene files.
Result<LabelTable> labelsOf(const ImportOptions& options);

}  // namespace dollytrack
