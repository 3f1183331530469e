#pragma once

#include "render/dataset/contents/format.h"

namespace dollytrack::render {

/// The links of all given formats.
[[nodiscard]] PictureLinks pictureLinks(const DatasetContents& contents, const FormatSet& formats);

}  // namespace dollytrack::render
