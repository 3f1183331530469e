#include "render/pipeline/capture_counter.h"

#include <algorithm>

namespace dollytrack::render {
namespace {

struct Extent {
    std::uint32_t pixels = 0;
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// Pixel count and bounding box of each id, scanned by runs.
std::vector<Extent> measure(const FrameRecord& frame, std::size_t id_count) {
    std::vector<Extent> extents(id_count);
    for (int y = 0; y < frame.height; ++y) {
        const std::uint16_t* row =
            frame.instance.data() + static_cast<std::size_t>(y) * frame.width;
        for (int x = 0; x < frame.width;) {
            const std::uint16_t id = row[x];
            const int start = x;
            while (x < frame.width && row[x] == id) ++x;
            if (id == 0 || id >= id_count) continue;
            Extent& extent = extents[id];
            if (extent.pixels == 0) {
                extent.x0 = start;
                extent.y0 = y;
                extent.x1 = x;
            }
            extent.x0 = std::min(extent.x0, start);
            extent.x1 = std::max(extent.x1, x);
            extent.y1 = y + 1;
            extent.pixels += static_cast<std::uint32_t>(x - start);
        }
    }
    return extents;
}

}  // namespace

CaptureCounter::CaptureCounter(const Scene& scene, const CaptureRules& rules)
    : rules_(rules),
      is_target_(scene.objects.size() + 1, false),
      best_whole_(scene.objects.size() + 1) {
    for (const Object& object : scene.objects) {
        is_target_[object.id] = object.role == Role::Target;
    }
}

bool CaptureCounter::canMatter(const ObjectView& view) const {
    if (view.visible_px < rules_.min_visible_px) return false;
    // It may show the object well, which the frame's list of well-shown objects needs.
    if (view.box_share >= rules_.min_box_share) return true;
    // The best view shows the whole object with the largest mask.
    const ObjectView& best = best_whole_[view.object_id];
    return best.object_id == 0 || view.mask_share > best.mask_share;
}

std::vector<int> CaptureCounter::addFrame(const FrameRecord& frame) {
    const std::vector<Extent> extents = measure(frame, is_target_.size());
    const double area = static_cast<double>(frame.width) * frame.height;
    pending_.clear();
    pending_px_.clear();
    well_shown_.clear();
    std::vector<int> wanted;
    for (std::size_t id = 1; id < extents.size(); ++id) {
        const Extent& extent = extents[id];
        if (!is_target_[id] || extent.pixels == 0) continue;
        ObjectView view;
        view.object_id = static_cast<int>(id);
        view.frame = frame.index;
        view.visible_px = extent.pixels * (640.0 * 480.0 / area);
        view.box_share = double(extent.x1 - extent.x0) * (extent.y1 - extent.y0) / area;
        view.mask_share = extent.pixels / area;
        if (!canMatter(view)) continue;
        wanted.push_back(view.object_id);
        pending_.push_back(view);
        pending_px_.push_back(extent.pixels);
    }
    return wanted;
}

void CaptureCounter::take(const ObjectView& view) {
    if (isWellCaptured(view, rules_)) well_shown_.push_back(view.object_id);
    ObjectView& best = best_whole_[view.object_id];
    if (view.visible_fraction >= 1.0 &&
        (best.object_id == 0 || view.mask_share > best.mask_share)) {
        best = view;
    }
    views_.push_back(view);
}

void CaptureCounter::addCounted(std::span<const ObjectView> views) {
    well_shown_.clear();
    last_views_ = views_.size();
    for (const ObjectView& view : views) take(view);
}

void CaptureCounter::addSilhouettes(std::span<const std::uint64_t> whole_px, bool usable) {
    last_views_ = views_.size();
    for (std::size_t i = 0; usable && i < pending_.size(); ++i) {
        ObjectView view = pending_[i];
        // The two renderings may round border pixels differently.
        const double whole = std::max(static_cast<double>(whole_px[i]), pending_px_[i]);
        view.visible_fraction = pending_px_[i] / whole;
        take(view);
    }
    pending_.clear();
    pending_px_.clear();
}

}  // namespace dollytrack::render
