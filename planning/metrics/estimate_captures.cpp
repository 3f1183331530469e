#include "planning/metrics/estimate_captures.h"

#include "engine/jobs/parallel.h"
#include "planning/metrics/view_cache.h"
#include "planning/visibility/image_boxes.h"
#include "planning/visibility/view_estimator.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace dollytrack::planning {
namespace {

constexpr int kExactFrames = 4;        // frames estimated exactly per ordering
constexpr std::size_t kMoreKeys = 12;  // further key frames, if none of those shows the object well

/// Frames worth an exact estimate, by several orderings: most visible, most visible among those
/// that show the object large, largest margin of these, and key frames of largest margin.
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
        return v.box_share < 0.9 * CaptureRules{}.min_box_share ||
               v.scanned_share < CaptureRules{}.min_scanned_share;
    });
    take([&](const ObjectView& a, const ObjectView& b) { return key(a) < key(b); });
    // The most visible of many similar frames may all be slightly too small: add those with the
    // largest margin on both conditions.
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
    // One key frame was chosen for this object, and in cluttered scenes only a dense estimate shows
    // it.
    std::erase_if(
        coarse, [&](const ObjectView& v) { return trajectory.frames[v.frame].position_point < 0; });
    take(safer);
    std::sort(frames.begin(), frames.end());
    frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
    return frames;
}

/// Key frames that show part of the object, the most visible first. Coincident surfaces give
/// different results with few rays, so the coarse pass may miss what a key frame was chosen for.
std::vector<int> keyFramesOf(std::vector<ObjectView> coarse, const Trajectory& trajectory) {
    std::erase_if(
        coarse, [&](const ObjectView& v) { return trajectory.frames[v.frame].position_point < 0; });
    std::ranges::sort(coarse, {}, [](const ObjectView& v) {
        return std::tuple(-v.visible_fraction, -v.box_share, v.frame);
    });
    coarse.resize(std::min(coarse.size(), kMoreKeys));
    std::vector<int> frames(coarse.size());
    std::ranges::transform(coarse, frames.begin(), &ObjectView::frame);
    return frames;
}

using CoarseEstimates = std::vector<ViewCache::CoarseEstimate>;
using ObjectViews = std::vector<ObjectView>;  // of one object, by ascending frame

/// Coarse estimates of all targets, by frame; cached poses are reused.
std::vector<ViewCache::Entry*> estimateCoarsely(const ViewEstimator& views,
                                                const Trajectory& trajectory, ViewCache& memo,
                                                const JobContext& job) {
    const Scene& scene = views.scene();
    const auto& frames = trajectory.frames;
    std::vector<ViewCache::Entry*> entries(frames.size());
    std::vector<std::size_t> fresh;
    for (std::size_t f = 0; f < frames.size(); ++f) {
        entries[f] = memo.find(frames[f].pose);
        if (entries[f] == nullptr) fresh.push_back(f);
    }
    // Object by object, for cache locality: neighbouring frames see much the same of one object.
    std::vector<std::vector<std::pair<std::size_t, ViewCache::CoarseEstimate>>> seen(
        scene.objects.size());
    parallelFor(scene.objects.size(), [&](std::size_t i) {
        const int id = scene.objects[i].id;
        if (scene.objects[i].role != Role::Target) return;
        for (std::size_t f = 0; f < fresh.size() && !job.cancelled(); ++f) {
            const Pose& pose = frames[fresh[f]].pose;
            if (!mayCapture(views, pose, id)) continue;
            const auto one = views.estimate(pose, id, kSparseGrid);
            seen[i].emplace_back(f,
                                 ViewCache::CoarseEstimate{makeView(one, id, 0), one.visible_box});
        }
    });
    if (job.cancelled()) return {};
    std::vector<CoarseEstimates> by_frame(fresh.size());
    for (const auto& of_object : seen) {
        for (const auto& [f, one] : of_object) by_frame[f].push_back(one);
    }
    for (std::size_t f = 0; f < fresh.size(); ++f) {
        entries[fresh[f]] = &memo.keep(frames[fresh[f]].pose, std::move(by_frame[f]));
    }
    return entries;
}

}  // namespace

Result<CaptureEstimate> estimateCaptures(const ViewEstimator& views, const Trajectory& trajectory,
                                         const JobContext& job, ViewCache* memo) {
    ViewCache own;
    ViewCache& known = memo != nullptr ? *memo : own;
    known.begin();
    const std::vector<ViewCache::Entry*> entries = estimateCoarsely(views, trajectory, known, job);
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");

    const Scene& scene = views.scene();
    CaptureEstimate estimate;
    estimate.frame_views.resize(entries.size());
    estimate.frame_boxes.resize(entries.size());
    std::vector<double> scanned(entries.size());
    parallelFor(entries.size(),
                [&](std::size_t f) { scanned[f] = views.scannedShare(trajectory.frames[f].pose); });
    std::vector<ObjectViews> coarse(scene.objects.size());
    for (std::size_t f = 0; f < entries.size(); ++f) {
        for (const ViewCache::CoarseEstimate& one : entries[f]->coarse) {
            ObjectView view = one.view;
            view.frame = static_cast<int>(f);
            view.scanned_share = scanned[f];
            coarse[view.object_id - 1].push_back(view);
            if (!one.box.isEmpty()) estimate.frame_boxes[f].push_back(one.box);
        }
    }
    std::vector<ObjectViews> exact(scene.objects.size());
    parallelFor(scene.objects.size(), [&](std::size_t i) {
        const int id = static_cast<int>(i) + 1;
        const auto addExact = [&](int frame) {
            const std::size_t f = frame;
            const auto remembered = entries[f]->exact.find(id);
            ObjectView view =
                remembered != entries[f]->exact.end()
                    ? remembered->second
                    : makeView(views.estimateExactly(trajectory.frames[f].pose, id), id, 0);
            view.frame = frame;
            view.scanned_share = scanned[f];
            exact[i].push_back(view);
        };
        const std::vector<int> best = bestFrames(coarse[i], trajectory);
        for (const int frame : best) {
            if (job.cancelled()) return;
            addExact(frame);
        }
        const auto is_well = [](const ObjectView& view) { return isWellCaptured(view); };
        if (std::ranges::any_of(exact[i], is_well)) return;
        for (const int frame : keyFramesOf(coarse[i], trajectory)) {
            if (job.cancelled()) return;
            if (!std::ranges::binary_search(best, frame)) addExact(frame);
        }
        std::ranges::sort(exact[i], {}, &ObjectView::frame);
    });
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
    ObjectViews all;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        // Both are sorted by frame: the exact view replaces the coarse one.
        auto better = exact[i].begin();
        for (ObjectView& view : coarse[i]) {
            const std::size_t f = view.frame;
            if (better != exact[i].end() && better->frame == view.frame) {
                view = *better++;
                entries[f]->exact[view.object_id] = view;
            }
            estimate.frame_views[f].push_back(view);
        }
        all.insert(all.end(), exact[i].begin(), exact[i].end());
    }
    estimate.captures = bestCaptures(scene, all);
    return estimate;
}

}  // namespace dollytrack::planning
