#pragma once

#include "engine/camera/picture_params.h"

#include <string>
#include <vector>

namespace dollytrack::ui {

/// The widgets of how colour pictures are made, in one row: the mode, and what belongs to it.
void drawPictureFields(PictureParams& params);

/// "antialias=8x": the fields that belong to the mode and are not as by default, for --picture.
[[nodiscard]] std::vector<std::string> pictureSettings(PictureParams params);

}  // namespace dollytrack::ui
