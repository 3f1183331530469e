#pragma once

#include "engine/camera/lens_distortion.h"
#include "render/formats/formats.h"

namespace dollytrack::render {

/// calibration.yaml: the camera as OpenCV's FileStorage, ROS's camera_info and any reader of YAML
/// take it.
extern const Format kCalibrationFormat;

/// Of the pictures that formats name, see DatasetContents::pictureModality().
[[nodiscard]] LensDistortion pictureDistortion(const DatasetContents& contents);

}  // namespace dollytrack::render
