#pragma once

#include "engine/camera/lens_distortion.h"
#include "render/dataset/contents/format.h"

namespace dollytrack::render {

/// calibration.yaml: the camera in a form that OpenCV's FileStorage, ROS's camera_info and generic
/// YAML readers accept.
extern const Format kCalibrationFormat;

/// Distortion of the images that formats refer to; see DatasetContents::pictureModality().
[[nodiscard]] LensDistortion pictureDistortion(const DatasetContents& contents);

}  // namespace dollytrack::render
