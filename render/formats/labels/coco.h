#pragma once

#include "render/dataset/dataset_contents.h"

#include <span>
#include <string>

namespace dollytrack::render {

/// The text of annotations.json: COCO instances with compressed run lengths. Annotated are targets:
/// they are what a detector is to find. Structure (walls, floor, doors ...) surrounds the camera,
/// its boxes would be the whole image; it is in instance/ and semantic/. Categories are the
/// scene's classes under their own ids: of NYU40, where a target of unknown class counts as
/// "otherprop", or of a table of one's own, where a target of class void is not annotated. An image
/// id is index + 1: readers take 0 for "none". No `attributes`: they need whole masks.
[[nodiscard]] std::string cocoText(const DatasetContents& contents);
/// Of some frames alone; image ids stay theirs.
[[nodiscard]] std::string cocoText(const DatasetContents& contents, std::span<const int> frames);

/// The same with outlines instead of run lengths, for readers that know no others. COCO's outlines
/// have no holes: where a mask has some they are filled, `area` and `bbox` stay the mask's. Each
/// annotation has `attributes`: how much of the object is in sight, and what hides it.
[[nodiscard]] std::string cocoPolygonsText(const DatasetContents& contents);

}  // namespace dollytrack::render
