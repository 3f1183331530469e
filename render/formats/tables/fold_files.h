#pragma once

#include "render/dataset/dataset_contents.h"
#include "render/formats/formats.h"

#include <nlohmann/json_fwd.hpp>

#include <string_view>
#include <vector>

namespace dollytrack::render {

inline constexpr const char* kFoldFolder = "folds";

/// The lists of pictures of each fold, folds/fold_0_train.txt and fold_0_val.txt ..., and their
/// annotations beside them (.json) where the dataset has `coco`.
[[nodiscard]] Result<std::vector<DatasetFile>> foldFiles(const DatasetContents& contents,
                                                         const FormatSet& formats);

/// What dataset.json says of them.
[[nodiscard]] nlohmann::ordered_json foldConvention(const DatasetContents& contents);

/// Whether a file in the folder of folds is one of these, or what a killed run left of one.
[[nodiscard]] bool isFoldFile(std::string_view name);

}  // namespace dollytrack::render
