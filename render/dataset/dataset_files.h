#pragma once

#include "engine/core/result.h"
#include "engine/io/files/guarded_folder.h"
#include "render/dataset/dataset_contents.h"
#include "render/formats/tables/dataset_card.h"

#include <string>

namespace dollytrack::render {

/// Writes what a dataset holds beside its images: the formats' files, the contact sheet under this
/// title, and dataset.json when all the others are on the disk. `card` has the images' hashes.
[[nodiscard]] Status writeDatasetFiles(const io::GuardedFolder& folder,
                                       const DatasetContents& contents, DatasetCard card,
                                       const std::string& title);

}  // namespace dollytrack::render
