#pragma once

#include "engine/core/result.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace dollytrack::gather {

/// What marks a gathered dataset, and says what it is.
inline constexpr const char* kGatherCard = "gather.json";

/// A dataset's folder, whether the dataset in it is complete or not.
struct FoundDataset {
    std::filesystem::path folder;
    std::string name;  // unique, also where case does not count
};

/// The arguments without those that name files, if another one names a folder; warns of each, with
/// the subsystem's name. A shell's `datasets/*` includes the pages that lie beside datasets.
[[nodiscard]] std::vector<std::string> withoutFilesBesideFolders(std::vector<std::string> arguments,
                                                                 std::string_view subsystem);

/// The datasets that arguments name, in natural order and each once: a dataset's folder, one of
/// rooms, that of a batch, a folder around any of these, or a pattern of such folders with `*` and
/// `?`. Rooms and jobs without a dataset are among them. Hidden folders, gathered datasets and
/// files beside folders are passed by. Error: BadInput where an argument leads to no dataset.
[[nodiscard]] Result<std::vector<FoundDataset>> findDatasets(
    const std::vector<std::string>& arguments);

}  // namespace dollytrack::gather
