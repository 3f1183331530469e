#include "planning/coverage/surface_views.h"

#include "engine/geometry/ray_caster.h"
#include "engine/jobs/parallel.h"
#include "planning/collision/swept_sphere.h"
#include "planning/coverage/reachable_patches.h"
#include "planning/coverage/surface_progress.h"
#include "planning/free_space/free_space.h"
#include "planning/plan_params.h"
#include "planning/visibility/view_estimator.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <queue>
#include <utility>

namespace dollytrack::planning {
namespace {

constexpr double kHalfTurn = std::numbers::pi;
constexpr std::size_t kSurfacePlaces = 300;
constexpr int kSurfaceRaysAround = 1500;  // per position
constexpr double kFinestPatch_m = 0.1;
constexpr std::size_t kMostSurfacePatches = 4000;
constexpr double kCoarser = 1.1;  // factor on the patches' size while there are too many
constexpr double kCoveredEnough = 0.99;

// Steps between viewing directions at one position, as shares of the field of view.
constexpr double kStepAcross = 0.5;
constexpr double kStepHigh = 0.6;
constexpr int kMostAcross = 24, kFewestHigh = 3, kMostHigh = 9;

/// A view that may be chosen.
struct SurfaceCandidate {
    std::size_t place = 0;
    Eigen::Vector3d forward = Eigen::Vector3d::UnitX();
    std::vector<std::uint32_t> shown;  // indices into the observations from its position
};

SurfacePatches patchesFor(std::vector<SurfacePatch> fine) {
    SurfacePatches surface{std::move(fine), kFinestPatch_m};
    while (surface.patches.size() > kMostSurfacePatches) {
        const double excess = std::sqrt(static_cast<double>(surface.patches.size()) /
                                        static_cast<double>(kMostSurfacePatches));
        surface.spacing_m *= std::max(kCoarser, excess);
        surface.patches = thinnedOut(surface.patches, surface.spacing_m);
    }
    return surface;
}

/// Viewing directions at one position; `phase` (0..1) turns them about the vertical.
std::vector<Eigen::Vector3d> aimsAround(const Intrinsics& lens, const PitchBand& pitch,
                                        double phase) {
    const double across = 2.0 * std::atan(lens.cx / lens.fx);
    const double high = 2.0 * std::atan(lens.cy / lens.fy);
    const int rings = std::clamp(static_cast<int>(std::ceil(kHalfTurn / (kStepHigh * high))),
                                 kFewestHigh, kMostHigh);
    std::vector<Eigen::Vector3d> aims;
    double before = -kHalfTurn;
    for (int r = 0; r < rings; ++r) {
        const double up = pitch.nearest(kHalfTurn * ((r + 0.5) / rings - 0.5));
        if (up == before) continue;  // clamped to the same limit of the pitch band
        before = up;
        const int count = std::clamp(
            static_cast<int>(std::ceil(2.0 * kHalfTurn * std::cos(up) / (kStepAcross * across))), 1,
            kMostAcross);
        for (int h = 0; h < count; ++h) {
            const double heading = 2.0 * kHalfTurn * (h + phase) / count;
            aims.emplace_back(std::cos(up) * std::cos(heading), std::cos(up) * std::sin(heading),
                              std::sin(up));
        }
    }
    return aims;
}

class SurfaceViewSearch {
  public:
    SurfaceViewSearch(const PlanningEnvironment& environment, SurfaceGoal goal,
                      std::vector<Eigen::Vector3d> places)
        : environment_(environment),
          lens_(environment.views.intrinsics()),
          goal_(std::move(goal)),
          places_(std::move(places)),
          observations_(places_.size()) {
        parallelFor(places_.size(),
                    [&](std::size_t i) { observations_[i] = observationsAt(places_[i]); });
        const std::size_t patches = goal_.surface.patches.size();
        std::vector<DistinctDirections> possible(patches);
        for (const auto& list : observations_) {
            for (const PatchObservation& one : list) {
                if (one.sharp) possible[one.patch].add(one.direction, goal_.directions);
            }
        }
        for (const DistinctDirections& one : possible) goal_.coverable.push_back(one.count());
    }

    SurfaceViews choose(const std::vector<Pose>& given, std::size_t most,
                        const JobContext& job) && {
        SurfaceProgress progress(goal_.coverable);
        std::vector<std::vector<PatchObservation>> shown(given.size());
        parallelFor(given.size(), [&](std::size_t i) { shown[i] = observationsOf(given[i]); });
        for (const auto& list : shown) {
            for (const PatchObservation& one : list) progress.add(one);
        }
        std::vector<Pose> views;
        if (most > 0) addBest(progress, most, views, job);
        return {std::move(goal_), std::move(views)};
    }

  private:
    /// The patches visible from a position, in any viewing direction.
    [[nodiscard]] std::vector<PatchObservation> observationsAt(const Eigen::Vector3d& place) const {
        const PatchVisibility visibility(environment_.views.rays(), surfaceRules());
        const std::vector<SurfacePatch>& patches = goal_.surface.patches;
        std::vector<PatchObservation> found;
        std::vector<RayCaster::BundleRay> rays;
        for (std::size_t p = 0; p < patches.size(); ++p) {
            if (!visibility.faces(place, patches[p])) continue;
            const Eigen::Vector3d way = patches[p].point - place;
            const double distance = way.norm();
            found.push_back({p, distance <= goal_.sharp_m, -way / distance});
            rays.push_back({way, static_cast<float>(1.0 - PatchVisibility::kReached_m / distance)});
        }
        std::vector<RayHit> hits;
        environment_.views.rays().castBundle(place, rays, 0.0, hits);
        std::vector<PatchObservation> visible;
        for (std::size_t i = 0; i < found.size(); ++i) {
            if (hits[i].object_id == 0) visible.push_back(found[i]);
        }
        return visible;
    }

    [[nodiscard]] std::vector<PatchObservation> observationsOf(const Pose& pose) const {
        std::vector<PatchObservation> shown;
        for (const PatchObservation& one : observationsAt(pose.position)) {
            if (environment_.views.inImage(pose, goal_.surface.patches[one.patch].point)) {
                shown.push_back(one);
            }
        }
        return shown;
    }

    [[nodiscard]] std::vector<SurfaceCandidate> candidatesAt(std::size_t place) const {
        constexpr double kTurn = 0.6180339887498949;  // golden ratio: phases spread evenly
        const double phase = std::fmod(static_cast<double>(place) * kTurn, 1.0);
        const double x = lens_.cx / lens_.fx;
        const double y = lens_.cy / lens_.fy;
        const double corner_cosine = 1.0 / std::sqrt(1.0 + x * x + y * y);
        std::vector<SurfaceCandidate> candidates;
        for (const Eigen::Vector3d& forward : aimsAround(lens_, environment_.pitch, phase)) {
            SurfaceCandidate one{place, forward, {}};
            const Eigen::Matrix3d camera_from_world =
                lookAlong(forward).conjugate().toRotationMatrix();
            for (std::size_t s = 0; s < observations_[place].size(); ++s) {
                const Eigen::Vector3d& direction = observations_[place][s].direction;
                if (-forward.dot(direction) < corner_cosine) continue;
                const Eigen::Vector3d p = camera_from_world * -direction;
                if (std::abs(p.x()) < x * p.z() && std::abs(p.y()) < y * p.z()) {
                    one.shown.push_back(static_cast<std::uint32_t>(s));
                }
            }
            if (!one.shown.empty()) candidates.push_back(std::move(one));
        }
        return candidates;
    }

    [[nodiscard]] double gainOf(const SurfaceCandidate& one,
                                const SurfaceProgress& progress) const {
        double gain = 0.0;
        for (const std::uint32_t s : one.shown) gain += progress.gain(observations_[one.place][s]);
        return gain;
    }

    /// In a scan, a view must show enough scanned surface.
    [[nodiscard]] bool showsScanned(const Pose& pose) const {
        return environment_.views.scannedShare(pose) >= CaptureRules{}.min_scanned_share;
    }

    /// Lazy greedy: gains only fall, so a candidate whose gain is still the largest after an update
    /// is the best.
    void addBest(SurfaceProgress& progress, std::size_t most, std::vector<Pose>& views,
                 const JobContext& job) const {
        std::vector<std::vector<SurfaceCandidate>> at(places_.size());
        parallelFor(places_.size(), [&](std::size_t i) { at[i] = candidatesAt(i); });
        std::vector<SurfaceCandidate> all;
        for (auto& list : at) {
            for (SurfaceCandidate& one : list) all.push_back(std::move(one));
        }
        std::vector<double> gains(all.size());
        parallelRanges(all.size(), 64, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) gains[i] = gainOf(all[i], progress);
        });
        // Of equal gains the first candidate comes first.
        std::priority_queue<std::pair<double, std::ptrdiff_t>> queue;
        for (std::size_t i = 0; i < all.size(); ++i) {
            queue.emplace(gains[i], -static_cast<std::ptrdiff_t>(i));
        }
        while (!queue.empty() && views.size() < most && !progress.reaches(kCoveredEnough) &&
               !job.cancelled()) {
            const std::ptrdiff_t index = queue.top().second;
            queue.pop();
            const SurfaceCandidate& one = all[-index];
            const double gain = gainOf(one, progress);
            if (gain <= 0.0) continue;
            if (!queue.empty() && std::pair(gain, index) < queue.top()) {
                queue.emplace(gain, index);
                continue;
            }
            const Pose pose{places_[one.place], lookAlong(one.forward)};
            if (!showsScanned(pose)) continue;
            for (const std::uint32_t s : one.shown) progress.add(observations_[one.place][s]);
            views.push_back(pose);
        }
    }

    const PlanningEnvironment& environment_;
    const Intrinsics& lens_;
    SurfaceGoal goal_;
    std::vector<Eigen::Vector3d> places_;
    std::vector<std::vector<PatchObservation>> observations_;  // by position
};

}  // namespace

Result<SurfaceViews> findSurfaceViews(const PlanningEnvironment& environment,
                                      const PlanParams& params, const std::vector<Pose>& given,
                                      std::size_t most, const JobContext& job) {
    std::vector<Eigen::Vector3d> places =
        evenPlaces(environment.free_space, environment.sphere, kSurfacePlaces);
    auto fine = reachablePatches(environment.views.scene(), environment.views.rays(), places,
                                 kSurfaceRaysAround, kFinestPatch_m, job);
    if (!fine) return tl::unexpected(std::move(fine.error()));
    SurfaceGoal goal;
    goal.surface = patchesFor(std::move(*fine));
    goal.sharp_m = sharpWithin_m(params);
    goal.directions = params.coverage.surface_directions;
    SurfaceViews found =
        SurfaceViewSearch(environment, std::move(goal), std::move(places)).choose(given, most, job);
    if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
    return found;
}

}  // namespace dollytrack::planning
