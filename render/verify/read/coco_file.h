#pragma once

#include "render/verify/finding.h"
#include "render/verify/read/frame_images.h"

#include <nlohmann/json.hpp>

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace dollytrack::verify {

struct CocoAnnotation {
    int id = 0;
    int category = 0;
    int object_id = 0;
    double area = 0.0;
    std::array<double, 4> box = {};  // x, y, width, height, px
    nlohmann::json segmentation;
    nlohmann::json attributes;  // null where there are none
};

/// The annotations of each frame of the dataset.
using CocoByFrame = std::vector<std::vector<CocoAnnotation>>;

/// Reads a COCO file that should list these frames, and finds what can be said without the images:
/// numbers and names, and that all refer to what there is. Nothing, and a finding, when it is no
/// such file.
std::optional<CocoByFrame> readCoco(const StoredDataset& dataset, const std::string& file,
                                    std::span<const int> frames, Findings& findings);

/// Finds what is wrong with one segmentation.
using CompareMask = std::function<void(const CocoAnnotation& one, const Image16& ids, int frame,
                                       Findings& findings)>;

/// The annotations of one frame against what its id image shows.
void compareCoco(const StoredDataset& dataset, const std::string& file,
                 const std::vector<CocoAnnotation>& annotations, FrameImages& images,
                 const CompareMask& compare_mask, Findings& findings);

}  // namespace dollytrack::verify
