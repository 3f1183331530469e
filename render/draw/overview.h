#pragma once

#include "engine/core/result.h"
#include "engine/geometry/ray_caster.h"
#include "engine/scene/scene.h"
#include "render/draw/view.h"
#include "render/gl/context.h"
#include "render/overlays/overlay.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace dollytrack::render {

/// How a scene is looked at as a whole. Plain data.
struct OverviewSettings {
    int width_px = 1600;
    int height_px = 1000;
    double azimuth_deg = 248.0;   // where the viewer stands, from +x towards +y
    double elevation_deg = 48.0;  // above the horizon
    double hfov_deg = 30.0;
    int supersampling = 2;  // drawn this many times larger each way
    int storey = 0;         // that is looked into, 1 the lowest; 0: the topmost
};

/// 3 bytes a pixel, sRGB, rows from the top.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;
};

/// A view from above at an angle that holds the whole building, with the ceilings, everything far
/// outside and the near walls left away.
/// What lies over the storey is left away, too.
[[nodiscard]] View overviewOf(const Scene& scene, const OverviewSettings& settings = {},
                              std::span<const Eigen::AlignedBox3d> rooms = {});

/// The lit scene from outside with an overlay. `rooms` are lit as by makeLightRig().
[[nodiscard]] Result<Picture> renderOverview(std::unique_ptr<gl::Context> context,
                                             const Scene& scene, const RayCaster& rays,
                                             const Overlay& overlay,
                                             const OverviewSettings& settings = {},
                                             std::span<const Eigen::AlignedBox3d> rooms = {});

}  // namespace dollytrack::render
