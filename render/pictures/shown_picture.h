#pragma once

#include "engine/io/files/guarded_folder.h"
#include "engine/scene/class_table.h"

#include <opencv2/core.hpp>

#include <string>
#include <string_view>

namespace dollytrack::render {

/// An image of a dataset, read unchanged, as people look at it: 8-bit RGB. Depth becomes grey (near
/// is bright, nothing is black), ids and classes become colours.
[[nodiscard]] cv::Mat shownPicture(const cv::Mat& image, std::string_view modality,
                                   const ClassTable& classes);

/// The same of a file in a dataset's folder, scaled to a width. Labels are not blended into other
/// labels. Empty when the file is gone or damaged.
[[nodiscard]] cv::Mat readShownPicture(const GuardedFolder& folder, const std::string& file,
                                       std::string_view modality, const ClassTable& classes,
                                       int width_px);

}  // namespace dollytrack::render
