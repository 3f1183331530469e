#pragma once

#include "render/dataset_contents.h"

#include <string>

namespace dollytrack::render {

/// The text of annotations.json: COCO instances with compressed run lengths. Annotated are targets:
/// they are what a detector is to find. Structure (walls, floor, doors ...) surrounds the camera,
/// its boxes would be the whole image; it is in instance/ and semantic/. Categories are all of
/// NYU40 under their own numbers; a target of unknown class counts as "otherprop". An
/// image id is index + 1: readers take 0 for "none".
[[nodiscard]] std::string cocoText(const DatasetContents& contents);

}  // namespace dollytrack::render
