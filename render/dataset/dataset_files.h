#pragma once

#include "engine/core/result.h"
#include "engine/io/files/guarded_folder.h"
#include "render/dataset/contents/dataset_contents.h"
#include "render/formats/tables/dataset_card.h"

#include <string>

namespace dollytrack::render {

/// Writes the dataset's files besides its images: the formats' files, the contact sheet with this
/// title and, after all others are synced to disk, dataset.json. `card` must contain the images'
/// hashes.
[[nodiscard]] Status writeDatasetFiles(const GuardedFolder& folder, const DatasetContents& contents,
                                       DatasetCard card, const std::string& title);

}  // namespace dollytrack::render
