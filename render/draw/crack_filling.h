#pragma once

#include "engine/geometry/ray_caster.h"
#include "render/frames/frame_record.h"
#include "render/scene/moving_objects.h"
#include "render/view/view.h"

#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack::render {

/// A pixel whose content rasterisation cannot determine, with the ray-cast result for its centre.
/// Rasterisation rounds vertex positions: it leaves one-pixel gaps where surfaces meet without
/// sharing vertices (walls standing on a floor), on surfaces seen edge-on it extrapolates depth
/// by metres, and the thin triangles along an object's outline get depths millimetres off.
struct CrackPixel {
    std::size_t pixel = 0;
    bool drawn = false;           // the rasteriser drew a surface here, but its depth is unreliable
    std::size_t like = 0;         // pixel whose colour is copied: a neighbour of the same object if
                                  // there is one
    std::uint16_t object_id = 0;  // id after filling; 0: nothing is hit
    RayHit hit;                   // its distance is planar depth, m
};

/// Finds gap pixels: pixels without a label (0) that a ray hits and most of whose neighbours have a
/// label. `rays` must cast against the scene as it stands in this frame.
[[nodiscard]] std::vector<CrackPixel> findCracks(const View& view,
                                                 std::span<const std::uint16_t> labels,
                                                 const RayCaster& rays);

/// Finds gap pixels, the pixels that RenderTarget::readDrawnDepth() marks as unreliable, those
/// beside outlines (where the label changes, or the depth by more than 2 %), and those that lie on
/// neither of the planes extrapolated from the pixels on either side along the row or the column:
/// through a gap, another surface of the same object may show a few millimetres behind.
[[nodiscard]] std::vector<CrackPixel> findCracks(const View& view,
                                                 std::span<const std::uint16_t> labels,
                                                 std::span<const float> drawn_depth_m,
                                                 const RayCaster& rays);

/// Writes the ray-cast results into every image of the left camera that the record holds.
void fillCracks(std::span<const CrackPixel> cracks, const Scene& scene, const MovingObjects& moving,
                const View& view, FrameRecord& record);

/// Fills only the colours of an image, 3 bytes per pixel.
void fillCrackColours(std::span<const CrackPixel> cracks, std::vector<std::uint8_t>& rgb);

/// Finds and fills crack pixels in the right camera's depth and colour. The right camera has no
/// labels; `record.depth_right_m` must hold the depth as drawn, with its marks.
void fillRightCracks(const MovingObjects& moving, const View& right, FrameRecord& record);

}  // namespace dollytrack::render
