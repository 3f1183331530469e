#pragma once

#include "render/formats/formats.h"

namespace dollytrack::render {

/// preview.mp4: the colour images in order.
extern const Format kVideoFormat;

}  // namespace dollytrack::render
