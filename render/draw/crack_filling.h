#pragma once

#include "engine/geometry/ray_caster.h"
#include "render/draw/view.h"
#include "render/frames/frame_context.h"
#include "render/frames/frame_record.h"

#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack::render {

/// A pixel of which drawing does not tell what its centre sees, and what a ray through it meets.
/// Drawing rounds corners: where surfaces meet without sharing them (walls that stand on a floor)
/// it leaves gaps of a pixel between the two, and of a surface seen along itself it extrapolates
/// depth by metres.
struct CrackPixel {
    std::size_t pixel = 0;
    bool drawn = false;           // it shows a surface, of unknown depth
    std::size_t like = 0;         // the pixel whose colours it takes: of the same object, if one is
    std::uint16_t object_id = 0;  // what it shows; 0: nothing
    RayHit hit;                   // distance: planar depth, m
};

/// Gaps: pixels without a label most of whose neighbours have one; 0 is none. `rays` are of the
/// scene as it is in the frame.
[[nodiscard]] std::vector<CrackPixel> findCracks(const View& view,
                                                 std::span<const std::uint16_t> labels,
                                                 const RayCaster& rays);

/// The same and those of unknown depth, as RenderTarget::readDrawnDepth() marks them.
[[nodiscard]] std::vector<CrackPixel> findCracks(const View& view,
                                                 std::span<const std::uint16_t> labels,
                                                 std::span<const float> drawn_depth_m,
                                                 const RayCaster& rays);

/// Gives the pixels what their rays meet, in every image of the left camera that the record has.
void fillCracks(std::span<const CrackPixel> cracks, const FrameContext& context, const View& view,
                FrameRecord& record);

/// The same in a picture alone, 3 bytes a pixel.
void fillCrackColours(std::span<const CrackPixel> cracks, std::vector<std::uint8_t>& rgb);

/// Both in the right camera's images, which have no labels. Its depth is as it was drawn.
void fillRightCracks(const FrameContext& context, const View& right, FrameRecord& record);

}  // namespace dollytrack::render
