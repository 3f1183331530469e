#pragma once

#include "render/dataset/contents/format.h"

namespace dollytrack::render {

/// The layout of the EuRoC micro aerial vehicle data set (ASL): a folder mav0 with one folder per
/// sensor. The body frame is the left camera's, and so is the inertial sensor's.
extern const Format kEurocFormat;

/// Links to the images, named by time: mav0/cam0/data/100000000.png.
[[nodiscard]] PictureLinks eurocPictures(const DatasetContents& contents);

}  // namespace dollytrack::render
