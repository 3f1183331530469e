#pragma once

#include "engine/scene/scene.h"
#include "render/formats/mask_rle.h"

#include <string>
#include <vector>

namespace dollytrack::render {

/// What COCO needs of one frame.
struct CocoFrame {
    int index = 0;          // image id is index + 1: readers take 0 for "none"
    std::string file_name;  // "rgb/000000.png"
    std::vector<ObjectMask> masks;
};

/// The text of annotations.json: COCO instances with compressed run lengths. Annotated are targets:
/// they are what a detector is to find. Structure (walls, floor, doors ...) surrounds the camera,
/// its boxes would be the whole image; it is in instance/ and semantic/. Categories are all of
/// NYU40 under their own numbers; a target of unknown class counts as "otherprop".
[[nodiscard]] std::string cocoText(const Scene& scene, int width, int height,
                                   const std::vector<CocoFrame>& frames);

}  // namespace dollytrack::render
