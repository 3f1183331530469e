#pragma once

#include "engine/core/result.h"
#include "engine/io/import/scene_import.h"
#include "engine/scene/class_table.h"
#include "engine/scene/label_table.h"

#include <memory>

namespace dollytrack {

/// What names mean, and the classes that a dataset of the scene is written with.
struct ImportLabels {
    LabelTable words;                           // the built-in ones, then the user's own
    std::shared_ptr<const ClassTable> classes;  // null: NYU40
};

/// By the options' label file, if there is one. Errors: those of that file.
Result<ImportLabels> importLabels(const ImportOptions& options);

/// The table of words of importLabels(), for readers of scene files, which need no classes.
Result<LabelTable> labelsOf(const ImportOptions& options);

}  // namespace dollytrack
