#pragma once

#include "render/frames/frame_record.h"
#include "ui/viewport/render_thread.h"

#include <cstdint>
#include <vector>

namespace dollytrack::ui {

/// A modality of a frame as a picture for people, 4 bytes a pixel: depth from near (bright, warm)
/// to far (dark, cool), ids and classes in colours of their own, normals of the surface in the
/// camera's frame computed from depth. Black where nothing was hit.
[[nodiscard]] std::vector<std::uint8_t> falseColor(const render::FrameRecord& record,
                                                   const render::View& view, Modality modality);

/// The colour that stands for an id or a class, sRGB; neighbours in number differ clearly.
[[nodiscard]] Eigen::Vector3f colorOfId(int id);

}  // namespace dollytrack::ui
