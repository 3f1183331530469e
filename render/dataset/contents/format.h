#pragma once

#include "engine/core/result.h"
#include "render/dataset/contents/content_group.h"
#include "render/dataset/contents/dataset_contents.h"

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <span>
#include <string>
#include <vector>

namespace dollytrack::render {

/// A file of a dataset besides its images.
struct DatasetFile {
    std::string path;  // relative to the dataset's folder
    std::string bytes;
};

/// An annotation or pose format; a row of the table in formats/formats.h, from which the command
/// line, the editor's check boxes, the files and dataset.json are derived. A new format is a file
/// with its writer and a row.
struct Format {
    const char* name;  // its name in options, and its key in dataset.json
    const char* text;  // one line for people
    ContentGroup group;
    bool standard = false;  // written if no format is named
    unsigned needs = 0;     // bits of FrameNeeds
    // What it writes, so that it can be removed again: files beside the images, and folders of
    // files whose names begin with the frame's six digits.
    std::span<const char* const> files = {};
    std::span<const char* const> folders = {};

    /// Writes the files that need all frames. Null: the format has none.
    Result<std::vector<DatasetFile>> (*write)(const DatasetContents& contents) = nullptr;
    /// Makes the files of one frame; called for each frame, on many threads. Null: the format has
    /// none.
    Result<std::vector<FrameFile>> (*encode)(const FrameContext& context,
                                             const FrameRecord& frame) = nullptr;
    /// What dataset.json says of the files.
    nlohmann::ordered_json (*convention)(const DatasetContents& contents) = nullptr;
    const char* modality = nullptr;  // the one without which there is nothing to write
    double bytes_per_pixel = 0.0;    // of a frame's share of its files, on the high side
    /// Returns a sentence if a library that the format needs is not installed, else null.
    const char* (*missing)() = nullptr;
    bool outlines_things = false;  // its files have boxes or outlines in the undistorted images
};

/// A selection of formats, in the order of the table.
using FormatSet = std::vector<const Format*>;

/// Additional names of a dataset's images, in the layout that readers expect. They are hard links
/// and take no disk space. Maps each new name to the image's own, relative to the dataset folder.
using PictureLinks = std::map<std::string, std::string>;

}  // namespace dollytrack::render
