#pragma once

#include "render/dataset/contents/dataset_contents.h"
#include "render/dataset/contents/format.h"

#include <nlohmann/json_fwd.hpp>

#include <string_view>
#include <vector>

namespace dollytrack::render {

inline constexpr const char* kFoldFolder = "folds";

/// Image lists of each fold (folds/fold_0_train.txt, fold_0_val.txt, ...) and, if the dataset has
/// the format `coco`, their annotations (.json).
[[nodiscard]] Result<std::vector<DatasetFile>> foldFiles(const DatasetContents& contents,
                                                         const FormatSet& formats);

/// Description of the folds for dataset.json.
[[nodiscard]] nlohmann::ordered_json foldConvention(const DatasetContents& contents);

/// Whether a name in the folder of folds belongs to such a file or to its temporary file.
[[nodiscard]] bool isFoldFile(std::string_view name);

}  // namespace dollytrack::render
