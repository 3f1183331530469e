#pragma once

#include "render/dataset/contents/format.h"

namespace dollytrack::render {

/// instant-ngp: transforms_ngp.json, scaled so that the room fills the unit cube.
extern const Format kInstantNgpFormat;

}  // namespace dollytrack::render
