#pragma once

#include "render/verify/compare/finding.h"
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
    nlohmann::json attributes;  // null if missing
};

/// Annotations by frame of the dataset.
using CocoByFrame = std::vector<std::vector<CocoAnnotation>>;

/// Reads a COCO file that should list these frames and checks what can be checked without images:
/// numbers, names and references. Returns nothing and adds a finding if it is no COCO file.
std::optional<CocoByFrame> readCoco(const StoredDataset& dataset, const std::string& file,
                                    std::span<const int> frames, Findings& findings);

/// Checks one segmentation.
using CompareMask = std::function<void(const CocoAnnotation& one, const Image16& ids, int frame,
                                       Findings& findings)>;

/// Compares one frame's annotations with its id image.
void compareCoco(const StoredDataset& dataset, const std::string& file,
                 const std::vector<CocoAnnotation>& annotations, FrameImages& images,
                 const CompareMask& compare_mask, Findings& findings);

}  // namespace dollytrack::verify
