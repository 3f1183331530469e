#pragma once

#include "engine/core/result.h"
#include "engine/io/files/guarded_folder.h"
#include "render/dataset/modalities.h"
#include "render/formats/formats.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace dollytrack::render {

inline constexpr const char* kCardFile = "dataset.json";

/// The names that an export may give to files. Its journal lists them before the first is written,
/// so that what it left can be told from other files.
struct DatasetNames {
    int frames = 0;                 // files of frames are numbered from 0 to below this
    std::set<std::string> folders;  // of numbered files, and `folds`
    std::set<std::string> files;    // the others, by relative path
};

/// `folders`: more folders of numbered files.
[[nodiscard]] DatasetNames namesOf(const ModalitySet& modalities, const FormatSet& formats,
                                   int frames, const std::vector<std::string>& folders);

[[nodiscard]] nlohmann::json toJson(const DatasetNames& names);
/// Throws nlohmann's exceptions.
[[nodiscard]] DatasetNames datasetNamesFrom(const nlohmann::json& value);

/// Relative paths of the files in a folder that have such names, and of what a killed run left of
/// them (000000.png.tmp.123), dataset.json first. Error: CannotWrite, also for a link in the way.
[[nodiscard]] Result<std::vector<std::string>> filesNamed(const io::GuardedFolder& folder,
                                                          const DatasetNames& names);

/// Many datasets have a dataset.json; ours says so in it. Error: CannotWrite when it is there and
/// cannot be read.
[[nodiscard]] Result<bool> hasOurCard(const io::GuardedFolder& folder);
/// How many frames a dataset.json of ours lists.
[[nodiscard]] std::size_t framesListed(const io::GuardedFolder& folder);
/// The files beside itself that a dataset.json lists, by relative path; none where it is damaged.
/// Error: CannotWrite when it cannot be read.
[[nodiscard]] Result<std::set<std::string>> filesListed(const io::GuardedFolder& folder,
                                                        const std::string& card);

}  // namespace dollytrack::render
