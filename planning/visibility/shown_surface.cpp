#include "planning/visibility/shown_surface.h"

#include "engine/jobs/parallel.h"
#include "planning/visibility/view_estimator.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dollytrack::planning {
namespace {

// Rays over the image.
constexpr int kColumns = 32;
constexpr int kRows = 24;
constexpr int kRays = kColumns * kRows;
constexpr double kPatch_m = 0.1;  // edge of a patch

// Rays are ordered in blocks of this many rows and columns, so that neighbours in the list point in
// similar directions.
constexpr int kBlock = 4;

/// Key of the surface patch at a point: grid cell and object.
std::uint64_t patchAt(const Eigen::Vector3d& point, int object_id) {
    std::uint64_t key = static_cast<std::uint64_t>(object_id);
    for (int axis = 0; axis < 3; ++axis) {
        const auto cell = static_cast<std::int64_t>(std::floor(point[axis] / kPatch_m));
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

Seen castSamples(const ViewEstimator& views, const Pose& pose) {
    const Intrinsics& k = views.intrinsics();
    const Eigen::Matrix3d world_from_camera = pose.rotation.toRotationMatrix();
    thread_local std::vector<RayCaster::BundleRay> rays;
    thread_local std::vector<RayHit> hits;
    thread_local KeyNumbers known;
    rays.clear();
    known.clear();
    for (int ray = 0; ray < kRays; ++ray) {
        const int block = ray / (kBlock * kBlock);
        const int row = block / (kColumns / kBlock) * kBlock + ray / kBlock % kBlock;
        const int column = block % (kColumns / kBlock) * kBlock + ray % kBlock;
        rays.push_back({world_from_camera * k.unproject((column + 0.5) * k.width / kColumns,
                                                        (row + 0.5) * k.height / kRows)});
    }
    views.rays().castBundle(pose.position, rays, views.nearDistance(), hits);
    Seen seen;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const RayHit& hit = hits[i];
        if (hit.object_id == 0) continue;
        const std::uint64_t patch =
            patchAt(pose.position + hit.distance * rays[i].direction, hit.object_id);
        const int before = known.count();
        if (known[patch] == before) seen.patches.push_back(patch);
        seen.on_targets += views.scene().object(hit.object_id).role == Role::Target;
    }
    return seen;
}

}  // namespace

double ShownSurface::repeatRate() const {
    if (new_shares.empty()) return 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < new_shares.size(); ++i) count += repeats(i) ? 1.0 : 0.0;
    return count / static_cast<double>(new_shares.size());
}

Result<ShownSurface> measureShownSurface(const ViewEstimator& views, const Trajectory& trajectory,
                                         const JobContext& job) {
    std::vector<Seen> seen(trajectory.frames.size());
    parallelFor(seen.size(), [&](std::size_t i) {
        if (!job.cancelled()) seen[i] = castSamples(views, trajectory.frames[i].pose);
    });
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
    ShownSurface shown;
    KeyNumbers known;
    double on_targets = 0.0;
    for (const Seen& frame : seen) {
        const int before = known.count();
        for (const std::uint64_t patch : frame.patches) known[patch];
        shown.new_shares.push_back(static_cast<double>(known.count() - before) / kRays);
        on_targets += frame.on_targets;
    }
    if (!seen.empty()) {
        shown.object_pixels = on_targets / (static_cast<double>(seen.size()) * kRays);
    }
    return shown;
}

}  // namespace dollytrack::planning
