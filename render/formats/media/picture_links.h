#pragma once

#include "render/dataset/dataset_contents.h"
#include "render/formats/formats.h"

#include <map>
#include <string>

namespace dollytrack::render {

/// Additional names of a dataset's images, in the layout that readers expect. They are hard links
/// and take no disk space. Maps each new name to the image's own, relative to the dataset folder.
using PictureLinks = std::map<std::string, std::string>;

/// The links of all given formats.
[[nodiscard]] PictureLinks pictureLinks(const DatasetContents& contents, const FormatSet& formats);

}  // namespace dollytrack::render
