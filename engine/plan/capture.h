#pragma once

#include "engine/scene/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace dollytrack {

/// How one object shows in one frame. Planning fills it by rays, export by pixels.
struct ObjectView {
    int object_id = 0;
    int frame = 0;                  // index in the trajectory
    double visible_fraction = 0.0;  // visible px / px of the whole silhouette drawn alone,
                                    // on an unbounded image
    double visible_px = 0.0;        // as if the image were 640 x 480
    double box_share = 0.0;         // area of the box around the visible px / image area
    double mask_share = 0.0;        // visible px / image area
    double scanned_share = 1.0;     // of a scan: share of the image that shows what was scanned
};

/// When an object counts as captured, and as well captured.
struct CaptureRules {
    double min_visible_fraction = 0.8;
    double min_visible_px = 120.0;
    double min_box_share = 0.05;
    double min_scanned_share = 0.5;  // for well captured
};

[[nodiscard]] bool isCaptured(const ObjectView& view, const CaptureRules& rules = {});
[[nodiscard]] bool isWellCaptured(const ObjectView& view, const CaptureRules& rules = {});

/// The metrics over a set of frames; rates are 0..1. All are over targets.
struct CaptureMetrics {
    int objects = 0;
    int captured = 0;
    int well_captured = 0;
    double capture_rate = 0.0;
    double well_captured_rate = 0.0;
    double small_capture_rate = 0.0;  // of objects under 0.1 m3; 1 when there are none
    double area_share_box = 0.0;      // mean over captured objects, in their best frame
    double area_share_mask = 0.0;
};

/// What is best known of one object. `best` is the frame with the highest visible fraction, then
/// the largest mask; `best_well` the same among the frames that capture it well.
struct ObjectCapture {
    int object_id = 0;
    bool captured = false;
    bool well_captured = false;
    ObjectView best;       // frame -1 when it is never seen
    ObjectView best_well;  // frame -1 when it is never captured well
};

/// One row a target, ordered by id, from all views of all frames in any order.
std::vector<ObjectCapture> bestCaptures(const Scene& scene, const std::vector<ObjectView>& views,
                                        const CaptureRules& rules = {});

/// Whether it counts in small_capture_rate.
[[nodiscard]] bool isSmallTarget(const Object& object);

CaptureMetrics summarize(const Scene& scene, const std::vector<ObjectCapture>& captures);

}  // namespace dollytrack
