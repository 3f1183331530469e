#pragma once

#include "engine/core/result.h"
#include "engine/geometry/ray_caster.h"
#include "engine/jobs/job.h"
#include "engine/scene/scene.h"
#include "render/gl/context.h"
#include "render/overlays/overlay.h"
#include "render/view/view.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace dollytrack::render {

/// Viewpoint and size of an overview image of the whole scene.
struct OverviewSettings {
    int width_px = 1600;
    int height_px = 1000;
    double azimuth_deg = 248.0;   // direction from the building to the viewer, from +x towards +y
    double elevation_deg = 48.0;  // above the horizon
    double hfov_deg = 30.0;
    int supersampling = 2;  // rendered this many times larger in width and height, then averaged
    int storey = 0;         // storey to show, 1: the lowest; 0: the topmost
};

/// An sRGB image, 3 bytes per pixel, row 0 at the top.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;
};

/// An oblique view from above that shows the whole building. Ceilings, large outdoor structure, the
/// near walls and everything above the chosen storey are left out.
[[nodiscard]] View overviewOf(const Scene& scene, const OverviewSettings& settings = {},
                              std::span<const Eigen::AlignedBox3d> rooms = {});

/// Renders the overview with an overlay. The rooms are lit as by makeLightRig(), which takes most
/// of the time of `job`. Returns the renderer's errors (NoOpenGl, Usage for sizes beyond the
/// driver's limit, Failed) and Cancelled.
[[nodiscard]] Result<Picture> renderOverview(std::unique_ptr<gl::Context> context,
                                             const Scene& scene, const RayCaster& rays,
                                             const Overlay& overlay,
                                             const OverviewSettings& settings = {},
                                             std::span<const Eigen::AlignedBox3d> rooms = {},
                                             const JobContext& job = {});

}  // namespace dollytrack::render
