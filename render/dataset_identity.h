#pragma once

#include "render/dataset_contents.h"
#include "render/dataset_job.h"
#include "render/dataset_journal.h"
#include "render/formats/dataset_card.h"

namespace dollytrack::render {

/// All that decides over a dataset's bytes. `contents` and `card` need not know yet what the
/// pictures show.
[[nodiscard]] DatasetIdentity identityOf(const DatasetContents& contents, const DatasetCard& card,
                                         const DatasetSettings& settings,
                                         const DatasetOrigin& origin);

}  // namespace dollytrack::render
