#include "planning/visibility/shown_surface.h"

#include "engine/jobs/parallel.h"
#include "engine/math/pose_key.h"
#include "planning/visibility/view_estimator.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace dollytrack::planning {
namespace {

/// A grid of rays over the image, and the size of surface patches.
struct RayGrid {
    int columns = 32;
    int rows = 24;
    double patch_m = 0.1;  // edge of a patch
    [[nodiscard]] int rays() const { return columns * rows; }
};
constexpr RayGrid kFineRays;
constexpr RayGrid kCoarseRays = {16, 12, 0.2};
constexpr double kNothingNew = 0.01;  // share of the rays

// Rays are ordered in blocks of this many rows and columns, so that neighbours in the list point in
// similar directions.
constexpr int kBlock = 4;

/// Key of the surface patch at a point: grid cell and object.
std::uint64_t patchAt(const Eigen::Vector3d& point, int object_id, double patch_m) {
    std::uint64_t key = static_cast<std::uint64_t>(object_id);
    for (int axis = 0; axis < 3; ++axis) {
        const auto cell = static_cast<std::int64_t>(std::floor(point[axis] / patch_m));
        key = key << 16U | static_cast<std::uint64_t>(cell & 0xffff);
    }
    return key;
}

/// Numbers keys from 0 in order of first appearance, in one open-addressing hash table. Keys must
/// not be 0, which holds for object ids below 65536.
class KeyNumbers {
  public:
    int operator[](std::uint64_t key) {
        if (2 * (static_cast<std::size_t>(count_) + 1) > slots_.size()) grow();
        Slot& slot = find(key);
        if (slot.key == 0) slot = {key, count_++};
        return slot.number;
    }
    [[nodiscard]] int count() const { return count_; }
    void clear() {
        std::ranges::fill(slots_, Slot{});
        count_ = 0;
    }

  private:
    struct Slot {
        std::uint64_t key = 0;
        int number = 0;
    };

    Slot& find(std::uint64_t key) {
        const std::size_t mask = slots_.size() - 1;
        std::size_t i = (key * 0x9e3779b97f4a7c15U >> 32U) & mask;
        while (slots_[i].key != 0 && slots_[i].key != key) i = (i + 1) & mask;
        return slots_[i];
    }

    void grow() {
        std::vector<Slot> before(std::max<std::size_t>(2048, 2 * slots_.size()));
        before.swap(slots_);
        for (const Slot& slot : before) {
            if (slot.key != 0) find(slot.key) = slot;
        }
    }

    std::vector<Slot> slots_;  // their number is a power of two
    int count_ = 0;
};

struct Seen {
    std::vector<std::uint64_t> patches;  // without duplicates
    int on_targets = 0;
};

Seen castSamples(const ViewEstimator& views, const Pose& pose, const RayGrid& grid) {
    const Intrinsics& k = views.intrinsics();
    const Eigen::Matrix3d world_from_camera = pose.rotation.toRotationMatrix();
    thread_local std::vector<RayCaster::BundleRay> rays;
    thread_local std::vector<RayHit> hits;
    thread_local KeyNumbers known;
    rays.clear();
    known.clear();
    for (int ray = 0; ray < grid.rays(); ++ray) {
        const int block = ray / (kBlock * kBlock);
        const int row = block / (grid.columns / kBlock) * kBlock + ray / kBlock % kBlock;
        const int column = block % (grid.columns / kBlock) * kBlock + ray % kBlock;
        rays.push_back({world_from_camera * k.unproject((column + 0.5) * k.width / grid.columns,
                                                        (row + 0.5) * k.height / grid.rows)});
    }
    views.rays().castBundle(pose.position, rays, views.nearDistance(), hits);
    Seen seen;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const RayHit& hit = hits[i];
        if (hit.object_id == 0) continue;
        const std::uint64_t patch =
            patchAt(pose.position + hit.distance * rays[i].direction, hit.object_id, grid.patch_m);
        const int before = known.count();
        if (known[patch] == before) seen.patches.push_back(patch);
        seen.on_targets += views.scene().object(hit.object_id).role == Role::Target;
    }
    return seen;
}

}  // namespace

class SurfaceSampler::Numbers : public KeyNumbers {};

SurfaceSampler::SurfaceSampler(const ViewEstimator& views, Detail detail)
    : views_(views), detail_(detail), numbers_(std::make_unique<Numbers>()) {}
SurfaceSampler::~SurfaceSampler() = default;

Result<FrameSurfaces> SurfaceSampler::sample(const Trajectory& trajectory, const JobContext& job) {
    const RayGrid& grid = detail_ == Detail::Fine ? kFineRays : kCoarseRays;
    // Frames at new poses, and the patches they show.
    std::vector<std::size_t> fresh;
    for (std::size_t i = 0; i < trajectory.frames.size(); ++i) {
        const bool is_new = shown_.try_emplace(keyOf(trajectory.frames[i].pose), nullptr).second;
        if (is_new) fresh.push_back(i);
    }
    std::vector<Seen> seen(fresh.size());
    parallelFor(fresh.size(), [&](std::size_t i) {
        if (!job.cancelled()) seen[i] = castSamples(views_, trajectory.frames[fresh[i]].pose, grid);
    });
    if (job.cancelled()) {
        shown_.clear();
        return fail(ErrorCode::Cancelled, "Planning was cancelled.");
    }
    for (std::size_t i = 0; i < fresh.size(); ++i) {
        FrameSurfaces::Shown shown{{}, seen[i].on_targets};
        shown.patches.reserve(seen[i].patches.size());
        for (const std::uint64_t patch : seen[i].patches) {
            shown.patches.push_back((*numbers_)[patch]);
        }
        shown_[keyOf(trajectory.frames[fresh[i]].pose)] =
            std::make_shared<const FrameSurfaces::Shown>(std::move(shown));
    }
    FrameSurfaces surfaces;
    surfaces.rays_ = grid.rays();
    surfaces.patches_ = numbers_->count();
    for (const TrajectoryFrame& frame : trajectory.frames) {
        surfaces.shown_.push_back(shown_.find(keyOf(frame.pose))->second);
    }
    return surfaces;
}

int FrameSurfaces::repeats(const std::vector<std::size_t>& frames) const {
    std::vector<char> known(patches_, 0);
    int repeats = 0;
    for (const std::size_t frame : frames) {
        int fresh = 0;
        for (const int patch : shown_[frame]->patches) {
            char& before = known[patch];
            fresh += before == 0;
            before = 1;
        }
        repeats += fresh < kNothingNew * rays_;
    }
    return repeats;
}

int FrameSurfaces::repeats() const {
    std::vector<std::size_t> all(shown_.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return repeats(all);
}

double FrameSurfaces::objectPixels() const {
    double on_targets = 0.0;
    for (const auto& shown : shown_) on_targets += shown->on_targets;
    return on_targets / (std::max<double>(1.0, static_cast<double>(shown_.size())) * rays_);
}

Result<ShownSurface> measureShownSurface(const ViewEstimator& views, const Trajectory& trajectory,
                                         const JobContext& job) {
    return SurfaceSampler(views).sample(trajectory, job).map([](const FrameSurfaces& surfaces) {
        const auto frames = static_cast<double>(std::max<std::size_t>(1, surfaces.frames()));
        return ShownSurface{surfaces.repeats() / frames, surfaces.objectPixels()};
    });
}

}  // namespace dollytrack::planning
