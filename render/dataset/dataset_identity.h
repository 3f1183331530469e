#pragma once

#include "render/dataset/dataset_order.h"
#include "render/dataset/folder/dataset_journal.h"

namespace dollytrack::render {

/// Everything that determines a dataset's bytes.
[[nodiscard]] DatasetIdentity identityOf(const DatasetOrder& order, const DatasetSettings& settings,
                                         const DatasetOrigin& origin);

}  // namespace dollytrack::render
