#include "engine/plan/capture.h"

#include <algorithm>
#include <tuple>

namespace dollytrack {
namespace {

constexpr double kSmallVolume = 0.1;  // m3; the paper's small objects

/// Compares views by visible fraction, then by the object's share of the image; the earlier frame
/// wins ties.
bool isBetter(const ObjectView& a, const ObjectView& b) {
    if (b.frame < 0) return true;
    return std::tuple(a.visible_fraction, a.mask_share, -a.frame) >
           std::tuple(b.visible_fraction, b.mask_share, -b.frame);
}

}  // namespace

bool isCaptured(const ObjectView& view, const CaptureRules& rules) {
    return view.visible_fraction >= rules.min_visible_fraction &&
           view.visible_px >= rules.min_visible_px;
}

bool isWellCaptured(const ObjectView& view, const CaptureRules& rules) {
    return isCaptured(view, rules) && view.box_share >= rules.min_box_share &&
           view.scanned_share >= rules.min_scanned_share;
}

std::vector<ObjectCapture> bestCaptures(const Scene& scene, const std::vector<ObjectView>& views,
                                        const CaptureRules& rules) {
    std::vector<ObjectCapture> all(scene.objects.size());
    for (const Object& object : scene.objects) {
        ObjectCapture& row = all[object.id - 1];
        row.object_id = object.id;
        row.best.frame = -1;
        row.best_well.frame = -1;
    }
    for (const ObjectView& view : views) {
        ObjectCapture& row = all[view.object_id - 1];
        row.captured |= isCaptured(view, rules);
        if (isBetter(view, row.best)) row.best = view;
        if (!isWellCaptured(view, rules)) continue;
        row.well_captured = true;
        if (isBetter(view, row.best_well)) row.best_well = view;
    }
    std::erase_if(all, [&](const ObjectCapture& row) {
        return scene.object(row.object_id).role != Role::Target;
    });
    return all;
}

bool isSmallTarget(const Object& object) {
    return object.box.volume() < kSmallVolume;
}

CaptureMetrics summarize(const Scene& scene, const std::vector<ObjectCapture>& captures) {
    CaptureMetrics metrics;
    int small = 0;
    int small_captured = 0;
    for (const ObjectCapture& row : captures) {
        ++metrics.objects;
        const bool is_small = isSmallTarget(scene.object(row.object_id));
        small += is_small;
        if (row.well_captured) ++metrics.well_captured;
        if (!row.captured) continue;
        ++metrics.captured;
        small_captured += is_small;
        metrics.area_share_box += row.best.box_share;
        metrics.area_share_mask += row.best.mask_share;
    }
    if (metrics.captured > 0) {
        metrics.area_share_box /= metrics.captured;
        metrics.area_share_mask /= metrics.captured;
    }
    if (metrics.objects > 0) {
        metrics.capture_rate = static_cast<double>(metrics.captured) / metrics.objects;
        metrics.well_captured_rate = static_cast<double>(metrics.well_captured) / metrics.objects;
    }
    metrics.small_capture_rate = small > 0 ? static_cast<double>(small_captured) / small : 1.0;
    return metrics;
}

}  // namespace dollytrack
