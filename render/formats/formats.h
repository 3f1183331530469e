#pragma once

#include "engine/core/result.h"
#include "render/dataset/dataset_contents.h"

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>
#include <vector>

namespace dollytrack::render {

/// A file of a dataset beside its images.
struct DatasetFile {
    std::string path;  // relative to the dataset's folder
    std::string bytes;
};

/// A way to say what the images show, for the readers of some field. A row of the one table from
/// which the command line, the editor's check boxes, the files and dataset.json follow; a new
/// format is a file with its writer and a row.
struct Format {
    const char* name;  // as one asks for it, and its key in dataset.json
    const char* text;  // what it is, for people
    bool standard;     // written where none is named
    unsigned needs;    // bits of FrameNeeds
    // What it writes, so that it can be removed again: files beside the images, and folders of
    // files whose names begin with the frame's six digits.
    std::span<const char* const> files;
    std::span<const char* const> folders;

    /// When all frames are written. Null: there is nothing more to say then.
    Result<std::vector<DatasetFile>> (*write)(const DatasetContents& contents);
    /// A frame's own files, made on many threads, once. Null: there are none.
    Result<std::vector<FrameFile>> (*encode)(const FrameContext& context, const FrameRecord& frame);
    /// What dataset.json says of the files.
    nlohmann::ordered_json (*convention)(const DatasetContents& contents);
    const char* modality = nullptr;  // the one without which there is nothing to write
    double bytes_per_pixel = 0.0;    // of a frame's share of its files, on the high side
    bool outlines_things = false;    // says where in the clean pictures things are
};

/// All there are. dataset.json is not among them: it is always written.
[[nodiscard]] std::span<const Format> formats();

/// Some of the table's rows, in its order.
using FormatSet = std::vector<const Format*>;

/// Those named, all for "all", the standard ones when none is. Error: Usage, with the closest name.
[[nodiscard]] Result<FormatSet> chooseFormats(const std::vector<std::string>& names);

/// Whether the modalities are there that the formats need. Error: Usage, naming the first.
[[nodiscard]] Status checkNeeds(const FormatSet& formats, const ModalitySet& modalities);

}  // namespace dollytrack::render
