#pragma once

#include "render/formats/media/picture_links.h"

namespace dollytrack::render {

/// The layout of EuRoC's micro aerial vehicle data set (ASL): a folder mav0 with a folder for each
/// sensor. The body is the left camera; the inertial sensor is there, too.
extern const Format kEurocFormat;

/// Pictures under the names of their times, mav0/cam0/data/100000000.png.
[[nodiscard]] PictureLinks eurocPictures(const DatasetContents& contents);

}  // namespace dollytrack::render
