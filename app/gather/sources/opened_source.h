#pragma once

#include "app/gather/sources/class_union.h"
#include "app/gather/sources/source.h"
#include "engine/core/result.h"
#include "render/verify/read/stored_dataset.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace dollytrack::gather {

/// A box and mask of annotations.json.
struct Annotation {
    std::size_t class_index = 0;  // in the gathered classes
    int object_id = 0;            // in the instance image
    std::array<int, 4> box = {};  // x, y, width, height, px
    long area = 0;                // px
    std::string segmentation;     // JSON, COCO's compressed run lengths
};

/// A dataset while its frames are written.
struct OpenedSource {
    const Source& source;
    verify::StoredDataset dataset;
    std::vector<std::vector<Annotation>> annotations;  // of each frame

    /// "kitchen_000012": what the frame is called in the gathered dataset.
    [[nodiscard]] std::string frameName(std::size_t frame) const;
    /// A file that dataset.json lists.
    [[nodiscard]] SourceFile file(const std::string& name) const;
    /// The names of the frame's files in a folder, which begin with its six digits; in order.
    [[nodiscard]] std::vector<std::string> filesOf(const std::string& folder,
                                                   std::size_t frame) const;
};

/// Reads dataset.json. Error: BadInput where it is damaged, or has changed since the dataset was
/// looked at.
[[nodiscard]] Result<verify::StoredDataset> readDescription(const Source& source);

/// Removes the parts of dataset.json that only few layouts need, because they need much memory.
void keepConventionsOnly(verify::StoredDataset& dataset);

/// Reads annotations.json, and dataset.json unless it is kept. Error: BadInput where a file is
/// damaged, or has changed since the dataset was looked at.
[[nodiscard]] Result<OpenedSource> openSource(const Source& source, const ClassUnion& classes);

}  // namespace dollytrack::gather
