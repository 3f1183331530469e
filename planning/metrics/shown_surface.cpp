#include "planning/metrics/shown_surface.h"

#include "engine/jobs/parallel.h"
#include "planning/visibility/view_estimator.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace dollytrack::planning {
namespace {

constexpr int kColumns = 32;
constexpr int kRows = 24;
constexpr double kPatch = 0.1;        // m, edge of a patch of surface
constexpr double kNothingNew = 0.01;  // share of the rays

struct Seen {
    std::vector<std::uint64_t> patches;  // each once, sorted
    int on_targets = 0;
};

/// The patch of surface under a point: its cell of a 0.1 m grid, and the object.
std::uint64_t patchAt(const Eigen::Vector3d& point, int object_id) {
    std::uint64_t key = static_cast<std::uint64_t>(object_id);
    for (int axis = 0; axis < 3; ++axis) {
        const auto cell = static_cast<std::int64_t>(std::floor(point[axis] / kPatch));
        key = key << 16U | static_cast<std::uint64_t>(cell & 0xffff);
    }
    return key;
}

Seen lookFrom(const ViewEstimator& views, const Pose& pose) {
    const Intrinsics& k = views.intrinsics();
    const Eigen::Matrix3d world_from_camera = pose.rotation.toRotationMatrix();
    thread_local std::vector<RayCaster::BundleRay> rays;
    thread_local std::vector<RayHit> hits;
    rays.clear();
    for (int row = 0; row < kRows; ++row) {
        for (int column = 0; column < kColumns; ++column) {
            rays.push_back({world_from_camera * k.unproject((column + 0.5) * k.width / kColumns,
                                                            (row + 0.5) * k.height / kRows)});
        }
    }
    views.rays().castBundle(pose.position, rays, views.nearDistance(), hits);
    Seen seen;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const RayHit& hit = hits[i];
        if (hit.object_id == 0) continue;
        seen.patches.push_back(
            patchAt(pose.position + hit.distance * rays[i].direction, hit.object_id));
        seen.on_targets += views.scene().object(hit.object_id).role == Role::Target;
    }
    std::sort(seen.patches.begin(), seen.patches.end());
    seen.patches.erase(std::unique(seen.patches.begin(), seen.patches.end()), seen.patches.end());
    return seen;
}

}  // namespace

Result<FrameSurfaces> FrameSurfaces::look(const ViewEstimator& views, const Trajectory& trajectory,
                                          const JobContext& job) {
    const std::size_t count = trajectory.frames.size();
    std::vector<Seen> seen(count);
    parallelFor(count, [&](std::size_t i) {
        if (!job.cancelled()) seen[i] = lookFrom(views, trajectory.frames[i].pose);
    });
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");

    FrameSurfaces surfaces;
    surfaces.shown_.resize(count);
    std::unordered_map<std::uint64_t, int> numbers;
    double on_targets = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        for (const std::uint64_t patch : seen[i].patches) {
            surfaces.shown_[i].push_back(
                numbers.try_emplace(patch, static_cast<int>(numbers.size())).first->second);
        }
        on_targets += seen[i].on_targets;
    }
    surfaces.patches_ = static_cast<int>(numbers.size());
    surfaces.object_pixels_ =
        on_targets / (std::max<double>(1.0, static_cast<double>(count)) * kColumns * kRows);
    return surfaces;
}

int FrameSurfaces::repeats(const std::vector<std::size_t>& frames) const {
    std::vector<char> known(static_cast<std::size_t>(patches_), 0);
    int repeats = 0;
    for (const std::size_t frame : frames) {
        int fresh = 0;
        for (const int patch : shown_[frame]) {
            char& before = known[static_cast<std::size_t>(patch)];
            fresh += before == 0;
            before = 1;
        }
        repeats += fresh < kNothingNew * kColumns * kRows;
    }
    return repeats;
}

Result<ShownSurface> measureShownSurface(const ViewEstimator& views, const Trajectory& trajectory,
                                         const JobContext& job) {
    return FrameSurfaces::look(views, trajectory, job).map([](const FrameSurfaces& surfaces) {
        std::vector<std::size_t> all(surfaces.frames());
        std::iota(all.begin(), all.end(), std::size_t{0});
        const auto frames = static_cast<double>(std::max<std::size_t>(1, all.size()));
        return ShownSurface{surfaces.repeats(all) / frames, surfaces.objectPixels()};
    });
}

}  // namespace dollytrack::planning
