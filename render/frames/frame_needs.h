#pragma once

namespace dollytrack::render {

/// Bits for what must be drawn of a frame so that its files can be made; ids are always drawn.
enum FrameNeeds : unsigned {
    kNeedsRgb = 1U << 0U,
    kNeedsDepth = 1U << 1U,
    kNeedsSurfaces = 1U << 2U,     // normals and albedo
    kNeedsRight = 1U << 3U,        // image and depth of the stereo pair's right camera
    kNeedsWhole = 1U << 4U,        // amodal masks of all visible objects
    kNeedsSensorLight = 1U << 6U,  // light that reaches a real camera's lens
    kNeedsMasks = 1U << 5U,        // visible masks, kept until the last frame is drawn
    kNeedsRig = 1U << 12U,         // colour images of the rig's cameras
    kNeedsLayers = 1U << 13U,      // light by layer; only path-traced images have it
};

/// Needs whose images show light, which takes long to prepare.
inline constexpr unsigned kNeedsLight =
    kNeedsRgb | kNeedsLayers | kNeedsRight | kNeedsRig | kNeedsSensorLight;

}  // namespace dollytrack::render
