#pragma once

#include "engine/geometry/ray_caster.h"
#include "render/frame_context.h"
#include "render/frame_record.h"
#include "render/view.h"

#include <cstdint>
#include <span>
#include <vector>

namespace dollytrack::render {

/// A pixel that was drawn to show nothing, though the ray through its centre meets a surface.
/// Drawing rounds corners; where surfaces meet without sharing them (walls that stand on a floor)
/// it leaves gaps of a pixel between the two.
struct CrackPixel {
    std::size_t pixel = 0;
    std::size_t like = 0;  // the neighbour whose colours it takes: of the same object, if one is
    RayHit hit;            // distance: planar depth, m
};

/// Looks at pixels without a label most of whose neighbours have one; 0 is none. `rays` are of the
/// scene as it is in the frame.
[[nodiscard]] std::vector<CrackPixel> findCracks(const View& view,
                                                 std::span<const std::uint16_t> labels,
                                                 const RayCaster& rays);

/// Gives the pixels what their rays meet, in every image of the left camera that the record has.
void fillCracks(std::span<const CrackPixel> cracks, const FrameContext& context, const View& view,
                FrameRecord& record);

/// The same in a picture alone, 3 bytes a pixel.
void fillCrackColours(std::span<const CrackPixel> cracks, std::vector<std::uint8_t>& rgb);

/// Depth of pixels that stand alone with theirs, asked of rays again: along the rim of what is seen
/// along itself, drawing carries a plane's depth on beyond its end. `labels` say which object the
/// ray has to meet; empty where any will do.
void mendDepths(const View& view, std::span<const std::uint16_t> labels, const RayCaster& rays,
                std::vector<float>& depth_m);

/// Both in the right camera's images, which have no labels.
void fillRightCracks(const FrameContext& context, const View& right, FrameRecord& record);

}  // namespace dollytrack::render
