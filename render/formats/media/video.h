#pragma once

#include "render/dataset/contents/format.h"

namespace dollytrack::render {

/// Lowest rate of the preview, images per second. A slower trajectory is shown at this rate.
inline constexpr double kSlowestVideo = 0.01;
inline constexpr double kFastestVideo = 1000.0;

/// preview.mp4: the colour images in order.
extern const Format kVideoFormat;

}  // namespace dollytrack::render
