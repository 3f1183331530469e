#pragma once

namespace dollytrack::render {

/// What of a frame has to be drawn, for its files to be made; ids always are. Bits.
enum FrameNeeds : unsigned {
    kNeedsRgb = 1U << 0U,
    kNeedsDepth = 1U << 1U,
    kNeedsSurfaces = 1U << 2U,     // normals and albedo
    kNeedsRight = 1U << 3U,        // the right picture of the stereo pair and its depth
    kNeedsWhole = 1U << 4U,        // each object as if nothing stood before it
    kNeedsSensorLight = 1U << 6U,  // what falls into a real camera's lens
    kNeedsMasks = 1U << 5U,        // the visible masks, kept until the last frame is drawn
    kNeedsRig = 1U << 12U,         // the colour pictures of the rig's cameras
};

}  // namespace dollytrack::render
