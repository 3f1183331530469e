#pragma once

#include "render/frames/frame_record.h"
#include "ui/viewport/render_thread.h"

#include <cstdint>
#include <vector>

namespace dollytrack::ui {

/// A modality of a frame as an RGBA image for display, 4 bytes per pixel: depth from near (bright,
/// warm) to far (dark, cool), distinct colours for ids and classes, surface normals in the camera
/// frame computed from depth. Black where no surface was hit.
[[nodiscard]] std::vector<std::uint8_t> falseColor(const render::FrameRecord& record,
                                                   const render::View& view, Modality modality);

/// The sRGB colour of an id or a class; consecutive numbers get clearly different colours.
[[nodiscard]] Eigen::Vector3f colorOfId(int id);

}  // namespace dollytrack::ui
