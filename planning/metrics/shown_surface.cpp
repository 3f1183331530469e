#include "planning/metrics/shown_surface.h"

#include "engine/jobs/parallel.h"
#include "planning/visibility/view_estimator.h"

#include <cmath>
#include <limits>
#include <unordered_set>

namespace dollytrack::planning {
namespace {

constexpr int kColumns = 32;
constexpr int kRows = 24;
constexpr double kPatch = 0.1;        // m, edge of a patch of surface
constexpr double kNothingNew = 0.01;  // share of the rays

struct Seen {
    std::vector<std::uint64_t> patches;  // one a ray that hit something
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

Seen look(const ViewEstimator& views, const Pose& pose) {
    const Intrinsics& k = views.intrinsics();
    Seen seen;
    for (int row = 0; row < kRows; ++row) {
        for (int column = 0; column < kColumns; ++column) {
            const Eigen::Vector3d ray =
                pose.rotation *
                k.unproject((column + 0.5) * k.width / kColumns, (row + 0.5) * k.height / kRows);
            const RayHit hit = views.rays().cast(
                pose.position, ray, std::numeric_limits<double>::infinity(), views.nearDistance());
            if (hit.object_id == 0) continue;
            seen.patches.push_back(patchAt(pose.position + hit.distance * ray, hit.object_id));
            seen.on_targets += views.scene().object(hit.object_id).role == Role::Target;
        }
    }
    return seen;
}

}  // namespace

Result<ShownSurface> measureShownSurface(const ViewEstimator& views, const Trajectory& trajectory,
                                         const JobContext& job) {
    const std::size_t count = trajectory.frames.size();
    if (count == 0) return ShownSurface{};
    std::vector<Seen> seen(count);
    parallelFor(count, [&](std::size_t i) {
        if (!job.cancelled()) seen[i] = look(views, trajectory.frames[i].pose);
    });
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");

    std::unordered_set<std::uint64_t> known;
    int repeats = 0;
    double on_targets = 0.0;
    for (const Seen& frame : seen) {
        int fresh = 0;
        for (const std::uint64_t patch : frame.patches) fresh += known.insert(patch).second;
        repeats += fresh < kNothingNew * kColumns * kRows;
        on_targets += frame.on_targets;
    }
    const auto frames = static_cast<double>(count);
    return ShownSurface{repeats / frames, on_targets / (frames * kColumns * kRows)};
}

}  // namespace dollytrack::planning
