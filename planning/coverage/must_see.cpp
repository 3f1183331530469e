#include "planning/coverage/must_see.h"

#include "engine/core/log.h"
#include "engine/core/text_lists.h"
#include "engine/core/random.h"
#include "engine/geometry/ray_caster.h"
#include "engine/jobs/parallel.h"
#include "planning/collision/swept_sphere.h"
#include "planning/free_space/free_space.h"
#include "planning/visibility/view_estimator.h"

#include <algorithm>
#include <cmath>

namespace dollytrack::planning {
namespace {

constexpr double kSpacing_m = 0.1;
constexpr std::size_t kPlaces = 500;
// More than the 95 % that are asked for: frames are counted by drawn pixels, views by rays.
constexpr double kEnough = 0.98;
constexpr std::size_t kMostViews = 60;
// Share of the seeable patches that a given view must add to be kept.
constexpr double kWorthKeeping = 0.02;
constexpr std::size_t kPlacesTried = 16;  // candidates, those that see most missing patches, per
                                          // new view
constexpr std::size_t kAimsTried = 24;

/// Random legal camera positions near the region.
std::vector<Eigen::Vector3d> placesNear(const PlanningEnvironment& environment,
                                        const OrientedBox& box, double farthest_m) {
    std::vector<Eigen::Vector3d> near;
    for (std::size_t room = 0; room < environment.free_space.rooms().size(); ++room) {
        for (const Eigen::Vector3f& cell : environment.sphere.cells(static_cast<int>(room))) {
            const Eigen::Vector3d place = cell.cast<double>();
            if (box.distance(place) < farthest_m) near.push_back(place);
        }
    }
    std::vector<Eigen::Vector3d> places;
    Random random(1);
    for (std::size_t i = 0; i < 4 * kPlaces && places.size() < kPlaces && !near.empty(); ++i) {
        const Eigen::Vector3d& place = near[random.below(static_cast<std::uint32_t>(near.size()))];
        if (environment.sphere.fits(place)) places.push_back(place);
    }
    return places;
}

/// Chooses the views of one region.
class Covering {
  public:
    Covering(const PlanningEnvironment& environment, const Region& region)
        : environment_(environment), views_(environment.views) {
        result_.name = region.name;
        result_.surface = patchesIn(views_.scene(), region.box, kSpacing_m);
        const PatchVisibility visibility(views_.rays(), views_.intrinsics(),
                                         result_.surface.spacing_m);
        places_ = placesNear(environment, region.box, visibility.farthest_m());
        const double half_height =
            std::atan(0.5 * views_.intrinsics().height / views_.intrinsics().fy);
        const auto& patches = result_.surface.patches;
        seen_from_.resize(places_.size());
        parallelFor(places_.size(), [&](std::size_t i) {
            for (std::size_t p = 0; p < patches.size(); ++p) {
                const double elevation = elevationOf(patches[p].point - places_[i]);
                if (elevation < environment_.pitch.lowest - half_height ||
                    elevation > environment_.pitch.highest + half_height) {
                    continue;
                }
                if (visibility.reaches(places_[i], patches[p])) {
                    seen_from_[i].push_back(static_cast<int>(p));
                }
            }
        });
        result_.seeable.assign(patches.size(), 0);
        for (const auto& list : seen_from_) {
            for (const int p : list) result_.seeable[p] = 1;
        }
        wanted_ = result_.seeable;
    }

    /// Counts the fixed views, then keeps given views that add enough, the best first.
    void takeGiven(const std::vector<ExistingView>& given) {
        std::vector<std::vector<int>> shown(given.size());
        parallelFor(given.size(), [&](std::size_t i) { shown[i] = shownBy(given[i].pose); });
        const auto take = [&](std::size_t i) {
            for (const int p : shown[i]) wanted_[p] = 0;
            shown[i].clear();
        };
        for (std::size_t i = 0; i < given.size(); ++i) {
            if (given[i].fixed) take(i);
        }
        const auto least = static_cast<std::ptrdiff_t>(
            std::ceil(kWorthKeeping * static_cast<double>(countOf(result_.seeable))));
        while (true) {
            std::size_t best = 0;
            std::ptrdiff_t most = 0;
            for (std::size_t i = 0; i < given.size(); ++i) {
                const auto count = std::count_if(shown[i].begin(), shown[i].end(),
                                                 [&](int p) { return wanted_[p] != 0; });
                if (count > most) {
                    most = count;
                    best = i;
                }
            }
            if (most == 0 || most < least) return;
            take(best);
            result_.kept.push_back(static_cast<int>(best));
        }
    }

    MustSee run(const JobContext& job) && {
        const auto seeable = countOf(result_.seeable);
        const auto left = [&] { return countOf(wanted_); };
        while (static_cast<double>(left()) > (1.0 - kEnough) * static_cast<double>(seeable) &&
               result_.views.size() < kMostViews && !job.cancelled()) {
            const auto before = left();
            const Pose best = nextView();
            for (const int p : shownBy(best)) wanted_[p] = 0;
            if (left() == before) break;
            result_.views.push_back(best);
        }
        return std::move(result_);
    }

  private:
    struct Tried {
        int shown = 0;
        Pose pose;
    };

    static std::ptrdiff_t countOf(const std::vector<char>& marked) {
        return std::count(marked.begin(), marked.end(), 1);
    }

    /// Indices of the patches not yet covered that a view shows.
    [[nodiscard]] std::vector<int> shownBy(const Pose& pose) const {
        const PatchVisibility visibility(views_.rays(), views_.intrinsics(),
                                         result_.surface.spacing_m);
        const auto& patches = result_.surface.patches;
        std::vector<int> shown;
        for (std::size_t p = 0; p < patches.size(); ++p) {
            if (wanted_[p] != 0 && views_.inImage(pose, patches[p].point) &&
                visibility.reaches(pose.position, patches[p])) {
                shown.push_back(static_cast<int>(p));
            }
        }
        return shown;
    }

    [[nodiscard]] std::vector<int> wantedFrom(std::size_t place) const {
        std::vector<int> list;
        for (const int p : seen_from_[place]) {
            if (wanted_[p] != 0) list.push_back(p);
        }
        return list;
    }

    /// The best of a few orientations at the positions that see most of the missing patches.
    [[nodiscard]] Pose nextView() const {
        std::vector<std::pair<int, std::size_t>> order;
        for (std::size_t i = 0; i < places_.size(); ++i) {
            order.emplace_back(-static_cast<int>(wantedFrom(i).size()), i);
        }
        const std::size_t count = std::min(kPlacesTried, order.size());
        std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count),
                          order.end());
        std::vector<Tried> tried(count);
        parallelFor(count, [&](std::size_t i) { tried[i] = bestAim(order[i].second); });
        Tried best;
        for (const Tried& one : tried) {
            if (one.shown > best.shown) best = one;
        }
        return best.pose;
    }

    [[nodiscard]] Tried bestAim(std::size_t place) const {
        const std::vector<int> list = wantedFrom(place);
        const auto& patches = result_.surface.patches;
        Tried best;
        const std::size_t aims = std::min(kAimsTried, list.size());
        for (std::size_t i = 0; i <= aims && !list.empty(); ++i) {
            // Aim at single patches, and last at the centroid of all.
            Eigen::Vector3d at = Eigen::Vector3d::Zero();
            if (i < aims) {
                at = patches[list[i * list.size() / aims]].point;
            } else {
                for (const int p : list) at += patches[p].point;
                at /= static_cast<double>(list.size());
            }
            if ((at - places_[place]).norm() < 1e-6) continue;
            Tried one{0, aim(places_[place], at, environment_.pitch)};
            for (const int p : list) {
                one.shown += views_.inImage(one.pose, patches[p].point) ? 1 : 0;
            }
            if (one.shown > best.shown) best = one;
        }
        return best;
    }

    const PlanningEnvironment& environment_;
    const ViewEstimator& views_;
    MustSee result_;
    std::vector<Eigen::Vector3d> places_;
    std::vector<std::vector<int>> seen_from_;  // patch indices, by position
    std::vector<char> wanted_;                 // by patch: 1 if not yet covered
};

}  // namespace

std::vector<Region> mustSeeAmong(const std::vector<Region>& regions) {
    std::vector<Region> wanted;
    for (const Region& region : regions) {
        if (!region.must_see) continue;
        wanted.push_back(region);
        wanted.back().weight = 1.0;
    }
    return wanted;
}

Result<std::vector<MustSee>> findMustSee(const PlanningEnvironment& environment,
                                         const std::vector<Region>& regions,
                                         std::vector<ExistingView> given, const JobContext& job) {
    std::vector<MustSee> all;
    std::vector<std::string> empty;  // names of regions without surface
    for (const Region& region : regions) {
        Covering covering(environment, region);
        covering.takeGiven(given);
        all.push_back(std::move(covering).run(job));
        if (all.back().surface.patches.empty()) empty.push_back("'" + region.name + "'");
        if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
        for (const int kept : all.back().kept) given[kept].fixed = true;
        for (const Pose& view : all.back().views) given.push_back({view, true});
    }
    if (!empty.empty()) {
        log::warn("planning", counted(empty.size(), "must-see region contains",
                                      "must-see regions contain") +
                                  " no surface of the scene: " + listOf(empty));
    }
    return all;
}

Result<std::vector<RegionCoverage>> measureCoverage(const std::vector<MustSee>& must_see,
                                                    const ViewEstimator& views,
                                                    const Trajectory& trajectory,
                                                    const JobContext& job) {
    // Key frames first, because they show most; a patch seen once is not tested again.
    std::vector<const TrajectoryFrame*> frames;
    for (const bool keys : {true, false}) {
        for (const TrajectoryFrame& frame : trajectory.frames) {
            if ((frame.position_point >= 0) == keys) frames.push_back(&frame);
        }
    }
    std::vector<RegionCoverage> all;
    for (const MustSee& region : must_see) {
        const auto& patches = region.surface.patches;
        const PatchVisibility visibility(views.rays(), views.intrinsics(),
                                         region.surface.spacing_m);
        std::vector<char> seen(patches.size(), 0);
        parallelFor(patches.size(), [&](std::size_t p) {
            for (const TrajectoryFrame* frame : frames) {
                if (job.cancelled()) return;
                if (views.inImage(frame->pose, patches[p].point) &&
                    visibility.reaches(frame->pose.position, patches[p])) {
                    seen[p] = 1;
                    break;
                }
            }
        });
        if (job.cancelled()) return fail(ErrorCode::Cancelled, "Planning was cancelled.");
        RegionCoverage coverage;
        coverage.name = region.name;
        coverage.patches = static_cast<int>(patches.size());
        for (std::size_t p = 0; p < patches.size(); ++p) {
            coverage.seeable += seen[p] != 0 || region.seeable[p] != 0 ? 1 : 0;
            coverage.seen += seen[p];
        }
        all.push_back(std::move(coverage));
    }
    return all;
}

}  // namespace dollytrack::planning
