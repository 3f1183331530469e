#pragma once

#include "render/dataset/contents/format.h"

#include <span>
#include <string>

namespace dollytrack::render {

/// The text of annotations.json: COCO instances with compressed run lengths. Only targets are
/// annotated; structure (walls, floor, doors) surrounds the camera, so its boxes would be the whole
/// image; it is in instance/ and semantic/. Categories are the scene's classes with their own ids.
/// In NYU40 a target of unknown class becomes "otherprop"; in a custom table a target of class void
/// is not annotated. Image ids are index + 1, because readers take 0 for "none". There are no
/// `attributes`, because they need amodal masks.
[[nodiscard]] std::string cocoText(const DatasetContents& contents);
/// The same for some frames only; image ids do not change.
[[nodiscard]] std::string cocoText(const DatasetContents& contents, std::span<const int> frames);

/// The same with polygons instead of run lengths, for readers that support only these. COCO
/// polygons have no holes: holes are filled, while `area` and `bbox` stay those of the mask. Each
/// annotation has `attributes`: the object's visible share and its occluder.
[[nodiscard]] std::string cocoPolygonsText(const DatasetContents& contents);

/// annotations.json, see cocoText().
extern const Format kCocoFormat;
/// annotations_polygons.json, see cocoPolygonsText().
extern const Format kCocoPolygonsFormat;

}  // namespace dollytrack::render
