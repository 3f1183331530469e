#pragma once

#include "render/formats/formats.h"

namespace dollytrack::render {

/// preview.mp4: the colour pictures one after the other.
extern const Format kVideoFormat;

}  // namespace dollytrack::render
