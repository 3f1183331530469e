#pragma once

#include "engine/core/result.h"
#include "engine/io/files/guarded_folder.h"
#include "render/dataset/contents/format.h"
#include "render/dataset/contents/modality.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace dollytrack::render {

inline constexpr const char* kCardFile = "dataset.json";

/// File names that an export may use. The journal lists them before the first file is written, so
/// that files of an export can be told from others.
struct DatasetNames {
    int frames = 0;                 // frame files are numbered from 0 to frames - 1
    std::set<std::string> folders;  // with numbered files, and the folder of folds
    std::set<std::string> files;    // other files, by relative path
};

/// `folders`: additional folders of numbered files.
[[nodiscard]] DatasetNames namesOf(const ModalitySet& modalities, const FormatSet& formats,
                                   int frames, const std::vector<std::string>& folders);

[[nodiscard]] nlohmann::json toJson(const DatasetNames& names);
/// Throws nlohmann's exceptions.
[[nodiscard]] DatasetNames datasetNamesFrom(const nlohmann::json& value);

/// Relative paths of existing files with such names and of their temporary files from a killed run
/// (000000.png.tmp.123), dataset.json first. Returns CannotWrite if a folder cannot be read or is a
/// symbolic link.
[[nodiscard]] Result<std::vector<std::string>> filesNamed(const GuardedFolder& folder,
                                                          const DatasetNames& names);

/// Whether the folder has a dataset.json written by Dollytrack; other tools use the same name.
/// Returns CannotWrite if it cannot be read.
[[nodiscard]] Result<bool> hasOurCard(const GuardedFolder& folder);
/// Number of frames in a dataset.json of Dollytrack.
[[nodiscard]] std::size_t framesListed(const GuardedFolder& folder);
/// Relative paths of the files that a dataset.json lists; none if it is damaged. Returns
/// CannotWrite if it cannot be read.
[[nodiscard]] Result<std::set<std::string>> filesListed(const GuardedFolder& folder,
                                                        const std::string& card);

}  // namespace dollytrack::render
