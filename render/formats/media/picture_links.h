#pragma once

#include "render/dataset/dataset_contents.h"
#include "render/formats/formats.h"

#include <map>
#include <string>

namespace dollytrack::render {

/// Further names of a dataset's pictures, where readers look for them: hard links, which take no
/// room on the disk. Paths relative to the dataset's folder: the new name, and the picture's own.
using PictureLinks = std::map<std::string, std::string>;

/// The links of all given formats.
[[nodiscard]] PictureLinks pictureLinks(const DatasetContents& contents, const FormatSet& formats);

}  // namespace dollytrack::render
