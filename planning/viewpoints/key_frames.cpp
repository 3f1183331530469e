#include "planning/viewpoints/key_frames.h"

#include "engine/jobs/parallel.h"
#include "engine/math/pose_key.h"
#include "planning/plan_params.h"
#include "planning/viewpoints/candidate_evaluator.h"
#include "planning/visibility/view_estimator.h"

#include <algorithm>
#include <map>
#include <set>

namespace dollytrack::planning {
namespace {

constexpr int kScreeningCells = 6;
constexpr double kLeastVisibleAsKeyFrame = 0.7;  // visible fraction in a coarse estimate
constexpr int kGrid = 16;
// Least size of an object's box in another point's view, relative to its own view.
constexpr double kRidesAlong = 0.6;
// Share of an object's extent that must lie in the image for it to be shown well.
constexpr double kMostlyInside = 0.6;

bool mayShowWell(const ViewEstimator& views, const Pose& pose, int object_id) {
    const auto extent = views.extent(pose, object_id);
    if (!extent) return false;
    const Eigen::AlignedBox2d image(
        Eigen::Vector2d::Zero(),
        Eigen::Vector2d(views.intrinsics().width, views.intrinsics().height));
    const double inside =
        image.intersection(*extent).isEmpty() ? 0.0 : image.intersection(*extent).sizes().prod();
    return inside >= kMostlyInside * extent->sizes().prod() &&
           inside >= CaptureRules{}.min_box_share * image.sizes().prod();
}

VisibilityCache::Entry sampleObjects(const ViewEstimator& views, const PositionPoint& point) {
    VisibilityCache::Entry entry{point.own, point.own, {}};
    const Pose& pose = point.pose;
    for (const Object& object : views.scene().objects) {
        if (object.role != Role::Target || !mayShowWell(views, pose, object.id)) continue;
        entry.looked_at.push_back(object.id);
        if (std::ranges::find(point.own, object.id, &ShownObject::object_id) != point.own.end()) {
            continue;
        }
        // A coarse estimate avoids the dense one if the object is clearly hidden.
        const auto coarse = views.estimate(pose, object.id, kScreeningCells);
        if (coarse.tells() && coarse.visible_fraction < kLeastVisibleAsKeyFrame) continue;
        const auto estimate = estimateSurely(views, pose, object.id, kGrid);
        if (isSafelyWellCaptured(estimate)) entry.shown.push_back({object.id, estimate.box_share});
    }
    return entry;
}

}  // namespace

const VisibilityCache::Entry* VisibilityCache::find(const PositionPoint& point) const {
    const auto found = entries_.find(keyOf(point.pose));
    return found != entries_.end() && found->second.known == point.own ? &found->second : nullptr;
}

void VisibilityCache::forget(const MovedObjects& moved, const ViewEstimator& now) {
    std::erase_if(entries_, [&](const auto& entry) {
        const Pose pose = poseOf(entry.first);
        return std::ranges::any_of(entry.second.looked_at,
                                   [&](int id) {
                                       return moved.isOne(id) ||
                                              moved.cross(pose.position, reachedBox(now, id));
                                   }) ||
               std::ranges::any_of(moved.objects(), [&](int id) {
                   return now.scene().object(id).role == Role::Target && mayShowWell(now, pose, id);
               });
    });
}

void VisibilityCache::keep(const Pose& pose, Entry entry) {
    // Bounds the cache while a point is being dragged.
    constexpr std::size_t kMost = 20'000;
    if (entries_.size() >= kMost) entries_.clear();
    entries_.insert_or_assign(keyOf(pose), std::move(entry));
}

void findCaptured(const ViewEstimator& views, std::vector<PositionPoint>& position_points,
                  VisibilityCache* memo) {
    std::vector<VisibilityCache::Entry> entries(position_points.size());
    parallelFor(position_points.size(), [&](std::size_t i) {
        const auto* known = memo ? memo->find(position_points[i]) : nullptr;
        entries[i] = known ? *known : sampleObjects(views, position_points[i]);
    });
    for (std::size_t i = 0; memo && i < entries.size(); ++i) {
        memo->keep(position_points[i].pose, entries[i]);
    }

    std::map<int, double> own_share;
    for (std::size_t i = 0; i < position_points.size(); ++i) {
        const auto& own = position_points[i].well_captured;
        for (const ShownObject& one : entries[i].shown) {
            if (std::find(own.begin(), own.end(), one.object_id) == own.end()) continue;
            double& share = own_share[one.object_id];
            share = std::max(share, one.box_share);
        }
    }
    for (std::size_t i = 0; i < position_points.size(); ++i) {
        PositionPoint& point = position_points[i];
        std::set<int> well(point.well_captured.begin(), point.well_captured.end());
        for (const ShownObject& one : entries[i].shown) {
            if (one.box_share >= kRidesAlong * own_share[one.object_id]) well.insert(one.object_id);
        }
        std::set<int> captured(point.captured.begin(), point.captured.end());
        captured.insert(well.begin(), well.end());
        point.well_captured.assign(well.begin(), well.end());
        point.captured.assign(captured.begin(), captured.end());
    }
}

std::vector<int> chooseKeyFrames(const std::vector<PositionPoint>& position_points,
                                 const std::vector<double>& weights) {
    return chooseKeyFrames(position_points, weights, Objective::Objects);
}

std::vector<int> chooseKeyFrames(const std::vector<PositionPoint>& position_points,
                                 const std::vector<double>& weights, Objective objective) {
    std::set<int> well_missing;
    std::set<int> missing;
    for (const PositionPoint& point : position_points) {
        if (objective == Objective::Surface) break;
        well_missing.insert(point.well_captured.begin(), point.well_captured.end());
        missing.insert(point.captured.begin(), point.captured.end());
    }
    const auto weightOf = [&](int id) { return weights.empty() ? 1.0 : weights[id - 1]; };
    std::vector<int> chosen;
    const auto choose = [&](std::size_t i) {
        chosen.push_back(static_cast<int>(i));
        for (const int id : position_points[i].well_captured) well_missing.erase(id);
        for (const int id : position_points[i].captured) missing.erase(id);
    };
    for (std::size_t i = 0; i < position_points.size(); ++i) {
        if (position_points[i].fixed) choose(i);
    }
    while (true) {
        int best = -1;
        double best_gain = 0.0;
        for (std::size_t i = 0; i < position_points.size(); ++i) {
            double gain = 0.0;
            for (const int id : position_points[i].well_captured) {
                if (well_missing.contains(id)) gain += 1000.0 * weightOf(id);
            }
            for (const int id : position_points[i].captured) {
                if (missing.contains(id)) gain += weightOf(id);
            }
            if (gain <= best_gain) continue;
            best_gain = gain;
            best = static_cast<int>(i);
        }
        if (best < 0) break;
        choose(static_cast<std::size_t>(best));
    }
    for (std::size_t i = 0; i < position_points.size(); ++i) {
        if (position_points[i].room_view) choose(i);
    }
    for (std::size_t i = 0; i < position_points.size(); ++i) {
        if (position_points[i].surface_view) choose(i);
    }
    return chosen;
}

}  // namespace dollytrack::planning
