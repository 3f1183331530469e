#pragma once

#include "render/dataset/contents/format.h"

namespace dollytrack::render {

/// preview.mp4: the colour images in order.
extern const Format kVideoFormat;

}  // namespace dollytrack::render
