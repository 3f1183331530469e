#include "planning/metrics/estimate_captures.h"

#include "engine/jobs/parallel.h"
#include "planning/visibility/view_estimator.h"

#include <algorithm>
#include <tuple>

namespace dollytrack::planning {
namespace {

constexpr int kCoarseGrid = 7;
constexpr int kExactFrames = 4;  // frames looked at by every pixel, for each of the orders
constexpr int kExactGrid = 72;   // denser than this adds nothing that decides

/// A cheap look, without rays, at whether a frame could capture the object.
bool mayCapture(const ViewEstimator& views, const Pose& pose, int object_id) {
    const auto extent = views.extent(pose, object_id);
    if (!extent) return false;
    const Intrinsics& k = views.intrinsics();
    const Eigen::AlignedBox2d image(Eigen::Vector2d::Zero(), Eigen::Vector2d(k.width, k.height));
    const Eigen::AlignedBox2d inside = image.intersection(*extent);
    if (inside.isEmpty()) return false;
    const double to_vga = 640.0 * 480.0 / (static_cast<double>(k.width) * k.height);
    return inside.sizes().prod() * to_vga >= CaptureRules{}.min_visible_px &&
           inside.sizes().prod() >= 0.5 * extent->sizes().prod();
}

/// The frames that are worth a look by every pixel, by three orders: most visible, most visible
/// among those that show the object large, and of these the safest; then the safest key frames.
std::vector<int> bestFrames(std::vector<ObjectView> coarse, const Trajectory& trajectory) {
    std::vector<int> frames;
    const auto take = [&](auto&& better) {
        const auto count = std::min<std::size_t>(kExactFrames, coarse.size());
        std::partial_sort(coarse.begin(), coarse.begin() + static_cast<std::ptrdiff_t>(count),
                          coarse.end(), better);
        for (std::size_t i = 0; i < count; ++i) frames.push_back(coarse[i].frame);
    };
    const auto key = [](const ObjectView& v) {
        return std::tuple(-v.visible_fraction, -v.mask_share, v.frame);
    };
    take([&](const ObjectView& a, const ObjectView& b) { return key(a) < key(b); });
    std::erase_if(coarse, [](const ObjectView& v) {
        return v.box_share < 0.9 * CaptureRules{}.min_box_share;
    });
    take([&](const ObjectView& a, const ObjectView& b) { return key(a) < key(b); });
    // Among many alike the most visible may all be a little too small: also those that pass both
    // conditions by the widest margin.
    const auto margin = [](const ObjectView& v) {
        const CaptureRules rules;
        return std::tuple(-std::min(v.visible_fraction / rules.min_visible_fraction,
                                    v.box_share / rules.min_box_share),
                          v.frame);
    };
    const auto safer = [&](const ObjectView& a, const ObjectView& b) {
        return margin(a) < margin(b);
    };
    take(safer);
    // One of them was chosen for this object, and what it was chosen for shows at a close look
    // only, where things stand one before the other.
    std::erase_if(coarse, [&](const ObjectView& v) {
        return trajectory.frames[static_cast<std::size_t>(v.frame)].position_point < 0;
    });
    take(safer);
    std::sort(frames.begin(), frames.end());
    frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
    return frames;
}

}  // namespace

Result<CaptureEstimate> estimateCaptures(const ViewEstimator& views, const Trajectory& trajectory,
                                         const JobContext& job) {
    const Scene& scene = views.scene();
    std::vector<std::vector<ObjectView>> exact(scene.objects.size());
    std::vector<std::vector<ObjectView>> all_frames(scene.objects.size());
    parallelFor(scene.objects.size(), [&](std::size_t i) {
        const int id = scene.objects[i].id;
        if (scene.objects[i].role != Role::Target || job.cancelled()) return;
        std::vector<ObjectView> coarse;
        for (std::size_t f = 0; f < trajectory.frames.size(); ++f) {
            if (job.cancelled()) return;
            const Pose& pose = trajectory.frames[f].pose;
            if (!mayCapture(views, pose, id)) continue;
            coarse.push_back(
                makeView(views.estimate(pose, id, kCoarseGrid), id, static_cast<int>(f)));
        }
        for (const int frame : bestFrames(coarse, trajectory)) {
            const Pose& pose = trajectory.frames[static_cast<std::size_t>(frame)].pose;
            exact[i].push_back(makeView(views.estimate(pose, id, kExactGrid), id, frame));
        }
        // Both by rising frame: the exact view takes the place of the coarse one.
        auto better = exact[i].begin();
        for (ObjectView& view : coarse) {
            if (better != exact[i].end() && better->frame == view.frame) view = *better++;
        }
        all_frames[i] = std::move(coarse);
    });
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
    std::vector<ObjectView> all;
    for (const auto& some : exact) all.insert(all.end(), some.begin(), some.end());
    CaptureEstimate estimate{bestCaptures(scene, all), {}};
    estimate.frame_views.resize(trajectory.frames.size());
    for (const auto& some : all_frames) {
        for (const ObjectView& view : some) {
            estimate.frame_views[static_cast<std::size_t>(view.frame)].push_back(view);
        }
    }
    return estimate;
}

}  // namespace dollytrack::planning
