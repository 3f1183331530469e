#pragma once

#include "engine/core/result.h"
#include "render/dataset/dataset_contents.h"

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>
#include <vector>

namespace dollytrack::render {

/// A file of a dataset besides its images.
struct DatasetFile {
    std::string path;  // relative to the dataset's folder
    std::string bytes;
};

/// An annotation or pose format; a row of the table from which the command line, the editor's check
/// boxes, the files and dataset.json are derived. A new format is a file with its writer and a row.
struct Format {
    const char* name;  // name on the command line, and key in dataset.json
    const char* text;  // description for users
    bool standard;     // written if no format is named
    unsigned needs;    // bits of FrameNeeds
    // Names it may write, so that they can be removed again: files, and folders of files whose
    // names begin with the frame's six digits.
    std::span<const char* const> files;
    std::span<const char* const> folders;

    /// Writes files after all frames are written. Null: there are none.
    Result<std::vector<DatasetFile>> (*write)(const DatasetContents& contents);
    /// Encodes a frame's own files; called once per frame, on many threads. Null: there are none.
    Result<std::vector<FrameFile>> (*encode)(const FrameContext& context, const FrameRecord& frame);
    /// Description of the files for dataset.json.
    nlohmann::ordered_json (*convention)(const DatasetContents& contents);
    const char* modality = nullptr;  // required modality; null: none
    double bytes_per_pixel = 0.0;    // estimate for a frame's files, on the high side
    bool outlines_things = false;    // gives object positions in the undistorted pictures
};

/// The whole table. dataset.json is always written and not part of it.
[[nodiscard]] std::span<const Format> formats();

/// A selection of the table's rows, in its order.
using FormatSet = std::vector<const Format*>;

/// Selects by name: all for "all", the standard ones if `names` is empty. Returns Usage, suggesting
/// the closest name, for an unknown one.
[[nodiscard]] Result<FormatSet> chooseFormats(const std::vector<std::string>& names);

/// Checks that the formats' required modalities are selected. Returns Usage for the first missing
/// one.
[[nodiscard]] Status checkNeeds(const FormatSet& formats, const ModalitySet& modalities);

}  // namespace dollytrack::render
