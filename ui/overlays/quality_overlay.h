#pragma once

#include "engine/plan/frame_quality.h"
#include "engine/plan/plan.h"
#include "render/pictures/picture_quality.h"
#include "ui/overlays/legend.h"

#include <memory>
#include <string>
#include <vector>

namespace dollytrack::ui {

/// Which weaknesses of the frames are drawn.
struct QualityOverlayOptions {
    bool untrackable = true;     // frames with too few image corners
    bool wide_gaps = true;       // too little overlap with the frame before
    bool unusable = true;        // dark, white or flat images
    bool unseen_surface = true;  // surface that no frame shows; see surfaceLayer()
    bool operator==(const QualityOverlayOptions&) const = default;
};

/// The class of each frame's image; empty or null: not known.
using PictureClasses = std::shared_ptr<const std::vector<render::PictureQuality>>;

/// Stretches of the trajectory that SLAM and reconstruction programs can hardly use, over the
/// trajectory's line: frames with few image corners, gaps between consecutive frames, and frames
/// without content. Empty if `quality` belongs to another trajectory.
[[nodiscard]] PlanLayer qualityLayer(const Plan& plan, const FrameQuality& quality,
                                     const PictureClasses& pictures,
                                     const QualityOverlayOptions& options);

/// A frame's measurements as lines of text, with the thresholds: "57 image corners, 150 needed".
[[nodiscard]] std::string qualityText(const Plan& plan, const FrameQuality& quality,
                                      const PictureClasses& pictures, int frame);

}  // namespace dollytrack::ui
